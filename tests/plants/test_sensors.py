"""Sensors as data, and what reaches the flight computer of them: instants, latencies, noise, losses, steps."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.plants import SUITES, Plant, Sensor, Sensors
from flypend.plants.equations import EquationsEngine
from flypend.plants.schedule import timing
from flypend.plants.sensing import WIDTH, draws_of, draws_size, first_memory, sensing
from flypend.plants.sensors import sensors_called

VEHICLE = fp.vehicle("hehn2011")
GYRO = Sensor(rate=500.0, noise=1e-2)


def sensors(**streams):
    given = {"position": Sensor(rate=500.0, noise=1e-3), "rod": Sensor(rate=500.0, noise=1e-3), "gyro": GYRO}
    return Sensors(**given | streams)


def flown(ticks, period, steps=50, vehicle=VEHICLE):
    """A tumbling vehicle under constant rotor forces, in fine steps: packed states (ticks · steps + 1, 24)."""
    engine = EquationsEngine(vehicle)
    start = fp.State(x_dot=(1, -0.5, 0.3), omega=(2, -3, 1), y=(0.6, 0, 0.8), y_dot=(0.8, 1, -0.6))
    engine.reset(start.packed(), np.array([1.0, 1.2, 1.4, 1.1]))
    states = [engine.packed]
    for _ in range(ticks * steps):
        engine.step(np.array([1.3, 1.2, 1.6, 1.5]), period / steps, np.zeros(6))
        states.append(engine.packed)
    return np.array(states)


def read(suite, states, period, steps=50, draws=None, vehicle=VEHICLE):
    """What is delivered at each tick, by stream: numbers, and ages (s)."""
    sense = as_numpy(sensing(suite, vehicle, period))
    memory = np.asarray(ca.DM(first_memory(suite, period, states[0]))).ravel()
    found = []
    for k, packed in enumerate(states[::steps]):
        drawn = np.full(draws_size(suite), 0.0) if draws is None else draws[k]
        memory, readings = sense(memory, k * period, packed, drawn)
        found.append(readings)
    table, columns, place = np.array(found), {}, 0
    for name in suite.streams:
        columns[name] = table[:, place : place + WIDTH[name]], table[:, place + WIDTH[name]]
        place += WIDTH[name] + 1
    return columns


@pytest.mark.parametrize(
    ("rate", "latency"), [(200.0, 0.01), (500.0, 0.0), (100.0, 0.003), (173.0, 0.0117), (1000.0, 0.005)]
)
def test_a_reading_is_the_state_at_its_own_instant(rate, latency):
    period, steps = 0.002, 50
    stream = Sensor(rate=rate, noise=1e-9, latency=latency)
    suite = sensors(position=stream, attitude=stream, rod=stream, gyro=Sensor(rate=rate, noise=1e-9, latency=latency))
    states = flown(100, period, steps)
    columns = read(suite, states, period, steps)
    truth = fp.State.trusted(states)
    for name, true, tolerance in (
        # Cubic in time between states 2 ms apart, of which the fourth derivative is left out; rates are linear there.
        ("position", truth.x, 1e-6),
        ("rod", truth.y, 1e-6),
        ("attitude", truth.R.reshape(-1, 9), 2e-5),
        ("gyro", truth.omega, 2e-3),
    ):
        values, ages = columns[name]
        fresh = np.flatnonzero(ages >= 0)
        taken = fresh * period - ages[fresh]
        # Every reading is taken at a multiple of the sensor's period, or the newest of several in a control period.
        np.testing.assert_allclose(taken * rate, np.rint(taken * rate), atol=1e-4)
        arrived = taken + latency
        assert np.all(arrived <= fresh * period + 1e-8)
        assert np.all(arrived > (fresh - 1) * period - 1e-8)
        assert len(fresh) == pytest.approx(min(rate, 1 / period) * (len(ages) * period - latency), abs=2)
        at = np.array(
            [[np.interp(t, np.arange(len(true)) * period / steps, column) for column in true.T] for t in taken]
        )
        np.testing.assert_allclose(values[fresh], at, atol=tolerance)
        assert timing(suite.streams[name], period).oldest * period >= ages.max() - 1e-9


@pytest.mark.parametrize("offset", [(0.0, 0.0, 0.0), (0.01, -0.02, 0.05)])
def test_an_accelerometer_feels_everything_but_gravity(offset):
    """At the centre of mass, wherever the pivot is."""
    period, steps, vehicle = 0.002, 50, VEHICLE.replace(pivot_offset=offset)
    states, suite = flown(60, period, steps, vehicle), sensors(accelerometer=Sensor(rate=500.0, noise=1e-9))
    values, ages = read(suite, states, period, steps, vehicle=vehicle)["accelerometer"]
    fine = period / steps
    arm = fp.State.trusted(states).R @ offset
    velocity = states[:, 3:6] - np.gradient(arm, fine, axis=0, edge_order=2)
    force = np.diff(velocity, axis=0) / fine + [0, 0, VEHICLE.g]
    body = np.einsum("nji,nj->ni", fp.State.trusted(states[:-1]).R, force)
    mean = body.reshape(-1, steps, 3).mean(axis=1)
    assert ages[0] < 0  # no period has passed
    # The chord of the attitude instead of its mean: (ω h)²/24 of 15 m/s².
    np.testing.assert_allclose(values[1:], mean, atol=1e-3)


def test_joint_angles_come_in_steps():
    step = 2 * np.pi / 64
    states = flown(50, 0.002)[::50]
    suite = sensors(joints=Sensor(rate=500.0, quantisation=step))
    values, _ = read(suite, states, 0.002, steps=1)["joints"]
    roll, pitch = np.arctan2(-values[:, 1], values[:, 2]), np.arcsin(values[:, 0])
    np.testing.assert_allclose(roll / step, np.rint(roll / step), atol=1e-9)
    np.testing.assert_allclose(pitch / step, np.rint(pitch / step), atol=1e-9)
    truth = fp.State.trusted(states)
    seen = np.einsum("nji,nj->ni", truth.R, truth.y)
    off = np.linalg.norm(values - seen, axis=1)
    assert np.max(off) <= step / np.sqrt(2) + 1e-12
    assert np.max(off) > step / 4


def test_noise_and_losses_are_those_that_were_asked_for():
    rng, ticks = np.random.default_rng(1), 8000
    stream = Sensor(rate=500.0, noise=0.02, dropouts=0.3)
    suite = sensors(position=stream, attitude=stream, rod=stream, gyro=stream, accelerometer=stream, rod_gyro=stream)
    state = fp.State.random(rng).packed()
    states = np.tile(state, (ticks, 1))
    columns = read(suite, states, 0.002, steps=1, draws=rng.standard_normal((ticks, draws_size(suite))))
    truth = fp.State.trusted(state)
    for name, true in (("position", truth.x), ("gyro", truth.omega), ("rod", truth.y)):
        values, ages = columns[name]
        fresh = ages >= 0
        # Four standard deviations of a share of 0.3 in 8000.
        assert np.mean(fresh) == pytest.approx(0.7, abs=4 * np.sqrt(0.21 / ticks))
        error = values[fresh] - true
        across = 2 if name == "rod" else 3
        spread = np.sqrt(np.sum(error**2, axis=1).mean() / across)
        assert spread == pytest.approx(0.02, rel=0.04)
    values, ages = columns["attitude"]
    turn = values[ages >= 0].reshape(-1, 3, 3) @ truth.R.T
    angle = np.arccos(np.clip((np.trace(turn, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert np.sqrt(np.mean(angle**2) / 3) == pytest.approx(0.02, rel=0.04)


def test_streams_share_no_random_number_and_leave_those_of_gusts():
    for suite in (
        SUITES["mocap"],
        SUITES["onboard"],
        sensors(joints=GYRO.__class__(rate=1.0, noise=1.0, dropouts=0.1)),
    ):
        used = [i for noise, lost in draws_of(suite).values() for i in (*noise, *([] if lost is None else [lost]))]
        assert len(set(used)) == len(used)
        assert not set(used) & set(range(18, 24))


def test_suites_have_the_numbers_that_their_names_promise():
    mocap = SUITES["mocap"]
    for stream, noise in ((mocap.position, 1e-3), (mocap.attitude, 3.5e-3), (mocap.rod, 3.5e-3)):
        assert (stream.rate, stream.noise, stream.latency) == (200.0, noise, 0.01)
    assert mocap.gyro.rate == 500.0
    onboard = SUITES["onboard"]
    assert set(onboard.streams) == {"position", "gyro", "accelerometer", "joints"}
    assert (onboard.position.rate, onboard.joints.rate) == (100.0, 500.0)
    assert onboard.joints.quantisation > 0
    assert Plant(sensors="perfect") == Plant()
    assert Plant(sensors="mocap") == Plant(sensors=mocap)


def test_a_table_is_put_on_top_of_a_suite_and_comes_back_from_one():
    given = sensors_called({"base": "mocap", "position": {"rate": 100.0}, "force_error": 0.01})
    assert given.position == Sensor(rate=100.0, noise=1e-3, latency=0.01)
    assert given.rod == SUITES["mocap"].rod
    for suite in (given, SUITES["onboard"]):
        assert Sensors(**suite.to_dict()) == suite


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: Plant(sensors="mocup"), "mocap"),
        (lambda: Plant(sensors=3), "suite"),
        (lambda: Plant(sensors="mocap", noise=fp.Noise(x=1.0)), "plant.noise"),
        (lambda: sensors(gyro=None), "sensors.gyro"),
        (lambda: sensors(rod=None), "sensors.rod"),
        (lambda: sensors(rod=Sensor(rate=0.0, noise=1.0)), "rate"),
        (lambda: sensors(rod=Sensor(rate=10.0)), "noise"),
        (lambda: sensors(rod=Sensor(rate=10.0, noise=1.0, quantisation=1.0)), "direction"),
        (lambda: sensors(rod=Sensor(rate=10.0, noise=1.0, dropouts=1.0)), "probability"),
        (lambda: sensors(rod=Sensor(rate=10.0, noise=1.0, latency=2.0)), "latency"),
        (lambda: sensors(rates="guessed"), "estimated"),
        (lambda: sensors(rates="differenced"), "attitude"),
        (lambda: sensors_called({"base": "mocap", "postion": {}}), "position"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(make, told):
    with pytest.raises(InputError, match=told) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_noisier_sensors_are_so_in_noise_only():
    twice = SUITES["onboard"].noisier(2.0)
    for name, stream in SUITES["onboard"].streams.items():
        there = getattr(twice, name)
        assert there.noise == 2 * stream.noise
        assert (there.rate, there.latency, there.quantisation) == (stream.rate, stream.latency, stream.quantisation)
