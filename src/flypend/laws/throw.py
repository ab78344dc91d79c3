"""The outer loops of the inverted law: what the bob should do, what the rod should do, and the force for both."""

from __future__ import annotations

from typing import Any, NamedTuple

import casadi as ca

from flypend.geometry import E1, E3, cross, dot, norm, scale, tangent_part, unit
from flypend.laws.references import Path, Reference
from flypend.model import Vehicle

# A continuous pull on S² vanishes somewhere opposite to its aim. Not at rest hanging, where people start: the point is
# moved aside by this angle, rad.
ANTIPODE_SHIFT = 0.03


def carrying(reference: Reference) -> Path:
    """The path of a bob carried so that the pivot is at `reference`(t).

    The rod leans along g e₃ − F_b/m + p̈ with p = x_ref + l y, which is solved by two fixed-point steps; each shrinks
    the error by (rate of the reference)² l/g.
    """

    def path(t: Any, vehicle: Vehicle, on_bob: Any) -> tuple[Any, Any, Any]:
        x_ref = reference(t)
        support = vehicle.g * E3 - on_bob / vehicle.m
        y = unit(support)
        for _ in range(2):
            acceleration = derivatives(x_ref + vehicle.l * y, t, 2)[-1]
            y = unit(support + acceleration)
        return x_ref, x_ref + vehicle.l * y, y

    return path


def bob_reference(t: Any, reference: Reference, vehicle: Vehicle, on_bob: Any) -> tuple[Any, Any, Any, Any, Any]:
    """Position of the bob, its first three derivatives, and rod direction, for the pivot to be at `reference`(`t`).

    `on_bob` is the external force F_b on the bob of `vehicle`, N. See `carrying`.
    """
    _, position, y = carrying(reference)(t, vehicle, on_bob)
    return position, *derivatives(position, t, 3), y


def derivatives(value: Any, t: Any, count: int) -> list[Any]:
    """The first `count` derivatives of the expression `value` with respect to the symbol `t`."""
    out = []
    for _ in range(count):
        value = ca.jacobian(value, t)
        out.append(value)
    return out


def bob_acceleration(e: Any, v: Any, y: Any, k: Any) -> Any:
    """Acceleration asked of the bob at position error `e` (m), velocity error `v` (m/s) and rod `y`, less gravity.

    A position loop with softly limited error, and a throw: an upward speed asked for while the rod is low.
    """
    limited = soft(e, k.position_reach)
    throw = k.throw_speed * low_rod(y, k)
    up = -(k.height_bandwidth**2) * limited[2] - 2 * k.height_damping * k.height_bandwidth * (v[2] - throw)
    vertical = ca.fmax(up, 0) + soft(ca.fmin(up, 0), k.descent_limit)
    horizontal = -(k.position_bandwidth**2) * limited[:2] - 2 * k.position_damping * k.position_bandwidth * v[:2]
    return ca.vertcat(soft(horizontal, k.level_limit), vertical)


def flip_permission(y: Any, height: Any, climb: Any, k: Any) -> Any:
    """1 where the bob climbs fast enough (`climb`, m/s), is high enough (`height` of the pivot, m) to flip, else 0.

    Flipping takes thrust away from the bob for a while; the permission comes when it can afford that.
    """
    return smooth_step((climb + k.flip_by_height * height + k.flip_by_rod * y[2] - k.flip_speed) / k.flip_width)


def low_rod(y: Any, k: Any) -> Any:
    """1 while the rod `y` is low, exactly 0 near upright, so that the throw leaves the equilibrium alone."""
    return smooth_step((k.high_above - y[2]) / (k.high_above - k.low_below))


def rod_force(
    e: Any,
    v: Any,
    a_ref: Any,
    jerk_ref: Any,
    y: Any,
    y_dot: Any,
    height: Any,
    on: tuple[Any, Any],
    vehicle: Vehicle,
    k: Any,
) -> Any:
    """Force on the quadrotor (3, 1), N, that steers rod and bob.

    Parameters
    ----------
    e, v : SX (3, 1)
        Position and velocity error of the bob, m, m/s.
    a_ref, jerk_ref : SX (3, 1)
        Acceleration of the bob's reference and its rate.
    y, y_dot : SX (3, 1)
        Rod and its rate.
    height : SX
        Height of the pivot above its reference, m.
    on : (SX, SX)
        External forces on vehicle and bob, N.
    vehicle, k
        The vehicle and the gains.
    """  # fmt: skip
    wish = demand(e, v, a_ref, jerk_ref, y, y_dot, vehicle.g * E3 - on[1] / vehicle.m, k)
    return steering_force(wish, v[2], y, y_dot, height, on, vehicle, k)


class Demand(NamedTuple):
    """What the bob asks of the rod, each (3, 1): A, its direction d = A/|A|, Ȧ, and ω_d = d × ḋ."""

    A: Any
    d: Any
    A_dot: Any
    omega_d: Any


def demand(e: Any, v: Any, a_ref: Any, jerk_ref: Any, y: Any, y_dot: Any, weight: Any, k: Any) -> Demand:
    """A, d = A/|A|, Ȧ by a Lie derivative along the ideal bob, p̈ = (A·y) y − `weight`, and ω_d = d × Ȧ/|A|.

    The law is a function of errors that are expressions themselves, so the derivative is taken on symbols of its own.
    Arguments as in `rod_force`.
    """
    at = [ca.SX.sym(name, 3) for name in ("e", "v", "a", "y")]
    asked = weight + at[2] + bob_acceleration(at[0], at[1], at[3], k)
    rates = ca.vertcat(at[1], scale(dot(asked, at[3]), at[3]) - weight - at[2], jerk_ref, y_dot)
    rate = ca.jtimes(asked, ca.vertcat(*at), rates)
    A, A_dot = ca.substitute([asked, rate], at, [ca.densify(value) for value in (e, v, a_ref, y)])
    per_length = 1 / norm(A)
    d = scale(per_length, A)
    return Demand(A, d, A_dot, cross(d, scale(per_length, A_dot)))  # ḋ = P_d Ȧ/|A|, and d × P_d = d ×


def steering_force(
    wish: Demand, climb: Any, y: Any, y_dot: Any, height: Any, on: tuple[Any, Any], vehicle: Vehicle, k: Any
) -> Any:
    """Force on the quadrotor (3, 1), N, that turns the rod to the demand `wish` of a bob rising at `climb` m/s.

    Other arguments as in `rod_force`.
    """
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    on_vehicle, on_bob = on
    A, d, _, omega_d = wish

    # Rod on S²: Lemma 2 towards d without the acceleration of d, its stiffness turned round until the flip is allowed.
    v_e = y_dot - cross(omega_d, y)  # τ(y, d) ḋ = ω_d × y
    low = low_rod(y, k)
    share = 1 - low * (1 - flip_permission(y, height, climb, k)) * (1 + k.hanging_share)
    pull = tangent_part(y, d + ANTIPODE_SHIFT * low * E1)
    u = share * k.rod_bandwidth**2 * pull - 2 * k.rod_damping * k.rod_bandwidth * v_e
    u = u + scale(dot(y, omega_d), cross(y, y_dot))

    difference = on_bob / m - on_vehicle / M
    F = -M * l * u + scale((M + m) * dot(A, y) + M * l * dot(y_dot, y_dot), y) + M * difference
    swing = k.pump_share * low
    F = (1 - swing) * F + swing * pumping_force(A, y, y_dot, vehicle, k)
    return limited_force(F, k.thrust_share * largest_thrust(vehicle))


def pumping_force(A: Any, y: Any, y_dot: Any, vehicle: Vehicle, k: Any) -> Any:
    """Force on the quadrotor (3, 1), N, that carries everything as `A` asks and swings the rod up by its energy.

    Under the force (M+m) g e₃ the rod is a pendulum, ÿ + |ẏ|² y = −w² P_y e₃ with w² = (M+m) g/(M l), of energy
    E = |ẏ|²/2 + w² y₃ and E = w² upright at rest. The rest of F, M l κ (E/w² − 1) ẏ, makes Ė = −κ (E/w² − 1) |ẏ|².
    """
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    w_squared = vehicle.weight / (M * l)
    missing = 1 - (dot(y_dot, y_dot) / 2 / w_squared + y[2])
    push = y_dot + ANTIPODE_SHIFT * ca.sqrt(w_squared) * E1  # off the rest that hangs, where people start
    return (M + m) * A - scale(M * l * k.pump_rate * missing, push)


def largest_thrust(vehicle: Vehicle) -> Any:
    """Sum of the largest rotor forces, N."""
    return vehicle.rotor_limits[1] * len(vehicle.rotor_spins)


def limited_force(F: Any, limit: Any) -> Any:
    """F/(1 + (|F|/limit)⁸)^(1/8): a saturation of high order, because a soft one would shift hover."""
    ratio = dot(F, F) / limit**2
    return F / ca.sqrt(ca.sqrt(ca.sqrt(1 + ratio**4)))


def lifted(F: Any, tilt: Any) -> Any:
    """F with its vertical part raised until it is no further than `tilt` (rad, below π) from e₃."""
    level = ca.sqrt(F[0] ** 2 + F[1] ** 2 + 1e-12)
    return ca.vertcat(F[:2], ca.fmax(F[2], level * ca.cos(tilt) / ca.sin(tilt)))


def soft(value: Any, limit: Any) -> Any:
    """Value/√(1 + |value|²/limit²): `value` for small ones, never longer than `limit`."""
    return value / ca.sqrt(1 + ca.dot(value, value) / limit**2)


def smooth_step(q: Any) -> Any:
    """0 below q = 0, 1 above q = 1, exactly, and twice differentiable, so that none jumps in ż_d."""
    q = ca.fmin(ca.fmax(q, 0), 1)
    return q * q * q * (10 - q * (15 - 6 * q))


def coasted(y: Any, y_dot: Any, time: Any) -> tuple[Any, Any]:
    """Rod direction and rate after coasting for `time` s: y + time ẏ drawn back to the sphere, and its velocity."""
    factor = 1 / norm_of_sum(y_dot, time)
    return scale(factor, y + time * y_dot), scale(factor, y_dot - scale(time * dot(y_dot, y_dot), y))


def norm_of_sum(y_dot: Any, time: Any) -> Any:
    """|y + time ẏ| for tangent ẏ."""
    return ca.sqrt(1 + time**2 * dot(y_dot, y_dot))
