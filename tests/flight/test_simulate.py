"""One run: accuracy, the manifold, how runs end, and what is refused."""

import dataclasses

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.flight.integrate import integrate
from flypend.flight.request import Tolerances
from flypend.laws import Control, Guard
from flypend.model.state import MAX_STATE
from flypend.paper import experiment

VEHICLE = fp.vehicle("hehn2011")
TUMBLING = fp.State(x_dot=(0.5, 0, 0), omega=(0.3, 2.0, 0.1), y=(0.6, 0, 0.8), y_dot=(0, 2.0, 0))


def law(control, **options):
    """A law of one function of (t, state)."""
    return fp.Law(name="test", e3="up", control=lambda t, state, vehicle, k: control(t, state), **options)


def push(t, state):
    """A smooth wrench, too weak to turn small errors into large ones within the seconds of these tests."""
    return fp.Wrench(0.3 + 0.2 * ca.sin(3 * t), 1e-3 * ca.vertcat(ca.cos(t), ca.sin(2 * t), -state.omega[0]))


def rest(t, state):
    return fp.Wrench(ca.SX(0), ca.SX.zeros(3))


# Accuracy --------------------------------------------------------------------------------------------------------


def test_the_error_falls_with_the_tolerance_and_steps_grow_as_for_order_eight():
    runs = {
        rtol: fp.simulate(VEHICLE, law(push), TUMBLING, 4.0, rtol=rtol, plant="ideal")
        for rtol in (1e-5, 1e-7, 1e-9, 1e-13)
    }
    final = {rtol: run.states.packed()[-1] for rtol, run in runs.items()}
    error = {rtol: np.max(np.abs(final[rtol] - final[1e-13])) for rtol in (1e-5, 1e-7, 1e-9)}
    for rtol, size in error.items():
        assert size < 100 * rtol  # some fifty steps that commit rtol each
    # A hundredth of the tolerance: a hundredth of the error, within a factor ten.
    assert error[1e-7] < error[1e-5] / 10
    assert error[1e-9] < error[1e-7] / 10
    # The step of a method of order eight goes like rtol^(1/8): 1e-9 against 1e-13 is a factor 3.2.
    assert 2.2 < len(runs[1e-13].drift) / len(runs[1e-9].drift) < 4.5


def test_atol_alone_can_loosen_the_run():
    tight, loose = (
        fp.simulate(VEHICLE, law(push), TUMBLING, 2.0, rtol=1e-10, atol=atol, plant="ideal") for atol in (None, 1e-4)
    )
    assert len(loose.drift) < len(tight.drift) / 2
    assert 1e-9 < np.max(np.abs(loose.states.packed()[-1] - tight.states.packed()[-1])) < 1e-2


def test_a_law_may_depend_on_time():
    # τ = I (sin t, 0, 0) from rest: ω₁ = 1 − cos t, exactly, and thrust is what was asked for.
    inertia = ca.DM(VEHICLE.I)
    timed = law(lambda t, state: fp.Wrench(t**2, ca.mtimes(inertia, ca.vertcat(ca.sin(t), 0, 0))))
    run = fp.simulate(VEHICLE, timed, fp.State(y=(0, 0, 1)), 3.0, plant="ideal")
    np.testing.assert_allclose(run.omega[:, 0], 1 - np.cos(run.t), rtol=0, atol=1e-8)  # rtol 1e-9, some ten steps
    np.testing.assert_allclose(run.thrust, run.t**2, rtol=1e-14)


def test_a_run_repeats_bit_by_bit_and_leaves_its_start_alone():
    before = TUMBLING.packed()
    first, second = (fp.simulate(VEHICLE, law(push), TUMBLING, 1.0, plant="ideal") for _ in range(2))
    np.testing.assert_array_equal(first.states.packed(), second.states.packed())
    np.testing.assert_array_equal(TUMBLING.packed(), before)


# The manifold ----------------------------------------------------------------------------------------------------


def test_drift_is_recorded_per_step_and_of_the_order_of_the_tolerance():
    worst = []
    for rtol in (1e-6, 1e-9):
        run = fp.simulate(VEHICLE, law(push), TUMBLING, 3.0, rtol=rtol, plant="ideal")
        assert run.drift.shape[1] == 3
        assert np.all(run.drift >= 0)
        # The norm of a step's error is a mean over 24 entries: one entry may err by √24 rtol (1 + |ẏ|), |ẏ| up to 3.
        assert np.max(run.drift) < 20 * rtol
        worst.append(run.drift.max(axis=0))
        states = run.states
        assert np.max(geo.rotation_defect(states.R)) < 1e-14  # a few eps of the SVD
        assert np.max(np.abs(geo.norm(states.y) - 1)) < 1e-15
        assert np.max(np.abs(geo.dot(states.y, states.y_dot))) < 1e-14
    assert np.all(worst[0] > 1e-12)  # it is the drift before the projection, not after it
    assert np.all(worst[1] < worst[0] / 10)


# Samples ---------------------------------------------------------------------------------------------------------


def test_samples_come_every_hundredth_second_with_both_ends():
    run = fp.simulate(VEHICLE, law(rest), TUMBLING, 0.5, plant="ideal")
    np.testing.assert_allclose(run.t, np.arange(51) / 100, rtol=0, atol=1e-15)
    assert run.t[-1] == 0.5
    for name, shape in (("x", (3,)), ("R", (3, 3)), ("thrust", ()), ("moment", (3,))):
        assert getattr(run, name).shape == (51, *shape)
    short = fp.simulate(VEHICLE, law(rest), TUMBLING, 1e-3, plant="ideal")
    np.testing.assert_array_equal(short.t, [0, 1e-3])


def test_times_are_sampled_where_asked():
    times = [0.0, 0.1234, 0.5, 0.987]
    run = fp.simulate(VEHICLE, law(push), TUMBLING, 1.0, times=times, plant="ideal")
    np.testing.assert_array_equal(run.t, times)
    whole = fp.simulate(VEHICLE, law(push), TUMBLING, 1.0, plant="ideal")
    np.testing.assert_array_equal(run.states.packed(), whole.at(times).packed())  # the same steps: the same numbers
    assert len(fp.simulate(VEHICLE, law(push), TUMBLING, 1.0, times=[0.3], plant="ideal").t) == 1


def test_the_first_sample_is_the_start():
    run = fp.simulate(VEHICLE, law(push), TUMBLING, 0.1, plant="ideal")
    np.testing.assert_allclose(run.states.packed()[0], TUMBLING.packed(), rtol=0, atol=1e-15)


# How runs end ----------------------------------------------------------------------------------------------------


def test_a_law_that_destabilises_ends_as_diverged():
    # f = 50 ẋ₃ with the rod hanging along the thrust axis: v̇ = a v − g, so v = (1 − g/a) exp(a t) + g/a.
    a, g = 50 / (VEHICLE.M + VEHICLE.m), VEHICLE.g
    start = fp.State(x_dot=(0, 0, 1), y=(0, 0, -1))
    runaway = law(lambda t, state: fp.Wrench(50 * state.x_dot[2], ca.SX.zeros(3)))
    run = fp.simulate(VEHICLE, runaway, start, 5.0, rtol=1e-6, plant="ideal")
    assert run.outcome.status == "diverged"
    assert "left" in run.outcome.reason
    # It ends with the last step before MAX_STATE; a step lets v grow by at most some powers of e.
    assert run.outcome.time == pytest.approx(np.log(MAX_STATE / (1 - g / a)) / a, abs=5 / a)
    assert run.t[-1] == run.outcome.time
    assert np.max(np.abs(run.states.packed())) < MAX_STATE
    expected = (1 - g / a) * np.exp(a * run.t) + g / a
    np.testing.assert_allclose(run.x_dot[:, 2], expected, rtol=1e-4)  # 100 rtol
    assert str(run.outcome).startswith("diverged at 0.1")


@pytest.mark.parametrize(
    "broken",
    [
        lambda t: ca.sqrt(0.5 - t),  # not a number from then on
        lambda t: 1 / (0.5 - t),  # infinite in between
        lambda t: ca.if_else(t < 0.5, 1, np.nan),
    ],
)
def test_a_law_that_breaks_down_midway_ends_as_diverged_and_not_never(broken):
    run = fp.simulate(VEHICLE, law(lambda t, state: fp.Wrench(broken(t), ca.SX.zeros(3))), TUMBLING, 2.0, plant="ideal")
    assert run.outcome.status == "diverged"
    assert run.outcome.time == pytest.approx(0.5, abs=1e-3)
    assert "step" in run.outcome.reason
    assert len(run.drift) < 5000
    assert np.all(np.isfinite(run.states.packed()))
    assert run.t[-1] == run.outcome.time


def test_a_law_undefined_at_the_start_is_singular_at_once():
    undefined = law(lambda t, state: fp.Wrench(ca.SX(1), 1e-3 * state.omega / ca.norm_2(state.omega)))
    run = fp.simulate(VEHICLE, undefined, fp.State(y=(0, 0, 1)), 1.0, plant="ideal")
    assert (run.outcome.status, run.outcome.time) == ("singular", 0.0)
    assert "not defined at the start" in run.outcome.reason
    np.testing.assert_array_equal(run.t, [0.0])
    assert run.drift.shape == (0, 3)
    assert fp.simulate(VEHICLE, undefined, TUMBLING, 1.0, plant="ideal").outcome.status == "completed"


def guarded(signal, threshold):
    control = lambda t, state: Control(wrench=rest(t, state), signals={"level": signal(t, state)})  # noqa: E731
    return law(control, guard=Guard("level", threshold, "the level is low"))


def test_a_guard_ends_the_run_where_its_signal_crosses():
    # x₁ = 1 − t in free flight (the rod at rest): below 0.3 from 0.7 s on.
    start = fp.State(x=(1, 0, 0), x_dot=(-1, 0, 0), y=(0, 0, 1))
    run = fp.simulate(VEHICLE, guarded(lambda t, state: state.x[0], 0.3), start, 2.0, plant="ideal")
    assert run.outcome.status == "singular"
    assert run.outcome.reason == "the level is low"
    assert run.outcome.time == pytest.approx(0.7, abs=1e-11)  # the root is sought to 1e-12
    assert run.t[-1] == run.outcome.time
    assert run.signals["level"][-1] == pytest.approx(0.3, abs=1e-11)
    np.testing.assert_allclose(run.t[:-1], np.arange(70) / 100, rtol=0, atol=1e-15)
    never = fp.simulate(VEHICLE, guarded(lambda t, state: state.x[0], -1.5), start, 2.0, plant="ideal")
    assert never.outcome == fp.Outcome("completed", 2.0)


def test_the_time_of_the_singularity_converges_with_the_tolerance():
    case = experiment("2")
    ends = {}
    for rtol in (1e-5, 1e-7, 1e-9, 1e-12):
        run = fp.simulate(case.vehicle, case.law("printed"), case.start, 1.0, rtol=rtol, plant="ideal")
        assert run.outcome.status == "singular"
        ends[rtol] = run.outcome.time
    error = {rtol: abs(ends[rtol] - ends[1e-12]) for rtol in (1e-5, 1e-7, 1e-9)}
    for rtol, size in error.items():
        assert size < 100 * rtol  # as for the state
    assert error[1e-9] < error[1e-5] / 100


def test_a_guard_that_is_low_at_the_start_ends_the_run_there():
    start = fp.State(x=(0.2, 0, 0), x_dot=(1, 0, 0), y=(0, 0, 1))  # low at first, not any more after the first step
    run = fp.simulate(VEHICLE, guarded(lambda t, state: state.x[0], 0.2001), start, 2.0, plant="ideal")
    assert (run.outcome.status, run.outcome.time) == ("singular", 0.0)


def test_a_guard_of_an_unknown_signal_is_refused():
    wrong = dataclasses.replace(guarded(lambda t, state: state.x[0], 0.0), guard=Guard("levle", 0.0, ""))
    with pytest.raises(
        fp.InputError, match=r"^law\.guard.*: expected one of level, got 'levle' \(did you mean 'level'"
    ):
        fp.simulate(VEHICLE, wrong, TUMBLING, 1.0, plant="ideal")


def test_outcomes_print_in_a_line():
    assert str(fp.Outcome("completed", 6.5)) == "completed at 6.5 s"
    assert str(fp.Outcome("singular", 0.25, "0/0")) == "singular at 0.25 s: 0/0"


def test_the_integrator_stops_at_its_step_limit(monkeypatch):
    monkeypatch.setattr("flypend.flight.request.MAX_STEPS", 5)
    for engine in ("kernel", "scipy"):
        run = fp.simulate(VEHICLE, law(push), TUMBLING, 4.0, engine=engine, plant="ideal")
        assert run.outcome.status == "diverged"
        assert "steps were not enough" in run.outcome.reason
        assert len(run.drift) == 5
        assert run.t[-1] == run.outcome.time  # no sample lies past the last step
        assert 0 < run.outcome.time < 4.0


def test_integrate_by_itself_keeps_the_start():
    def rates(t, s):
        out = np.zeros(24)
        out[0:3] = s[3:6]
        return out

    start = TUMBLING.packed()
    solution = integrate(rates, start, 2.0, Tolerances(rtol=1e-8))
    assert solution.outcome.status == "completed"
    np.testing.assert_array_equal(solution(0.0)[0], start)
    np.testing.assert_allclose(solution([1.0])[0, 0], 0.5, rtol=0, atol=1e-14)
    assert solution.knots[0] == 0
    assert solution.knots[-1] == 2.0


# What is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("duration", [0, -1.0, np.nan, np.inf, "5", None])
def test_a_duration_that_is_not_positive_is_refused(duration):
    with pytest.raises(fp.InputError, match=r"^duration: expected a finite number > 0 s, got .*$"):
        fp.simulate(VEHICLE, law(rest), TUMBLING, duration, plant="ideal")


@pytest.mark.parametrize("name", ["rtol", "atol"])
@pytest.mark.parametrize("value", [0, -1e-9, np.nan, "tight"])
def test_a_tolerance_that_is_not_positive_is_refused(name, value):
    with pytest.raises(fp.InputError, match=rf"^{name}: expected a finite number > 0, got .*$"):
        fp.simulate(VEHICLE, law(rest), TUMBLING, 1.0, **{name: value}, plant="ideal")


def test_a_tolerance_below_roundoff_is_refused():
    with pytest.raises(fp.InputError, match=r"^rtol: expected at least 2\.2.*e-14.*, got 1e-16$"):
        fp.simulate(VEHICLE, law(rest), TUMBLING, 0.1, rtol=1e-16, plant="ideal")


def test_a_batch_of_starts_is_refused():
    batch = fp.State.random(np.random.default_rng(0), (3,))
    with pytest.raises(fp.InputError, match=r"^start: expected a single state, got a batch of shape \(3,\)$"):
        fp.simulate(VEHICLE, law(rest), batch, 1.0, plant="ideal")
    assert fp.simulate(VEHICLE, law(rest), batch[0], 0.1, plant="ideal").outcome.status == "completed"


@pytest.mark.parametrize(
    ("times", "line"),
    [
        ([0.5, 0.2], "increasing times"),
        ([0.2, 0.2], "increasing times"),
        ([], "increasing times"),
        ([[0.1, 0.2]], r"numbers of shape \(n\)"),
        ([-0.1, 0.2], "times inside 0 .. 1 s"),
        ([0.1, 1.1], "times inside 0 .. 1 s"),
        ([0.1, np.nan], "finite numbers"),
        (0.5, "shape"),
        ("noon", "numbers"),
    ],
)
def test_times_that_make_no_sense_are_refused(times, line):
    with pytest.raises(fp.InputError, match=rf"^times: expected .*{line}.*, got .*$"):
        fp.simulate(VEHICLE, law(rest), TUMBLING, 1.0, times=times, plant="ideal")


def test_the_wrong_kind_of_thing_is_refused():
    for arguments, line in (
        (("hehn2011", law(rest), TUMBLING), r"^vehicle: expected a Vehicle, .*, got 'hehn2011'$"),
        ((VEHICLE, fp.laws.corrected, TUMBLING), r"^law: expected a Law.*, got <function corrected"),
        ((VEHICLE, law(rest), TUMBLING.packed()), r"^start: expected a State, .*, got array"),
    ):
        with pytest.raises(fp.InputError, match=line) as caught:
            fp.simulate(*arguments, 1.0, plant="ideal")
        assert "\n" not in str(caught.value)


def test_a_sampled_run_that_ends_early_is_sampled_up_to_its_end():
    vehicle = fp.vehicle("hehn2011")
    law = fp.Law(
        name="breaks", e3="up", control=lambda t, s, v, k: fp.Wrench(v.weight / ca.sqrt(0.3 - t), -0.1 * s.omega)
    )
    for times in (None, [0.1, 0.5], [0.9]):
        kernel, steps = (
            fp.simulate(vehicle, law, fp.State(y=(0, 0, 1)), 1.0, times=times, engine=e) for e in ("kernel", "scipy")
        )
        assert kernel.outcome.status == "singular"
        assert kernel.t[-1] == pytest.approx(kernel.outcome.time, abs=1e-12)
        np.testing.assert_allclose(kernel.t, steps.t, rtol=0, atol=1e-12)
        np.testing.assert_allclose(kernel.packed, steps.packed, rtol=0, atol=1e-9)
