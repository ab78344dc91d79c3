"""What a policy sees, and what its actions mean: in environments, and in flights of the policy as a law."""

from __future__ import annotations

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Scalar, Vector
from flypend.model import State, Vehicle


def observe_state(state: State, columns: int) -> Numbers:
    """Return x, ẋ, the first `columns` of R, ω, y and ẏ (15 + 3 columns, 1) of a `state` with e₃ up, in CasADi.

    Position and velocity of the pivot are relative to the goal.
    """
    return ca.vertcat(state.x, state.x_dot, ca.vec(state.R[:, :columns]), state.omega, state.y, state.y_dot)


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
