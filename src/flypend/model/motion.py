"""Equations of motion: the paper's, and the same with disturbances that the laws do not model, from one formula.

Both functions accept NumPy batches and CasADi expressions.
"""

from __future__ import annotations

from typing import NamedTuple

import casadi as ca
import numpy as np

from flypend.geometry import (
    E3,
    Matrix,
    Scalar,
    Vector,
    apply,
    cross,
    dot,
    hat,
    hat_squared,
    is_symbolic,
    scale,
    transpose,
)
from flypend.model.dynamics import Rates, gravity_vector, gyroscopic_moment, swing_around
from flypend.model.joint import on_rod
from flypend.model.rod import is_point, share_out
from flypend.model.state import E3Direction, State, Wrench
from flypend.model.vehicle import Vehicle


class Disturbance(NamedTuple):
    """What laws do not model: external forces, and a joint that need not be free (`model.joint`).

    Parameters
    ----------
    force_on_vehicle, force_on_bob : (..., 3)
        F_v at the vehicle's centre of mass and F_b at that of rod and bob, world frame, N.
    pivot_offset : (..., 3)
        o, from the vehicle's centre of mass to the pivot, body frame, m.
    joint_torque : (..., 3), optional
        Q, across the rod, world frame, N m; default none.
    spin : scalar, optional
        S, angular momentum of the rod about its own axis, kg m²/s; default none.
    """

    force_on_vehicle: Vector = (0.0, 0.0, 0.0)
    force_on_bob: Vector = (0.0, 0.0, 0.0)
    pivot_offset: Vector = (0.0, 0.0, 0.0)
    joint_torque: Vector = None
    spin: Scalar | None = None


UNDISTURBED = Disturbance()


def equations_of_motion(state: State, wrench: Wrench, vehicle: Vehicle, e3: E3Direction) -> Rates:
    """Rates of `state` of `vehicle` under `wrench`, in the frame whose third axis points `e3` ("up" or "down").

        M ẍ = M g⃗ + f z + T y,   m (ẍ + l ÿ) = m g⃗ − T y,   Ṙ = R ω̂,   I ω̇ + ω × I ω = τ

    These are the paper's (xeqn_txt), (ddty_notfin) and (Rfin), with τ = −μ and T the rod tension.
    """
    return disturbed_motion(state, wrench, vehicle, e3)


def disturbed_motion(
    state: State, wrench: Wrench, vehicle: Vehicle, e3: E3Direction, disturbance: Disturbance = UNDISTURBED
) -> Rates:
    """Rates of `state` under `wrench` and a `disturbance`.

    With c the centre of mass, o the pivot offset in the body frame, x = c + R o the pivot and T the rod tension,

        M c̈ = M g⃗ + f z + F_v + T y,   m (ẍ + l ÿ) = m g⃗ + F_b − T y                              (1), (2)
        I ω̇ + ω × I ω = τ + o × Rᵀ(T y),   ẍ = c̈ + s,   s = R (ω̇ × o + ω × (ω × o))               (3), (4)

    By (3), ω̇ = α + T a and s = s₀ + T R (a × o), where a = I⁻¹(o × Rᵀy). Then (1)/M + (4) − (2)/m reads

        −l ÿ = f z/M + h + T (1/m + 1/M) y,   h = F_v/M − F_b/m + s,                                      (5)

    in which gravity cancels. Projecting (5) onto y, with y · ÿ = −|ẏ|², yields T; the factor of T is positive:

        T (1/m + 1/M + (o × Rᵀy) · a) = l |ẏ|² − y · (f z/M + h₀),   h₀ = F_v/M − F_b/m + s₀                (6)

    The part of (5) tangent to S² yields ÿ, and M (4) + (1) + (2) yields ẍ. For F_v = F_b = o = 0 these reduce to the
    paper's (ddty), (xeqn_txt) and (Rfin).

    An extended rod is a point bob m at l and a mass M − M₀ at the pivot (see `Vehicle`), M₀ being the vehicle's own. So
    c, o, I and τ above are those of the rigid body of vehicle and pivot mass; thrust and F_v act at the vehicle's own
    centre of mass, −s o from c, s = (M − M₀)/M. F_b acts at the centre of mass of the rod, λ l from the pivot: its
    share λ counts at the bob, the rest at the pivot. A torque Q of the joint on the rod and the rod's spin S act on it
    like forces P on the bob and −P at the pivot, l y × P = Q − S ẏ, and −Q on the vehicle.

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
    disturbance : Disturbance
        Forces and joint, in the same frame.

    Returns
    -------
    Rates
        Rates of the state; `x_ddot` is the acceleration of the pivot.
    """
    vehicle = vehicle.in_frame(e3)
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    R, omega, y = state.R, state.omega, state.y
    f, z = wrench.thrust, state.z
    speed_squared = dot(state.y_dot, state.y_dot)
    o, I, I_inv, moment, F_v, F_b = _of_rigid_body(vehicle, state, wrench, disturbance)
    if disturbance.joint_torque is not None or disturbance.spin is not None:
        torque = 0 * state.y if disturbance.joint_torque is None else disturbance.joint_torque
        P = on_rod(state, torque, disturbance.spin, l)
        back = transpose(R)
        F_v, F_b, moment = F_v - P, F_b + P, moment - apply(back, torque) - cross(o, apply(back, P))

    arm = cross(o, apply(transpose(R), y))  # moment per unit tension, body frame
    a = apply(I_inv, arm)  # (3)
    alpha = apply(I_inv, moment - gyroscopic_moment(I, omega))
    s_0 = apply(R, swing_around(o, omega, alpha))  # (4)
    h_0 = F_v / M - F_b / m + s_0
    T = (l * speed_squared - f / M * dot(y, z) - dot(y, h_0)) / (1 / m + 1 / M + dot(arm, a))  # (6)

    s_T = scale(T, apply(R, cross(a, o)))
    y_ddot = scale(f / (M * l), hat_squared(y, z)) - scale(speed_squared, y)  # (5), (ddty)
    y_ddot = y_ddot + hat_squared(y, (h_0 + s_T) / l)
    x_ddot = gravity_vector(vehicle, e3) + scale(f / (M + m), z) - m * l / (M + m) * y_ddot  # (xeqn_txt)
    x_ddot = x_ddot + (F_v + F_b + M * (s_0 + s_T)) / (M + m)
    return Rates(state.x_dot, x_ddot, R @ hat(omega), alpha + scale(T, a), state.y_dot, y_ddot)


def _of_rigid_body(
    vehicle: Vehicle, state: State, wrench: Wrench, disturbance: Disturbance
) -> tuple[Vector, Matrix, Matrix, Vector, Vector, Vector]:
    """Return o, I, I⁻¹, the moment, F_v and F_b of the rigid body of vehicle and pivot mass, and the point bob."""
    offset = disturbance.pivot_offset
    on_vehicle, on_rod = scale(1.0, disturbance.force_on_vehicle), scale(1.0, disturbance.force_on_bob)
    if is_point(vehicle):
        return offset, vehicle.I, vehicle.I_inv, wrench.moment, on_vehicle, on_rod
    own, M, o = vehicle.mass, vehicle.M, scale(1.0, offset)
    share = 1 - own / M
    I = vehicle.I - own * share * (hat(o) @ hat(o))  # parallel axes, reduced mass
    at_pivot, on_bob = share_out(on_rod, vehicle)
    back = transpose(state.R)
    pushed = apply(back, on_vehicle) + scale(wrench.thrust, E3)
    moment = wrench.moment - cross(share * o, pushed) + cross((1 - share) * o, apply(back, at_pivot))
    inverse = ca.inv_minor(I) if is_symbolic(I) else np.linalg.inv(I)
    return (1 - share) * o, I, inverse, moment, on_vehicle + at_pivot, on_bob
