"""The solver: Gauss-Newton differential dynamic programming with a primal-dual barrier, one problem per lane.

Each iteration linearises all stages, solves the linear-quadratic problem by `riccati`, and flies its feedback through
the nonlinear equations, shortening the step until the merit falls. A guess may have gaps between its stages; a step of
length α leaves 1 − α of them. docs/planning/limit.md derives it.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.compile.llvm.stagewise import lanes as some_lanes
from flypend.planning.coordinates import ATTITUDE, POSITION, ROD
from flypend.planning.inequalities import EFFORT, HIGH, LOW, SHARED
from flypend.planning.kernels import Kernels
from flypend.planning.method import Lanes, Problem, Scratch, Settings
from flypend.planning.stage import LEAST_ROOM


class Solver:
    """The state of the method on a `problem`, beginning with guessed states and commands.

    Parameters
    ----------
    kernels : Kernels
        The compiled programs, for one problem or for as many as there are lanes.
    problem : Problem
        The problem.
    states : (stages + 1, 24 + n, lanes)
        Guessed states and rotor forces; the first is the start and stays.
    commands : (stages, n, lanes)
        Guessed commands.
    settings : Settings
        Numbers of the method.
    scratch : Scratch, optional
        Memory that is shared with other solvers.

    Attributes
    ----------
    states, commands
        The best so far.
    merit, violation, gap, end : (lanes,)
        Merit, sum of what inequalities lack, sum of all gaps, and largest error at the end in tolerances.
    cost : (lanes,)
        The merit with the weight of e as it was asked for.
    promise : (lanes,)
        By how much the linear-quadratic problem expected the merit to fall at the last step.
    """

    def __init__(
        self, kernels: Kernels, problem: Problem, states: Lanes, commands: Lanes, settings: Settings | None = None,
        scratch: Scratch | None = None,
    ) -> None:  # fmt: skip
        self._k, self._problem = kernels, problem
        self._set = settings = settings or Settings()
        N, k, self.width = problem.stages, kernels.inequalities, states.shape[-1]
        lanes = partial(some_lanes, width=self.width)
        self.states, self.commands = states, commands
        self._limits, self._asked = lanes(3), lanes(1)
        self._mu, self._shared, self._length = lanes(1), lanes(1), lanes(1)
        self._damping, self._weight, self._offset = lanes(2), lanes(1), lanes(kernels.end_size)
        self._slack, self._dual = lanes(N, k), lanes(N, k)
        self._epsilon, self._new_shared, self._errors = lanes(1), lanes(1), lanes(1, kernels.end_size)
        self._price, self._w = np.ones((2, self.width)), scratch or Scratch(kernels, N, self.width)
        self.merit, self.violation, self.gap, self.end, self.promise = (np.full(self.width, np.inf) for _ in range(5))
        self._connect()
        self._begin(slice(None))

    def _connect(self) -> None:
        """Give the programs the arrays that they work on."""
        k, p, w, N = self._k, self._problem, self._w, self._problem.stages
        here = (self.states, self.commands, self._shared, p.numbers, p.vehicle)
        there = (w.new_states, w.new_commands, self._new_shared, p.numbers, p.vehicle)
        moves, places = (w.delta, w.upsilon, self._epsilon), () if p.places is None else (p.places,)
        slack, dual, to_go, d, slopes = self._slack, self._dual, w.to_go, w.d, w.slopes
        at_end = (p.numbers, self._weight, self._offset, self._errors)
        self._linearise = k.linearised.on(
            self.states, self.states[1:], self.commands, p.timing, p.vehicle, d, *slopes
        )  # fmt: skip
        self._add_terms = k.terms.on(*here, slack, dual, self._mu, *places, w.cost)
        self._add_end = k.end.on(self.states[N:], *at_end, to_go[N:])
        self._back = k.backward.on(to_go[1:], *slopes, d, w.cost, self._damping, to_go, w.gains)
        self._ahead = k.forward.on(
            w.delta, self._epsilon, *slopes, d, w.gains, to_go[1:], w.delta[1:], w.upsilon, w.costate
        )  # fmt: skip
        self._along = k.steps.on(
            *here, slack, dual, self._mu, *moves, *places, w.s_step, w.z_step, w.shares
        )  # fmt: skip
        self._roll = k.rollout.on(
            self.states, self.commands, d, w.gains, w.new_states, self._length, self._epsilon, self._limits,
            p.timing, p.vehicle, w.new_states[1:], w.new_commands,
        )  # fmt: skip
        self._measured = (
            (
                k.values.on(*here, slack, self._mu, *places, w.summary, slack),
                k.end.on(self.states[N:], *at_end, w.end),
            ),
            (
                k.values.on(*there, w.trial, self._mu, *places, w.summary, w.new_slack),
                k.end.on(w.new_states[N:], *at_end, w.end),
            ),
        )

    def take(self, lane: int, problem: Problem, states: Lanes, commands: Lanes, source: int) -> None:
        """Begin another problem on a `lane`: that on the lane `source` of `problem`, `states` and `commands`."""
        own = (self.states, self.commands, *self._problem.arrays)
        for old, new in zip(own, (states, commands, *problem.arrays), strict=True):
            old[..., lane] = new[..., source]
        self._begin(lane)

    def _begin(self, on: Any) -> None:
        """Begin on the lanes `on`, with the guessed states and commands that are there."""
        settings, numbers = self._set, self._problem.numbers
        self._asked[0, on] = numbers[SHARED, on]
        self._limits[0, on], self._limits[1, on], self._limits[2, on] = (
            numbers[LOW, on],
            numbers[HIGH, on],
            settings.room,
        )
        inside = 0.02 * (numbers[HIGH, on] - numbers[LOW, on])
        low, high = numbers[LOW, on] + inside, numbers[HIGH, on] - inside
        self.commands[..., on] = np.clip(self.commands[..., on], low, high)
        self._mu[..., on], self._weight[..., on], self._offset[..., on] = settings.barrier, settings.end_weight, 0.0
        self._damping[0, on], self._damping[1, on] = settings.state_damping * settings.damping, settings.damping
        self._shared[0, on] = 1.05 * np.max(self._squared(self.states), axis=0)[on] + 0.05
        self._slack[..., on], self._price[:, on] = 0.1, 1.0
        for measured in (self.merit, self.violation, self.gap, self.end):
            measured[on] = np.inf
        # In the other lanes slacks are what they were.
        self._value(False, 0.0)
        self._dual[..., on] = self._mu[..., on] / self._slack[..., on]

    def iterate(self, lane: int) -> tuple[Lanes, Lanes]:
        """Return copies of the states (stages + 1, 24 + n) and commands (stages, n) of a `lane`."""
        return self.states[:, :, lane].copy(), self.commands[:, :, lane].copy()

    @property
    def excursion(self) -> Lanes:
        """Largest distance of the pivot from where it is to be, at the stages, (lanes,)."""
        distance: Lanes = np.sqrt(np.max(self._squared(self.states), axis=0))
        return distance

    @property
    def barrier(self) -> Lanes:
        """The barrier parameter μ, (lanes,)."""
        mu: Lanes = self._mu[0]
        return mu

    @property
    def cost(self) -> Lanes:
        """See the class."""
        own: Lanes = self.merit + (self._asked[0] - self._problem.numbers[SHARED]) * self._shared[0]
        return own

    @property
    def value(self) -> Lanes:
        """Excursion and effort with their weights, (lanes,)."""
        own: Lanes = self._asked[0] * self.excursion**2 + self.effort
        return own

    @property
    def stuck(self) -> NDArray[np.bool_]:
        """Which lanes cannot be improved any more, whatever the damping, (lanes,)."""
        stuck: NDArray[np.bool_] = self._damping[1] >= self._set.most_damping
        return stuck

    @property
    def effort(self) -> Lanes:
        """Sum over the stages of the cost of the commands, (lanes,)."""
        own: Lanes = self._problem.numbers[EFFORT] * np.sum((self.commands - 1) ** 2, axis=(0, 1)) / 2
        return own

    def measure(self) -> None:
        """Measure violation, gap and end of the states and commands as they are."""
        self._linearise(0, self._problem.stages)
        self.gap = np.sum(np.abs(self._w.d), axis=(0, 1))
        self.merit, self.violation, self.end = self._value(False, self.gap)

    def insist(self, place: int, weight: float, on: Any) -> None:
        """Set the number at `place` of the inequalities, a `weight`, in the lanes `on`."""
        self._problem.numbers[place, on] = weight

    def improve(self) -> None:
        """Do one iteration."""
        k, p, N = self._k, self._problem, self._problem.stages
        early = np.minimum(1.0, self._mu[0] / self._set.relief)
        p.numbers[SHARED] = self._asked[0] / (1 + early * self._shared[0])
        self._linearise(0, N)
        self._add_terms(0, N)
        self._add_end(0, 1)
        self._back(0, N)
        c, g, v = self._w.to_go[0, k.of_shared : k.of_shared + 3]
        self._epsilon[0] = -g / c
        self.promise = g * g / (2 * c) - v
        self._ahead(0, N)
        self._along(0, N)
        self.gap = np.sum(np.abs(self._w.d), axis=(0, 1))
        self._price = self._prices()
        self.merit, self.violation, self.end = self._value(False, self.gap)
        self._search()

    def _prices(self) -> Lanes:
        """Return the prices (2, lanes) of gaps and violations: above all multipliers, so that neither is worth it."""
        dual = np.max(self._dual[:, self._k.exact :], axis=(0, 1), initial=0.0)
        return np.maximum(1.0, 1.2 * np.array([np.max(self._w.costate, axis=(0, 1)), dual]))

    def _search(self) -> None:
        """Shorten the step until the merit falls, lane by lane, and take it."""
        settings = self._set
        turns = np.max(np.abs(self._w.delta[:, TURNS]), axis=(0, 1))
        used = np.max(self._w.shares, axis=0)
        with np.errstate(divide="ignore", invalid="ignore"):
            longest, dual_length = np.fmin(1.0, settings.room / used)
            length = np.fmin(longest, settings.turn / turns)
        found = np.zeros(self.width, dtype=bool)
        for _ in range(settings.attempts):
            self._fly(length)
            gap = (1 - length) * self.gap
            merit, violation, end = self._value(True, gap)
            found |= merit < self.merit
            if np.all(found):
                break
            length = np.where(found, length, settings.shrink * length)
        pairs = (
            (self.states, self._w.new_states), (self.commands, self._w.new_commands), (self._shared, self._new_shared),
            (self._slack, self._w.new_slack),
        )  # fmt: skip
        for old, new in pairs:
            np.copyto(old, new, where=found)
        self.merit, self.violation = np.where(found, merit, self.merit), np.where(found, violation, self.violation)
        self.gap, self.end = np.where(found, gap, self.gap), np.where(found, end, self.end)
        self._dual += np.where(found, dual_length, 0.0) * self._w.z_step
        self._adapt(np.where(found, length, 0.0))

    def _fly(self, length: Lanes) -> None:
        """Fly a step of this `length` (lanes,) into the new states and commands, with trial values of the slacks."""
        k, N = self._k, self._problem.stages
        self._w.new_states[0], self._length[0] = self.states[0], length
        self._roll(0, N)
        # The ball grows if need be, so that its slack keeps the same share as those of the commands.
        room = np.maximum((1 - self._set.room) * self._slack[:, k.exact - 1], LEAST_ROOM)
        kept = self._squared(self._w.new_states[:N]) + room
        self._new_shared[0] = np.maximum(self._shared[0] + length * self._epsilon[0], np.max(kept, axis=0))
        self._w.trial[:, k.exact :] = self._slack[:, k.exact :] + length * self._w.s_step[:, k.exact :]

    def _value(self, new: bool, gap: Lanes | float) -> tuple[Lanes, Lanes, Lanes]:
        """Return merit, violation and largest error at the end, each (lanes,), and write the slacks.

        They are those of the `new` states and commands, or of the old ones.
        """
        p, shared = self._problem, self._new_shared if new else self._shared
        values, end = self._measured[new]
        values(0, p.stages)
        end(0, 1)
        own, violation = np.sum(self._w.summary, axis=0)
        with np.errstate(over="ignore", invalid="ignore"):
            missed = np.sum((self._errors[0] + self._offset) ** 2, axis=0)
            merit = p.numbers[SHARED] * shared[0] + own + self._weight[0] * missed / 2
            merit += self._price[0] * gap + self._price[1] * violation
        return merit, violation, np.max(np.abs(self._errors[0]), axis=0)

    def _adapt(self, length: Lanes) -> None:
        """Adapt damping and barrier to the `length` of the step, and keep the multipliers near μ/s."""
        settings = self._set
        damping = self._damping[1]
        damping = np.where(length >= 0.5, settings.better * damping, damping)
        damping = np.where(length < 0.2, settings.worse * damping, damping)
        self._damp(np.clip(damping, settings.least_damping, settings.most_damping))
        cooled = np.maximum(settings.cooling * self._mu[0], settings.least_barrier)
        self._mu[0] = np.where(length >= 0.3, cooled, self._mu[0])
        missed = (self.end > MISSED) & (self._mu[0] <= settings.end_barrier)
        grown = np.minimum(settings.end_growth * self._weight[0], settings.most_end_weight)
        self._weight[0] = np.where(missed, grown, self._weight[0])
        middle = self._mu / self._slack
        np.clip(self._dual, middle / settings.spread, middle * settings.spread, out=self._dual)

    def _squared(self, states: Lanes) -> Lanes:
        """Return the squared distances (k, lanes) of the pivot from where it is to be, at the first k stages."""
        places, x = self._problem.places, states[:, POSITION]
        x = x if places is None else x - places[: len(x)]
        distances: Lanes = np.sum(x * x, axis=1)
        return distances

    def _damp(self, damping: Lanes) -> None:
        self._damping[:] = self._set.state_damping * damping, damping


MISSED = 0.5  # tolerances at the end, above which its weight grows
# Coordinates that turn: attitude and rod.
TURNS = [*range(ATTITUDE.start, ATTITUDE.stop), *range(ROD.start, ROD.stop)]
