"""Success when several numbers of the vehicle are wrong together: corners of their bands, and draws from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from itertools import product
from typing import Any

import numpy as np

from flypend import errors, plants, signals
from flypend.flight.ensemble import fly_many
from flypend.flight.kernels import has_kernel
from flypend.flight.metrics import wilson
from flypend.flight.request import Flight, bound_to
from flypend.flight.tasks import task_starts
from flypend.laws import AnyLaw, inverted
from flypend.model import Vehicle
from flypend.plants import AnyPlant, Sampled
from flypend.signals.waiting import result_of, threads
from flypend.studies.margins import LEAST_RATE, SEARCHES

# How far numbers of a vehicle that was weighed and measured in haste may be off: both masses, rod length, thrust.
BANDS = {"masses": 0.2, "rod length": 0.15, "thrust": 0.15}
SHARES = (1.0, 0.5, 0.25)  # of the bands, flown until every corner keeps LEAST_RATE
DRAWS = 8  # vehicles drawn from the bands; each is compiled
RUNS, SLOW_RUNS = 50, 6
DURATION = 20.0  # s


@dataclass(frozen=True)
class Wrong:
    """Flights with numbers of the vehicle that are not those which the law believes.

    Parameters
    ----------
    kind : str
        "nominal", "corner" or "draw".
    share : float
        Share of the bands that a corner is one of.
    factors : dict
        Ratio of true to believed value by name, of `BANDS`.
    successes, runs : int
        How many of how many flights succeed.
    """

    kind: str
    share: float
    factors: Mapping[str, float]
    successes: int
    runs: int

    @property
    def rate(self) -> float:
        """Share of the flights that succeed."""
        return self.successes / self.runs

    def told(self) -> str:
        """Return factors, successes and their Wilson interval, 95 %, in a line."""
        what = ", ".join(f"{name} × {factor:.3g}" for name, factor in self.factors.items())
        return f"{self.kind} {what}: {format_count(self.successes, self.runs)}"


def format_count(successes: int, runs: int) -> str:
    """Return "48 of 50 (86.5 to 98.9 %)", the Wilson interval of 95 %."""
    low, high = wilson(successes, runs)
    return f"{successes} of {runs} ({100 * low:.1f} to {100 * high:.1f} %)"


@dataclass(frozen=True)
class Joint:
    """The result of `joint`.

    Parameters
    ----------
    bands : dict
        Largest relative error by name.
    flown : tuple of Wrong
        In the order flown: nominal, corners of each share of the bands, draws.
    """

    bands: Mapping[str, float]
    flown: tuple[Wrong, ...]

    @property
    def share(self) -> float:
        """The largest share of the bands flown at which success is at least 90 % in every corner; 0 for none."""
        corners = [one for one in self.flown if one.kind == "corner"]
        kept = {one.share for one in corners} - {one.share for one in corners if one.rate < LEAST_RATE}
        return max(kept, default=0.0)

    @property
    def worst(self) -> Wrong:
        """What fails first: of the smallest share with a failing corner the worst corner, else the worst of all."""
        failing = [one for one in self.flown if one.kind == "corner" and one.rate < LEAST_RATE]
        least = min((one.share for one in failing), default=0.0)
        return min((one for one in failing if one.share == least) if failing else self.flown, key=lambda one: one.rate)

    def lines(self) -> list[str]:
        """Return the nominal vehicle, all corners and all draws, then what fails first and what to calibrate."""
        out = [one.told() for one in self.flown if one.kind == "nominal"]
        for share in dict.fromkeys(one.share for one in self.flown if one.kind == "corner"):
            some = [one for one in self.flown if one.kind == "corner" and one.share == share]
            out.append(f"{self._within(share)}, {len(some)} corners together: {_sum(some)}")
        out.append(f"draws from {self._within(1.0)}: {_sum([one for one in self.flown if one.kind == 'draw'])}")
        out.append(f"worst {self.worst.told()}")
        if self.share == 1.0:
            return [*out, "every corner keeps 90 %"]
        known = f"calibrate to {self._within(self.share)}" if self.share else f"{self._within(SHARES[-1])} is too much"
        return [*out, known]

    def _within(self, share: float) -> str:
        return ", ".join(f"{name} ±{100 * share * band:.3g} %" for name, band in self.bands.items())

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain numbers, lists and dicts."""
        rows = [asdict(one) | {"wilson": list(wilson(one.successes, one.runs))} for one in self.flown]
        return {"bands": dict(self.bands), "share": self.share, "flown": rows, "worst": self.worst.told()}


def _sum(some: list[Wrong]) -> str:
    return format_count(sum(one.successes for one in some), sum(one.runs for one in some))


def world_with(plant: Sampled, factors: Mapping[str, float]) -> Sampled:
    """Return `plant` with the vehicle's numbers of `BANDS` multiplied by `factors`."""
    ratios = {"mass": factors["masses"], "bob_mass": factors["masses"], "rod_length": factors["rod length"]}
    mismatch = {**plant.mismatch, **{name: plant.mismatch.get(name, 1.0) * ratio for name, ratio in ratios.items()}}
    strength = np.array(plant.strength) * factors["thrust"]
    return plant.replace(mismatch=mismatch, strength=strength.tolist() if strength.ndim else float(strength))


@signals.defer()
def joint(
    vehicle: Vehicle,
    law: AnyLaw | None = None,
    *,
    plant: str | AnyPlant = "rotors",
    runs: int | None = None,
    seed: int = 1,
    progress: Callable[[str, int, int], Any] = lambda *_: None,
) -> Joint:
    """Fly `vehicle` from random starts while masses, rod length and thrust are off together, each up to its band.

    Parameters
    ----------
    vehicle, law, plant
        As in `check`.
    runs : int, optional
        Flights of each wrong vehicle; default 50, and 6 where flights are slow.
    seed : int
        Seed of starts and of the vehicles drawn.
    progress : callable
        Called with `(task, done, total)`.
    """
    world = plants.as_sampled(plant)
    bound = bound_to(vehicle, inverted() if law is None else law)
    starts = task_starts(vehicle, RUNS if runs is None else errors.integer("runs", runs, 1), seed)["random"]
    flight = Flight(vehicle=vehicle, law=bound, starts=starts.seen(bound.e3), duration=DURATION, plant=world)
    if runs is None and not has_kernel(flight):
        flight = flight.replace(starts=flight.starts[:SLOW_RUNS])
    rng = np.random.default_rng(seed)
    drawn = [{name: float(1 + band * rng.uniform(-1, 1)) for name, band in BANDS.items()} for _ in range(DRAWS)]
    flown = _fly(flight, [("nominal", 0.0, dict.fromkeys(BANDS, 1.0))], progress)
    for share in SHARES:
        signs = product((1, -1), repeat=len(BANDS))
        corners = [{n: 1 + s * share * b for s, (n, b) in zip(sign, BANDS.items(), strict=True)} for sign in signs]
        found = _fly(flight, [("corner", share, factors) for factors in corners], progress)
        flown += found
        if all(one.rate >= LEAST_RATE for one in found):
            break
    flown += _fly(flight, [("draw", 1.0, factors) for factors in drawn], progress)
    return Joint(dict(BANDS), tuple(flown))


def _fly(
    flight: Flight, worlds: list[tuple[str, float, dict[str, float]]], progress: Callable[[str, int, int], Any]
) -> list[Wrong]:
    """Fly every start of `flight` in each of `worlds`: kind, share, factors."""
    kind, out = worlds[0][0], []
    workers, plant = 1 if has_kernel(flight) else None, plants.as_sampled(flight.plant)

    def fly(factors: Mapping[str, float]) -> int:
        return int(fly_many(flight.through(world_with(plant, factors)), workers=workers).success.sum())

    with threads(SEARCHES if workers else 1) as pool:
        jobs = [pool.submit(fly, factors) for *_, factors in worlds]
        for (_, share, factors), job in zip(worlds, jobs, strict=True):
            out.append(Wrong(kind, share, factors, result_of(job), flight.runs))
            progress(f"{kind} of joint errors", len(out), len(worlds))
    return out
