"""Motors: forces that rise slower than they fall, a battery that sags, rotors of unequal strength."""

import casadi as ca
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.compile.program import lower
from flypend.plants import ROTORS, Plant
from flypend.plants.actuation import make_engine
from flypend.plants.equations import rotor_step
from flypend.plants.motors import follow, motor_timing, settle_forces, timing_size

VEHICLE = fp.vehicle("hehn2011")
LEAST, MOST = VEHICLE.rotor_limits
START = fp.State(omega=(1, -2, 0.5), y=(0.6, 0, 0.8), y_dot=(0, 1, 0)).packed()
ENGINES = pytest.mark.parametrize("engine", ["equations", "mujoco"])


def settled(command, plant):
    u = ca.SX.sym("u", 4)
    delivered = ca.Function("delivered", [u], [settle_forces(u, MOST, plant.strength, plant.sag)])
    return as_numpy(delivered)(np.asarray(command, dtype=float))


def rotors_after(command, begin, duration, plant, steps=1):
    engine = make_engine(plant.true_vehicle(VEHICLE), plant)
    engine.reset(START, begin)
    for _ in range(steps):
        engine.step(np.asarray(command), duration / steps, np.zeros(6))
    return engine.rotors


@ENGINES
def test_forces_rise_with_a_time_constant_of_their_own(engine):
    plant = Plant(engine=engine, spin_up=1.5)
    begin, command, duration = np.array([0.1, 3.0, 1.0, 2.0]), np.array([2.0, 1.0, 1.0, 2.5]), 0.03
    lag = VEHICLE.rotor_lag * np.where(command > begin, 1.5, 1.0)
    expected = command + (begin - command) * np.exp(-duration / lag)
    # MuJoCo takes its filters with RK4, in steps of a tenth of the lag: (1/10)⁵/120 a step.
    np.testing.assert_allclose(rotors_after(command, begin, duration, plant, 15), expected, atol=1e-5)
    if engine == "equations":
        np.testing.assert_allclose(rotors_after(command, begin, duration, plant), expected, atol=1e-14)
    even = rotors_after(command, begin, duration, plant.replace(spin_up=1.0), 15)
    np.testing.assert_allclose(even[[1, 2]], expected[[1, 2]], atol=1e-5)  # they fall, or stay
    assert np.all(even[[0, 3]] > expected[[0, 3]] + 0.05)


def test_a_ramp_has_the_mean_and_the_first_moment_of_what_it_stands_for():
    plant, h = Plant(spin_up=1.8), 5e-3
    begin, command = np.array([0.1, 3.0]), np.array([2.0, 1.0])
    r, u, timing = ca.SX.sym("r", 2), ca.SX.sym("u", 2), ca.SX.sym("h", timing_size(plant))
    ramp, _ = follow(r, u, timing)
    mean, change = as_numpy(ca.Function("ramp", [r, u, timing], [ramp.mean, ramp.change]))(
        begin, command, motor_timing(0.02, plant, h)
    )
    t = (np.arange(20000) + 0.5) / 20000 * h
    forces = command + (begin - command) * np.exp(-t[:, None] / np.array([0.036, 0.02]))
    np.testing.assert_allclose(mean, forces.mean(0), rtol=1e-8)  # midpoint rule with 20,000 points
    np.testing.assert_allclose(change, 12 * ((t / h - 0.5)[:, None] * forces).mean(0), rtol=1e-7)


def test_voltage_and_force_fall_with_the_power_of_all_rotors():
    plant = Plant(sag=0.2)
    np.testing.assert_allclose(settled(np.full(4, MOST), plant), 0.8**2 * MOST, rtol=1e-15)
    np.testing.assert_allclose(settled(np.full(4, MOST / 4), plant), (1 - 0.2 / 8) ** 2 * MOST / 4, rtol=1e-15)
    # One rotor that works drags the others down: a quarter of the load.
    one = settled([MOST, 1e-9, 1e-9, 1e-9], plant)
    np.testing.assert_allclose(one, 0.95**2 * np.array([MOST, 1e-9, 1e-9, 1e-9]), rtol=1e-9)
    asked = np.linspace(LEAST, MOST, 50)[:, None] * np.ones(4)
    # u (1 − s u^1.5)² rises up to u = (4 s)^(−2/3), which is 1 for the largest sag, 1/4.
    assert np.all(np.diff([settled(u, Plant(sag=0.25))[0] for u in asked]) > 0)


def test_a_sagging_battery_has_a_derivative_without_a_load():
    """The identity: the load, with the power 3/2 of the commands, is level there."""
    u = ca.SX.sym("u", 4)
    slopes = ca.Function("slopes", [u], [ca.jacobian(settle_forces(u, MOST, 1.0, 0.2), u)])
    np.testing.assert_array_equal(np.array(slopes(np.zeros(4))), np.eye(4))


def test_a_command_beyond_the_limits_drains_no_more_than_the_largest():
    np.testing.assert_allclose(settled(np.full(4, 2 * MOST), Plant(sag=0.2)), 0.64 * 2 * MOST, rtol=1e-15)
    np.testing.assert_allclose(settled(np.full(4, -1.0), Plant(sag=0.2)), -1.0, rtol=1e-15)


@ENGINES
def test_each_rotor_has_its_strength(engine):
    strength = (1.0, 0.7, 1.1, 0.9)
    command = np.array([1.0, 2.0, 1.5, 1.2])
    for plant in (Plant(engine=engine, strength=strength, lag=0.0), Plant(engine=engine, strength=strength, lag=1e-3)):
        found = rotors_after(command, np.ones(4), 0.02, plant, 10)
        np.testing.assert_allclose(found, np.multiply(strength, command), atol=1e-7)  # e^(-20) of a newton


@ENGINES
def test_the_flight_is_that_of_an_integrator_with_events(engine):
    """SciPy, with the rotors' differential equation as it is written, switching where a force passes its command."""
    plant = Plant(engine=engine, spin_up=1.6, sag=0.15, strength=0.95)
    vehicle, begin, commands = VEHICLE, np.full(4, 1.4), np.array([[2.0, 1.0, 1.5, 1.2], [0.5, 3.0, 1.0, 1.6]])
    mixing, lag = vehicle.mixing(), vehicle.rotor_lag
    symbols = ca.SX.sym("s", 24), ca.SX.sym("W", 4)
    motion = fp.model.equations_of_motion(
        fp.State.symbolic(symbols[0]), fp.Wrench(symbols[1][0], symbols[1][1:]), vehicle, "up"
    )
    rates = as_numpy(ca.Function("rates", list(symbols), [ca.densify(motion.packed())]))

    def written(t, s, u):
        load = np.mean((u / MOST) ** 1.5)
        target = 0.95 * (1 - 0.15 * load) ** 2 * u
        r = s[24:]
        return np.append(rates(s[:24], mixing @ r), (target - r) / np.where(r < target, 1.6 * lag, lag))

    s = np.append(START, begin)
    machine = make_engine(vehicle, plant)
    machine.reset(START, begin)
    for u in commands:
        s = solve_ivp(written, (0, 0.04), s, args=(u,), rtol=1e-10, atol=1e-12, max_step=2e-3).y[:, -1]
        for _ in range(20):
            machine.step(u, 2e-3, np.zeros(6))
    np.testing.assert_allclose(machine.rotors, s[24:], atol=1e-5)  # RK4 of the filters
    np.testing.assert_allclose(machine.packed, s[:24], atol=2e-6)


def test_a_plant_without_them_is_the_same_program():
    plain = lower(rotor_step(VEHICLE))
    assert lower(rotor_step(VEHICLE.replace(air=None), Plant(spin_up=1.0, sag=0.0, strength=1))) == plain
    for plant in (Plant(spin_up=1.1), Plant(sag=0.1), Plant(strength=0.9)):
        assert lower(rotor_step(VEHICLE, plant)) != plain


def test_bad_motors_are_told_in_one_line():
    for options, words in [
        ({"spin_up": 0}, r"^plant\.spin_up: expected a finite number > 0, got 0$"),
        ({"sag": 0.3}, r"^plant\.sag: expected at most 0\.25, got 0\.3$"),
        ({"strength": (1, 0)}, r"^plant\.strength: expected a number > 0, or one per rotor, got \[1\.0, 0\.0\]$"),
        ({"strength": "strong"}, r"^plant\.strength: expected a finite number > 0, got 'strong'$"),
        ({"strength": [[1]]}, r"^plant\.strength: expected numbers of shape \(n\), got shape \(1, 1\)$"),
    ]:
        with pytest.raises(fp.InputError, match=words):
            Plant(**options)
    with pytest.raises(fp.InputError, match=r"^plant\.strength: expected a number, or one for each of 4 rotors, got 3"):
        fp.simulate(VEHICLE, fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.1, plant=Plant(strength=(1, 1, 1)))
    assert ROTORS.replace(strength=[1, 2, 3, 4]).strength == (1.0, 2.0, 3.0, 4.0)
