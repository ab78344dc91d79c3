"""Closed-loop runs from a batch of starts, on all cores. Each member matches the corresponding single run."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors, plants, signals
from flypend.flight.criterion import Criterion
from flypend.flight.files import ARRAYS
from flypend.flight.kernels import fly_all, has_kernel
from flypend.flight.kernels.results import Progress
from flypend.flight.labels import dataset, describe, state_variables, variable
from flypend.flight.metrics import Count, Metrics, judge, metrics
from flypend.flight.request import SAMPLE_PERIOD, Flight, Tolerances, bound_to, check_batch, some_times
from flypend.flight.sampled import nearest_ticks
from flypend.flight.simulate import ENGINES, fly
from flypend.flight.trajectory import Trajectory
from flypend.laws import AnyLaw, Controller
from flypend.model import State, Vehicle
from flypend.model.state import SIZE, E3Direction
from flypend.plants import AnyPlant, Sampled
from flypend.signals import polling

if TYPE_CHECKING:
    import xarray

# Runs per task. A task compiles the law once, at a fraction of the cost of a run.
CHUNK = 8
Member = tuple[Metrics, NDArray[np.float64], Any]  # of a run: metrics, final state (24,), and its samples, or None


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Ensemble:
    """Results of n runs; the first axis of every array runs over them.

    Parameters
    ----------
    starts : State
        Initial states (n,), in the law's frame.
    final : State
        Final states (n,), in the law's frame.
    success, settling, excursion, effort, peak_force, end, clearance, lowest, box_x, box_y, box_z, cause : (n,)
        The fields of `Metrics`, run by run.
    e3 : "up" or "down"
        Direction of the frame's third axis.
    vehicle : Vehicle
        Vehicle parameters.
    law, gains : str, dict
        Name and gains of the law; a gain that differs between runs is an array (n,).
    t : (k,), optional
        Sample times, s, if any were requested.
    samples : State, optional
        States (n, k) at these times, in the law's frame; NaN after the end of a run.
    wrenches : (n, k, 4), optional
        Thrust (N) and moment (N m) that act at these times, in the ideal plant with lag.
    shares : tuple of int
        Numbers of runs, in order, that flew through each of several plants; empty for one plant.
    """

    starts: State
    final: State
    success: NDArray[np.bool_]
    settling: NDArray[np.float64]
    excursion: NDArray[np.float64]
    effort: NDArray[np.float64]
    peak_force: NDArray[np.float64]
    end: NDArray[np.float64]
    clearance: NDArray[np.float64]
    lowest: NDArray[np.float64]
    box_x: NDArray[np.float64]
    box_y: NDArray[np.float64]
    box_z: NDArray[np.float64]
    cause: NDArray[np.str_]
    e3: E3Direction
    vehicle: Vehicle
    law: str
    gains: Mapping[str, Any] = field(default_factory=dict)
    t: NDArray[np.float64] | None = None
    samples: State | None = None
    wrenches: NDArray[np.float64] | None = None
    shares: tuple[int, ...] = ()

    def __repr__(self) -> str:
        """Return law, vehicle and success rate in one line."""
        low, high = self.interval
        found = f"{int(np.sum(self.success))} of {len(self)} succeed (95 %: {100 * low:.1f} to {100 * high:.1f} %)"
        return f"<Ensemble of {self.law} on {self.vehicle.name}: {found}>"

    def __len__(self) -> int:
        """Number of runs."""
        return len(self.success)

    @property
    def columns(self) -> dict[str, NDArray[Any]]:
        """The fields of `Metrics` as arrays (n,), by name."""
        return {entry.name: getattr(self, entry.name) for entry in fields(Metrics)}

    @property
    def rate(self) -> float:
        """Success rate."""
        return float(np.mean(self.success))

    @property
    def count(self) -> Count:
        """How many runs succeed, of each of the `shares`, too."""
        if not self.shares:
            return Count(int(np.sum(self.success)), len(self))
        parts = np.split(self.success, np.cumsum(self.shares)[:-1])
        return Count.together(Count(int(np.sum(part)), len(part)) for part in parts)

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson interval of the success rate, 95 %, if runs are independent: none flies the start of another.

        With `shares` it is that for plants like these: runs through one plant depend on each other.
        """
        return self.count.interval

    def percentile(self, name: str, q: float) -> float:
        """Return percentile `q` of the field `name` over the runs where it is finite; NaN if there are none."""
        values = getattr(self, name)
        values = values[np.isfinite(values)]
        return float(np.percentile(values, q)) if len(values) else float("nan")

    def to_xarray(self) -> xarray.Dataset:
        """Return an `xarray.Dataset` on the dimension `run`, with units, and vehicle, law and frame as attributes.

        Starts and final states are named start_x, final_x and so on; samples, on `run` and `t`, as in a trajectory.
        """
        runs = ("run",)
        variables = {entry.name: variable(entry.name, runs, getattr(self, entry.name)) for entry in fields(Metrics)}
        variables |= state_variables(self.starts, runs, "start_") | state_variables(self.final, runs, "final_")
        if self.t is not None and self.samples is not None:
            variables |= {"t": variable("t", ("t",), self.t), **state_variables(self.samples, ("run", "t"))}
        differing = {name: value for name, value in self.gains.items() if isinstance(value, np.ndarray)}
        variables |= {f"gains.{name}": variable(name, runs, value) for name, value in differing.items()}
        own = {name: value for name, value in self.gains.items() if name not in differing}
        return dataset(variables, describe(self.vehicle, self.law, own, self.e3))


@errors.named_arguments
@signals.defer()
def simulate_ensemble(
    vehicle: Vehicle,
    law: AnyLaw,
    starts: State,
    duration: float,
    *,
    plant: str | AnyPlant = "rotors",
    rtol: float = 1e-9,
    atol: float | None = None,
    gains: Mapping[str, ArrayLike] | None = None,
    criterion: Criterion | None = None,
    times: ArrayLike | None = None,
    judge_period: float = SAMPLE_PERIOD,
    method: Any = None,
    precision: Any = "double",
    engine: str = "kernel",
    workers: int | None = None,
    progress: Progress = lambda *_: None,
) -> Ensemble:
    """Fly `vehicle` under `law` from each of `starts`.

    Parameters
    ----------
    vehicle, law, duration, plant, rtol, atol
        As in `simulate`. With noise or gusts, run i gets the seed `plant.seed + i`.
    starts : State
        A batch of states with one leading axis, in the law's frame.
    gains : dict, optional
        Gains that differ between runs: name to (n,). Each is checked by itself, not whether it fits the others.
    criterion : Criterion, optional
        Success criterion; default: standing inverted at the reference.
    times : (t,) increasing, optional
        Times, s, at which states are kept; in a sampled flight, the nearest control ticks. They do not affect the
        criterion.
    judge_period : float
        Sampling period of the criterion, s. The default is that of `metrics`; a longer one makes short runs cheaper.
    method : "dop853" or "dp5", optional
        Runge-Kutta method of the ideal plant; default chosen by tolerance.
    precision : "double" or "float"
        Floating-point precision of the ideal plant; "float" suits tolerances of 1e-4 and looser.
    engine : "kernel" or "scipy"
        As in `simulate`.
    workers : int, optional
        Threads, or processes for the engine "scipy"; default one per core. A law that cannot be pickled is flown in
        this process.
    progress : callable
        Called with `(started, total)` as runs start.

    Raises
    ------
    InputError
        If the starts are not a batch, the law lacks a gain, the engine lacks an option, or `simulate` would raise it.
    """
    check_batch(starts)
    exact = Tolerances(rtol=rtol, atol=atol, method=method, precision=precision)
    flight = Flight(
        vehicle=vehicle, law=bound_to(vehicle, law), starts=starts, duration=duration, plant=plants.plant(plant),
        tolerances=exact, criterion=criterion or Criterion(), gains=gains or {}, times=some_times(times),
        judge_period=judge_period,
    )  # fmt: skip
    return fly_many(flight, engine, workers=workers, progress=progress)


def fly_many(
    flight: Flight, engine: str = "kernel", *, workers: int | None = None, progress: Progress = lambda *_: None
) -> Ensemble:
    """Fly every start of `flight`; `engine`, `workers` and `progress` are those of `simulate_ensemble`.

    Raises InputError if the engine lacks what the flight requires.
    """
    errors.one_of("engine", engine, ENGINES)
    if workers is not None:
        errors.integer("workers", workers, 1)
    if engine == "kernel" and has_kernel(flight):
        flown = fly_all(flight, workers=workers, progress=progress)
        columns = judge(
            flown.reductions, flown.status, flown.end, flight.vehicle, flight.criterion, clearance=flown.clearance
        )
        return _gather(flight, columns, flown.final, flown.samples)
    exact = flight.tolerances
    asked = {
        "gains": flight.gains and not isinstance(flight.law, Controller),
        "method": exact.method,
        "precision": exact.precision != "double",
    }
    for name, value in asked.items():
        if value:
            raise errors.InputError(name, "an engine with compiled code, for a symbolic law", "another")
    return _one_by_one(flight, engine, workers, progress)


def _gather(flight: Flight, columns: Mapping[str, Any], final: Any, samples: Any) -> Ensemble:
    """Return the ensemble of runs with these fields of `Metrics`, final states (n, 24) and, if kept, `samples`.

    The samples (n, k, 24 or more) are states, followed by the wrench that acts in the ideal plant with lag.
    """
    law, plant, t = flight.law, flight.plant, flight.times
    if t is not None and isinstance(plant, Sampled):
        t = nearest_ticks(t, plant, flight.duration) / plant.rate
    kept = samples is not None
    return Ensemble(
        starts=flight.starts, final=State.trusted(final), **columns, e3=law.e3, vehicle=flight.vehicle, law=law.name,
        gains={**law.gains, **flight.gains}, t=t, samples=State.trusted(samples[..., :SIZE]) if kept else None,
        wrenches=samples[..., SIZE:] if kept and flight.loop.lag else None,
    )  # fmt: skip


# Flights without a kernel, in one process per core --------------------------------------------------------------------


def _one_by_one(flight: Flight, engine: str, workers: int | None, progress: Progress) -> Ensemble:
    """Like `fly_many`, by single runs."""
    members: list[Member] = []
    for part in _chunks(flight, engine, workers or os.cpu_count() or 1):
        members += part
        progress(len(members), flight.runs)
    judged, final, samples = zip(*members, strict=True)
    columns = {entry.name: np.array([getattr(one, entry.name) for one in judged]) for entry in fields(Metrics)}
    return _gather(flight, columns, np.array(final), None if flight.times is None else np.array(samples))


def _chunks(flight: Flight, engine: str, processes: int) -> Iterator[list[Member]]:
    """Yield chunks of members, in the order of the starts."""

    def chunk(indices: range) -> list[Member]:
        return [_member(flight.member(i), engine) for i in indices]

    chunks = [range(i, min(i + CHUNK, flight.runs)) for i in range(0, flight.runs, CHUNK)]
    if processes == 1 or len(chunks) == 1 or not _can_be_sent(flight.law):
        yield from (chunk(indices) for indices in chunks)
    else:
        with polling.processes(processes) as submit:
            for call in [submit(chunk, indices) for indices in chunks]:
                yield polling.result_of(call)


def _member(flight: Flight, engine: str) -> Member:
    """Fly one run, sampled at the criterion's times and at the flight's `times`; the two do not affect each other."""
    if flight.times is None:
        run = fly(flight, engine)
        return metrics(run, flight.criterion), run.packed[-1], None
    run = fly(flight.replace(times=np.union1d(flight.grid, flight.times)), engine)
    judge, keep = (_rows(flight, run, wanted) for wanted in (flight.grid, flight.times))
    ends = judge[judge >= 0] if run.outcome.status == "completed" else np.append(judge[judge >= 0], len(run.t) - 1)
    columns = np.column_stack([run.packed, run.thrust, run.moment]) if flight.loop.lag else run.packed
    samples = np.where(keep[:, None] >= 0, columns[keep], np.nan)
    rows = {name: getattr(run, name)[np.unique(ends)] for name in ARRAYS}
    judged = replace(run, **rows, signals={})  # metrics need no signals
    return metrics(judged, flight.criterion), run.packed[-1], samples


def _rows(flight: Flight, run: Trajectory, wanted: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the rows of `run` at the times `wanted`; -1 for times after its end."""
    t = run.t
    if isinstance(flight.plant, Sampled):
        wanted, t = nearest_ticks(wanted, flight.plant, flight.duration), np.rint(t * flight.plant.rate)
    place = np.minimum(np.searchsorted(t, wanted), len(t) - 1)
    return np.where(t[place] == wanted, place, -1)


def _can_be_sent(law: AnyLaw) -> bool:
    """Whether `law` can be pickled; not if it holds a loaded C library or CasADi symbols."""
    import cloudpickle

    try:
        cloudpickle.dumps(law)
    except Exception:  # CasADi raises nothing narrower
        return False
    return True
