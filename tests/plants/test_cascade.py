"""One step of the cascade: of order four, on the manifold at any length, and good enough to predict with."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.compile.numeric import as_numpy
from flypend.model import State
from flypend.plants.cascade import cascade_step
from flypend.plants.equations import EquationsEngine, runge_kutta_step
from flypend.plants.lag import Ramp, hold_in_turn

LOPSIDED = fp.vehicle("hehn2011").replace(inertia=[[0.0032, 2e-4, -1e-4], [2e-4, 0.0041, 3e-4], [-1e-4, 3e-4, 0.0055]])
SPINNING = State(x_dot=(1, -2, 0.5), omega=(6, -9, 4), y=(0.6, 0, 0.8), y_dot=(0, 5, 0))
OUTSIDE = np.array([0.5, -0.3, 0.2, 0.05, 0.1, -0.05])


def step_of(vehicle, method=cascade_step):
    """The step as a function (state, mean and change of the wrench, outside forces, h) → state."""
    s, mean, change, outside, h = (ca.SX.sym(name, n) for name, n in zip("swcfh", (24, 4, 4, 6, 1), strict=True))
    acting = Ramp(mean, change) if method is cascade_step else Ramp(mean, change).mix(vehicle.unmixing())
    after = method(s, acting, outside, h, vehicle)
    return as_numpy(ca.Function("step", [s, mean, change, outside, h], [ca.densify(after)]))


def flown(step, start, ramp, duration, steps):
    """`steps` equal steps under a wrench that changes linearly over the whole `duration`."""
    state = start
    for k in range(steps):
        mean = ramp.mean + ramp.change * ((k + 0.5) / steps - 0.5)
        state = step(state, mean, ramp.change / steps, OUTSIDE, duration / steps)
    return state


RAMP = Ramp(np.array([8.0, 0.2, -0.3, 0.05]), np.array([4.0, -0.3, 0.5, 0.1]))


@pytest.mark.parametrize("vehicle", [fp.vehicle("hehn2011"), LOPSIDED])
def test_it_is_of_order_four_and_converges_to_what_runge_kutta_converges_to(vehicle):
    cascade, whole = step_of(vehicle), step_of(vehicle, runge_kutta_step)
    start = SPINNING.packed()
    exact = flown(whole, start, RAMP, 0.2, 2000)
    errors = [np.max(np.abs(flown(cascade, start, RAMP, 0.2, n) - exact)) for n in (10, 20, 40)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4, abs=0.4)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(4, abs=0.4)
    assert errors[2] > 1e-10  # above the accuracy of what it is compared with
    # Its error is smaller than that of Runge-Kutta steps of the whole state as long as they are.
    assert errors[1] < np.max(np.abs(flown(whole, start, RAMP, 0.2, 20) - exact)) / 2


def test_each_step_ends_on_the_manifold_however_long_it_is():
    step = step_of(LOPSIDED)
    for h in (1e-3, 0.05, 1.0):
        state = step(SPINNING.packed(), RAMP.mean, RAMP.change, OUTSIDE, h)
        assert geo.rotation_defect(state[6:15].reshape(3, 3)) < 1e-14
        assert abs(geo.norm(state[18:21]) - 1) < 1e-15
        assert abs(geo.dot(state[18:21], state[21:24])) < 1e-15 * geo.norm(state[21:24]) + 1e-15


def test_over_many_steps_roundoff_alone_takes_it_off_the_manifold():
    engine = EquationsEngine(fp.vehicle("hehn2011"))
    engine.reset(SPINNING.packed(), np.full(4, 1.5))
    for _ in range(5000):
        engine.step(np.array([1.5, 1.4, 1.5, 1.4]), 2e-3, np.zeros(6))
    # 5,000 products of rotations, each rounded to some 1e-16.
    assert geo.rotation_defect(engine.packed[6:15].reshape(3, 3)) < 1e-12


def test_without_forces_momentum_and_energy_stay():
    vehicle = fp.vehicle("hehn2011").replace(gravity=0.0)
    engine = EquationsEngine(vehicle)
    engine.reset(SPINNING.packed(), np.zeros(4))

    def kept():
        s = State.trusted(engine.packed)
        momentum = fp.model.linear_momentum(s, vehicle)
        return np.append(momentum, fp.model.kinetic_energy(s, vehicle))

    before = kept()
    for _ in range(500):
        engine.step(np.zeros(4), 2e-3, np.zeros(6))
    after = kept()
    np.testing.assert_allclose(after[:3], before[:3], rtol=0, atol=1e-13)  # exact but for roundoff
    assert after[3] == pytest.approx(before[3], rel=1e-8)  # (5 rad/s · 2 ms)⁴ a step, in rounds that add up


# A prediction over 28 ms, against steps of 0.1 ms. Motion capture errs by 3.5e-3 rad and 2e-2 rad/s.


@pytest.mark.parametrize(("speed", "axis", "rates"), [(3.0, 2e-4, 1e-3), (20.0, 4e-4, 1e-2)])
@pytest.mark.parametrize("commands", ["saturating at random", "switching once", "a ramp"])
def test_one_step_predicts_28_ms_of_commands(commands, speed, axis, rates):
    vehicle, rng = fp.vehicle("hehn2011"), np.random.default_rng(8)
    low, high = vehicle.rotor_limits
    step, engine, mixing = step_of(vehicle), EquationsEngine(vehicle), vehicle.mixing()
    starts = State.random(rng, 40, max_omega=speed, max_y_dot=speed).packed()
    for start in starts:
        rotors = rng.uniform(low, high, 4)
        if commands == "saturating at random":
            given = rng.choice([low, high], (14, 4))
        elif commands == "switching once":
            before, after, at = *rng.choice([low, high], (2, 4)), rng.integers(1, 14)
            given = np.where(np.arange(14)[:, None] < at, before, after)
        else:
            before, after = rng.uniform(low, high, (2, 4))
            given = before + (after - before) * np.linspace(0, 1, 14)[:, None]
        engine.reset(start, rotors)
        for command in given:
            for _ in range(20):
                engine.step(command, 1e-4, np.zeros(6))
        ramp, end = hold_in_turn(rotors, list(given), [2e-3] * 14, vehicle.rotor_lag)
        state = step(start, mixing @ ramp.mean, mixing @ ramp.change, np.zeros(6), 0.028)
        error = np.abs(state - engine.packed)
        assert np.max(error[6:15]) < axis
        assert max(np.max(error[15:18]), np.max(error[21:])) < rates
        assert np.max(error[:6]) < rates / 2
        np.testing.assert_allclose(end, engine.rotors, rtol=0, atol=1e-12)
