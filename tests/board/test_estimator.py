"""The estimator: its error equations against the motion, its sensitivities against its sensors, and what it claims."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.board import accelerometer, error_state
from flypend.board.computer import SteppedBoard
from flypend.board.estimator import Filter, steady_gain
from flypend.board.history import QUANTITIES, History
from flypend.board.innovation import Expected
from flypend.board.nominal import Nominal
from flypend.board.program import board, initial_memory
from flypend.compile.llvm.random import normals
from flypend.compile.numeric import as_numpy
from flypend.flight import sampled
from flypend.flight.kernels import sampled_kernel
from flypend.flight.request import Flight
from flypend.geometry import parallel_transport
from flypend.laws import references
from flypend.model.motion import Disturbance, disturbed_motion
from flypend.plants import ROTORS, SUITES, Plant, Sensor, Wind
from flypend.plants.equations import EquationsEngine
from flypend.plants.loop import Loop
from flypend.plants.sensing import WIDTH, draws_size, first_memory, readings_record, sensing
from tests.few import few, slow

VEHICLE = fp.vehicle("hehn2011")
LAW = fp.laws.inverted().bind(VEHICLE)
TOLD = fp.laws.inverted(latency=0.0, delay_reach=0.0).bind(VEHICLE)
NONE = np.zeros(0)
ERRORS = error_state.ERRORS


def wrong_by(state, b, error):
    """The packed state (24,) of which `state` is the estimate with this error."""
    packed, tangent, e = ca.SX.sym("s", 24), ca.SX.sym("b", 3), ca.SX.sym("e", ERRORS)
    s, _, _ = error_state.correct(fp.State.symbolic(packed), tangent, e, VEHICLE)
    return np.asarray(ca.Function("f", [packed, tangent, e], [s.packed()])(state, b, error)).ravel()


def error_of(truth, estimate, b):
    """The error (13,) of an estimate (24,), whose rod has the frame of `b`, to first order."""
    t, e = fp.State.trusted(truth), fp.State.trusted(estimate)
    B, a = np.stack([b, np.cross(e.y, b)], axis=1), error_state.lever(VEHICLE)
    turn = t.R @ e.R.T
    theta = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    centre, velocity = t.x - e.x + a * (t.y - e.y), t.x_dot - e.x_dot + a * (t.y_dot - e.y_dot)
    return np.concatenate([centre, velocity, theta, B.T @ t.y, B.T @ (t.y_dot - e.y_dot)])


def some_state(seed):
    state = fp.State.random(np.random.default_rng(seed))
    tangent = np.cross(state.y, [0.3, -0.5, 0.8])
    return state.packed(), tangent / np.linalg.norm(tangent)


def test_an_error_is_put_in_and_found_again():
    state, b = some_state(1)
    error = 1e-5 * np.random.default_rng(2).standard_normal(ERRORS)
    # Of second order in the error.
    np.testing.assert_allclose(error_of(wrong_by(state, b, error), state, b), error, atol=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_errors_move_as_the_motion_of_two_neighbours_tells(seed):
    state, b = some_state(seed)
    rotors, h, size = np.random.default_rng(seed).uniform(0.5, 3.0, 4), 1e-3, 1e-5

    def later(packed):
        engine = EquationsEngine(VEHICLE)
        engine.reset(packed, rotors)
        engine.step(rotors, h, np.zeros(6))
        return engine.packed

    after = later(state)
    y, y_after = state[18:21], after[18:21]
    b_after = parallel_transport(b, y, y_after)
    P = ca.SX.sym("P", ERRORS, ERRORS)
    packed, tangent = ca.SX.sym("s", 24), ca.SX.sym("b", 3)
    s = fp.State.symbolic(packed)
    force = float(np.sum(rotors)) * s.z
    spread = error_state.propagate(P, s, tangent, force, VEHICLE, h, error_state.Densities(0.0, 0.0, 0.0))
    covariance = ca.Function("f", [P, packed, tangent], [ca.densify(spread)])
    for i in range(ERRORS):
        unit = np.zeros(ERRORS)
        unit[i] = size
        moved = error_of(later(wrong_by(state, b, unit)), after, b_after) / size
        predicted = np.asarray(covariance(np.outer(unit, unit) / size**2, state, b))
        # One Euler step of 1 ms: (h λ)²/2 with rates up to 40 1/s² and |ẏ| = 3 1/s, and the size of the error.
        np.testing.assert_allclose(predicted, np.outer(moved, moved), atol=2e-4)


@pytest.mark.parametrize("seed", range(2))
def test_unknown_forces_drive_the_errors_that_they_drive_in_the_motion(seed):
    """From no error: specific forces on vehicle and on bob, against the motion under each, and the rate's error."""
    packed, b = some_state(seed)
    state, h, densities = fp.State.trusted(packed), 1e-3, error_state.Densities(0.3, 0.7, 0.2)
    a, B = error_state.lever(VEHICLE), np.stack([b, np.cross(state.y, b)], axis=1)

    def driven(on_vehicle, on_bob):
        """Rates of velocity and swing (5,) by such specific forces, m/s²."""
        forces = {"force_on_vehicle": VEHICLE.M * on_vehicle, "force_on_bob": VEHICLE.m * on_bob}
        moved = disturbed_motion(state, fp.Wrench(0.0, np.zeros(3)), VEHICLE, "up", Disturbance(**forces))
        return np.append(moved.x_ddot + a * moved.y_ddot, B.T @ moved.y_ddot)

    rest, none, Q = driven(np.zeros(3), np.zeros(3)), np.zeros(3), np.zeros((ERRORS, ERRORS))
    for axis in np.eye(3):
        for density, forces in ((densities.on_vehicle, (axis, none)), (densities.on_bob, (none, axis))):
            G = np.zeros(ERRORS)
            G[[3, 4, 5, 11, 12]] = driven(*forces) - rest
            Q += h * density * np.outer(G, G)
    Q[6:9, 6:9] += h * densities.turning * np.eye(3)
    zero = ca.SX(ERRORS, ERRORS)
    given = (ca.DM(b), ca.SX(3, 1), VEHICLE, h, densities)
    found = error_state.propagate(zero, fp.State.symbolic(ca.SX(ca.DM(packed))), *given)
    np.testing.assert_allclose(np.asarray(ca.DM(found)), Q, atol=1e-15)


@pytest.mark.parametrize("seed", range(2))
def test_a_bias_of_the_accelerometer_drives_the_errors_that_the_force_would_that_it_is_taken_for(seed):
    packed, b = some_state(seed)
    state, h, size = fp.State.trusted(packed), 1e-3, error_state.FELT_BIAS.stop
    a, B = error_state.lever(VEHICLE), np.stack([b, np.cross(state.y, b)], axis=1)

    def driven(force):
        moved = disturbed_motion(state, fp.Wrench(0.0, np.zeros(3)), VEHICLE, "up", Disturbance(force_on_vehicle=force))
        return np.append(moved.x_ddot + a * moved.y_ddot, B.T @ moved.y_ddot)

    symbolic = fp.State.symbolic(ca.SX(ca.DM(packed)))
    for i, axis in enumerate(np.eye(3)):
        P = ca.SX(size, size)
        P[error_state.FELT_BIAS.start + i, error_state.FELT_BIAS.start + i] = 1
        still = error_state.Densities(0.0, 0.0, 0.0)
        after = error_state.propagate(P, symbolic, ca.DM(b), ca.SX(3, 1), VEHICLE, h, still)
        found = np.asarray(ca.DM(after))[[3, 4, 5, 11, 12], error_state.FELT_BIAS.start + i]
        accelerated = state.R @ axis
        force = np.asarray(accelerometer.force_of(ca.DM(accelerated), ca.DM(state.y), VEHICLE)).ravel()
        # F accelerates the pivot itself by what the accelerometer wrongly reads.
        moved = driven(force) - driven(np.zeros(3))
        pivot = moved[:3] - a * B @ moved[3:]
        np.testing.assert_allclose(pivot, accelerated, atol=1e-12)
        np.testing.assert_allclose(found, -h * moved, atol=1e-12)


@pytest.mark.parametrize("calm", [0.0, 0.3, 1.0])
def test_a_share_of_the_gain_leaves_the_covariance_of_that_gain(calm):
    """Against Joseph's form, which holds for any gain; a whole share is the Kalman filter."""
    size, rng = error_state.FELT_BIAS.stop, np.random.default_rng(4)
    root, row, noise = rng.standard_normal((size, size)), np.zeros(size), 0.5
    row[:ERRORS] = rng.standard_normal(ERRORS)
    P = root @ root.T
    share = np.where(np.arange(size) < ERRORS, 1.0, calm)
    share[error_state.PULL] = 1 - calm
    gain = share * (P @ row) / (row @ P @ row + noise)
    reading = error_state.Reading(ca.SX(2.0), ca.SX(ca.DM(row[:ERRORS])).T, noise, ca.SX(1))
    error, after, _ = error_state.update(ca.SX(ca.DM(P)), [[reading]], ca.SX(0), calm)
    kept = np.eye(size) - np.outer(gain, row)
    np.testing.assert_allclose(np.asarray(ca.DM(error)).ravel(), 2.0 * gain, atol=1e-12)
    np.testing.assert_allclose(np.asarray(ca.DM(after)), kept @ P @ kept.T + noise * np.outer(gain, gain), atol=1e-10)


def test_a_covariance_of_the_start_is_that_of_its_errors():
    state, b = some_state(5)
    start = fp.Noise(x=0.02, x_dot=0.3, attitude=0.02, y=0.03, y_dot=0.4)
    s = fp.State.symbolic(ca.DM(state))
    B = error_state.frame(ca.DM(b), s.y)
    P = np.asarray(ca.DM(error_state.first_covariance(start, s, B, VEHICLE)))
    rng, errors = np.random.default_rng(0), []
    suite = SUITES["mocap"].replace(start=start)
    guess = as_numpy(sampled.first_estimate(suite))
    for draws in rng.standard_normal((4000, 18)):
        errors.append(error_of(guess(state, draws), state, b))
    found = np.cov(np.array(errors).T, bias=True)
    scale = np.sqrt(np.outer(np.diag(P), np.diag(P)))
    # Standard error of a covariance of 4,000: 1/√4000 = 0.016 of the scale; 91 entries; errors of 3 % of second order.
    assert np.max(np.abs(found - P) / scale) < 0.08


# What the sensors are expected to read ------------------------------------------------------------------------------

QUIET = Sensor(rate=500.0, noise=1e-9)
LATE = {name: Sensor(rate=173.0, noise=1e-3, latency=0.011) for name in ("position", "attitude", "rod", "rod_gyro")}
EVERYTHING = fp.Sensors(
    **LATE, gyro=Sensor(rate=500.0, noise=1e-2, latency=0.004), accelerometer=Sensor(rate=400.0, noise=0.1),
    joints=Sensor(rate=300.0, noise=1e-3, latency=0.001), start=fp.Noise(),
)  # fmt: skip


def without_noise(suite):
    """The same sensors with readings that are exact, as far as a noise must not be 0."""
    streams = {n: Sensor(rate=stream.rate, noise=1e-12, latency=stream.latency) for n, stream in suite.streams.items()}
    return suite.replace(**streams)


def flown(suite, seed, duration, wind=None, world=None, start=None, law=LAW):
    """A flight that records true states (n, 24), estimates (n, 24), and memories of the estimator.

    With other sensors in the `world` than the board believes, it begins without error; without a `start`, anywhere.
    """
    plant = Plant(sensors=suite, wind=wind, seed=seed)
    loop, period = Loop(VEHICLE, law, plant), 1 / plant.rate
    ticks = round(duration / period)
    start = (fp.State.random(np.random.default_rng(seed)) if start is None else start).packed()
    estimate = start if world is not None else sampled.estimate_at_start(plant, start)
    least = np.full(4, VEHICLE.rotor_limits[0])
    computer, engine = SteppedBoard(loop, least, estimate), EquationsEngine(VEHICLE)
    engine.reset(start, least)
    sense = as_numpy(sensing(world or suite, VEHICLE, period))
    memory = np.asarray(ca.DM(first_memory(suite, period, start))).ravel()
    draws = normals(seed, ticks, draws_size(suite))
    gust = np.random.default_rng(seed).standard_normal((ticks, 6)) * (0 if wind is None else 1)
    if wind is not None:
        gust *= np.repeat([wind.gust_on_vehicle, wind.gust_on_bob], 3)
    columns = ([], [], [])
    for k in range(ticks):
        memory, readings = sense(memory, k * period, engine.packed, draws[k])
        command = computer.command(k * period, readings)
        for column, value in zip(columns, (engine.packed, computer.estimated, computer.filtered), strict=True):
            column.append(np.array(value))
        engine.step(command, period, gust[k])
    return tuple(np.array(column) for column in columns)


@pytest.mark.parametrize(
    "suite", [slow(SUITES["mocap"]), SUITES["onboard"], EVERYTHING], ids=["mocap", "onboard", "all"]
)
def test_without_noise_and_errors_the_estimate_is_the_truth(suite):
    """Every expectation, latency and interpolation is right, or the estimate would leave the truth.

    So it is if the delay of the commands is told. While one is found, the forces are that much late.
    """
    truth, estimates, _ = flown(suite, 3, 1.5, world=without_noise(suite), law=TOLD)
    s, e = fp.State.trusted(truth), fp.State.trusted(estimates)
    # Readings between ticks are placed linearly in time: 15 m/s² · h²/8 = 8e-6 m, and 1e-4 rad of a turn. A gyroscope
    # 4 ms late turns the estimate by that much, which at 2 rad/s looks as if poses came 0.1 ms late: 5 m/s of that.
    assert np.max(np.abs(s.x - e.x)) < (5e-4 if suite is EVERYTHING else 1e-4)
    assert np.max(np.abs(s.y - e.y)) < 1e-3
    # It also looks like a moment that the model lacks, which the trim then adds and the estimate does not expect.
    assert np.max(np.abs(s.R - e.R)) < (2e-3 if suite is EVERYTHING else 1e-3)
    assert np.max(np.abs(s.omega - e.omega)) < 5e-2  # a gyroscope 4 ms late, through rotor moments of 200 rad/s²


def moved_back(packed, age):
    """The state (24,) `age` seconds before, if pivot and rod moved on straight lines and nothing turned."""
    s = fp.State.trusted(packed)
    y = s.y - age * s.y_dot
    y_dot = s.y_dot - y * (y @ s.y_dot) / (y @ y)
    x, y = s.x - age * s.x_dot, y / np.linalg.norm(y)
    return fp.State(x=x, x_dot=s.x_dot, R=s.R, omega=s.omega, y=y, y_dot=y_dot).packed()


def test_the_frame_that_errors_are_carried_to_is_tangent_to_the_rod_of_then():
    suite = fp.Sensors(position=QUIET, attitude=QUIET, rod=QUIET, gyro=QUIET)
    readings, packed, tangent = ca.SX.sym("r", readings_record(suite).length), ca.SX.sym("s", 24), ca.SX.sym("b", 3)
    history, estimate = History(dict.fromkeys(QUANTITIES, 0), 0.002), fp.State.symbolic(packed)
    expected = Expected(suite, history, readings, estimate, tangent, ca.SX.eye(3), ca.SX(0, 1))
    y, B = expected._rod_at(0.05)
    state, b = some_state(8)
    basis = np.asarray(ca.Function("f", [packed, tangent], [ca.horzcat(B, y)])(state, b))
    np.testing.assert_allclose(basis.T @ basis, np.eye(3), atol=1e-12)
    assert np.linalg.norm(basis[:, 2] - state[18:21]) > 0.05  # the rod has turned


@pytest.mark.parametrize(
    ("age", "at_rest", "tolerance"),
    [
        (0.0, False, 1e-3),  # the size of the error
        (0.004, False, 0.05),  # of first order in the age: |ẏ| a is 1 %
        (0.2, True, 1e-4),  # the size of the error: what the age multiplies stands out
    ],
    ids=["now", "late", "rod at rest, very late"],
)
def test_sensitivities_are_those_of_the_sensors(age, at_rest, tolerance):
    """The rows of every stream, against readings of a state that is wrong by a small error."""
    suite = fp.Sensors(**dict.fromkeys(("position", "attitude", "rod", "joints", "rod_gyro"), QUIET), gyro=QUIET)
    history = History(dict.fromkeys(QUANTITIES, 0), 0.002)  # nothing but straight lines
    packed, tangent, readings = ca.SX.sym("s", 24), ca.SX.sym("b", 3), ca.SX.sym("r", readings_record(suite).length)
    estimate = fp.State.symbolic(packed)
    streams = Expected(suite, history, readings, estimate, tangent, ca.SX.eye(3), ca.SX(0, 1)).readings(VEHICLE)
    rows = [row for stream in streams for row in stream]
    differences = ca.Function("f", [packed, tangent, readings], [ca.vertcat(*(row.difference for row in rows))])
    sensitivities = ca.Function("f", [packed, tangent, readings], [ca.vertcat(*(row.row for row in rows))])
    sense = as_numpy(sensing(suite, VEHICLE, 0.002))
    (state, b), size = some_state(8), 1e-5
    if at_rest:
        state = np.append(state[:21], np.zeros(3))

    def read(truth):
        then = moved_back(truth, age)
        memory = np.asarray(ca.DM(first_memory(suite, 0.002, then))).ravel()
        found = sense(memory, 0.002, then, np.zeros(draws_size(suite)))[1]
        found[np.cumsum([WIDTH[name] + 1 for name in suite.streams]) - 1] = age
        return found

    right = np.asarray(differences(state, b, read(state))).ravel()
    rows_found = np.asarray(sensitivities(state, b, read(state)))
    for i, unit in enumerate(np.eye(ERRORS)):
        moved = np.asarray(differences(state, b, read(wrong_by(state, b, size * unit)))).ravel()
        np.testing.assert_allclose((moved - right) / size, rows_found[:, i], atol=tolerance)


@pytest.mark.parametrize("seed", range(4))
def test_the_accelerometer_tells_the_force_that_accelerates_the_vehicle_so(seed):
    """Against the motion with a force on the vehicle and without it."""
    suite = fp.Sensors(position=QUIET, attitude=QUIET, rod=QUIET, gyro=QUIET, accelerometer=QUIET)
    history = Filter(Loop(VEHICLE, LAW, Plant(sensors=suite)), Nominal(VEHICLE)).history
    state, rng = fp.State.random(np.random.default_rng(seed)), np.random.default_rng(seed + 10)
    wrench, force = fp.Wrench(rng.uniform(0, 10), np.zeros(3)), rng.standard_normal(3)  # body frame

    def acceleration(on_vehicle):
        motion = disturbed_motion(state, wrench, VEHICLE, "up", Disturbance(on_vehicle, np.zeros(3)))
        return motion.x_ddot

    felt = state.R.T @ (acceleration(state.R @ force) - acceleration(np.zeros(3)))
    given = []
    for name in suite.streams:
        given += [*(felt if name == "accelerometer" else np.zeros(WIDTH[name])), 0.0]
    past = ca.DM.zeros(history.record.length)  # nothing was expected
    estimate = fp.State.symbolic(ca.DM(state.packed()))
    expected = Expected(suite, history, ca.DM(given), estimate, ca.DM.zeros(3), ca.DM.eye(3), past)
    found = np.asarray(ca.DM(expected.felt(np.zeros(3), VEHICLE)[1])).ravel()
    np.testing.assert_allclose(found, force, atol=1e-10)


# What lasts ---------------------------------------------------------------------------------------------------------


def test_a_manoeuvre_tells_a_scale_of_the_thrust_from_a_force():
    """Thrust that is 15 % weak, and a wind: both found within a second of changing thrust, each by its own."""
    suite, rng = SUITES["mocap"], np.random.default_rng(0)
    memory, thrust, fresh, told = (
        ca.SX.sym(n, k) for n, k in (("m", accelerometer.RECORD.length), ("f", 1), ("a", 1), ("d", 3))
    )
    after = accelerometer.correct(memory, fresh, told, thrust, 100.0, VEHICLE, suite, 0.002)
    step = as_numpy(ca.Function("f", [memory, fresh, told, thrust], [after]))
    known, scale, force = np.asarray(accelerometer.begin(VEHICLE)).ravel(), -0.15, np.array([0.3, -0.2, 0.4])
    noise = VEHICLE.M * suite.accelerometer.noise
    for k in range(500):
        f = 5.0 + 4.0 * np.sin(10 * k * 0.002)
        expected = accelerometer.beyond(ca.DM(known), f)
        difference = force + np.array([0, 0, scale * f]) - np.asarray(expected).ravel() + noise * rng.standard_normal(3)
        known = np.asarray(step(known, 1.0, difference, f)).ravel()
    # The force walks fast in a manoeuvre: 20 rad/s times 2e-3 s of noise, 0.1 N √(0.04/2) = 0.014 N, thrice.
    assert known[accelerometer.RECORD.place("scale")] == pytest.approx([scale], abs=0.02)
    np.testing.assert_allclose(known[:3], force, atol=0.1)


def test_a_wrong_body_is_left_out_and_a_true_jump_is_taken():
    """One stream of one number: what is far off is left out until it has come PATIENCE times."""
    row = ca.SX(1, ERRORS)
    row[0] = 1
    difference, P, rejected = ca.SX.sym("d"), 1e-6 * ca.SX.eye(ERRORS), ca.SX.sym("r")
    reading = error_state.Reading(difference, row, 1e-6, ca.SX(1))
    error, _, after = error_state.update(P, [[reading]], rejected)
    update = as_numpy(ca.Function("f", [difference, rejected], [error[0], after]))
    assert update(4e-3, 0.0)[0].item() == pytest.approx(2e-3)  # below five standard deviations of 1.4 mm
    count = 0.0
    for _ in range(error_state.PATIENCE):
        moved, count = (float(v.item()) for v in update(1.0, count))
        assert moved == 0
    assert update(1.0, count)[0].item() == pytest.approx(0.5)
    assert update(0.0, 1.0)[1].item() == 0  # a good reading makes up for a wrong one


@pytest.mark.parametrize(("name", "duration", "off"), [("mocap", 8.0, 0.005), slow("onboard", 15.0, 0.01)])
def test_a_bias_of_the_gyroscope_is_found(name, duration, off):
    """Within four time constants of its integral, as well as what the noise of the attitude leaves of it.

    On board what is about the vertical stays unknown: no sensor tells yaw.
    """
    bias = np.array([0.03, -0.02, 0.04])
    suite = SUITES[name]
    flight = flown(suite, 3, duration, world=suite.replace(gyro_bias=tuple(bias)))
    filtering = Filter(Loop(VEHICLE, LAW, Plant(sensors=suite)), Nominal(VEHICLE))
    found = np.array(filtering.record.split(flight[2][-1])["bias"]).ravel()
    kept = slice(None) if suite.attitude is not None else slice(2)
    np.testing.assert_allclose(found[kept], bias[kept], atol=off)


@pytest.mark.parametrize(("name", "duration"), [("mocap", 10.0), slow("onboard", 10.0)])
def test_a_bias_of_the_accelerometer_is_not_taken_for_a_force(name, duration):
    """In the end of a hover the mean distance is far below the 6 and 11 cm of an integral of forces alone."""
    plant = Plant(sensors=SUITES[name].replace(accelerometer_bias=(0.2, -0.2, 0.2)))
    hover, late = (
        fp.State(x=np.zeros((8, 3)), y=np.tile([0.0, 0.0, 1.0], (8, 1))),
        np.arange(duration - 2, duration, 0.1),
    )
    flown = fp.simulate_ensemble(VEHICLE, LAW, hover, duration, plant=plant, times=late).samples
    assert np.linalg.norm(np.mean(flown.x, axis=(0, 1))) < 0.02


# What it claims -----------------------------------------------------------------------------------------------------


def normalised(suite, flights, duration, density):
    """Normalised squared errors (flights, instants) in a world that is as uncertain as the filter believes."""
    suite = suite.replace(force_error=density, manoeuvre_error=0.0)
    kick = density * np.sqrt(500.0)  # of each control period, m/s²
    wind = Wind(gust_on_vehicle=kick * VEHICLE.M, gust_on_bob=kick * VEHICLE.m)
    return np.array([squared(suite, flown(suite, 100 + seed, duration, wind)) for seed in range(flights)])


def squared(suite, records, kept=slice(None)):
    """Normalised squared errors, of the numbers `kept`, of the `records` of a flight, every 0.2 s."""
    filtering = Filter(Loop(VEHICLE, LAW, Plant(sensors=suite)), Nominal(VEHICLE))
    found = []
    for truth, estimate, memory in list(zip(*records, strict=True))[100::100]:
        parts, P = filtering.record.split(memory), np.zeros((ERRORS, ERRORS))
        lower = np.tril_indices(ERRORS)
        P[lower] = parts["covariance"][: len(lower[0])]  # after them, a bias if there is one
        error = error_of(truth, estimate, np.asarray(parts["frame"]))
        P = (P + np.tril(P, -1).T)[kept][:, kept]
        found.append(error[kept] @ np.linalg.solve(P, error[kept]))
    return found


# Of what it claims, the share that errors are short of: on board, the accelerometer tells more than is counted.
SHORT = {"mocap": 0.1, "onboard": 0.5}


def check_consistent(found, short):
    """A χ² with 13 degrees of freedom has mean 13. Errors last, so what is independent are flights, not instants.

    By the median and the median deviation of flights: in a few, what the thrust lacks exceeds the scale believed.
    """
    means = np.mean(found, axis=1)
    deviation = 1.4826 * np.median(np.abs(means - np.median(means)))
    bound = 3 * np.sqrt(np.pi / 2) * deviation / np.sqrt(len(means))
    assert bound < ERRORS / 3  # or a single flight would hide that the claim is wrong
    assert -bound - short * ERRORS < np.median(means) - ERRORS < bound, (np.median(means), bound)


@pytest.fixture
def known_rod(monkeypatch):
    """These flights have the believed rod; a filter that doubted its length would claim larger errors."""
    monkeypatch.setattr(error_state, "PULL_PRIOR", 1e-4)
    monkeypatch.setattr(error_state, "PULL_WALK", 0.0)


@pytest.mark.usefixtures("known_rod")
@pytest.mark.parametrize("name", ["mocap", slow("onboard")])
def test_errors_are_as_large_as_it_claims(name):
    check_consistent(normalised(SUITES[name], 12, 1.6, density=0.1), SHORT[name])


@pytest.mark.slow
@pytest.mark.usefixtures("known_rod")
@pytest.mark.parametrize("name", ["mocap", "onboard"])
def test_errors_are_as_large_as_it_claims_in_many_flights(name):
    """By the median: in a few flights what the thrust lacks exceeds the scale that the filter believes."""
    median = np.median(np.mean(normalised(SUITES[name], 60, 4.0, density=0.1), axis=1))
    assert (1 - SHORT[name]) * ERRORS < median < 1.1 * ERRORS, median


def test_a_nominal_rod_is_pulled_as_one_of_another_length():
    """By a pair of forces, so that nothing else moves; against the motion of a vehicle with that rod."""
    pull, filtering = 0.15, Filter(Loop(VEHICLE, LAW, Plant(sensors=SUITES["mocap"])), Nominal(VEHICLE))
    state, rotors, outside = some_state(6)[0], np.array([1.0, 1.5, 0.7, 1.1]), 0.1 * np.arange(6.0)
    memory = np.zeros(filtering.record.length)
    for name, value in (("state", state), ("rotors", rotors), ("pull", pull)):
        memory[filtering.record.place(name)] = value
    forces = np.asarray(filtering._pull()(memory, outside, [])).ravel()
    np.testing.assert_allclose(forces[:3] + forces[3:], outside[:3] + outside[3:], atol=1e-12)
    s, wrench = fp.State.from_packed(state), fp.Wrench(rotors.sum(), np.zeros(3))
    swung = [
        disturbed_motion(s, wrench, vehicle, "up", Disturbance(given[:3], given[3:])).y_ddot
        for vehicle, given in (
            (VEHICLE, forces),
            (VEHICLE.replace(rod_length=VEHICLE.rod_length / (1 + pull), rod_end=None), outside),
        )
    ]
    np.testing.assert_allclose(*swung, atol=1e-9)


@pytest.mark.parametrize("ratio", [0.85, 1.0, 1.15])
def test_a_rod_of_another_length_is_found(ratio):
    """Within four of its standard deviations, and within 3 %, in three seconds."""
    plant = ROTORS.replace(sensors="mocap", mismatch={"rod_length": ratio}, seed=5)
    log = []

    class Spy(SteppedBoard):
        def command(self, t, measured):
            answer = super().command(t, measured)
            log.append(np.array(self.filtered))
            return answer

    start = fp.State.random(np.random.default_rng(8))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sampled, "SteppedBoard", Spy)
        sampled.fly_stepwise(Flight(vehicle=VEHICLE, law=LAW, starts=start, duration=3.0, plant=plant, seed=1))
    parts = Filter(Loop(VEHICLE, LAW, plant), Nominal(VEHICLE), finds=True).record.split(log[-1])
    place = error_state.PULL.start
    doubt = np.sqrt(parts["covariance"][place * (place + 1) // 2 + place])
    wrong = abs(parts["pull"] - (1 / ratio - 1))
    assert doubt < 0.02
    assert wrong < min(4 * doubt, 0.03)


# A rod that swings faster than believed: on rotors 15 % weak under a heavy vehicle, and 15 % strong under a light one,
# whose rotors lag.
CORNERS = {"hehn2011": (1.2, 0.85), "crazyflie": (0.8, 1.15)}


def stand(name):
    """How many of 24 flights of the machine in its corner stand, with 20 ms of untold delay."""
    mass, strength = CORNERS[name]
    sensors = SUITES["mocap"].replace(command_delay=0.0)
    mismatch = {"mass": mass, "bob_mass": mass, "rod_length": 0.85}
    plant = ROTORS.replace(sensors=sensors, delay=0.02, strength=strength, mismatch=mismatch, seed=3)
    runs = fp.simulate_ensemble(fp.vehicle(name), fp.laws.inverted(), fp.random_starts(24, 61), 20.0, plant=plant)
    return int(runs.success.sum())


@pytest.mark.parametrize("name", few(["crazyflie"], CORNERS))
def test_a_machine_with_every_error_at_a_bound_stands(name):
    assert stand(name) >= 23


@pytest.mark.slow
@pytest.mark.usefixtures("known_rod")
def test_a_rod_held_for_known_falls():
    """Negative control of the test above."""
    assert stand("crazyflie") <= 12


@pytest.mark.parametrize("name", [slow("mocap"), "onboard"])
def test_a_world_as_the_model_has_it_is_not_claimed_to_be_known_better(name):
    """The filter expects forces that this world lacks: its errors are no larger than it claims."""
    found = np.array([squared(SUITES[name], flown(SUITES[name], seed, 1.6)) for seed in range(6)])
    assert np.mean(found) < ERRORS + 3 * np.sqrt(26 / found.size)
    assert np.mean(found) > ERRORS / 3  # and not so much smaller that the claim says nothing


def test_noise_of_an_accelerometer_is_not_put_down_to_the_world():
    """In a long hover, what it feels pushes the estimate about: the filter has to know."""
    suite, all_but_yaw = SUITES["onboard"], [i for i in range(ERRORS) if i != 8]
    hover = fp.State(y=(0.0, 0.0, 1.0))
    found = [squared(suite, flown(suite, seed, 6.0, start=hover), all_but_yaw)[15:] for seed in range(4)]
    # Errors of attitude and rod last for seconds: over eight flights, the means of flights scatter by 7, and by √24 if
    # each were one instant. So each flight counts as one.
    assert np.mean(found) < 12 + 3 * np.sqrt(24 / 4)  # without its noise in the model: 107


def test_a_filter_that_trusts_its_sensors_too_much_is_found_out():
    """Negative control of the test above: poses twice as noisy as the filter believes."""
    world = SUITES["mocap"]
    half = {n: Sensor(rate=s.rate, latency=s.latency, noise=s.noise / 2) for n, s in world.streams.items()}
    nominal = world.replace(**half)
    found = squared(nominal, flown(nominal, 7, 1.6, world=world))
    assert np.mean(found) > ERRORS + 3 * np.sqrt(26 / len(found))


def test_a_steady_gain_solves_its_riccati_equation():
    for wander, noise in ((1e-3, 4e-4), (1.0, 1.0), (1e-6, 1.0)):
        gain = steady_gain(wander, noise)
        after = 1.0
        for _ in range(20_000):
            before = after + wander
            after = before * noise / (before + noise)
        assert gain == pytest.approx((after + wander) / (after + wander + noise), rel=1e-9)


def test_a_pivot_beside_the_centre_of_mass_does_not_mislead_the_accelerometer():
    """With readings of the pivot's acceleration, one start in ten succeeds."""
    plant = Plant(sensors="onboard", pivot_offset=(0.0, 0.0, 0.05))
    assert fp.simulate_ensemble(VEHICLE, LAW, fp.random_starts(20, 2), 12.0, plant=plant).rate > 0.8


# One source ---------------------------------------------------------------------------------------------------------

BOARDS = {
    "mocap": Plant(sensors="mocap"),
    "onboard": Plant(sensors="onboard", rate=400.0, pivot_offset=(0.01, 0.0, 0.05)),
    "all": Plant(sensors=EVERYTHING, delay=0.003),
    "rates": Plant(sensors="mocap", interface="rates", rate=50.0, delay=0.03),
    "differenced": Plant(sensors=SUITES["mocap"].replace(rates="differenced")),
}


@pytest.mark.parametrize("name", few(("mocap", "all", "differenced"), BOARDS))
def test_one_step_of_the_program_is_its_stages_one_after_the_other(name):
    around = fp.laws.inverted(references.circle(radius=0.5, rate=2.0)).bind(VEHICLE)  # it matters when commands act
    loop, rng = Loop(VEHICLE, around, BOARDS[name]), np.random.default_rng(3)
    least, start = np.full(4, VEHICLE.rotor_limits[0]), fp.State.random(rng).packed()
    stepped, made = SteppedBoard(loop, least, start), board(loop)
    step, memory = as_numpy(made), initial_memory(loop, least, start)
    assert len(memory) == made.numel_in(0)
    suite, period = BOARDS[name].sensors, 1 / BOARDS[name].rate
    sense = as_numpy(sensing(suite, VEHICLE, period))
    seen = np.asarray(ca.DM(first_memory(suite, period, start))).ravel()
    for k in range(30):
        seen, readings = sense(seen, k * period, start, rng.standard_normal(draws_size(suite)))
        command = stepped.command(k * period, readings)
        memory, given = step(memory, np.append(k * period, readings), NONE, NONE, NONE)
        np.testing.assert_allclose(given, command, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "engine"),
    [
        ("mocap", "equations"),
        ("onboard", "mujoco"),
        ("differenced", "equations"),
        *(slow(name, "equations") for name in ("onboard", "all", "rates")),
        *(slow(name, "mujoco") for name in ("mocap", "all", "rates", "differenced")),
    ],
)
def test_a_kernel_flies_what_the_python_reference_flies(name, engine):
    if engine == "mujoco":
        pytest.importorskip("mujoco")
    plant = BOARDS[name].replace(engine=engine, wind=Wind(on_vehicle=(0.1, 0, 0), gust_on_vehicle=0.1))
    starts, duration = fp.State.random(np.random.default_rng(4), 2), 0.4
    ticks = sampled.number_of_ticks(duration, plant)
    flown_ = sampled_kernel(Loop(VEHICLE, LAW, plant), fp.Criterion()).fly(
        starts.packed(), duration, judge_at=[ticks], first_seed=5
    )
    for i in range(2):
        flight = Flight(vehicle=VEHICLE, law=LAW, starts=starts[i], duration=duration, plant=plant, seed=5 + i)
        reference = sampled.fly_stepwise(flight).packed[-1]
        # Order of operations only; a closed loop over 200 ticks, in which angles of steps of a joint may round over.
        np.testing.assert_allclose(flown_.final[i], reference, rtol=1e-6, atol=1e-6)
