"""The moment that moves the thrust axis on S², the paper's (setmu) solved for the rotation normal to the axis.

A vehicle that spins too fast to turn its axis at will is a gyroscope, which is righted, braked and stopped. Turning the
axis of a body with spin ω₃ at the rate v takes the moment I₃ ω₃ v. In the body, that moment turns with −ω₃, and rotors
of lag T follow it with 1/√(1 + (ω₃ T)²) of its amplitude. So the axis is led upright no faster than what is left
allows, by the gyroscopic moment of the motion *demanded*: that of the actual motion would do no work on the axis and
leave nothing to damp it with. Yaw comes last in the allocation, so thrust leaves room for it. The rod hangs until the
spin is gone.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import casadi as ca

from flypend.geometry import E3, Numbers, Scalar, Vector, apply, cross
from flypend.laws.smooth import smooth_step, soft
from flypend.model import State, Vehicle
from flypend.model.dynamics import gyroscopic_moment

# Spin about the thrust axis, in units of the one at which turning the axis as fast as the vehicle flips takes all
# moment there is: up to one unit the gyroscopic moment is compensated; from here on not at all.
SPUN = 2.0
# Of the largest thrust, while the vehicle spins; the rest is the yaw moment's. Reached at 1.6 units of spin.
THRUST_SHARE, WIDTH = 0.65, 1.5
# Of the largest angular acceleration that rotors with a lag can still turn with the body: to lead the axis, and to damp
# it. With 1.0 for the first, 5 of 60 crazyflies at 40 rad/s are not stopped in 20 s; with 1.4 all are.
LEADING, DAMPING = 1.4, 0.25
# Of g, at a speed of √(g l) and more: acceleration that brakes level motion, climb and fall.
LEVEL, CLIMB, FALL = 0.4, 0.5, 1.0


def axis_rate(state: State) -> Vector:
    """Return ż = R (ω × e₃) (3, 1), 1/s."""
    return apply(state.R, cross(state.omega, E3))


def axis_moment(
    state: State, vehicle: Vehicle, u: Vector, yaw: Scalar, *, turned: Scalar = 0.0, compensated: Scalar = 1.0
) -> Vector:
    """Return the moment (3, 1), N m, under which z̈ = −|ż|² z + R `u` and ω̇₃ = `yaw`, rad/s².

    `u` is in the body frame and normal to e₃, 1/s²; `vehicle` has its inertia in the body frame of `state` (see
    `Vehicle.in_frame`). `turned` is the angle, rad, by which the rotation wanted is turned about the axis beforehand.

    z̈ = R (ω̇ × e₃) + ω₃ R (ω₁, ω₂, 0) − |ż|² z, so (ω̇₁, ω̇₂, 0) = e₃ × u + ω₃ ω × e₃. (setmu) leaves ω̇₃ free.
    What follows from ω₃ is gyroscopic and does no work on the axis; only the share `compensated` is cancelled.
    """
    omega = state.omega
    turn = cross(E3, u) + compensated * omega[2] * cross(omega, E3)
    alpha = ca.vertcat(spin(turn[:2], turned), yaw)
    return apply(vehicle.I, alpha) + compensated * gyroscopic_moment(vehicle.I, omega)


def spin(v: Numbers, angle: Scalar) -> Numbers:
    """Return the plane vector (2, 1) turned by 2 atan(`angle`/2): `angle`, rad, where it is small, and below π."""
    half = angle / 2
    c, s = (1 - half**2) / (1 + half**2), 2 * half / (1 + half**2)
    return ca.vertcat(c * v[0] - s * v[1], c * v[1] + s * v[0])


class Spin(NamedTuple):
    """What a spin leaves to the law.

    calm : 1 for a vehicle that turns its axis at will, 0 for a gyroscope.
    thrust : the share of the largest thrust that may be used.
    acceleration : largest angular acceleration normal to the axis that the rotors can follow, rad/s².
    rate : rate at which the axis is led, rad/s.
    """

    calm: Scalar
    thrust: Scalar
    acceleration: Scalar
    rate: Scalar


def spin_of(state: State, vehicle: Vehicle, authority: Scalar, turn_rate: Scalar, rotor_lag: float) -> Spin:
    """Return what the spin of `state` leaves.

    `authority` is the angular acceleration that the rotors give at most, rad/s², and `turn_rate` the rate at which a
    vehicle without spin turns its axis, rad/s; `rotor_lag` is in s, a number where those of the vehicle are symbols.
    """
    spin, inertia = state.omega[2], vehicle.I
    transverse = ca.fmax(inertia[0, 0], inertia[1, 1])
    fast = transverse / inertia[2, 2] * ca.sqrt(authority)
    over = (spin / fast) ** 2 - 1
    calm = 1 - smooth_step(over / (SPUN**2 - 1))
    thrust = 1 - (1 - THRUST_SHARE) * smooth_step(over / WIDTH)
    acceleration = authority / ca.sqrt(1 + (rotor_lag * spin) ** 2)
    # A body that tumbles is damped first: a lead that turns as fast as it does, and lags, would drive it.
    tumbling = state.omega[0] ** 2 + state.omega[1] ** 2
    led = LEADING * acceleration * transverse / (inertia[2, 2] * ca.sqrt(spin**2 + fast**2))
    led = ca.fmin(led / (1 + tumbling / turn_rate**2), turn_rate)
    return Spin(calm, thrust, acceleration, calm * turn_rate + (1 - calm) * led)


def braking_force(state: State, vehicle: Vehicle) -> Vector:
    """Return the force (3, 1) on a vehicle with a hanging rod that brakes its motion, N."""
    v = state.x_dot / ca.sqrt(vehicle.g * vehicle.l)
    level = -LEVEL * soft(v[:2], 1)
    return vehicle.weight * (E3 + ca.vertcat(level, ca.fmin(ca.fmax(-v[2], -CLIMB), FALL)))


def gyroscopic_lead(state: State, vehicle: Vehicle, v_d: Numbers, share: Scalar) -> Vector:
    """Return `share` of the gyroscopic moment (3, 1), N m, of an axis that moves at `v_d` (3, 1), 1/s, body frame."""
    demanded = cross(E3, v_d)
    moving = replace(state, omega=ca.vertcat(demanded[:2], state.omega[2]))
    return axis_moment(moving, vehicle, ca.SX.zeros(3), 0, compensated=share)
