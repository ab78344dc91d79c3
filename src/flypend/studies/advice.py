"""Which of several checked laws to fly on a vehicle; and where none will do, which change of the vehicle would.

A change is flown, not foretold: the inverted law, whose gains follow from the changed vehicle, from random starts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from flypend import plants
from flypend.errors import InputError
from flypend.flight.ensemble import Ensemble, fly_many
from flypend.flight.feasibility import feasibility
from flypend.flight.metrics import Count
from flypend.flight.request import Flight, bound_to
from flypend.flight.tasks import LEAST_RATE, task_starts
from flypend.laws import inverted
from flypend.model import Vehicle
from flypend.model.rod import stretch
from flypend.plants import AnyPlant, Sampled
from flypend.studies.check import Check

RUNS, DURATION = 100, 30.0  # flights of a changed vehicle, and seconds of each, as in a check
# Factors of each number, from a small change to the largest that leaves the machine recognisable, and how to make it.
CHANGES: Mapping[str, tuple[tuple[float, ...], str]] = {
    "rod_length": ((1.25, 1.6, 2.0), "a longer rod"),
    "bob_mass": ((0.7, 0.5, 0.25), "a lighter rod and bob"),
    "rotor_limits": ((1.25, 1.6, 2.0), "stronger rotors: a battery of more cells, or larger propellers"),
    "rotor_lag": ((0.7, 0.5, 0.3), "quicker rotors: smaller propellers, or controllers that brake"),
}
UNITS = {"rod_length": "m to the centre of mass", "bob_mass": "kg", "rotor_limits": "N each", "rotor_lag": "s"}


@dataclass(frozen=True)
class Change:
    """A changed vehicle that was flown."""

    factors: Mapping[str, float]  # of each number that was changed, of `CHANGES`
    how: str  # the change in words, with the numbers it leads to
    successes: int  # of so many random flights
    runs: int

    @property
    def works(self) -> bool:
        """Whether at least 90 % succeed."""
        return self.successes >= LEAST_RATE * self.runs

    def describe(self) -> str:
        """Return change and success with its Wilson interval, 95 %, in a line."""
        return f"{self.how}: {Count(self.successes, self.runs).describe()}"


@dataclass(frozen=True)
class Advice:
    """What to fly on a vehicle."""

    law: str  # the best of the laws; empty if none flies the vehicle from 90 % of the random starts
    why: str  # what it does beside the others, in a line
    # Changes of a vehicle that no law flies: the smallest of each kind that works; if no kind does, all at once.
    changes: tuple[Change, ...] = ()
    as_written: tuple[str, ...] = ()  # laws that fly the vehicle as written, where none flies those of its bands

    def lines(self) -> list[str]:
        """Return the law and why, or what to change."""
        if self.law:
            return [f"best: {self.law}. {self.why}"]
        if self.as_written:
            laws = f"{', '.join(self.as_written)} will do for the vehicle as written"
            return [f"none of these laws will do within the bands. {self.why}", f"narrow them by a longer log: {laws}"]
        good = [f"  {one.describe()}" for one in self.changes if one.works]
        best = max(self.changes, key=lambda one: one.successes, default=None)
        if good:
            return [f"none of these laws will do. {self.why}", "what would help, flown with the inverted law:", *good]
        tried = "nothing that could be tried" if best is None else f"not even {best.describe()}"
        return [f"none of these laws will do. {self.why}", f"what would help: {tried}"]

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain numbers, lists and dicts."""
        return asdict(self)


def advise(
    vehicle: Vehicle,
    checks: Mapping[str, Check],
    *,
    plant: str | AnyPlant = "rotors",
    seed: int = 1,
    progress: Callable[[str, int, int], Any] = lambda *_: None,
) -> Advice:
    """Name the best of checked laws, or find out which change of `vehicle` would do.

    The best law succeeds from 90 % of the random starts, of drawn vehicles if those were flown, and is the best of such
    laws by `best_of`. The `checks` of the vehicle are keyed by the name of the law; `plant` and `seed` are as in
    `check`. `progress` is called with (task, done, total).
    """
    flown = {
        law: check.tasks.get("drawn", check.tasks["random"])
        for law, check in checks.items()
        if check.ok and check.tasks
    }
    why = "; ".join(f"{law}: {_describe(flown[law])}" if law in flown else f"{law}: cannot hover" for law in checks)
    best = best_of(flown)
    written = tuple(law for law in flown if checks[law].tasks["random"].rate >= LEAST_RATE)
    if not best and written:
        return Advice("", why, as_written=written)
    return Advice(best, why, () if best else changes_of(vehicle, plant, seed, progress))


def best_of(flown: Mapping[str, Ensemble]) -> str:
    """Return the best law of `flown`, from the same starts; empty if none succeeds from 90 % of them.

    No other law's interval of success lies above its own, and of such laws its median excursion is the smallest.
    """
    able = {law: one for law, one in flown.items() if one.rate >= LEAST_RATE}
    surest = max((one.interval[0] for one in able.values()), default=1.0)
    equal = {law: one.percentile("excursion", 50) for law, one in able.items() if one.interval[1] >= surest}
    return min(equal, key=equal.__getitem__, default="")


def changes_of(
    vehicle: Vehicle,
    plant: str | AnyPlant = "rotors",
    seed: int = 1,
    progress: Callable[[str, int, int], Any] = lambda *_: None,
) -> tuple[Change, ...]:
    """Return for each kind of `CHANGES` the largest, or where it lets the inverted law fly, the smallest that does.

    If no kind works alone, the last is all of them at once. `plant`, `seed` and `progress` as in `advise`.
    """
    world, found = plants.as_sampled(plant), []
    known = {name: factors for name, (factors, _) in CHANGES.items() if np.any(getattr(vehicle, name))}
    for done, (name, factors) in enumerate(known.items()):
        progress("changes", done, len(known) + 1)
        largest = _fly(vehicle, {name: factors[-1]}, world, seed)
        smaller = (_fly(vehicle, {name: factor}, world, seed) for factor in factors[:-1])
        found.append(next((one for one in smaller if one.works), largest) if largest.works else largest)
    if not any(one.works for one in found):
        found.append(_fly(vehicle, {name: factors[-1] for name, factors in known.items()}, world, seed))
    progress("changes", len(known) + 1, len(known) + 1)
    return tuple(found)


def change(vehicle: Vehicle, factors: Mapping[str, float]) -> Vehicle:
    """Return `vehicle` with numbers of `CHANGES` times their factors; the rod keeps its shape."""
    new: dict[str, Any] = {name: getattr(vehicle, name) * np.float64(factor) for name, factor in factors.items()}
    if "rotor_limits" in factors:
        least, most = vehicle.rotor_limits
        new["rotor_limits"] = (least, most * factors["rotor_limits"])
    return vehicle.replace(**new | stretch(vehicle, factors.get("bob_mass", 1.0), factors.get("rod_length", 1.0)))


def _fly(vehicle: Vehicle, factors: Mapping[str, float], plant: Sampled, seed: int) -> Change:
    """Fly the inverted law on the `vehicle` changed by `factors`, from random starts."""
    new = change(vehicle, factors)
    words = ", ".join(f"{CHANGES[name][1]} (× {factor:g}, {_number(new, name)})" for name, factor in factors.items())
    if feasibility(plant.true_vehicle(new), plant.delay).impossible:
        return Change(dict(factors), words, 0, RUNS)
    try:
        law = bound_to(new, inverted())
    except InputError:  # the law refuses such a vehicle
        return Change(dict(factors), words, 0, RUNS)
    starts = task_starts(new, RUNS, seed)["random"]
    flight = Flight(vehicle=new, law=law, starts=starts.in_frame(law.e3), duration=DURATION, plant=plant)
    return Change(dict(factors), words, int(fly_many(flight).success.sum()), RUNS)


def _number(vehicle: Vehicle, name: str) -> str:
    value, unit = np.ravel(getattr(vehicle, name))[-1], UNITS[name]
    return f"{value:.3g} {unit}"


def _describe(flown: Ensemble) -> str:
    return f"{flown.count.describe()}, {flown.percentile('excursion', 50):.3g} m off in the median"
