"""Whether a plan keeps what was wished, at all its samples: the last word before it may be flown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend.flight.touch import touched
from flypend.geometry import norm
from flypend.model import State, Vehicle, Wrench
from flypend.model.mount import margins
from flypend.planning.window import Window


@dataclass(frozen=True)
class Limits:
    """What a plan must keep, SI units.

    Parameters
    ----------
    walls : (2, 3), optional
        Lowest and highest corner of the box that pivot and rod stay in, m.
    speed : float, optional
        Largest speed of the pivot, m/s.
    lean : float, optional
        Largest angle between the rod and the vertical, rad.
    tolerance : float
        By how much a length or, in m/s, a speed or, in rad, an angle may be exceeded.
    windows : tuple of Window
        Walls that the machine does not touch, with their openings.
    points : (k, 3)
        Points that the pivot passes within a distance `near`, m.
    near : float
        See `points`.
    """

    walls: Any
    speed: float | None
    lean: float | None
    tolerance: float
    windows: tuple[Window, ...] = ()
    points: Any = ()
    near: float = 0.0


def broken(packed: Any, rotor_forces: Any, vehicle: Vehicle, limits: Limits) -> str:
    """Return what the states `packed` (n, 24) with `rotor_forces` (n, k) of `vehicle` break most of `limits`; or "".

    The mount's limits count too: what the rod touches ends a flight.
    """
    state = State.trusted(packed)
    if limits.walls is not None:
        points = np.stack([state.x, state.x + vehicle.reach * state.y])
        out = float(np.max(np.maximum(limits.walls[0] - points, points - limits.walls[1])))
        if out > limits.tolerance:
            return f"the box is left by {out:.3g} m"
    if limits.speed is not None and (over := float(np.max(norm(state.x_dot))) - limits.speed) > limits.tolerance:
        return f"the speed is exceeded by {over:.3g} m/s"
    if limits.lean is not None and (over := float(np.max(np.arccos(state.y[:, 2]))) - limits.lean) > limits.tolerance:
        return f"the rod leans {over:.3g} rad too far"
    if missed := _missed(state, vehicle, limits):
        return missed
    return _touched(state, rotor_forces, vehicle)


def begins_touching(packed: Any, rotor_forces: Any, vehicle: Vehicle) -> str:
    """Return what the rod touches at the first of the states `packed` (n, 24), from where no plan leads; or ""."""
    found = _touched(State.trusted(packed[:1]), rotor_forces[:1], vehicle)
    return found and f"{found} at the start"


def _touched(state: State, rotor_forces: Any, vehicle: Vehicle) -> str:
    """Return what the rod of `vehicle` touches most in a batch of states with `rotor_forces` (n, k); or ""."""
    if vehicle.mount == "gimbal":
        return ""
    wrench = rotor_forces @ vehicle.mixing().T
    found = margins(state, Wrench(wrench[:, 0], wrench[:, 1:]), vehicle, "up")
    least = np.min(found, axis=0)
    return touched(vehicle, int(np.argmin(least))) if np.min(least) < 0 else ""


def _missed(state: State, vehicle: Vehicle, limits: Limits) -> str:
    """Return which window or waypoint of `limits` the states miss; or ""."""
    for window in limits.windows:
        if (room := float(np.min(window.room(state, vehicle)))) < 0:
            return f"the frame of a window is {-room:.3g} m too near"
    for point in limits.points:
        if (off := float(np.min(norm(state.x - point)))) > limits.near:
            return f"a waypoint is missed by {off:.3g} m"
    return ""
