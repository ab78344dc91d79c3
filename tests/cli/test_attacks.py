"""Mutated settings and files, through the command's own entry: exit code 0, 1 or 2, one line, no traceback, no hang.

The small number runs with every test; `pytest -m slow tests/cli/test_attacks.py -s` runs the full one and prints the
counts of docs/reliability.md.
"""

import contextlib
import io
import random
import signal
import sys
import time
from collections import Counter
from copy import deepcopy

import pytest

import flypend as fp
from flypend.cli import app as cli
from flypend.files.toml import toml_text
from flypend.flight import simulate
from flypend.studies.sweep import run

LONGEST = 10.0  # s of processor time of any command: other tests run beside it
PATIENCE = 60.0  # s of wall time after which a command that computes nothing is ended
NUMBERS = [
    0, -1, 1, 1e-9, 1e9, 1e30, 1e308, float("nan"), float("inf"), float("-inf"), 0.5, 1e-30, True, "x", "", [], [1.0],
    {}, 10, 100, 1e5, 1e-4, 3, 0.05, 2**62, "../../etc/passwd", "a\u0000b", "\U0001f681", [1.0, 2.0], {"x": 1.0},
]  # fmt: skip
RUN = {
    "vehicle": {
        "base": "hehn2011", "mass": 0.5, "bob_mass": 0.05, "rod_length": 0.5, "gravity": 9.81, "rotor_lag": 0.02,
        "drag_ratio": 0.02, "inertia": [0.0025, 0.0025, 0.0045], "rotor_limits": [0.08, 3.5], "name": "mine",
    },
    "law": {"name": "inverted", "gains": {"position_bandwidth": 2.0, "attitude_bandwidth": 20.0}},
    "duration": 0.1,
    "plant": {
        "base": "rotors", "rate": 500.0, "delay": 0.0, "lag": 0.02, "pivot_offset": [0.0, 0.0, 0.0], "seed": 1,
        "limits": True, "interface": "wrench", "mismatch": {"mass": 1.1}, "noise": {"x": 0.001},
        "wind": {"on_bob": [0.1, 0.0, 0.0], "gust_on_bob": 0.1, "gust_time": 1.0},
    },
    "rtol": 1e-6,
    "start": {"y": [0.0, 0.0, -1.0], "omega": [0.0, 0.1, 0.0], "x": [0.0, 0.0, 0.0]},
}  # fmt: skip
STUDY = {
    "vehicle": {"base": "nayak2018", "mass": 0.5},
    "law": {"name": "corrected", "gains": {"k_d": 2.0}},
    "plant": "ideal",
    "duration": 0.1,
    "judge_period": 0.05,
    "rtol": 1e-4,
    "runs": 4,
    "chunk": 2,
    "seed": 1,
    "sampling": "sobol",
    "precision": "double",
    "max_steps": 1000,
    "final": False,
    "criterion": {"target": "e3", "position": 1.0, "rod": 1.0, "axis": 0.5, "hold": 0.05},
    "vary": {
        "start": {"y": "uniform", "omega": {"ball": 3.0}},
        "gains": {"k_1": {"from": 4.0, "to": 9.0, "points": 2}},
    },
}


class LateError(BaseException):
    """A command took too long."""


def late(*_):
    raise LateError


def called(arguments):
    """Exit code of a command called in this process, what it complains of, and the seconds that it took."""
    told, out = io.StringIO(), io.StringIO()
    before, sys.argv = sys.argv, ["flypend", *arguments]
    handlers = {number: signal.getsignal(number) for number in (signal.SIGALRM, signal.SIGTERM)}
    signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, PATIENCE)
    begin = time.process_time()
    try:
        with contextlib.redirect_stderr(told), contextlib.redirect_stdout(out):
            cli.main()
    except SystemExit as end:
        code = end.code
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        took = time.process_time() - begin
        sys.argv = before
        for number, handler in handlers.items():
            signal.signal(number, handler)
    return code, told.getvalue(), took


def check(arguments, what):
    """Call a command on `what`, and return its exit code. It must be 0, 1 or, with one line, 2, and come in time."""
    try:
        code, told, took = called(arguments)
    except AcceptedError:
        raise
    except BaseException as error:
        raise AssertionError(f"{arguments} ended in {error!r} on\n{what}") from error
    assert code in (0, 1, 2), f"{arguments} exits with {code} on\n{what}"
    assert "Traceback" not in told, f"{told} on\n{what}"
    assert code != 2 or (told.count("\n") == 1 and told.startswith("flypend: ")), f"{told!r} on\n{what}"
    assert took < LONGEST, f"{arguments} took {took:.1f} s on\n{what}"
    return code


# Settings -------------------------------------------------------------------------------------------------------------


def places(table, path=()):
    """Every place of a nested table, as a tuple of keys."""
    for key, value in table.items():
        yield (*path, key)
        if isinstance(value, dict):
            yield from places(value, (*path, key))


def mutated_settings(base, rng):
    """A copy of `base` with one to three entries replaced, removed, renamed or doubled in the text, as text."""
    table = deepcopy(base)
    for _ in range(rng.choice([1, 1, 2, 3])):
        *outer, last = rng.choice(list(places(table)))
        inner = table
        for key in outer:
            inner = inner[key]
        kind = rng.choice(["replace"] * 6 + ["remove", "rename"])
        if kind == "replace":
            inner[last] = deepcopy(rng.choice(NUMBERS))
        elif kind == "remove":
            del inner[last]
        else:
            inner[last + rng.choice("sx_")] = inner.pop(last)
        if not table:
            break
    text = toml_text(table)
    return mutated_text(text, rng) if rng.random() < 0.15 else text


def mutated_text(text, rng):
    """`text` with a stretch removed, doubled or replaced by characters that TOML minds."""
    a = rng.randrange(len(text) + 1)
    b = min(len(text), a + rng.randrange(1, 20))
    return text[:a] + rng.choice(["", text[a:b] * 2, rng.choice('{}[]"=#.,\x00é\n')]) + text[b:]


class AcceptedError(Exception):
    """The settings have passed every check, and the flight would begin."""


def accepted(*_args, **_more):
    raise AcceptedError


def attack_settings(number, seed, folder, monkeypatch, flown):
    """Exit codes of `number` settings. Of those that are accepted one in `flown` is compiled and flown."""
    monkeypatch.chdir(folder)
    monkeypatch.setenv("FLYPEND_CACHE", str(folder / "cache"))
    rng, codes = random.Random(seed), Counter()
    fly, fly_range = simulate.fly, run.fly_range
    for k in range(number):
        really = rng.randrange(flown) == 0
        monkeypatch.setattr(simulate, "fly", fly if really else accepted)
        monkeypatch.setattr(run, "fly_range", fly_range if really else accepted)
        as_study = k % 4 == 3
        text = mutated_settings(STUDY if as_study else RUN, rng)
        (folder / "f.toml").write_text(text, encoding="utf-8")
        sweep = ["sweep", "f.toml", "-o", "s.zarr", "--force", "--workers", "1"]
        arguments = sweep if as_study else ["run", "f.toml", "--no-figures", "-o", "out"]
        try:
            codes[check(arguments, text)] += 1
        except AcceptedError:
            codes["accepted"] += 1
    return codes


def test_mutated_settings_end_in_a_code_and_one_line(tmp_path, monkeypatch):
    codes = attack_settings(150, 1, tmp_path, monkeypatch, 20)
    assert codes[0] + codes["accepted"] > 10  # not all are refused at the door
    assert codes[2] > 50


@pytest.mark.slow
def test_10_000_mutated_settings(tmp_path, monkeypatch):
    print("10,000 mutated settings, by exit code:", dict(attack_settings(10_000, 2, tmp_path, monkeypatch, 50)))


# Saved runs -----------------------------------------------------------------------------------------------------------


def mutated_bytes(content, rng):
    """`content` with bytes changed, a stretch removed, doubled or zeroed, or cut."""
    content = bytearray(content)
    for _ in range(rng.choice([1, 1, 2, 8])):
        if not content:
            break
        a = rng.randrange(min(len(content), rng.choice([64, 2048, len(content)])))
        b = min(len(content), a + rng.choice([1, 4, 64, 1024]))
        kind = rng.choice(["flip", "flip", "random", "zero", "remove", "double", "cut"])
        if kind == "flip":
            content[a] ^= 1 << rng.randrange(8)
        elif kind == "random":
            content[a:b] = rng.randbytes(b - a)
        elif kind == "zero":
            content[a:b] = bytes(b - a)
        elif kind == "remove":
            del content[a:b]
        elif kind == "double":
            content[a:a] = content[a:b]
        else:
            del content[a:]
    return bytes(content)


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0, 0, 1.0)), 0.05)
    path = tmp_path_factory.mktemp("saved") / "run.nc"
    run.save(path)
    return path.read_bytes(), run.packed


def attack_saved(number, seed, content, folder, monkeypatch):
    """Load mutated files: what loads has every number of the run."""
    rng, ends = random.Random(seed), Counter()
    content, packed = content
    path = folder / "run.nc"
    for k in range(number):
        path.write_bytes(mutated_bytes(content, rng))
        begin = time.process_time()
        with contextlib.suppress(fp.InputError):
            assert fp.load(path).packed.tobytes() == packed.tobytes(), (seed, k)
            ends["loaded, every number right"] += 1
            continue
        ends["refused"] += 1
        assert time.process_time() - begin < LONGEST
        if k % 50 == 0:
            check(["replay", str(path), "-o", str(folder / "page.html")], f"the file {k} of seed {seed}")
    return ends


def test_mutated_runs_are_loaded_or_refused(saved, tmp_path, monkeypatch):
    ends = attack_saved(200, 1, saved, tmp_path, monkeypatch)
    assert ends["refused"] > 50


@pytest.mark.slow
def test_3000_mutated_runs(saved, tmp_path, monkeypatch):
    print("3,000 mutated .nc files:", dict(attack_saved(3000, 2, saved, tmp_path, monkeypatch)))
