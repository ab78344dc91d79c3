"""Real-time iterations: what is left of a plan, solved again from where the flight is, one iteration at a time.

One iteration is that of `solver.Solver`, begun from the last one with its multipliers. Its first state is that of the
flight, so that only the first stage has a gap, which a full step closes. Two lanes differ in their damping; the better
one is kept. The barrier stays where it is: commands keep away from their limits, for feedback to use.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.compile.llvm.stagewise import lanes
from flypend.planning.coordinates import POSITION
from flypend.planning.equilibrium import hover_under
from flypend.planning.kernels import kernels
from flypend.planning.request import Request
from flypend.planning.scaled import size
from flypend.planning.solver import TURNS, Settings
from flypend.planning.wishes import HIGH, LOW, SHARED
from flypend.plants.lag import step_timing

WIDTH = 2
CAUTIOUS = 30.0  # ratio of the dampings of the two lanes
LENGTHS = (1.0, 0.4, 0.15)
BARRIER, FIRST_DAMPING, MOST_DAMPING = 3e-5, 1e-4, 1.0
# Of the excursion, where the flight has been farther out already.
SUNK = 0.05
MARGIN = 0.02  # of the ball's squared radius

Array = NDArray[np.float64]


class RealTime:
    """What is left of a plan, in own units about the target.

    Parameters
    ----------
    asked : Request
        What was planned.
    states : (stages + 1, 24 + n)
        Planned states and rotor forces.
    commands : (stages, n)
        Planned commands.
    stage : float
        Duration of a stage.
    planned : int
        Stage at which the flight is to hover. The horizon ends there, or `least` stages ahead, whichever is later.
    least : int
        Least number of stages of a horizon.

    Attributes
    ----------
    states, commands
        As above, lanes last; they are the best known.
    """

    def __init__(self, asked: Request, states: Array, commands: Array, stage: float, planned: int, least: int) -> None:
        n, many = asked.rotors, partial(lanes, width=WIDTH)
        self._k, self._set = kernels(n, asked.wishes, WIDTH), Settings(barrier=BARRIER)
        self._planned, self._least = planned, least
        k, shape, N = self._k, self._k.shape, len(commands)
        self.states, self.commands = many(*states.shape), many(N, n)
        self.states[:], self.commands[:] = states[..., None], commands[..., None]
        self._timing, self._numbers = many(4), many(len(asked.numbers))
        self._vehicle = many(size(n))
        self._timing[:] = step_timing(asked.vehicle.rotor_lag / asked.units.time, stage)[:, None]
        self._numbers[:], self._vehicle[:] = asked.numbers[:, None], asked.units.numbers(asked.vehicle)[:, None]
        self._weight_of_excursion = float(asked.numbers[SHARED])
        self._limits, self._damping, self._mu = many(3), many(2), many(1)
        self._limits[:] = self._numbers[LOW], self._numbers[HIGH], np.full(WIDTH, self._set.room)
        room = 0.005 * (self._limits[1] - self._limits[0])
        np.clip(self.commands, self._limits[0] + room, self._limits[1] - room, out=self.commands)
        self._mu[:], self._damp = BARRIER, FIRST_DAMPING
        self._shared, self._length, self._epsilon, self._new_shared = (many(1) for _ in range(4))
        self._weight, self._offset = many(1), many(k.end_size)
        self._weight[:] = self._set.end_weight
        self._slack, self._dual, self._trial, self._new_slack = (many(N, k.inequalities) for _ in range(4))
        self._s_step, self._z_step, self._shares = many(N, k.inequalities), many(N, k.inequalities), many(N, 2)
        self._A, self._B, self._d = many(N, shape.A.nnz()), many(N, shape.B.nnz()), many(N, shape.n)
        self._cost, self._to_go, self._gains = many(N, shape.of_stage), many(N + 1, shape.to_go), many(N, shape.gains)
        self._delta, self._upsilon, self._costate = many(N + 1, shape.n), many(N, shape.k), many(N, 1)
        self._summary, self._end, self._errors = many(N, 2), many(1, shape.to_go), many(1, k.end_size)
        self._hover = many(1, states.shape[1])
        self._new_states, self._new_commands = many(*states.shape), many(N, n)
        self._price, self._slack[:] = np.ones((2, WIDTH)), 0.1
        self._fit(0, N)
        self._value(0, N, self.states, self.commands, self._shared, self._slack, self._slack, 0.0)
        self._dual[:] = self._mu / self._slack

    def covers(self, first: int) -> bool:
        """Whether there is a horizon from stage `first` on."""
        return first + self._least <= len(self.commands)

    def horizon(self, first: int) -> int:
        """Return the number of stages of the horizon from stage `first` on."""
        return max(self._planned - first, self._least)

    def improve(self, first: int, state: Array, been: float, outside: Array) -> bool:
        """Do one iteration from stage `first` on, which begins at `state` (24 + n,).

        `been` is the largest distance from the target so far; `outside` (6,) are forces on vehicle and bob, weights,
        under which the end is hover. Returns whether the iteration succeeded; if not, everything is as before, but for
        the first state.
        """
        N = self.horizon(first)
        self._aim(outside)
        self.states[first] = state[:, None]
        self._fit(first, N)
        farther = self._shared[0, 0] > been**2
        self._numbers[SHARED] = self._weight_of_excursion * (1.0 if farther else SUNK)
        with np.errstate(all="ignore"):
            self._solve(first, N)
            return self._search(first, N)

    def _aim(self, outside: Array) -> None:
        """Let forces `outside` act, and hover under them be the end."""
        self._vehicle[-6:] = outside[:, None]
        self._hover[0] = hover_under(outside, self._vehicle[0, 0], self.commands.shape[1])[:, None]
        self._k.end(1, self._hover, self._numbers, self._weight, self._offset, self._errors, self._end)
        self._offset[:] = -self._errors[0]

    def _fit(self, first: int, N: int) -> None:
        """Let the ball hold all states."""
        most = float(np.max(np.sum(self.states[first : first + N + 1, POSITION, 0] ** 2, axis=1)))
        self._shared[0] = max(float(self._shared[0, 0]), (1 + MARGIN) * most + 1e-4)

    def _solve(self, first: int, N: int) -> None:
        k, states, commands = self._k, self.states[first:], self.commands[first:]
        slack, dual = self._slack[first:], self._dual[first:]
        self._damping[:] = self._damp * np.array([1.0, CAUTIOUS])
        self._damping[0] *= self._set.state_damping
        here = (states, commands, self._shared, slack, slack)
        self._value(first, N, *here, 0.0)
        middle = self._mu / slack[:N]
        np.clip(dual[:N], middle / self._set.spread, middle * self._set.spread, out=dual[:N])
        point = (states, commands, self._shared, self._numbers, self._vehicle)
        k.linearised(N, states, states[1:], commands, self._timing, self._vehicle, self._d, self._A, self._B)
        k.terms(N, *point, slack, dual, self._mu, self._cost)
        k.end(1, states[N:], self._numbers, self._weight, self._offset, self._errors, self._to_go[N:])
        k.backward(N, self._to_go[1:], self._A, self._B, self._d, self._cost, self._damping, self._to_go, self._gains)
        c, g = self._to_go[0, -3:-1]
        self._epsilon[0] = -g / c
        k.forward(
            N, self._delta, self._epsilon, self._A, self._B, self._d, self._gains, self._to_go[1:], self._delta[1:],
            self._upsilon, self._costate,
        )  # fmt: skip
        moves = (self._delta, self._upsilon, self._epsilon)
        k.steps(N, *point, slack, dual, self._mu, *moves, self._s_step, self._z_step, self._shares)
        of_gaps = np.max(self._costate[:N])
        of_wishes = np.max(dual[:N, k.exact :], initial=0.0)
        self._price[:] = np.maximum(1.0, 1.2 * np.array([[of_gaps], [of_wishes]]))

    def _search(self, first: int, N: int) -> bool:
        """Take the longest step that lets the merit fall, of the better lane."""
        states, commands, slack = self.states[first:], self.commands[first:], self._slack[first:]
        gap = np.sum(np.abs(self._d[:N]), axis=(0, 1))
        before = self._value(first, N, states, commands, self._shared, slack, slack, gap)
        turns, used = np.max(np.abs(self._delta[: N + 1, TURNS]), axis=(0, 1)), np.max(self._shares[:N], axis=0)
        longest, dual_length = np.fmin(1.0, self._set.room / used)
        most = np.fmin(longest, self._set.turn / turns)
        for wanted in LENGTHS:
            length = wanted * most
            self._fly(first, N, length)
            merit = self._value(
                first, N, self._new_states, self._new_commands, self._new_shared, self._trial, self._new_slack,
                (1 - length) * gap,
            )  # fmt: skip
            gain = np.where(np.isfinite(merit), before - merit, -np.inf)
            lane = int(np.argmax(gain))
            if gain[lane] > 0:
                self._take(first, N, lane, float(dual_length[lane]))
                self._damp = max(self._damp / 3, self._set.least_damping) if wanted == 1.0 else self._damp
                return True
        self._damp = min(self._damp * self._set.worse, MOST_DAMPING)
        return False

    def _take(self, first: int, N: int, lane: int, dual_length: float) -> None:
        one = slice(lane, lane + 1)
        self.states[first + 1 : first + N + 1] = self._new_states[1 : N + 1, :, one]
        self.commands[first : first + N] = self._new_commands[:N, :, one]
        self._slack[first : first + N] = self._new_slack[:N, :, one]
        self._dual[first : first + N] += dual_length * self._z_step[:N, :, one]
        self._shared[:] = self._new_shared[:, one]

    def _fly(self, first: int, N: int, length: Any) -> None:
        """Fly a step of this `length` (lanes,) into the new states and commands, with trial values of the slacks."""
        k, states, slack = self._k, self.states[first:], self._slack[first:]
        self._new_states[0], self._length[0] = states[0], length
        k.rollout(
            N, states, self.commands[first:], self._d, self._gains, self._new_states, self._length, self._epsilon,
            self._limits, self._timing, self._vehicle, self._new_states[1:], self._new_commands,
        )  # fmt: skip
        x = self._new_states[:N, POSITION]
        kept = np.sum(x * x, axis=1) + (1 - self._set.room) * slack[:N, k.exact - 1]
        self._new_shared[0] = np.maximum(self._shared[0] + length * self._epsilon[0], np.max(kept, axis=0))
        self._trial[:N, k.exact :] = slack[:N, k.exact :] + length * self._s_step[:N, k.exact :]

    def _value(
        self, first: int, N: int, states: Any, commands: Any, shared: Any, trial: Any, slack: Any, gap: Any
    ) -> Any:
        """Return the merit (lanes,), and write the slacks."""
        k = self._k
        k.values(N, states, commands, shared, self._numbers, self._vehicle, trial, self._mu, self._summary, slack)
        k.end(1, states[N:], self._numbers, self._weight, self._offset, self._errors, self._end)
        own, violation = np.sum(self._summary[:N], axis=0)
        missed = np.sum((self._errors[0] + self._offset) ** 2, axis=0)
        merit = self._numbers[SHARED] * shared[0] + own + self._weight[0] * missed / 2
        return merit + self._price[0] * gap + self._price[1] * violation
