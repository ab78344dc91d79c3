"""Multistart: solvers that begin from many guesses, of which the dearest are given up, until the best is steady."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from flypend import signals
from flypend.compile.llvm.stagewise import lanes
from flypend.planning.constraints import TOLERANCE
from flypend.planning.dynamics import Array
from flypend.planning.problem import Request
from flypend.planning.solver import (
    DEFAULT,
    Measures,
    Problem,
    Programs,
    Scratch,
    Settings,
    Solver,
    one_lane,
    programs_of,
)

# After so many iterations so many go on, those of least cost.
ROUNDS: Mapping[int, int] = MappingProxyType({6: 4, 12: 2})

Guess = tuple[Array, Array]  # states (stages + 1, 24 + n) and commands (stages, n), own units

NEVER = np.full(1, np.inf)
LOST = Measures(NEVER, NEVER, NEVER, NEVER, NEVER, NEVER, np.full(1, True), NEVER)  # of a guess that is given up
MOST_ITERATIONS = 80
# A search is over when at so small a barrier the best cost has changed by less than this share in so many iterations.
STEADY, STEADY_FOR, STEADY_BARRIER = 0.01, 4, 3e-5
# What it found is solved to the end, which takes 5 to 70 iterations, and through windows some hundreds: from a little
# inside the limits, with a smaller barrier, and each error at the end within 1/√3 of its tolerance, so that vectors of
# errors are within theirs.
FINAL = Settings(
    barrier=1e-5, least_barrier=1e-6, cooling=0.5, long=0.3, missed=0.57, multipliers=True, inside=1e-4, slack=1e-3,
    margin=(1e-3, 1e-5), state_damping=1.0, worse=3.0, plain=1e-3, credit=0.93,
)  # fmt: skip
# In the least time, the end is reached with all that its tolerances and limits allow: less leaves no room to converge.
FINAL_IN_TIME = replace(FINAL, least_barrier=3e-7, missed=0.98)
# It has converged when so many times in a row the next step would change the cost by less than this share, barrier
# included: then IPOPT, begun there, finds less than 1 % of an excursion to improve, and 4 % of an effort.
STATIONARY, STATIONARY_FOR, MOST_FINAL = 1e-4, 2, 1000
SOFT_FIRST, SOFT_GROWTH, SOFT_LAST = 1e-4, 2.0, 10.0
SAME = 0.01  # share by which costs of guesses differ that lead to the same plan
CLOSED = 1e-6  # largest sum of all gaps, own units, of a plan that can be flown
NOT_REACHED, NOT_KEPT = "inverted hover is not reached", "a wish is not kept"
UNKNOWN = 1e9  # stationarity of what has no cost
UNFINISHED = "the solver had not converged"


class Race:
    """Solvers of one problem each, which are seen as the lanes of one; those given up are stuck, and cost infinity.

    `compiled` are the programs of a single problem, `rounds` are as `ROUNDS`, and the rest as in `Solver`. The lanes
    are to keep what is `kept`, although their solvers do not know of it. Where gaps are not `closed` by the time of a
    round, they are most of the cost, and the guess of least excursion and effort goes on as well. The lanes `running`
    are those that are not given up.
    """

    def __init__(
        self, compiled: Programs, problem: Problem, states: Array, commands: Array,
        rounds: Mapping[int, int] = ROUNDS, kept: Request | None = None, settings: Settings = DEFAULT,
        *, closed: bool = True,
    ) -> None:  # fmt: skip
        scratch, arrays = Scratch(compiled, problem.stages, 1), (*problem.arrays, states, commands)
        self._solvers, self._lacks = [], []
        for i in range(states.shape[-1]):
            *own, begin, steered = (one_lane(values[..., i]) for values in arrays)
            alone = Problem(problem.stages, *own)
            self._solvers.append(Solver(compiled, alone, begin, steered, settings, scratch))
            self._lacks += [_lack(kept, alone, begin, steered)] if kept else []
        self.running = list(range(len(self._solvers)))
        self._iterations, self._rounds, self._closed, self._stages = 0, rounds, closed, problem.stages

    def improve(self) -> None:
        """Do one iteration of each that is not given up."""
        for i in self.running:
            self._solvers[i].improve()
        self._iterations += 1
        if self._iterations in self._rounds:
            cost, value = (np.nan_to_num(each[self.running], nan=np.inf) for each in self.measures[:2])
            best = np.argsort(cost, kind="stable")
            if not self._closed:
                nearest = np.argmin(value)
                best = np.array([nearest, *best[best != nearest]])
            self.running = sorted(self.running[i] for i in best[: self._rounds[self._iterations]])

    def insist(self, place: int, weight: float, on: Any) -> None:
        """See `Solver`."""
        for i in on:
            self._solvers[i].insist(place, weight, slice(None))

    def iterate(self, lane: int) -> tuple[Array, Array]:
        """See `Solver`."""
        return self._solvers[lane].iterate(0)

    @property
    def measures(self) -> Measures:
        """See `Solver`."""
        some = [LOST] * len(self._solvers)
        for i in self.running:
            found = self._solvers[i].measures
            some[i] = found._replace(lack=self._lacks[i]()) if self._lacks else found
        return Measures(*map(np.concatenate, zip(*some, strict=True)))


def _lack(kept: Request, problem: Problem, states: Array, commands: Array) -> Callable[[], Array]:
    """Return what tells how much `states` and `commands` on one lane, whatever they are by then, lack of `kept`."""
    k, N, one = programs_of(kept), problem.stages, one_lane([1.0])
    places = () if problem.places is None else (problem.places,)
    summary, slack = lanes(N, k.summary, width=1), one_lane(np.ones((N, k.inequalities)))
    point = states, commands, one, one_lane(kept.numbers), problem.vehicle
    values = k.values.on(*point, slack, one, *places, summary, slack.copy())

    def lack() -> Array:
        values(0, N)
        found: Array = summary[:, 2].sum(axis=0)  # see `Barrier.values`
        return found

    return lack


def work(rounds: Mapping[int, int], guesses: int, iterations: int) -> int:
    """Return how many iterations of single guesses so many `iterations` of a race are."""
    done = 0
    for i in range(iterations):
        guesses = rounds.get(i, guesses)
        done += guesses
    return done


@dataclass(frozen=True)
class Job:
    """A guess to solve: what is `asked`, and the number of the guess's `style`."""

    asked: Request
    style: int


@dataclass(frozen=True, eq=False)
class Found:
    """What came of one or several guesses: the best iterate, in own units."""

    states: Array  # (stages + 1, 24 + n)
    commands: Array  # (stages, n)
    cost: float  # infinite if it cannot be flown
    lacks: str  # why it cannot be flown; empty if it can
    unfinished: str  # whether the solver had not converged; empty if it had
    style: int  # of its guess
    costs: tuple[float, ...]  # of all guesses of which it is the best, infinite for those that failed or were given up
    stationarity: float  # see `Plan`
    iterations: int
    spent: float  # processor time, s: of every iteration, an equal part for each guess that was being solved


class Verdict:
    """What lanes are worth by their `measures`, (lanes,) each; with `soft` constraints, what is too near counts.

    `cost` is infinite for what cannot be flown, and `lacks` tells how far it is from that, in tolerances. What
    `arrives` reaches hover, whatever it breaks on the way. `stationarity` is the change of the cost that the last step
    was to bring, as a share of it. The others are as in `Measures`.
    """

    def __init__(self, measures: Measures, soft: bool) -> None:
        cost, lack = (measures.cost if soft else measures.value), measures.lack
        self.arrives, self.stuck = (measures.end <= 1) & (measures.gap <= CLOSED), measures.stuck
        self.barrier = measures.barrier
        with np.errstate(all="ignore"):
            self.stationarity = np.nan_to_num(measures.change / measures.value, nan=UNKNOWN, posinf=UNKNOWN)
        self.cost = np.where(self.arrives & (lack <= TOLERANCE) & np.isfinite(cost), cost, np.inf)
        lacks = np.maximum(measures.end, 1) + lack / TOLERANCE + measures.gap / CLOSED
        lacks = np.where(self.arrives, lacks, np.fmax(lacks, UNKNOWN) + lacks)  # what arrives comes first
        self.lacks = np.where(np.isfinite(lacks), lacks, np.inf)

    def of(self, on: Any) -> tuple[float, int, str]:
        """Return cost and place of the best of the lanes `on`; of the nearest, with what it lacks, if there is none."""
        place = int(np.argmin(self.cost[on]))
        if np.isfinite(self.cost[on[place]]):
            return float(self.cost[on[place]]), place, ""
        place = int(np.argmin(self.lacks[on]))
        return np.inf, place, NOT_KEPT if self.arrives[on[place]] else NOT_REACHED


class Watch:
    """Watches the lanes `on` of a solver with `settings`, a lane for each of `jobs`, until the best is steady.

    There are at `most` so many iterations. In the first, being too near what must not be touched has the weight
    `first`.
    """

    enough = STEADY_FOR  # iterations in a row

    def __init__(
        self, jobs: Sequence[Job], on: Sequence[int], most: int = MOST_ITERATIONS, first: float = SOFT_FIRST,
        settings: Settings = DEFAULT,
    ) -> None:  # fmt: skip
        self.settings, self.soft = settings, jobs[0].asked.structure.soft
        self._jobs, self._on, self._most, self._first = jobs, np.array(on), most, first
        self._best, self._steady, self._iterations, self._spent = np.inf, 0, 0, 0.0
        self._costs: tuple[float, ...] = (np.inf,) * len(on)
        self._kept: tuple[Array, Array, str, int, float] | None = None
        self._stuck = False

    @property
    def done(self) -> bool:
        """Whether more iterations are not worth their time."""
        return self._steady >= self.enough or self._iterations >= self._most or self._stuck

    def before(self, solver: Solver | Race) -> None:
        """Prepare an iteration: what must not be touched costs more and more to be near."""
        if self.soft:
            weight = self._first * SOFT_GROWTH**self._iterations
            solver.insist(-2, min(SOFT_LAST, weight), self._on)
            self._best = self._best if weight > SOFT_LAST else np.inf  # costs under other weights do not compare

    def after(self, solver: Solver | Race, verdict: Verdict, spent: float) -> None:
        """Look at the lanes after an iteration, of which `spent` (s) belongs to these lanes."""
        score, place, lacks = verdict.of(self._on)
        lane = int(self._on[place])
        settled = np.isfinite(self._best) and score > (1 - STEADY) * self._best
        self._steady = self._steady + 1 if settled and verdict.barrier[lane] <= STEADY_BARRIER else 0
        if self._kept is None or not score > self._best:
            self._kept = *solver.iterate(lane), lacks, place, float(verdict.stationarity[lane])
        self._best = min(self._best, score)
        self._costs = tuple(verdict.cost[self._on].tolist())
        self._iterations += 1
        self._spent += spent
        self._stuck = bool(np.all(verdict.stuck[self._on]))

    def found(self, solver: Solver | Race) -> Found:
        """Return the best so far."""
        none = *solver.iterate(int(self._on[0])), NOT_REACHED, 0, UNKNOWN
        states, commands, lacks, place, stationarity = self._kept or none
        return Found(
            states, commands, self._best, lacks, UNFINISHED, self._jobs[place].style, self._costs, stationarity,
            self._iterations, self._spent,
        )  # fmt: skip


class FinalWatch(Watch):
    """Watches a lane that solves a `job` to the end with `settings`: until the conditions of first order hold."""

    enough = STATIONARY_FOR

    def __init__(self, job: Job, lane: int = 0, settings: Settings = FINAL) -> None:
        super().__init__([job], [lane], MOST_FINAL, SOFT_LAST, settings)

    def after(self, solver: Solver | Race, verdict: Verdict, spent: float) -> None:
        """Look at the lane after an iteration, which took `spent` (s): what converges counts, else the best."""
        lane = int(self._on[0])
        small = verdict.stationarity[lane] <= STATIONARY and verdict.barrier[lane] <= self.settings.least_barrier
        stationary = bool(small and np.isfinite(verdict.cost[lane]))
        times, self._best = (self._steady + 1, np.inf) if stationary else (0, self._best)
        super().after(solver, verdict, spent)
        self._steady = times

    def found(self, solver: Solver | Race) -> Found:
        """Return the iterate that converged, or else the best."""
        found = super().found(solver)
        return replace(found, unfinished="") if self._steady >= self.enough else found


def count_agreeing(costs: ArrayLike) -> int:
    """Return how many of `costs`, infinite for what cannot be flown, are within `SAME` of the least."""
    least = np.min(costs)
    return int(np.sum(np.asarray(costs) <= (1 + SAME) * least)) if np.isfinite(least) else 0


def run_race(race: Race, watch: Watch, deadline: float) -> Found:
    """Return what a `race` finds until its `watch` is done, or the `deadline` (s) of this thread's time is over."""
    while not watch.done and time.thread_time() < deadline:
        signals.poll()
        begin = time.thread_time()
        watch.before(race)
        race.improve()
        watch.after(race, Verdict(race.measures, watch.soft), time.thread_time() - begin)
    return watch.found(race)
