"""A plan in C gives the commands that its tracking gives in Python."""

import ctypes

import numpy as np
import pytest
from cbuild import build

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.planning.feedback import deviation, hover_deviation, regulator
from flypend.plants.equations import rotor_step
from flypend.plants.lag import step_timing

HEHN = fp.vehicle("hehn2011")
KINDS = {"double": ctypes.c_double, "float": ctypes.c_float}


@pytest.fixture(scope="module")
def plan():
    return fp.plan(HEHN, fp.random_starts(3, seed=2026)[1], time_limit=120.0)


def compiled(plan, folder, precision):
    fp.export_plan(plan, folder, precision=precision)
    # A table does not convert: no literal is rounded twice.
    build(folder, ["flypend_plan.c"], "plan.so", flags=("-shared", "-fPIC"))
    command, kind = ctypes.CDLL(str(folder / "plan.so")).flypend_plan_command, KINDS[precision]

    def call(t, state):
        given = [(kind * len(part))(*part) for part in (state[:24], state[24:])]
        wanted = (kind * 4)(*[7.0] * 4)
        status = command(kind(t), *given, wanted)
        return status, np.array(wanted)

    return call


def in_python(plan):
    feedback = regulator(plan)
    step, off, at_hover = as_numpy(rotor_step(HEHN, windy=False)), as_numpy(deviation(4)), as_numpy(hover_deviation(4))

    def call(t, state):
        k = min(int(t / plan.stage), len(plan.commands))
        nominal, into = feedback.states[k], t - k * plan.stage
        if k < len(plan.commands):
            timing = step_timing(HEHN.rotor_lag, into)
            nominal = np.concatenate(step(nominal[:24], nominal[24:], feedback.commands[k], np.zeros(6), timing))
        gap = (off if k < len(plan.commands) else at_hover)(nominal, state)
        return np.clip(feedback.commands[k] - feedback.gains[k] @ gap, *HEHN.rotor_limits), nominal

    return call


@pytest.mark.parametrize(("precision", "tolerance"), [("double", 1e-9), ("float", 2e-3)])
def test_c_commands_what_python_commands(plan, tmp_path, precision, tolerance):
    """Of floats, gains of up to 100 N per unit amplify the rounding of states of up to 10 units, 1e-6."""
    in_c, expected, rng = compiled(plan, tmp_path / "c", precision), in_python(plan), np.random.default_rng(3)
    free = 0
    for t in np.append(rng.uniform(0, plan.duration, 60), plan.duration + np.array([0.01, 0.5, 20.0])):
        _, nominal = expected(t, np.append(plan.packed[0], plan.rotor_forces[0]))
        state = nominal + 1e-2 * rng.normal(size=28) * np.repeat([1, 0], [24, 4])
        wanted, _ = expected(t, state)
        status, found = in_c(t, state)
        assert status == 0
        np.testing.assert_allclose(found, wanted, atol=tolerance)
        free += np.any((wanted > HEHN.rotor_limits[0]) & (wanted < HEHN.rotor_limits[1]))
    assert free > 40  # most commands are not just limits


def test_far_from_the_plan_another_law_is_asked_for(plan, tmp_path):
    in_c = compiled(plan, tmp_path / "c", "double")
    state = np.append(plan.packed[0], plan.rotor_forces[0])
    assert in_c(0.0, state)[0] == 0
    for place, value in ((0, 5.0), (0, np.nan), (3, np.nan), (17, np.inf), (27, np.nan)):
        off = state.copy()
        off[place] = value
        assert in_c(0.0, off)[0] == 1
    turned = state.copy()
    turned[18:21] = -turned[18:21] + 0.3
    assert in_c(0.0, turned)[0] == 1


def test_a_failed_plan_is_not_exported(tmp_path):
    failed = fp.plan(HEHN, fp.State(y=(0, 0, -1)), duration=0.3)
    with pytest.raises(fp.InputError, match="plan: expected a plan that can be flown"):
        fp.export_plan(failed, tmp_path / "c")
    assert not (tmp_path / "c").exists()


@pytest.mark.parametrize("precision", ["double", "float"])
def test_it_keeps_what_its_header_promises(plan, tmp_path, precision):
    """Every input that is not finite is refused; whatever is not, commands within limits; a refusal writes nothing."""
    in_c, (low, high) = compiled(plan, tmp_path / "c", precision), HEHN.rotor_limits
    largest = float(np.finfo(KINDS[precision]).max)
    start = np.append(plan.packed[0], plan.rotor_forces[0])
    hover = np.append(fp.State(y=(0, 0, 1)).packed(), np.full(4, HEHN.weight / 4))
    untouched = np.full(4, 7.0)
    for t in (np.nan, np.inf, -np.inf):
        status, command = in_c(t, start)
        assert status == 1
        np.testing.assert_array_equal(command, untouched)
    at_start = in_c(0.0, start)
    assert at_start[0] == 0
    for t in (-0.0, -1e-3, -1e30, -largest):
        np.testing.assert_array_equal(in_c(t, start)[1], at_start[1])
    for t in (plan.duration, 1e6, 1e30, largest):
        status, command = in_c(t, hover)
        assert status == 0
        assert np.all((command >= low - 1e-6) & (command <= high + 1e-6))
    for place in range(28):
        for value in (np.nan, np.inf, -np.inf, largest, -largest, 1e30):
            for t, good in ((0.0, start), (0.37 * plan.duration, start), (plan.duration + 1, hover)):
                state = good.copy()
                state[place] = value
                status, command = in_c(t, state)
                if status == 0:
                    assert np.isfinite(value)
                    assert np.all((command >= low - 1e-6) & (command <= high + 1e-6))
                else:
                    assert status == 1
                    np.testing.assert_array_equal(command, untouched)
    rng = np.random.default_rng(5)
    for _ in range(3000):  # several at once, so that infinities of both signs meet
        state = start + rng.choice([0, 1, 1e10, 1e30, largest], 28) * rng.choice([-1, 0, 0, 1], 28)
        status, command = in_c(rng.uniform(-1, plan.duration + 1), state)
        good = np.all((command >= low - 1e-6) & (command <= high + 1e-6))
        assert good if status == 0 else np.array_equal(command, untouched)
