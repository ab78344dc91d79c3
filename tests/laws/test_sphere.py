"""Lemmas 1 and 2 as closed loops on S², and what happens to the reference when Lemma 2 is taken as printed."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from flypend import geometry as geo
from flypend.laws import sphere

K_P, K_D = 9.0, 4.0
COUNT = 12
RTOL = 1e-10


def _fly(force, phi, phi_dot, duration, times=None):
    """Final φ, φ̇ (or at `times`) of a batch under φ̈ = force(t, φ, φ̇) − |φ̇|² φ."""
    shape = phi.shape

    def rates(t, s):
        q, v = s.reshape(2, *shape)
        return np.concatenate([v.ravel(), sphere.acceleration(q, v, force(t, q, v)).ravel()])

    start = np.concatenate([phi.ravel(), phi_dot.ravel()])
    solution = solve_ivp(rates, (0, duration), start, "DOP853", t_eval=times, rtol=RTOL, atol=RTOL)
    assert solution.success
    return np.moveaxis(solution.y.reshape(2, *shape, -1), -1, 1)


def _starts(seed):
    rng = np.random.default_rng(seed)
    phi = geo.random_sphere(rng, (COUNT,))
    return phi, geo.random_tangent(rng, phi, 3.0)


OMEGA_1, OMEGA_2, START = np.array([0.2, -0.5, 0.7]), np.array([0.6, 0.3, -0.2]), np.array([0.6, 0.0, 0.8])


def reference(t):
    """φ_d(t) = exp(t ω̂₁) exp(t ω̂₂) start with its first two derivatives, by hand: no great circle, no rest."""
    A, B = geo.hat(OMEGA_1), geo.hat(OMEGA_2)
    E_1, E_2 = _turn(OMEGA_1, t), _turn(OMEGA_2, t)
    phi_d = E_1 @ E_2 @ START
    first = A @ phi_d + E_1 @ B @ E_2 @ START
    second = A @ A @ phi_d + 2 * A @ E_1 @ B @ E_2 @ START + E_1 @ B @ B @ E_2 @ START
    return phi_d, first, second


def _turn(omega, t):
    K, angle = geo.hat(omega / np.linalg.norm(omega)), np.linalg.norm(omega) * t
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def _all(vector):
    return np.tile(vector, (COUNT, 1))


def track(t, phi, phi_dot):
    return sphere.tracking(phi, phi_dot, *map(_all, reference(t)), K_P, K_D)


# The lemmas ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("target", [geo.E3, -geo.E3, np.array([2.0, -1.0, 2.0]) / 3])
def test_lemma_1_regulates_from_random_starts(target):
    phi, phi_dot = _starts(0)
    q, v = _fly(lambda t, q, v: sphere.regulation(q, v, _all(target), K_P, K_D), phi, phi_dot, 15.0)
    # Linearised, errors decay like exp(−k_d t / 2): 1e-13 after 15 s. Starts near the antipode take a few seconds more.
    assert np.max(np.abs(q[-1] - target)) < 1e-6
    assert np.max(np.abs(v[-1])) < 1e-6
    np.testing.assert_allclose(geo.norm(q), 1, rtol=0, atol=1e-8)  # no projection: 100 RTOL


def test_lemma_1_loses_energy_at_the_rate_of_its_damping():
    # d/dt [k_p (1 − φ·target) + |φ̇|²/2] = −k_d |φ̇|², at random states.
    phi, phi_dot = _starts(1)
    target = _all(geo.E3)
    acceleration = sphere.acceleration(phi, phi_dot, sphere.regulation(phi, phi_dot, target, K_P, K_D))
    rate = -K_P * geo.dot(phi_dot, target) + geo.dot(phi_dot, acceleration)
    np.testing.assert_allclose(rate, -K_D * geo.dot(phi_dot, phi_dot), rtol=0, atol=1e-12)


def test_the_antipode_is_an_equilibrium_of_lemma_1():
    force = sphere.regulation(-geo.E3, np.zeros(3), geo.E3, K_P, K_D)
    np.testing.assert_array_equal(force, np.zeros(3))


def test_lemma_2_tracks_from_random_starts():
    phi, phi_dot = _starts(2)
    q, v = _fly(track, phi, phi_dot, 15.0)
    phi_d, phi_d_dot, _ = reference(15.0)
    # As for Lemma 1; what stays is the error of the integrator, some 100 RTOL.
    assert np.max(np.abs(q[-1] - phi_d)) < 1e-6
    assert np.max(np.abs(v[-1] - phi_d_dot)) < 1e-6


def test_the_lyapunov_function_of_lemma_2_falls_at_the_rate_of_its_damping():
    # V = k_p (1 − φ·φ_d) + |v_e|²/2 has V̇ = −k_d |v_e|²: V̇ by central differences over the exact motion to third order.
    phi, phi_dot = _starts(3)
    t0, h = 0.7, 1e-4

    def value(t, q, v):
        phi_d, phi_d_dot, _ = map(_all, reference(t))
        v_e = sphere.velocity_error(q, v, phi_d, phi_d_dot)
        return K_P * (1 - geo.dot(q, phi_d)) + geo.dot(v_e, v_e) / 2, v_e

    ends = []
    for step in (h, -h):
        q, v = _runge_kutta(lambda t, q, v: sphere.acceleration(q, v, track(t, q, v)), t0, phi, phi_dot, step)
        ends.append(value(t0 + step, q, v)[0])
    v_e = value(t0, phi, phi_dot)[1]
    # h²/6 |V⃛| with |V⃛| up to 1e4: 2e-5; |v_e|² is of order ten.
    np.testing.assert_allclose((ends[0] - ends[1]) / (2 * h), -K_D * geo.dot(v_e, v_e), rtol=0, atol=2e-5)


def _runge_kutta(acceleration, t, q, v, h):
    k1 = (v, acceleration(t, q, v))
    k2 = (v + h / 2 * k1[1], acceleration(t + h / 2, q + h / 2 * k1[0], v + h / 2 * k1[1]))
    k3 = (v + h / 2 * k2[1], acceleration(t + h / 2, q + h / 2 * k2[0], v + h / 2 * k2[1]))
    k4 = (v + h * k3[1], acceleration(t + h, q + h * k3[0], v + h * k3[1]))
    return tuple(s + h / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip((q, v), k1, k2, k3, k4, strict=True))


def test_a_start_on_the_reference_stays_on_it():
    phi_d, phi_d_dot, _ = reference(0.0)
    times = np.linspace(0, 10, 101)
    q, v = _fly(track, _all(phi_d), _all(phi_d_dot), 10.0, times)
    exact = [np.array(part)[:, None] for part in zip(*map(reference, times), strict=True)]
    # The law attracts, so errors of the steps (RTOL each) do not add up.
    assert np.max(np.abs(q - exact[0])) < 100 * RTOL
    assert np.max(np.abs(v - exact[1])) < 100 * RTOL
    # And the force is exactly what the reference needs: its covariant acceleration.
    force = sphere.tracking(*reference(3.0)[:2], *reference(3.0), K_P, K_D)
    phi_d, phi_d_dot, phi_d_ddot = reference(3.0)
    np.testing.assert_allclose(force, phi_d_ddot + (phi_d_dot @ phi_d_dot) * phi_d, rtol=0, atol=1e-14)


def test_all_forces_are_tangent():
    phi, phi_dot = _starts(4)
    for force in (sphere.regulation(phi, phi_dot, _all(geo.E3), K_P, K_D), track(0.3, phi, phi_dot)):
        np.testing.assert_allclose(geo.dot(phi, force), 0, rtol=0, atol=1e-13)


# As printed ------------------------------------------------------------------------------------------------------


def test_lemma_2_with_e_3_as_printed_does_not_track():
    def printed(t, phi, phi_dot):
        _, phi_d_dot, phi_d_ddot = given = tuple(map(_all, reference(t)))
        v_e = sphere.velocity_error(phi, phi_dot, given[0], phi_d_dot)
        feedforward = geo.transport_derivative(phi, phi_dot, given[0], phi_d_dot, phi_d_ddot)
        return -K_P * geo.hat_squared(phi, _all(geo.E3)) - K_D * v_e + feedforward

    phi_d, phi_d_dot, _ = reference(0.0)
    times = np.linspace(5, 15, 41)
    q, _ = _fly(printed, _all(phi_d), _all(phi_d_dot), 15.0, times)
    error = np.linalg.norm(q[:, 0] - [reference(t)[0] for t in times], axis=-1)
    assert np.mean(error) > 0.3  # it was put on the reference and left it for good
    assert np.max(np.abs(q - q[:, :1])) < 1e-12  # all members alike


def test_lemma_2_without_its_feedforward_does_not_track():
    def bare(t, phi, phi_dot):
        phi_d, phi_d_dot, _ = map(_all, reference(t))
        v_e = sphere.velocity_error(phi, phi_dot, phi_d, phi_d_dot)
        return -K_P * geo.hat_squared(phi, phi_d) - K_D * v_e

    q, _ = _fly(bare, *_starts(2), 15.0)
    assert np.min(np.linalg.norm(q[-1] - reference(15.0)[0], axis=-1)) > 1e-3


def test_lemma_2_with_the_own_acceleration_as_printed_has_no_solution_on_the_reference():
    # φ̈ stands on both sides: φ̈ − (φ_d × φ̈) × φ = ... For φ = φ_d the left side is zero for every tangent φ̈: what is
    # to be solved is singular exactly where the law should hold the system.
    phi_d = reference(1.0)[0]
    matrix = np.eye(3) - np.stack([geo.transport(phi_d, phi_d, e) for e in np.eye(3)], axis=1)
    plane = np.linalg.svd(phi_d[None])[2][1:]
    np.testing.assert_allclose(plane @ matrix @ plane.T, 0, rtol=0, atol=1e-15)
