"""Flights in pieces: equal to flights that are not interrupted, and to those whose numbers are compiled in."""

import numpy as np
import pytest

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.flight.kernels.pieces import pieces_kernel
from flypend.flight.kernels.sampled import plant_numbers, sampled_kernel
from flypend.flight.request import Flight
from flypend.flight.sampled import fly_stepwise
from flypend.plants import SUITES, plant
from flypend.plants.defects import NAMES
from flypend.plants.equations import struck
from flypend.plants.knobs import KNOBS, defect_sizes, knob_values, turn_knobs
from flypend.plants.loop import Loop
from flypend.plants.plant import Noise, Wind

MACHINE = fp.vehicle("hehn2011")
CALM = plant("rotors")
REAL = CALM.replace(delay=0.006, noise=Noise(x=1e-3, y=2e-3, omega=1e-2), wind=Wind(gust_on_vehicle=0.1))
SEEN = CALM.replace(sensors="mocap")
START = fp.State(y=(0.6, 0.0, 0.8), y_dot=(0, 0.2, 0), x=(0.1, 0, 0))
TICKS = 1500
CRITERION = fp.Criterion()


def loop_of(through=CALM, law=None, vehicle=MACHINE, parameters=()):
    return Loop(vehicle, (law or fp.laws.inverted()).bind(vehicle), through, parameters)


def in_pieces(loop, lengths=(TICKS,), seed=3, **knobs):
    flight = pieces_kernel(loop, CRITERION).begin(START, seed=seed)
    flight.turn(**knobs)
    return np.concatenate([flight.advance(length) for length in lengths])


def at_once(loop, seed=3, start=START):
    """The same flight by the ordinary kernel, eight at a time."""
    every = np.arange(TICKS + 1)
    flown = sampled_kernel(loop, CRITERION).fly(
        start.packed()[None], TICKS / loop.sampled.rate, judge_at=every, keep_at=every, first_seed=seed, workers=1
    )
    return flown.samples[0]


@pytest.mark.parametrize("through", [CALM, REAL, plant("hehn2011"), SEEN])
def test_a_flight_in_pieces_is_the_flight_itself_bit_by_bit(through):
    loop, lengths = loop_of(through), np.random.default_rng(5).integers(1, 90, 100)
    lengths = lengths[: np.searchsorted(np.cumsum(lengths), TICKS)]
    lengths = [*lengths.tolist(), TICKS - int(lengths.sum())]
    assert np.array_equal(in_pieces(loop, lengths), in_pieces(loop))


@pytest.mark.parametrize("through", [CALM, REAL, plant("hehn2011"), SEEN, CALM.replace(lag=0)])
def test_it_is_the_flight_of_the_ordinary_kernel(through):
    # 1e-9: the same operations in another order, over three seconds of a flight that settles.
    np.testing.assert_allclose(in_pieces(loop_of(through)), at_once(loop_of(through)), atol=1e-9)


def test_a_flight_begins_with_the_random_numbers_of_its_seed():
    through = REAL.replace(seed=7)
    flight = Flight(vehicle=MACHINE, law=fp.laws.inverted().bind(MACHINE), starts=START, duration=0.2, plant=through)
    rows = pieces_kernel(flight.loop, CRITERION).begin(START, seed=flight.seed).advance(100)
    whole = fp.simulate(MACHINE, fp.laws.inverted(), START, 0.2, plant=through, times=np.arange(101) / 500)
    np.testing.assert_allclose(rows[:, :24], whole.packed, atol=1e-9)
    kernel = pieces_kernel(loop_of(through), CRITERION)
    assert np.array_equal(kernel.begin(START).advance(100), rows)
    assert not np.array_equal(kernel.begin(START, seed=0).advance(100), rows)


def test_another_delay_is_that_of_a_plant_that_has_it():
    law = fp.laws.inverted()
    for delay in (0.0, 0.0013, 0.002, 0.0095, 0.02):
        wanted = at_once(loop_of(CALM.replace(delay=delay), law))
        np.testing.assert_allclose(in_pieces(loop_of(CALM, law), delay=[delay]), wanted, atol=1e-9)


def test_other_rotor_limits_are_those_of_a_vehicle_that_has_them():
    limits = [MACHINE.rotor_limits[0], 0.45 * MACHINE.weight]
    other = MACHINE.replace(rotor_limits=limits)
    law = fp.laws.inverted().with_gains(dict(fp.laws.inverted().bind(MACHINE).numbers))
    own = in_pieces(loop_of(CALM, law), rotor_limits=limits)
    assert own[:, 24:].max() <= limits[1] + 1e-12
    np.testing.assert_allclose(own, at_once(loop_of(CALM, law, other)), atol=1e-9)
    assert np.abs(own - in_pieces(loop_of(CALM, law))).max() > 0.1


ADJUSTABLE = SEEN.replace(sensors=SUITES["mocap"].replace(adjustable="all"))
SIZES = {
    "gyro_bias": 0.02, "accelerometer_scale": 0.01, "imu_turned": 0.01, "markers_off": 0.003, "markers_turned": 0.01,
    "rod_markers_off": 0.01, "frame_off": 0.1, "frame_turned": 0.02, "frame_scale": 0.01, "gyro_bias_walk": 0.01,
    "vibration": 1.0, "gyro_vibration": 0.1, "outliers": 0.02, "bursts": 0.3, "untold_latency": 0.0073,
    "latency_jitter": 0.004,
}  # fmt: skip


def test_other_sizes_of_defects_are_those_of_sensors_that_have_them():
    """Of 0, only roundoff remains of them, though they draw random numbers. They act from the next piece on."""
    kernel, ticks = pieces_kernel(loop_of(ADJUSTABLE), CRITERION), 300
    wrong = ADJUSTABLE.sensors.replace(**SIZES)

    def flown(sizes, *lengths):
        flight = kernel.begin(START, seed=3)
        flight.turn(defects=sizes)
        return np.concatenate([flight.advance(length) for length in lengths])

    for sensors, same in ((wrong, wrong), (ADJUSTABLE.sensors, SUITES["mocap"])):
        law = fp.laws.inverted().bind(MACHINE)
        request = Flight(
            vehicle=MACHINE, law=law, starts=START, duration=ticks / CALM.rate, plant=CALM.replace(sensors=same), seed=3
        )
        wanted = fly_stepwise(request)
        # Kernels fuse products and sums: roundoff, which the unstable rod makes e^(4.4 · 0.6) times as large.
        np.testing.assert_allclose(flown(defect_sizes(sensors), ticks)[:, :24], wanted.packed, atol=1e-9)
    right, off = (flown(defect_sizes(sensors), ticks) for sensors in (ADJUSTABLE.sensors, wrong))
    assert np.abs(right - off)[-1].max() > 1e-2
    flight = kernel.begin(START, seed=3)
    before = flight.advance(200)
    flight.turn(defects=defect_sizes(wrong))
    assert np.array_equal(before, right[:201])
    assert np.abs(flight.advance(20) - right[201:221]).max() > 1e-3


def test_a_moved_origin_moves_the_flight():
    place = np.array([0.4, -0.3, 0.2])
    moved = in_pieces(loop_of(), origin=place)
    start = START.packed()
    start[:3] -= place
    wanted = at_once(loop_of(), start=fp.State.from_packed(start))
    wanted[:, :3] += place
    np.testing.assert_allclose(moved, wanted, atol=1e-9)


def test_gains_that_change_are_those_of_another_law():
    loop = loop_of(parameters=("rod_bandwidth",))
    value = 1.1 * loop.law.gains["rod_bandwidth"]
    flight = pieces_kernel(loop, CRITERION).begin(START, gains={"rod_bandwidth": value})
    other = loop_of(law=fp.laws.inverted(rod_bandwidth=value))
    np.testing.assert_allclose(flight.advance(TICKS), at_once(other), atol=1e-9)


def test_an_impulse_is_the_change_of_momentum():
    strike, start = as_numpy(struck(MACHINE)), fp.State.random(np.random.default_rng(2))
    impulses = np.array([0.3, -0.1, 0.2, 0.01, 0.05, -0.02])
    after = fp.State.from_packed(strike(start.packed(), impulses))
    M, m, l = MACHINE.M, MACHINE.m, MACHINE.l
    momentum = [(M + m) * s.x_dot + m * l * s.y_dot for s in (start, after)]
    np.testing.assert_allclose(momentum[1] - momentum[0], impulses[:3] + impulses[3:], atol=1e-14)
    # Along the rod the two bodies share what they get; across it, each keeps its own: of the bob, m (ẋ + l ẏ).
    across = np.eye(3) - np.outer(start.y, start.y)
    bob = [m * (s.x_dot + l * s.y_dot) for s in (start, after)]
    np.testing.assert_allclose(across @ (bob[1] - bob[0]), across @ impulses[3:], atol=1e-14)
    assert np.array_equal(strike(start.packed(), np.zeros(6)), start.packed())


def test_knobs_are_the_numbers_of_the_plant():
    rng = np.random.default_rng(9)
    for name in ("rotors", "hehn2011"):
        base = plant(name)
        turn = as_numpy(turn_knobs(base))
        for _ in range(40):
            lag, delay = (
                rng.choice([0.0, rng.uniform(0.002, 0.1)]),
                rng.choice([0.0, 1 / base.rate, rng.uniform(0, 0.1)]),
            )
            blown = Wind(on_vehicle=rng.normal(size=3), gust_on_bob=rng.uniform(), on_bob=rng.normal(size=3))
            whole = base.replace(lag=lag, delay=delay, noise=Noise(y=0.1), wind=blown)
            numbers = turn(np.concatenate(list(knob_values(MACHINE, whole).values())))
            wanted = plant_numbers(loop_of(whole))
            (age, steps), timing = numbers[:4].reshape(2, 2).T, numbers[4:12].reshape(2, 4)
            kept = steps > 0
            assert age[1] == np.floor((delay + 1e-9) * base.rate)
            assert age[0] == age[1] + 1
            found = np.concatenate([timing[kept].ravel(), numbers[12:18], numbers[21:33]])
            # The change of a ramp is twelve times a difference of numbers near one, times (lag / step)², at most 1e6.
            np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-8 if lag > 0 else 1e-15)
            assert np.sum(steps * timing[:, 0]) == pytest.approx(1 / base.rate, abs=1e-9)


def test_what_is_no_knob_and_no_gain_is_refused():
    flight = pieces_kernel(loop_of(), CRITERION).begin(START)
    with pytest.raises(fp.InputError, match="lag"):
        flight.turn(leg=[0.1])
    with pytest.raises(fp.InputError, match="origin"):
        flight.turn(origin=[0.1])
    with pytest.raises(fp.InputError, match="gains"):
        flight.tune({"rod_bandwidth": 3.0})
    with pytest.raises(fp.InputError, match="engine"):
        pieces_kernel(loop_of(plant("mujoco")), CRITERION)
    assert sum(KNOBS.values()) == 21 + len(NAMES)


def test_a_flight_that_has_ended_goes_nowhere():
    flight = pieces_kernel(loop_of(law=fp.laws.lqr()), CRITERION).begin(START)
    hit = flight.advance(100, [0, 0, 0, 0, 0, 1e9])
    assert flight.outcome.status == "diverged"
    assert not flight.flying
    assert np.isnan(hit[-1]).all()
    assert np.isnan(flight.advance(10)).all()
