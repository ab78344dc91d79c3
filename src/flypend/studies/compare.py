"""Laws flown from the same starts, in one table, and their failed flights as run files, to be flown again."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, fields, replace
from functools import partial
from itertools import chain, count
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from flypend import errors, plants, signals
from flypend.errors import InputError
from flypend.flight.ensemble import Ensemble, fly_many
from flypend.flight.kernels import has_kernel, kernel_of
from flypend.flight.labels import dataset, variable
from flypend.flight.request import Flight, bound_to, check_batch, check_judged
from flypend.laws import AnyLaw, Controller, Law
from flypend.model import State, Vehicle
from flypend.model.state import SHAPES
from flypend.plants import AnyPlant
from flypend.settings.laws import absolute, table_of
from flypend.settings.runfile import plant_of, run_of
from flypend.signals.polling import result_of, threads

if TYPE_CHECKING:
    import xarray

Progress = Callable[[str, int, int], Any]
# Kernels that are compiled while a flight waits or flies, its own included.
AHEAD = 4
MOST_KEPT = 100  # failed flights of each law: one that fails for ever needs no thousand files
Name = TypeVar("Name", str, tuple[str, str])


@errors.named_arguments
@dataclass(frozen=True)
class Comparison:
    """Laws flown from the same physical starts.

    Parameters
    ----------
    ensembles : dict of Ensemble
        By name of the law; a second law of the same name is called "name (2)".
    """

    ensembles: dict[str, Ensemble]

    def rows(self) -> list[dict[str, Any]]:
        """Return one record per law: success with Wilson interval, settling, excursion, effort, peak force, causes."""
        return [{"law": name, **summary(ensemble)} for name, ensemble in self.ensembles.items()]

    def to_xarray(self) -> xarray.Dataset:
        """Return success, settling time and the other metrics as an `xarray.Dataset` over `law` and `run`."""
        over = ("law", "run")
        columns = [ensemble.columns for ensemble in self.ensembles.values()]
        variables = {name: variable(name, over, [some[name] for some in columns]) for name in columns[0]}
        vehicle = next(iter(self.ensembles.values())).vehicle
        return dataset({"law": variable("law", ("law",), list(self.ensembles)), **variables}, {"vehicle": vehicle.name})


@errors.named_arguments
@signals.defer()
def compare(
    vehicle: Vehicle,
    laws: Law | Controller | Sequence[Law | Controller],
    starts: State,
    duration: float = 10.0,
    *,
    plant: str | AnyPlant | Sequence[AnyPlant] = "rotors",
    workers: int | None = None,
    progress: Progress = lambda *_: None,
) -> Comparison:
    """Fly `vehicle` under each of `laws` from the same `starts`.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle.
    laws : Law, Controller or sequence of them
        Laws to compare; e₃-down laws fly the same physical starts in their own frame.
    starts : State
        A batch of states in the e₃-up frame.
    duration, workers
        As in `simulate_ensemble`.
    plant : str, Plant or sequence of Plant
        As in `simulate_ensemble`; of several, each gets an equal share of the starts, in order.
    progress : callable
        Called with `(name of the law, done, total)`.
    """
    several = plant if isinstance(plant, Sequence) and not isinstance(plant, str) else (plant,)
    worlds = [plants.plant(one) for one in several]
    flights = {
        (name, str(place)): part
        for name, flight in flights_of(vehicle, laws, starts, duration).items()
        for place, part in enumerate(split_flight(flight, worlds))
    }
    ensembles = fly_each(flights, workers, lambda key, done, total: progress(key[0], done, total))
    parts: dict[str, list[Ensemble]] = {}
    for (name, _), ensemble in ensembles.items():
        parts.setdefault(name, []).append(ensemble)
    return Comparison({name: join_ensembles(some) for name, some in parts.items()})


def split_flight(flight: Flight, worlds: Sequence[AnyPlant]) -> list[Flight]:
    """Return the parts of `flight` that fly through each of `worlds`. A run has the noise of its place in `flight`."""
    if not worlds:
        raise InputError("plant", "a plant, or several", "none")
    ends = share_ends(flight.runs, len(worlds))
    parts = [(flight.through(world), a, b) for world, a, b in zip(worlds, ends, ends[1:], strict=False) if a < b]
    return [one.replace(starts=one.starts[a:b], seed=(one.seed or 0) + a) for one, a, b in parts]


def share_ends(runs: int, worlds: int) -> list[int]:
    """Return where the equal shares of `worlds` begin among `runs`, and where the last one ends."""
    return [runs * place // worlds for place in range(worlds + 1)]


def join_ensembles(parts: Sequence[Ensemble]) -> Ensemble:
    """Return ensembles of one law on one vehicle, without samples, as one."""
    if len(parts) == 1:
        return parts[0]
    changes: dict[str, Any] = {
        name: np.concatenate([part.columns[name] for part in parts]) for name in parts[0].columns
    }
    changes["shares"] = tuple(map(len, parts))
    for name in ("starts", "final"):
        changes[name] = State.trusted(np.concatenate([getattr(part, name).packed() for part in parts]))
    return replace(parts[0], **changes)


def flights_of(
    vehicle: Vehicle, laws: Law | Controller | Sequence[Law | Controller], starts: State, duration: float
) -> dict[str, Flight]:
    """Return a request for each of `laws`, by unique name; `starts` (e₃ up) are converted to the frame of each law."""
    check_batch(starts)
    several = (laws,) if isinstance(laws, AnyLaw) else tuple(laws)
    if not several:
        raise InputError("laws", "a law, or several", "none")
    flights: dict[str, Flight] = {}
    for law in several:
        errors.check_kind("law", law, AnyLaw)
        own = starts.in_frame(law.e3)
        names = chain([law.name], (f"{law.name} ({number})" for number in count(2)))
        name = next(one for one in names if one not in flights)
        flights[name] = Flight(vehicle=vehicle, law=bound_to(vehicle, law), starts=own, duration=duration)
        check_judged(flights[name])
    return flights


def fly_each(
    flights: Mapping[Name, Flight], workers: int | None, progress: Callable[[Name, int, int], Any]
) -> dict[Name, Ensemble]:
    """Fly `flights` one after the other; another thread compiles the kernels of those to come.

    `workers` as in `compare`; `progress` is called with `(key of the flight, done, total)`.
    """
    names, ensembles = list(flights), {}
    with threads(1, last=False) as pool:
        coming: deque[Future[Any]] = deque()
        for place, name in enumerate(names):
            for following in names[place + len(coming) : place + AHEAD]:
                coming.append(pool.submit(_compile, flights[following]))
            result_of(coming.popleft())
            ensembles[name] = fly_many(flights[name], workers=workers, progress=partial(progress, name))
    return ensembles


def _compile(flight: Flight) -> None:
    """Leave the kernel of `flight`, if it has one, in the cache of this process."""
    if has_kernel(flight):
        kernel_of(flight)


def summary(ensemble: Ensemble) -> dict[str, Any]:
    """Return the statistics of one ensemble for tables."""
    low, high = ensemble.interval
    failed = ensemble.cause[ensemble.cause != ""]
    return {
        "runs": len(ensemble),
        "successes": int(ensemble.success.sum()),
        "success": ensemble.rate,
        "wilson_low": low,
        "wilson_high": high,
        "settling_p50": ensemble.percentile("settling", 50),
        "settling_p95": ensemble.percentile("settling", 95),
        "excursion_p50": ensemble.percentile("excursion", 50),
        "excursion_p95": ensemble.percentile("excursion", 95),
        "excursion_max": ensemble.percentile("excursion", 100),
        "lowest_p5": ensemble.percentile("lowest", 5),
        **{f"{name}_p95": ensemble.percentile(name, 95) for name in ("box_x", "box_y", "box_z")},
        "effort_p50": ensemble.percentile("effort", 50),
        "peak_force_max": ensemble.percentile("peak_force", 100),
        **({"clearance_p5": ensemble.percentile("clearance", 5)} if ensemble.vehicle.mount != "gimbal" else {}),
        "causes": {str(cause): int((failed == cause).sum()) for cause in sorted(set(failed.tolist()))},
    }


def files_of_failures(
    comparison: Comparison, laws: Sequence[str], plant: Any, duration: float, drawn: Sequence[AnyPlant] = ()
) -> dict[str, Any]:
    """Return the content of a run file for each failed flight of `comparison`, by name "law-run".

    Of each of `laws`, called as on the command line, at most `MOST_KEPT` are taken. `plant` is a name or a table, as in
    a run file, the `duration` of a flight in s. Shares flew through plants `drawn` from it; none if through it alone.
    """
    found: dict[str, Any] = {}
    table_of_plant, base = {"base": plant} if isinstance(plant, str) else dict(plant), plant_of(plant)
    seed = getattr(base, "seed", None)
    for (name, ensemble), law in zip(comparison.ensembles.items(), laws, strict=True):
        table = absolute(table_of(law), Path.cwd())
        ends = share_ends(len(ensemble), len(drawn)) if drawn else [0]
        for run in np.flatnonzero(~ensemble.success)[:MOST_KEPT]:
            start = ensemble.starts[run]
            own = differing_fields(drawn[np.searchsorted(ends, run, "right") - 1], base) if drawn else {}
            found[f"{_plain(name)}-{run}"] = {
                "vehicle": ensemble.vehicle.to_dict(),
                "law": table,
                "plant": plant if seed is None else table_of_plant | own | {"seed": seed + int(run)},
                "duration": float(duration),
                "start": {field: getattr(start, field).tolist() for field in SHAPES},
            }
    return found


def fly_again(runs: Mapping[str, Any], folder: Path, progress: Any = lambda *_: None) -> None:
    """Fly the run files `runs` of `files_of_failures` one by one, and save each in `folder` as name.nc."""
    from flypend.flight.simulate import fly

    for done, (name, content) in enumerate(runs.items()):
        progress(f"flying {name} again", done, len(runs))
        fly(run_of(dict(content)).flight).save(folder / f"{name}.nc")


def differing_fields(plant: AnyPlant, base: AnyPlant) -> dict[str, Any]:
    """Return the fields in which `plant` differs from `base`, as a run file has them."""
    found = {entry.name: getattr(plant, entry.name) for entry in fields(plant)}
    changed = {name: value for name, value in found.items() if value != getattr(base, name)}
    return {name: dict(value) if isinstance(value, Mapping) else value for name, value in changed.items()}


def _plain(name: str) -> str:
    """`name` without characters that a file name cannot have."""
    return "".join(letter if letter.isalnum() else "-" for letter in name).strip("-")
