"""The motion with what the laws do not know of: forces from outside, and a pivot beside the centre of mass."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.geometry import apply, cross, dot, hat, hat_squared, is_symbolic, scale
from flypend.model.dynamics import Rates, gravity_vector
from flypend.model.state import E3Direction, State, Wrench
from flypend.model.vehicle import Vehicle


def disturbed_motion(
    state: State,
    wrench: Wrench,
    vehicle: Vehicle,
    e3: E3Direction,
    *,
    force_on_vehicle: Any = (0.0, 0.0, 0.0),
    force_on_bob: Any = (0.0, 0.0, 0.0),
    pivot_offset: Any = (0.0, 0.0, 0.0),
) -> Rates:
    """Rates of `state` under `wrench` and external forces, the pivot lying beside the centre of mass.

    With c the centre of mass, o the offset in the body frame, x = c + R o the pivot and T the tension of the rod,

        M c̈ = M g⃗ + f z + F_v + T y,   m (ẍ + l ÿ) = m g⃗ + F_b − T y                              (1), (2)
        I ω̇ + ω × I ω = τ + o × Rᵀ(T y),   ẍ = c̈ + s,   s = R (ω̇ × o + ω × (ω × o))               (3), (4)

    (3) splits ω̇ = α + T a and with it s = s₀ + T R (a × o), where a = I⁻¹(o × Rᵀy). (2)/m − (1)/M − (4) is

        l ÿ = h − T (1/m + 1/M) y,   h = F_b/m − (f z + F_v)/M − s,                                       (5)

    in which gravity cancels. Its part along y, with y · ÿ = −|ẏ|², gives T; what multiplies T on the left is positive:

        T (1/m + 1/M + (o × Rᵀy) · a) = l |ẏ|² + y · h₀,   h₀ = F_b/m − (f z + F_v)/M − s₀                  (6)

    The part of (5) tangent to S² gives ÿ, and M (4) + (1) + (2) gives ẍ. With F_v = F_b = o = 0 these are
    `flypend.model.equations_of_motion`, line by line.

    Parameters
    ----------
    state : State
        State, or batch of states; `state.x` and `state.x_dot` are those of the pivot. NumPy arrays or CasADi symbols.
    wrench : Wrench
        Thrust f (N) along z = R e₃ and moment τ (N m, body frame), at the centre of mass.
    vehicle : Vehicle
        What flies.
    e3 : "up" or "down"
        Direction of the third axis of the world in which all of this is written.
    force_on_vehicle, force_on_bob : (..., 3)
        F_v at the centre of mass and F_b at the bob, world frame, N.
    pivot_offset : (..., 3)
        o, from the centre of mass to the pivot, body frame, m.

    Returns
    -------
    Rates
        Of the state, `x_ddot` being the acceleration of the pivot.
    """
    vehicle = vehicle.seen(e3)
    M, m, l, I = vehicle.M, vehicle.m, vehicle.l, vehicle.I
    R, omega, y, o = state.R, state.omega, state.y, pivot_offset
    F_b = scale(1.0, force_on_bob)
    F = scale(wrench.thrust, state.z) + scale(1.0, force_on_vehicle)  # f z + F_v
    speed_squared = dot(state.y_dot, state.y_dot)

    arm = cross(o, apply(_transposed(R), y))  # moment per tension, body frame
    a = apply(vehicle.I_inv, arm)  # (3)
    alpha = apply(vehicle.I_inv, wrench.moment - cross(omega, apply(I, omega)))
    s_0 = apply(R, cross(alpha, o) + cross(omega, cross(omega, o)))  # (4)
    h_0 = F_b / m - F / M - s_0
    T = (l * speed_squared + dot(y, h_0)) / (1 / m + 1 / M + dot(arm, a))  # (6)

    s_T = scale(T, apply(R, cross(a, o)))
    y_ddot = -hat_squared(y, h_0 - s_T) / l - scale(speed_squared, y)  # (5)
    x_ddot = gravity_vector(vehicle, e3) + (F + F_b + M * (s_0 + s_T) - m * l * y_ddot) / (M + m)
    return Rates(state.x_dot, x_ddot, R @ hat(omega), alpha + scale(T, a), state.y_dot, y_ddot)


def _transposed(R: Any) -> Any:
    """Rᵀ, batch axes in front."""
    return R.T if is_symbolic(R) else np.swapaxes(R, -1, -2)
