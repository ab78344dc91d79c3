"""The joint of the rod beyond a free one at the centre of mass: friction, and a rod that spins about its own axis.

The joint resists the swing of the rod against the vehicle. About its own axis an axisymmetric rod turns freely, so that
its spin is a constant of motion: the angular momentum S along y, of which S ẏ is the rate.
"""

from __future__ import annotations

import numpy as np

from flypend.geometry import Scalar, Vector, apply, cross, dot, is_symbolic, scale, tangent_part
from flypend.model.state import State
from flypend.model.vehicle import Vehicle

# Dry friction has its full size well above this rate of swing, rad/s; below, a rod at rest creeps instead of sticking.
CREEP = 0.05


def swing(state: State) -> Vector:
    """Return the angular velocity (..., 3) of the rod relative to the vehicle, across the rod; world frame, rad/s."""
    body = apply(state.R, state.omega)
    return cross(state.y, state.y_dot) - tangent_part(state.y, body)


def friction(state: State, vehicle: Vehicle) -> Vector:
    """Return the torque (..., 3) of the joint on the rod, world frame, N m; the vehicle feels the opposite.

    With w the `swing`: −(pivot_damping + pivot_friction/√(|w|² + `CREEP`²)) w.
    """
    w = swing(state)
    size = (dot(w, w) + CREEP**2) ** 0.5
    return scale(-(vehicle.pivot_damping + vehicle.pivot_friction / size), w)


def stiffness(vehicle: Vehicle) -> float:
    """Return the largest rate, 1/s, at which friction stops the swing."""
    lightest = float(np.linalg.eigvalsh(vehicle.I)[0])
    resistance = vehicle.pivot_damping + vehicle.pivot_friction / CREEP
    return float(resistance * (1 / lightest + 1 / (vehicle.m * vehicle.l**2)))


def on_rod(state: State, torque: Vector, spin: Scalar | None, l: Scalar) -> Vector:
    """Return the force P (..., 3) on the bob, at `l` (m), that with −P at the pivot is a `torque` on the rod, N.

    The `torque` (..., 3), N m, is across the rod. Beside it the rod's `spin` S (kg m²/s), if it spins, takes S ẏ, by
    which its angular momentum S y changes: l y × P = torque − S ẏ.
    """
    taken = torque if spin is None else torque - scale(spin, state.y_dot)
    pair = cross(taken, state.y)
    return pair / l if is_symbolic(pair) else scale(1 / l, pair)
