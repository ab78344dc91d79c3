"""The reality ladder: the same starts and laws on plants that each add a departure from the ideal."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flypend import errors, plants, signals
from flypend.laws import Controller, Law
from flypend.model import State, Vehicle
from flypend.plants import AnyPlant
from flypend.studies.compare import Comparison, flights_of, flown
from flypend.studies.rungs import rungs_for

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class Ladder:
    """Laws compared from the same starts, on one plant per rung.

    Parameters
    ----------
    rungs : dict of Comparison
        By name of the rung.
    """

    rungs: dict[str, Comparison]

    def broken(self, law: str, below: float = 0.9) -> list[str]:
        """Return the rungs on which the success rate of `law` is less than `below`."""
        return [rung for rung, comparison in self.rungs.items() if comparison.ensembles[law].rate < below]

    def to_xarray(self) -> xarray.Dataset:
        """Return the metrics as an `xarray.Dataset` over `rung`, `law` and `run`."""
        errors.require("xarray", extra="studies", for_="to_xarray")
        import xarray

        found = [comparison.to_xarray() for comparison in self.rungs.values()]
        return xarray.concat(found, dim=xarray.Variable("rung", list(self.rungs)), combine_attrs="override")


@signals.deferred()
def ladder(
    vehicle: Vehicle,
    laws: Law | Controller | Sequence[Law | Controller],
    starts: State,
    duration: float = 10.0,
    *,
    rungs: Mapping[str, str | AnyPlant] | None = None,
    workers: int | None = None,
    progress: Callable[[str, int, int], Any] = lambda *_: None,
) -> Ladder:
    """Fly `vehicle` under `laws` from `starts` on each of `rungs`.

    Parameters
    ----------
    vehicle, laws, starts, duration, workers
        As in `compare`.
    rungs : dict, optional
        Plants by name of the rung; default `flypend.studies.rungs.rungs_for(vehicle)`.
    progress : callable
        Called with `(task, done, total)`.
    """
    worlds = {
        rung: plants.plant(plant) for rung, plant in (rungs or rungs_for(vehicle)).items()
    }  # raises if an extra is not installed
    of_laws = flights_of(vehicle, laws, starts, duration)
    flights = {(rung, law): flight.through(world) for rung, world in worlds.items() for law, flight in of_laws.items()}
    ensembles = flown(flights, workers, lambda key, done, total: progress(f"flying {key[1]} on {key[0]}", done, total))
    return Ladder({rung: Comparison({law: ensembles[rung, law] for law in of_laws}) for rung in worlds})
