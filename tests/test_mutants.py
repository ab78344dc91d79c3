"""Mutations: what is planted is a mistake and always the same, and mistakes that once passed are caught."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests import mutants

ROOT = Path(__file__).parents[1]
LAW = """
def force(vehicle, state, rotors, angle):
    if angle > 1:
        raise ValueError(f"{angle - 1} too much")
    pull = vehicle.M * state.x - vehicle.m * rotors.T
    return turned(pull, -np.radians(angle))[0]
"""


@pytest.fixture
def source(tmp_path, monkeypatch):
    """A package of one room, and a function that writes a file into it and returns the mutations drawn there."""
    monkeypatch.setattr(mutants, "SOURCE", tmp_path)
    (tmp_path / "room").mkdir()

    def draw(name, text, count):
        (tmp_path / "room" / name).write_text(text, encoding="utf-8")
        mutants._read.cache_clear()
        return mutants.drawn(count)

    yield draw
    mutants._read.cache_clear()


def test_every_kind_of_mistake_is_found_and_messages_are_left_alone(source):
    drawn = source("law.py", LAW, 20)
    assert {one.kind for one in drawn} == {
        "sign", "comparison", "off by one", "swapped", "dropped term", "transposed", "unit", "dropped check",
    }  # fmt: skip
    changed = {one.name().partition(" → ")[2] for one in drawn}
    assert {
        "pull = vehicle.M * state.x + vehicle.m * rotors.T", "pull = vehicle.M * state.x - vehicle.m * rotors",
        "pull = vehicle.m * state.x - vehicle.m * rotors.T", "if False:", "if angle < 1:",
        "return turned(pull, -(angle))[0]", "return turned(pull, -np.radians(angle))[1]",
    } <= changed  # fmt: skip
    assert not [one for one in changed if "too much" in one]
    assert all(one.within == ("force",) for one in drawn)


def test_an_edit_elsewhere_changes_none_of_those_drawn(source):
    before = {one.name() for one in source("law.py", LAW, 6)}
    after = {one.name() for one in source("law.py", "LENGTH = 3\n" + LAW.replace("too much", "too far"), 6)}
    assert before == after


def test_mistakes_that_once_passed_are_caught():
    command = [sys.executable, "tests/mutants.py", "--count", "0"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "SURVIVED" not in done.stdout
    assert done.stdout.splitlines()[-1].endswith(" caught, 0 survived with a reason, 0 without")
