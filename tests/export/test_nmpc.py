"""A plan that is improved in flight by C code: its iterations are those of Python, and it flies."""

import ctypes
import re
from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest
from cbuild import build, run

import flypend as fp
from flypend.cli import app as cli
from flypend.export.plan import COARSER, PHASES, sizes, table_of
from flypend.planning.dynamics import Units
from flypend.planning.feedback import Feedback, Follower, regulator, step_program
from flypend.planning.planner import coarsen
from flypend.planning.real_time import SUBSTEPS, RealTime

HEHN = fp.vehicle("hehn2011")
KINDS = {"double": (ctypes.c_double, np.float64), "float": (ctypes.c_float, np.float32)}
OWN = Units.of(HEHN).states(4)
STILL = np.zeros(6)


@pytest.fixture(scope="module")
def plan():
    return fp.plan(HEHN, fp.State(y=(0, 0, -1)))


@pytest.fixture(scope="module")
def coarse(plan):
    return coarsen(plan, COARSER)


CALLS = """
int main(void)
{
    static flypend_nmpc nmpc;
    flypend_real numbers[24] = {0};
    flypend_nmpc_begin(&nmpc, &flypend_nmpc_exported);
    return flypend_plan_command(0, numbers, numbers, numbers);
}
"""


class InC:
    """The exported code, begun with its plan."""

    def __init__(self, folder, precision):
        self.real, self.kind = KINDS[precision]
        self.code = ctypes.CDLL(str(folder / "nmpc.so"))
        stages = int(re.search(r"NMPC_ALL = (\d+)", (folder / "flypend_nmpc.h").read_text())[1])
        self.memory = np.zeros(60_000, self.kind)
        exported = ctypes.c_char.in_dll(self.code, "flypend_nmpc_exported")
        self.code.flypend_nmpc_begin(place(self.memory), ctypes.byref(exported))
        self.states = self.memory[: 28 * (stages + 1)].reshape(-1, 28)
        self.commands = self.memory[self.states.size : self.states.size + 4 * (stages + 1)].reshape(-1, 4)

    def improve(self, t, state):
        return self._call(self.code.flypend_nmpc_improve, t, state)

    def command(self, t, state):
        found = np.full(4, 7.0, self.kind)
        return self._call(self.code.flypend_nmpc_command, t, state, found), found.astype(float)

    def _call(self, function, t, state, *outputs):
        given = [np.array(part, self.kind) for part in (state[:24], state[24:])]
        return function(place(self.memory), self.real(t), *map(place, (*given, *outputs)))


def place(array):
    return ctypes.c_void_p(array.ctypes.data)


@pytest.fixture(scope="module", params=["double", "float"])
def exported(request, plan, tmp_path_factory):
    """Folder and precision of the compiled code, of which no compiler complains."""
    folder = tmp_path_factory.mktemp(request.param) / "c"
    fp.export_nmpc(plan, folder, precision=request.param)
    build(folder, ["flypend_nmpc.c"], "nmpc.so", flags=("-shared", "-fPIC"))
    return folder, request.param


class InPython:
    """The same of `planning`, stage by stage: an iteration is due at the beginning of the next."""

    def __init__(self, plan, asked):
        feedback, (least, tail) = regulator(plan), sizes(len(plan.commands))
        longer = [
            np.concatenate([each, np.repeat(each[-1:], tail, axis=0)])
            for each in (feedback.states, feedback.commands, feedback.gains)
        ]
        self.feedback, self.stage, self.been = Feedback(plan.stage, *longer), plan.stage, 0.0
        self.follower, self.step = Follower(self.feedback, HEHN), step_program(HEHN)
        own = longer[0] / OWN, longer[1][:-1] / OWN[24:]
        self.realtime = RealTime(asked, *own, plan.stage / Units.of(HEHN).time, len(plan.commands), least)

    def improve(self, t, state, first):
        here, h = state, (first * self.stage - t) / SUBSTEPS
        self.been = max(self.been, np.linalg.norm(state[:3] / OWN[:3]))
        for i in range(SUBSTEPS):
            command, _ = self.follower.command(t + i * h, here[:24], here[24:])
            here = self.step(here[:24], here[24:], command, h)
        good = self.realtime.improve(first, here / OWN, self.been, STILL)
        if good:
            last = first + self.realtime.horizon(first)
            self.feedback.states[first : last + 1] = self.realtime.states[first : last + 1] * OWN
            self.feedback.commands[first:last] = self.realtime.commands[first:last] * OWN[24:]
        return good


def test_iterations_are_those_of_python(coarse, exported):
    """In a closed loop with pushes.

    Python rounds the durations of its steps to 1e-9 s, and C has a series for the exponential. Such differences grow as
    an open loop does, from iteration to iteration.
    """
    in_c, in_python = InC(*exported), InPython(*coarse)
    stage, rng = coarse[0].stage, np.random.default_rng(1)
    state, t = in_python.feedback.states[0].copy(), 0.0
    stages, tolerance = {"double": (16, 1e-6), "float": (8, 1e-2)}[exported[1]]
    begun = in_c.states.copy()
    for k in range(1, stages):
        for _ in range(PHASES):
            command, _ = in_python.follower.command(t, state[:24], state[24:])
            status, found = in_c.command(t, state)
            assert status == 0
            np.testing.assert_allclose(found, command, atol=10 * tolerance)
            if t > (k - 1 / PHASES) * stage - 1e-6:
                assert (in_c.improve(t, state) == 0) == in_python.improve(t, state, k)
            state = in_python.step(state[:24], state[24:], command, stage / PHASES)
            t += stage / PHASES
        state[3:6] += 0.05 * rng.normal(size=3)
        np.testing.assert_allclose(in_c.states, in_python.realtime.states[: len(in_c.states)], atol=tolerance)
        np.testing.assert_allclose(in_c.commands[:-1], in_python.realtime.commands, atol=tolerance)
    assert np.max(np.abs(in_c.states - begun)) > 100 * tolerance


@pytest.mark.parametrize("phase", range(PHASES))
def test_an_iteration_may_begin_within_a_stage(coarse, exported, phase):
    """A full step leaves no gap: each state follows from the one before, the first after the rest of its stage."""
    in_c, stage, step, first = InC(*exported), coarse[0].stage, step_program(HEHN), 4
    states, t = table_of(coarse[0])[0] * OWN, (first + (phase - 1) / PHASES) * stage + 1e-5
    k = int(t / stage)
    state = step(states[k, :24], states[k, 24:], coarse[0].commands[k], t - k * stage)
    assert in_c.improve(t, state) == 0
    rest = stage * (1 - phase / PHASES)
    for k, h in ((first, rest), (first + 1, stage), (first + 2, stage)):
        here = in_c.states[k].astype(float) * OWN
        led = step(here[:24], here[24:], in_c.commands[k].astype(float) * OWN[24:], h)
        np.testing.assert_allclose(in_c.states[k + 1] * OWN, led, atol={"double": 1e-7, "float": 1e-5}[exported[1]])
    # Where it was predicted to be, the flight takes the command as planned.
    status, command = in_c.command(first * stage + phase * stage / PHASES, in_c.states[first] * OWN)
    assert status == 0
    np.testing.assert_allclose(
        command, in_c.commands[first] * OWN[24:], atol={"double": 1e-5, "float": 1e-3}[exported[1]]
    )


def flown(in_c, plan, *, improving):
    """Excursion, and distance from hover when the plan ends, of a flight that is struck in mid-throw."""
    state, step, farthest, i = np.append(plan.packed[0], plan.rotor_forces[0]), step_program(HEHN), 0.0, 0
    while (found := in_c.command(0.002 * i, state))[0] == 0:
        if improving and i % 10 == 0:
            in_c.improve(0.002 * i, state)
        state = step(state[:24], state[24:], found[1], 0.002)
        state[3] += 0.8 * (i == 300)
        farthest, i = max(farthest, np.linalg.norm(state[:3])), i + 1
    assert found[0] == 2
    assert 0.002 * i == pytest.approx(plan.duration, abs=0.003)
    return farthest, np.linalg.norm(state[:3]) + np.linalg.norm(state[18:21] - [0, 0, 1])


def test_it_flies_and_iterations_make_up_for_a_blow(plan, exported):
    with_iterations, end = flown(InC(*exported), plan, improving=True)
    without, _ = flown(InC(*exported), plan, improving=False)
    assert end < 0.1
    assert with_iterations < 0.5 * without


def test_it_keeps_what_its_header_promises(plan, exported):
    """What is not finite is refused, commands are within limits, and sqrt is all that it needs."""
    folder, precision = exported
    in_c, (low, high) = InC(folder, precision), HEHN.rotor_limits
    start = np.append(plan.packed[0], plan.rotor_forces[0])
    for t in (np.nan, np.inf, -np.inf):
        assert in_c.improve(t, start) == 2
        status, command = in_c.command(t, start)
        assert status == 1
        np.testing.assert_array_equal(command, 7.0)
    for at in range(28):
        for value in (np.nan, np.inf, -np.inf, 1e30, -1e30):
            state = start.copy()
            state[at] = value
            status, command = in_c.command(0.0, state)
            assert status == 1 or (np.isfinite(value) and np.all((command >= low - 1e-6) & (command <= high + 1e-6)))
            assert in_c.improve(0.0, state) == 2 or np.isfinite(value)
    turned = start.copy()
    turned[18:21] = -turned[18:21] + 0.3
    assert in_c.command(0.0, turned)[0] == 1
    waiting = InC(folder, precision)
    assert waiting.improve(-1.0, start) == 2  # in the second before the plan, the vehicle would fall away from it
    assert waiting.improve(0.0, start) == 0
    needed = set(re.findall(r" U (\w+)", run(["nm", "-D", "-u", "nmpc.so"], folder)))
    assert needed <= {"sqrt", "sqrtf", "__stack_chk_fail"}


def test_what_it_cannot_fly_is_refused(plan, tmp_path):
    failed, on_hub = replace(plan, status="failed", reason="late"), replace(plan, vehicle=HEHN.replace(mount="hub"))
    for other, what in ((failed, "can be flown, got late"), (on_hub, "on a gimbal")):
        with pytest.raises(fp.InputError, match=f"plan: .*{what}"):
            fp.export_nmpc(other, tmp_path / "c")
    assert not (tmp_path / "c").exists()


def test_the_command_writes_it_beside_the_law(tmp_path):
    out = tmp_path / "c"
    words = ["export-c", "--law", "nmpc", "--precision", "float", "--no-check", "--out", str(out)]
    cli.app(words, standalone_mode=False)
    assert "typedef float flypend_real" in (out / "flypend_law.h").read_text()
    assert (out / "flypend_nmpc.c").exists()


def test_the_command_writes_all_or_nothing(tmp_path, monkeypatch, plan):
    monkeypatch.setattr(fp, "plan", lambda *_: plan)
    (tmp_path / "README.md").write_text("mine")
    for name, more, what in (("taken", [], "a folder that an export wrote"), ("new", ["--rate", "3"], "rate")):
        out = tmp_path if name == "taken" else tmp_path / name
        with pytest.raises(fp.InputError, match=what):
            cli.app(["export-c", "--law", "nmpc", "--no-check", "--out", str(out), *more], standalone_mode=False)
    assert [path.name for path in tmp_path.iterdir()] == ["README.md"]


def test_the_command_removes_the_sensors_of_an_earlier_export(tmp_path):
    for more in (["--sensors", "mocap"], []):
        words = ["export-c", "--law", "corrected", "--no-check", "--out", str(tmp_path), *more]
        cli.app(words, standalone_mode=False)
        assert (tmp_path / "flypend_sensors.c").exists() == bool(more)


def test_headers_of_one_precision_stand_beside_each_other_in_c_and_cpp(plan, tmp_path):
    for precision in ("double", "float"):
        fp.export_c(fp.laws.inverted(), HEHN, tmp_path / precision, precision=precision, check=False)
        fp.export_plan(plan, tmp_path / precision, precision=precision)
        fp.export_nmpc(plan, tmp_path / precision, precision=precision)
    code = tmp_path / "code.c"
    for names in permutations(("law", "plan", "nmpc")):
        code.write_text("".join(f'#include "float/flypend_{name}.h"\n' for name in names) + CALLS)
        build(tmp_path, ["-c", code], "code.o")
        code.write_text(code.read_text().replace("float", "double", 1))
        assert "different precisions" in run(["gcc", "-w", "-c", code], check=False).stderr
    code.write_text("".join(f'#include "double/flypend_{name}.h"\n' for name in names) + CALLS)
    objects = [build(tmp_path, ["-c", tmp_path / f"double/flypend_{name}.c"], f"{name}.o") for name in names]
    build(tmp_path, ["-x", "c++", code, "-x", "none", *objects], "both", compiler="g++")
