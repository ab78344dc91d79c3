"""The solver: Gauss-Newton differential dynamic programming with a primal-dual barrier, one problem per lane.

Each iteration linearises all stages, solves the linear-quadratic problem by `riccati`, and flies its feedback through
the nonlinear equations, shortening the step until the merit falls. A guess may have gaps between its stages; a step of
length α leaves 1 − α of them. docs/planning/method.md derives it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend.building import built
from flypend.compile.llvm.stagewise import WIDTH, Stagewise, stagewise
from flypend.compile.llvm.stagewise import lanes as some_lanes
from flypend.model.state import SIZE
from flypend.planning.dynamics import ATTITUDE, LEAST_ROOM, POSITION, ROD, Array, Stage
from flypend.planning.inequalities import EFFORT, HIGH, LOW, SHARED, Barrier, Structure
from flypend.planning.problem import Request
from flypend.planning.riccati import Layout, backward, forward

# Of multipliers of the end: their step, as a share of weight and error; the error, in tolerances, beyond which the
# weight grows first; and the offset below which it falls.
ASCENT, FAR_OFF, PUSHED = 2.0, 1.5, 2.0


@dataclass(frozen=True)
class Programs:
    """What the solver calls; functions of the same names in the modules named here say what goes in and out."""

    layout: Layout
    inequalities: int  # their number,
    exact: int  # and that of the exact ones among them, which come first
    end_size: int  # number of errors at the end
    summary: int  # length of what `values` tells of a stage
    linearised: Stagewise  # of `dynamics.Stage`, as is `rollout`; of the derivatives it writes F
    rollout: Stagewise
    backward: Stagewise  # of `riccati`, as is `forward`
    forward: Stagewise
    values: Stagewise  # of `inequalities.Barrier`, as are the others
    terms: Stagewise
    steps: Stagewise
    end: Stagewise


@built(maxsize=64)
def programs(rotors: int, structure: Structure, *, lanes: bool) -> Programs:
    """Return the compiled programs for machines with this many `rotors`, and `structure`, from the cache if possible.

    They solve as many problems as `lanes`, a lane each, so that none is ever idle. Or else they solve a single one:
    many stages at a time where no stage takes from another, and the recursion fills the lanes with rows of matrices.
    """
    stage = Stage(rotors)
    barrier = Barrier(stage, structure)
    gap, A, B = stage.derivatives()
    curved = barrier.pattern
    pattern = curved + ca.Sparsity.diag(curved.size1())
    layout = Layout(A.sparsity(), B.sparsity(), pattern, 1 if lanes else WIDTH)
    each, in_turn = (stagewise, stagewise) if lanes else (partial(stagewise, abreast=True), partial(stagewise, width=1))
    return Programs(
        layout=layout,
        inequalities=barrier.inequalities,
        exact=barrier.exact,
        end_size=barrier.end_size,
        summary=3 + (structure.cost != ""),
        linearised=each(stage.linearise(gap, layout.slopes(A, B)), shared=(3, 4)),
        values=each(barrier.values(), shared=(2, 3, 4, 6)),
        terms=each(barrier.terms(layout), shared=(2, 3, 4, 7)),
        steps=each(barrier.steps(), shared=(2, 3, 4, 7, 10)),
        backward=backward(layout),
        forward=in_turn(forward(layout), shared=(1,)),
        rollout=in_turn(stage.rollout(), shared=(5, 6, 7, 8, 9)),
        end=in_turn(barrier.end(layout), shared=(1, 2, 3, 4)),
    )


def programs_of(asked: Request, *, lanes: bool = False) -> Programs:
    """Return the `programs` that solve what is `asked`."""
    return programs(asked.rotors, asked.structure, lanes=lanes)


@dataclass(frozen=True)
class Settings:
    """Numbers of the method, in the machine's own units, in which the cost is of order one."""

    barrier: float = 1e-3  # first μ,
    least_barrier: float = 1e-6  # last,
    cooling: float = 0.8  # and its factor after a good step
    damping: float = 3e-3  # of commands: first,
    least_damping: float = 1e-6  # least,
    most_damping: float = 1e6  # and largest
    state_damping: float = 0.1  # of states, as a share of that of commands
    worse: float = 8.0  # factor of the damping after a step that failed,
    better: float = 1 / 3  # and after one of at least
    long: float = 0.5  # this length
    shrinks: tuple[float, ...] = (0.4,) * 7  # factors of the step length, in turn, while the merit does not fall
    room: float = 0.9  # largest share of the room to a limit that one step takes
    turn: float = 2.0  # largest change of attitude or rod in one step, rad
    spread: float = 100.0  # largest ratio between a multiplier and μ/s, either way
    end_weight: float = 0.005  # of the squared errors at the end: first and least,
    most_end_weight: float = 50.0  # and largest
    missed: float = 0.5  # tolerances at the end, above which its weight grows at a barrier
    end_barrier: float = 1e-4  # below this,
    end_growth: float = 1.3  # by this factor per iteration
    multipliers: bool = False  # whether each error has a multiplier instead, so that the weight is the first
    plain: float = np.inf  # largest damping with which the change that a step predicts is measured; beyond it,
    credit: float = 0.0  # share of what the merit has fallen by, from step to step, that it may rise again
    relief: float = 1e-4  # barrier down to which a large e costs its logarithm, so that it does not outweigh the end
    inside: float = 0.02  # share of the range of a command by which guesses keep away from its limits
    slack: float = 0.1  # least, at first, of an inequality that need not be kept exactly
    margin: tuple[float, float] = (0.05, 0.05)  # of the ball beyond the farthest state: share of its square, and least


DEFAULT = Settings()


@dataclass(frozen=True)
class Problem:
    """What is to be planned, one problem per lane, in each machine's own units."""

    stages: int
    timing: Array  # of a stage, (4, lanes); see `plants.lag.step_timing`
    vehicle: Array  # numbers of the machines, (k, lanes); see `dynamics.Units.numbers`
    numbers: Array  # of the inequalities, (j, lanes); see `inequalities.Structure.slices`
    places: Array | None = None  # (stages + 1, 3, lanes): where the pivot is to be, with a path; else the origin

    @classmethod
    def of(cls, asked: Sequence[Request], stages: int, h: float) -> Problem:
        """Return the problem of what is `asked`, of the same structure, in so many `stages` of `h`, own units."""
        own = [(each.units.timing(each.vehicle, h), each.units.numbers(each.vehicle), each.numbers) for each in asked]
        timing, vehicle, numbers = map(side_by_side, zip(*own, strict=True))
        places = None
        if asked[0].structure.path:
            places = side_by_side([each.places(h * np.arange(stages + 1, dtype=float)) for each in asked])
        return cls(stages, timing, vehicle, numbers, places)

    @property
    def arrays(self) -> tuple[Array, ...]:
        """What differs between lanes."""
        own = (self.timing, self.vehicle, self.numbers)
        return own if self.places is None else (*own, self.places)


def side_by_side(arrays: Sequence[ArrayLike]) -> Array:
    """Return copies of `arrays` of one shape, each on a lane of its own."""
    found = some_lanes(*np.shape(arrays[0]), width=len(arrays))
    np.stack(arrays, axis=-1, out=found)
    return found


def one_lane(values: ArrayLike) -> Array:
    """Return a copy of `values` with a last axis of one lane."""
    return side_by_side([values])


class Scratch:
    """What an iteration of a solver writes before it reads it, for a number of `stages` on `width` lanes.

    Solvers that take turns share it: then it stays in the processor's cache.
    """

    def __init__(self, programs: Programs, stages: int, width: int) -> None:
        layout, k, of = programs.layout, programs.inequalities, partial(some_lanes, stages, width=width)
        one_more = partial(some_lanes, stages + 1, width=width)
        self.slopes, self.d, self.cost = of(layout.of_slopes), of(layout.n), of(layout.of_stage)
        self.to_go, self.gains, self.summary = one_more(layout.of_to_go), of(layout.of_gains), of(programs.summary)
        self.delta, self.upsilon = one_more(layout.n), of(layout.m)
        self.costate, self.s_step, self.z_step, self.shares = of(1), of(k), of(k), of(2)
        self.new_states, self.new_commands = one_more(SIZE + layout.m), of(layout.m)
        self.trial, self.new_slack = of(k), of(k)


class Measures(NamedTuple):
    """What the lanes of a solver have come to, (lanes,) each.

    `cost` is the merit with the weight of e as it was asked for, `value` excursion and effort with their weights,
    `lack` what inequalities lack, `gap` the sum of all gaps, `end` the largest error there in tolerances, and
    `barrier` is μ. Lanes that are `stuck` cannot be improved any more, whatever the damping. `change` is that of
    the cost in the linear-quadratic problem of the last step, whose damping would make it small anywhere, and is
    therefore `Settings.plain` at most: 0 where the conditions of first order hold.
    """

    cost: Array
    value: Array
    lack: Array
    gap: Array
    end: Array
    barrier: Array
    stuck: NDArray[np.bool_]
    change: Array


class Solver:
    """The state of the method on a `problem`, with `programs` for one problem or for as many as there are lanes.

    It begins with guessed `states` (stages + 1, 24 + n, lanes), with rotor forces, of which the first is the start and
    stays, and `commands` (stages, n, lanes); later they are the best so far. `settings` are the numbers of the method,
    and `scratch` is memory that is shared with other solvers.

    Attributes
    ----------
    merit, lack, gap, end : (lanes,)
        Merit, sum of what inequalities lack, sum of all gaps, and largest error at the end in tolerances.
    change : (lanes,)
        See `Measures`.
    shared, damping : (lanes,)
        The squared radius e of the ball, and the damping of the commands.
    """

    def __init__(
        self, programs: Programs, problem: Problem, states: Array, commands: Array, settings: Settings = DEFAULT,
        scratch: Scratch | None = None,
    ) -> None:  # fmt: skip
        self._k, self._problem, self._set = programs, problem, settings
        self._stages = slice(0, problem.stages)
        N, k, width = problem.stages, programs.inequalities, states.shape[-1]
        lanes = partial(some_lanes, width=width)
        self.states, self.commands = states, commands
        self._limits, self._asked = lanes(3), lanes(1)
        self._mu, self._shared, self._length = lanes(1), lanes(1), lanes(1)
        self._damping, self._weight, self._offset = lanes(2), lanes(1), lanes(programs.end_size)
        self.shared, self.damping = self._shared[0], self._damping[1]
        self._slack, self._dual, self._hover = lanes(N, k), lanes(N, k), lanes(1, states.shape[1])
        self._epsilon, self._new_shared, self._errors = lanes(1), lanes(1), lanes(programs.end_size)
        self._price, self._w = np.ones((2, width)), scratch or Scratch(programs, N, width)
        self.merit, self.lack, self.gap, self.end = (np.full(width, np.inf) for _ in range(4))
        self._wished, self.change = np.zeros(width), np.full(width, np.inf)  # the cost of one's own
        self._credit = np.zeros(width)
        self._connect()
        self._begin(slice(None))

    def _connect(self) -> None:
        """Give the programs the arrays that they work on."""
        k, p, w = self._k, self._problem, self._w
        here = (self.states, self.commands, self._shared, p.numbers, p.vehicle)
        there = (w.new_states, w.new_commands, self._new_shared, p.numbers, p.vehicle)
        moves, places = (w.delta, w.upsilon, self._epsilon), () if p.places is None else (p.places,)
        slack, dual, to_go, d, F = self._slack, self._dual, w.to_go, w.d, w.slopes
        at_end = (p.numbers, self._weight, self._offset, self._errors, to_go)
        self._linearise = k.linearised.on(self.states, self.states[1:], self.commands, p.timing, p.vehicle, d, F)
        self._add_terms = k.terms.on(*here, slack, dual, self._mu, *places, w.cost)
        self._back = k.backward.on(to_go[1:], F, d, w.cost, self._damping, to_go, w.gains)
        self._ahead = k.forward.on(w.delta, self._epsilon, F, d, w.gains, to_go[1:], w.delta[1:], w.upsilon, w.costate)
        self._along = k.steps.on(*here, slack, dual, self._mu, *moves, *places, w.s_step, w.z_step, w.shares)
        self._roll = k.rollout.on(
            self.states, self.commands, d, w.gains, w.new_states, self._length, self._epsilon, self._limits,
            p.timing, p.vehicle, w.new_states[1:], w.new_commands,
        )  # fmt: skip
        self._values = (
            k.values.on(*here, slack, self._mu, *places, w.summary, slack),
            k.values.on(*there, w.trial, self._mu, *places, w.summary, w.new_slack),
        )
        self._ends = k.end.on(self.states, *at_end), k.end.on(w.new_states, *at_end)
        self._end_in_hover = k.end.on(self._hover, *at_end)

    def take(self, lane: int, problem: Problem, states: Array, commands: Array, source: int) -> None:
        """Begin another problem on a `lane`: that on the lane `source` of `problem`, `states` and `commands`."""
        own = (self.states, self.commands, *self._problem.arrays)
        for old, new in zip(own, (states, commands, *problem.arrays), strict=True):
            old[..., lane] = new[..., source]
        self._begin(lane)

    def _begin(self, on: Any) -> None:
        """Begin on the lanes `on`, with the guessed states and commands that are there."""
        settings, numbers = self._set, self._problem.numbers
        low, high = numbers[LOW, on], numbers[HIGH, on]
        self._asked[0, on] = numbers[SHARED, on]
        self._limits[0, on], self._limits[1, on], self._limits[2, on] = low, high, settings.room
        inside = settings.inside * (high - low)
        self.commands[..., on] = np.clip(self.commands[..., on], low + inside, high - inside)
        self._mu[..., on], self._weight[..., on], self._offset[..., on] = settings.barrier, settings.end_weight, 0.0
        self._damping[0, on], self._damping[1, on] = settings.state_damping * settings.damping, settings.damping
        self._shared[0, on] = 0.0
        self._fit(on)
        self._slack[..., on], self._price[:, on], self._credit[on] = settings.slack, 1.0, 0.0
        for measured in (self.merit, self.lack, self.gap, self.end):
            measured[on] = np.inf
        # In the other lanes slacks are what they were.
        with np.errstate(all="ignore"):
            self._value(new=False, gap=0.0)
        self._dual[..., on] = self._mu[..., on] / self._slack[..., on]

    def iterate(self, lane: int) -> tuple[Array, Array]:
        """Return copies of the states (stages + 1, 24 + n) and commands (stages, n) of a `lane`."""
        return self.states[self._after, :, lane].copy(), self.commands[self._stages, :, lane].copy()

    @property
    def _after(self) -> slice:
        """Where states of the stages are, with the last."""
        return slice(self._stages.start, self._stages.stop + 1)

    @property
    def measures(self) -> Measures:
        """What the lanes have come to."""
        numbers, asked = self._problem.numbers, self._asked[0]
        cost = self.merit + (asked - numbers[SHARED]) * self.shared
        excursion = np.sqrt(np.max(self._squared_distances(self.states, self._after), axis=0))
        effort = numbers[EFFORT] * np.sum((self.commands[self._stages] - 1) ** 2, axis=(0, 1)) / 2
        value = asked * excursion**2 + effort + self._wished
        stuck = self.damping >= self._set.most_damping
        return Measures(cost, value, self.lack, self.gap, self.end, self._mu[0], stuck, self.change)

    def insist(self, place: int, weight: float, on: Any) -> None:
        """Set the number at `place` of the inequalities, a `weight`, in the lanes `on`."""
        self._problem.numbers[place, on] = weight

    def aim(self, vehicle: Array, hover: Array, force: float) -> None:
        """Let `vehicle` (k, lanes) be its numbers, and `hover` (24 + n, lanes) the end.

        Rotor forces are in a new unit, whose ratio to the old one is `force`.
        """
        if force != 1:
            limits = self._limits[:2], self._problem.numbers[LOW : HIGH + 1]
            for forces in (self.states[:, SIZE:], self.commands, *limits):
                forces /= force
        self._problem.vehicle[:], self._hover[0] = vehicle, hover
        self._end_in_hover(0, 1)
        np.negative(self._errors, out=self._offset)

    def restart(self, stages: slice, state: Array) -> None:
        """Go on with `stages` only, from `state` (24 + n, lanes): the ball holds all states, and slacks are theirs."""
        self._stages, self.states[stages.start] = stages, state
        self._fit(slice(None))
        self._values[False](stages.start, stages.stop - stages.start)

    def improve(self) -> None:
        """Do one iteration, and adapt damping, barrier and weights to its step."""
        early = np.minimum(1.0, self._mu[0] / self._set.relief)
        self._problem.numbers[SHARED] = self._asked[0] / (1 + early * self.shared)
        self._adapt(self.step()[0])

    def step(self) -> tuple[Array, Array]:
        """Take a step; return its length (lanes,), 0 where the merit did not fall, and the most."""
        with np.errstate(all="ignore"):
            self._solve()
            return self._search()

    def _solve(self) -> None:
        """Solve the linear-quadratic problem about what is known."""
        stages, w, spread = self._stages, self._w, self._set.spread
        first, N = stages.start, stages.stop - stages.start
        middle, dual = self._mu / self._slack[stages], self._dual[stages]
        np.maximum(dual, middle / spread, out=dual)
        np.minimum(dual, middle * spread, out=dual)
        self._linearise(first, N)
        self._add_terms(first, N)
        self._ends[False](first + N, 1)
        damping = self.damping.copy()
        self.damp(np.minimum(damping, self._set.plain))
        c, g, v = self._recur()
        self.change = np.abs(g * g / (2 * c) - v)
        if np.any(damping > self._set.plain):
            self.damp(damping)
            c, g, _ = self._recur()
        self._epsilon[0], w.delta[first] = -g / c, 0.0
        self._ahead(first, N)
        self._along(first, N)
        self.gap = np.abs(w.d[stages]).sum(axis=(0, 1))
        # Above all multipliers, so that neither gaps nor violations are worth it.
        self._price[0] = w.costate[stages].max(axis=(0, 1))
        self._price[1] = dual[:, self._k.exact :].max(axis=(0, 1), initial=0.0)
        self._price = np.maximum(1.0, 1.2 * self._price)
        self.merit, self.lack, self.end, self._wished = self._value(new=False, gap=self.gap)

    def _recur(self) -> Array:
        """Go backward through the stages; return c, g and v (3, lanes) of the cost to go from the first."""
        first, c = self._stages.start, self._k.layout.of_shared
        self._back(first, self._stages.stop - first)
        found: Array = self._w.to_go[first, c : c + 3]
        return found

    def _search(self) -> tuple[Array, Array]:
        """Shorten the step until the merit falls, lane by lane, and take it. Returns as `step`."""
        settings, w, stages, after = self._set, self._w, self._stages, self._after
        turns = np.maximum(*(np.abs(w.delta[after, turning]).max(axis=(0, 1)) for turning in (ATTITUDE, ROD)))
        longest, dual_length = np.fmin(1.0, settings.room / w.shares[stages].max(axis=0))
        length = most = np.fmin(longest, settings.turn / turns)
        found = np.zeros(len(length), dtype=bool)
        # A step along the ball, which must hold every state, is not straight: the merit may rise before it falls.
        allowed = self.merit + np.where(self.damping > settings.plain, self._credit, 0.0)
        for factor in (1.0, *settings.shrinks):
            length = np.where(found, length, factor * length)
            self._fly(length)
            gap = (1 - length) * self.gap
            merit, lack, end, wished = self._value(new=True, gap=gap)
            found |= merit < allowed
            if found.all():
                break
        np.copyto(self._credit, settings.credit * (self._credit + self.merit - merit), where=found)
        pairs = (
            (self.states[after], w.new_states[after]), (self.commands[stages], w.new_commands[stages]),
            (self._shared, self._new_shared), (self._slack[stages], w.new_slack[stages]),
            (self._dual[stages], self._dual[stages] + dual_length * w.z_step[stages]),
            (self.merit, merit), (self.lack, lack), (self.gap, gap), (self.end, end), (self._wished, wished),
        )  # fmt: skip
        for old, new in pairs:
            np.copyto(old, new, where=found)
        return np.where(found, length, 0.0), most

    def _fly(self, length: Array) -> None:
        """Fly a step of this `length` (lanes,) into the new states and commands, with trial values of the slacks."""
        stages, exact, w = self._stages, self._k.exact, self._w
        first, slack = stages.start, self._slack[stages]
        w.new_states[first], self._length[0] = self.states[first], length
        self._roll(first, stages.stop - first)
        # The ball grows if need be, so that its slack keeps the same share as those of the commands.
        room = np.maximum((1 - self._set.room) * slack[:, exact - 1], LEAST_ROOM)
        kept = self._squared_distances(w.new_states, stages) + room
        self._new_shared[0] = np.maximum(self.shared + length * self._epsilon[0], kept.max(axis=0))
        w.trial[stages, exact:] = slack[:, exact:] + length * w.s_step[stages, exact:]

    def _value(self, *, new: bool, gap: Array | float) -> tuple[Array, Array, Array, Array]:
        """Return merit, lack, largest error at the end and cost of one's own, (lanes,) each, and write the slacks.

        They are those of the `new` states and commands, or of the old ones.
        """
        p, stages, shared = self._problem, self._stages, self._new_shared if new else self._shared
        self._values[new](stages.start, stages.stop - stages.start)
        self._ends[new](stages.stop, 1)
        own, violation, lack, *wished = self._w.summary[stages].sum(axis=0)
        missed = ((self._errors + self._offset) ** 2).sum(axis=0)
        merit = p.numbers[SHARED] * shared[0] + own + self._weight[0] * missed / 2
        merit += self._price[0] * gap + self._price[1] * violation
        return merit, lack, np.abs(self._errors).max(axis=0), wished[0] if wished else np.zeros_like(own)

    def _adapt(self, length: Array) -> None:
        """Adapt damping, barrier and weight of the end to the `length` of the step."""
        settings = self._set
        damping = np.where(length >= settings.long, settings.better * self.damping, self.damping)
        damping = np.where(length < 0.2, settings.worse * damping, damping)
        self.damp(np.clip(damping, settings.least_damping, settings.most_damping))
        cooled = np.maximum(settings.cooling * self._mu[0], settings.least_barrier)
        self._mu[0] = np.where(length >= 0.3, cooled, self._mu[0])
        if settings.multipliers:
            self._yield(length)
        else:
            missed = (self.end > settings.missed) & (self._mu[0] <= settings.end_barrier)
            grown = np.minimum(settings.end_growth * self._weight[0], settings.most_end_weight)
            self._weight[0] = np.where(missed, grown, self._weight[0])

    def _yield(self, length: Array) -> None:
        """Let errors at the end come as near to their tolerances as the cost wants them, by a multiplier for each.

        The offset is the multiplier over the weight, which grows where errors are far too large, and falls again. After
        a step shorter than 1 it changes by as much less, or it would run ahead of the errors.
        """
        settings, size, pushed = self._set, np.abs(self._errors), np.abs(self._offset)
        pushed = np.maximum(0.0, pushed + ASCENT * length * (size - settings.missed))
        far, near = self.end > FAR_OFF, pushed.max(axis=0) < PUSHED
        factor = np.where(far, settings.end_growth, np.where(near, 1 / settings.end_growth, 1.0))
        before = self._weight[0].copy()
        self._weight[0] = np.clip(factor * before, settings.end_weight, settings.most_end_weight)
        self._offset[:] = np.sign(self._errors) * pushed * (before / self._weight[0])

    def _squared_distances(self, states: Array, stages: slice) -> Array:
        """Return the squared distances (k, lanes) of the pivot from where it is to be, at the beginning of `stages`."""
        places, x = self._problem.places, states[stages, POSITION]
        x = x if places is None else x - places[stages]
        distances: Array = (x * x).sum(axis=1)
        return distances

    def _fit(self, on: Any) -> None:
        """Let the ball hold all states, in the lanes `on`."""
        share, more = self._set.margin
        most = self._squared_distances(self.states, self._after).max(axis=0)[on]
        self.shared[on] = np.maximum(self.shared[on], (1 + share) * most + more)

    def damp(self, damping: Array) -> None:
        """Set the `damping` (lanes,) of commands, and of states in proportion."""
        self._damping[:] = self._set.state_damping * damping, damping
