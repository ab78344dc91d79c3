"""`plan`: from a vehicle, a start and wishes to a `Plan`."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors
from flypend.compile.llvm.stagewise import Stagewise, lanes
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.planning.check import broken
from flypend.planning.guesses import pumping, styles
from flypend.planning.kernels import Kernels, kernels
from flypend.planning.request import STAGES_PER_UNIT, TOLERANCE, Request, request, walls_of
from flypend.planning.result import Plan, Status
from flypend.planning.solver import Problem, Solver
from flypend.plants.lag import step_timing

HORIZONS = (12.5, 20.0, 32.0, 48.0)  # √(l/g), tried in turn: 3 s on hehn2011
LONGEST = 60.0  # √(l/g)
MOST_ITERATIONS = 80
DENSE = 4  # samples per stage
# Converged: at so small a barrier, the best cost has changed by less than this share in so many iterations.
STEADY, STEADY_FOR, STEADY_BARRIER = 0.01, 4, 3e-5
MOUNT_FIRST, MOUNT_GROWTH, MOUNT_LAST = 1e-4, 2.0, 10.0
NOT_REACHED, NOT_KEPT = "inverted hover is not reached", "a wish is not kept"
CLOSED = 1e-6  # largest sum of all gaps, own units, of a plan that can be flown


def plan(
    vehicle: Vehicle,
    start: State,
    objective: str | Mapping[str, float] = "excursion",
    *,
    duration: float | None = None,
    target: ArrayLike = (0.0, 0.0, 0.0),
    rotors: ArrayLike | None = None,
    box: ArrayLike | None = None,
    floor: float | None = None,
    ceiling: float | None = None,
    speed: float | None = None,
    lean: float | None = None,
    clearance: float = 0.01,
    time_limit: float = 5.0,
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
        What to make small: the largest distance of the pivot from the target, the deviation of the rotor commands from
        hover, or the duration; or weights of "excursion" (of its square, in rod lengths) and "effort".
    duration : float, optional
        Time until hover, s; default 12.5 √(l/g), or longer if that is too short. The most for the objective "time".
    target : (3,)
        Where the pivot is to hover, m.
    rotors : (n,), optional
        Rotor forces at the start, N; default their minimum.
    box : (2, 3), optional
        Lowest and highest corner of a box that pivot and rod stay in, m; infinite entries for no wall.
    floor, ceiling : float, optional
        Lowest and highest height of pivot and rod, m.
    speed : float, optional
        Largest speed of the pivot, m/s.
    lean : float, optional
        Largest angle between the rod and the vertical, rad: π/2 keeps it above the horizon.
    clearance : float
        Distance that the rod of a hub or cup keeps from what it can touch, m.
    time_limit : float
        Time after which the best so far is returned, s. Compiling, once per kind of wishes, does not count.

    Returns
    -------
    Plan
        Also if there is none: see `Plan.status` and `Plan.reason`.

    Raises
    ------
    InputError
        If an argument is out of range, or the start breaks a wish.
    """
    asked = request(vehicle, start, objective, target, rotors, walls_of(box, floor, ceiling), speed, lean, clearance)
    limit = errors.number("time_limit", time_limit, above=0, unit="s")
    horizons: Sequence[float] = HORIZONS
    if duration is not None:
        time_unit = asked.units.time
        horizons = [errors.number("duration", duration, above=0, at_most=LONGEST * time_unit, unit="s") / time_unit]
    kernels(asked.rotors, asked.wishes), pumping(asked.rotors)  # compiling takes seconds, once
    deadline = time.monotonic() + limit
    first = _first(asked, horizons, deadline)
    return _shortened(asked, first, deadline) if objective == "time" and first else first


def _first(asked: Request, horizons: Sequence[float], deadline: float) -> Plan:
    """Return the first plan that can be flown with the `horizons` in turn, else the last."""
    for horizon in horizons:
        found = _solved(asked, horizon, deadline)
        if found or time.monotonic() > deadline:
            break
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


def _solved(asked: Request, horizon: float, deadline: float) -> Plan:
    """Solve with a `horizon` (√(l/g)) from all styles of guesses, one per lane."""
    compiled, guess = kernels(asked.rotors, asked.wishes), pumping(asked.rotors)
    begin = time.process_time()
    stages = max(2, round(horizon * STAGES_PER_UNIT))
    solver = Solver(compiled, *_guessed(asked, guess, stages, horizon / stages))
    best, steady, iterations, kept = np.inf, 0, 0, None
    while iterations < MOST_ITERATIONS and steady < STEADY_FOR and not solver.stuck and time.monotonic() < deadline:
        if asked.wishes.mounted is not None:
            weight = MOUNT_FIRST * MOUNT_GROWTH**iterations
            solver.insist(-2, min(MOUNT_LAST, weight))
            best = best if weight > MOUNT_LAST else np.inf  # costs under other weights do not compare
        solver.improve()
        iterations += 1
        score, lane, lacks = _judged(solver, asked)
        settled = np.isfinite(best) and score > (1 - STEADY) * best and solver.barrier[lane] <= STEADY_BARRIER
        steady = steady + 1 if settled else 0
        if kept is None or not score > best:
            kept = solver.states[:, :, lane].copy(), solver.commands[:, :, lane].copy(), lane, lacks
        best = min(best, score)
    took = time.process_time() - begin
    if kept is None:
        kept = solver.states[:, :, 0], solver.commands[:, :, 0], 0, NOT_REACHED
    states, commands, lane, lacks = kept
    if lacks and time.monotonic() >= deadline:
        lacks += " within the time limit"
    unfinished = "" if steady >= STEADY_FOR else "the solver had not converged"
    dense = _dense(asked, compiled, states, commands, horizon / stages / DENSE)
    return _told(asked, dense, commands, horizon / stages, lacks, unfinished, took, iterations, lane)


def _judged(solver: Solver, asked: Request) -> tuple[float, int, str]:
    """Return cost and lane of the best that can be flown; else infinity, the nearest lane, and what it lacks."""
    ends, closed, kept = solver.end <= 1, solver.gap <= CLOSED, solver.violation <= TOLERANCE
    cost = asked.objective["excursion"] * solver.excursion**2 + solver.effort
    if asked.wishes.mounted is not None:
        cost = solver.cost  # with what it costs to be near a part
    flyable = ends & closed & kept & np.isfinite(cost)
    if np.any(flyable):
        lane = int(np.argmin(np.where(flyable, cost, np.inf)))
        return float(cost[lane]), lane, ""
    lacks = np.maximum(solver.end, 1) + solver.violation / TOLERANCE + solver.gap / CLOSED
    lane = int(np.argmin(np.where(np.isfinite(lacks), lacks, np.inf)))
    wish = ends[lane] and closed[lane]
    return np.inf, lane, NOT_KEPT if wish else NOT_REACHED


def _same(values: Any) -> NDArray[np.float64]:
    """Return `values` (k,), the same in all lanes."""
    array = lanes(len(values))
    array[:] = np.reshape(values, (len(values), -1))
    return array


def _guessed(asked: Request, guess: Stagewise, stages: int, h: float) -> tuple[Problem, Any, Any]:
    """Return the problem with stages of length `h`, and the guessed states and commands of all lanes."""
    vehicle, units, n = asked.vehicle, asked.units, asked.rotors
    timing = _same(step_timing(vehicle.rotor_lag / units.time, h))
    problem = Problem(stages, timing, _same(units.numbers(vehicle)), _same(asked.numbers))
    states, commands = lanes(stages + 1, SIZE + n), lanes(stages, n)
    states[0] = asked.start[:, None]
    style, limits = (
        _same(styles(vehicle, falls=not asked.wishes.lean and vehicle.mount != "cup")),
        _same(vehicle.rotor_limits / units.force),
    )
    guess(stages, states, style, limits, timing, problem.vehicle, states[1:], commands)
    return problem, states, commands


def _dense(asked: Request, compiled: Kernels, states: Any, commands: Any, h: float) -> Any:
    """Return the states (DENSE stages + 1, 24 + n), SI units, at equal times, by steps of length `h` in each stage."""
    vehicle, units = asked.vehicle, asked.units
    timing, numbers = _same(step_timing(vehicle.rotor_lag / units.time, h)), _same(units.numbers(vehicle))
    stages, width = len(commands), states.shape[1]
    here, after, command = lanes(stages, width), lanes(stages, width), lanes(stages, asked.rotors)
    here[:], command[:] = states[:-1, :, None], commands[:, :, None]
    parts = [here[:, :, 0].copy()]
    for _ in range(DENSE - 1):
        compiled.step(stages, here, command, timing, numbers, after)
        parts.append(after[:, :, 0].copy())
        here[:] = after
    inside = np.stack(parts, axis=1).reshape(-1, width)
    dense = np.concatenate([inside, states[-1:]]) * units.states(asked.rotors)
    dense[:, :3] += asked.target
    return dense


def _told(
    asked: Request, dense: Any, commands: Any, h: float, lacks: str, unfinished: str, took: float, iterations: int,
    lane: int,
) -> Plan:  # fmt: skip
    """Return the plan with its verdict; stages have the length `h`, own units."""
    units, packed, forces = asked.units, dense[:, :SIZE], dense[:, SIZE:]
    lacks = lacks or broken(packed, forces, asked.vehicle, asked.limits)
    status: Status = "failed" if lacks else "feasible" if unfinished else "optimal"
    times = np.arange(len(dense), dtype=float) * float(h * units.time / DENSE)
    return Plan(
        vehicle=asked.vehicle, objective=asked.objective, target=asked.target, t=times, packed=packed,
        rotor_forces=forces, commands=commands * units.force, stage=h * units.time, status=status,
        reason=lacks or unfinished, solve_time=took, iterations=iterations, guess=lane,
    )  # fmt: skip
