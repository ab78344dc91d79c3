"""Tuning: it improves what the study asks for, on starts that it reports and never saw, and its result flies."""

import json
import math
import tomllib
from types import SimpleNamespace

import numpy as np
import pytest

import flypend as fp
from flypend.cli import app as cli
from flypend.files.toml import toml_text
from flypend.flight.ensemble import fly_many
from flypend.flight.simulate import fly
from flypend.report.tuning import summarise
from flypend.settings.runfile import run_file, run_of
from flypend.studies.sweep import cube
from flypend.studies.sweep.design import design
from flypend.studies.tune import STANDARD, Objective

STUDY = {
    "vehicle": "nayak2018", "law": {"name": "corrected", "gains": {"k_d": 0.4, "yaw_damping": 1.0}}, "plant": "ideal",
    "duration": 5.0,    "judge_period": 0.1, "runs": 300, "seed": 3,
    "criterion": {"target": "e3", "position": math.inf, "rod": 0.2, "axis": 0.2},
    "vary": {"start": {"y": "uniform", "R": "uniform", "y_dot": {"disc": 1.0}}},
    "tune": {"gains": {"k_d": [0.3, 4.0], "k_1": [4.0, 60.0]}, "runs": 60, "generations": 6, "population": 6},
}  # fmt: skip


@pytest.fixture(scope="module")
def found():
    return fp.tune(STUDY, workers=1)


def test_gains_become_better_on_starts_that_were_not_tuned_on(found):
    assert found.after["cost"] < 0.7 * found.before["cost"]
    assert found.after["wilson_low"] > found.before["wilson_high"]  # the intervals do not touch
    assert set(found.gains) == {"k_d", "k_1"}
    for name, (low, high) in STUDY["tune"]["gains"].items():
        assert low <= found.gains[name] <= high
    assert found.before["gains"] == {"k_d": 0.4, "k_1": 9.0}


def test_the_starts_tuned_on_are_none_of_those_reported():
    study = fp.study(STUDY)
    tuned, reported = (design(study, 0, 300, stream).packed for stream in (cube.TUNED, cube.REPORTED))
    assert not {tuple(row) for row in tuned} & {tuple(row) for row in reported}
    np.testing.assert_array_equal(reported, design(study, 0, 300).packed)  # what a sweep flies


def test_starts_of_a_sobol_sequence_have_no_interval():
    report = fp.tune(SMALL | {"sampling": "sobol", "tune": SMALL["tune"] | {"generations": 1}}, workers=1).after
    assert report["wilson_low"] is report["wilson_high"] is None
    assert "runs succeed (no interval), median" in summarise(report)


def test_what_is_reported_is_what_a_sweep_finds(found, tmp_path):
    for report in (found.before, found.after):
        table = STUDY | {"law": {"name": "corrected", "gains": {**STUDY["law"]["gains"], **report["gains"]}}}
        data = fp.sweep({key: value for key, value in table.items() if key != "tune"},
                        tmp_path / f"{report['cost']}.zarr", workers=1)  # fmt: skip
        assert report["success"] == pytest.approx(float(data.success.mean()), abs=0.01)  # rounding apart, the same runs


def test_the_same_seed_finds_the_same_gains_and_another_does_not(found):
    again = fp.tune(STUDY, workers=2)
    assert again.gains == found.gains
    assert again.history == found.history
    other = fp.tune(STUDY | {"tune": STUDY["tune"] | {"seed": 2}}, workers=1)
    assert other.gains != found.gains


def test_the_history_falls_and_counts_the_runs(found):
    best = [entry["best"] for entry in found.history]
    assert best == sorted(best, reverse=True)
    assert [entry["runs"] for entry in found.history] == [360 * (k + 1) for k in range(6)]
    assert all(entry["best"] <= entry["median"] for entry in found.history)


def test_the_objective_is_what_its_weights_say():
    columns = {
        "success": np.array([True, False]), "settling": np.array([2.0, np.nan]),
        "excursion": np.array([3.0, np.inf]), "effort": np.array([1.5, np.nan]),
    }  # fmt: skip
    assert Objective(failure=1, settling=0).cost(columns, 10.0).tolist() == [0, 1]
    assert Objective(failure=0, settling=1).cost(columns, 10.0).tolist() == [0.2, 2]
    assert Objective(failure=0, settling=0, excursion=1).cost(columns, 10.0).tolist() == [3, 100]
    assert Objective(failure=0, settling=0, effort=2).cost(columns, 10.0).tolist() == [3, 200]


SMALL = STUDY | {"runs": 50, "tune": STUDY["tune"] | {"runs": 20, "generations": 4}}


def test_an_interrupted_search_goes_on_to_the_same_result(tmp_path):
    """Stopped after two of four generations, with half a line written on: two are read, two are flown."""
    path = tmp_path / "costs.jsonl"
    whole = fp.tune(SMALL, workers=1)

    def stop(generation, _):
        if generation == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fp.tune(SMALL, workers=1, costs=path, progress=stop)
    with path.open("a", encoding="utf-8") as file:
        file.write("[[0.1, 0.2")
    told = []
    again = fp.tune(SMALL, workers=1, costs=path, progress=lambda *now: told.append(now))
    assert told == [(2, 4), (1, 4), (2, 4), (3, 4), (4, 4)]
    assert (again.gains, again.history, again.after) == (whole.gains, whole.history, whole.after)
    turned = {key: SMALL[key] for key in reversed(SMALL)} | {"duration": int(SMALL["duration"])}
    turned["tune"] = {key: SMALL["tune"][key] for key in reversed(SMALL["tune"])}
    turned["tune"]["gains"] = {"k_1": [4, 60], "k_d": [0.3, 4]}
    same = fp.tune(turned, workers=1, costs=path, progress=lambda *now: told.append(now))
    assert told[5:] == [(4, 4), (1, 4), (2, 4), (3, 4), (4, 4)]
    assert (same.gains, same.history) == (whole.gains, whole.history)
    with pytest.raises(fp.InputError, match="expected the costs of this search"):
        fp.tune(SMALL | {"seed": 9}, workers=1, costs=path)


def test_noise_is_tuned_on_other_seeds_than_it_is_reported_on():
    table = {
        "vehicle": "hehn2011", "law": {"name": "corrected", "gains": {"k_d": 1.0}}, "duration": 0.3, "runs": 5,
        "criterion": {"hold": 0.1},
        "plant": {"base": "rotors", "rate": 100.0, "noise": {"omega": 0.5}}, "start": {"y": [0, 0, 1]},
        "vary": {"start": {"omega": {"ball": 1e-9}}},
        "tune": {"gains": {"k_d": [0.5, 2.0]}, "runs": 5, "generations": 1, "population": 2,
                 "objective": {"failure": 0.0, "settling": 0.0, "effort": 1.0}},
    }  # fmt: skip
    one = fp.tune(table, workers=1)
    assert one.history[0]["best"] != one.after["cost"]  # but for the noise these would be equal to nine digits
    calm = {**table, "plant": {"base": "rotors", "rate": 100.0}}
    two = fp.tune(calm, workers=1)
    assert two.history[0]["best"] == pytest.approx(two.after["cost"], rel=1e-5)


# Files and the command ------------------------------------------------------------------------------------------------


def test_with_bands_every_gain_vector_flies_vehicles_drawn_and_the_report_flies_others(monkeypatch):
    flown = []

    def watched(flight, *given, **named):
        flown.append(flight)
        return fly_many(flight, *given, **named)

    monkeypatch.setattr("flypend.studies.tune.fly_many", watched)
    vehicle = fp.vehicle("hehn2011").replace(bands={"mass": [0.4, 0.6], "delay": [0.0, 0.02]})
    study = {
        "vehicle": vehicle.to_dict(), "law": {"name": "inverted"}, "plant": {"base": "rotors", "rate": 100.0},
        "duration": 0.2, "runs": 5, "criterion": {"hold": 0.1}, "vary": {"start": {"y": "uniform"}},
        "tune": {"bands": 1, "runs": 3, "generations": 1, "population": 2},
    }  # fmt: skip
    tuned = fp.tune(study, workers=1)
    searched, reported = flown[:2], flown[2:]
    written = fp.study(study).flight.plant
    assert [flight.plant == written for flight in flown] == [True, False] * 3
    assert len({flight.plant for flight in searched} & {flight.plant for flight in reported}) == 1
    assert 0.4 / 0.5 <= searched[1].plant.mismatch["mass"] <= 0.6 / 0.5
    seeds = [flight.seed + i for flight in searched for i in range(flight.runs)]
    assert len(seeds) == len(set(seeds))  # noise of their own
    assert [len(flight.starts.x) for flight in flown] == [4, 2, 3, 2, 3, 2]  # two gain vectors on 2 and 1 starts
    assert set(tuned.gains) == set(STANDARD)
    assert tuned.after["runs"] == 5
    with pytest.raises(fp.InputError, match=r"^vehicle\.bands"):
        fp.tune(study | {"vehicle": "hehn2011"})
    with pytest.raises(fp.InputError, match=r"^tune\.bands: expected a sampled plant"):
        fp.tune(study | {"plant": "ideal"})


def test_on_sensors_the_report_flies_the_law_of_the_study_and_that_of_the_run_file(monkeypatch):
    """Neither is that of the search, in whose one kernel every gain vector shares the calm of the study's gains."""
    flown = []

    def watched(flight, **_):
        flown.append(flight)
        numbers = {name: np.ones(flight.runs) for name in ("settling", "excursion", "effort")}
        return SimpleNamespace(columns={"success": np.ones(flight.runs, dtype=bool), **numbers})

    monkeypatch.setattr("flypend.studies.tune.fly_many", watched)
    monkeypatch.setattr("flypend.studies.tune.program_digest", lambda _: "")
    study = {
        "vehicle": "hehn2011", "law": {"name": "inverted"}, "plant": {"base": "rotors", "sensors": "mocap"},
        "duration": 1.0, "runs": 3, "vary": {"start": {"y": "uniform"}},
        "tune": {"gains": {"rod_damping": [0.3, 1.5]}, "runs": 2, "generations": 1, "population": 2},
    }  # fmt: skip
    tuned = fp.tune(study, workers=1)
    search, before, after = (flight.law for flight in flown)
    own, again = fp.study(study).law, run_of(tuned.settings()).flight.law
    assert set(own.prepared["calming"]) - set(search.prepared["calming"]) == {"rod_damping"}
    assert before.prepared["calming"] == own.prepared["calming"]
    assert after.prepared["calming"] == again.prepared["calming"] != search.prepared["calming"]
    assert (after.gains, after.calm) == (again.gains, again.calm)
    assert after.gains["rod_damping"] == tuned.gains["rod_damping"]
    assert not flown[1].gains
    assert not flown[2].gains


def test_the_command_leaves_a_file_that_flies(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    small = STUDY | {"runs": 50, "tune": STUDY["tune"] | {"runs": 20, "generations": 2}}
    (tmp_path / "study.toml").write_text(toml_text(small), encoding="utf-8")
    monkeypatch.setattr("sys.argv", ["flypend", "tune", "study.toml", "-o", "out", "--workers", "1"])
    monkeypatch.setattr(cli.signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as exit_:
        cli.main()
    assert exit_.value.code == 0
    told = capsys.readouterr().out
    left = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert left == ["costs.jsonl", "history.json", "history.png", "tuned.toml"]
    history = json.loads((tmp_path / "out" / "history.json").read_text(encoding="utf-8"))
    settings = tomllib.loads((tmp_path / "out" / "tuned.toml").read_text(encoding="utf-8"))
    assert settings["law"]["gains"] == {"yaw_damping": 1.0, **history["after"]["gains"]}
    chosen = run_file("out/tuned.toml", ["duration=0.2"]).flight
    drawn = design(fp.study(small), 0, 1).packed[0]
    np.testing.assert_allclose(chosen.starts.packed(), drawn, rtol=0, atol=1e-15)  # a start of the study, not another
    assert fly(chosen).outcome.status == "completed"
    assert f"k_d = {history['after']['gains']['k_d']:g}" in told
    assert fp.study(tomllib.loads(history["study"])).text() == history["study"]


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"gain": {}}, "tune.gain: "),
        ({"gains": {}}, "tune.gains: expected a table of gains"),
        ({"gains": {"k_9": [1, 2]}}, "tune.gains.k_9: "),
        ({"gains": {"k_d": [2.0, 1.0]}}, "tune.gains.k_d: expected 0 < least < largest"),
        ({"gains": {"k_d": [1.0, 2.0]}}, "tune.gains.k_d: expected a range around 0.4"),
        ({"gains": {"k_d": 1.0}}, "tune.gains.k_d: "),
        ({"objective": 3}, "tune.objective: expected a table"),
        ({"objective": {"sucess": 1.0}}, "tune.objective.sucess: "),
        ({"objective": {"failure": math.nan}}, "tune.objective.failure: "),
        ({"runs": 0}, "tune.runs: "),
        ({"population": 1}, "tune.population: "),
        ({"seed": 0}, "tune.seed: "),
        ({"step": -1.0}, "tune.step: "),
    ],
)
def test_mistakes_are_told_with_their_field(change, line):
    with pytest.raises(fp.InputError) as caught:
        fp.tune(STUDY | {"tune": STUDY["tune"] | change})
    assert str(caught.value).startswith(line)


def test_a_study_that_varies_gains_is_not_tuned():
    vary = STUDY["vary"] | {"gains": {"k_2": {"values": [4.0]}}}
    with pytest.raises(fp.InputError, match=r"^vary: expected starts that are drawn"):
        fp.tune(STUDY | {"vary": vary})
