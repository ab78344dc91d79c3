"""The equations of motion in momenta are those of the paper."""

import numpy as np
import pytest

import flypend as fp
from flypend.geometry import cross
from flypend.model import Disturbance, disturbed_motion
from flypend.model.dynamics import gyroscopic_moment
from flypend.model.momenta import angular_acceleration, outside_on_rod, pull_on_rod

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

    pull = pull_on_rod(thrust, state.z, vehicle) + outside_on_rod(on_vehicle, on_bob, vehicle)
    H = cross(state.y, state.y_dot)
    np.testing.assert_allclose(cross(state.y, pull), cross(state.y, rates.y_ddot), rtol=0, atol=1e-10)  # Ḣ
    np.testing.assert_allclose(cross(H, state.y), state.y_dot, rtol=0, atol=1e-13)

    mass, arm = vehicle.M + vehicle.m, vehicle.m * vehicle.l / (vehicle.M + vehicle.m)
    force = thrust[:, None] * state.z + on_vehicle + on_bob - vehicle.weight * np.array([0, 0, 1])
    np.testing.assert_allclose(rates.x_ddot + arm * rates.y_ddot, force / mass, rtol=0, atol=1e-10)


def test_the_gyroscopic_moment_is_that_of_the_whole_inertia():
    rng = np.random.default_rng(2)
    omega, inertia = rng.normal(size=(50, 3)), LOPSIDED.I
    np.testing.assert_allclose(
        gyroscopic_moment(inertia, omega), cross(omega, omega @ inertia), rtol=0, atol=1e-16 * 10
    )
    # Negative control: without the product of inertia it is another one.
    other = gyroscopic_moment(np.diag(np.diag(inertia)), omega)
    assert np.max(np.abs(other - cross(omega, omega @ inertia))) > 1e-4
