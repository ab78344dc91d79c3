"""Lemmas 1 and 2 on their own: small simulations of a point on S² under the feedback of `laws.sphere`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from flypend.compile.methods import method
from flypend.geometry import cross, dot, hat_squared, scale, unit
from flypend.laws.sphere import acceleration, tracking, velocity_error

K_P, K_D = 9.0, 4.2  # 1/s², 1/s: natural frequency 3 rad/s, damping ratio 0.7
# s. With a method of order 8, the error per step is below 1e-11 at rates of a few rad/s.
STEP = 0.025
Reference = tuple[Any, Any, Any]


def circle(t: float, height: float = 0.6, rate: float = 1.5) -> Reference:
    """Return φ_d, φ̇_d, φ̈_d at time `t` (s) on the circle at `height` on S², followed at angular `rate` (rad/s)."""
    radius = np.sqrt(1 - height**2)
    c, s = np.cos(rate * t), np.sin(rate * t)
    phi_d = np.array([radius * c, radius * s, height])
    phi_d_dot = radius * rate * np.array([-s, c, 0.0])
    return phi_d, phi_d_dot, radius * rate**2 * np.array([-c, -s, 0.0])


def fly(force: Callable[[float, Any, Any], Any], start: Any, start_rate: Any, times: Any) -> Any:
    """Integrate ∇_φ̇ φ̇ = `force`(t, φ, φ̇) from `start`, `start_rate` (3,); return φ (n, 3) at `times` (n,), s."""

    def rates(t: float, s: Any) -> Any:
        return np.concatenate([s[3:], acceleration(s[:3], s[3:], force(t, s[:3], s[3:]))])

    now, states = 0.0, [np.concatenate([start, start_rate])]
    for time in times:
        steps = max(1, int(np.ceil((time - now) / STEP)))
        states.append(_steps(rates, now, states[-1], (time - now) / steps, steps))
        now = time
    return np.array(states[1:])[:, :3]


def _steps(rates: Callable[[float, Any], Any], t: float, s: Any, h: float, steps: int) -> Any:
    """The state after `steps` fixed DOP853 steps of length `h` (s) from `s` at time `t`."""
    scheme = method("dop853")
    for number in range(steps):
        slopes = np.zeros((scheme.stages, len(s)))
        for i in range(scheme.stages):
            slopes[i] = rates(t + (number + scheme.C[i]) * h, s + h * scheme.A[i] @ slopes)
        s = s + h * scheme.B @ slopes
    return s


def track(start: Any, start_rate: Any, reference: Callable[[float], Reference], times: Any) -> Any:
    """Lemma 2, corrected: track `reference`(t) from `start`, `start_rate`; return φ (n, 3) at `times`."""
    return fly(lambda t, phi, phi_dot: tracking(phi, phi_dot, *reference(t), K_P, K_D), start, start_rate, times)


def track_as_printed(
    start: Any, start_rate: Any, reference: Callable[[float], Reference], target: Any, times: Any
) -> Any:
    """Lemma 2 with the printed proportional term −k_p φ̂²e₃, where `target` is e₃, and the correct feedforward.

    The other arguments are those of `track`.
    """

    def force(t: float, phi: Any, phi_dot: Any) -> Any:
        true = tracking(phi, phi_dot, *reference(t), K_P, K_D)
        return true - K_P * hat_squared(phi, target - reference(t)[0])

    return fly(force, start, start_rate, times)


def printed_feedforward_force(phi: Any, phi_dot: Any, reference: Reference) -> Any:
    """Return the force u of Lemma 2 at `phi`, `phi_dot` if its feedforward contains φ̈, as printed, instead of φ̈_d.

    On S², (φ_d × φ̈) × φ = (φ·φ_d) φ̈ + |φ̇|² φ_d with φ̈ = u − |φ̇|² φ, hence u (1 − φ·φ_d) = the other terms: the force
    is unbounded as φ → φ_d. `reference` is (φ_d, φ̇_d, φ̈_d), each (3,).
    """
    phi_d, phi_d_dot, _ = reference
    alignment = dot(phi, phi_d)
    v_e = velocity_error(phi, phi_dot, phi_d, phi_d_dot)
    other = -K_P * hat_squared(phi, phi_d) - K_D * v_e + dot(phi, cross(phi_d, phi_d_dot)) * cross(phi, phi_dot)
    other = other + scale(dot(phi_dot, phi_dot), phi_d - alignment * phi)
    return scale(1 / (1 - alignment), other)


def near(phi_d: Any, angle: float) -> Any:
    """Return the point at `angle` (rad) from the unit vector `phi_d` (3,), towards e₁."""
    towards = unit(-hat_squared(phi_d, np.array([1.0, 0.0, 0.0])))
    return np.cos(angle) * phi_d + np.sin(angle) * towards
