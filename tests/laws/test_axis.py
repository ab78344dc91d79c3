"""The moment on the thrust axis, with what follows from spin cancelled and not."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend import geometry as geo
from flypend.laws.axis import axis_moment, spin

VEHICLE = fp.vehicle("hehn2011")
E3 = np.array([0.0, 0, 1])


def _turning(state, u, yaw, **options):
    """ω̇ (3,) under the moment."""
    moment = np.array(ca.DM(axis_moment(state, VEHICLE, ca.DM(u), yaw, **options))).ravel()
    I, omega = VEHICLE.I, state.omega
    return np.linalg.solve(I, moment - np.cross(omega, I @ omega))


def test_cancelled_the_axis_moves_as_demanded_whatever_the_spin():
    rng = np.random.default_rng(0)
    for state in fp.State.random(rng, 20, max_omega=60.0):
        u, omega = np.append(rng.standard_normal(2), 0), state.omega
        rate = _turning(state, u, -3.0)
        z_ddot = np.cross(rate, E3) + np.cross(omega, np.cross(omega, E3))  # R'z̈
        z_dot = np.cross(omega, E3)
        np.testing.assert_allclose(z_ddot, -(z_dot @ z_dot) * E3 + u, rtol=0, atol=1e-10)  # 60² eps, and products
        assert rate[2] == pytest.approx(-3)


def test_left_alone_what_follows_from_spin_does_no_work_on_the_axis():
    for state in fp.State.random(np.random.default_rng(1), 20, max_omega=60.0):
        omega = state.omega
        rate = _turning(state, np.zeros(3), 0.0, compensated=0.0)
        assert rate[:2] @ omega[:2] == pytest.approx(0, abs=1e-10)
        precession = (VEHICLE.I[2, 2] - VEHICLE.I[0, 0]) / VEHICLE.I[0, 0] * omega[2]
        assert geo.norm(rate) == pytest.approx(abs(precession) * np.hypot(*omega[:2]), rel=1e-9)


@pytest.mark.parametrize("angle", [-0.3, 1e-9, 0.02, 2.0])
def test_a_plane_vector_is_turned_by_twice_the_arc_tangent_of_half_the_angle(angle):
    turned = np.array(spin(ca.DM([0.6, -0.8]), angle)).ravel()
    by = 2 * np.arctan(angle / 2)
    wanted = [0.6 * np.cos(by) + 0.8 * np.sin(by), 0.6 * np.sin(by) - 0.8 * np.cos(by)]
    np.testing.assert_allclose(turned, wanted, rtol=0, atol=1e-15 + 4e-16)
