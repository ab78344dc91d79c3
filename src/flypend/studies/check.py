"""What a vehicle can do under a law, and how wrong its numbers may be before it cannot: `flypend check`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from functools import partial
from typing import Any

import numpy as np

from flypend import errors, plants, signals
from flypend.errors import InputError
from flypend.flight.criterion import Criterion
from flypend.flight.ensemble import Ensemble
from flypend.flight.feasibility import Feasibility, feasibility
from flypend.flight.request import Flight, bound_to
from flypend.flight.tasks import LEAST_RATE, fly_tasks, task_starts
from flypend.laws import AnyLaw, BoundLaw, inverted
from flypend.laws.law_error import LawError
from flypend.model import State, Vehicle
from flypend.planning.planner import plan_ensemble
from flypend.planning.result import PlanEnsemble
from flypend.plants import AnyPlant, Sampled
from flypend.plants.bands import check_bands
from flypend.plants.tremor import too_noisy
from flypend.studies.bands import fly_within
from flypend.studies.compare import Progress, summary
from flypend.studies.margins import Margin, quantities, search

# Random flights, directions of the other tasks, and seconds a flight: usually, and where flights take long, in MuJoCo
# and for a law that is stepped in Python. And how many flights each value of a margin takes.
USUAL, SLOW = (1000, 12, 30.0), (24, 3, 10.0)
MARGIN_RUNS, SLOW_MARGIN_RUNS = 200, 12
MOST_RUNS = 1_000_000  # minutes of flights; a sweep can be stopped and resumed
GRADES = ("all", "most", "some", "none")  # of the starts of a task succeed; most: at least 90 %
STARTS = 8  # of the random ones, to plan from where a law fails
HARDLY_ANY = 0.1  # share of them
LEAST_DURATION = 10.0  # s, of a flight for a margin, or twice what 95 % need to settle if that is more


@dataclass(frozen=True)
class Catch:
    """Leans at rest that are caught directly: the rod is never below the horizon of its pivot.

    Parameters
    ----------
    lean : float
        The largest lean up to which every one is caught, whatever its direction, rad; 0 for none.
    excursion : float
        Largest distance from the reference while it is caught, m; NaN for none.
    swung : int
        Leans, of all, that end upright after the rod was below the horizon.
    """

    lean: float
    excursion: float
    swung: int


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Check:
    """The result of `check`.

    Parameters
    ----------
    vehicle, plant
        What flew, and through which plant.
    law : str
        Name of the law.
    feasibility : Feasibility
        What the vehicle's numbers allow, whatever the law.
    tasks : dict of Ensemble
        Flights of each task: see `flypend.flight.tasks.TASKS`, and with bands "drawn". Empty without flights.
    catch : Catch, optional
        Leans that are caught directly.
    margins : dict of Margin
        By name: delay, rotor lag, rod length, mass and noise. Empty if they were not searched.
    reasons : tuple of str
        Why the vehicle cannot be flown by this law: its numbers forbid it, the law refuses it, or hover fails. Empty if
        it can be flown.
    warnings : tuple of str
        What leaves little margin, and in which tasks flights fail.
    plans : PlanEnsemble, optional
        Plans from some of the random starts, if the law fails: they show what the vehicle could do.
    """

    vehicle: Vehicle
    plant: Sampled
    law: str
    feasibility: Feasibility
    tasks: Mapping[str, Ensemble] = field(default_factory=dict)
    catch: Catch | None = None
    margins: Mapping[str, Margin] = field(default_factory=dict)
    reasons: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    plans: PlanEnsemble | None = None

    @property
    def possible(self) -> str:
        """What the plans say, in a sentence; empty without plans."""
        return "" if self.plans is None else describe_plans(self.plans, self.law)

    @property
    def ok(self) -> bool:
        """Whether the law hovers with the vehicle. What else it can do is the `envelope`."""
        return not self.reasons

    @property
    def envelope(self) -> dict[str, str]:
        """One of `GRADES` for each task that was flown: from how many of its starts flights succeed."""
        return {name: grade(ensemble.rate) for name, ensemble in self.tasks.items()}

    def verdict(self, law: str = "") -> str:
        """Return in a line whether the law, here called `law`, can fly the vehicle, and the grade of each task."""
        machine, can = f"{self.vehicle.name} on a {self.vehicle.mount}", "can" if self.ok else "cannot"
        sentence = f"{machine} {can} be flown by {law or self.law}"
        graded = [f"{name} {found}" for name, found in self.envelope.items() if name != "hover"]
        return f"{sentence}: {', '.join(graded)}." if self.ok and graded else f"{sentence}."

    def __repr__(self) -> str:
        """Return verdict, tasks and margins, a line each."""
        lines = [f"<Check of {self.law} on {self.vehicle.name}: {'can' if self.ok else 'cannot'} be flown"]
        lines += [f"  {line}" for line in (*self.reasons, *self.warnings, self.possible) if line]
        for name, row in self.rows().items():
            lines.append(
                f"  {name:7} {self.envelope[name]}: {self.tasks[name].count.describe()}, "
                f"excursion {row['excursion_p50']:.3g}/{row['excursion_p95']:.3g} m"
            )
        if (catch := self.catch) is not None:
            reach = f"up to {np.degrees(catch.lean):.0f}°, excursion {catch.excursion:.3g} m"
            lines.append(f"  leans caught directly: {reach if catch.lean else 'none'}")
        lines += [f"  {name}: {margin.describe()}" for name, margin in self.margins.items()]
        return "\n".join(lines) + ">"

    def rows(self) -> dict[str, dict[str, Any]]:
        """Return success with its Wilson interval, settling, excursion, clearance and causes of failure, by task."""
        return {name: summary(ensemble) for name, ensemble in self.tasks.items()}

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the single flights as plain numbers, lists and dicts."""
        return {
            "vehicle": self.vehicle.to_dict(),
            "law": self.law,
            "ok": self.ok,
            "envelope": self.envelope,
            "reasons": list(self.reasons),
            "warnings": list(self.warnings),
            "possible": self.possible,
            "feasibility": asdict(self.feasibility),
            "tasks": self.rows(),
            "catch": None if self.catch is None else asdict(self.catch),
            "margins": {name: asdict(margin) for name, margin in self.margins.items()},
        }


@errors.named_arguments
@signals.defer()
def check(
    vehicle: Vehicle,
    law: AnyLaw | None = None,
    *,
    plant: str | AnyPlant = "rotors",
    runs: int | None = None,
    seed: int = 1,
    duration: float | None = None,
    margins: bool | None = None,
    bands: bool = False,
    workers: int | None = None,
    progress: Progress = lambda *_: None,
) -> Check:
    """Find out whether `law` can fly `vehicle`, how well, and how wrong its model of the vehicle may be.

    The tasks are hover, leans at rest, a swing-up from hanging, level and random starts. Then come the margins of
    delay, rotor lag, rod length, mass and noise: how far each may change, unknown to the law, before success from
    random starts drops below 90 %.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle, with its mount.
    law : Law or Controller, optional
        The law; default the inverted law.
    plant : str or Plant
        The sampled plant to fly through.
    runs : int, optional
        Random starts; default 1000, or 24 in MuJoCo and for a law that is stepped in Python.
    seed : int
        Seed of the random starts.
    duration : float
        Seconds per flight; default 30, or 10 where there are only 24 random starts.
    margins : bool, optional
        Whether to search for margins; default where there are 1000 random starts.
    bands : bool
        Whether to fly the random starts again as the task "drawn", with vehicles drawn from the bands of `vehicle`.
    workers : int, optional
        As in `simulate_ensemble`.
    progress : callable
        Called with `(what, done, total)`.

    Raises
    ------
    InputError
        If the plant is ideal, which has no margins; if the code of a law of your own fails; if a number is out of
        range; or with `bands`, if the vehicle has none. A vehicle that cannot be flown is a result, not an error.
    """
    world = plants.as_sampled(plant)
    if bands:
        check_bands(vehicle)
    chosen = law if law is not None else inverted()
    found = feasibility(world.true_vehicle(vehicle), world.delay)
    name = chosen.name
    about: dict[str, Any] = {"vehicle": vehicle, "plant": world, "law": name, "feasibility": found}
    if found.impossible and (world.limits or vehicle.weight == 0):
        return Check(**about, reasons=found.impossible)
    try:
        bound = bound_to(vehicle, chosen)
    except LawError:
        raise
    except InputError as error:
        refusal = f"the {name} law refuses the vehicle: {error}"
        some = task_starts(vehicle, STARTS, seed)["random"]
        plans = plan_some(world.true_vehicle(vehicle), some, workers, progress)
        return Check(**about, reasons=(*found.doubtful, refusal), plans=plans)
    quick = isinstance(bound, BoundLaw) and world.engine == "equations"
    usual, directions, long = USUAL if quick else SLOW
    seconds = long if duration is None else errors.number("duration", duration, at_least=Criterion().hold, unit="s")
    starts = task_starts(
        vehicle, usual if runs is None else errors.integer("runs", runs, 1, MOST_RUNS), seed, directions
    )
    tasks = fly_tasks(vehicle, bound, world, starts, seconds, workers=workers, progress=progress)
    random = Flight(
        vehicle=vehicle, law=bound, starts=starts["random"].in_frame(bound.e3), duration=seconds, plant=world
    )
    if bands:
        tasks["drawn"] = fly_within(random, seed, workers, partial(progress, "drawn"))
    reasons, shortfalls = _shortfalls(tasks)
    about |= {"tasks": tasks, "catch": caught(tasks["lean"], directions)}
    if (quick if margins is None else margins) and tasks["random"].rate >= LEAST_RATE:
        enough = max(LEAST_DURATION, 2 * tasks["random"].percentile("settling", 95))
        some = random.starts[: MARGIN_RUNS if quick else SLOW_MARGIN_RUNS]
        few = random.replace(starts=some, duration=float(min(seconds, enough)))
        about["margins"] = search(few, quantities(vehicle, world), progress)
    if (reasons or shortfalls) and world.limits:
        about["plans"] = plan_some(world.true_vehicle(vehicle), starts["random"], workers, progress)
    trembles = too_noisy(bound, world) if isinstance(bound, BoundLaw) else ""
    notes = (*shortfalls, *[trembles] * bool(trembles), *found.doubtful)
    return Check(**about, reasons=(*reasons, *notes)) if reasons else Check(**about, warnings=notes)


def plan_some(vehicle: Vehicle, starts: State, workers: int | None, progress: Progress) -> PlanEnsemble | None:
    """Return plans from the first of `starts`, whatever the law; None for a vehicle that the planner refuses."""
    try:
        return plan_ensemble(vehicle, starts[:STARTS], workers=workers, progress=partial(progress, "planning"))
    except InputError:
        return None


def describe_plans(plans: PlanEnsemble, law: str) -> str:
    """Return in a sentence what the `plans` say about a vehicle on which the `law` fails."""
    count, share = int(plans.success.sum()), float(plans.success.mean())
    found = f"plans reach inverted hover from {count} of {len(plans)} random starts"
    if share >= LEAST_RATE:
        return f"{found}: the limit is the {law} law's, not the vehicle's"
    if share <= HARDLY_ANY:
        return f"{found}: the limit may be the vehicle's, not the {law} law's"
    return f"{found}: this vehicle can be inverted from some"


def grade(rate: float) -> str:
    """Return which of `GRADES` a success rate is."""
    return GRADES[0] if rate == 1 else GRADES[1] if rate >= LEAST_RATE else GRADES[2] if rate > 0 else GRADES[3]


def caught(leans: Ensemble, directions: int) -> Catch:
    """Return which of the flights of the task "lean", in `directions` of each lean, are catches."""
    assert leans.samples is not None
    up = 1.0 if leans.e3 == "up" else -1.0
    low = np.nanmin(up * leans.samples.y[..., 2], axis=1)
    direct = (leans.success & (low > 0)).reshape(-1, directions)
    count = int(np.argmin([*direct.all(axis=1), False]))
    angles = np.arccos(np.clip(up * leans.starts.y[::directions, 2], -1, 1))
    excursion = leans.excursion.reshape(-1, directions)[:count]
    return Catch(
        lean=float(angles[count - 1]) if count else 0.0,
        excursion=float(excursion.max()) if count else float("nan"),
        swung=int(np.sum(leans.success & (low <= 0))),
    )


def _shortfalls(tasks: Mapping[str, Ensemble]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Why hover fails, and in which other tasks fewer than 90 % succeed; each empty if there is nothing to report."""
    lines = {}
    for name, ensemble in tasks.items():
        if ensemble.rate < {"hover": 1.0, "lean": 0.0}.get(name, LEAST_RATE):
            causes = ", ".join(f"{cause} {count}" for cause, count in summary(ensemble)["causes"].items())
            lines[name] = f"{name}: {int(ensemble.success.sum())} of {len(ensemble)} succeed ({causes})"
    hover = lines.pop("hover", None)
    return (() if hover is None else (hover,)), tuple(lines.values())
