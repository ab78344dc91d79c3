"""Laws flown from the same starts, in one table."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from flypend import plants
from flypend.errors import InputError
from flypend.flight.ensemble import Ensemble, fly_many
from flypend.flight.labelled import dataset, variable
from flypend.flight.request import Flight, bound_to
from flypend.laws import Controller, Law
from flypend.model import State, Vehicle
from flypend.plants import AnyPlant

if TYPE_CHECKING:
    import xarray

Progress = Callable[[str, int, int], Any]


@dataclass(frozen=True)
class Comparison:
    """Laws flown from the same physical starts.

    Parameters
    ----------
    ensembles : dict of Ensemble
        By the name of the law; a second law of one name is called "name (2)".
    """

    ensembles: dict[str, Ensemble]

    def rows(self) -> list[dict[str, Any]]:
        """One record per law: success with its Wilson interval, settling, excursion, effort, peak force, causes."""
        return [{"law": name, **summary(ensemble)} for name, ensemble in self.ensembles.items()]

    def to_xarray(self) -> xarray.Dataset:
        """Success, settling time and the other metrics as an `xarray.Dataset` on the dimensions `law` and `run`."""
        over = ("law", "run")
        columns = [ensemble.columns for ensemble in self.ensembles.values()]
        variables = {name: variable(name, over, [some[name] for some in columns]) for name in columns[0]}
        vehicle = next(iter(self.ensembles.values())).vehicle
        return dataset({"law": variable("law", ("law",), list(self.ensembles)), **variables}, {"vehicle": vehicle.name})


def compare(
    vehicle: Vehicle,
    laws: Sequence[Law | Controller],
    starts: State,
    duration: float = 10.0,
    *,
    plant: str | AnyPlant = "rotors",
    workers: int | None = None,
    progress: Progress = lambda *_: None,
) -> Comparison:
    """Fly `vehicle` under each of `laws` from the same `starts`.

    Parameters
    ----------
    vehicle : Vehicle
        What flies.
    laws : sequence of Law or Controller
        Laws to compare; those with e₃ down fly the same physical starts in their own frame.
    starts : State
        A batch of states in the frame with e₃ up.
    duration, plant, workers
        As in `simulate_ensemble`.
    progress : callable
        Told `(name of the law, done, total)`.
    """
    flights = flights_of(vehicle, laws, starts, duration)
    return compared(flights, plants.plant(plant), workers=workers, progress=progress)


def flights_of(vehicle: Vehicle, laws: Sequence[Law | Controller], starts: State, duration: float) -> dict[str, Flight]:
    """A request for each of `laws`, by a name of its own; `starts`, with e₃ up, are turned into the frame of each."""
    if not isinstance(starts, State) or len(starts.batch_shape) != 1:
        raise InputError("starts", "a State with one leading batch axis", repr(starts)[:80])
    flights: dict[str, Flight] = {}
    for law in laws:
        own = starts.seen(law.e3)
        name = _free_name(law.name, flights)
        flights[name] = Flight(vehicle=vehicle, law=bound_to(vehicle, law), starts=own, duration=duration)
    return flights


def compared(
    flights: Mapping[str, Flight], plant: AnyPlant, *, workers: int | None = None, progress: Progress = lambda *_: None
) -> Comparison:
    """The `flights` of `flights_of`, each through `plant`; `workers` and `progress` as in `compare`."""
    return Comparison(
        {
            name: fly_many(flight.through(plant), workers=workers, progress=partial(progress, name))
            for name, flight in flights.items()
        }
    )


def summary(ensemble: Ensemble) -> dict[str, Any]:
    """The numbers of one ensemble that tables show."""
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
        "effort_p50": ensemble.percentile("effort", 50),
        "peak_force_max": ensemble.percentile("peak_force", 100),
        "causes": {str(cause): int((failed == cause).sum()) for cause in sorted(set(failed.tolist()))},
    }


def _free_name(name: str, taken: Mapping[str, Flight]) -> str:
    out, count = name, 2
    while out in taken:
        out, count = f"{name} ({count})", count + 1
    return out
