"""The search for plans: guesses on the lanes of a solver, watched until they settle."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend import signals
from flypend.compile.llvm.stagewise import WIDTH, lanes
from flypend.model.state import SIZE
from flypend.planning.guesses import pumping, styles
from flypend.planning.kernels import kernels
from flypend.planning.leaning import leaned, leans
from flypend.planning.method import Problem
from flypend.planning.race import ROUNDS, Race
from flypend.planning.request import STAGES_PER_UNIT, TOLERANCE, Request
from flypend.planning.single import single
from flypend.planning.solver import Solver
from flypend.plants.lag import step_timing

MOST_ITERATIONS = 80
# Converged: at so small a barrier, the best cost has changed by less than this share in so many iterations.
STEADY, STEADY_FOR, STEADY_BARRIER = 0.01, 4, 3e-5
SOFT_FIRST, SOFT_GROWTH, SOFT_LAST = 1e-4, 2.0, 10.0
CLOSED = 1e-6  # largest sum of all gaps, own units, of a plan that can be flown
NOT_REACHED, NOT_KEPT = "inverted hover is not reached", "a wish is not kept"
UNFINISHED = "the solver had not converged"

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Job:
    """A guess to solve: what is `asked`, and the number of the guess's `style`."""

    asked: Request
    style: int


@dataclass(frozen=True, eq=False)
class Found:
    """What came of one or several guesses, in own units.

    Parameters
    ----------
    states, commands : (stages + 1, 24 + n), (stages, n)
        The best iterate.
    cost : float
        Its cost; infinite if it cannot be flown.
    lacks, unfinished : str
        Why it cannot be flown, and whether the solver had not converged; empty if not.
    style, iterations : int
        The style of its guess, and the iterations of the solver.
    spent : float
        Processor time, s: of every iteration, an equal part for each guess that was being solved.
    """

    states: Array
    commands: Array
    cost: float
    lacks: str
    unfinished: str
    style: int
    iterations: int
    spent: float


class Verdict:
    """What the lanes of a `solver` are worth after an iteration; with `soft` constraints, what is too near counts.

    Attributes
    ----------
    cost, lacks : (lanes,)
        The cost, infinite for what cannot be flown; and how far it is from that, in tolerances.
    arrives, stuck : (lanes,)
        Whether it reaches hover, whatever it breaks on the way; and whether it cannot be improved.
    """

    def __init__(self, solver: Solver | Race, soft: bool) -> None:
        cost, violation = (solver.cost if soft else solver.value), solver.violation
        self.arrives, self.stuck = (solver.end <= 1) & (solver.gap <= CLOSED), solver.stuck
        self.cost = np.where(self.arrives & (violation <= TOLERANCE) & np.isfinite(cost), cost, np.inf)
        lacks = np.maximum(solver.end, 1) + violation / TOLERANCE + solver.gap / CLOSED
        self.lacks = np.where(np.isfinite(lacks), lacks, np.inf)

    def of(self, on: Any) -> tuple[float, int, str]:
        """Return cost and place of the best of the lanes `on`; of the nearest, with what it lacks, if there is none."""
        place = int(np.argmin(self.cost[on]))
        if np.isfinite(self.cost[on[place]]):
            return float(self.cost[on[place]]), place, ""
        place = int(np.argmin(self.lacks[on]))
        return np.inf, place, NOT_KEPT if self.arrives[on[place]] else NOT_REACHED


class Watch:
    """Watches some `lanes` of a solver with `jobs`, of which the best counts, until that is steady.

    There are at `most` so many iterations. In the first, being too near what must not be touched has the weight `soft`.
    """

    def __init__(
        self, jobs: Sequence[Job], on: Sequence[int], most: int = MOST_ITERATIONS, soft: float = SOFT_FIRST
    ) -> None:
        self._jobs, self._on, self._most, self._first = jobs, np.array(on), most, soft
        self._best, self._steady, self._iterations, self._spent = np.inf, 0, 0, 0.0
        self._soft = jobs[0].asked.structure.soft
        self._kept: tuple[Array, Array, str, int] | None = None
        self._stuck = False

    @property
    def done(self) -> bool:
        """Whether more iterations are not worth their time."""
        return self._steady >= STEADY_FOR or self._iterations >= self._most or self._stuck

    def before(self, solver: Solver | Race) -> None:
        """Prepare an iteration: what must not be touched costs more and more to be near."""
        if self._soft:
            weight = self._first * SOFT_GROWTH**self._iterations
            solver.insist(-2, min(SOFT_LAST, weight), self._on)
            self._best = self._best if weight > SOFT_LAST else np.inf  # costs under other weights do not compare

    def after(self, solver: Solver | Race, verdict: Verdict, spent: float) -> None:
        """Look at the lanes after an iteration, of which `spent` (s) belongs to these lanes."""
        score, place, lacks = verdict.of(self._on)
        lane = int(self._on[place])
        settled = np.isfinite(self._best) and score > (1 - STEADY) * self._best
        self._steady = self._steady + 1 if settled and solver.barrier[lane] <= STEADY_BARRIER else 0
        if self._kept is None or not score > self._best:
            self._kept = *solver.iterate(lane), lacks, place
        self._best = min(self._best, score)
        self._iterations += 1
        self._spent += spent
        self._stuck = bool(np.all(verdict.stuck[self._on]))

    def found(self, solver: Solver | Race) -> Found:
        """Return the best so far."""
        none = *solver.iterate(int(self._on[0])), NOT_REACHED, 0
        states, commands, lacks, place = self._kept or none
        unfinished = "" if self._steady >= STEADY_FOR else UNFINISHED
        return Found(
            states, commands, self._best, lacks, unfinished, self._jobs[place].style, self._iterations, self._spent
        )


def stages_of(horizon: float) -> tuple[int, float]:
    """Return number and length of the stages of a `horizon` (√(l/g))."""
    stages = max(WIDTH, round(horizon * STAGES_PER_UNIT))
    return stages, horizon / stages


def prepared(asked: Request) -> None:
    """Compile what solves `asked`, or take it from the cache."""
    single(asked.rotors, asked.structure), pumping(asked.rotors)


def together(
    asked: Request,
    horizon: float,
    deadline: float,
    most: int = MOST_ITERATIONS,
    rounds: Mapping[int, int] | None = None,
    first: float = SOFT_FIRST,
) -> Found:
    """Solve from all styles of guesses, until the best is steady or the `deadline` (monotonic) is over.

    There are at `most` so many iterations. `rounds` are as in `race.Race`; by default no guess is given up where costs
    are soft at first, since the dearest may be the one that keeps away. `first` is the `soft` of `Watch`.
    """
    jobs, soft = [Job(asked, style) for style in range(WIDTH)], asked.structure.soft
    given_up = ({} if soft else ROUNDS) if rounds is None else rounds
    solver = Race(single(asked.rotors, asked.structure), *guessed(jobs, horizon), given_up)
    watch = Watch(jobs, range(WIDTH), most, first)
    while not watch.done and time.monotonic() < deadline:
        signals.poll()
        begin = time.thread_time()
        watch.before(solver)
        solver.improve()
        watch.after(solver, Verdict(solver, soft), time.thread_time() - begin)
    return watch.found(solver)


def one_by_one(jobs: Sequence[Job], horizon: float) -> list[Found]:
    """Solve each of `jobs` on a lane of its own; a lane that is done takes the next job.

    Jobs have the same structure, and vehicles as many rotors. Lanes do not see each other: what is found for a job
    does not depend on the others.
    """
    found: list[Found | None] = [None] * len(jobs)
    soft = jobs[0].asked.structure.soft
    first = [*jobs[:WIDTH], *[jobs[0]] * (WIDTH - len(jobs))]
    solver = _solver(first, horizon)
    watches = {lane: (lane, Watch([job], [lane])) for lane, job in enumerate(jobs[:WIDTH])}
    following = WIDTH
    guesses: list[tuple[Problem, Array, Array]] = []
    while watches:
        signals.poll()
        begin = time.thread_time()
        for _, watch in watches.values():
            watch.before(solver)
        solver.improve()
        verdict, spent = Verdict(solver, soft), (time.thread_time() - begin) / len(watches)
        for lane, (place, watch) in list(watches.items()):
            watch.after(solver, verdict, spent)
            if not watch.done:
                continue
            found[place] = watch.found(solver)
            del watches[lane]
            if following < len(jobs):
                ahead = (following - WIDTH) % WIDTH
                if ahead == 0:
                    some = jobs[following : following + WIDTH]
                    guesses = [guessed([*some, *[some[0]] * (WIDTH - len(some))], horizon)]
                solver.take(lane, *guesses[0], ahead)
                watches[lane] = following, Watch([jobs[following]], [lane])
                following += 1
    return [each for each in found if each is not None]


def _solver(jobs: Sequence[Job], horizon: float) -> Solver:
    asked = jobs[0].asked
    return Solver(kernels(asked.rotors, asked.structure), *guessed(jobs, horizon))


def guessed(jobs: Sequence[Job], horizon: float) -> tuple[Problem, Array, Array]:
    """Return the problem of as many `jobs` as lanes, and their guessed states and commands."""
    stages, h = stages_of(horizon)
    n = jobs[0].asked.rotors
    columns = [_columns(job, h) for job in jobs]
    timing, vehicle, numbers, style, limits, begin = (_side_by_side(some) for some in zip(*columns, strict=True))
    states, commands = lanes(stages + 1, SIZE + n), lanes(stages, n)
    states[0] = begin
    pumping(n)(stages, states, style, limits, timing, vehicle, states[1:], commands)
    for lane, job in enumerate(jobs):
        if leans(job.asked, job.style):
            states[..., lane], commands[..., lane] = leaned(job.asked, job.style, stages, h)
    places = None
    if jobs[0].asked.structure.path:
        places = lanes(stages + 1, 3)
        places[:] = np.stack([job.asked.places(h * np.arange(stages + 1, dtype=float)) for job in jobs], axis=-1)
    return Problem(stages, timing, vehicle, numbers, places), states, commands


def _columns(job: Job, h: float) -> tuple[Any, ...]:
    """Return timing, vehicle, numbers, style, rotor limits and start of a `job`, own units."""
    asked, vehicle, units = job.asked, job.asked.vehicle, job.asked.units
    falls = not asked.structure.lean and vehicle.mount != "cup"
    return (
        step_timing(vehicle.rotor_lag / units.time, h), units.numbers(vehicle), asked.numbers,
        styles(vehicle, falls=falls)[:, job.style], vehicle.rotor_limits / units.force, asked.start,
    )  # fmt: skip


def _side_by_side(columns: Sequence[Any]) -> Array:
    array = lanes(len(columns[0]))
    array[:] = np.column_stack(columns)
    return array
