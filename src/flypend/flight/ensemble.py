"""Closed-loop runs from a batch of starts, on all cores. Each member matches the corresponding single run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors, plants, signals
from flypend.flight.criterion import Criterion
from flypend.flight.kernels import Flown, fly_all, has_kernel
from flypend.flight.labelled import dataset, describe, state_variables, variable
from flypend.flight.members import fly_members
from flypend.flight.metrics import Metrics, judge, wilson
from flypend.flight.request import SAMPLE_PERIOD, Flight, Tolerances, bound_to, check_batch, some_times
from flypend.flight.sampled import nearest_ticks
from flypend.flight.simulate import ENGINES
from flypend.laws import AnyLaw, Controller
from flypend.model import State, Vehicle
from flypend.model.state import SIZE, E3Direction
from flypend.plants import AnyPlant, Sampled

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], Any]


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
    def interval(self) -> tuple[float, float]:
        """Wilson interval of the success rate, 95 %."""
        return wilson(int(np.sum(self.success)), len(self))

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
        Gains that differ between runs: name to (n,).
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
    if engine == "scipy" or not has_kernel(flight):
        steered = isinstance(flight.law, Controller)
        exact = flight.tolerances
        asked = {
            "gains": flight.gains and not steered,
            "method": exact.method,
            "precision": exact.precision != "double",
        }
        for name, value in asked.items():
            if value:
                raise errors.InputError(name, "an engine with compiled code, for a symbolic law", "another")
        return _one_by_one(flight, engine, workers, progress)
    return _gather(flight, fly_all(flight, workers=workers, progress=progress))


def _gather(flight: Flight, flown: Flown) -> Ensemble:
    columns = judge(
        flown.reductions, flown.status, flown.end, flight.vehicle, flight.criterion, clearance=flown.clearance
    )
    samples = None if flown.samples is None else State.trusted(flown.samples[..., :SIZE])
    return Ensemble(
        starts=flight.starts, final=State.trusted(flown.final), **columns, **_about(flight),
        samples=samples, wrenches=flown.samples[..., SIZE:] if flight.loop.lag and samples is not None else None,
    )  # fmt: skip


def _about(flight: Flight) -> dict[str, Any]:
    """Return the fields of an ensemble that specify what was flown and when it was sampled."""
    law, plant, t = flight.law, flight.plant, flight.times
    if t is not None and isinstance(plant, Sampled):
        t = nearest_ticks(t, plant, flight.duration) / plant.rate
    gains = {**law.gains, **flight.gains}
    return {"e3": law.e3, "vehicle": flight.vehicle, "law": law.name, "gains": gains, "t": t}


def _one_by_one(flight: Flight, engine: str, workers: int | None, progress: Progress) -> Ensemble:
    """Like `fly_many`, by single runs in one process per core."""
    members = fly_members(flight, engine, workers, progress)
    columns: dict[str, Any] = {
        entry.name: np.array([getattr(member.metrics, entry.name) for member in members]) for entry in fields(Metrics)
    }
    kept = flight.times is not None
    return Ensemble(
        starts=flight.starts, final=State.trusted(np.array([member.final for member in members])), **columns,
        **_about(flight), samples=State.trusted(np.array([member.samples for member in members])) if kept else None,
    )  # fmt: skip
