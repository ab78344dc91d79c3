"""The outer loops of the inverted law: the demands on bob and rod, and the force that meets both."""

from __future__ import annotations

from types import SimpleNamespace
from typing import NamedTuple

import casadi as ca

from flypend.geometry import E3, Numbers, Scalar, Vector, cross, dot, norm, scale, tangent_part, unit
from flypend.laws.references import Path, Reference
from flypend.laws.smooth import positive, smooth_step, soft
from flypend.model import Vehicle
from flypend.model.momenta import carrying_force

# Rate at which the pump stops the rod's circling, in units of the rate of its energy. More than a half costs height.
CIRCLING = 0.4
# Rate at which the pump drives the rod's energy to its upright value, in units of √(g/l).
PUMP_RATE = 2.0
# Acceleration, in units of g, at which the pull of the position loop on a distant bob levels off.
FAR_PULL = 1.8
# Soft limit on the bob's horizontal acceleration, in units of g tan(tilt limit).
LEVEL_SHARE = 0.5
# Speed band, in units of √(g l), over which a flip becomes permitted.
FLIP_WIDTH = 0.2
# Of the largest thrust; below 1, so that the rotors keep some authority for moments.
THRUST_SHARE = 0.993


class Rod(NamedTuple):
    """The rod: direction `y` (3, 1) and its rate `y_dot` (3, 1), 1/s."""

    y: Vector
    y_dot: Vector


class Bob(NamedTuple):
    """The bob about its reference, each (3, 1).

    Errors `e`, m, and `v`, m/s; the reference's acceleration `a_ref`, m/s², and its rate `jerk_ref`, m/s³.
    """

    e: Vector
    v: Vector
    a_ref: Vector
    jerk_ref: Vector


class Pose(NamedTuple):
    """Vehicle and rod as the loops of bob and rod see them.

    `low` is 1 to throw the rod and 0 to catch it, see `low_rod`; `height` is the pivot's above its reference, m;
    `aside` (3, 1) and `clear` are as in `passage.Steering`.
    """

    low: Scalar
    height: Scalar
    aside: Vector
    clear: Scalar


class Demand(NamedTuple):
    """The bob's demand on the rod, each (3, 1): A, its direction d = A/|A|, Ȧ, and ω_d = d × ḋ."""

    A: Vector
    d: Vector
    A_dot: Vector
    omega_d: Vector


def bob_path(reference: Reference) -> Path:
    """Return the path of the balanced bob with the pivot at `reference`(t).

    The rod points along g e₃ − F_b/m + p̈ with p = x_ref + l y. Two fixed-point iterations solve for it; each reduces
    the error by a factor (rate of the reference)² l/g.
    """

    def path(t: Scalar, vehicle: Vehicle, on_bob: Vector) -> tuple[Vector, Vector, Vector]:
        x_ref = reference(t)
        support = vehicle.g * E3 - on_bob / vehicle.m
        y = unit(support)
        for _ in range(2):
            acceleration = derivatives(x_ref + vehicle.l * y, t, 2)[-1]
            y = unit(support + acceleration)
        return x_ref, x_ref + vehicle.l * y, y

    return path


def derivatives(value: Numbers, t: Scalar, count: int) -> list[Numbers]:
    """Return the first `count` derivatives of the expression `value` with respect to the symbol `t`."""
    out = []
    for _ in range(count):
        value = ca.jacobian(value, t)
        out.append(value)
    return out


def bob_acceleration(e: Vector, v: Vector, low: Scalar, g: Scalar, k: SimpleNamespace) -> Vector:
    """Return the bob's desired acceleration at position error `e` (m) and velocity error `v` (m/s), `low` as below.

    A position loop with a soft limit on the error, plus a throw: an upward speed demand while the rod is low. Gravity
    `g` is not included. The horizontal part is limited as the tilt of the thrust axis is: not at all where the axis may
    lean below the horizon.
    """
    limited = soft(e, FAR_PULL * g / k.position_bandwidth**2)
    throw = k.throw_speed * low
    up = -(k.height_bandwidth**2) * limited[2] - 2 * k.position_damping * k.height_bandwidth * (v[2] - throw)
    rising = positive(up)
    vertical = rising + soft(up - rising, k.descent_limit)
    horizontal = -(k.position_bandwidth**2) * limited[:2] - 2 * k.position_damping * k.position_bandwidth * v[:2]
    excess = ca.fmax(ca.cos(k.tilt_limit), 0) / ca.sin(k.tilt_limit) / (LEVEL_SHARE * g)
    level = horizontal / ca.sqrt(1 + excess**2 * ca.dot(horizontal, horizontal))
    return ca.vertcat(level, vertical)


def flip_permission(y: Vector, height: Scalar, climb: Scalar, vehicle: Vehicle, k: SimpleNamespace) -> Scalar:
    """Return 1 where the bob's `climb` (m/s) and the pivot's `height` (m) suffice for a flip, else 0.

    A flip takes thrust away from the bob for a while; permission is granted once that is affordable.
    """
    width = FLIP_WIDTH * ca.sqrt(vehicle.g * vehicle.l)
    return smooth_step((climb + k.flip_by_height * height + k.flip_by_rod * y[2] - k.flip_speed) / width)


def low_rod(rod: Rod, z: Vector, up: Vector, k: SimpleNamespace) -> Scalar:
    """Return 1 where the `rod` is too low to be caught, and exactly 0 near `up`, to leave the equilibrium alone.

    `up` is the direction of a rod that is balanced along the reference, e₃ if that does not accelerate. What counts is
    the lean 1 − y·up after coasting for a while, plus z·P_y up: a thrust axis on the side to which the rod leans is
    half way to catching it. With `mounting.side`, also on which side of the rotor plane the rod is.
    """
    y = rod.y
    ahead = coast(rod, k.catch_time).y
    along, high = dot(y, z), dot(y, up)
    lean = 1 - dot(ahead, up) + k.catch_by_axis * (dot(z, up) - high * along) - k.mounting.side * along * (1 - high)
    return smooth_step((lean - k.catch_within) / k.catch_width)


def rod_force(
    bob: Bob, rod: Rod, pose: Pose, forces: tuple[Vector, Vector], vehicle: Vehicle, k: SimpleNamespace
) -> Vector:
    """Return the force on the quadrotor (3, 1), N, that controls `rod` and `bob`.

    `forces` are the external ones on vehicle and bob, each (3, 1), N; `k` has the gains.
    """
    wish = demand(bob, rod, pose.low, forces[1], vehicle, k)
    return steering_force(wish, bob.v[2], rod, pose, forces, vehicle, k)


def demand(bob: Bob, rod: Rod, low: Scalar, on_bob: Vector, vehicle: Vehicle, k: SimpleNamespace) -> Demand:
    """Return A, d = A/|A|, Ȧ, the Lie derivative along the ideal bob, p̈ = (A·y) y − g e₃ + F_b/m, and ω_d = d × Ȧ/|A|.

    The errors are expressions themselves, so the derivative is taken with respect to fresh symbols. `low` as in `Pose`;
    `on_bob` (3, 1) is F_b, N.
    """
    weight = vehicle.g * E3 - on_bob / vehicle.m
    e, v, a, y = at = [ca.SX.sym(name, 3) for name in ("e", "v", "a", "y")]
    asked = weight + a + bob_acceleration(e, v, low, vehicle.g, k)
    rates = ca.vertcat(v, scale(dot(asked, y), y) - weight - a, bob.jerk_ref, rod.y_dot)
    rate = ca.jtimes(asked, ca.vertcat(*at), rates)
    A, A_dot = ca.substitute([asked, rate], at, [ca.densify(value) for value in (bob.e, bob.v, bob.a_ref, rod.y)])
    per_length = 1 / norm(A)
    d = scale(per_length, A)
    return Demand(A, d, A_dot, cross(d, scale(per_length, A_dot)))  # ḋ = P_d Ȧ/|A|, and d × P_d = d ×


def steering_force(
    wish: Demand,
    climb: Scalar,
    rod: Rod,
    pose: Pose,
    forces: tuple[Vector, Vector],
    vehicle: Vehicle,
    k: SimpleNamespace,
) -> Vector:
    """Return the force on the quadrotor (3, 1), N, that turns the `rod` to `wish`, with the bob rising at `climb` m/s.

    Other arguments as in `rod_force`.
    """
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    (y, y_dot), (on_vehicle, on_bob) = rod, forces
    A, d, _, omega_d = wish

    # Rod on S²: Lemma 2 towards d without the acceleration of d; the stiffness has the opposite sign until a flip is
    # permitted.
    v_e = y_dot - cross(omega_d, y)  # τ(y, d) ḋ = ω_d × y
    permitted = pose.clear * flip_permission(y, pose.height, climb, vehicle, k)
    share = 1 - pose.low * (1 - permitted) * (1 + k.hanging_share)
    pull = tangent_part(y, d + k.mounting.shift * pose.low * pose.aside)
    u = share * k.rod_bandwidth**2 * pull - 2 * k.rod_damping * k.rod_bandwidth * v_e
    u = u + scale(dot(y, omega_d), cross(y, y_dot))

    difference = on_bob / m - on_vehicle / M
    F = -M * l * u + scale(carrying_force(dot(A, y), y_dot, vehicle), y) + M * difference
    if k.mounting.cone is not None:
        F = F + scale((1 - pose.low) * missing_along(F, y, k.mounting.cone), y)
    swing = k.pump_share * pose.low
    F = (1 - swing) * F + swing * pumping_force(A, rod, pose.aside, vehicle, k)
    return limit_force(F, THRUST_SHARE * largest_thrust(vehicle))


def missing_along(F: Vector, y: Vector, cone: Scalar) -> Scalar:
    """Return what F lacks along y, N, to be at most `cone` (rad, below π/2) from it; 0 if it is nearer."""
    along = dot(F, y)
    across = ca.sqrt(dot(F, F) - along**2 + 1e-12)
    return ca.fmax(across / ca.tan(cone) - along, 0)


def pumping_force(A: Vector, rod: Rod, aside: Vector, vehicle: Vehicle, k: SimpleNamespace) -> Vector:
    """Return the force on the quadrotor (3, 1), N, that meets the demand `A` and pumps the rod's energy.

    Under the force (M+m) g e₃ the rod is a pendulum, ÿ + |ẏ|² y = −w² P_y e₃ with w² = (M+m) g/(M l), of energy
    E = |ẏ|²/2 + w² y₃ and E = w² upright at rest. The rest of F, M l κ (E/w² − 1) ẏ, makes Ė = −κ (E/w² − 1) |ẏ|².
    A rod circling on a cone can have that energy too. M l κ Λ e₃ × y, with Λ = e₃·(y × ẏ), makes Λ̇ = −κ |e₃ × y|² Λ
    besides, so that it swings through the vertical in the end.
    """
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    y, y_dot = rod
    w_squared = vehicle.weight / (M * l)
    missing = 1 - (dot(y_dot, y_dot) / 2 / w_squared + y[2])
    push = y_dot + k.mounting.shift * ca.sqrt(w_squared) * aside  # moves it off the hanging rest, a common start
    circling = scale(dot(E3, cross(y, y_dot)), cross(E3, y))
    rate = PUMP_RATE * ca.sqrt(vehicle.g / l)
    return (M + m) * A - M * l * rate * (scale(missing, push) - CIRCLING * circling)


def largest_thrust(vehicle: Vehicle) -> Scalar:
    """Return the sum of the largest rotor forces, N."""
    return vehicle.rotor_limits[1] * len(vehicle.rotor_spins)


def limit_force(F: Vector, limit: Scalar) -> Vector:
    """Return F/(1 + (|F|/limit)⁸)^(1/8): a high-order saturation, since a softer one would shift hover."""
    ratio = dot(F, F) / limit**2
    return F / ca.sqrt(ca.sqrt(ca.sqrt(1 + ratio**4)))


def lift(F: Vector, tilt: Scalar) -> Vector:
    """Return F with its vertical part raised until F is at most `tilt` (rad, below π) from e₃; 0 stays 0."""
    level = ca.sqrt(F[0] ** 2 + F[1] ** 2 + 1e-12)
    return ca.vertcat(F[:2], ca.fmax(F[2], level * ca.cos(tilt) / ca.sin(tilt)))


def coast(rod: Rod, time: Scalar) -> Rod:
    """Return the `rod` after coasting for `time` s: y + time ẏ projected onto S², and its velocity."""
    y, y_dot = rod
    factor = 1 / ca.sqrt(1 + time**2 * dot(y_dot, y_dot))  # 1/|y + time ẏ| for tangent ẏ
    return Rod(scale(factor, y + time * y_dot), scale(factor, y_dot - scale(time * dot(y_dot, y_dot), y)))
