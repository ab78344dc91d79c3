"""The command learn: what it writes, and that it goes on after an interruption as if there had been none."""

import json

import numpy as np
import pytest

import flypend as fp
from flypend.files.toml import toml_text
from flypend.learning import training
from flypend.learning.course import Course
from flypend.learning.training import Learner, Training


@pytest.fixture
def little(monkeypatch):
    """A training of seconds, in place of one of minutes, with a checkpoint every 25 updates."""

    def usual(vehicle, seed=0, updates=None, bands=False, sensors=None):
        course = Course(vehicle, duration=0.6, bands=bands, sensors=sensors)
        return Training(course, seed=seed, rounds=2, steps=5, updates=updates or 100, batch=16, hidden=(8, 8))

    monkeypatch.setattr(training, "usual", usual)
    monkeypatch.setattr("flypend.cli.studies.OFTEN", 25)


def weights(path):
    with np.load(path) as stored:
        return {name: stored[name] for name in stored.files}


@pytest.mark.usefixtures("little")
def test_it_learns_is_interrupted_and_goes_on(call, tmp_path, monkeypatch):
    assert call("learn", "--out", "whole", "--runs", 20)[0] == 0
    descend = Learner.descend

    def until_40(self, told=lambda _: None):
        if self.done == 40:
            raise KeyboardInterrupt
        descend(self, told)

    monkeypatch.setattr(Learner, "descend", until_40)
    code, _, complaints = call("learn", "--out", "half", "--runs", 20)
    assert code == 130
    assert "flypend learn --out half --runs 20" in complaints
    assert not (tmp_path / "half" / "policy.npz").exists()
    begun = []
    monkeypatch.setattr(Learner, "descend", lambda self: (begun.append(self.done), descend(self)))
    code, said, _ = call("learn", "--out", "half", "--runs", 20)
    assert (code, begun[0]) == (0, 25)
    assert "learned" in said
    whole, half = (weights(tmp_path / name / "policy.npz") for name in ("whole", "half"))
    assert all(np.array_equal(half[name], array) for name, array in whole.items())
    curve = json.loads((tmp_path / "half" / "curve.json").read_text())["curve"]
    assert [(row["phase"], row["update"]) for row in curve] == [(0, 1), (0, 2), (1, 25), (1, 50), (1, 75), (1, 100)]
    assert (tmp_path / "half" / "curve.png").read_bytes().startswith(b"\x89PNG")
    fp.laws.learned(policy=str(tmp_path / "half" / "policy.npz")).bind(fp.vehicle("hehn2011"))


@pytest.mark.usefixtures("little")
def test_a_law_within_bands_and_the_best_law_is_named(call, tmp_path):
    """A policy of seconds fails where the tuned law does not: the tuned law is named, with the true sensors flown."""
    near = {"mass": (0.49, 0.51)}  # an input of the kernels, which all machines share
    (tmp_path / "mine.toml").write_text(toml_text(fp.vehicle("hehn2011").replace(bands=near).to_dict()), "utf-8")
    given = ("--vehicle", "mine.toml", "--updates", 1, "--runs", 18)
    code, said, _ = call("learn", *given, "--bands", "--sensors", "mocap")
    assert code == 0
    assert "The best law here is inverted." in said
    course = json.loads((tmp_path / "learn-out" / "curve.json").read_text())["training"]["course"]
    assert course["bands"]
    assert course["sensors"]["position"]["latency"] == 0.01


@pytest.mark.usefixtures("little")
def test_what_is_not_possible_is_told_in_a_line(call, tmp_path):
    for arguments, words in (
        (("--mount", "bogus"), "mount: expected one of gimbal, hub, cup, got 'bogus'"),
        (("--mount", "cup"), "mount: expected gimbal or hub"),
        (("--sensors", "bogus"), "--sensors: expected one of"),
        (("--vehicle", "none.toml"), "none.toml: expected a readable TOML file"),
    ):
        code, said, complaints = call("learn", *arguments)
        assert (code, said) == (2, "")
        assert words in complaints
    (tmp_path / "cut").mkdir()
    (tmp_path / "cut" / "checkpoint.npz").write_bytes(b"PK\x03\x04")
    code, _, complaints = call("learn", "--out", "cut")
    assert code == 2
    assert complaints.startswith("flypend: checkpoint: expected one of the same training")
    assert not (tmp_path / "learn-out").exists()
