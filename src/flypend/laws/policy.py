"""What a policy sees, and what its actions mean: in environments, and in flights of the policy as a law."""

from __future__ import annotations

from typing import Literal

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Scalar, Vector
from flypend.model import State, Vehicle

Attitude = Literal["matrix", "6d", "body"]
ATTITUDES: dict[int, Attitude] = {24: "matrix", 21: "6d", 18: "body"}  # by the numbers that are seen of a state


def observe_state(state: State, attitude: Attitude) -> Numbers:
    """Return what is seen of a `state` with e₃ up (24, 21 or 18, 1), in CasADi: x, ẋ, attitude, ω, y and ẏ.

    Position and velocity of the pivot are relative to the goal. The attitude is R by columns, or its first two ("6d");
    or, with "body", the vertical Rᵀe₃, all vectors being in the body frame. What is seen is then the same whatever the
    heading.
    """
    if attitude == "body":
        x, x_dot, y, y_dot = (to_body(state, vector) for vector in (state.x, state.x_dot, state.y, state.y_dot))
        return ca.vertcat(x, x_dot, state.R[2, :].T, state.omega, y, y_dot)
    columns = 3 if attitude == "matrix" else 2
    return ca.vertcat(state.x, state.x_dot, ca.vec(state.R[:, :columns]), state.omega, state.y, state.y_dot)


def to_body(state: State, vector: Vector) -> Vector:
    """Return a `vector` (3, 1) of the world frame in the body frame: Rᵀ times it."""
    return ca.mtimes(state.R.T, vector)


def rotor_action(action: Vector, vehicle: Vehicle) -> Vector:
    """Return the rotor forces (n,), N, of an `action` (n,) in [−1, 1]: from the least to the largest."""
    low, high = vehicle.rotor_limits
    return low + (high - low) * (action + 1) / 2


def thrust_action(action: Scalar, vehicle: Vehicle) -> Scalar:
    """Return the thrust, N, of an `action` in [−1, 1]: from none to the largest of all rotors."""
    return len(vehicle.rotor_spins) * vehicle.rotor_limits[1] * (action + 1) / 2


def moment_action(action: Vector, vehicle: Vehicle) -> Vector:
    """Return the moment (3,), N m, of an `action` (3,) in [−1, 1].

    A 1 is half of what the rotors give, each with its largest force in the way that turns the vehicle.
    """
    return np.abs(vehicle.mixing()[1:]).sum(axis=1) * vehicle.rotor_limits[1] / 2 * action
