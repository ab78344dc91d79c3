"""The outer loops of the inverted law: the demands on bob and rod, and the force that meets both."""

from __future__ import annotations

from typing import Any, NamedTuple

import casadi as ca

from flypend.geometry import E1, E3, cross, dot, norm, scale, tangent_part, unit
from flypend.laws.references import Path, Reference
from flypend.model import Vehicle

# A continuous attracting field on S² vanishes at some other point; here, opposite its target. This angle, rad, shifts
# that point away from the rod that hangs at rest below its reference, a common start.
ANTIPODE_SHIFT = 0.03


def carrying(reference: Reference) -> Path:
    """Return the path of the balanced bob with the pivot at `reference`(t).

    The rod points along g e₃ − F_b/m + p̈ with p = x_ref + l y. Two fixed-point iterations solve for it; each reduces
    the error by a factor (rate of the reference)² l/g.
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
    """Return the bob's position, its first three derivatives, and the rod, with the pivot at `reference`(`t`).

    `on_bob` is the external force F_b on the bob of `vehicle`, N. See `carrying`.
    """
    _, position, y = carrying(reference)(t, vehicle, on_bob)
    return position, *derivatives(position, t, 3), y


def derivatives(value: Any, t: Any, count: int) -> list[Any]:
    """Return the first `count` derivatives of the expression `value` with respect to the symbol `t`."""
    out = []
    for _ in range(count):
        value = ca.jacobian(value, t)
        out.append(value)
    return out


def bob_acceleration(e: Any, v: Any, y: Any, k: Any) -> Any:
    """Return the bob's desired acceleration at position error `e` (m), velocity error `v` (m/s) and rod `y`.

    A position loop with a soft limit on the error, plus a throw: an upward speed demand while the rod is low. Gravity
    is not included.
    """
    limited = soft(e, k.position_reach)
    throw = k.throw_speed * low_rod(y, k)
    up = -(k.height_bandwidth**2) * limited[2] - 2 * k.height_damping * k.height_bandwidth * (v[2] - throw)
    rising = positive(up)
    vertical = rising + soft(up - rising, k.descent_limit)
    horizontal = -(k.position_bandwidth**2) * limited[:2] - 2 * k.position_damping * k.position_bandwidth * v[:2]
    return ca.vertcat(soft(horizontal, k.level_limit), vertical)


def flip_permission(y: Any, height: Any, climb: Any, k: Any) -> Any:
    """Return 1 where the bob's `climb` (m/s) and the pivot's `height` (m) suffice for a flip, else 0.

    A flip takes thrust away from the bob for a while; permission is granted once that is affordable.
    """
    return smooth_step((climb + k.flip_by_height * height + k.flip_by_rod * y[2] - k.flip_speed) / k.flip_width)


def low_rod(y: Any, k: Any) -> Any:
    """Return 1 while the rod `y` is low, and exactly 0 near upright, to leave the equilibrium unaffected."""
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
    """Return the force on the quadrotor (3, 1), N, that controls rod and bob.

    Parameters
    ----------
    e, v : SX (3, 1)
        Position and velocity error of the bob, m, m/s.
    a_ref, jerk_ref : SX (3, 1)
        Acceleration of the bob's reference, m/s², and its rate, m/s³.
    y, y_dot : SX (3, 1)
        Rod direction and its rate.
    height : SX
        Height of the pivot above its reference, m.
    on : (SX, SX)
        External forces on vehicle and bob, N.
    vehicle, k
        Vehicle and gains.
    """  # fmt: skip
    wish = demand(e, v, a_ref, jerk_ref, y, y_dot, vehicle.g * E3 - on[1] / vehicle.m, k)
    return steering_force(wish, v[2], y, y_dot, height, on, vehicle, k)


class Demand(NamedTuple):
    """The bob's demand on the rod, each (3, 1): A, its direction d = A/|A|, Ȧ, and ω_d = d × ḋ."""

    A: Any
    d: Any
    A_dot: Any
    omega_d: Any


def demand(e: Any, v: Any, a_ref: Any, jerk_ref: Any, y: Any, y_dot: Any, weight: Any, k: Any) -> Demand:
    """Return A, d = A/|A|, Ȧ, the Lie derivative along the ideal bob, p̈ = (A·y) y − `weight`, and ω_d = d × Ȧ/|A|.

    The errors are expressions themselves, so the derivative is taken with respect to fresh symbols. Other arguments
    as in `rod_force`; `weight` is g e₃ − F_b/m, m/s².
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
    """Return the force on the quadrotor (3, 1), N, that turns the rod to `wish`, with the bob rising at `climb` m/s.

    Other arguments as in `rod_force`.
    """
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    on_vehicle, on_bob = on
    A, d, _, omega_d = wish

    # Rod on S²: Lemma 2 towards d without the acceleration of d; the stiffness has the opposite sign until a flip is
    # permitted.
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
    """Return the force on the quadrotor (3, 1), N, that meets the demand `A` and pumps the rod's energy.

    Under the force (M+m) g e₃ the rod is a pendulum, ÿ + |ẏ|² y = −w² P_y e₃ with w² = (M+m) g/(M l), of energy
    E = |ẏ|²/2 + w² y₃ and E = w² upright at rest. The rest of F, M l κ (E/w² − 1) ẏ, makes Ė = −κ (E/w² − 1) |ẏ|².
    Only E is controlled: a rod circling on a cone at that energy stays there.
    """
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    w_squared = vehicle.weight / (M * l)
    missing = 1 - (dot(y_dot, y_dot) / 2 / w_squared + y[2])
    push = y_dot + ANTIPODE_SHIFT * ca.sqrt(w_squared) * E1  # moves it off the hanging rest, a common start
    return (M + m) * A - scale(M * l * k.pump_rate * missing, push)


def largest_thrust(vehicle: Vehicle) -> Any:
    """Return the sum of the largest rotor forces, N."""
    return vehicle.rotor_limits[1] * len(vehicle.rotor_spins)


def limited_force(F: Any, limit: Any) -> Any:
    """Return F/(1 + (|F|/limit)⁸)^(1/8): a high-order saturation, since a softer one would shift hover."""
    ratio = dot(F, F) / limit**2
    return F / ca.sqrt(ca.sqrt(ca.sqrt(1 + ratio**4)))


def lifted(F: Any, tilt: Any) -> Any:
    """Return F with its vertical part raised until F is at most `tilt` (rad, below π) from e₃; 0 stays 0."""
    level = ca.sqrt(F[0] ** 2 + F[1] ** 2 + 1e-12)
    return ca.vertcat(F[:2], ca.fmax(F[2], level * ca.cos(tilt) / ca.sin(tilt)))


def soft(value: Any, limit: Any) -> Any:
    """Return value/√(1 + |value|²/limit²): close to `value` if short, never longer than `limit`."""
    return value / ca.sqrt(1 + ca.dot(value, value) / limit**2)


def smooth_step(q: Any) -> Any:
    """Return exactly 0 below q = 0 and exactly 1 above q = 1; twice differentiable, so that ż_d has no jump."""
    q = 1 - positive(1 - positive(q))
    return q * q * q * (10 - q * (15 - 6 * q))


def positive(value: Any) -> Any:
    """Return `value` where it is positive, else 0: max(value, 0) with a derivative that takes one operation."""
    return value * (value > 0)


def coasted(y: Any, y_dot: Any, time: Any) -> tuple[Any, Any]:
    """Return rod direction and rate after coasting for `time` s: y + time ẏ projected onto S², and its velocity."""
    factor = 1 / norm_of_sum(y_dot, time)
    return scale(factor, y + time * y_dot), scale(factor, y_dot - scale(time * dot(y_dot, y_dot), y))


def norm_of_sum(y_dot: Any, time: Any) -> Any:
    """Return |y + time ẏ| for tangent ẏ."""
    return ca.sqrt(1 + time**2 * dot(y_dot, y_dot))
