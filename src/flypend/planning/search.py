"""The search for a plan: from what is asked to guesses, from them to the best, and from that to a plan."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from flypend import signals
from flypend.building import builds, built
from flypend.compile.llvm.stagewise import WIDTH, Stagewise, lanes, stagewise
from flypend.model.state import SIZE
from flypend.planning.constraints import begins_touching, broken
from flypend.planning.dynamics import Array, Stage
from flypend.planning.files import Status
from flypend.planning.guess import arcs, lean_guess, leans, pump_program, styles
from flypend.planning.multistart import (
    FINAL,
    MOST_ITERATIONS,
    NOT_REACHED,
    ROUNDS,
    SOFT_GROWTH,
    SOFT_LAST,
    FinalWatch,
    Found,
    Guess,
    Job,
    Race,
    Verdict,
    Watch,
    count_agreeing,
    run_race,
)
from flypend.planning.problem import STAGES_PER_UNIT, Request
from flypend.planning.result import Plan
from flypend.planning.solver import Problem, Settings, Solver, programs_of, side_by_side

DENSE = 4  # samples per stage
NEARER = 0.01  # rod lengths, by which a converged plan may be nearer than the clearance: a cost leaves that much
FINER = 4  # times as many are checked: what moves at 10 m/s comes 12 mm farther between them on hehn2011


def stages_of(horizon: float) -> tuple[int, float]:
    """Return number and length of the stages of a `horizon` (√(l/g))."""
    stages = max(WIDTH, round(horizon * STAGES_PER_UNIT))
    return stages, horizon / stages


@builds
def prepare(asked: Request) -> None:
    """Compile what solves `asked`, or take it from the cache."""
    programs_of(asked), pump_program(asked.rotors)


def together(
    asked: Request,
    horizon: float,
    deadline: float,
    most: int = MOST_ITERATIONS,
    rounds: Mapping[int, int] | None = None,
    kept: Request | None = None,
) -> Found:
    """Solve from all styles of guesses, until the best is steady or the `deadline` is over.

    It is of the processor time of this thread, s. There are at `most` so many iterations. `rounds` are as in `Race`; by
    default no guess is given up where costs are soft at first, since the dearest may be the one that keeps away.
    `kept` is as in `Race`.
    """
    jobs = _every_style(asked)
    given_up = ({} if asked.structure.soft else ROUNDS) if rounds is None else rounds
    race = Race(programs_of(asked), *make_guesses(jobs, horizon), given_up, kept)
    return run_race(race, Watch(jobs, range(WIDTH), most), deadline)


class Relay(Race):
    """A race of all guesses for what is `asked` with a `horizon` (√(l/g)), in legs that begin ever later.

    `rounds` as in `Race`, which is early; `first` as in `Watch`.
    """

    def __init__(self, asked: Request, horizon: float, rounds: Mapping[int, int], first: float) -> None:
        self._jobs, self._first, self._spent = _every_style(asked), first, 0.0
        super().__init__(programs_of(asked), *make_guesses(self._jobs, horizon), rounds, closed=False)

    def begin_at(self, stage: int, state: Array) -> None:
        """Go on from a `stage`, which begins at `state` (24 + n,), own units."""
        for i in self.running:
            self._solvers[i].restart(slice(stage, self._stages), state[:, None])

    def leg(self, iterations: int) -> Found:
        """Do so many `iterations`, and return the best of this leg; the cheapest, if none reaches its end."""
        found = run_race(self, Watch(self._jobs, range(WIDTH), iterations, self._first), math.inf)
        self._first *= SOFT_GROWTH**iterations
        self._spent += found.spent
        found = replace(found, iterations=self._iterations, spent=self._spent)
        if not found.lacks:
            return found
        cost = np.nan_to_num(self.measures.cost, nan=np.inf)
        lane = min(self.running, key=cost.__getitem__)
        states, commands = self.iterate(lane)
        return replace(found, states=states, commands=commands, style=lane)


def improve(job: Job, horizon: float, guess: Guess, deadline: float, watch: Watch | None = None) -> Found:
    """Solve from a `guess` of one's own, in as many stages as it has; its first state is the start.

    `job` says what is asked for, and the number of the guess. By default it is watched as one that keeps its distance.
    """
    watch = watch or Watch([job], [0], first=SOFT_LAST)
    race = Race(programs_of(job.asked), *_begun([job], horizon, [guess]), {}, settings=watch.settings)
    return run_race(race, watch, deadline)


def finish(job: Job, horizon: float, found: Found, deadline: float, settings: Settings = FINAL) -> Found:
    """Solve what was `found` for a `job` to the end with `settings`."""
    watch = FinalWatch(job, settings=settings)
    return _join(found, improve(job, horizon, (found.states, found.commands), deadline, watch))


def _join(found: Found, final: Found) -> Found:
    """Return the `final` of what was `found` by a search, with the iterations of both."""
    return replace(final, costs=found.costs, iterations=found.iterations + final.iterations)


def one_by_one(jobs: Sequence[Job], horizon: float, before: Sequence[Found] | None = None) -> list[Found]:
    """Solve each of `jobs` on a lane of its own; a lane that is done takes the next job.

    Jobs have the same structure, and vehicles as many rotors. Lanes do not see each other: what is found for a job
    does not depend on the others. What was found for each `before` is solved to the end.
    """
    found, asked = {}, jobs[0].asked

    def begin_from(first: int) -> tuple[Problem, Array, Array]:
        own = [i if i < len(jobs) else first for i in range(first, first + WIDTH)]
        some = [jobs[i] for i in own]
        if before is None:
            return make_guesses(some, horizon)
        return _begun(some, horizon, [(before[i].states, before[i].commands) for i in own])

    def watching(place: int, lane: int) -> tuple[int, Watch]:
        return place, Watch([jobs[place]], [lane]) if before is None else FinalWatch(jobs[place], lane)

    watches = {lane: watching(lane, lane) for lane in range(min(WIDTH, len(jobs)))}
    compiled, begun, following = programs_of(asked, lanes=True), begin_from(0), WIDTH
    solver = Solver(compiled, *begun, settings=watches[0][1].settings)
    while watches:
        signals.poll()
        begin = time.thread_time()
        for _, watch in watches.values():
            watch.before(solver)
        solver.improve()
        verdict, spent = Verdict(solver.measures, asked.structure.soft), (time.thread_time() - begin) / len(watches)
        for lane, (place, watch) in list(watches.items()):
            watch.after(solver, verdict, spent)
            if not watch.done:
                continue
            found[place] = watch.found(solver)
            del watches[lane]
            if following < len(jobs):
                if following % WIDTH == 0:
                    begun = begin_from(following)
                solver.take(lane, *begun, following % WIDTH)
                watches[lane] = watching(following, lane)
                following += 1
    ended = [found[i] for i in range(len(jobs))]
    return ended if before is None else [*map(_join, before, ended)]


def _every_style(asked: Request) -> list[Job]:
    return [Job(asked, style) for style in range(WIDTH)]


def guesses_of(asked: Request, horizon: float, stages: int) -> list[Guess]:
    """Return all guesses there are for what is `asked`, in so many `stages`: of all styles, and arcs of the rod."""
    _, states, commands = make_guesses(_every_style(asked), horizon, stages)
    found = [(states[..., lane], commands[..., lane]) for lane in range(WIDTH)]
    return [*found, *arcs(asked, stages, horizon / stages)] if asked.falls else found


def make_guesses(jobs: Sequence[Job], horizon: float, stages: int | None = None) -> tuple[Problem, Array, Array]:
    """Return the problem of as many `jobs` as lanes, and their guessed states and commands."""
    stages = stages or stages_of(horizon)[0]
    asked, h = [job.asked for job in jobs], horizon / stages
    n, problem = asked[0].rotors, Problem.of(asked, stages, h)
    style = side_by_side([styles(job.asked)[:, job.style] for job in jobs])
    limits = side_by_side([each.vehicle.rotor_limits / each.units.force for each in asked])
    states, commands = lanes(stages + 1, SIZE + n), lanes(stages, n)
    states[0] = side_by_side([each.start for each in asked])
    pump_program(n)(stages, states, style, limits, problem.timing, problem.vehicle, states[1:], commands)
    for lane, job in enumerate(jobs):
        if leans(job.asked, job.style):
            states[..., lane], commands[..., lane] = lean_guess(job.asked, job.style, stages, h)
    return problem, states, commands


def _begun(jobs: Sequence[Job], horizon: float, guesses: Sequence[Guess]) -> tuple[Problem, Array, Array]:
    """Return the problem of `jobs`, and their states and commands: `guesses`, which have as many stages."""
    states, commands = map(side_by_side, zip(*guesses, strict=True))
    stages = len(commands)
    return Problem.of([job.asked for job in jobs], stages, horizon / stages), states, commands


def _dense(asked: Request, found: Found, horizon: float, samples: int) -> Any:
    """Return states (samples · stages + 1, 24 + n), SI units, at equal times, by so many steps in each stage."""
    stages, width = len(found.commands), found.states.shape[1]
    h = horizon / stages / samples
    after, commands = np.empty((stages, width)), np.ascontiguousarray(found.commands)
    timing, numbers = asked.units.timing(asked.vehicle, h), asked.units.numbers(asked.vehicle)
    step, parts = _step(asked.rotors), [found.states[:-1]]
    for _ in range(samples - 1):
        step(stages, np.ascontiguousarray(parts[-1]), commands, timing, numbers, after)
        parts.append(after.copy())
    dense = np.concatenate([np.stack(parts, axis=1).reshape(-1, width), found.states[-1:]])
    dense *= asked.units.states(asked.rotors)
    dense[:, :3] += asked.target
    return dense


@built(maxsize=4)
def _step(rotors: int) -> Stagewise:
    return stagewise(Stage(rotors).step(), shared=(2, 3), abreast=True)


@dataclass(frozen=True)
class Tried:
    """What came of an attempt at a request with a `horizon` (√(l/g))."""

    asked: Request
    horizon: float
    found: Found
    plan: Plan

    @classmethod
    def of(cls, asked: Request, found: Found, horizon: float) -> Tried:
        """Return what was `found` for what is `asked`, with its plan."""
        return cls(asked, horizon, found, plan_of(asked, found, horizon))

    def __bool__(self) -> bool:
        """Whether the plan can be flown."""
        return bool(self.plan)

    def rank(self) -> tuple[bool, float]:
        """Return whether it failed, and its cost: the less, the better."""
        return not self, self.found.cost

    @property
    def job(self) -> Job:
        """Its guess."""
        return Job(self.asked, self.found.style)

    def better_of(self, final: Tried) -> Tried:
        """Return what solving this to the end came to, `final`, if that converged or is better; else this."""
        return final if final and (not final.found.unfinished or final.found.cost < self.found.cost) else self


def plan_of(asked: Request, found: Found, horizon: float) -> Plan:
    """Return the plan, with its verdict, of what was `found` for what is `asked` with the `horizon` (√(l/g))."""
    units, h = asked.units, horizon / len(found.commands)
    stage, dense = h * units.time, _dense(asked, found, horizon, DENSE)
    packed, forces = dense[:, :SIZE], dense[:, SIZE:]
    lacks = begins_touching(packed, forces, asked.vehicle) or found.lacks
    lacks = lacks or ("" if np.all(np.isfinite(dense)) else "its numbers are not finite")
    lacks = "the target is not reached" if asked.structure.end and lacks == NOT_REACHED else lacks
    if not lacks:
        finer = _dense(asked, found, horizon, DENSE * FINER)
        lacks = broken(finer[:, :SIZE], finer[:, SIZE:], asked.vehicle, asked.kept)
    status: Status = "failed" if lacks else "feasible" if found.unfinished else "converged"
    plan = Plan(
        vehicle=asked.vehicle, objective=asked.objective, target=asked.target, path=asked.kept.path,
        windows=asked.kept.windows,
        t=np.arange(len(dense), dtype=float) * float(stage / DENSE), packed=packed, rotor_forces=forces,
        commands=found.commands * units.force, stage=stage, status=status, reason=lacks or found.unfinished,
        solve_time=found.spent, iterations=found.iterations, stationarity=found.stationarity, guess=found.style,
        guesses=len(found.costs), agreeing=0 if lacks else count_agreeing(found.costs),
    )  # fmt: skip
    near = _too_near(plan, asked.kept.clearance or 0.0) if plan else ""
    return replace(plan, status="feasible", reason=", ".join(filter(None, (plan.reason, near)))) if near else plan


def _too_near(plan: Plan, clearance: float) -> str:
    """Return by how much a `plan` is nearer than the `clearance` (m) to frames or mount; or "".

    A cost grows for the clearance: what comes nearer can be flown as long as nothing touches. A start that is nearer is
    to keep its own distance.
    """
    rooms = [window.room(plan.states, plan.vehicle) for window in plan.windows]
    if plan.vehicle.mount != "gimbal":
        rooms.append(plan.trajectory.clearance)
    lacking = max((min(clearance, float(room[0])) - float(np.min(room)) for room in rooms), default=0.0)
    return f"the clearance is {lacking:.3g} m short" if lacking > NEARER * plan.vehicle.l else ""
