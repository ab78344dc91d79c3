"""Judging a flight: constructed flights with known answers, both sides of every threshold, and Wilson's interval."""

import dataclasses
import math

import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.flight.metrics import Count, Metrics, interval_over_clusters, metrics, wilson
from flypend.flight.outcome import Outcome
from flypend.model import equations_of_motion

VEHICLE = fp.vehicle("hehn2011")
SHARE = VEHICLE.weight / 4  # of one rotor in hover, N
E3 = np.array([0.0, 0.0, 1.0])
T = np.linspace(0.0, 3.0, 301)
# Of the box about the upright machine: from disc to disc, and above the pivot, m.
WIDE = 2 * (np.max(VEHICLE.rotor_positions[:, 0]) + VEHICLE.body.disc_radius)
TALL = VEHICLE.rod_length + VEHICLE.body.rod_radius


def about(axis, angle):
    """The rotation, or rotations, by `angle` about the unit vector `axis`: Rodrigues."""
    return np.eye(3) + np.sin(angle) * geo.hat(axis) + (1 - np.cos(angle)) * geo.hat(axis) @ geo.hat(axis)


def chord(distance):
    """The unit vector at `distance` from e₃, leaning along e₁."""
    angle = 2 * math.asin(distance / 2)
    return np.array([math.sin(angle), 0.0, math.cos(angle)])


def turned(distance):
    """The rotation whose z is at `distance` from e₃."""
    return about(np.array([0.0, 1.0, 0.0]), 2 * math.asin(distance / 2))


def flight(t=T, **given):
    """A flight that hovers upright at its reference, all rotors at their share of the weight, but for what is given."""
    n = len(t)
    values = {
        "x": np.zeros((n, 3)),
        "x_dot": np.zeros((n, 3)),
        "R": np.tile(np.eye(3), (n, 1, 1)),
        "omega": np.zeros((n, 3)),
        "y": np.tile(E3, (n, 1)),
        "y_dot": np.zeros((n, 3)),
        "thrust": np.full(n, VEHICLE.weight),
        "moment": np.zeros((n, 3)),
        "rotor_forces": np.full((n, 4), SHARE),
        "drift": np.zeros((0, 3)),
        "outcome": Outcome("completed", float(t[-1])),
        "e3": "up",
        "vehicle": VEHICLE,
        "law": "constructed",
        "gains": {},
    }
    return fp.Trajectory(t=t, **(values | given))


def where(mask, inside, outside):
    """`inside` at the times where `mask`, `outside` elsewhere."""
    return np.where(mask.reshape(-1, *(1,) * np.ndim(outside)), inside, outside)


# What a flight is told to be -------------------------------------------------------------------------------------


def test_a_flight_that_stands_from_the_start():
    assert metrics(flight()) == Metrics(
        success=True,
        settling=0.0,
        excursion=0.0,
        effort=pytest.approx(1),
        peak_force=SHARE,
        end=3.0,
        clearance=float("inf"),
        lowest=-VEHICLE.body.hub_radius,
        box_x=pytest.approx(WIDE),
        box_y=pytest.approx(WIDE),
        box_z=pytest.approx(VEHICLE.body.hub_radius + TALL),
        cause="",
    )


@pytest.mark.parametrize("e3", ["up", "down"])
def test_the_box_holds_the_machine_on_its_whole_way(e3):
    """It climbs 2 m, and goes 1 m along e₁ and 3 m along −e₂; the height is upward in either frame."""
    share = np.linspace(0, 1, len(T))[:, None]
    run = flight(x=share * np.array([1.0, -3.0, 2.0]), x_ref=share * np.array([1.0, -3.0, 2.0]))
    found = metrics(run if e3 == "up" else run.flipped())
    assert found.lowest == pytest.approx(-VEHICLE.body.hub_radius)
    sizes = (found.box_x, found.box_y, found.box_z)
    assert sizes == pytest.approx((1 + WIDE, 3 + WIDE, 2 + VEHICLE.body.hub_radius + TALL))


def test_an_ensemble_has_the_box_of_each_run():
    starts, law = fp.random_starts(6, 4), fp.laws.inverted()
    for plant in ("rotors", "mujoco"):
        found = fp.simulate_ensemble(VEHICLE, law, starts, 2.0, plant=plant)
        for i in range(len(found)):
            own = metrics(fp.simulate(VEHICLE, law, starts[i], 2.0, plant=plant))
            for name in ("lowest", "box_x", "box_y", "box_z"):
                assert getattr(found, name)[i] == pytest.approx(getattr(own, name), abs=1e-9)
    ideal = fp.simulate_ensemble(VEHICLE, law, starts, 2.0, plant="ideal")
    assert np.all(np.isnan(ideal.lowest))


LIMITS = {
    "rod": (0.05, lambda d: {"y": chord(d)}),
    "axis": (0.05, lambda d: {"R": turned(d)}),
    "position": (0.2, lambda d: {"x": np.array([0.6, 0.0, 0.8]) * d}),
}


@pytest.mark.parametrize("what", LIMITS)
@pytest.mark.parametrize("side", ["inside", "outside"])
def test_both_sides_of_each_tolerance(what, side):
    limit, build = LIMITS[what]
    changed = build(limit * (0.999 if side == "inside" else 1.001))
    run = flight()
    run = dataclasses.replace(
        run, **{name: np.broadcast_to(v, getattr(run, name).shape) for name, v in changed.items()}
    )
    judged = metrics(run)
    assert judged.success == (side == "inside")
    assert judged.cause == ("" if side == "inside" else what)
    assert (judged.settling == 0.0) if judged.success else math.isnan(judged.settling)


@pytest.mark.parametrize("what", LIMITS)
@pytest.mark.parametrize(("when", "success"), [(1.99, True), (2.0, False), (2.5, False), (3.0, False)])
def test_only_the_last_second_counts_and_all_of_it(what, when, success):
    limit, build = LIMITS[what]
    run, at = flight(), np.isclose(T, when)
    assert np.sum(at) == 1
    changed = {name: where(at, v, getattr(run, name)[0]) for name, v in build(1.5 * limit).items()}
    judged = metrics(dataclasses.replace(run, **changed))
    assert judged.success == success
    if success:
        assert judged.settling == pytest.approx(when + 0.01)


def test_settling_is_the_time_after_the_last_excursion_whatever_left():
    y = where((T > 0.2) & (T < 0.503), chord(0.3), E3)
    R = where((T > 0.7) & (T < 1.103), turned(0.3), np.eye(3))
    x = where((T > 1.5) & (T < 1.703), np.array([0.5, 0, 0]), np.zeros(3))
    assert metrics(flight(y=y)).settling == pytest.approx(0.51)
    assert metrics(flight(y=y, R=R)).settling == pytest.approx(1.11)
    assert metrics(flight(y=y, R=R, x=x)).settling == pytest.approx(1.71)


def test_a_rod_that_hangs_fails_for_the_rod_and_an_overturned_vehicle_for_its_axis():
    assert metrics(flight(y=np.tile(-E3, (301, 1)))).cause == "rod"
    assert metrics(flight(R=np.tile(about(np.array([1.0, 0, 0]), np.pi), (301, 1, 1)))).cause == "axis"


def test_the_cause_is_the_first_of_rod_axis_position_and_how_the_run_ended_comes_before():
    far, lean, tilt = np.full((301, 3), 5.0), np.tile(chord(0.5), (301, 1)), np.tile(turned(0.5), (301, 1, 1))
    assert metrics(flight(x=far)).cause == "position"
    assert metrics(flight(x=far, R=tilt)).cause == "axis"
    assert metrics(flight(x=far, R=tilt, y=lean)).cause == "rod"
    for status in ("diverged", "singular"):
        for run in (flight(outcome=Outcome(status, 3.0)), flight(x=far, y=lean, outcome=Outcome(status, 3.0))):
            judged = metrics(run)
            assert (judged.success, judged.cause) == (False, status)
            assert math.isnan(judged.settling)


def test_a_cause_before_the_last_second_is_none():
    y = where(T < 1.5, chord(0.5), E3)
    x = where(T > 2.5, np.array([0.5, 0, 0]), np.zeros(3))
    assert metrics(flight(y=y, x=x)).cause == "position"


def test_excursion_and_position_are_from_the_reference():
    reference = np.tile([3.0, -4.0, 12.0], (301, 1))
    x = reference + where(T < 0.3, np.array([0.0, 0.3, 0.4]), np.array([0.0, 0.0, 0.1]))
    judged = metrics(flight(x=x, x_ref=reference))
    assert judged.excursion == pytest.approx(0.5)
    assert judged.success
    away = metrics(flight(x_ref=reference))
    assert (away.cause, away.excursion) == ("position", pytest.approx(13.0))


def test_effort_is_the_root_mean_square_over_the_share_of_the_weight():
    forces = where(np.arange(301) < 100, np.array([3.0, 3.0, 3.0, 3.0]), np.array([0.0, 0.0, 2.0, 2.0])) * SHARE
    judged = metrics(flight(rotor_forces=forces))
    # 99 intervals, one across the step, and 200 more: the trapezoidal rule.
    assert judged.effort == pytest.approx(np.sqrt((99 * 9 + (9 + 2) / 2 + 200 * 2) / 300))
    assert judged.peak_force == pytest.approx(3 * SHARE)


def test_effort_is_a_mean_over_time_however_the_samples_are_spread():
    """Forces that grow like t: the mean of t² over 3 s is 3 s². The error is that of the trapezoidal rule, h²/12."""
    t = np.concatenate([np.linspace(0, 0.5, 501), np.linspace(0.5, 3.0, 51)[1:]])
    ramp = flight(t, rotor_forces=np.repeat(t[:, None], 4, axis=1) * SHARE)
    assert metrics(ramp).effort == pytest.approx(np.sqrt(3.0), rel=1e-3)
    # Negative control: the mean over these samples is another.
    assert np.sqrt(np.mean(t**2)) < 0.5 * np.sqrt(3.0)


def test_the_share_is_that_of_the_vehicle_that_flew():
    six = VEHICLE.replace(
        rotor_positions=[[np.cos(a), np.sin(a), 0] for a in np.arange(6) * np.pi / 3], rotor_spins=[1, -1] * 3
    )
    assert metrics(flight(vehicle=six, rotor_forces=np.full((301, 6), six.weight / 6))).effort == pytest.approx(1)


def test_the_end_is_that_of_the_outcome():
    assert metrics(flight(outcome=Outcome("diverged", 2.995))).end == 2.995


def test_a_run_of_one_sample_is_judged():
    judged = metrics(flight(t=np.zeros(1), outcome=Outcome("singular", 0.0)))
    assert (judged.success, judged.cause, judged.end) == (False, "singular", 0.0)


def test_a_run_of_two_samples_after_a_moving_reference_is_judged():
    x = np.array([[0.0, 0, 0], [0.01, 0, 0]])
    assert metrics(flight(t=np.array([0.0, 0.01]), x=x, x_ref=x)).success


def test_a_flight_shorter_than_a_second_counts_whole():
    t = np.linspace(0, 0.5, 51)
    assert metrics(flight(t)).success
    assert not metrics(flight(t, y=where(t < 0.005, chord(0.1), E3))).success


# The frame --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("stands", [True, False])
def test_the_frame_does_not_matter(stands):
    """A rod that settles while the vehicle climbs along a slanted line, in either frame."""
    rng = np.random.default_rng(4)
    lean = np.exp(-4 * T)[:, None] if stands else np.full((301, 1), 0.9)
    y = geo.unit(E3 + lean * [0.5, -0.3, -0.2])
    line = T[:, None] * [0.3, -0.4, 0.5]
    x = line + 0.5 * np.exp(-3 * T)[:, None] * [0.2, 0.5, -0.3]
    R = np.stack([about(np.array([0.6, 0.8, 0.0]), 0.4 * np.exp(-3 * t)) for t in T])
    run = flight(x=x, x_ref=line, y=y, R=R, rotor_forces=SHARE * rng.random((301, 4)))
    up, down = metrics(run), metrics(run.flipped())
    assert run.flipped().e3 == "down"
    assert up.success == stands
    for name, value in vars(up).items():
        other = getattr(down, name)
        if isinstance(value, float):
            assert other == pytest.approx(value, rel=1e-12, nan_ok=True), name
        else:
            assert other == value, name
    # Negative control: the same numbers, taken for those of the other frame, are another flight.
    assert not metrics(dataclasses.replace(run, e3="down")).success


# Moving references ------------------------------------------------------------------------------------------------

RADIUS, RATE = 1.0, 2.0  # m, rad/s: a vehicle that leans by 0.38 rad


def lean_on_the_circle(radius=RADIUS, rate=RATE):
    """Angles by which rod and thrust axis lean inwards on a circle flown exactly, and the radius of the bob.

    The bob is carried along the rod, so tan(rod) = rate² r/g with r = radius − l sin(rod). The rotors carry both, so
    tan(axis) = rate² (M radius + m r)/((M+m) g).
    """
    M, m, l, g = VEHICLE.M, VEHICLE.m, VEHICLE.l, VEHICLE.g
    rod = 0.0
    for _ in range(200):
        rod = math.atan(rate**2 * (radius - l * math.sin(rod)) / g)
    r = radius - l * math.sin(rod)
    return rod, math.atan(rate**2 * (M * radius + m * r) / ((M + m) * g)), r


def circling(rod, axis, radius=RADIUS, rate=RATE, t=T, circled=True):
    """A flight on the circle with rod and thrust axis leaning inwards by angles, and its reference, if it `circled`."""
    inwards = -np.stack([np.cos(rate * t), np.sin(rate * t), 0 * t], axis=-1)
    around = np.cross(E3, inwards)
    x, x_dot = -radius * inwards, -radius * rate * around
    y = np.sin(rod) * inwards + np.cos(rod) * E3
    R = np.stack([about(direction, axis) for direction in around])
    return flight(t, x=x, x_dot=x_dot, R=R, y=y, y_dot=np.sin(rod) * rate * around, x_ref=x if circled else 0 * x)


def test_the_lean_of_a_circle_is_what_the_equations_of_motion_ask_for():
    """The constructed flight is a motion of the model: ẍ = −rate² x and ÿ = −rate² (y across e₃) under |F| along z."""
    rod, axis, r = lean_on_the_circle()
    run = circling(rod, axis)
    carried = (VEHICLE.M * RADIUS + VEHICLE.m * r) * RATE**2  # N, inwards
    thrust = math.hypot(carried, VEHICLE.weight)
    rates = equations_of_motion(run.states, fp.Wrench(np.full(301, thrust), np.zeros((301, 3))), VEHICLE, "up")
    np.testing.assert_allclose(rates.x_ddot, -(RATE**2) * run.x, atol=1e-9)
    np.testing.assert_allclose(rates.y_ddot, -(RATE**2) * run.y * [1, 1, 0], atol=1e-9)


@pytest.mark.parametrize(("radius", "rate"), [(0.1, np.pi / 2), (0.5, np.pi / 2), (RADIUS, RATE), (2.0, 2.5)])
def test_a_circle_followed_exactly_succeeds(radius, rate):
    rod, axis, r = lean_on_the_circle(radius, rate)
    assert r < radius
    judged = metrics(circling(rod, axis, radius, rate))
    assert (judged.success, judged.settling) == (True, 0.0)


def test_the_same_lean_without_a_moving_reference_fails():
    rod, axis, _ = lean_on_the_circle()
    still = circling(rod, axis, circled=False)
    assert metrics(dataclasses.replace(still, x=0 * still.x)).cause == "rod"
    # A reference that stands anywhere else is none that moves.
    away = np.tile([5.0, 5.0, 5.0], (301, 1))
    assert metrics(dataclasses.replace(still, x=away, x_ref=away)).cause == "rod"


@pytest.mark.parametrize("what", ["rod", "axis"])
@pytest.mark.parametrize("rate", [50, 100, 500])
def test_both_sides_of_the_lean_at_every_sample(what, rate):
    """The allowance is 0.05 and |d − e₃| with d along ẍ_ref + g e₃, at the last sample as in the middle.

    Differences of samples h apart miss ẍ_ref by some (h rate)² inside and h rate at the ends: 4 % at 50 Hz.
    """
    t = np.linspace(0, 3, 3 * rate + 1)
    allowed = 0.05 + 2 * math.sin(math.atan(RATE**2 * RADIUS / VEHICLE.g) / 2)
    for factor, success in ((0.98, True), (1.02, False)):
        angle = 2 * math.asin(factor * allowed / 2)
        angles = (angle, 0.0) if what == "rod" else (0.0, angle)
        assert metrics(circling(*angles, t=t)).success == success
        # With the lean at one sample alone.
        run, upright = circling(*angles, t=t), circling(0.0, 0.0, t=t)
        for i in (2 * rate, len(t) - 2, len(t) - 1):
            y, R = upright.y.copy(), upright.R.copy()
            y[i], R[i] = run.y[i], run.R[i]
            assert metrics(dataclasses.replace(upright, y=y, R=R)).success == success


@pytest.mark.parametrize("climb", [-4.0, 6.0])
def test_whoever_climbs_faster_leans_less(climb):
    """A circle flown while climbing at `climb` m/s²: the pull to counter is g + climb."""
    allowed = 0.05 + 2 * math.sin(math.atan(RATE**2 * RADIUS / (VEHICLE.g + climb)) / 2)
    for factor, success in ((0.98, True), (1.02, False)):
        run = circling(2 * math.asin(factor * allowed / 2), 0.0)
        x = run.x + climb / 2 * (T**2)[:, None] * E3
        assert metrics(dataclasses.replace(run, x=x, x_ref=x)).success == success


def test_an_upright_rod_on_a_fast_circle_is_within_the_tolerance_of_upright():
    """Documented: the tolerance is about upright, made wider by the lean; it is not a tolerance about the lean."""
    assert metrics(circling(0.0, 0.0)).success


def test_no_circle_is_so_fast_that_a_hanging_rod_passes():
    for rate in (2.0, 6.0, 20.0):  # up to 400 m/s²
        assert metrics(circling(np.pi, 0.0, rate=rate)).cause == "rod"
    assert metrics(circling(0.0, np.pi, rate=20.0)).cause == "axis"


def test_a_line_allows_no_lean_and_neither_does_a_climb():
    for x_ref in (T[:, None] * [3.0, 0, 1.0], (T**2)[:, None] * [0.0, 0, 2.0]):
        run = flight(x=x_ref, x_ref=x_ref)
        assert metrics(run).success
        assert metrics(dataclasses.replace(run, y=np.tile(chord(0.0502), (301, 1)))).cause == "rod"


# How sure a rate is -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("successes", "runs", "low", "high"),
    # Newcombe (1998), Statistics in Medicine 17, 857-872, table I, method 3.
    [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)],
)
def test_wilsons_interval_as_published(successes, runs, low, high):
    assert wilson(successes, runs) == pytest.approx((low, high), abs=5e-5)
    mirrored = wilson(runs - successes, runs)
    assert mirrored == pytest.approx((1 - high, 1 - low), abs=5e-5)


@pytest.mark.parametrize(("successes", "runs"), [(1998, 2000), (8, 10), (500, 1000), (2000, 2000)])
@pytest.mark.parametrize(("confidence", "z"), [(0.95, 1.959964), (0.99, 2.575829)])
def test_wilsons_interval_is_where_the_score_test_turns(successes, runs, confidence, z):
    """At its ends the rate differs from the estimate by z standard deviations of that rate: Wilson's definition."""
    estimate = successes / runs
    for end in wilson(successes, runs, confidence):
        if 0 < end < 1:
            assert abs(estimate - end) == pytest.approx(z * math.sqrt(end * (1 - end) / runs), rel=1e-5)
    low, high = wilson(successes, runs, confidence)
    assert low < estimate <= high
    assert (high == 1.0) == (successes == runs)


@pytest.mark.parametrize(("rate", "runs"), [(0.5, 40), (0.9, 100), (0.98, 300)])
def test_wilsons_interval_covers_the_rate_in_95_of_100_experiments(rate, runs):
    """20,000 experiments: the share that covers is known to 0.0015, and the binomial is granular to 0.02."""
    drawn = np.random.default_rng(12).binomial(runs, rate, 20_000)
    ends = {k: wilson(k, runs) for k in set(drawn.tolist())}
    covered = np.mean([ends[k][0] <= rate <= ends[k][1] for k in drawn.tolist()])
    assert 0.93 < covered < 0.97
    # Negative control: an interval of half the width does not.
    middle = {k: (low + high) / 2 for k, (low, high) in ends.items()}
    half = [abs(rate - middle[k]) <= (ends[k][1] - ends[k][0]) / 4 for k in drawn.tolist()]
    assert np.mean(half) < 0.9


@pytest.mark.parametrize("width", [0.0, 0.1, 0.5])
def test_the_interval_over_starts_covers_the_rate_of_all_cells(width):
    """40 starts in 25 cells whose rates differ by `width`: a start that fails in one cell fails in all harder ones.

    2,000 experiments know the share that covers to 0.005.
    """
    rng, rates = np.random.default_rng(5), np.linspace(0.7 - width / 2, 0.7 + width / 2, 25)
    truth, runs = rates.mean(), np.full(40, 25)
    drawn = [np.sum(rng.random((40, 1)) < rates, axis=1) for _ in range(2000)]
    covered, as_independent = (
        np.mean([low <= truth <= high for low, high in ends])
        for ends in ([interval_over_clusters(k, runs) for k in drawn], [wilson(k.sum(), 1000) for k in drawn])
    )
    assert 0.93 < covered < 0.975
    assert as_independent < 0.7  # negative control


@pytest.mark.parametrize("shape", [(0.2, 0.2), (1.0, 1.0), (9.0, 1.0), (200.0, 20.0)])
@pytest.mark.parametrize("vehicles", [6, 8, 33])
def test_the_interval_of_few_vehicles_holds_the_rate_of_all(vehicles, shape):
    """Rates of vehicles from nearly all or none to nearly the same; 2,000 experiments know the share to 0.007."""
    rng, truth = np.random.default_rng(6), shape[0] / sum(shape)
    rates = rng.beta(*shape, (2000, vehicles))
    drawn = [Count.together(Count(int(good), 60) for good in row) for row in rng.binomial(60, rates)]
    held = [low <= truth <= high for low, high in (one.interval for one in drawn)]
    assert np.mean(held) > 0.92
    if shape[0] < 100:  # negative control: runs as independent
        assert np.mean([low <= truth <= high for low, high in (wilson(*one[:2]) for one in drawn)]) < 0.7


def test_the_interval_over_starts_is_wilson_s_where_each_flies_once_and_no_narrower_than_that_of_all_runs():
    once = np.arange(50) < 31
    assert interval_over_clusters(once, np.ones(50)) == pytest.approx(wilson(31, 50), abs=1e-12)
    for rate in (0, 1):  # starts that all fail, or succeed, are no more than they are
        assert interval_over_clusters(np.full(30, 8 * rate), np.full(30, 8)) == pytest.approx(wilson(30 * rate, 30))
    assert interval_over_clusters(np.full(30, 4), np.full(30, 8)) == pytest.approx(wilson(120, 240))  # cells decide
    few = interval_over_clusters(np.array([8, 3, 0]), np.array([8, 4, 0]))  # of an unfinished store
    assert few == interval_over_clusters(np.array([8, 3]), np.array([8, 4]))


def test_a_run_without_samples_to_judge_is_refused_and_a_long_hold_is_not_late():
    vehicle, start = fp.vehicle("hehn2011"), fp.State(x=(1, 0, 0), y=(0, 0, 1))
    run = fp.simulate(vehicle, fp.laws.lqr(), start, 4, times=np.linspace(0, 2, 21))
    with pytest.raises(fp.InputError) as refused:
        fp.metrics(run)
    assert refused.value.field == "times"
    still = fp.simulate(vehicle, fp.laws.lqr(), fp.State(y=(0, 0, 1)), 1)
    assert [fp.metrics(still, fp.Criterion(hold=hold)).success for hold in (0.5, 3.0)] == [True, True]


def test_a_run_that_touches_at_its_start_strays_by_nothing():
    """Its one sample is its start."""
    vehicle = fp.vehicle("hehn2011").replace(mount="hub")
    found = fp.simulate_ensemble(vehicle, fp.laws.inverted(), fp.State.random(np.random.default_rng(0), 64), 0.5)
    touched = found.end == 0
    assert touched.any()
    assert np.all(found.excursion[touched] == 0)
    assert np.all(found.lowest[touched] < 0)
    assert np.all(found.peak_force[touched] == vehicle.rotor_limits[0])
