"""Equations of motion: the paper's, and the same with disturbances that the laws do not model, from one formula.

Both functions accept NumPy batches and CasADi expressions.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.geometry import apply, cross, dot, hat, hat_squared, is_symbolic, scale
from flypend.model.dynamics import Rates, gravity_vector, gyroscopic_moment
from flypend.model.state import E3Direction, State, Wrench
from flypend.model.vehicle import Vehicle


def equations_of_motion(state: State, wrench: Wrench, vehicle: Vehicle, e3: E3Direction) -> Rates:
    """Rates of `state` of `vehicle` under `wrench`, in the frame whose third axis points `e3` ("up" or "down").

        M ẍ = M g⃗ + f z + T y,   m (ẍ + l ÿ) = m g⃗ − T y,   Ṙ = R ω̂,   I ω̇ + ω × I ω = τ

    These are the paper's (xeqn_txt), (ddty_notfin) and (Rfin), with τ = −μ and T the rod tension.
    """
    return disturbed_motion(state, wrench, vehicle, e3)


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
    """Rates of `state` under `wrench` and external forces, with the pivot offset from the centre of mass.

    With c the centre of mass, o the pivot offset in the body frame, x = c + R o the pivot and T the rod tension,

        M c̈ = M g⃗ + f z + F_v + T y,   m (ẍ + l ÿ) = m g⃗ + F_b − T y                              (1), (2)
        I ω̇ + ω × I ω = τ + o × Rᵀ(T y),   ẍ = c̈ + s,   s = R (ω̇ × o + ω × (ω × o))               (3), (4)

    By (3), ω̇ = α + T a and s = s₀ + T R (a × o), where a = I⁻¹(o × Rᵀy). Then (1)/M + (4) − (2)/m reads

        −l ÿ = f z/M + h + T (1/m + 1/M) y,   h = F_v/M − F_b/m + s,                                      (5)

    in which gravity cancels. Projecting (5) onto y, with y · ÿ = −|ẏ|², yields T; the factor of T is positive:

        T (1/m + 1/M + (o × Rᵀy) · a) = l |ẏ|² − y · (f z/M + h₀),   h₀ = F_v/M − F_b/m + s₀                (6)

    The part of (5) tangent to S² yields ÿ, and M (4) + (1) + (2) yields ẍ. For F_v = F_b = o = 0 these reduce to the
    paper's (ddty), (xeqn_txt) and (Rfin).

    Parameters
    ----------
    state : State
        State or batch of states; `state.x` and `state.x_dot` refer to the pivot. NumPy arrays or CasADi expressions.
    wrench : Wrench
        Thrust f (N) along z = R e₃ and moment τ (N m, body frame), at the centre of mass.
    vehicle : Vehicle
        Vehicle parameters.
    e3 : "up" or "down"
        Direction of the third axis of the world frame, for all arguments and results.
    force_on_vehicle, force_on_bob : (..., 3)
        F_v at the centre of mass and F_b at the bob, world frame, N.
    pivot_offset : (..., 3)
        o, from the centre of mass to the pivot, body frame, m.

    Returns
    -------
    Rates
        Rates of the state; `x_ddot` is the acceleration of the pivot.
    """
    vehicle = vehicle.seen(e3)
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    R, omega, y, o = state.R, state.omega, state.y, pivot_offset
    F_b = scale(1.0, force_on_bob)
    f, z, F_v = wrench.thrust, state.z, scale(1.0, force_on_vehicle)
    speed_squared = dot(state.y_dot, state.y_dot)

    arm = cross(o, apply(_transposed(R), y))  # moment per unit tension, body frame
    a = apply(vehicle.I_inv, arm)  # (3)
    alpha = apply(vehicle.I_inv, wrench.moment - gyroscopic_moment(vehicle.I, omega))
    s_0 = apply(R, cross(alpha, o) + cross(omega, cross(omega, o)))  # (4)
    h_0 = F_v / M - F_b / m + s_0
    T = (l * speed_squared - f / M * dot(y, z) - dot(y, h_0)) / (1 / m + 1 / M + dot(arm, a))  # (6)

    s_T = scale(T, apply(R, cross(a, o)))
    y_ddot = scale(f / (M * l), hat_squared(y, z)) - scale(speed_squared, y)  # (5), (ddty)
    y_ddot = y_ddot + hat_squared(y, (h_0 + s_T) / l)
    x_ddot = gravity_vector(vehicle, e3) + scale(f / (M + m), z) - m * l / (M + m) * y_ddot  # (xeqn_txt)
    x_ddot = x_ddot + (F_v + F_b + M * (s_0 + s_T)) / (M + m)
    return Rates(state.x_dot, x_ddot, R @ hat(omega), alpha + scale(T, a), state.y_dot, y_ddot)


def _transposed(R: Any) -> Any:
    """Rᵀ, with leading batch axes."""
    return R.T if is_symbolic(R) else np.swapaxes(R, -1, -2)
