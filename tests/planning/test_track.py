"""Flights along plans: the feedback is optimal where that can be checked, and plans are flown as planned."""

import numpy as np
import pytest

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.model.state import SIZE
from flypend.planning.dynamics import Stage, Units
from flypend.planning.feedback import deviation, regulator
from flypend.planning.tracking import Tracker
from flypend.plants.lag import step_timing

HEHN = fp.vehicle("hehn2011")
START = fp.random_starts(3, seed=2026)[1]


@pytest.fixture(scope="module")
def planned():
    return fp.plan(HEHN, START, time_limit=120.0)


@pytest.fixture(scope="module")
def flown(planned):
    return fp.simulate(HEHN, fp.track(planned), START, planned.duration + 1.5)


def test_a_tracked_plan_is_flown_as_planned(planned, flown):
    result = fp.metrics(flown)
    assert result.success
    assert result.excursion == pytest.approx(planned.excursion, abs=1e-3)
    # Finer steps than those of the plan differ by some 1e-5 a stage, which feedback keeps from growing; interpolation
    # between samples 5 ms apart errs by 20 m/s² (5 ms)²/8 = 6e-5 m.
    during = flown.t <= planned.duration
    along = np.column_stack([np.interp(flown.t, planned.t, column) for column in planned.x.T])
    np.testing.assert_allclose(flown.x[during], along[during], atol=1e-3)


def test_feedback_recovers_what_the_open_loop_loses(planned):
    """Masses ten per cent larger: with the gains it stands, without it falls."""
    plant = fp.Plant(mismatch={"mass": 1.1, "bob_mass": 1.1})
    assert fp.metrics(fp.simulate(HEHN, fp.track(planned), START, 6, plant=plant)).success
    deaf = fp.track(planned)
    feedback = regulator(planned)
    mute = type(feedback)(feedback.stage, feedback.states, feedback.commands, 0 * feedback.gains)
    blind = fp.Controller(
        name="blind", function=deaf.function, computer=deaf.computer,
        flight_computer=lambda loop, rotors: Tracker(mute, HEHN, fp.laws.lqr(), loop, rotors),
    )  # fmt: skip
    assert not fp.metrics(fp.simulate(HEHN, blind, START, 6, plant=plant)).success


def test_hover_gains_stabilise_hover(planned):
    """The closed loop of the nonlinear step about hover, by finite differences, has a spectral radius below 1."""
    feedback, units = regulator(planned), Units.of(HEHN)
    step, off = as_numpy(Stage(4).step()), as_numpy(deviation(4))
    hover, command, K = feedback.states[-1], feedback.commands[-1], feedback.gains[-1]
    timing = step_timing(HEHN.rotor_lag / units.time, feedback.stage / units.time)
    own = units.states(4)

    def after(state):
        given = command - K @ off(hover, state)
        return step(state / own, given / units.force, timing, units.numbers(HEHN)) * own

    np.testing.assert_allclose(after(hover), hover, atol=1e-12)
    state = hover.copy()
    state[:3] += 0.02
    state[SIZE:] *= 1.02
    first = np.linalg.norm(off(hover, state))
    for _ in range(250):  # 5 s
        state = after(state)
    assert np.linalg.norm(off(hover, state)) < 1e-3 * first


def test_a_vehicle_that_spins_hovers_as_it_spins():
    """nayak2018 cannot stop its spin in time; feedback that expects one heading loses it."""
    nayak, start = fp.vehicle("nayak2018"), fp.random_starts(6, 7701)[3]
    plan = fp.plan(nayak, start, time_limit=120.0)
    assert plan.omega[-1, 2] > 2
    run = fp.simulate(nayak, fp.track(plan), start, 8)
    assert fp.metrics(run).success
    assert fp.metrics(run).excursion < 1.05 * plan.excursion
    feedback = regulator(plan)

    def expecting(loop, rotors):
        tracker = Tracker(feedback, nayak, fp.laws.inverted(), loop, rotors)
        follower = tracker._follower
        follower._hovering = follower._deviation
        return tracker

    tracked = fp.track(plan)
    stubborn = fp.Controller(
        name="stubborn", function=tracked.function, computer=tracked.computer, flight_computer=expecting
    )
    assert fp.metrics(fp.simulate(nayak, stubborn, start, 8)).excursion > 1.3 * plan.excursion


def test_thrown_off_the_plan_the_other_law_takes_over(planned):
    """A start other than the plan's: the rod is on the other side."""
    other = fp.State(y=-START.y, R=START.R)
    run = fp.simulate(HEHN, fp.track(planned), other, 10)
    assert fp.metrics(run).success


def test_a_plan_is_not_flown_by_another_vehicle(planned):
    with pytest.raises(fp.InputError, match="vehicle"):
        fp.simulate(HEHN.replace(bob_mass=1.2 * HEHN.bob_mass), fp.track(planned), START, 1)


def test_latency_is_predicted_and_found(planned):
    """Behind 30 ms the plan is followed if they are told or found; neither told nor looked for, they lose it."""
    plant, deaf = fp.Plant(delay=0.03), fp.laws.inverted(delay_reach=0.0)
    laws = (fp.track(planned, latency=0.03), fp.track(planned), fp.track(planned, otherwise=deaf))
    told, untold, unsought = (fp.metrics(fp.simulate(HEHN, law, START, 6, plant=plant)) for law in laws)
    assert told.success
    assert untold.success
    assert max(told.excursion, untold.excursion) < 0.2 * unsought.excursion


@pytest.mark.parametrize("make", [lambda plan: fp.track(plan), lambda plan: fp.plan_and_track()], ids=["track", "plan"])
def test_it_is_flown_on_sensors_with_their_estimator(make, planned):
    run = fp.simulate(HEHN, make(planned), START, 6, plant=fp.Plant(sensors="mocap", seed=3))
    assert fp.metrics(run).success
    assert fp.metrics(run).excursion < 1.3 * planned.excursion


def test_what_cannot_be_tracked_is_refused(planned):
    failed = fp.plan(HEHN, START, duration=0.3)
    with pytest.raises(
        fp.InputError, match="plan: expected a plan that can be flown, got inverted hover is not reached"
    ):
        fp.track(failed)
    with pytest.raises(fp.InputError, match="wrench: a plan commands rotor forces"):
        fp.simulate(HEHN, fp.track(planned), START, 1, plant="hehn2011")
    with pytest.raises(fp.InputError, match="otherwise: expected a Law"):
        fp.track(planned, otherwise=3)
