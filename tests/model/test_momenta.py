"""The equations of motion in momenta are those of the paper."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.geometry import cross, hat, vee
from flypend.model import Disturbance, disturbed_motion
from flypend.model.dynamics import gyroscopic_moment, swing_around
from flypend.model.momenta import (
    angular_acceleration,
    carrying_force,
    lever,
    moment_for,
    outside_on_rod,
    pull_on_rod,
    split_force,
)

LOPSIDED = fp.vehicle("hehn2011").replace(inertia=[[0.0032, 2e-4, -1e-4], [2e-4, 0.0041, 3e-4], [-1e-4, 3e-4, 0.0055]])


@pytest.mark.parametrize("vehicle", [fp.vehicle("hehn2011"), fp.vehicle("nayak2018"), LOPSIDED])
def test_rates_of_momenta_are_those_of_the_equations_of_motion(vehicle):
    rng = np.random.default_rng(5)
    state = fp.State.random(rng, 100, max_omega=20.0, max_y_dot=20.0)
    thrust, moment = rng.uniform(0, 15, 100), rng.normal(size=(100, 3))
    on_vehicle, on_bob = rng.normal(size=(2, 100, 3))
    wrench = fp.Wrench(thrust, moment)
    rates = disturbed_motion(state, wrench, vehicle, "up", Disturbance(on_vehicle, on_bob))

    turning = angular_acceleration(moment, state.omega, vehicle)
    np.testing.assert_allclose(turning, rates.omega_dot, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(moment_for(turning, state.omega, vehicle), moment, rtol=0, atol=1e-12)

    pull = pull_on_rod(thrust, state.z, vehicle) + outside_on_rod(on_vehicle, on_bob, vehicle)
    H = cross(state.y, state.y_dot)
    np.testing.assert_allclose(cross(state.y, pull), cross(state.y, rates.y_ddot), rtol=0, atol=1e-10)  # Ḣ
    np.testing.assert_allclose(cross(H, state.y), state.y_dot, rtol=0, atol=1e-13)

    mass, arm = vehicle.M + vehicle.m, lever(vehicle)
    force = thrust[:, None] * state.z + on_vehicle + on_bob - vehicle.weight * np.array([0, 0, 1])
    np.testing.assert_allclose(rates.x_ddot + arm * rates.y_ddot, force / mass, rtol=0, atol=1e-10)


@pytest.mark.parametrize("vehicle", [fp.vehicle("hehn2011"), fp.vehicle("nayak2018")])
def test_a_bob_is_carried_along_the_rod_by_the_force_that_says_so(vehicle):
    """The thrust axis along the rod, so that all of the thrust acts along it."""
    rng = np.random.default_rng(8)
    state, a = fp.State.random(rng, 100, max_omega=5.0, max_y_dot=9.0), rng.uniform(-3, 20, 100)
    state = fp.State(**{**vars(state), "y": state.z, "y_dot": cross(rng.normal(size=(100, 3)), state.z)})
    thrust = carrying_force(a, state.y_dot, vehicle)
    rates = disturbed_motion(state, fp.Wrench(thrust, np.zeros((100, 3))), vehicle, "up")
    carried = rates.x_ddot + vehicle.l * rates.y_ddot + [0, 0, vehicle.g]
    np.testing.assert_allclose(carried, a[:, None] * state.y, rtol=0, atol=1e-10)


def test_forces_are_split_into_those_with_their_sum_and_difference():
    total, difference = np.random.default_rng(3).normal(size=(2, 50, 3))
    for vehicle in (fp.vehicle("hehn2011"), fp.vehicle("nayak2018")):
        on_vehicle, on_bob = split_force(total, difference, vehicle)
        np.testing.assert_allclose(on_vehicle + on_bob, total, rtol=0, atol=1e-14)
        np.testing.assert_allclose(
            vehicle.l * outside_on_rod(on_vehicle, on_bob, vehicle), difference, rtol=0, atol=1e-13
        )
        alone = split_force(total, 0 * difference, vehicle)[1]  # both accelerate alike, each by its mass
        np.testing.assert_allclose(alone, vehicle.m / (vehicle.M + vehicle.m) * total, rtol=0, atol=1e-15)


def test_a_point_of_a_turning_body_accelerates_as_its_position_in_the_world():
    """R(t) = exp(t â) exp(t² b̂) in CasADi, whose second derivative makes the acceleration."""
    t, arm = ca.SX.sym("t"), np.array([0.3, -0.2, 0.5])
    turns = []
    for axis, angle in (((1, 0, 0), 1.3 * t), ((0, 0.6, 0.8), t**2)):
        k = hat(np.array(axis, dtype=float))
        turns.append(ca.DM.eye(3) + ca.sin(angle) * k + (1 - ca.cos(angle)) * k @ k)
    R = turns[0] @ turns[1]
    rate = ca.reshape(ca.jacobian(ca.vec(R), t), 3, 3)
    omega = vee(R.T @ rate)
    place = R @ arm
    felt = R.T @ ca.jacobian(ca.jacobian(place, t), t)
    got, omega, omega_dot = ca.Function("f", [t], [felt, omega, ca.jacobian(omega, t)])(0.7)
    expected = swing_around(arm, omega.full().ravel(), omega_dot.full().ravel())
    np.testing.assert_allclose(got.full().ravel(), expected, rtol=0, atol=1e-13)
    np.testing.assert_array_equal(expected, ca.DM(swing_around(arm, omega, omega_dot)).full().ravel())


def test_the_gyroscopic_moment_is_that_of_the_whole_inertia():
    rng = np.random.default_rng(2)
    omega, inertia = rng.normal(size=(50, 3)), LOPSIDED.I
    np.testing.assert_allclose(
        gyroscopic_moment(inertia, omega), cross(omega, omega @ inertia), rtol=0, atol=1e-16 * 10
    )
    # Negative control: without the product of inertia it is another one.
    other = gyroscopic_moment(np.diag(np.diag(inertia)), omega)
    assert np.max(np.abs(other - cross(omega, omega @ inertia))) > 1e-4
