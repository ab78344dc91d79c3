"""A training: imitation of the tuned law, then descent of the gradient of what flights cost; from a seed, resumable."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from flypend import errors
from flypend.errors import InputError
from flypend.files.arrays import read_arrays, save_arrays
from flypend.files.schema import Field
from flypend.flight.tasks import free_starts
from flypend.laws.learned import MOST_WEIGHTS, Policy
from flypend.learning.course import Course, Machines
from flypend.learning.flights import Costs, Flights
from flypend.learning.network import Adam, Weights, first_weights
from flypend.learning.teacher import RATE, Imitation, direct
from flypend.model import State, Vehicle
from flypend.planning.dynamics import Units
from flypend.plants.bands import check_bands
from flypend.plants.sensors import Sensors
from flypend.signals.polling import result_of, threads

AHEAD = 0.3  # s: what touches does so soon, or can be helped later
AMONG = 4  # starts flown for each that is kept
PARTS = 2  # of a batch, each flown by a thread; fixed, so that results do not depend on the machine's cores


@dataclass(frozen=True)
class Training:
    """What is to be learned, and for how long.

    Parameters
    ----------
    course : Course
        The flights, and what they cost.
    seed : int
        Seed of first weights and starts.
    hidden : (2,)
        Sizes of the hidden layers.
    batch : int
        Flights per update, a multiple of 16.
    rounds, steps : int
        Rounds of imitation, and steps of each.
    updates : int
        Updates by descent.
    rate : float
        Largest step of a weight per update; it falls to a fiftieth.
    """

    course: Course
    seed: int = 0
    hidden: tuple[int, int] = (64, 64)
    batch: int = 512
    rounds: int = 60
    steps: int = 100
    updates: int = 1500
    rate: float = 4e-3

    def __post_init__(self) -> None:
        vehicle = self.course.vehicle
        least, most = len(vehicle.rotor_spins) * np.array(vehicle.rotor_limits)
        if not least < vehicle.weight < most:
            wanted = f"one that can hover: a weight between its thrusts, {least:.3g} N and {most:.3g} N"
            raise InputError("vehicle", wanted, f"{vehicle.weight:.3g} N of {vehicle.name}")
        if vehicle.mount == "cup":
            raise InputError("mount", "gimbal or hub: from random starts a rod leaves its cup at once", "cup")
        for name in ("rounds", "updates", "steps"):
            errors.integer(name, getattr(self, name), 0)
        if errors.integer("batch", self.batch, 16) % 16:
            raise InputError("batch", "a multiple of 16", repr(self.batch))
        k, m = self.hidden
        size = 18 * (k + len(vehicle.rotor_spins)) + k + m * k + m + len(vehicle.rotor_spins) * m
        if min(k, m) < 1 or size > MOST_WEIGHTS:
            raise InputError("hidden", f"two layers with at most {MOST_WEIGHTS} weights", repr(self.hidden))

    @property
    def data(self) -> dict[str, Any]:
        """All of it, for files."""
        course = {name: value for name, value in vars(self.course).items() if name != "vehicle"}
        course["sensors"] = self.course.sensors and self.course.sensors.to_dict()
        return {**vars(self), "course": course, "vehicle": self.course.vehicle.to_dict()}


def usual(
    vehicle: Vehicle, seed: int = 0, updates: int | None = None, bands: bool = False, sensors: Sensors | None = None
) -> Training:
    """Return the training for `vehicle` of `flypend learn`.

    On a hub keeping clear is what costs most, by far, and takes a larger network and smaller steps. Raises InputError
    for `bands` of a vehicle that has none.
    """
    if bands:
        check_bands(vehicle)
    if updates is None:
        updates = 1200 if vehicle.mount == "hub" else 1500
    if vehicle.mount != "hub":
        return Training(Course(vehicle, bands=bands, sensors=sensors), seed=seed, updates=updates)
    course = Course(vehicle, excursion=0.3, arms=40.0, bands=bands, sensors=sensors)
    return Training(course, seed=seed, hidden=(96, 96), rate=2e-3, updates=updates)


class Entry(NamedTuple):
    """A point of the curve: the `phase` (0 or 1), its updates so far, and what the flights since the last one did.

    `cost`, the share of flights that `stands` near hover at the end, and median and 95th percentile of the largest
    distance, m.
    """

    phase: float
    update: float
    cost: float
    stands: float
    median: float
    high: float


EVERY = 25  # updates between two points of the curve


class Learner:
    """A training under way. Equal `training` yields equal weights, however often it was interrupted."""

    def __init__(self, training: Training) -> None:
        self.training, vehicle = training, training.course.vehicle
        self.weights = first_weights(direct(vehicle), training.hidden, np.random.default_rng([training.seed, 0]))
        self.adam, self.done = Adam(self.weights), 0
        self.curve: list[Entry] = []
        self._parts = [Flights(training.course, training.batch // PARTS) for _ in range(PARTS)]
        self._machines = Machines.of(training.course, training.seed)
        short = replace(training.course, duration=AHEAD)
        self._scouts = Flights(short, AMONG * (training.batch // 2)) if vehicle.mount == "hub" else None
        self._since: list[Costs] = []

    @property
    def policy(self) -> Policy:
        """The present policy."""
        return Policy(**self.weights)

    def imitate(self, report: Callable[[Entry], Any] = lambda _: None) -> None:
        """Imitate the tuned law; `report` is called after every round."""
        flights, training = self._parts[0], self.training
        imitation = Imitation(flights, self.weights, training.steps)
        for i in range(training.rounds):
            rng = np.random.default_rng([training.seed, 1, i])
            with threadpool_limits(1, "blas"):
                begin = starts(training.course.vehicle, rng, flights.count)
                imitation.round(self.weights, begin, rng, RATE * rate_share(i, training.rounds))
            self._add(flights.judge()[0], 0, i + 1, report)

    def descend(self, report: Callable[[Entry], Any] = lambda _: None) -> None:
        """Make the next update by descent; `report` is called with every new point of the curve."""
        training, i = self.training, self.done
        rng = np.random.default_rng([training.seed, 2, i])
        begin = np.split(self._starts(rng), PARTS)
        for part in self._parts:
            self._enter(part, rng)
        with threadpool_limits(1, "blas"), threads(PARTS) as pool:
            calls = [pool.submit(self._fly, *part) for part in zip(self._parts, begin, strict=True)]
            flown = [result_of(call) for call in calls]
        gradient = {name: np.sum([part[1][name] for part in flown], axis=0) / training.batch for name in self.weights}
        warm = min(1.0, (i + 1) / 20)
        self.adam.move(self.weights, gradient, training.rate * warm * rate_share(i, training.updates))
        self.done = i + 1
        self._since += [part[0] for part in flown]
        if self.done % EVERY == 0 or self.done == training.updates:
            self._add(Costs(*map(np.concatenate, zip(*self._since, strict=True))), 1, self.done, report)
            self._since = []

    def _enter(self, flights: Flights, rng: np.random.Generator) -> None:
        """Draw who flies, and how it is seen, if that differs from the vehicle as written and its state."""
        machines, course = self._machines, self.training.course
        if course.bands or course.sensors is not None:
            errors = machines.errors(rng, flights.count) if course.sensors is not None else None
            flights.enter(machines.choose(rng, flights.count), machines, errors)

    def _fly(self, flights: Flights, starts: Any) -> tuple[Costs, Weights]:
        flights.fly(self.weights, starts)
        costs, to_costs = flights.judge()
        return costs, flights.gradient(self.weights, to_costs)

    def _starts(self, rng: np.random.Generator) -> Any:
        """Return `starts` of a batch; half are dangerous ones under the present weights if the rod can touch a part."""
        vehicle, count, scouts = self.training.course.vehicle, self.training.batch, self._scouts
        if scouts is None:
            return starts(vehicle, rng, count)
        with threadpool_limits(1, "blas"):
            begin = dangerous(scouts, self.weights, starts(vehicle, rng, scouts.count), count // 2)
        return rng.permutation(np.concatenate([begin, starts(vehicle, rng, count - len(begin))]))

    def _add(self, costs: Costs, phase: int, update: int, report: Callable[[Entry], Any]) -> None:
        """Add an entry of these `costs` to the curve, and tell it."""
        median, high = np.quantile(costs.distance, (0.5, 0.95))
        self.curve.append(Entry(phase, update, np.mean(costs.cost), np.mean(costs.stands), median, high))
        report(self.curve[-1])

    # Interruptions ----------------------------------------------------------------------------------------------------

    def save(self, path: Path) -> None:
        """Write the state of the training to `path`, .npz. Raises InputError if it is no longer finite."""
        own = {
            "told": _report(self.training), "done": self.done, "count": self.adam.count,
            "curve": np.reshape(self.curve, (-1, len(Entry._fields))),
        }  # fmt: skip
        save_arrays(path, self._fields(), {**own, **self.weights, **self.adam.moments})

    def resume(self, path: Path) -> bool:
        """Take up the training saved in `path`; return whether there is one. Raises InputError if it is another."""
        if not path.exists():
            return False
        expected = "one of the same training (or another folder)"
        stored = read_arrays("checkpoint", path, expected, self._fields())
        if str(stored["told"]) != _report(self.training):
            raise InputError("checkpoint", expected, str(path))
        for known in (self.weights, self.adam.moments):
            for name, array in known.items():
                array[...] = stored[name]
        self.done, self.adam.count = int(stored["done"]), int(stored["count"])
        self.curve = [Entry(*row) for row in stored["curve"].tolist()]
        return True

    def _fields(self) -> dict[str, Field]:
        """What a checkpoint of this training holds."""
        updates = self.training.updates
        weights = {name: Field(array.shape, "<f4") for name, array in self.weights.items()}
        return {
            "told": Field((), "U"),
            "done": Field((), "<i8", low=0, high=updates),
            "count": Field((), "<i8", low=0, high=updates),  # fewer: a gradient that is not finite moves nothing
            "curve": Field(("entry", len(Entry._fields)), finite=False),
            **weights,
            **{f"m{name}": field for name, field in weights.items()},
            **{f"v{name}": field._replace(low=0) for name, field in weights.items()},
        }


def _report(training: Training) -> str:
    return json.dumps(training.data, default=list, sort_keys=True)


def rate_share(i: int, count: int) -> float:
    """Return the share of the rate at step `i` of `count`: from 1 to a fiftieth, faster at first."""
    return 0.02 + 0.98 * (1 - i / max(count, 1)) ** 2


def starts(vehicle: Vehicle, rng: np.random.Generator, count: int) -> Any:
    """Return random starts (count, 24 + n) in own units, with free rods and rotors at their least."""
    n, found = len(vehicle.rotor_spins), free_starts(vehicle, State.random, rng, count)
    forces = np.full((count, n), vehicle.rotor_limits[0])
    return np.concatenate([found.packed(), forces], axis=1) / Units.of(vehicle).states(n)


def dangerous(scouts: Flights, weights: Weights, starts: Any, kept: int) -> Any:
    """Return the `kept` of `starts` (count, 24 + n), own units, whose rods come nearest to an arm under `weights`.

    `scouts` is the memory of their flights.
    """
    scouts.fly(weights, starts)
    near = scouts.costs[:, :, 2].max(axis=0).ravel()
    return starts[np.argsort(-near, kind="stable")[:kept]]
