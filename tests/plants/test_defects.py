"""Defects of sensors: each does what its definition says, in NumPy; one of size 0 adds nothing; nobody is told."""

import itertools
from functools import cache
from statistics import NormalDist

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend.board.estimator import Filter
from flypend.compile.llvm.random import normals
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.flight.kernels.sampled import structure
from flypend.flight.request import Flight
from flypend.flight.sampled import fly_stepwise
from flypend.plants import SUITES, Plant, Sensor, Sensors
from flypend.plants.defects import CONSTANT, NAMES, NEEDS, NUMBERS, blank, names_drawn
from flypend.plants.loop import Loop
from flypend.plants.measurement import normal_quantile
from flypend.plants.sensing import WIDTH, _defect_draws, draws_of, draws_size, first_memory, sensing, start_draws
from flypend.plants.sensors import sensors_called

VEHICLE, LAW, PERIOD = fp.vehicle("hehn2011"), fp.laws.inverted(), 0.002
EXACT = Sensor(rate=500.0, noise=1e-12)
POSE = Sensor(rate=500.0, noise=1e-12, latency=0.004)
EVERY = Sensors(position=POSE, attitude=POSE, rod=POSE, gyro=EXACT, accelerometer=EXACT, joints=EXACT)
# One of each, of a size at which it shows.
ONE = {
    "gyro_bias": (0.01, -0.02, 0.03), "gyro_scale": (0.01, 0.02, -0.03), "accelerometer_bias": (0.1, 0.2, -0.3),
    "accelerometer_scale": (0.01, -0.02, 0.03), "imu_turned": (0.02, -0.01, 0.03), "markers_off": (0.003, -0.002, 0.01),
    "markers_turned": (0.01, 0.02, -0.01), "rod_markers_off": (0.02, -0.01), "joints_off": (0.01, -0.02),
    "frame_off": (0.1, 0.2, 0.3), "frame_turned": (0.01, -0.02, 1.5), "frame_scale": (0.01, 0.02, -0.01),
    "gyro_bias_walk": 0.02, "accelerometer_bias_walk": 0.3, "vibration": 2.0, "gyro_vibration": 0.3, "outliers": 0.1,
    "bursts": 3.0, "untold_latency": 0.007, "latency_jitter": 0.006,
}  # fmt: skip
# Those that only say how large, how long or how fast another is.
SIZES = {"vibration_rate", "outlier_off", "outlier_turned", "burst_time"}


def wandering(ticks, seed=0):
    """Smooth states (ticks, 24) that turn and swing; their velocities are no derivatives, which nothing here needs."""
    rng = np.random.default_rng(seed)
    states, y = [], np.array([0.1, 0.2, 1.0]) / np.linalg.norm([0.1, 0.2, 1.0])
    R, x, v = Rotation.random(rng=rng).as_matrix(), rng.standard_normal(3), rng.standard_normal(3)
    for _ in range(ticks):
        omega, swing = 3 * rng.standard_normal(3), np.array([1.5, -2.0, 1.0])
        y_dot = np.cross(swing, y)
        states.append(fp.State(x=x, x_dot=v, R=R, omega=omega, y=y, y_dot=y_dot).packed())
        R, x = R @ Rotation.from_rotvec(PERIOD * omega).as_matrix(), x + PERIOD * v
        v, y = v + PERIOD * 5 * rng.standard_normal(3), Rotation.from_rotvec(PERIOD * swing).apply(y)
    return np.array(states)


@cache
def sense_of(suite):
    return as_numpy(sensing(suite, VEHICLE, PERIOD))


def read(suite, states, seed=1, rng=None, at_start=None):
    """What is delivered at each tick, by stream: numbers and ages; and the random numbers of the ticks."""
    sense, draws = sense_of(suite), normals(seed, len(states), draws_size(suite))
    for noise, _ in draws_of(suite).values():
        draws[:, noise] = 0.0
    first = normals(seed, 1, start_draws(suite), first=2**40)[0] if at_start is None else at_start
    memory, found = np.asarray(ca.DM(first_memory(suite, PERIOD, states[0], first))).ravel(), []
    for k, packed in enumerate(states):
        memory, readings = sense(memory, k * PERIOD, packed, draws[k])
        found.append(readings)
    table, columns, place = np.array(found), {}, 0
    for name in suite.streams:
        columns[name] = table[:, place : place + WIDTH[name]], table[:, place + WIDTH[name]]
        place += WIDTH[name] + 1
    return columns, draws


def turn(vector):
    return Rotation.from_rotvec(vector).as_matrix()


def rod_frames(y):
    """First vectors (n, 3) of the frame that moves with the rod `y` (n, 3), by small rotations about y × y_next."""
    axis = np.array([1.0, 0, 0]) if y[0, 0] ** 2 < 0.5 else np.array([0, 1.0, 0])
    b = [axis - (axis @ y[0]) * y[0]]
    for one, other in itertools.pairwise(y):
        about = np.cross(one, other)
        b.append(Rotation.from_rotvec(about / np.linalg.norm(about) * np.arcsin(np.linalg.norm(about))).apply(b[-1]))
    return np.array(b) / np.linalg.norm(b, axis=1)[:, None]


def expected(name, values, truth):
    """What the defect `name` of the size `values` makes of the `truth`, by stream."""
    size, R, y, x = np.array(values), truth.R, truth.y, truth.x
    gyro, attitude = truth.omega, R.reshape(-1, 9)
    if name == "gyro_bias":
        return {"gyro": gyro + size}
    if name == "gyro_scale":
        return {"gyro": gyro * (1 + size)}
    if name == "markers_off":
        return {"position": x + np.einsum("nij,j->ni", R, size)}
    if name == "markers_turned":
        return {"attitude": (R @ turn(size)).reshape(-1, 9)}
    if name == "frame_off":
        return {"position": x + size}
    if name == "frame_scale":
        return {"position": x * (1 + size)}
    if name == "frame_turned":
        Q = turn(size)
        return {"position": x @ Q.T, "attitude": (Q @ R).reshape(-1, 9), "rod": y @ Q.T}
    if name == "rod_markers_off":
        b = rod_frames(y)
        off = y + size[0] * b + size[1] * np.cross(y, b)
        return {"rod": off / np.linalg.norm(off, axis=1)[:, None]}
    assert name == "joints_off"
    # A universal joint turned by roll about x, then by pitch about the y that has turned with it.
    seen = np.einsum("nji,nj->ni", R, y)
    roll, pitch = np.arctan2(-seen[:, 1], seen[:, 2]) + size[0], np.arcsin(seen[:, 0]) + size[1]
    del attitude
    return {"joints": Rotation.from_euler("XY", np.stack([roll, pitch], axis=1)).apply([0, 0, 1.0])}


@pytest.mark.parametrize("name", [n for n in CONSTANT if n not in ("accelerometer_bias", "accelerometer_scale")])
def test_an_error_that_lasts_is_that_of_its_definition(name):
    states = wandering(60)
    truth = fp.State.trusted(states)
    found, _ = read(EVERY.replace(**{name: ONE[name]}), states)
    without, _ = read(EVERY, states)
    if name == "imu_turned":
        N = turn(ONE[name])
        np.testing.assert_allclose(found["gyro"][0], truth.omega @ N, atol=1e-10)
        np.testing.assert_allclose(found["accelerometer"][0], without["accelerometer"][0] @ N, atol=1e-10)
        changed = {"gyro", "accelerometer"}
    else:
        wanted = expected(name, ONE[name], truth)
        for stream, values in wanted.items():
            late = 2 if stream in ("position", "attitude", "rod") else 0  # ticks of latency
            np.testing.assert_allclose(found[stream][0][late:], values[: len(values) - late], atol=1e-10)
        changed = set(wanted)
    for stream in EVERY.streams:
        assert np.array_equal(found[stream][1], without[stream][1])
        same = np.array_equal(found[stream][0], without[stream][0])
        assert same != (stream in changed), stream


@pytest.mark.parametrize("name", ["accelerometer_bias", "accelerometer_scale"])
def test_an_accelerometer_is_off_by_bias_and_scale(name):
    states = wandering(30)
    found, without = (
        read(suite, states)[0]["accelerometer"][0] for suite in (EVERY.replace(**{name: ONE[name]}), EVERY)
    )
    size = np.array(ONE[name])
    wanted = without + size if name == "accelerometer_bias" else without * (1 + size)
    np.testing.assert_allclose(found, wanted, atol=1e-11)


def test_errors_come_in_the_order_scale_bias_and_marker_frame():
    """Q, scale and offset of the frame act on where the markers are; the scale of an IMU on its own axes."""
    suite = EVERY.replace(**{n: ONE[n] for n in ("frame_turned", "frame_scale", "frame_off", "markers_off")},
                          **{n: ONE[n] for n in ("imu_turned", "gyro_scale", "gyro_bias")})  # fmt: skip
    states = wandering(20)
    s, (found, _) = fp.State.trusted(states), read(suite, states)
    seen = (s.x + np.einsum("nij,j->ni", s.R, ONE["markers_off"])) @ turn(ONE["frame_turned"]).T
    seen = seen * (1 + np.array(ONE["frame_scale"])) + ONE["frame_off"]
    np.testing.assert_allclose(found["position"][0][2:], seen[:-2], atol=1e-10)
    gyro = (s.omega @ turn(ONE["imu_turned"])) * (1 + np.array(ONE["gyro_scale"])) + ONE["gyro_bias"]
    np.testing.assert_allclose(found["gyro"][0], gyro, atol=1e-10)


def test_a_number_draws_an_error_for_each_flight():
    suite = EVERY.replace(gyro_bias=0.01, frame_off=0.2)
    assert names_drawn(suite) == ["gyro_bias", "frame_off"]
    states = np.tile(wandering(1), (10, 1))
    truth, biases, offsets = fp.State.trusted(states[0]), [], []
    for seed in range(400):
        found, _ = read(suite, states, seed)
        bias = found["gyro"][0] - truth.omega
        np.testing.assert_allclose(bias, np.tile(bias[:1], (10, 1)), atol=1e-12)  # it lasts
        biases.append(bias[0])
        offsets.append(found["position"][0][-1] - truth.x)
    for sample, size in ((biases, 0.01), (offsets, 0.2)):
        # Four standard errors of a deviation, a mean and a correlation of 400.
        assert np.std(sample, axis=0) == pytest.approx(size, rel=4 / np.sqrt(800))
        assert np.all(np.abs(np.mean(sample, axis=0)) < 4 * size / np.sqrt(400))
    mixed = np.corrcoef(np.hstack([biases, offsets]).T) - np.eye(6)
    assert np.max(np.abs(mixed)) < 4 / np.sqrt(400)


def test_the_start_s_estimate_is_that_without_defects():
    from flypend.flight.sampled import estimate_at_start

    state = wandering(1)[0]
    plain, worse = (estimate_at_start(Plant(sensors=s, seed=3), state) for s in (EVERY, EVERY.replace(gyro_bias=0.1)))
    assert np.array_equal(plain, worse)


@pytest.mark.parametrize(("stream", "name"), [("gyro", "gyro_bias_walk"), ("accelerometer", "accelerometer_bias_walk")])
def test_a_bias_walks_with_the_root_of_time(stream, name):
    states = np.tile(wandering(1), (501, 1))
    ends = []
    for seed in range(200):
        found, _ = read(EVERY.replace(**{name: ONE[name]}), states, seed)
        values = found[stream][0]
        ends.append(values[-1] - values[0])
    # A second, with four standard errors of a deviation of 600.
    assert np.std(ends) == pytest.approx(ONE[name], rel=4 / np.sqrt(1200))


def test_vibration_is_a_wave_of_which_an_accelerometer_reads_the_mean():
    states, rate = np.tile(wandering(1), (80, 1)), 137.0
    suite = EVERY.replace(vibration=2.0, gyro_vibration=0.3, vibration_rate=rate)
    found, without = read(suite, states)[0], read(EVERY, states)[0]
    t = np.arange(80) * PERIOD
    for axis in range(3):
        wave = lambda at, axis=axis: np.sin(2 * np.pi * (rate * at + axis / 3))  # noqa: E731
        np.testing.assert_allclose((found["gyro"][0] - without["gyro"][0])[:, axis], 0.3 * wave(t), atol=1e-10)
        fine = t[:, None] - PERIOD * (np.arange(1000) + 0.5) / 1000
        mean = 2.0 * wave(fine).mean(axis=1)
        # The midpoint rule with 1,000 points: (2π · 137 · 2e-6)²/24.
        read_ = (found["accelerometer"][0] - without["accelerometer"][0])[:, axis]
        np.testing.assert_allclose(read_, mean, atol=1e-6)
    assert np.max(np.abs(read_)) > 1.0


def test_outliers_are_of_a_body_as_far_away_as_was_said():
    states = np.tile(wandering(1), (6000, 1))
    suite = EVERY.replace(outliers=0.1, outlier_off=0.07, outlier_turned=0.3)
    s, (found, _) = fp.State.trusted(states[0]), read(suite, states)
    off = np.linalg.norm(found["position"][0][2:] - s.x, axis=1)
    tilt = np.arccos(np.clip(found["rod"][0][2:] @ s.y, -1, 1))
    turned = Rotation.from_matrix(found["attitude"][0][2:].reshape(-1, 3, 3) @ s.R.T).magnitude()
    wrong, rod = off > 0.01, tilt > 0.01
    np.testing.assert_allclose(off[wrong], 0.07, atol=1e-9)
    np.testing.assert_allclose(turned[wrong], 0.3, atol=1e-7)
    np.testing.assert_allclose(tilt[rod], 0.3, atol=1e-7)
    assert np.max(np.concatenate([off[~wrong], turned[~wrong], tilt[~rod]])) < 1e-6
    spread = np.sqrt(0.09 / len(wrong))
    for share, four in (
        (wrong.mean() - 0.1, spread),
        (rod.mean() - 0.1, spread),
        ((wrong & rod).mean() - 0.01, spread / 3),
    ):
        assert abs(share) < 4 * four
    # Directions are uniform: their mean is 0, each component has variance 1/3.
    ways = (found["position"][0][2:][wrong] - s.x) / 0.07
    assert np.all(np.abs(ways.mean(axis=0)) < 4 / np.sqrt(3 * wrong.sum()))


def test_bursts_lose_frames_of_all_cameras_for_their_time():
    states = np.tile(wandering(1), (20000, 1))
    suite = EVERY.replace(bursts=1.5, burst_time=0.05)
    found, _ = read(suite, states)
    late = found["position"][1][2:] < 0
    for name in ("attitude", "rod"):
        assert np.array_equal(found[name][1][2:] < 0, late)
    assert np.all(found["gyro"][1] >= 0)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], late.astype(int), [0]])))
    lengths = (edges[1::2] - edges[::2]) * PERIOD
    assert np.min(lengths[:-1]) >= 0.05 - 1e-9
    # Bursts that begin within one prolong it, so a tick is lost unless none began in the 25 before.
    lost = 1 - (1 - 1.5 * PERIOD) ** 25
    # 40 s hold some 60 bursts; the share of their sum is known to 1/√60.
    assert late.mean() == pytest.approx(lost, rel=4 / np.sqrt(60))


@pytest.mark.parametrize("rate", [500.0, 173.0])
def test_untold_latency_makes_poses_older_than_their_age(rate):
    pose = Sensor(rate=rate, noise=1e-12, latency=0.004)
    suite = Sensors(position=pose, attitude=pose, rod=pose, gyro=EXACT, untold_latency=0.0073)
    states = line(80)
    for name in ("position", "gyro"):
        values, ages = read(suite, states)[0][name]
        fresh = np.flatnonzero(ages >= 0)
        told_at, taken = fresh * PERIOD - ages[fresh], values[fresh, 0] if name == "position" else fresh * PERIOD
        if name == "position":
            np.testing.assert_allclose(told_at - taken, 0.0073, atol=1e-9)
            assert np.all(ages[fresh] >= 0.004 - 1e-9)
            assert np.all(ages[fresh] < 0.004 + PERIOD)
            assert len(fresh) >= 0.1 * rate
        else:
            assert np.all(ages >= 0)


def line(ticks):
    """States whose first coordinate is the time."""
    start = fp.State(x=(0, 0, 0), x_dot=(1, 0, 0), y=(0, 0, 1.0)).packed()
    states = np.tile(start, (ticks, 1))
    states[:, 0] = np.arange(ticks) * PERIOD
    return states


@pytest.mark.parametrize(("rate", "untold"), [(500.0, 0.0), (200.0, 0.003), (50.0, 0.0)])
def test_jitter_delays_each_frame_by_its_own_part(rate, untold):
    pose = Sensor(rate=rate, noise=1e-12, latency=0.0045)
    suite = Sensors(position=pose, attitude=pose, rod=pose, gyro=EXACT, latency_jitter=0.006, untold_latency=untold)
    states = line(4000)
    (values, ages), (rods, rod_ages) = (read(suite, states)[0][name] for name in ("position", "rod"))
    assert np.array_equal(ages, rod_ages)
    fresh = np.flatnonzero(ages >= 0)
    taken = values[fresh, 0]
    np.testing.assert_allclose(taken * rate, np.rint(taken * rate), atol=1e-4)
    later = fresh * PERIOD - ages[fresh] - taken - untold  # that part of the latency of which nobody told
    assert np.all((later >= -1e-9) & (later <= 0.006 + 1e-9))
    arrived = taken + 0.0045 + untold + later
    assert np.all(arrived <= fresh * PERIOD + 1e-8)
    assert np.all(arrived > (fresh - 1) * PERIOD - 1e-8)
    if rate < 500:  # no two arrive in one period, or the older of them is dropped: some at 200 Hz
        assert len(fresh) > 0.9 * rate * 7.9
    # Uniform: mean 3 ms, deviation 6/√12 ms; the newest of several counts, so at 500 Hz the early ones are favoured.
    if rate == 50.0:
        assert len(fresh) == pytest.approx(rate * 8, abs=2)
        assert np.mean(later) == pytest.approx(0.003, abs=4 * 0.006 / np.sqrt(12 * len(fresh)))
        assert np.std(later) == pytest.approx(0.006 / np.sqrt(12), rel=4 / np.sqrt(2 * len(fresh)))
    del rods


@pytest.mark.parametrize("stream", ["position", "gyro", "accelerometer"])
def test_readings_come_in_steps(stream):
    states = wandering(40)
    coarse = EVERY.replace(**{stream: Sensor(rate=500.0, noise=1e-12, quantisation=0.05)})
    exact = EVERY.replace(**{stream: EXACT})
    values, true = (read(suite, states)[0][stream][0] for suite in (coarse, exact))
    np.testing.assert_allclose(values / 0.05, np.rint(values / 0.05), atol=1e-9)
    assert np.max(np.abs(values - true)) <= 0.025 + 1e-9
    assert np.max(np.abs(values - true)) > 0.0125


# Nothing, and nobody told -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["mocap", "onboard"])
def test_defects_of_size_0_add_no_operation(name):
    suite = SUITES[name]
    nothing = suite.replace(**{n: 0.0 if n in NUMBERS else (0.0,) * CONSTANT[n][0] for n in NAMES if n not in SIZES})
    assert nothing == suite

    def text(sensors):
        return sensing(sensors, VEHICLE, PERIOD).serialize()

    assert text(suite.replace(outlier_off=1.0, burst_time=1.0)) == text(suite)
    assert len(text(suite.replace(gyro_bias=1e-3))) > len(text(suite))  # the comparison sees one that is there


def test_every_defect_changes_the_program():
    plain = sensing(EVERY, VEHICLE, PERIOD).serialize()
    assert set(ONE) | SIZES == set(NAMES)
    for name, value in ONE.items():
        assert sensing(EVERY.replace(**{name: value}), VEHICLE, PERIOD).serialize() != plain, name


def test_the_estimator_is_told_of_no_defect():
    from flypend.board.nominal import Nominal

    def programs(sensors):
        made = Filter(Loop(VEHICLE, LAW.bind(VEHICLE), Plant(sensors=sensors)), Nominal(VEHICLE))
        return [f.serialize() for f in (made.begin(), made.correct(), made.carry())]

    worst = EVERY.replace(**ONE)
    assert programs(worst) == programs(EVERY)
    assert worst.told == EVERY
    assert programs(EVERY.replace(gyro=Sensor(rate=500.0, noise=0.1))) != programs(EVERY)


def test_defects_share_no_random_number():
    suite = EVERY.replace(**ONE)
    used = [i for noise, lost in draws_of(suite).values() for i in (*noise, *([] if lost is None else [lost]))]
    used += [i for some in _defect_draws(suite).values() for i in some]
    assert len(set(used)) == len(used)
    assert not set(used) & set(range(18, 24))
    assert draws_size(suite) == max(used) + 1


def test_a_kernel_flies_them_as_python_does():
    """Half of the errors are fixed, half are drawn."""
    suite = SUITES["mocap"].replace(
        accelerometer=Sensor(rate=500.0, noise=0.2),
        joints=Sensor(rate=500.0, noise=1e-3),
        **ONE | dict.fromkeys(list(CONSTANT)[::2], 0.01),
    )
    start, plant = fp.State(y=(0.0, 0.1, 0.995)), fp.Plant(sensors=suite, seed=5)
    run = fp.simulate(VEHICLE, LAW, start, duration=0.2, plant=plant)

    def stepped(plant):
        flight = Flight(vehicle=VEHICLE, law=LAW.bind(VEHICLE), starts=start, duration=0.2, plant=plant)
        return fly_stepwise(flight).packed[-1]

    # Kernels fuse products and sums: roundoff, which the unstable rod makes e^(4.4 · 0.2) times as large.
    np.testing.assert_allclose(run.packed[-1], stepped(plant), atol=1e-9)
    assert np.max(np.abs(run.packed[-1] - stepped(plant.replace(seed=6)))) > 1e-4


def test_one_kernel_serves_every_size():
    """Sizes are numbers at run time: of those that there are, and of those that may come."""

    def same(one, other):
        return structure(Plant(sensors=one)) == structure(Plant(sensors=other))

    laboratory, mocap = SUITES["laboratory"], SUITES["mocap"]
    assert same(laboratory, laboratory.replace(gyro_bias=0.1, frame_turned=0.05))
    assert not same(laboratory, laboratory.replace(gyro_bias=0.0))
    assert not same(laboratory, laboratory.replace(gyro_bias=(0.0, 0.005, 0.0)))  # not drawn
    assert not same(laboratory, laboratory.replace(untold_latency=0.009))  # of which a queue depends
    assert not same(laboratory, laboratory.replace(rod=Sensor(rate=200.0, noise=3.5e-3, latency=0.01)))
    every = mocap.replace(adjustable="all")
    assert set(every.adjustable) == {*NAMES} - SIZES - {"joints_off"}
    assert same(every, every.replace(**dict.fromkeys(every.adjustable, 0.005)))
    assert same(every, every.replace(outliers=0.3, untold_latency=0.02, vibration_rate=90.0))
    assert not same(every, mocap)
    assert every.told == mocap
    assert Sensors(**every.to_dict()) == every
    for suite in (laboratory, every, EVERY.replace(**ONE)):
        assert blank(blank(suite)) == blank(suite)


@pytest.mark.parametrize(
    ("named", "told"), [("gyro_byas", "gyro_bias"), ("joints_off", "one of"), ("burst_time", "one")]
)
def test_what_cannot_be_adjusted_is_refused(named, told):
    with pytest.raises(InputError, match=told):
        SUITES["mocap"].replace(adjustable=(named,))
    with pytest.raises(InputError, match="names of defects"):
        SUITES["mocap"].replace(adjustable=named)


def test_an_adjustable_defect_is_that_of_its_size():
    """Latencies that are numbers at run time deliver the readings of those that are compiled in, at the same ticks."""
    states, fixed = wandering(200), EVERY.replace(untold_latency=0.0073)
    adjustable = EVERY.replace(untold_latency=0.0073, adjustable=("untold_latency", "bursts", "outliers", "vibration"))
    (one, _), (other, _) = read(fixed, states), read(adjustable, states)
    for name in EVERY.streams:
        assert np.array_equal(one[name][1] < 0, other[name][1] < 0)
        np.testing.assert_allclose(other[name][1], one[name][1], atol=1e-15)
        fresh = one[name][1] >= 0
        np.testing.assert_allclose(other[name][0][fresh], one[name][0][fresh], atol=1e-9)


@pytest.mark.parametrize("probability", [1e-9, 1e-3, 0.07, 0.08, 0.5, 0.91, 0.93, 0.999])
def test_the_quantile_in_symbols_is_the_normal_one(probability):
    found = float(normal_quantile(ca.DM(probability)))
    assert found == pytest.approx(NormalDist().inv_cdf(probability), rel=1e-14)
    assert float(normal_quantile(ca.DM(0.0))) == -1000.0


# As data ------------------------------------------------------------------------------------------------------------


def test_they_go_through_tables_and_back():
    given = sensors_called({"base": "mocap", "gyro_bias": [0.01, 0.0, 0.0], "outliers": 0.01, "markers_off": 0.003})
    assert given.gyro_bias == (0.01, 0.0, 0.0)
    table = given.to_dict()
    assert {"gyro_bias", "outliers", "markers_off"} <= set(table)
    assert "frame_off" not in table
    assert "outlier_off" not in table  # it is the default
    for suite in (given, EVERY.replace(**ONE)):
        assert Sensors(**suite.to_dict()) == suite
        assert hash(Plant(sensors=suite)) == hash(Plant(sensors=Sensors(**suite.to_dict())))


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"gyro_bias": (0.1, 0.2)}, "gyro_bias"),
        ({"gyro_bias": -0.1}, ">= 0"),
        ({"gyro_bias": "much"}, "gyro_bias"),
        ({"markers_off": (0, 0, 5.0)}, "at most 1 m"),
        ({"frame_turned": (0, 0, 90.0)}, "degrees"),
        ({"outliers": 1.0}, "outliers"),
        ({"untold_latency": 8.0}, "at most 0.2 s"),
        ({"latency_jitter": np.nan}, "latency_jitter"),
        ({"gyro_byas": 0.1}, "gyro_bias"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(changes, told):
    with pytest.raises(InputError, match=told) as caught:
        EVERY.replace(**changes)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", NEEDS)
def test_a_defect_of_a_sensor_that_is_not_there_is_refused(name):
    without = dict.fromkeys(("accelerometer", "attitude"))
    without |= {"joints": None} if name != "rod_markers_off" else {"rod": None}
    bare = EVERY.replace(**without)
    with pytest.raises(InputError, match=NEEDS[name][0]):
        bare.replace(**{name: ONE[name]})
