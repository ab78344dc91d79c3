"""How far plans and a law stray: against the time that is allowed, and over all directions of the rod."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.flight.ensemble import simulate_ensemble
from flypend.laws import Controller, Law
from flypend.model import State, Vehicle
from flypend.planning.durations import HORIZONS
from flypend.planning.dynamics import Units
from flypend.planning.planner import plan, plan_ensemble
from flypend.planning.result import Plan, PlanEnsemble
from flypend.studies.sweep.bins import EDGE

DURATION = 10.0  # s, of the flights of a law
Array = NDArray[np.float64]
Progress = Callable[[int, int], Any]


@dataclass(frozen=True, eq=False)
class Front:
    """The least excursion of plans from one start against the time that they may take."""

    durations: Array  # (n,), allowed times, s, from the shortest in which a plan was found
    plans: tuple[Plan, ...]  # one for each; it may have failed

    @property
    def excursion(self) -> Array:
        """Excursions (n,), m; NaN where there is no plan."""
        return np.array([plan.excursion if plan else np.nan for plan in self.plans])


def front(
    vehicle: Vehicle, start: State, count: int = 9, *, time_limit: float = 20.0, progress: Progress = lambda *_: None,
    **asked: Any,
) -> Front:  # fmt: skip
    """Return the front of `vehicle` from `start`: `count` allowed times from the shortest to the planner's own.

    Each plan takes `asked`, further arguments of `plan`, within a `time_limit` (s). If even the shortest plan fails,
    it stands alone. Raises InputError as `plan` does.
    """
    errors.integer("count", count, 2)
    shortest = plan(vehicle, start, "time", time_limit=time_limit, **asked)
    progress(1, count + 1)
    if not shortest:
        return Front(np.array([shortest.duration]), (shortest,))
    longest = max(HORIZONS[0] * Units.of(vehicle).time, 2 * shortest.duration)
    durations = np.geomspace(shortest.duration, longest, count)
    plans: list[Plan] = []
    for duration in durations:
        found = plan(vehicle, start, duration=duration, time_limit=time_limit, **asked)
        plans.append(found or (found if plans else shortest))  # there are few ways in the least time
        progress(1 + len(plans), count + 1)
    return Front(durations, tuple(plans))


@dataclass(frozen=True, eq=False)
class Strays:
    """How far laws and plans stray from rest, the vehicle level, with the rod in directions all over the sphere."""

    cells: int  # rows and columns of each hemisphere's disc in Lambert's equal-area projection
    place: NDArray[np.int64]  # (n, 3), hemisphere (0 is the upper), row and column of each start
    starts: State  # (n,)
    by_law: Mapping[str, Array]  # excursions (n,), m, by the name of the law; NaN where it fails
    plans: PlanEnsemble

    def disc(self, values: Array, part: int) -> Array:
        """Return `values` (n,) of a hemisphere as rows and columns (cells, cells); NaN outside of its disc."""
        found = np.full((self.cells, self.cells), np.nan)
        here = self.place[:, 0] == part
        found[self.place[here, 1], self.place[here, 2]] = values[here]
        return found


def strays(
    vehicle: Vehicle,
    laws: Sequence[Law | Controller],
    cells: int = 12,
    *,
    guesses: int = 4,
    workers: int | None = None,
    tell: Callable[[str, int, int], Any] = lambda *_: None,
) -> Strays:
    """Fly `laws` in the rotors plant, and plan with so many `guesses`, from rest with the rod all over the sphere.

    The directions are the centres of the `cells` × `cells` squares of each hemisphere's disc that lie in it. `tell` is
    called with what is under way, and how much of it is done. Raises InputError if an argument is out of range.
    """
    count = errors.integer("cells", cells, 2)
    place, y = _directions(count)
    starts = State(y=y)
    plans = plan_ensemble(vehicle, starts, guesses=guesses, workers=workers, progress=partial(tell, "planning"))
    by_law = {}
    for law in laws:
        own, report = starts.in_frame(law.e3), partial(tell, f"flights of {law.name}")
        flown = simulate_ensemble(vehicle, law, own, DURATION, plant="rotors", workers=workers, progress=report)
        by_law[flown.law] = np.where(flown.success, flown.excursion, np.nan)
    return Strays(count, place, starts, by_law, plans)


def _directions(cells: int) -> tuple[NDArray[np.int64], Array]:
    """Return hemisphere, row and column (n, 3), and the directions (n, 3), of the squares whose centres lie in a disc.

    Lambert's projection takes y to the point at a distance √(2 (1 − |y₃|)) from the middle.
    """
    middles = ((np.arange(cells) + 0.5) / cells * 2 - 1) * EDGE
    part, row, column = (index.ravel() for index in np.indices((2, cells, cells)))
    a, b = middles[column], middles[row]
    square = a**2 + b**2
    inside = square < EDGE**2
    up = (1 - square / 2) * np.where(part == 0, 1, -1)
    across = np.sqrt(np.maximum(1 - square / 4, 0))
    y = np.stack([a * across, b * across, up], axis=-1)
    return np.stack([part, row, column], axis=-1)[inside], y[inside]
