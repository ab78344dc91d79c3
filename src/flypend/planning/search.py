"""The search for a plan: guesses that race each other, or one per lane, watched until they settle."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import signals
from flypend.compile.llvm.stagewise import WIDTH, lanes
from flypend.model.state import SIZE
from flypend.planning.constraints import TOLERANCE
from flypend.planning.guess import arcs, lean_guess, leans, pumping, styles
from flypend.planning.problem import STAGES_PER_UNIT, Request
from flypend.planning.solver import DEFAULT, Measures, Problem, Programs, Scratch, Settings, Solver, one_lane, programs
from flypend.plants.lag import step_timing

# After so many iterations so many go on, those of least cost.
ROUNDS: Mapping[int, int] = MappingProxyType({6: 4, 12: 2})

Array = NDArray[np.float64]
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

    Parameters
    ----------
    compiled : Programs
        The programs of a single problem.
    problem, states, commands : Problem, (stages + 1, 24 + n, lanes), (stages, n, lanes)
        As in `Solver`.
    rounds : dict
        See `ROUNDS`.
    kept : Request, optional
        What the lanes are to keep although their solvers do not know of it.
    settings : Settings, optional
        Numbers of the method.
    closed : bool
        Whether gaps are closed by the time of a round. Where they are not, they are most of the cost, and the guess of
        least excursion and effort goes on as well.
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
        self._running = list(range(len(self._solvers)))
        self._iterations, self._rounds, self._closed, self._stages = 0, rounds, closed, problem.stages

    def improve(self) -> None:
        """Do one iteration of each that is not given up."""
        for i in self._running:
            self._solvers[i].improve()
        self._iterations += 1
        if self._iterations in self._rounds:
            cost, value = (np.nan_to_num(each[self._running], nan=np.inf) for each in self.measures[:2])
            best = np.argsort(cost, kind="stable")
            if not self._closed:
                nearest = np.argmin(value)
                best = np.array([nearest, *best[best != nearest]])
            self._running = sorted(self._running[i] for i in best[: self._rounds[self._iterations]])

    def begin_at(self, stage: int, state: Array) -> None:
        """Go on from a `stage`, which begins at `state` (24 + n,), own units."""
        for i in self._running:
            self._solvers[i].restart(slice(stage, self._stages), state[:, None])

    def insist(self, place: int, weight: float, on: Any) -> None:
        """See `Solver`."""
        for i in on:
            self._solvers[i].insist(place, weight, slice(None))

    def iterate(self, lane: int) -> tuple[Array, Array]:
        """See `Solver`."""
        return self._solvers[lane].iterate(0)

    @property
    def running(self) -> list[int]:
        """The lanes that are not given up."""
        return self._running

    @property
    def measures(self) -> Measures:
        """See `Solver`."""
        some = [solver.measures if i in self._running else LOST for i, solver in enumerate(self._solvers)]
        for i in self._running if self._lacks else ():
            some[i] = some[i]._replace(lack=self._lacks[i]())
        return Measures(*(np.concatenate(parts) for parts in zip(*some, strict=True)))


def _lack(kept: Request, problem: Problem, states: Array, commands: Array) -> Callable[[], Array]:
    """Return what tells how much `states` and `commands` on one lane, whatever they are by then, lack of `kept`."""
    k, N, one = _alone(kept), problem.stages, np.ones(1)
    numbers, places = one_lane(kept.numbers), () if problem.places is None else (problem.places,)
    summary, slack = lanes(N, k.summary, width=1), one_lane(np.ones((N, k.inequalities)))
    values = k.values.on(
        states, commands, one_lane(one), numbers, problem.vehicle, slack, one_lane(one), *places, summary, slack.copy()
    )  # fmt: skip

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
    """What lanes are worth by their `measures`; with `soft` constraints, what is too near counts.

    Attributes
    ----------
    cost, lacks : (lanes,)
        The cost, infinite for what cannot be flown; and how far it is from that, in tolerances.
    arrives : (lanes,)
        Whether it reaches hover, whatever it breaks on the way.
    stationarity : (lanes,)
        The change of the cost that the last step was to bring, as a share of it.
    barrier, stuck : (lanes,)
        See `solver.Measures`.
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
    """Watches some `lanes` of a solver with `jobs`, of which the best counts, until that is steady.

    There are at `most` so many iterations. In the first, being too near what must not be touched has the weight `soft`.
    """

    def __init__(
        self, jobs: Sequence[Job], on: Sequence[int], most: int = MOST_ITERATIONS, soft: float = SOFT_FIRST
    ) -> None:
        self._jobs, self._on, self._most, self._first = jobs, np.array(on), most, soft
        self._best, self._steady, self._iterations, self._spent = np.inf, 0, 0, 0.0
        self._costs: tuple[float, ...] = (np.inf,) * len(on)
        self._soft = jobs[0].asked.structure.soft
        self._kept: tuple[Array, Array, str, int, float] | None = None
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

    def __init__(self, job: Job, lane: int = 0, settings: Settings = FINAL) -> None:
        super().__init__([job], [lane], MOST_FINAL, SOFT_LAST)
        self.settings = settings
        self._times = 0

    @property
    def done(self) -> bool:
        """Whether more iterations are not worth their time."""
        return self._times >= STATIONARY_FOR or self._iterations >= self._most or self._stuck

    def after(self, solver: Solver | Race, verdict: Verdict, spent: float) -> None:
        """Look at the lane after an iteration, which took `spent` (s): what converges counts, else the best."""
        lane = int(self._on[0])
        small = verdict.stationarity[lane] <= STATIONARY and verdict.barrier[lane] <= self.settings.least_barrier
        stationary = bool(small and np.isfinite(verdict.cost[lane]))
        self._best = np.inf if stationary else self._best
        super().after(solver, verdict, spent)
        self._times = self._times + 1 if stationary else 0

    def found(self, solver: Solver | Race) -> Found:
        """Return the iterate that converged, or else the best."""
        found = super().found(solver)
        return replace(found, unfinished="") if self._times >= STATIONARY_FOR else found


def agreeing(costs: ArrayLike) -> int:
    """Return how many of `costs`, infinite for what cannot be flown, are within `SAME` of the least."""
    least = np.min(costs)
    return int(np.sum(np.asarray(costs) <= (1 + SAME) * least)) if np.isfinite(least) else 0


def stages_of(horizon: float) -> tuple[int, float]:
    """Return number and length of the stages of a `horizon` (√(l/g))."""
    stages = max(WIDTH, round(horizon * STAGES_PER_UNIT))
    return stages, horizon / stages


def prepare(asked: Request) -> None:
    """Compile what solves `asked`, or take it from the cache."""
    _alone(asked), pumping(asked.rotors)


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
    jobs = [Job(asked, style) for style in range(WIDTH)]
    given_up = ({} if asked.structure.soft else ROUNDS) if rounds is None else rounds
    race = Race(_alone(asked), *make_guesses(jobs, horizon), given_up, kept)
    return _raced(race, Watch(jobs, range(WIDTH), most), asked.structure.soft, deadline)


class Relay:
    """A race of all guesses for what is `asked` with a `horizon` (√(l/g)), in legs that begin ever later.

    `rounds` as in `Race`, which is early; `soft` as in `Watch`.
    """

    def __init__(self, asked: Request, horizon: float, rounds: Mapping[int, int], soft: float) -> None:
        self._jobs = [Job(asked, style) for style in range(WIDTH)]
        self._race = Race(_alone(asked), *make_guesses(self._jobs, horizon), rounds, closed=False)
        self._asked, self._soft, self._iterations, self._spent = asked, soft, 0, 0.0

    def improve(self, iterations: int) -> Found:
        """Do so many `iterations`, and return the best of this leg; the cheapest, if none reaches its end."""
        watch = Watch(self._jobs, range(WIDTH), iterations, self._soft)
        self._soft *= SOFT_GROWTH**iterations
        found = _raced(self._race, watch, self._asked.structure.soft, math.inf)
        self._iterations, self._spent = self._iterations + found.iterations, self._spent + found.spent
        found = replace(found, iterations=self._iterations, spent=self._spent)
        if not found.lacks:
            return found
        cost = np.nan_to_num(self._race.measures.cost, nan=np.inf)
        lane = min(self._race.running, key=cost.__getitem__)
        states, commands = self._race.iterate(lane)
        return replace(found, states=states, commands=commands, style=lane)

    def begin_at(self, stage: int, state: Array) -> None:
        """Begin a leg at a `stage`, with the `state` (24 + n,), own units."""
        self._race.begin_at(stage, state)


def improved(job: Job, horizon: float, guess: Guess, deadline: float, watch: Watch | None = None) -> Found:
    """Solve from a `guess` of one's own, in as many stages as it has; its first state is the start.

    `job` says what is asked for, and the number of the guess. By default it is watched as one that keeps its distance.
    """
    settings = watch.settings if isinstance(watch, FinalWatch) else DEFAULT
    race = Race(_alone(job.asked), *_begun([job], horizon, [guess]), {}, settings=settings)
    return _raced(race, watch or Watch([job], [0], soft=SOFT_LAST), job.asked.structure.soft, deadline)


def finished(job: Job, horizon: float, found: Found, deadline: float, settings: Settings = FINAL) -> Found:
    """Solve what was `found` for a `job` to the end with `settings`."""
    watch = FinalWatch(job, settings=settings)
    return _joined(found, improved(job, horizon, (found.states, found.commands), deadline, watch))


def _joined(found: Found, final: Found) -> Found:
    """Return the `final` of what was `found` by a search, with the iterations of both."""
    return replace(final, costs=found.costs, iterations=found.iterations + final.iterations)


def _alone(asked: Request) -> Programs:
    return programs(asked.rotors, asked.structure, lanes=False)


def _raced(race: Race, watch: Watch, soft: bool, deadline: float) -> Found:
    """Return what a `race` finds until its `watch` is done, or the `deadline` is over."""
    while not watch.done and time.thread_time() < deadline:
        signals.poll()
        begin = time.thread_time()
        watch.before(race)
        race.improve()
        watch.after(race, Verdict(race.measures, soft), time.thread_time() - begin)
    return watch.found(race)


def one_by_one(jobs: Sequence[Job], horizon: float, before: Sequence[Found] | None = None) -> list[Found]:
    """Solve each of `jobs` on a lane of its own; a lane that is done takes the next job.

    Jobs have the same structure, and vehicles as many rotors. Lanes do not see each other: what is found for a job
    does not depend on the others. What was found for each `before` is solved to the end.
    """
    found: list[Found | None] = [None] * len(jobs)
    asked, soft = jobs[0].asked, jobs[0].asked.structure.soft

    def some_from(first: int) -> tuple[Problem, Array, Array]:
        own = [*range(first, min(first + WIDTH, len(jobs)))]
        own += [first] * (WIDTH - len(own))
        if before is None:
            return make_guesses([jobs[i] for i in own], horizon)
        begun = [(before[i].states, before[i].commands) for i in own]
        return _begun([jobs[i] for i in own], horizon, begun)

    def watching(place: int, lane: int) -> tuple[int, Watch]:
        return place, Watch([jobs[place]], [lane]) if before is None else FinalWatch(jobs[place], lane)

    compiled = programs(asked.rotors, asked.structure, lanes=True)
    solver = Solver(compiled, *some_from(0), settings=DEFAULT if before is None else FINAL)
    watches = {lane: watching(lane, lane) for lane in range(min(WIDTH, len(jobs)))}
    following = WIDTH
    guesses: list[tuple[Problem, Array, Array]] = []
    while watches:
        signals.poll()
        begin = time.thread_time()
        for _, watch in watches.values():
            watch.before(solver)
        solver.improve()
        verdict, spent = Verdict(solver.measures, soft), (time.thread_time() - begin) / len(watches)
        for lane, (place, watch) in list(watches.items()):
            watch.after(solver, verdict, spent)
            if not watch.done:
                continue
            found[place] = watch.found(solver)
            del watches[lane]
            if following < len(jobs):
                ahead = (following - WIDTH) % WIDTH
                if ahead == 0:
                    guesses = [some_from(following)]
                solver.take(lane, *guesses[0], ahead)
                watches[lane] = watching(following, lane)
                following += 1
    ended = [each for each in found if each is not None]
    return ended if before is None else [_joined(*pair) for pair in zip(before, ended, strict=True)]


def guesses_of(asked: Request, horizon: float, stages: int) -> list[Guess]:
    """Return all guesses there are for what is `asked`, in so many `stages`: of all styles, and arcs of the rod."""
    _, states, commands = make_guesses([Job(asked, style) for style in range(WIDTH)], horizon, stages)
    found = [(states[..., lane], commands[..., lane]) for lane in range(WIDTH)]
    return [*found, *arcs(asked, stages, horizon / stages)] if asked.falls else found


def make_guesses(jobs: Sequence[Job], horizon: float, stages: int | None = None) -> tuple[Problem, Array, Array]:
    """Return the problem of as many `jobs` as lanes, and their guessed states and commands."""
    stages = stages or stages_of(horizon)[0]
    h = horizon / stages
    n = jobs[0].asked.rotors
    columns = [_columns(job, h) for job in jobs]
    timing, vehicle, numbers, style, limits, begin = (_side_by_side(some) for some in zip(*columns, strict=True))
    states, commands = lanes(stages + 1, SIZE + n), lanes(stages, n)
    states[0] = begin
    pumping(n)(stages, states, style, limits, timing, vehicle, states[1:], commands)
    for lane, job in enumerate(jobs):
        if leans(job.asked, job.style):
            states[..., lane], commands[..., lane] = lean_guess(job.asked, job.style, stages, h)
    return Problem(stages, timing, vehicle, numbers, _places(jobs, stages, h)), states, commands


def _begun(jobs: Sequence[Job], horizon: float, guesses: Sequence[Guess]) -> tuple[Problem, Array, Array]:
    """Return the problem of `jobs`, and their states and commands: `guesses`, which have as many stages."""
    stages = len(guesses[0][1])
    timing, vehicle, numbers = (
        _side_by_side(parts) for parts in zip(*(_problem(job.asked, horizon / stages) for job in jobs), strict=True)
    )
    states, commands = (lanes(*np.shape(part), width=len(jobs)) for part in guesses[0])
    for lane, guess in enumerate(guesses):
        states[..., lane], commands[..., lane] = guess
    problem = Problem(stages, timing, vehicle, numbers, _places(jobs, stages, horizon / stages))
    return problem, states, commands


def _places(jobs: Sequence[Job], stages: int, h: float) -> Array | None:
    """Return where the pivots are to be (stages + 1, 3, lanes), own units, if there are paths."""
    if not jobs[0].asked.structure.path:
        return None
    places = lanes(stages + 1, 3, width=len(jobs))
    places[:] = np.stack([job.asked.places(h * np.arange(stages + 1, dtype=float)) for job in jobs], axis=-1)
    return places


def _columns(job: Job, h: float) -> tuple[Any, ...]:
    """Return what `_problem` does, then style, rotor limits and start of a `job`, own units."""
    asked = job.asked
    style = styles(asked.vehicle, falls=asked.falls, hangs=bool(asked.end.y[2] < 0))[:, job.style]
    return *_problem(asked, h), style, asked.vehicle.rotor_limits / asked.units.force, asked.start


def _problem(asked: Request, h: float) -> tuple[Array, Array, Array]:
    """Return timing, vehicle and numbers of what is `asked`, own units, in stages of `h`."""
    vehicle, units = asked.vehicle, asked.units
    return np.array(step_timing(vehicle.rotor_lag / units.time, h)), units.numbers(vehicle), asked.numbers


def _side_by_side(columns: Sequence[Any]) -> Array:
    array = lanes(len(columns[0]), width=len(columns))
    array[:] = np.column_stack(columns)
    return array
