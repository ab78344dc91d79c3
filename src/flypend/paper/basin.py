"""The basin of a theorem on a plane of starts: rod and thrust axis at rest, turned in one vertical plane."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend.flight.criterion import Criterion
from flypend.flight.ensemble import simulate_ensemble
from flypend.laws import Law
from flypend.laws.closed_loop import symbolic_loop
from flypend.model import State, Vehicle

SETTLE = 30.0  # s


@dataclass(frozen=True, eq=False)
class Basin:
    """Settling times on a grid of planar starts at rest.

    Parameters
    ----------
    law : str
        The law.
    angles : (n,)
        Angles of the grid, rad: of the rod from its goal along the columns, of the thrust axis along the rows.
    settling : (n, n)
        Settling time, s; NaN where the flight does not settle, or the law is not defined.
    domain : (n, n)
        The law's distance from its exceptional set: the least 1 + cosine of the angles to the targets.
    unresolved : (n, n) bool
        Which flights began in the domain and ended as singular: they came closer to the exceptional set than double
        precision resolves.
    """

    law: str
    angles: NDArray[np.float64]
    settling: NDArray[np.float64]
    domain: NDArray[np.float64]
    unresolved: NDArray[np.bool_]

    @property
    def edge(self) -> float:
        """1 + cosine one step of the grid away from an exceptional set."""
        return float(1 - np.cos(self.angles[1] - self.angles[0]))


def basin(law: Law, vehicle: Vehicle, points: int) -> Basin:
    """Fly `vehicle` under `law` from `points`² planar starts in the ideal plant, for `SETTLE` seconds each."""
    angles = np.linspace(-np.pi, np.pi, points)
    rod, axis = (grid.ravel() for grid in np.meshgrid(angles, angles))
    starts = planar(rod, axis)
    target = Criterion(target="e3", position=np.inf) if law.reference is None else Criterion()
    flown = simulate_ensemble(vehicle, law, starts, SETTLE, plant="ideal", rtol=1e-8, criterion=target)
    loop = symbolic_loop(vehicle, law)
    distance = ca.Function("domain", [loop.t, loop.s], [loop.signals["domain"]])(0.0, starts.packed().T)
    square = (points, points)
    return Basin(
        law.name,
        angles,
        np.where(flown.success, flown.settling, np.nan).reshape(square),
        np.array(distance).reshape(square),
        ((flown.cause == "singular") & (flown.end > 0)).reshape(square),
    )


def planar(rod: NDArray[np.float64], axis: NDArray[np.float64]) -> State:
    """Return states at rest (n,) with y and z turned by the angles `rod` and `axis` (n,), rad, from e₃ towards e₁."""
    zero, one = np.zeros_like(rod), np.ones_like(rod)
    s, c = np.sin(axis), np.cos(axis)
    R = np.stack([np.stack(row, -1) for row in ((c, zero, s), (zero, one, zero), (-s, zero, c))], -2)
    return State(y=np.stack([np.sin(rod), zero, np.cos(rod)], -1), R=R)
