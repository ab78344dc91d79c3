"""Constant rotor forces that keep the rod off the parts of a mount while there is no plan, where the law would touch.

A law knows nothing of the mount. What may keep the rod away is all rotors at a limit or in hover, or those on one side
of the pivot at one limit and the others at the other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flypend.model import State, Vehicle, Wrench
from flypend.model.mount import margins
from flypend.model.state import SIZE
from flypend.planning.nominal import stepping

DIRECTIONS, STEPS = 8, 12
BEYOND = 0.5  # of the wait, so much longer the rod has to keep away: a plan must be able to begin

Array = NDArray[np.float64]


def room(path: Array, vehicle: Vehicle) -> float:
    """Return the least margin of the mount along a `path` (k, 24 + n) of states and rotor forces; see `model.mount`."""
    wrench = path[:, SIZE:] @ vehicle.mixing().T
    found = margins(State.trusted(path[:, :SIZE]), Wrench(wrench[:, 0], wrench[:, 1:]), vehicle, "up")
    return float(np.min(found))


def evasion(vehicle: Vehicle, state: Array, rotors: Array, wait: float) -> tuple[Array, float, Array]:
    """Return the constant command that keeps the rod best on its mount for a `wait` (s), that room, and the end.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle, with a mount that limits the rod.
    state, rotors : (24,), (n,)
        State and rotor forces at the beginning.
    wait : float
        Duration, s.

    Returns
    -------
    command, room, end : (n,), float, (24 + n,)
        The command, N, its `room`, and state and rotor forces after the wait.
    """
    paths = [(command, *_flown(vehicle, state, rotors, command, wait)) for command in commands(vehicle)]
    command, path, end = max(paths, key=lambda flown: room(flown[1], vehicle))
    return command, room(path, vehicle), end


def commands(vehicle: Vehicle) -> list[Array]:
    """Return the commands (n,), N, that are tried."""
    low, high = (float(limit) for limit in vehicle.rotor_limits)
    n, centres = len(vehicle.rotor_spins), vehicle.rotors_from_pivot
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    sides = np.sign(np.round(np.column_stack([np.cos(angles), np.sin(angles)]) @ centres[:, :2].T / vehicle.l, 6))
    even = [np.full(n, force) for force in (low, vehicle.weight / n, high)]
    return [*even, *((low + high) / 2 + (high - low) / 2 * sides)]


def _flown(vehicle: Vehicle, state: Array, rotors: Array, command: Array, wait: float) -> tuple[Array, Array]:
    """Return the path under a `command` through the `wait` and `BEYOND`, and where it is after the wait."""
    step, h = stepping(vehicle), wait / STEPS
    path = [np.append(state, rotors)]
    for _ in range(round(STEPS * (1 + BEYOND))):
        path.append(step(path[-1][:SIZE], path[-1][SIZE:], command, h))
    return np.array(path), path[STEPS]
