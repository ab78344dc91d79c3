"""`plan` and `plan_ensemble`: from a vehicle, starts and constraints to plans."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from flypend import errors, signals
from flypend.compile.llvm.stagewise import WIDTH, Stagewise, stagewise
from flypend.errors import InputError
from flypend.flight.request import check_batch
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.planning.constraints import Constraints, Keywords, begins_touching, broken, gathered
from flypend.planning.dynamics import Stage
from flypend.planning.files import Status
from flypend.planning.problem import STAGES_PER_UNIT, Request, end_of, request
from flypend.planning.result import Plan, PlanEnsemble
from flypend.planning.search import Found, Job, agreeing, one_by_one, prepared, stages_of, together
from flypend.plants.lag import step_timing
from flypend.signals.waiting import result_of, threads

HORIZONS = (12.5, 20.0, 32.0, 48.0)  # √(l/g), tried in turn: 3 s on hehn2011
LONGEST = 60.0  # √(l/g)
DENSE = 4  # samples per stage
# Styles of guesses in the order in which they are tried: the one that fails least, then those that find what it does
# not.
ORDER = (1, 3, 4, 5, 0, 7, 2, 6)
MORE = 2  # so many more are tried where none can be flown, before the horizon grows
CHUNK = 8 * WIDTH  # most starts that a thread takes at a time
Progress = Callable[[int, int], Any]


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
        Processor time after which the best so far is returned, s: a busy machine takes longer to reach the same plan.
        Compiling, once per kind of constraints, does not count.
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
    deadline = time.thread_time() + (0 if asked.begins_touching else limit)
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
            if found or time.thread_time() > deadline:
                return found
    return found


def _shortened(asked: Request, best: Plan, deadline: float) -> Plan:
    """Return the shortest plan that bisection of the number of stages finds, from `best` on."""
    low, high = 0, len(best.commands)
    while high - low > 1 and time.thread_time() < deadline:
        middle = (low + high) // 2
        found = _solved(asked, middle / STAGES_PER_UNIT, deadline)
        if found:
            best, high = found, middle
        else:
            low = middle
    return best


def plan_within(asked: Request, horizon: float, iterations: int, rounds: Mapping[int, int]) -> Plan:
    """Return the best plan with a `horizon` (√(l/g)) that is known after so many `iterations`, whatever the clock.

    `rounds` as in `search.Race`.
    """
    return told([asked], [together(asked, horizon, math.inf, iterations, rounds)], horizon)[0]


def _solved(asked: Request, horizon: float, deadline: float) -> Plan:
    """Solve with a `horizon` (√(l/g)) from all styles of guesses, one per lane."""
    found = together(asked, horizon, deadline)
    if found.lacks and time.thread_time() >= deadline:
        found = replace(found, lacks=f"{found.lacks} within the time limit")
    return told([asked], [found], horizon)[0]


def told(asked: Sequence[Request], found: Sequence[Found], horizon: float) -> list[Plan]:
    """Return a plan with its verdict for each request `asked` and what was `found` with the `horizon`."""
    h = stages_of(horizon)[1] / DENSE
    return [_plan(each, what, _dense(each, what, h), horizon) for each, what in zip(asked, found, strict=True)]


def _dense(asked: Request, found: Found, h: float) -> Any:
    """Return states (DENSE stages + 1, 24 + n), own units, at equal times, by steps of length `h` in each stage."""
    stages, width = len(found.commands), found.states.shape[1]
    after, commands = np.empty((stages, width)), np.ascontiguousarray(found.commands)
    timing = np.array(step_timing(asked.vehicle.rotor_lag / asked.units.time, h))
    numbers, step, parts = asked.units.numbers(asked.vehicle), _step(asked.rotors), [found.states[:-1]]
    for _ in range(DENSE - 1):
        step(stages, np.ascontiguousarray(parts[-1]), commands, timing, numbers, after)
        parts.append(after.copy())
    return np.concatenate([np.stack(parts, axis=1).reshape(-1, width), found.states[-1:]])


@lru_cache(maxsize=4)
def _step(rotors: int) -> Stagewise:
    return stagewise(Stage(rotors).step(), shared=(2, 3), abreast=True)


def _plan(asked: Request, found: Found, own: Any, horizon: float) -> Plan:
    """Return the plan with the states `own` (n, 24 + k) in own units about the target."""
    units, stage = asked.units, stages_of(horizon)[1] * asked.units.time
    dense = own * units.states(asked.rotors)
    dense[:, :3] += asked.target
    packed, forces = dense[:, :SIZE], dense[:, SIZE:]
    lacks = begins_touching(packed, forces, asked.vehicle) or found.lacks
    lacks = lacks or broken(packed, forces, asked.vehicle, asked.kept)
    status: Status = "failed" if lacks else "feasible" if found.unfinished else "converged"
    return Plan(
        vehicle=asked.vehicle, objective=asked.objective, target=asked.target, path=asked.kept.path,
        windows=asked.kept.windows,
        t=np.arange(len(dense), dtype=float) * float(stage / DENSE), packed=packed, rotor_forces=forces,
        commands=found.commands * units.force, stage=stage, status=status, reason=lacks or found.unfinished,
        solve_time=found.spent, iterations=found.iterations, guess=found.style, guesses=found.guesses,
        agreeing=0 if lacks else found.agreeing,
    )  # fmt: skip


@errors.named_arguments
@signals.deferred()
def plan_ensemble(
    vehicle: Vehicle,
    starts: State,
    objective: str | Mapping[str, float] = "excursion",
    *,
    duration: float | None = None,
    target: ArrayLike | None = None,
    rotors: ArrayLike | None = None,
    constraints: Constraints | None = None,
    guesses: int = 2,
    workers: int | None = None,
    progress: Progress = lambda *_: None,
    **keywords: Unpack[Keywords],
) -> PlanEnsemble:
    """Plan flights of `vehicle` from each of `starts`, each guess on a lane of its own.

    Plan i depends on start i alone, whatever else is in the batch and on however many cores.

    Parameters
    ----------
    vehicle, duration, target, rotors, constraints, **keywords
        As in `plan`.
    starts : State
        A batch of states with one leading axis, e₃ up.
    objective : "excursion", "effort" or dict
        As in `plan`, except "time".
    guesses : int
        From how many guesses, up to 8, the best plan is taken. `plan` takes 8. Two more are tried where none is found,
        before the duration grows.
    workers : int, optional
        Number of threads; default one per core.
    progress : callable
        Called with `(done, total)`.

    Raises
    ------
    InputError
        If an argument is out of range, or a start breaks a constraint.
    """
    check_batch(starts)
    if objective == "time":
        raise InputError("objective", "one that a single solve finds: excursion, effort or weights", "'time'")
    first = errors.integer("guesses", guesses, 1, WIDTH)
    cores = errors.integer("workers", os.cpu_count() or 1 if workers is None else workers, 1)
    kept = gathered("plan_ensemble", constraints, keywords)
    goal = end_of(kept.path, duration, target)
    asked = [request(vehicle, starts[i], objective, goal, rotors, kept) for i in range(len(starts))]
    horizons = horizons_of(asked[0], duration)
    prepared(asked[0])  # compiling takes seconds, once
    share = min(CHUNK, WIDTH * -(-len(asked) // (WIDTH * cores)))
    parts = [asked[i : i + share] for i in range(0, len(asked), share)]
    plans: list[Plan] = []
    with threads(cores) as pool:
        for call in [pool.submit(_planned, part, horizons, first) for part in parts]:
            some = result_of(call)
            plans += some
            progress(len(plans), len(asked))
    return PlanEnsemble(tuple(plans))


def _planned(asked: Sequence[Request], horizons: Sequence[float], guesses: int) -> list[Plan]:
    """Return a plan for each request: with the first of `horizons` and the first styles that find one."""
    best: list[tuple[bool, float, Plan] | None] = [None] * len(asked)  # whether it failed, its cost, and the plan
    spent = np.zeros(len(asked))
    costs: list[list[float]] = [[] for _ in asked]  # of the guesses with the last horizon, infinite for those that fail
    for horizon in horizons:
        left = [i for i, each in enumerate(best) if _failed(each)]
        for i in left:
            costs[i] = []
        for tried, style in enumerate(ORDER[: guesses + MORE]):
            open_ = [i for i in left if tried < guesses or _failed(best[i])]
            if not open_:
                break
            found = one_by_one([Job(asked[i], style) for i in open_], horizon)
            plans = told([asked[i] for i in open_], found, horizon)
            for i, each, plan in zip(open_, found, plans, strict=True):
                spent[i] += each.spent
                costs[i].append(each.cost if plan else np.inf)
                kept = best[i]
                if kept is None or (not plan, each.cost) < kept[:2]:
                    best[i] = not plan, each.cost, plan
    return [
        replace(each[2], solve_time=float(used), guesses=len(tried), agreeing=agreeing(np.array(tried)))
        for each, used, tried in zip(best, spent, costs, strict=True)
        if each is not None
    ]


def _failed(kept: tuple[bool, float, Plan] | None) -> bool:
    """Whether there is no plan yet that can be flown."""
    return kept is None or kept[0]
