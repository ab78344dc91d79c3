"""Many closed-loop runs over a batch of starts, on all cores, member by member the same as single runs."""

from __future__ import annotations

import copyreg
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from flypend import errors
from flypend.laws import Controller, Law
from flypend.metrics import Metrics, metrics, wilson
from flypend.model import State, Vehicle
from flypend.plants import Plant
from flypend.simulate import simulate

# Runs per task: a task compiles the law once, which costs a fraction of one run.
CHUNK = 8

# What another process refuses comes back as the three fields of an InputError; by itself it is pickled by its message.
copyreg.pickle(errors.InputError, lambda error: (errors.InputError, (error.field, error.expected, str(error.got))))


@dataclass(frozen=True, kw_only=True, eq=False)
class Ensemble:
    """Results of n runs, each array with the runs along its first axis.

    Parameters
    ----------
    starts : State
        Initial states, in the frame of the law.
    final : (n, 24)
        Packed final states, in the frame of the law.
    success, settling, excursion, effort, peak_force, end, cause : (n,)
        The fields of `Metrics`, run by run.
    law, vehicle : str
        Names of what flew.
    """

    starts: State
    final: Any
    success: Any
    settling: Any
    excursion: Any
    effort: Any
    peak_force: Any
    end: Any
    cause: Any
    law: str
    vehicle: str

    def __len__(self) -> int:
        """Number of runs."""
        return len(self.success)

    @property
    def rate(self) -> float:
        """Success rate."""
        return float(np.mean(self.success))

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson interval of the success rate, 95 %."""
        return wilson(int(np.sum(self.success)), len(self))

    def percentile(self, name: str, q: float) -> float:
        """Percentile `q` of the field called `name`, over the runs where it is a number; NaN if there is none."""
        values = getattr(self, name)
        values = values[np.isfinite(values)]
        return float(np.percentile(values, q)) if len(values) else float("nan")


def simulate_ensemble(
    vehicle: Vehicle,
    law: Law | Controller,
    starts: State,
    duration: float,
    *,
    plant: str | Plant = "ideal",
    rtol: float = 1e-9,
    workers: int | None = None,
    progress: Callable[[int, int], Any] = lambda *_: None,
) -> Ensemble:
    """Fly `vehicle` under `law` from every one of `starts`.

    Parameters
    ----------
    vehicle, law, duration, plant, rtol
        As in `simulate`. A plant with noise or gusts gives run i the seed `plant.seed + i`.
    starts : State
        A batch of states with one leading axis, in the frame of the law.
    workers : int, optional
        Processes; default one per core.
    progress : callable
        Told `(done, total)` as runs come in.

    Raises
    ------
    InputError
        For starts that are not a batch, and whatever `simulate` refuses.
    """
    if not isinstance(starts, State) or len(starts.batch_shape) != 1:
        raise errors.InputError("starts", "a State with one leading batch axis", repr(starts)[:80])
    results = list(_run_all(vehicle, law, starts, duration, plant, rtol, workers, progress))
    columns = {
        entry.name: np.array([getattr(result[0], entry.name) for result in results]) for entry in fields(Metrics)
    }
    final = np.array([result[1] for result in results])
    return Ensemble(starts=starts, final=final, law=law.name, vehicle=vehicle.name, **columns)


def _run_all(
    vehicle: Vehicle,
    law: Law | Controller,
    starts: State,
    duration: float,
    plant: str | Plant,
    rtol: float,
    workers: int | None,
    progress: Callable[[int, int], Any],
) -> Iterator[tuple[Metrics, Any]]:
    """Results in the order of the starts, from one process per core."""
    count = workers or os.cpu_count() or 1
    bound = law.bound(vehicle)

    def chunk(indices: range) -> list[tuple[Metrics, Any]]:
        return [one(index) for index in indices]

    def one(index: int) -> tuple[Metrics, Any]:
        seeded = plant.replace(seed=plant.seed + index) if isinstance(plant, Plant) else plant
        run = simulate(vehicle, bound, starts[index], duration, plant=seeded, rtol=rtol)
        return metrics(run), run.states[-1].packed()

    chunks = [range(i, min(i + CHUNK, len(starts))) for i in range(0, len(starts), CHUNK)]
    if count == 1 or len(chunks) == 1:
        results: Any = (chunk(indices) for indices in chunks)
    else:
        results = Parallel(n_jobs=count, return_as="generator")(delayed(chunk)(indices) for indices in chunks)
    done = 0
    for part in results:
        done += len(part)
        progress(done, len(starts))
        yield from part
