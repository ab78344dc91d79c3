"""The runs of an ensemble as single trajectories, in one process per core, for flights without a kernel."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.flight.metrics import Metrics, metrics
from flypend.flight.request import Flight
from flypend.flight.sampled import nearest_ticks
from flypend.flight.simulate import fly
from flypend.flight.trajectory import Trajectory
from flypend.laws import AnyLaw
from flypend.plants import Sampled
from flypend.signals import waiting

# Runs per task. A task compiles the law once, at a fraction of the cost of a run.
CHUNK = 8


@dataclass(frozen=True, eq=False)
class Member:
    """One run of an ensemble: its metrics, final state (24,), and samples (k, 24) if any are kept."""

    metrics: Metrics
    final: NDArray[np.float64]
    samples: NDArray[np.float64] | None


def fly_members(flight: Flight, engine: str, workers: int | None, progress: Callable[[int, int], Any]) -> list[Member]:
    """Return the runs of `flight` in the order of its starts; `engine`, `workers` and `progress` as in `fly_many`."""
    members: list[Member] = []
    for part in _chunks(flight, engine, workers or os.cpu_count() or 1):
        members += part
        progress(len(members), flight.runs)
    return members


def _chunks(flight: Flight, engine: str, processes: int) -> Iterator[list[Member]]:
    """Yield chunks of members, in the order of the starts."""

    def chunk(indices: range) -> list[Member]:
        return [_member(flight.member(i), engine) for i in indices]

    chunks = [range(i, min(i + CHUNK, flight.runs)) for i in range(0, flight.runs, CHUNK)]
    if processes == 1 or len(chunks) == 1 or not _can_be_sent(flight.law):
        yield from (chunk(indices) for indices in chunks)
    else:
        with waiting.processes(processes) as submit:
            for call in [submit(chunk, indices) for indices in chunks]:
                yield waiting.result_of(call)


def _member(flight: Flight, engine: str) -> Member:
    """Fly one run, sampled at the criterion's times and at the flight's `times`; the two do not affect each other."""
    if flight.times is None:
        run = fly(flight, engine)
        return Member(metrics(run, flight.criterion), run.packed[-1], None)
    run = fly(flight.replace(times=np.union1d(flight.grid, flight.times)), engine)
    judge, keep = (_rows(flight, run, wanted) for wanted in (flight.grid, flight.times))
    ends = judge[judge >= 0] if run.outcome.status == "completed" else np.append(judge[judge >= 0], len(run.t) - 1)
    samples = np.where(keep[:, None] >= 0, run.packed[keep], np.nan)
    return Member(metrics(_take(run, np.unique(ends)), flight.criterion), run.packed[-1], samples)


def _rows(flight: Flight, run: Trajectory, wanted: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the rows of `run` at the times `wanted`; -1 for times after its end."""
    t = run.t
    if isinstance(flight.plant, Sampled):
        wanted, t = nearest_ticks(wanted, flight.plant, flight.duration), np.rint(t * flight.plant.rate)
    place = np.minimum(np.searchsorted(t, wanted), len(t) - 1)
    return np.where(t[place] == wanted, place, -1)


def _take(run: Trajectory, rows: NDArray[np.int64]) -> Trajectory:
    """Return `run` restricted to some of its rows."""
    names = ("t", "x", "x_dot", "R", "omega", "y", "y_dot", "thrust", "moment", "rotor_forces", "x_ref")
    return replace(run, **{name: getattr(run, name)[rows] for name in names}, signals={})  # metrics need no signals


def _can_be_sent(law: AnyLaw) -> bool:
    """Whether `law` can be pickled; not if it holds a loaded C library or CasADi symbols."""
    import cloudpickle

    try:
        cloudpickle.dumps(law)
    except Exception:  # CasADi raises nothing narrower
        return False
    return True
