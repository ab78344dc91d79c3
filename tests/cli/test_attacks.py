"""Mutated settings and files, through the command's own entry: exit code 0, 1 or 2, one line, no traceback, no hang.

The small number runs with every test; `pytest -m slow tests/cli/test_attacks.py -s` runs the full one and prints the
counts of docs/reliability.md.
"""

import contextlib
import importlib
import io
import json
import random
import resource
import shutil
import signal
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from mutations import mutated_bytes, mutated_netcdf, mutated_npz, mutated_settings

import flypend as fp
from flypend.cli import app as cli
from flypend.files.toml import toml_text
from flypend.flight import simulate
from flypend.laws.learned import load as load_policy
from flypend.laws.learned import save as save_policy
from flypend.learning import training
from flypend.learning.course import Course
from flypend.learning.training import Learner, Training
from flypend.paper import experiment
from flypend.studies.sweep import run

LONGEST = 10.0  # s of processor time of any command: other tests run beside it
PATIENCE = 600.0  # s of wall time after which a command that hangs is ended, on however busy a machine
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


class AcceptedError(Exception):
    """The settings have passed every check, and the flight would begin."""


def accepted(*_args, **_more):
    raise AcceptedError


TUNED = STUDY | {
    "vary": {"start": STUDY["vary"]["start"]},
    "tune": {"runs": 4, "generations": 1, "gains": {"k_d": [0.3, 5.0]}},
}
# What is mutated, how often of eight, and the command that reads it.
COMMANDS = (
    *[(RUN, ["run", "f.toml", "--no-figures", "-o", "out"])] * 3,
    (STUDY, ["sweep", "f.toml", "-o", "s.zarr", "--force", "--workers", "1"]),
    (TUNED, ["tune", "f.toml"]),
    (RUN["vehicle"], ["check", "f.toml"]),
    (RUN["vehicle"], ["export-c", "--vehicle", "f.toml", "-o", "out"]),
    (RUN["vehicle"], ["plan", "--vehicle", "f.toml", "-o", "plan.nc"]),
)
# Where the work of the last four begins: it is left out.
WORK = (
    "flypend.studies.tune.program_digest", "flypend.studies.check.fly_tasks", "flypend.export.write.interface",
    "flypend.planning.planner.prepare",
)  # fmt: skip


def attack_settings(number, seed, folder, monkeypatch, flown):
    """Ends of `number` commands on mutated settings. Of runs and sweeps that are accepted one in `flown` flies."""
    monkeypatch.chdir(folder)
    monkeypatch.setenv("FLYPEND_CACHE", str(folder / "cache"))
    rng, ends = random.Random(seed), Counter()
    fly, fly_range = simulate.fly, run.fly_range
    for place in WORK:
        module, _, name = place.rpartition(".")
        monkeypatch.setattr(importlib.import_module(module), name, accepted)
    for k in range(number):
        really = rng.randrange(flown) == 0
        monkeypatch.setattr(simulate, "fly", fly if really else accepted)
        monkeypatch.setattr(run, "fly_range", fly_range if really else accepted)
        settings, arguments = COMMANDS[k % len(COMMANDS)]
        text = mutated_settings(settings, rng)
        (folder / "f.toml").write_text(text, encoding="utf-8")
        try:
            ends[arguments[0], check(arguments, text)] += 1
        except AcceptedError:
            ends[arguments[0], "accepted"] += 1
    return ends


def test_mutated_settings_end_in_a_code_and_one_line(tmp_path, monkeypatch):
    ends = attack_settings(240, 1, tmp_path, monkeypatch, 20)
    for command in {arguments[0] for _, arguments in COMMANDS}:
        assert ends[command, "accepted"] > 0, ends  # not all are refused at the door
        assert ends[command, 2] > 10, ends


@pytest.mark.slow
def test_3000_mutated_settings(tmp_path, monkeypatch):
    ends = attack_settings(3000, 2, tmp_path, monkeypatch, 50)
    print("3,000 mutated settings:", *(f"{name}, {end}: {count}" for (name, end), count in ends.items()), sep="\n  ")


# Files of results -----------------------------------------------------------------------------------------------------
# Runs, plans, policies and checkpoints: in front of their digests (bytes), and behind them (a value, a shape, a name,
# and the digest computed again, or left out).

ROOM = 2**29  # bytes that reading a file of some kilobytes may take beyond what the process has


@contextlib.contextmanager
def little_memory():
    """Let this process take `ROOM` bytes more than it has."""
    before = resource.getrlimit(resource.RLIMIT_AS)
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + ROOM, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


def save_checkpoint(path):
    learner = Learner(little(fp.vehicle("hehn2011")))
    learner.done = learner.adam.count = learner.training.updates
    learner.save(path)


def little(vehicle, seed=0, updates=None, bands=False, sensors=None):
    """A training of seconds."""
    course = Course(vehicle, duration=0.3, bands=bands, sensors=sensors)
    return Training(course, seed=seed, rounds=1, steps=1, updates=updates or 1, batch=16, hidden=(8, 8))


def resumed(path):
    learner = Learner(little(fp.vehicle("hehn2011")))
    assert learner.resume(path)
    return learner


def is_run(run):
    """Whether a loaded run is what its docstring says, by other means than the schema's."""
    n, k = len(run.t), len(run.vehicle.rotor_spins)
    shapes = {
        "x": (3,),
        "x_dot": (3,),
        "R": (3, 3),
        "omega": (3,),
        "y": (3,),
        "y_dot": (3,),
        "moment": (3,),
        "x_ref": (3,),
    }
    assert all(getattr(run, name).shape == (n, *shape) for name, shape in shapes.items())
    assert (run.thrust.shape, run.rotor_forces.shape, run.drift.shape[1:]) == ((n,), (n, k), (3,))
    assert all(signal.shape == (n,) for signal in run.signals.values())
    assert np.isfinite(run.packed).all()
    assert n > 0
    assert run.t[0] >= 0
    assert (run.t[1:] > run.t[:-1]).all()
    # State accepts numbers that are rounded to four decimals.
    np.testing.assert_allclose(run.R @ run.R.transpose(0, 2, 1), np.tile(np.eye(3), (n, 1, 1)), atol=1e-3)
    assert (np.linalg.det(run.R) > 0).all()
    np.testing.assert_allclose((run.y**2).sum(axis=1), 1, atol=1e-3)
    assert (np.abs((run.y * run.y_dot).sum(axis=1)) <= 2e-4 * (1 + np.abs(run.y_dot).sum(axis=1))).all()
    assert isinstance(run.law, str)
    assert isinstance(run.outcome.reason, str)
    assert 0 <= run.outcome.time < np.inf
    assert run.vehicle == fp.Vehicle.from_dict(run.vehicle.to_dict())
    json.dumps(dict(run.gains), allow_nan=False)


def is_plan(plan):
    is_run(plan.trajectory)
    assert plan.commands.shape[1:] == (len(plan.vehicle.rotor_spins),)
    assert (len(plan.t) - 1) % len(plan.commands) == 0
    assert plan.duration == pytest.approx(plan.stage * len(plan.commands))
    assert plan.status in ("converged", "feasible", "failed")
    assert np.isfinite([*plan.commands.ravel(), *plan.target, *plan.objective.values(), plan.solve_time]).all()


def is_policy(found):
    assert all(np.isfinite(array).all() for array in found.arrays.values())
    assert found.D.shape == (len(found.W_3), 18)


def is_learner(learner):
    assert 0 <= learner.done <= learner.training.updates
    is_policy(learner.policy)
    assert all(np.isfinite(array).all() for array in learner.adam.moments.values())


class Kind(NamedTuple):
    """A kind of file: how one is made and mutated, read as what, and the commands that read it."""

    suffix: str
    make: Any
    mutated: Any
    load: Any
    check: Any
    commands: Any


def make_run(path):
    case = experiment("1")
    fp.simulate(case.vehicle, case.law(), case.start, 0.1, plant="ideal").save(path)


def make_sampled(path):
    fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0, 0, 1.0)), 0.05).save(path)


def make_plan(path):
    window = fp.Window((-0.4, 0.1, 0.2), 0.9, 1.4)
    start = fp.State(x=(-1.0, 0.0, 0.0), y=(0, 0, 1))
    fp.plan(fp.vehicle("hehn2011"), start, "effort", window=window, target=(0.5, 0, 0), time_limit=120.0).save(path)


def make_policy(path):
    save_policy(Learner(little(fp.vehicle("hehn2011"))).policy, path)


VIEWS = (
    ["replay", "{}", "-o", "out/page.html"],
    ["figures", "{}", "-o", "out/figures"],
    ["movie", "{}", "-o", "out/movie.gif", "--fps", "5", "--speed", "1", "--size", "160", "160"],
)
RUN_POLICY = (["run", "fly.toml", "--set", "law.gains.policy={}", "--no-figures", "-o", "out/run"],)
LEARN = (["learn", "--out", "{}", "--runs", "1"],)
KINDS = {
    "run": Kind(".nc", make_run, mutated_netcdf, fp.load, is_run, VIEWS),
    "sampled run": Kind(".nc", make_sampled, mutated_netcdf, fp.load, is_run, VIEWS),
    "plan": Kind(".nc", make_plan, mutated_netcdf, fp.load_plan, is_plan, VIEWS),
    "policy": Kind(".npz", make_policy, mutated_npz, load_policy, is_policy, RUN_POLICY),
    "checkpoint": Kind(".npz", save_checkpoint, mutated_npz, resumed, is_learner, LEARN),
}  # fmt: skip


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """A sound file of each kind, as bytes."""
    folder, found = tmp_path_factory.mktemp("sound"), {}
    for name, kind in KINDS.items():
        kind.make(folder / f"sound{kind.suffix}")
        found[name] = (folder / f"sound{kind.suffix}").read_bytes()
    return found


def attack_files(number, seed, sound, folder, monkeypatch, commands):
    """Load `number` mutated files: each is what its kind says, or refused in one line; one in `commands` is used."""
    monkeypatch.chdir(folder)
    monkeypatch.setattr(training, "usual", little)
    (folder / "fly.toml").write_text(toml_text(RUN | {"law": {"name": "learned"}}), encoding="utf-8")
    rng, ends = random.Random(seed), Counter()
    for k in range(number):
        name = list(KINDS)[k % len(KINDS)]
        kind, behind, what = KINDS[name], rng.random() < 0.6, f"file {k} of seed {seed}, a {name}"
        with np.errstate(all="ignore"):
            content = (
                kind.mutated(sound[name], rng, folder) if behind else mutated_bytes(sound[name], rng, sound["plan"])
            )
        path = folder / f"file{kind.suffix}"
        path.write_bytes(content)
        begin, where = time.process_time(), "behind" if behind else "in front"
        try:
            with little_memory():
                found = kind.load(path)
        except fp.InputError as error:
            ends[name, where, "in lines" if "\n" in str(error) else "refused"] += 1
        except BaseException as error:
            raise AssertionError(f"{error!r} on {what}") from error
        else:
            kind.check(found)
            ends[name, where, "loaded"] += 1
        assert time.process_time() - begin < LONGEST, what
        if rng.randrange(commands) == 0:
            use(kind, path, folder, what, rng)
    return ends


def use(kind, path, folder, what, rng):
    """Call a command on a file: what it refuses leaves nothing behind."""
    out = folder / "out"
    out.mkdir()
    if kind.load is resumed:
        (out / "learn").mkdir()
        shutil.copy(path, out / "learn" / "checkpoint.npz")
        path = out / "learn"
    before = set(out.rglob("*"))
    command = [word.format(path) if "{}" in word else word for word in rng.choice(kind.commands)]
    if check(command, what) == 2:
        assert set(out.rglob("*")) == before, what
    shutil.rmtree(out)


def test_mutated_files_are_what_they_say_or_refused(sound, tmp_path, monkeypatch):
    ends = attack_files(400, 1, sound, tmp_path, monkeypatch, 40)
    for name in KINDS:
        assert ends[name, "behind", "refused"] > 10, ends
        assert ends[name, "in front", "refused"] > 5, ends
    assert sum(count for (_, _, end), count in ends.items() if end == "loaded") > 20, ends
    assert {end for _, _, end in ends} == {"loaded", "refused"}


@pytest.mark.slow
def test_5000_mutated_files(sound, tmp_path, monkeypatch):
    ends = attack_files(5000, 2, sound, tmp_path, monkeypatch, 25)
    print("5,000 mutated files:", *(f"{' '.join(key)}: {count}" for key, count in sorted(ends.items())), sep="\n  ")
