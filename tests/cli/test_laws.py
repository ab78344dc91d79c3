"""A law of one's own on the command line: taken everywhere, and one line and exit code 2 for every mistake in it."""

import json
import sys

import pytest

from tests.few import each_once

TEXT = """
import numpy as np
import flypend as fp
from flypend.geometry import E3, cross

def balance(t, state, vehicle, *, stiffness=300.0, damping=30.0):
    error = state.R.T @ cross(state.z, E3)
    return fp.Wrench(vehicle.weight, vehicle.I @ (stiffness * error - damping * state.omega))

def stepped(t, state, vehicle, *, damping=30.0):
    if state.x[2] > 1e3:
        return fp.Wrench(0.0, np.zeros(3))
    return fp.Wrench(vehicle.weight, -damping * vehicle.I @ state.omega)

def misspelt(t, state, vehicle):
    return fp.Wrench(vehicle.weight, state.omga)

def late(t, state, vehicle):
    if t > 0.05:
        return fp.Wrench(1 / 0, np.zeros(3))
    return fp.Wrench(vehicle.weight, np.zeros(3))
"""
STUDY = """
vehicle = "hehn2011"
duration = 1.0
runs = 4
law = "mine.py:balance"
[vary.start]
y = "uniform"
[tune]
runs = 2
generations = 1
population = 2
[tune.gains]
damping = [3.0, 300.0]
"""
RUN = """
vehicle = "hehn2011"
duration = 0.1
law = { function = "mine.py:balance", gains = { damping = 20.0 } }
start = { y = [0.0, 0.0, 1.0] }
"""
LINES = {
    "run": "run run.toml --no-figures --out out --law",
    "compare": "compare --runs 2 --duration 1 --out out --law",
    "ladder": "ladder --rung noise --runs 2 --duration 1 --out out --law",
    "map": "map --runs 4 --duration 1 --out map.png --law",
    "sweep": "sweep study.toml --out out.zarr --workers 1 --law",
    "tune": "tune study.toml --out out --workers 1 --law",
}


@pytest.fixture
def call(call, tmp_path, monkeypatch):
    """The command in a folder with laws."""
    monkeypatch.setattr(sys, "path", list(sys.path))
    for name, text in {"mine.py": TEXT, "study.toml": STUDY, "run.toml": RUN, "bad.py": "def f(:\n"}.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return call


@pytest.mark.parametrize(("command", "law"), each_once(LINES, ("mine.py:stepped", "mine.py:balance")))
def test_every_command_takes_it(call, command, law):
    code, _, told = call(*LINES[command].split(), law)
    assert code == 0, told
    note = "stepped is not written in symbols: an if on symbols"
    assert told.startswith(note) if "stepped" in law else note not in told
    assert len(told.splitlines()) == ("stepped" in law)


def test_export_takes_what_is_symbolic_and_refuses_the_rest(call, tmp_path):
    code, _, told = call("export-c", "--law", "mine.py:balance", "--out", "c")
    assert code == 0
    assert told.startswith("flypend: warning: the exported law flies hehn2011 poorly: hover: 0 of 12 stand")
    assert "stiffness" in (tmp_path / "c" / "flypend_law.h").read_text(encoding="ascii")
    code, _, told = call("export-c", "--law", "mine.py:stepped", "--out", "d")
    assert (code, len(told.splitlines()), (tmp_path / "d").exists()) == (2, 1, False)
    assert told.startswith(
        "flypend: --law: expected a law written in symbols, got mine.py:stepped, which is not (an if"
    )
    assert "mine.py:11" in told


def test_a_file_stands_where_the_run_file_stands(call, tmp_path, monkeypatch):
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    code, out, told = call("run", "../run.toml", "--no-figures", "--out", "out", "--set", "law.gains.stiffness=250")
    assert (code, told) == (0, "")
    assert out.startswith("balance, stiffness 250, damping 20 on hehn2011")
    settings = json.loads((tmp_path / "elsewhere" / "out" / "report.json").read_text(encoding="utf-8"))["settings"]
    assert settings["law"]["function"] == f"{tmp_path / 'mine.py'}:balance"
    assert settings["law"]["gains"] == {"damping": 20.0, "stiffness": 250}
    code, _, told = call("run", "../run.toml", "--law", "mine.py:balance", "--out", "other")  # from the current folder
    assert code == 2
    assert told.startswith("flypend: law.function: expected a file that is there, got ")


@pytest.mark.parametrize("command", LINES)
@pytest.mark.parametrize(
    ("law", "words"),
    [
        (
            "mine.py:misspelt",
            "mine.py:16: AttributeError: 'State' object has no attribute 'omga' (did you mean 'omega'?)",
        ),
        ("mine.py:balanse", "got 'balanse' (did you mean 'balance'?)"),
        ("bad.py:f", "bad.py:1: SyntaxError: invalid syntax"),
        ("none.py:f", "expected a file that is there, got "),
    ],
)
def test_a_mistake_is_one_line_and_nothing_is_written(call, tmp_path, command, law, words):
    before = sorted(path.name for path in tmp_path.iterdir())
    code, out, told = call(*LINES[command].split(), law)
    assert (code, out) == (2, "")
    assert told.startswith("flypend: ")
    assert words in told
    assert len(told.splitlines()) == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == before


@pytest.mark.parametrize("command", ["run", "compare", "sweep"])
def test_a_mistake_in_flight_is_one_line(call, command):
    code, _, told = call(*LINES[command].split(), "mine.py:late")
    assert code == 2
    note, line = told.splitlines()
    assert note.startswith("late is not written in symbols")
    assert line == "flypend: mine.py:20: ZeroDivisionError: division by zero (in the law late)"


def test_debug_shows_the_traceback(call):
    code, _, told = call("--debug", "run", "run.toml", "--law", "mine.py:misspelt")
    assert code == 2
    assert told.startswith("Traceback (most recent call last):")
    assert "return fp.Wrench(vehicle.weight, state.omga)" in told
    assert told.splitlines()[-1].startswith("flypend: mine.py:16: AttributeError")
