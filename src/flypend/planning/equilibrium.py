"""Inverted hover under constant forces from outside: rod and thrust lean against them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.model import State, Vehicle

Array = NDArray[np.float64]
LEAST = 1e-3  # weights: shorter forces have no direction


def weighed(forces: Any, acceleration: Any, vehicle: Vehicle) -> Array:
    """Return `forces` (6,) on vehicle and bob, N, in weights, in a frame with an `acceleration` (3,), m/s²."""
    found: Array = np.concatenate([forces[:3] - vehicle.M * acceleration, forces[3:] - vehicle.m * acceleration])
    return found / vehicle.weight


def upright(outside: Any, m: float) -> tuple[Array, Array, float]:
    """Return directions of rod and thrust (3,), and the thrust, in hover under forces `outside` (6,), all in weights.

    `m` is the share of the bob in the mass.
    """
    rod, thrust = -outside[3:], -outside[:3] - outside[3:]
    rod[2] += m
    thrust[2] += 1
    size = np.sqrt(thrust @ thrust)
    return rod / max(np.sqrt(rod @ rod), LEAST * m), thrust / max(size, LEAST), float(size)


def hover_under(outside: Any, m: float, rotors: int) -> Array:
    """Return state and `rotors` (24 + n,), own units, of hover under forces `outside` (6,); see `upright`."""
    y, z, thrust = upright(outside, m)
    first = np.array([1 - z[0] * z[0], -z[0] * z[1], -z[0] * z[2]])
    first /= np.linalg.norm(first)
    R = np.column_stack([first, np.cross(z, first), z])
    return np.append(State(y=y, R=R).packed(), np.full(rotors, thrust))
