"""The filter's equations: derivatives against differences, and the rotors' forces against the plant's own steps."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.identification.manoeuvre import _specific_force, rehearse
from flypend.identification.model import (
    ERROR,
    LOCAL,
    MOVING,
    READING,
    correct,
    local_error,
    moves,
    places,
    reads,
    sizes,
)
from flypend.identification.rotors import patterns, rotor_forces, rotor_slopes, rotor_table
from flypend.model.rod import stretch
from flypend.plants.actuation import make_engine

VEHICLE = fp.vehicle("hehn2011")
STEP = 4e-3


@pytest.fixture(scope="module")
def case():
    """A tumbling state with gusts, and numbers of which none is zero."""
    rng = np.random.default_rng(3)
    moving = np.r_[0.55, 0.06, 3.1e-3, 3.4e-3, 5e-3, 0.017, 3e-3, -2e-3, 1e-2, 0.04, 0.08, 0.1, -0.2]
    reading = np.r_[0.003, rng.normal(size=9) * 0.02]
    return fp.State.random(rng).packed(), rng.normal(size=6) * 0.2, rng.uniform(1, 2, 4), moving, reading


def local():
    at, packed, error = ca.SX.sym("a", 24), ca.SX.sym("s", 24), ca.SX.sym("e", ERROR)
    apart = ca.Function("apart", [at, packed], [local_error(at, packed)])
    move = ca.Function("move", [packed, error], [correct(packed, error)])
    return (lambda a, s: np.array(apart(a, s)).ravel()), (lambda s, e: np.array(move(s, e)).ravel())


@pytest.mark.parametrize("changes", [{}, {"rod_inertia": 0.005, "pivot_offset": (0.03, -0.02, 0.01)}])
def test_the_step_is_that_of_the_plant(changes):
    """Also of a rod off the centre of mass, part of whose mass stays at the pivot, and from a guess of another."""
    vehicle = VEHICLE.replace(**changes)
    move = moves(vehicle.replace(**stretch(vehicle, 1.2, 0.9)))
    s, gusts = fp.State.random(np.random.default_rng(1)).packed(), np.array([0.3, -0.2, 0.1, 0.02, -0.05, 0.03])
    forces = np.array([1.0, 1.3, 1.1, 1.4])
    known = np.r_[vehicle.rod_length, vehicle.bob_mass, np.diag(vehicle.inertia), vehicle.drag_ratio]
    known = np.r_[known, vehicle.pivot_offset, 0.0, vehicle.air.inflow, np.zeros(2)]
    after, *_ = move(s, gusts, np.zeros(LOCAL), forces, 0 * forces, 1e-3, 1.0, known)
    engine = make_engine(vehicle.replace(rotor_lag=0.0), fp.Plant(air=("inflow", "lift", "body_drag")))
    engine.reset(s, forces)
    engine.step(forces, 1e-3, gusts)
    assert np.abs(after - engine.packed).max() < 1e-9  # two integrators of order 4, over a millisecond


@pytest.mark.parametrize("h", [STEP, STEP / 10])
def test_derivatives_of_a_step_are_those_of_its_differences(case, h):
    """Those by numbers to first order: that by the inflow, which acts by ω, is 18 % off over the longer of the steps.

    There ω changes by 0.1 rad/s; over the shorter it is within the bound that holds for all others over both.
    """
    s, gusts, forces, moving, _ = case
    apart, move = local()
    step = moves(VEHICLE)

    def after(error=0.0, m=moving, f=forces):
        e = error + np.zeros(LOCAL)
        return step(move(s, e[:ERROR]), gusts + e[ERROR:], np.zeros(LOCAL), f, 0 * f, h, 1.0, m)[0]

    middle = after()
    by = step(s, gusts, np.zeros(LOCAL), forces, 0 * forces, h, 1.0, moving)[2].reshape(-1, ERROR).T
    A = np.zeros((LOCAL, LOCAL))
    A[:ERROR] = by[:, :LOCAL]
    F = np.eye(LOCAL) + h * A + h**2 / 2 * A @ A
    B = h * (np.eye(ERROR) + h / 2 * A[:ERROR, :ERROR]) @ by[:, LOCAL:]
    rows = np.r_[0:12]  # the rod's are compared across it below
    for i in np.r_[0:12, 18:24]:
        d = 1e-5 * np.eye(LOCAL)[i]
        found = (apart(middle, after(d)) - apart(middle, after(-d))) / 2e-5
        assert found[rows] == pytest.approx(F[rows, i], abs=3e-4), i  # (h |A|)³/6, |A| = 30 1/s in a tumble
    across = np.eye(3) - np.outer(middle[18:21], middle[18:21])
    for i, size in enumerate(np.r_[moving, forces]):
        d = 1e-5 * np.maximum(abs(size), 1e-3) * np.eye(len(moving) + 4)[i]
        high, low = (after(m=moving + sign * d[:-4], f=forces + sign * d[-4:]) for sign in (1, -1))
        found = (apart(middle, high) - apart(middle, low)) / (2 * d[i])
        scale = np.abs(found).max()
        most = 0.2 if h == STEP and i == places(MOVING)["inflow"].start else 0.02  # first order; h |A| = 0.1 at most
        assert np.abs(found[rows] - B[rows, i]).max() < most * scale, i
        assert np.abs(across @ (found - B[:, i])[12:15]).max() < 0.02 * scale, i


def test_derivatives_of_readings_are_those_of_their_differences(case):
    s, gusts, forces, moving, reading = case
    _, move = local()
    read = reads(VEHICLE, (0.02, -0.01, 0.03))

    def local_of(z, at):
        turned = at[3:12].reshape(3, 3).T @ z[3:12].reshape(3, 3)
        return np.r_[z[:3] - at[:3], turned[2, 1], turned[0, 2], turned[1, 0], z[12:] - at[12:]]

    def seen(error=0.0, m=moving, r=reading, f=forces):
        e = error + np.zeros(LOCAL)
        return read(move(s, e[:ERROR]), gusts + e[ERROR:], f, 0.002, m, r)[0]

    at = seen()
    H = read(s, gusts, forces, 0.002, moving, reading)[1].reshape(-1, 15).T
    begin = LOCAL
    for count, change in (
        (LOCAL, lambda d: seen(d)), (len(moving), lambda d: seen(m=moving + d)),
        (4, lambda d: seen(f=forces + d)), (len(reading), lambda d: seen(r=reading + d)),
    ):  # fmt: skip
        columns = slice(0, LOCAL) if count == LOCAL else slice(begin, begin + count)
        for i in range(count):
            if count == LOCAL and i in range(12, 18):
                continue  # the rod keeps its length
            d = 1e-6 * np.eye(count)[i]
            found = (local_of(change(d), at) - local_of(change(-d), at)) / 2e-6
            assert found == pytest.approx(H[:, columns][:, i], rel=1e-4, abs=1e-5), (count, i)
        begin += 0 if count == LOCAL else count
    assert begin == H.shape[1] == LOCAL + sizes(MOVING) + 4 + sizes(READING)


def test_the_accelerometer_feels_what_the_centre_of_mass_does(case):
    """By differences of its velocity over a step; at the pivot, 1 cm off, a tumble feels another force."""
    s, gusts, forces, moving, reading = case
    s = np.array([*s[:15], 6.0, -4.0, 5.0, *s[18:]])  # ω, rad/s: at 1 cm, 0.8 m/s² towards the centre
    h, offset = 1e-5, moving[6:9]
    after = moves(VEHICLE)(s, gusts, np.zeros(LOCAL), forces, 0 * forces, h, 1.0, moving)[0]
    before, now = (fp.State.trusted(packed) for packed in (s, after))
    velocity = [state.x_dot - state.R @ np.cross(state.omega, offset) for state in (before, now)]
    felt = before.R.T @ ((velocity[1] - velocity[0]) / h + [0, 0, VEHICLE.gravity])
    read = reads(VEHICLE, (0.0, 0.0, 0.0))(s, gusts, forces, 0.0, moving, reading)[0][15:18] - reading[4:7]
    assert read == pytest.approx(felt, abs=0.02)  # the force changes by 1e3 m/s³ or so, over 10 µs
    at_pivot = before.R.T @ ((now.x_dot - before.x_dot) / h + [0, 0, VEHICLE.gravity])
    assert np.abs(read - at_pivot).max() > 0.2


NUMBERS = {
    "lag": [0.03], "spin_up": [1.3], "sag": [0.06], "delay": [0.0113], "scale": [np.log(0.9)],
    "shares": [0.03, -0.02, 0.01], "curve": [0.0],
}  # fmt: skip


def commands(count=200, rate=250.0):
    rng = np.random.default_rng(5)
    return np.cumsum(rng.uniform(0.5, 1.5, count)) / rate, rng.uniform(0.2, 3.4, (count, 4))


def test_forces_of_a_log_are_those_of_the_plant():
    """Lag up and down, sag, strengths and delay, at uneven times: the plant's engine, hold by hold."""
    t, command = commands()
    numbers = {name: np.array(value) for name, value in NUMBERS.items()}
    strength = np.exp(numbers["scale"] + patterns(4) @ numbers["shares"])
    plant = fp.Plant(spin_up=1.3, sag=0.06, strength=tuple(strength))
    engine = make_engine(VEHICLE.replace(rotor_lag=0.03), plant)
    at = t[5:-5] + 0.0113
    forces = rotor_forces(t, command, at, numbers, VEHICLE.rotor_limits[1], pwm=False)
    engine.reset(fp.State(y=(0, 0, -1)).packed(), rotor_forces(t, command, t[:1], numbers, 3.5, False).now[0])
    begun = []
    for k, duration in enumerate(np.diff(t)):
        begun.append(engine.rotors)
        engine.step(command[k], duration, np.zeros(6))
    assert np.abs(np.array(begun)[5:-4] - forces.now).max() < 1e-6  # holds begin 1 ns late
    assert not np.allclose(forces.now, rotor_forces(t, command, at - 0.001, numbers, 3.5, False).now, atol=1e-3)


def test_the_mean_of_a_step_is_the_integral_of_its_forces():
    t, command = commands()
    numbers = {name: np.array(value) for name, value in NUMBERS.items()}
    fine = np.linspace(t[10], t[-10], 20001)
    found = rotor_forces(t, command, fine[::100], numbers, 3.5, False)
    now = rotor_forces(t, command, fine, numbers, 3.5, False).now
    trapezia = (now[1:] + now[:-1]) / 2
    assert trapezia.reshape(200, 100, 4).mean(axis=1) == pytest.approx(found.mean, abs=1e-4)  # of jumps between holds


def test_slopes_of_forces_are_those_of_their_differences():
    t, command = commands()
    names = rotor_table(4)
    rotors = np.concatenate([NUMBERS[name] for name in names])
    grid = t[20:-20:3]

    def forces(values):
        return rotor_forces(t, command, grid, {n: values[p] for n, p in places(names).items()}, 3.5, pwm=False)

    free = np.array([name != "curve" for name, size in names.items() for _ in range(size)])
    slopes = rotor_slopes(forces(rotors), forces, rotors, names, free)
    for i in np.flatnonzero(free):
        d = 1e-6 * np.eye(len(rotors))[i]
        high, low = forces(rotors + d), forces(rotors - d)
        assert np.median(np.abs((high.mean - low.mean) / 2e-6 - slopes[0, :-1, :, i])) < 1e-3, i
        assert np.median(np.abs((high.now - low.now) / 2e-6 - slopes[1, :, :, i])) < 1e-3, i
    assert not slopes[:, :, :, ~free].any()


def test_the_accelerometer_of_a_rehearsal_feels_air_and_steady_wind():
    """By differences of the velocity of the centre of mass, in the engine that flies."""
    plant, h = fp.Plant(air="all"), 1e-5
    engine, wind = make_engine(VEHICLE, plant), np.array([0.3, -0.2, 0.1, 0.02, 0.0, -0.01])
    start = fp.State.random(np.random.default_rng(2)).packed()
    forces = np.linspace(1.0, 1.6, 4)
    engine.reset(start, forces)
    felt = _specific_force(VEHICLE, plant)(start, forces, wind)
    engine.step(forces, h, wind)
    before, after = fp.State.trusted(start), fp.State.trusted(engine.packed)
    expected = before.R.T @ ((after.x_dot - before.x_dot) / h + [0, 0, VEHICLE.gravity])
    assert np.ravel(felt) == pytest.approx(expected, abs=0.02)
    still = _specific_force(VEHICLE, fp.Plant())(start, forces, wind)
    assert np.abs(felt - still).max() > 0.1


def test_a_rehearsal_flies_in_the_wind_of_its_plant():
    windy = fp.Plant(wind=fp.Wind(on_vehicle=(1.0, 0.0, 0.0), gust_on_vehicle=1e-9))
    calm = fp.Plant(wind=fp.Wind(gust_on_vehicle=1e-9))
    one, other = (rehearse(VEHICLE, VEHICLE, plant, duration=2.0).states for plant in (windy, calm))
    assert np.abs(one - other)[:, 0].max() > 0.05
