"""Fast spins: a vehicle that starts as a gyroscope is righted and stopped, and does not fly off."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.laws.axis import SPUN, THRUST_SHARE, gyroscopic_lead, spin_of
from flypend.laws.inverted_gains import angular_authority
from flypend.model.dynamics import gyroscopic_moment

VEHICLE = fp.vehicle("hehn2011")


def spinning(runs, seed, rate):
    """Random starts whose bodies spin about their thrust axes at ±`rate`, rad/s."""
    packed = fp.random_starts(runs, seed).packed().copy()
    packed[:, 15:17] = 0
    packed[:, 17] = rate * np.where(np.arange(runs) % 2, 1, -1)
    return fp.State.from_packed(packed)


# The excursion is what it falls while the axis is righted; flights that are lost fall a kilometre in 20 s.
@pytest.mark.parametrize(("name", "furthest"), [("hehn2011", 40.0), ("crazyflie", 70.0)])
def test_from_40_rad_per_second_it_recovers(name, furthest):
    found = fp.simulate_ensemble(fp.vehicle(name), fp.laws.inverted(), spinning(60, 903, 40.0), 20.0)
    assert found.success.all()
    assert found.excursion.max() < furthest


def spin_at(omega):
    packed = ca.DM(fp.State(y=(0, 0, 1), omega=omega).packed())
    state, authority = fp.State.symbolic(packed), angular_authority(VEHICLE)
    return [float(v) for v in spin_of(state, VEHICLE, authority, 17.0, VEHICLE.rotor_lag)]


def test_without_spin_the_law_is_as_if_there_were_none():
    assert spin_at((0.0, 0.0, 0.0)) == [1.0, 1.0, angular_authority(VEHICLE), 17.0]


def test_a_gyroscope_is_led_slowly_and_one_that_tumbles_more_so():
    inertia = np.diag(VEHICLE.I)
    fast = SPUN * max(inertia[:2]) / inertia[2] * np.sqrt(angular_authority(VEHICLE))
    calm, thrust, acceleration, rate = spin_at((0.0, 0.0, 1.01 * fast))
    assert (calm, thrust) == (0.0, THRUST_SHARE)
    assert acceleration < angular_authority(VEHICLE)
    assert rate < 17.0
    assert spin_at((30.0, 0.0, 1.01 * fast))[3] < rate / 3


def test_the_axis_is_led_by_the_moment_under_which_it_moves_steadily():
    """In the body its rate turns with −ω₃: I ω̇ + ω × I ω = τ with ω̇ = ω₃ ω × e₃."""
    omega, axis = np.array([0.4, -0.7, 30.0]), np.array([0.0, 0.0, 1.0])
    v_d = np.cross(omega, axis)
    state = fp.State.symbolic(ca.DM(fp.State(y=(0, 0, 1), omega=(9.0, 5.0, 30.0)).packed()))
    wanted = VEHICLE.I @ (omega[2] * np.cross(omega, axis)) + np.array(gyroscopic_moment(VEHICLE.I, omega)).ravel()
    found = np.array(ca.DM(gyroscopic_lead(state, VEHICLE, ca.DM(v_d), 1.0))).ravel()
    np.testing.assert_allclose(found, wanted, atol=1e-12)
