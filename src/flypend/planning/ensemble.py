"""Plans from many starts at once, one problem a lane, on all cores."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors, signals
from flypend.compile.llvm.stagewise import WIDTH
from flypend.errors import InputError
from flypend.flight.metrics import wilson
from flypend.flight.request import check_batch
from flypend.model import State, Vehicle
from flypend.planning.constraints import Constraints, Keywords, gathered
from flypend.planning.planner import horizons_of
from flypend.planning.request import Request, end_of, request
from flypend.planning.result import Plan
from flypend.planning.search import Job, one_by_one, prepared
from flypend.planning.telling import told
from flypend.signals.waiting import result_of, threads

# Styles of guesses in the order in which they are tried: the one that fails least, then those that find what it does
# not.
ORDER = (1, 3, 4, 5, 0, 7, 2, 6)
MORE = 2  # so many more are tried where none can be flown, before the horizon grows
CHUNK = 8 * WIDTH  # most starts that a thread takes at a time
Progress = Callable[[int, int], Any]


@errors.named_arguments
@dataclass(frozen=True, eq=False)
class PlanEnsemble:
    """Plans of one vehicle from n starts.

    Parameters
    ----------
    plans : tuple of Plan
        A plan for each start, in order.
    """

    plans: tuple[Plan, ...]

    def __len__(self) -> int:
        """Number of plans."""
        return len(self.plans)

    def __iter__(self) -> Iterator[Plan]:
        """Iterate over the plans."""
        return iter(self.plans)

    def __getitem__(self, i: int) -> Plan:
        """Return the plan from start i."""
        return self.plans[i]

    def __repr__(self) -> str:
        """Return vehicle, share of plans that can be flown, and excursion in one line."""
        low, high = self.interval
        found = f"{int(np.sum(self.success))} of {len(self)} planned (95 %: {100 * low:.1f} to {100 * high:.1f} %)"
        middle, most = (self.percentile("excursion", q) for q in (50, 95))
        return f"<Plans for {self.plans[0].vehicle.name}: {found}, excursion {middle:.3f} / {most:.3f} m>"

    @property
    def success(self) -> NDArray[np.bool_]:
        """Which plans can be flown, (n,)."""
        return np.array([bool(plan) for plan in self.plans])

    @property
    def excursion(self) -> NDArray[np.float64]:
        """Excursions (n,), m; NaN where there is no plan."""
        return np.array([plan.excursion if plan else np.nan for plan in self.plans])

    @property
    def duration(self) -> NDArray[np.float64]:
        """Durations (n,), s; NaN where there is no plan."""
        return np.array([plan.duration if plan else np.nan for plan in self.plans])

    @property
    def solve_time(self) -> NDArray[np.float64]:
        """Processor time of each plan (n,), s, all its guesses included."""
        return np.array([plan.solve_time for plan in self.plans])

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson interval of the share of plans that can be flown, 95 %."""
        return wilson(int(np.sum(self.success)), len(self))

    def percentile(self, name: str, q: float) -> float:
        """Return percentile `q` of the property `name` where it is finite; NaN if there are none.

        It is "excursion", "duration" or "solve_time".
        """
        values = getattr(self, errors.one_of("name", name, ("excursion", "duration", "solve_time")))
        values = values[np.isfinite(values)]
        return float(np.percentile(values, q)) if len(values) else float("nan")


@errors.named_arguments
@signals.deferred()
def plan_ensemble(
    vehicle: Vehicle,
    starts: State,
    objective: str | Mapping[str, float] = "excursion",
    *,
    duration: float | None = None,
    target: ArrayLike | None = None,
    rotors: ArrayLike | None = None,
    constraints: Constraints | None = None,
    guesses: int = 2,
    workers: int | None = None,
    progress: Progress = lambda *_: None,
    **keywords: Unpack[Keywords],
) -> PlanEnsemble:
    """Plan flights of `vehicle` from each of `starts`, each guess on a lane of its own.

    Plan i depends on start i alone, whatever else is in the batch and on however many cores.

    Parameters
    ----------
    vehicle, duration, target, rotors, constraints, **keywords
        As in `plan`.
    starts : State
        A batch of states with one leading axis, e₃ up.
    objective : "excursion", "effort" or dict
        As in `plan`, except "time".
    guesses : int
        From how many guesses, up to 8, the best plan is taken. `plan` takes 8. Two more are tried where none is found,
        before the duration grows.
    workers : int, optional
        Number of threads; default one per core.
    progress : callable
        Called with `(done, total)`.

    Raises
    ------
    InputError
        If an argument is out of range, or a start breaks a constraint.
    """
    check_batch(starts)
    if objective == "time":
        raise InputError("objective", "one that a single solve finds: excursion, effort or weights", "'time'")
    first = errors.integer("guesses", guesses, 1, WIDTH)
    cores = errors.integer("workers", os.cpu_count() or 1 if workers is None else workers, 1)
    kept = gathered("plan_ensemble", constraints, keywords)
    goal = end_of(kept.path, duration, target)
    asked = [request(vehicle, starts[i], objective, goal, rotors, kept) for i in range(len(starts))]
    horizons = horizons_of(asked[0], duration)
    prepared(asked[0])  # compiling takes seconds, once
    share = min(CHUNK, WIDTH * -(-len(asked) // (WIDTH * cores)))
    parts = [asked[i : i + share] for i in range(0, len(asked), share)]
    plans: list[Plan] = []
    with threads(cores) as pool:
        for call in [pool.submit(_planned, part, horizons, first) for part in parts]:
            some = result_of(call)
            plans += some
            progress(len(plans), len(asked))
    return PlanEnsemble(tuple(plans))


def _planned(asked: Sequence[Request], horizons: Sequence[float], guesses: int) -> list[Plan]:
    """Return a plan for each request: with the first of `horizons` and the first styles that find one."""
    best: list[tuple[bool, float, Plan] | None] = [None] * len(asked)  # whether it failed, its cost, and the plan
    spent = np.zeros(len(asked))
    for horizon in horizons:
        left = [i for i, each in enumerate(best) if _failed(each)]
        for tried, style in enumerate(ORDER[: guesses + MORE]):
            open_ = [i for i in left if tried < guesses or _failed(best[i])]
            if not open_:
                break
            found = one_by_one([Job(asked[i], style) for i in open_], horizon)
            plans = told([asked[i] for i in open_], found, horizon)
            for i, each, plan in zip(open_, found, plans, strict=True):
                spent[i] += each.spent
                kept = best[i]
                if kept is None or (not plan, each.cost) < kept[:2]:
                    best[i] = not plan, each.cost, plan
    return [
        replace(each[2], solve_time=float(used)) for each, used in zip(best, spent, strict=True) if each is not None
    ]


def _failed(kept: tuple[bool, float, Plan] | None) -> bool:
    """Whether there is no plan yet that can be flown."""
    return kept is None or kept[0]
