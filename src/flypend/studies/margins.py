"""How far a number of the world may be from the law's own before success drops below a limit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from threading import Event
from typing import Any, NamedTuple, TypeVar

import numpy as np

from flypend.flight.ensemble import Ensemble, fly_many
from flypend.flight.kernels import has_kernel
from flypend.flight.metrics import Count, wilson
from flypend.flight.request import Flight
from flypend.flight.tasks import LEAST_RATE
from flypend.model import Vehicle
from flypend.plants import MOTION_CAPTURE, Noise, Sampled
from flypend.plants.plant import LONGEST_DELAY, MOST_IN_TRANSIT
from flypend.signals.polling import result_of, threads

# A search stops once the boundary is known to this share of it, or to be below this share of its first step.
RESOLUTION, LEAST_STEP = 0.12, 1 / 16
SEARCHES = 2  # searches at a time: while one compiles in Python, the other does in LLVM, or flies
Item = TypeVar("Item")
Found = TypeVar("Found")


def for_each(
    flight: Flight,
    call: Callable[[Item], Found],
    items: Sequence[Item],
    progress: Callable[[int, int], Any],
    stop: Callable[[], Any] = lambda: None,
) -> list[Found]:
    """Return what `call`, which flies variants of `flight` by `fly_beside`, returns for each of `items`.

    Of flights with a kernel `SEARCHES` are made at a time. `progress` is called with (done, total). At the end, or if
    anything is raised, `stop` tells calls that go on to return soon: they are waited for.
    """
    found: list[Found] = []
    with threads(SEARCHES if has_kernel(flight) else 1) as pool:
        try:
            for job in [pool.submit(call, item) for item in items]:
                found.append(result_of(job))
                progress(len(found), len(items))
        finally:
            stop()
    return found


def fly_beside(flight: Flight) -> Ensemble:
    """Fly `flight` beside others: a kernel in one thread, any other on all cores."""
    return fly_many(flight, workers=1 if has_kernel(flight) else None)


def count_of(flight: Flight) -> Count:
    """Return how many runs of `flight` succeed, flown by `fly_beside`."""
    return fly_beside(flight).count


@dataclass(frozen=True)
class Margin:
    """Success against one number of the world.

    Parameters
    ----------
    name, unit : str
        What is varied, and the unit of `values`.
    nominal : float
        What the law believes.
    values, successes : tuple of float, of int
        Values flown, ascending, and how many of `runs` flights succeed at each.
    runs : int
        Flights at each value.
    low, high : float
        The range around `nominal` within which at least 90 % succeed, as far as it was flown; NaN on a side that was
        not searched.
    open_low, open_high : bool
        Whether the search ended there before success dropped.
    """

    name: str
    unit: str
    nominal: float
    values: tuple[float, ...]
    successes: tuple[int, ...]
    runs: int
    low: float
    high: float
    open_low: bool
    open_high: bool

    def rate(self) -> Any:
        """Return success rates (k,) and their Wilson bounds (2, k), 95 %."""
        rates = np.array(self.successes) / self.runs
        return rates, np.array([wilson(count, self.runs) for count in self.successes]).T

    def describe(self) -> str:
        """Return the range in words: "0.62 to 1.31", "up to 34 ms", "up to more than 8"."""
        high = f"{'more than ' if self.open_high else ''}{self.high:.3g}"
        words = f"up to {high}"
        if not np.isnan(self.low):
            words = f"{'less than ' if self.open_low else ''}{self.low:.3g} to {high}"
        return f"{words} {self.unit}".strip()


@dataclass(frozen=True)
class Quantity:
    """A number of the world to vary."""

    name: str  # as in `Margin`, like the next two
    unit: str
    nominal: float
    plant: Callable[[float], Sampled]  # value → plant in which the world has it
    value: Callable[[float], float]  # signed distance from the nominal value → value; the nominal one at 0
    step: float  # first and largest distance
    most: float
    both: bool = True  # whether distances below 0 are searched, too


def quantities(vehicle: Vehicle, plant: Sampled) -> list[Quantity]:
    """Return the numbers whose margins are searched: delay, lag, rod length, mass and noise.

    Delays start at a tenth of √(l/g) and end where the plant's queue does. Lag, rod length and mass (of vehicle and rod
    together) are factors from 1/4 to 4; noise is a multiple of the plant's or its sensors', or of motion
    capture's.
    """
    time = float(np.sqrt(vehicle.l / vehicle.g))
    longest = min(LONGEST_DELAY, MOST_IN_TRANSIT / plant.rate)
    noisy = plant.noise is not None or plant.sensors is not None
    least = 1.0 if noisy else 0.0
    return [
        Quantity(
            "delay", "ms", 1e3 * plant.delay, lambda ms: plant.replace(delay=ms / 1e3),
            lambda d: 1e3 * (plant.delay + d), 0.1 * time, longest - plant.delay, both=False,
        ),
        _rotor_lag(plant, plant.true_vehicle(vehicle).rotor_lag, time),
        Quantity("rod length", "times the believed", 1.0, mismatch(plant, "rod_length"), _factor, 0.1, 3.0),
        Quantity(
            "mass", "times the believed", 1.0, mismatch(plant, "mass", "bob_mass"), _factor, 0.2, 3.0
        ),
        Quantity(
            "noise", "of the plant's" if noisy else "of motion capture's", least,
            partial(_noisier, plant), lambda d: least + d, 1.0, 15.0, both=False,
        ),
    ]  # fmt: skip


def _rotor_lag(plant: Sampled, lag: float, time: float) -> Quantity:
    def changed(ms: float) -> Sampled:
        return plant.replace(lag=ms / 1e3, mismatch={**plant.mismatch, "rotor_lag": 1.0})

    if lag > 0:
        return Quantity("rotor lag", "ms", 1e3 * lag, changed, lambda d: 1e3 * lag * _factor(d), 0.5, 3.0)
    return Quantity("rotor lag", "ms", 0.0, changed, lambda d: 1e3 * d, 0.1 * time, time, both=False)


def search(
    flight: Flight, wanted: Sequence[Quantity], progress: Callable[[str, int, int], Any] = lambda *_: None
) -> dict[str, Margin]:
    """Return the margins of `wanted` by name; `flight` flies its starts at every value, the nominal one once for all.

    `progress` is called with (name, done, total), in searches.
    """
    nominal, stop = count_of(flight).successes, Event()
    sides = [(quantity, sign) for quantity in wanted for sign in ((1.0, -1.0) if quantity.both else (1.0,))]

    def tell(done: int, total: int) -> None:
        progress(f"margin of {sides[done - 1][0].name}", done, total)

    progress("margins", 0, len(sides))
    found = for_each(flight, lambda side: _side(flight, *side, stop), sides, tell, stop.set)
    margins, sides_found = {}, iter(found)
    for quantity in wanted:
        above = next(sides_found)
        below = next(sides_found) if quantity.both else _Side({}, np.nan, False)
        counts = {quantity.nominal: nominal} | above.counts | below.counts
        values = sorted(counts)
        margins[quantity.name] = Margin(
            quantity.name, quantity.unit, quantity.nominal, tuple(values), tuple(counts[value] for value in values),
            flight.runs, below.end, above.end, below.is_open, above.is_open,
        )  # fmt: skip
    return margins


class _Side(NamedTuple):
    """One side of a search: successes by value, the value at its end, and whether success has not dropped there."""

    counts: dict[float, int]
    end: float
    is_open: bool


def _side(flight: Flight, quantity: Quantity, sign: float, stop: Event) -> _Side:
    """Search from the first step out to where success drops, then in between; no further once `stop` is set."""
    counts: dict[float, int] = {}
    good, bad, distance = 0.0, np.inf, min(quantity.step, quantity.most)
    while bad - good > RESOLUTION * good and good < quantity.most and bad > LEAST_STEP * quantity.step:
        if stop.is_set():
            break
        value = quantity.value(sign * distance)
        counts[value] = count_of(flight.through(quantity.plant(value))).successes
        if counts[value] >= LEAST_RATE * flight.runs:
            good = distance
        else:
            bad = distance
        distance = min(2 * distance, quantity.most) if np.isinf(bad) else (good + bad) / 2
    return _Side(counts, quantity.value(sign * good), bool(np.isinf(bad)))


def _factor(distance: float) -> float:
    """1 + d, or 1/(1 + |d|) for d < 0."""
    return 1 + distance if distance >= 0 else 1 / (1 - distance)


def mismatch(plant: Sampled, *names: str) -> Callable[[float], Sampled]:
    """Return factor → `plant` whose mismatch of each of `names` is multiplied by that factor."""

    def changed(factor: float) -> Sampled:
        more = {name: plant.mismatch.get(name, 1.0) * factor for name in names}
        return plant.replace(mismatch={**plant.mismatch, **more})

    return changed


def _noisier(plant: Sampled, factor: float) -> Sampled:
    """`plant` with its noise, or that of motion capture, times `factor`."""
    if plant.sensors is not None:
        return plant.replace(sensors=plant.sensors.noisier(factor))
    noise = vars(plant.noise or MOTION_CAPTURE)
    return plant.replace(noise=Noise(**{name: factor * value for name, value in noise.items()}))
