"""`plan` and `plan_ensemble`: from a vehicle, starts and constraints to plans."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from flypend import errors, signals
from flypend.compile.llvm.stagewise import WIDTH
from flypend.errors import InputError
from flypend.flight.request import check_batch
from flypend.laws.references import sample
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.planning.constraints import Constraints, Keywords, gather
from flypend.planning.durations import HORIZONS, Search, in_time, ladder, shortest
from flypend.planning.inequalities import EFFORT
from flypend.planning.multistart import NOT_KEPT, Found, Job, count_agreeing
from flypend.planning.problem import Request, end_of, request
from flypend.planning.result import Plan, PlanEnsemble
from flypend.planning.search import Tried, finish, improve, one_by_one, plan_of, prepare, together
from flypend.signals.polling import result_of, threads

LONGEST = 60.0  # √(l/g)
# Styles of guesses in the order in which they are tried: the one that fails least, then those that find what it does
# not.
ORDER = (1, 3, 4, 5, 0, 7, 2, 6)
MORE = 2  # so many more are tried where none can be flown, before the horizon grows
CHUNK = 8 * WIDTH  # most starts that a thread takes at a time
Progress = Callable[[int, int], Any]


@errors.named_arguments
@signals.defer()
def plan(
    vehicle: Vehicle,
    start: State,
    objective: str | Mapping[str, float] = "excursion",
    *,
    duration: float | None = None,
    target: ArrayLike | State | None = None,
    rotors: ArrayLike | None = None,
    constraints: Constraints | None = None,
    time_limit: float | None = None,
    **keywords: Unpack[Keywords],
) -> Plan:
    """Plan a flight of `vehicle` from `start` to inverted hover at the `target`, or to a target state.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle parameters; its rotor limits, rotor lag and mount are constraints. Like a law, a plan neglects pivot
        offset, friction of the joint, spin of the rod, and air.
    start : State
        A single state, e₃ up.
    objective : "excursion", "effort", "time", "cost" or dict
        What to minimise: the largest distance of the pivot from target or path, the deviation of the rotor commands
        from hover, the duration, or the `cost` of the constraints alone. A dict gives weights of "excursion" (of its
        square, in rod lengths) and "effort", the larger of them about 1.
    duration : float, optional
        Time by which the vehicle hovers, s; default 12.5 √(l/g), or longer if that is too short. A plan is shorter only
        if no plan of full length is as good.
    target : (3,) or State
        Where the pivot should hover, m; default the origin, or the end of the path. Or a single state to end in, e₃ up:
        hanging, `State(y=(0, 0, -1))`, or in motion. The heading of that state does not matter.
    rotors : (n,), optional
        Rotor forces at the start, N; default their minimum.
    constraints : Constraints, optional
        Constraints on the flight, besides the limits of the rotors.
    time_limit : float, optional
        Processor time after which the best plan so far is returned, s; `reason` then says so. Default none: the number
        of iterations is limited anyway, so that a plan does not depend on the machine. The time to compile, once per
        kind of constraints, does not count.
    **keywords
        Fields of `Constraints` one by one: box, floor, ceiling, speed, lean, window, waypoints, path,
        clearance, keep, cost.

    Returns
    -------
    Plan
        Returned even if no plan was found: see `Plan.status` and `Plan.reason`.

    Raises
    ------
    InputError
        If an argument is out of range, or the start breaks a constraint.
    """
    kept = gather("plan", constraints, keywords)
    asked = request(vehicle, start, objective, end_of(kept.path, duration, target, objective), rotors, kept)
    limit = math.inf if time_limit is None else errors.number("time_limit", time_limit, above=0, unit="s")
    longest = horizon_of(asked, duration)
    timed = objective == "time"
    # Without constraints first: many keep the best plan anyway, and walls that it does not touch would lead past it.
    free = asked.constrained and not asked.structure.gates and not timed
    attempts = [asked.without_constraints(), asked] if free else [asked]
    if asked.leaning:
        attempts.append(replace(asked, again=True))
    for attempt in attempts:
        prepare(attempt)  # compiling takes seconds, once
    if asked.begins_touching:
        return plan_within(asked, longest or HORIZONS[0], 0, {})
    search = Search(attempts, time.thread_time() + limit)
    if timed:
        return shortest(search, ladder(None, asked), longest)
    return in_time(search, ladder(longest, asked), longest or HORIZONS[0])


def horizon_of(asked: Request, duration: float | None) -> float | None:
    """Return a `duration` (s), if it is given, in √(l/g). Raises InputError."""
    if duration is None:
        return None
    return errors.number("duration", duration, above=0, at_most=LONGEST * asked.units.time, unit="s") / asked.units.time


def plan_within(
    asked: Request, horizon: float, iterations: int, rounds: Mapping[int, int], otherwise: Constraints | None = None
) -> Plan:
    """Return the best plan with a `horizon` (√(l/g)) that is known after so many `iterations`, whatever the clock.

    `rounds` as in `Race`. With constraints there are two races, the second of which does not know of them. If no plan
    keeps them, one that keeps `otherwise` will do, if that is given: of each race the one that breaks least.
    """
    found = [together(asked, horizon, math.inf, iterations, rounds)]
    if asked.kept.loose:
        found.append(together(asked.without_constraints(), horizon, math.inf, iterations, rounds, kept=asked))
    tries = [Tried.of(asked, each, horizon) for each in found]
    if not any(tries) and otherwise is not None:
        found = [replace(each, lacks="" if each.lacks == NOT_KEPT else each.lacks) for each in found]
        tries = [Tried.of(replace(asked, kept=otherwise), each, horizon) for each in found]
    return min(tries, key=Tried.rank).plan


@errors.named_arguments
@signals.defer()
def plan_ensemble(
    vehicle: Vehicle,
    starts: State,
    objective: str | Mapping[str, float] = "excursion",
    *,
    duration: float | None = None,
    target: ArrayLike | State | None = None,
    rotors: ArrayLike | None = None,
    constraints: Constraints | None = None,
    guesses: int = 2,
    workers: int | None = None,
    progress: Progress = lambda *_: None,
    **keywords: Unpack[Keywords],
) -> PlanEnsemble:
    """Plan flights of `vehicle` from each of `starts`, eight guesses at a time.

    Plan i depends on start i alone, not on the rest of the batch or the number of cores.

    Parameters
    ----------
    vehicle, duration, target, rotors, constraints, **keywords
        As in `plan`.
    starts : State
        A batch of states with one leading axis, e₃ up.
    objective : "excursion", "effort" or dict
        As in `plan`, except "time".
    guesses : int
        Number of guesses for each plan, up to 8; the best result is taken. `plan` uses 8 for each horizon that it
        tries. Where none leads to a plan, two more are tried before the duration grows.
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
    kept = gather("plan_ensemble", constraints, keywords)
    goal = end_of(kept.path, duration, target)
    asked = [request(vehicle, starts[i], objective, goal, rotors, kept) for i in range(len(starts))]
    longest = horizon_of(asked[0], duration)
    horizons = HORIZONS if longest is None else (longest,)
    prepare(asked[0])  # compiling takes seconds, once
    share = min(CHUNK, WIDTH * -(-len(asked) // (WIDTH * cores)))
    parts = [asked[i : i + share] for i in range(0, len(asked), share)]
    plans: list[Plan] = []
    with threads(cores) as pool:
        for call in [pool.submit(_plan_each, part, horizons, first) for part in parts]:
            some = result_of(call)
            plans += some
            progress(len(plans), len(asked))
    return PlanEnsemble(tuple(plans))


def _plan_each(asked: Sequence[Request], horizons: Sequence[float], guesses: int) -> list[Plan]:
    """Return a plan for each request: with the first of `horizons` and the first styles that find one."""
    best: dict[int, Tried] = {}
    spent = np.zeros(len(asked))
    costs: list[list[float]] = [[] for _ in asked]  # of the guesses with the last horizon, infinite for those that fail
    for horizon in horizons:
        left = [i for i in range(len(asked)) if not best.get(i)]
        for i in left:
            costs[i] = []
        for tried, style in enumerate(ORDER[: guesses + MORE]):
            open_ = [i for i in left if tried < guesses or not best.get(i)]
            if not open_:
                break
            for i, each in zip(open_, _solve([Job(asked[i], style) for i in open_], horizon), strict=True):
                spent[i] += each.found.spent
                costs[i].append(each.found.cost if each else np.inf)
                best[i] = min(best.get(i, each), each, key=Tried.rank)
        flown = [i for i in left if best[i]]
        jobs, before = [best[i].job for i in flown], [best[i].found for i in flown]
        for i, each in zip(flown, _solve(jobs, horizon, before), strict=True):
            spent[i] += each.found.spent
            best[i] = best[i].better_of(each)
    return [
        replace(best[i].plan, solve_time=float(spent[i]), guesses=len(costs[i]), agreeing=count_agreeing(costs[i]))
        for i in range(len(asked))
    ]


def _solve(jobs: Sequence[Job], horizon: float, before: Sequence[Found] | None = None) -> list[Tried]:
    """Return what comes of each of `jobs`; see `one_by_one`."""
    found = one_by_one(jobs, horizon, before) if jobs else []
    return [Tried.of(job.asked, each, horizon) for job, each in zip(jobs, found, strict=True)]


def coarsen(plan: Plan, many: int) -> tuple[Plan, Request]:
    """Return `plan` solved again with stages `many` times as long, and the request that it answers.

    For a computer with little time and memory. Raises InputError if it failed, does not end in inverted hover, has a
    path, windows or a mount that limits the rod, or cannot be flown in such stages. Constraints that a plan does not
    tell of, such as a box, are not kept.
    """
    if not isinstance(plan, Plan) or not plan:
        raise InputError("plan", "a plan that can be flown", getattr(plan, "reason", "") or repr(plan)[:80])
    if plan.path is not None or plan.windows or plan.vehicle.mount != "gimbal":
        raise InputError("plan", "one without path and windows, on a gimbal", f"{plan!r}")
    start, per_stage = State.trusted(plan.packed[0]), (len(plan.t) - 1) // len(plan.commands)
    rotors = np.clip(plan.rotor_forces[0], *plan.vehicle.rotor_limits)
    (target,) = sample(plan.reference, np.array([plan.duration]))
    asked = request(plan.vehicle, start, plan.objective, target, rotors)
    asked.numbers[EFFORT] *= many  # a stage lasts so much longer
    stages, n = math.ceil(len(plan.commands) / many), asked.rotors
    hover, left = asked.rest, stages * many - len(plan.commands)
    packed = np.column_stack([plan.packed, plan.rotor_forces])[::per_stage]
    packed[:, :3] -= plan.target
    states = np.concatenate([packed / asked.units.states(n), np.tile(hover, (left, 1))])[::many]
    commands = np.concatenate([plan.commands / asked.units.force, np.tile(hover[SIZE:], (left, 1))])
    commands = commands.reshape(stages, many, n).mean(axis=1)
    horizon, job = stages * many * plan.stage / asked.units.time, Job(asked, plan.guess)
    found = finish(job, horizon, improve(job, horizon, (states, commands), math.inf), math.inf)
    coarse = plan_of(asked, found, horizon)
    if not coarse:
        raise InputError("plan", f"one that can be flown in {stages} stages", coarse.reason)
    return coarse, asked
