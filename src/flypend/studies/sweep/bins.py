"""Runs of a store binned into cells, chunk by chunk, so that memory does not grow with the number of runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from flypend.errors import InputError, one_of
from flypend.flight.metrics import wilson_bounds
from flypend.geometry import norm
from flypend.studies.sweep.axes import ANGLES, Axis
from flypend.studies.sweep.chunk import CAUSES
from flypend.studies.sweep.design import design
from flypend.studies.sweep.store import find_store
from flypend.studies.sweep.study import Study
from flypend.studies.sweep.tally import Tally

# Target number of runs per cell, and bounds on the number of cells per side.
PER_CELL, LEAST, MOST = 400, 8, 64
# Radius of the disc of a hemisphere in Lambert's projection.
EDGE = float(np.sqrt(2))


@dataclass(frozen=True, eq=False)
class Cells:
    """Statistics of the runs in each of n cells."""

    runs: Any  # (n,), their number
    successes: Any  # (n,)
    settling: Any  # (n,), mean settling time over the successes, s; NaN if there are none
    excursion: Any  # (n,), mean excursion over all runs, m; NaN if there are none
    causes: Any  # (k, n), number of runs by cause, in the order of `flypend.studies.sweep.chunk.CAUSES`
    repeats: int = 1  # runs from each start that a cell has

    @cached_property
    def rate(self) -> Any:
        """Success rate (n,); NaN without runs."""
        return _over(self.successes, self.runs)

    @cached_property
    def width(self) -> Any:
        """Width (n,) of the 95 % Wilson interval of the success rate, in which every start counts once."""
        low, high = wilson_bounds(self.successes / self.repeats, self.runs / self.repeats)
        return high - low


@dataclass(frozen=True, eq=False)
class Grid:
    """A grid of cells, and the map from the columns of a chunk to cells."""

    shape: tuple[int, ...]
    columns: tuple[str, ...]  # those that `place` needs
    place: Callable[[dict[str, Any]], Any]  # columns → the flat index of each run's cell (n,)
    repeats: int = 1  # times that each start of a cell is flown in it, at other points of the study's grid


class Runs:
    """The runs in the store at `path`, for maps. Raises InputError if there are none."""

    def __init__(self, path: str | Path) -> None:
        self._store = find_store(path)
        self.study: Study = self._store.study
        self._numbers = self._store.numbers()
        self.names = self._store.columns
        if not self._numbers:
            raise InputError(str(path), "a store with runs", "one without")

    @property
    def number(self) -> int:
        """Number of runs flown."""
        return sum(len(self.study.rows(number)) for number in self._numbers)

    def gather(self, grids: Sequence[Grid], tally: Tally | None = None) -> list[Cells]:
        """Return the statistics of the cells of each of `grids`, in one pass over the store; `tally` gets all runs.

        Raises InputError for a chunk that does not match its digest.
        """
        sums = [np.zeros((3 + len(CAUSES), int(np.prod(grid.shape)))) for grid in grids]
        needed = {"settling", "excursion", "cause"}.union(*(grid.columns for grid in grids))
        for number in self._numbers:
            chunk = self._store.read(number, sorted(needed))
            for grid, total in zip(grids, sums, strict=True):
                total += _count(chunk, grid.place(chunk), total.shape[1])
            if tally is not None:
                tally.add(self.study.rows(number), chunk["cause"] == 0)
        return [_cells(total, grid.repeats) for total, grid in zip(sums, grids, strict=True)]


def _count(chunk: dict[str, Any], place: Any, cells: int) -> Any:
    """Sums over the runs of each cell, one per row: count, settling, excursion, and the count of each cause."""
    cause = chunk["cause"]
    rows = [
        np.bincount(place, minlength=cells),
        np.bincount(place, np.where(cause == 0, chunk["settling"], 0.0), cells),
        np.bincount(place, chunk["excursion"], cells),
    ]
    joint = np.bincount(cause.astype(np.int64) * cells + place, minlength=len(CAUSES) * cells)
    return np.concatenate([np.stack(rows), joint.reshape(len(CAUSES), cells)])


def _cells(total: Any, repeats: int) -> Cells:
    runs, causes = total[0], total[3:]
    return Cells(runs, causes[0], _over(total[1], causes[0]), _over(total[2], runs), causes, repeats)


def _over(sums: Any, numbers: Any) -> Any:
    return np.divide(sums, numbers, out=np.full(len(sums), np.nan), where=numbers > 0)


def side(runs: int, panels: int = 1) -> int:
    """Return the number of cells per side such that each cell of `panels` square panels holds enough runs."""
    return int(np.clip(np.sqrt(runs / (PER_CELL * panels)), LEAST, MOST))


# The sphere -----------------------------------------------------------------------------------------------------------


def sphere(study: Study, cells: int) -> Grid:
    """Return the grid of initial rods: equal-area cells on both hemispheres, (2, cells, cells).

    The first axis is upper, lower; rows run upwards.
    """

    def place(chunk: dict[str, Any]) -> Any:
        y = upright(chunk["y"], study)
        upper, flat = lambert(y)
        column, row = (np.clip((flat[:, i] / EDGE + 1) / 2 * cells, 0, cells - 1).astype(np.int64) for i in range(2))
        return (np.where(upper, 0, 1) * cells + row) * cells + column

    return Grid((2, cells, cells), ("y",), place, study.cells)


def lambert(y: Any) -> tuple[Any, Any]:
    """Lambert's equal-area projection of unit vectors (n, 3), e₃ up: whether upper, and the point (n, 2) in the disc.

    Each hemisphere is projected about its own pole: the radius is 2 sin(θ/2) at angle θ from the pole, √2 at the
    horizon.
    """
    flat = y[:, :2] * np.sqrt(2 / (1 + np.abs(y[:, 2])))[:, None]
    return y[:, 2] >= 0, flat


def upright(v: Any, study: Study) -> Any:
    """Convert vectors (n, 3) of a store to the e₃-up frame."""
    return v if study.law.e3 == "up" else v * np.array([1.0, -1.0, -1.0])


# Planes ---------------------------------------------------------------------------------------------------------------

# Quantity: the column it comes from, and its axis label.
QUANTITIES = {
    "tilt": ("y", "tilt of the rod from inverted (°)"),
    "rate": ("y_dot", "rate of the rod (1/s)"),
    "spin": ("omega", "angular velocity of the vehicle (rad/s)"),
    "speed": ("x_dot", "speed of the pivot (m/s)"),
    "body_tilt": ("quat_xyzw", "tilt of the vehicle (°)"),
}


def quantities(study: Study) -> list[str]:
    """Return the names of the quantities that can be an axis of a plane of a `study`."""
    drawn = design(study, 0, 1).columns
    by_vector = [name for name, (column, _) in QUANTITIES.items() if column in drawn and name not in drawn]
    angles = [name for name in ANGLES if name in drawn]
    return by_vector + angles + [quantity(axis) for axis in study.axes if axis.group != "start"]


def quantity(axis: Axis) -> str:
    """Return the name of an axis of a study as that of a quantity."""
    return axis.name if axis.group == "start" else f"{axis.group}.{axis.name}"


def check_plane(study: Study, x: str | None, y: str | None) -> None:
    """Raise InputError unless the axes `x` and `y` of a plane are both left out, or two quantities of the `study`."""
    if (x is None) != (y is None):
        raise InputError("x, y", "both or none", "one")
    for field, name in (("x", x), ("y", y)):
        if name is not None:
            one_of(field, name, quantities(study))
    if x is not None and x == y:
        raise InputError("y", "another quantity than x", repr(y))
    varied = {axis.name for axis in study.axes if axis.group == "start"}
    if x is None and len(quantities(study)) < 2 and ("y" not in varied or {"tilt", "azimuth"} & varied):
        raise InputError("study", "one in which two quantities vary", "fewer")


def label(name: str) -> str:
    """Return the axis label of a quantity."""
    return QUANTITIES[name][1] if name in QUANTITIES else {"azimuth": "azimuth (rad)", "heading": "heading (rad)"}.get(
        name, name.removeprefix("gains.").replace("plant.", "plant: ")
    )  # fmt: skip


def plane(runs: Runs, names: tuple[str, str], cells: int) -> tuple[Grid, tuple[Any, Any]]:
    """Return the grid over two quantities and the edges of its cells; a grid of the study keeps its own points."""
    edges = tuple(_edges(runs.study, name, cells) for name in names)
    shape = (len(edges[1]) - 1, len(edges[0]) - 1)

    def place(chunk: dict[str, Any]) -> Any:
        column, row = (
            np.clip(np.searchsorted(edge, _values(chunk, name, runs.study), side="right") - 1, 0, len(edge) - 2)
            for name, edge in zip(names, edges, strict=True)
        )
        return row * shape[1] + column

    columns = tuple(name if name in runs.names else QUANTITIES[name][0] for name in names)
    points = prod(len(np.unique(axis.values)) for axis in runs.study.grid if quantity(axis) in names)
    return Grid(shape, columns, place, runs.study.cells // points), (edges[0], edges[1])


def _values(chunk: dict[str, Any], name: str, study: Study) -> Any:
    """Values (n,) of a quantity over the runs of a chunk, in the unit of its axis."""
    if name == "tilt":
        return np.degrees(
            chunk["tilt"] if "tilt" in chunk else np.arccos(np.clip(upright(chunk["y"], study)[:, 2], -1, 1))
        )
    if name == "body_tilt":  # z₃ = 1 − 2 (q_x² + q_y²), the same in either frame
        return np.degrees(np.arccos(np.clip(1 - 2 * np.sum(chunk["quat_xyzw"][:, :2] ** 2, axis=1), -1, 1)))
    return chunk[name] if name in chunk else norm(chunk[QUANTITIES[name][0]])


def _edges(study: Study, name: str, cells: int) -> Any:
    """Edges of the cells along the axis of a quantity, in its unit."""
    group, _, key = name.partition(".") if name.startswith(("gains.", "plant.")) else ("start", "", name)
    varied = {axis.name: axis for axis in study.axes if axis.group == group}
    if key == "body_tilt" or (key == "tilt" and key not in varied):
        return np.linspace(0.0, 180.0, cells + 1)
    axis = varied[key] if key in varied else varied[QUANTITIES[key][0]]
    unit = 180 / np.pi if name == "tilt" else 1.0
    if axis.values:
        return _between(np.unique(axis.values) * unit)
    return unit * axis.at(np.linspace(0.0, 1.0, cells + 1))


def _between(values: Any) -> Any:
    """Edges halfway between the points of a grid."""
    if len(values) == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def default_plane(runs: Runs) -> tuple[str, str] | None:
    """Return tilt and rate if both vary, else the first two quantities; None if there are fewer than two."""
    known = quantities(runs.study)
    if {"tilt", "rate"} <= set(known):
        return ("tilt", "rate")
    return (known[0], known[1]) if len(known) > 1 else None
