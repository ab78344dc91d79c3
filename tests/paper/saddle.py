"""The stable manifold W of Theorem A's saddle y = −e₃: points on it, and its codimension by a winding number.

A start beside W passes the saddle and leaves it along its unstable directions, two of them, in a direction that depends
on which side of W it began. If W has codimension 2, a small loop of starts around it leaves in directions that turn
once; a loop that does not enclose W leaves in directions that turn not at all. The frame is the paper's.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.flight.ensemble import simulate_ensemble
from flypend.laws import Law
from flypend.model import State, Vehicle
from flypend.paper.descent import planar

DURATION, PERIOD = 20.0, 0.02
TOP = -0.5  # y₃ below it: the rod is near the saddle
GRID, ROUNDS = 33, 7  # each round of the search narrows the interval 32 times


def ways_down(law: Law, vehicle: Vehicle, starts: State) -> NDArray[np.float64]:
    """Return the horizontal direction (n, 2) in which the rod leaves the top for good, from each of `starts` (n,).

    Raises ValueError if a flight does not leave it within `DURATION`.
    """
    times = np.arange(0.0, DURATION, PERIOD)
    flown = simulate_ensemble(vehicle, law, starts, DURATION, plant="ideal", rtol=1e-11, times=times)
    assert flown.samples is not None
    y = flown.samples.y
    below = y[..., 2] >= TOP
    leaving = below.shape[1] - np.argmin(below[:, ::-1], axis=1)  # the sample after the last one near the top
    if not np.all(below[:, -1] & ~np.all(below, axis=1)):
        raise ValueError("a flight that does not pass near the saddle and leave it")
    out = y[np.arange(len(y)), leaving, :2]
    return np.asarray(out / np.linalg.norm(out, axis=1, keepdims=True))


def crossing(law: Law, vehicle: Vehicle, axis: float, low: float, high: float) -> float:
    """Return the rod's angle, rad, between `low` and `high` at which the planar start at rest lies on W.

    `axis` is the angle of the thrust axis, rad; see `basin.planar`. In the plane, W separates the starts that leave to
    either side. Raises ValueError if both ends leave to the same side.
    """
    for _ in range(ROUNDS):
        angles = np.linspace(low, high, GRID)
        side = np.sign(ways_down(law, vehicle, planar(angles, np.full(GRID, axis)))[:, 0])
        change = np.flatnonzero(side[:-1] != side[1:])
        if len(change) != 1:
            raise ValueError(f"one change of side between {low:g} and {high:g} rad, not {len(change)}")
        low, high = angles[change[0]], angles[change[0] + 1]
    return float((low + high) / 2)


def loop_around(rod: float, axis: float, radius: float, count: int, offset: float = 0.0) -> State:
    """Return `count` starts on a loop about the planar start (`rod`, `axis`): the rod is turned by `radius`, rad.

    `offset` moves the centre of the loop, rad.
    """
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    centre = planar(np.array([rod + offset]), np.array([axis]))
    in_plane = np.array([np.cos(rod + offset), 0.0, -np.sin(rod + offset)])
    y = centre.y + radius * (np.cos(turn)[:, None] * in_plane + np.sin(turn)[:, None] * np.array([0.0, 1.0, 0.0]))
    return State(y=y / np.linalg.norm(y, axis=1, keepdims=True), R=np.broadcast_to(centre.R, (count, 3, 3)))


def winding(directions: Any) -> int:
    """Return how many times the planar unit vectors `directions` (n, 2) turn around along the closed loop."""
    angles = np.arctan2(directions[:, 1], directions[:, 0])
    steps = np.diff(np.append(angles, angles[0]))
    return round(float(np.sum((steps + np.pi) % (2 * np.pi) - np.pi)) / (2 * np.pi))
