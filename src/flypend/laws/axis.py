"""The moment that moves the thrust axis on S², the paper's (setmu) solved for the rotation normal to the axis."""

from __future__ import annotations

import casadi as ca

from flypend.geometry import E3, Numbers, Scalar, Vector, apply, cross
from flypend.model import State, Vehicle
from flypend.model.dynamics import gyroscopic_moment


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
