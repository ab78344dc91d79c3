"""Many closed-loop runs over a batch of starts, on all cores, member by member the same as single runs."""

from __future__ import annotations

import copyreg
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from functools import partial
from typing import Any

import numpy as np

from flypend import errors
from flypend.flight.criterion import Criterion
from flypend.flight.kernels import Flown, ideal_kernel, method_for, sampled_kernel
from flypend.flight.metrics import Metrics, judged, metrics, wilson
from flypend.flight.sampled import nearest_ticks
from flypend.flight.simulate import LEAST_RTOL, SAMPLE_PERIOD, simulate
from flypend.laws import AnyLaw, BoundLaw, Controller
from flypend.model import State, Vehicle
from flypend.plants import Plant
from flypend.plants import plant as plant_named
from flypend.plants.loop import Loop

# Runs per task of the engine "scipy": a task compiles the law once, which costs a fraction of one run.
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
    times : (t,), optional
        Sample times, s, if any were asked for.
    samples : (n, t, 24), optional
        Packed states at these times, in the frame of the law; NaN after the end of a run.
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
    times: Any = None
    samples: Any = None

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
    law: AnyLaw,
    starts: State,
    duration: float,
    *,
    plant: str | Plant = "ideal",
    rtol: float = 1e-9,
    gains: Mapping[str, Any] | None = None,
    criterion: Criterion | None = None,
    times: Any = None,
    judge_period: float = SAMPLE_PERIOD,
    method: str | None = None,
    precision: str = "double",
    engine: str = "kernel",
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
    gains : dict, optional
        Gains of the law that differ from run to run: name to (n,).
    criterion : Criterion, optional
        What counts as a success; default to stand inverted at the reference.
    times : (t,) increasing, optional
        Times, s, at which states are kept, in the ideal plant under a Law.
    judge_period : float
        Every so often a run is judged, s. The default is that of `metrics`; a longer one makes short runs cheaper.
    method : "dop853" or "dp5", optional
        Runge-Kutta method of the ideal plant; default by the tolerance.
    precision : "double" or "float"
        Of the ideal plant; "float" is for tolerances of 1e-4 and looser.
    engine : "kernel" or "scipy"
        As in `simulate`.
    workers : int, optional
        Threads, or processes for the engine "scipy"; default one per core. A law that cannot be sent to another process
        is flown in this one.
    progress : callable
        Told `(taken, total)` as runs are taken up.

    Raises
    ------
    InputError
        For starts that are not a batch, gains that the law lacks, options that the engine lacks, and whatever
        `simulate` refuses.
    """
    if not isinstance(starts, State) or len(starts.batch_shape) != 1:
        raise errors.InputError("starts", "a State with one leading batch axis", repr(starts)[:80])
    criterion = criterion or Criterion()
    errors.one_of("engine", engine, ("kernel", "scipy"))
    if plant != "ideal":
        plant = plant_named(plant)
    if engine == "scipy" or isinstance(law, Controller) or (isinstance(plant, Plant) and plant.engine == "mujoco"):
        for name, value in (("gains", gains), ("times", times), ("method", method)):
            if value is not None:
                raise errors.InputError(name, "an engine that is compiled, for a law in symbols", "another")
        return _one_by_one(vehicle, law, starts, duration, plant, rtol, criterion, engine, workers, progress)

    bound = law.bind(vehicle)
    assert isinstance(bound, BoundLaw)
    kept = None if times is None else errors.array("times", times, (None,))
    if kept is not None and not (len(kept) and kept[0] >= 0 and kept[-1] <= duration and np.all(np.diff(kept) > 0)):
        raise errors.InputError("times", "increasing times from 0 to the duration", "others")
    flown = fly_packed(
        vehicle, bound, starts.packed(), duration, plant=plant, rtol=rtol, gains=gains, criterion=criterion,
        times=kept, judge_period=judge_period, method=method, precision=precision, workers=workers, progress=progress,
    )  # fmt: skip
    columns = judged(flown.reductions, flown.status, flown.end, vehicle, criterion)
    return Ensemble(
        starts=starts, final=flown.final, law=bound.name, vehicle=vehicle.name, times=kept, samples=flown.samples,
        **columns,
    )  # fmt: skip


def fly_packed(
    vehicle: Vehicle,
    law: BoundLaw,
    packed: Any,
    duration: float,
    *,
    plant: str | Plant,
    rtol: float,
    criterion: Criterion,
    gains: Mapping[str, Any] | None = None,
    times: Any = None,
    judge_period: float = SAMPLE_PERIOD,
    method: str | None = None,
    precision: str = "double",
    max_steps: int | None = None,
    workers: int | None = None,
    progress: Callable[[int, int], Any] = lambda *_: None,
) -> Flown:
    """What `simulate_ensemble` flies with a kernel, from `packed` states (n, 24) that are trusted, a `law` being bound.

    A run that needs more than `max_steps` steps is given up as diverged. The others of
    duration, plant, rtol, criterion, gains, times, judge_period, method, precision, workers, progress are those of
    `simulate_ensemble`, and so is what raises InputError.
    """
    names = tuple(gains or ())
    columns = [_column(law, name, value, len(packed)) for name, value in (gains or {}).items()]
    values = np.stack(columns, axis=1) if columns else None
    duration = errors.number("duration", duration, above=0, unit="s")
    period = errors.number("judge_period", judge_period, above=0, unit="s")
    grid = np.linspace(0.0, duration, max(2, round(duration / period) + 1))
    if isinstance(plant, Plant):
        if times is not None or method is not None or precision != "double":
            raise errors.InputError("times, method, precision", "nothing, in a sampled flight", "a value")
        return sampled_kernel(Loop(vehicle, law, plant.replace(seed=0), names), criterion).fly(
            packed, duration, ticks=nearest_ticks(grid, plant, duration), first_seed=plant.seed, parameters=values,
            workers=workers, progress=progress,
        )  # fmt: skip
    rtol = errors.number("rtol", rtol, at_least=LEAST_RTOL)
    chosen = method or method_for(rtol, law)
    kernel = ideal_kernel(vehicle, law, criterion, names, method=chosen, precision=precision)
    fly = partial(kernel.fly, packed, duration, rtol=rtol, parameters=values, max_steps=max_steps, workers=workers)
    flown = fly(times=grid, progress=progress)
    # Flown again for the states that are kept: a run is judged in the same way whether or not any are.
    return flown if times is None else replace(flown, samples=fly(times=times, keep=True, judge=False).samples)


def _column(law: BoundLaw, name: str, value: Any, runs: int) -> Any:
    """The values (n,) of one gain, from (n,) or one number for all."""
    given = law.check_gain(name, value)
    if given.shape not in ((), (runs,)):
        raise errors.InputError(f"gains.{name}", f"a number, or {runs} of them", f"shape {given.shape}")
    return np.broadcast_to(given, (runs,))


def _can_be_sent(law: AnyLaw) -> bool:
    """Whether another process can be given `law`; one with a loaded C library or symbols of CasADi cannot."""
    import cloudpickle

    try:
        cloudpickle.dumps(law)
    except Exception:  # CasADi raises no narrower one
        return False
    return True


def _one_by_one(
    vehicle: Vehicle,
    law: AnyLaw,
    starts: State,
    duration: float,
    plant: str | Plant,
    rtol: float,
    criterion: Criterion,
    engine: str,
    workers: int | None,
    progress: Callable[[int, int], Any],
) -> Ensemble:
    """As `simulate_ensemble`, by single runs in one process per core."""
    from joblib import Parallel, delayed  # processes, which a kernel does not wait for

    count = workers or os.cpu_count() or 1
    bound = law.bind(vehicle)

    def chunk(indices: range) -> list[tuple[Metrics, Any]]:
        return [one(index) for index in indices]

    def one(index: int) -> tuple[Metrics, Any]:
        seeded = plant.replace(seed=plant.seed + index) if isinstance(plant, Plant) else plant
        run = simulate(vehicle, bound, starts[index], duration, plant=seeded, rtol=rtol, engine=engine)
        return metrics(run, criterion), run.packed[-1]

    chunks = [range(i, min(i + CHUNK, len(starts))) for i in range(0, len(starts), CHUNK)]
    if count == 1 or len(chunks) == 1 or not _can_be_sent(bound):
        parts: Any = (chunk(indices) for indices in chunks)
    else:
        parts = Parallel(n_jobs=count, return_as="generator")(delayed(chunk)(indices) for indices in chunks)
    results: list[tuple[Metrics, Any]] = []
    for part in parts:
        results += part
        progress(len(results), len(starts))
    columns = {
        entry.name: np.array([getattr(result[0], entry.name) for result in results]) for entry in fields(Metrics)
    }
    final = np.array([result[1] for result in results])
    return Ensemble(starts=starts, final=final, law=law.name, vehicle=vehicle.name, **columns)
