"""Inverted hover under constant forces from outside: rod and thrust lean against them. How near it a state is."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.geometry import cross
from flypend.model import Vehicle
from flypend.model.state import SIZE
from flypend.planning.scaled import Units

Array = NDArray[np.float64]
LEAST = 1e-3  # weights: shorter forces have no direction
# In hover, own units, are at most: distance, speed, lean of the thrust axis (rad), spin, lean of the rod, its rate.
SETTLED = (0.15, 0.15, 0.2, 0.5, 0.1, 0.2)
# It is over when y + ẏ, which grows if nothing is done, is so far from upright, or the pivot so far away.
FALLING, AWAY = 0.35, 2.0
ATTITUDE, ROD, AXIS = slice(6, 15), slice(18, 21), [8, 11, 14]  # of a packed state


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
    first /= np.sqrt(first @ first)
    found = np.zeros(SIZE + rotors)
    found[ATTITUDE] = np.array([first, cross(z, first), z]).T.ravel()
    found[ROD], found[SIZE:] = y, thrust
    return found


def hovers(here: Any, level: Any, units: Units) -> bool:
    """Whether a state is so near hover that the law keeps it there.

    Parameters
    ----------
    here : (24,)
        The state relative to the reference.
    level : (3,), (3,)
        Rod and thrust axis in hover.
    units : Units
        Units of the vehicle.
    """
    own, (y, z) = here / units.of_state, level
    rod, axis = own[ROD], own[AXIS]
    if rod @ y < 0 or axis @ z < 0:
        return False
    # Spin about the thrust axis does no harm.
    off = (own[:3], own[3:6], axis - z, own[15:17], rod - y, own[21:24])
    return all(e @ e < most * most for e, most in zip(off, SETTLED, strict=True))


def falls(here: Any, level: Any, units: Units) -> bool:
    """Whether a state is so far from hover that a plan is due; see `hovers`."""
    own, (y, _) = here / units.of_state, level
    rod, x = own[ROD], own[:3]
    falling = rod + own[21:24] - y
    return bool(rod @ y < 0 or falling @ falling > FALLING**2 or x @ x > AWAY**2)
