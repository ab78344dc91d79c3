"""`plan`: from a vehicle, a start and constraints to a `Plan`."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Unpack

from numpy.typing import ArrayLike

from flypend import errors, signals
from flypend.model import State, Vehicle
from flypend.planning.constraints import Constraints, Keywords, gathered
from flypend.planning.request import STAGES_PER_UNIT, Request, end_of, request
from flypend.planning.result import Plan
from flypend.planning.search import prepared, together
from flypend.planning.telling import told

HORIZONS = (12.5, 20.0, 32.0, 48.0)  # √(l/g), tried in turn: 3 s on hehn2011
LONGEST = 60.0  # √(l/g)


@errors.named_arguments
@signals.deferred()
def plan(
    vehicle: Vehicle,
    start: State,
    objective: str | Mapping[str, float] = "excursion",
    *,
    duration: float | None = None,
    target: ArrayLike | None = None,
    rotors: ArrayLike | None = None,
    constraints: Constraints | None = None,
    time_limit: float = 5.0,
    **keywords: Unpack[Keywords],
) -> Plan:
    """Plan a flight of `vehicle` from `start` to inverted hover at the `target`.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle parameters; its rotor limits, rotor lag and mount are constraints. As laws do, a plan takes pivot
        offset, friction of the joint, spin of the rod and air as zero.
    start : State
        A single state, e₃ up.
    objective : "excursion", "effort", "time" or dict
        What to make small: the largest distance of the pivot from target or path, the deviation of the rotor commands
        from hover, or the duration; or weights of "excursion" (of its square, in rod lengths) and "effort".
    duration : float, optional
        Time until hover, s; default 12.5 √(l/g), or longer if that is too short. The most for the objective "time".
    target : (3,)
        Where the pivot is to hover, m; default the origin, or the end of the path.
    rotors : (n,), optional
        Rotor forces at the start, N; default their minimum.
    constraints : Constraints, optional
        What the flight keeps, beside the limits of the rotors.
    time_limit : float
        Time after which the best so far is returned, s. Compiling, once per kind of constraints, does not count.
    **keywords
        Fields of `Constraints` one by one: box, floor, ceiling, speed, lean, window, waypoints, path, clearance.

    Returns
    -------
    Plan
        Also if there is none: see `Plan.status` and `Plan.reason`.

    Raises
    ------
    InputError
        If an argument is out of range, or the start breaks a constraint.
    """
    kept = gathered("plan", constraints, keywords)
    asked = request(vehicle, start, objective, end_of(kept.path, duration, target), rotors, kept)
    limit = errors.number("time_limit", time_limit, above=0, unit="s")
    horizons = horizons_of(asked, duration)
    attempts = [asked.unconstrained(), asked] if asked.constrained and not asked.structure.gates else [asked]
    if asked.leaning:
        attempts.append(replace(asked, again=True))
    for attempt in attempts:
        prepared(attempt)  # compiling takes seconds, once
    deadline = time.monotonic() + (0 if asked.begins_touching else limit)
    first = _first(attempts, horizons, deadline)
    return _shortened(asked, first, deadline) if objective == "time" and first else first


def horizons_of(asked: Request, duration: float | None) -> Sequence[float]:
    """Return the horizons to try in turn, √(l/g): the one of a `duration` (s), if that is given."""
    if duration is None:
        return HORIZONS
    unit = asked.units.time
    return (errors.number("duration", duration, above=0, at_most=LONGEST * unit, unit="s") / unit,)


def _first(attempts: Sequence[Request], horizons: Sequence[float], deadline: float) -> Plan:
    """Return the first plan that can be flown, of the `attempts` with the `horizons` in turn, else the last.

    Without constraints first: many keep the best plan anyway, and walls that it does not touch would lead past it.
    """
    for horizon in horizons:
        for attempt in attempts:
            found = _solved(attempt, horizon, deadline)
            if found or time.monotonic() > deadline:
                return found
    return found


def _shortened(asked: Request, best: Plan, deadline: float) -> Plan:
    """Return the shortest plan that bisection of the number of stages finds, from `best` on."""
    low, high = 0, len(best.commands)
    while high - low > 1 and time.monotonic() < deadline:
        middle = (low + high) // 2
        found = _solved(asked, middle / STAGES_PER_UNIT, deadline)
        if found:
            best, high = found, middle
        else:
            low = middle
    return best


def plan_within(asked: Request, horizon: float, iterations: int, rounds: Mapping[int, int]) -> Plan:
    """Return the best plan with a `horizon` (√(l/g)) that is known after so many `iterations`, whatever the clock.

    `rounds` as in `race.Race`.
    """
    return told([asked], [together(asked, horizon, math.inf, iterations, rounds)], horizon)[0]


def _solved(asked: Request, horizon: float, deadline: float) -> Plan:
    """Solve with a `horizon` (√(l/g)) from all styles of guesses, one per lane."""
    found = together(asked, horizon, deadline)
    if found.lacks and time.monotonic() >= deadline:
        found = replace(found, lacks=f"{found.lacks} within the time limit")
    return told([asked], [found], horizon)[0]
