"""The equations of motion in momenta, which fall apart into a cascade: rotation, rod, centre of mass.

With the pivot at the vehicle's centre of mass, nothing but the moment turns the vehicle, the rod feels of the vehicle
only its thrust f z, and the centre of mass c of both bodies feels only forces from outside. With H = y × ẏ,

    I ω̇ = τ − ω × I ω,   Ṙ = R ω̂                                                                     (rotation)
    ẏ = H × y,   Ḣ = y × b,   b = (F_b/m − F_v/M − f z/M)/l                                            (rod)
    (M+m) c̈ = f z + F_v + F_b − (M+m) g e₃,   c = x + m l/(M+m) y                                      (centre)

They are those of `model.motion` for a pivot offset of zero.
"""

from __future__ import annotations

from flypend.geometry import Scalar, Vector, apply, dot, scale
from flypend.model.dynamics import gyroscopic_moment
from flypend.model.vehicle import Vehicle


def angular_acceleration(moment: Vector, omega: Vector, vehicle: Vehicle) -> Vector:
    """Return ω̇ (..., 3), rad/s², at angular velocity `omega` under `moment`, N m, both in the body frame."""
    return apply(vehicle.I_inv, moment - gyroscopic_moment(vehicle.I, omega))


def moment_for(alpha: Vector, omega: Vector, vehicle: Vehicle) -> Vector:
    """Return the moment (..., 3), N m, under which ω̇ is `alpha`, rad/s²: the inverse of `angular_acceleration`."""
    return apply(vehicle.I, alpha) + gyroscopic_moment(vehicle.I, omega)


def lever(vehicle: Vehicle) -> Scalar:
    """Return the distance c − x of the centre of mass of both bodies from the pivot, m l/(M+m), m."""
    return vehicle.m * vehicle.l / (vehicle.M + vehicle.m)


def pull_on_rod(thrust: Scalar, z: Vector, vehicle: Vehicle) -> Vector:
    """Return the part of b (..., 3), 1/s², that the `thrust` (N) along `z` exerts: −f z/(M l)."""
    return scale(-1 / (vehicle.M * vehicle.l) * thrust, z)


def carrying_force(a: Scalar, y_dot: Vector, vehicle: Vehicle) -> Scalar:
    """Return the force on the vehicle along the rod, N, under which the bob accelerates by a y − g e₃."""
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    return (M + m) * a + M * l * dot(y_dot, y_dot)


def outside_on_rod(on_vehicle: Vector, on_bob: Vector, vehicle: Vehicle) -> Vector:
    """Return the part of b (..., 3), 1/s², that external forces on vehicle and bob (N) exert: (F_b/m − F_v/M)/l."""
    return (on_bob / vehicle.m - on_vehicle / vehicle.M) / vehicle.l


def split_force(total: Vector, difference: Vector, vehicle: Vehicle) -> tuple[Vector, Vector]:
    """Return the forces F_v and F_b (..., 3), N, with this `total` and `difference` F_b/m − F_v/M, m/s²."""
    M, m = vehicle.M, vehicle.m
    on_bob = m * M / (M + m) * (difference + total / M)
    return total - on_bob, on_bob
