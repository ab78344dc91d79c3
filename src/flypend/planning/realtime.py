"""Real-time iterations: what is left of a plan, solved again from where the flight is, one iteration at a time.

One iteration is that of `solver.Solver`, begun from the last one with its multipliers. Its first state is that of the
flight, so that only the first stage has a gap, which a full step closes. The barrier stays where it is: commands keep
away from their limits, for feedback to use.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.compile.llvm.stagewise import lanes
from flypend.planning.coordinates import ATTITUDE, POSITION, ROD
from flypend.planning.equilibrium import hover_under
from flypend.planning.inequalities import HIGH, LOW, SHARED
from flypend.planning.method import Settings
from flypend.planning.request import Request
from flypend.planning.scaled import size
from flypend.planning.single import single
from flypend.plants.lag import step_timing

LENGTHS = (1.0, 0.4, 0.15)
BARRIER, FIRST_DAMPING, MOST_DAMPING = 3e-5, 3e-3, 1.0
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
        Least number of stages of a horizon, at least `stagewise.WIDTH`.

    Attributes
    ----------
    states, commands
        As above; they are the best known.
    """

    def __init__(self, asked: Request, states: Array, commands: Array, stage: float, planned: int, least: int) -> None:
        n, N = asked.rotors, len(commands)
        k = single(n, asked.structure)
        self._set, self._exact, self._of_shared = Settings(barrier=BARRIER), k.exact, k.of_shared
        self._planned, self._least = planned, least
        self.states, self.commands = _numbers(*states.shape), _numbers(N, n)
        self.states[:], self.commands[:] = states, commands
        self._numbers, self._vehicle, self._timing = _numbers(len(asked.numbers)), _numbers(size(n)), _numbers(4)
        self._numbers[:], self._vehicle[:] = asked.numbers, asked.units.numbers(asked.vehicle)
        self._timing[:] = step_timing(asked.vehicle.rotor_lag / asked.units.time, stage)
        self._weight_of_excursion = float(asked.numbers[SHARED])
        self._limits, self._damping, self._mu, self._weight = (_numbers(i) for i in (3, 2, 1, 1))
        self._limits[:] = asked.numbers[LOW], asked.numbers[HIGH], self._set.room
        room = 0.005 * (self._limits[1] - self._limits[0])
        np.clip(self.commands, self._limits[0] + room, self._limits[1] - room, out=self.commands)
        self._mu[:], self._weight[:], self._damp, self._price = BARRIER, self._set.end_weight, FIRST_DAMPING, (1.0, 1.0)
        self._shared, self._length, self._epsilon, self._new_shared = (_numbers(1) for _ in range(4))
        self._offset, self._errors, self._hover = _numbers(k.end_size), _numbers(k.end_size), _numbers(1, 24 + n)
        self._new_states, self._new_commands = _numbers(*states.shape), _numbers(N, n)
        self._connect(k, N)
        self._slack[:] = 0.1
        self._fit(0, N)
        self._merit(0, N, 0.0)
        self._dual[:] = BARRIER / self._slack

    def _connect(self, k: Any, N: int) -> None:
        """Give the programs `k` the arrays of N stages that they work on."""
        shape = k.shape
        g, n, ends = k.inequalities, shape.n, _numbers(1, k.to_go)
        slack, dual, trial, new_slack, s_step, z_step = (_numbers(N, g) for _ in range(6))
        F, d, cost = _numbers(N, *k.slopes), _numbers(N, n), _numbers(N, k.of_stage)
        to_go, gains, costate = _numbers(N + 1, k.to_go), _numbers(N, shape.gains), _numbers(N, 1)
        delta, upsilon, shares, summary = _numbers(N + 1, n), _numbers(N, shape.k), _numbers(N, 2), _numbers(N, 2)
        numbers, vehicle, epsilon = self._numbers, self._vehicle, self._epsilon
        here = (self.states, self.commands, self._shared, numbers, vehicle)
        there = (self._new_states, self._new_commands, self._new_shared, numbers, vehicle)
        at_end = (numbers, self._weight, self._offset, self._errors)
        self._linearise = k.linearised.on(
            self.states, self.states[1:], self.commands, self._timing, vehicle, d, F
        )  # fmt: skip
        self._terms = k.terms.on(*here, slack, dual, self._mu, cost)
        self._end = k.end.on(self.states, *at_end, to_go)
        self._new_end = k.end.on(self._new_states, *at_end, to_go)
        self._end_in_hover = k.end.on(self._hover, *at_end, ends)
        self._backward = k.backward.on(to_go[1:], F, d, cost, self._damping, to_go, gains)
        self._forward = k.forward.on(delta, epsilon, F, d, gains, to_go[1:], delta[1:], upsilon, costate)
        self._steps = k.steps.on(*here, slack, dual, self._mu, delta, upsilon, epsilon, s_step, z_step, shares)
        self._rollout = k.rollout.on(
            self.states, self.commands, d, gains, self._new_states, self._length, epsilon, self._limits, self._timing,
            vehicle, self._new_states[1:], self._new_commands,
        )  # fmt: skip
        self._values = k.values.on(*here, slack, self._mu, summary, slack)
        self._new_values = k.values.on(*there, trial, self._mu, summary, new_slack)
        self._slack, self._dual, self._trial, self._new_slack = slack, dual, trial, new_slack
        self._s_step, self._z_step, self._shares, self._summary = s_step, z_step, shares, summary
        self._d, self._delta, self._costate, self._to_go = d, delta, costate, to_go

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
        self.states[first] = state
        self._fit(first, N)
        farther = self._shared[0] > been**2
        self._numbers[SHARED] = self._weight_of_excursion * (1.0 if farther else SUNK)
        with np.errstate(all="ignore"):
            self._solve(first, N)
            return self._search(first, N)

    def _aim(self, outside: Array) -> None:
        """Let forces `outside` act, and hover under them be the end."""
        self._vehicle[-6:] = outside
        self._hover[0] = hover_under(outside, self._vehicle[0], self.commands.shape[1])
        self._end_in_hover(0, 1)
        np.negative(self._errors, out=self._offset)

    def _fit(self, first: int, N: int) -> None:
        """Let the ball hold all states."""
        x = self.states[first : first + N + 1, POSITION]
        most = float(np.max(np.einsum("ij,ij->i", x, x)))
        self._shared[0] = max(float(self._shared[0]), (1 + MARGIN) * most + 1e-4)

    def _solve(self, first: int, N: int) -> None:
        """Solve the linear-quadratic problem about what is known."""
        stages = slice(first, first + N)
        slack, dual, spread = self._slack[stages], self._dual[stages], self._set.spread
        self._damping[:] = self._set.state_damping * self._damp, self._damp
        self._values(first, N)
        middle = BARRIER / slack
        np.clip(dual, middle / spread, middle * spread, out=dual)
        self._linearise(first, N)
        self._terms(first, N)
        self._end(first + N, 1)
        self._backward(first, N)
        c, g = self._to_go[first, self._of_shared : self._of_shared + 2]
        self._epsilon[0] = -g / c
        self._delta[first] = 0.0
        self._forward(first, N)
        self._steps(first, N)
        of_gaps, of_limits = np.max(self._costate[stages]), np.max(dual[:, self._exact :], initial=0.0)
        self._price = max(1.0, 1.2 * float(of_gaps)), max(1.0, 1.2 * float(of_limits))

    def _search(self, first: int, N: int) -> bool:
        """Take the longest step that lets the merit fall."""
        stages = slice(first, first + N)
        gap = float(np.sum(np.abs(self._d[stages])))
        before = self._merit(first, N, gap)
        delta, used = np.abs(self._delta[first : first + N + 1]), np.max(self._shares[stages], axis=0)
        turn = max(float(np.max(delta[:, ATTITUDE])), float(np.max(delta[:, ROD])))
        longest, dual_length = np.fmin(1.0, self._set.room / used)
        most = float(np.fmin(longest, self._set.turn / np.float64(turn)))
        for wanted in LENGTHS:
            self._fly(first, N, wanted * most)
            if self._new_merit(first, N, (1 - wanted * most) * gap) < before:
                self._take(stages, float(dual_length))
                self._damp = max(self._damp / 3, self._set.least_damping) if wanted == 1.0 else self._damp
                return True
        self._damp = min(self._damp * self._set.worse, MOST_DAMPING)
        return False

    def _take(self, stages: slice, dual_length: float) -> None:
        after = slice(stages.start + 1, stages.stop + 1)
        self.states[after], self.commands[stages] = self._new_states[after], self._new_commands[stages]
        self._slack[stages] = self._new_slack[stages]
        self._dual[stages] += dual_length * self._z_step[stages]
        self._shared[:] = self._new_shared

    def _fly(self, first: int, N: int, length: float) -> None:
        """Fly a step of this `length` into the new states and commands, with trial values of the slacks."""
        stages, exact = slice(first, first + N), self._exact
        self._new_states[first], self._length[0] = self.states[first], length
        self._rollout(first, N)
        x, slack = self._new_states[stages, POSITION], self._slack[stages]
        kept = np.einsum("ij,ij->i", x, x) + (1 - self._set.room) * slack[:, exact - 1]
        self._new_shared[0] = max(self._shared[0] + length * self._epsilon[0], np.max(kept))
        self._trial[stages, exact:] = slack[:, exact:] + length * self._s_step[stages, exact:]

    def _merit(self, first: int, N: int, gap: float) -> float:
        """Return the merit of what is known, and write its slacks."""
        self._values(first, N)
        self._end(first + N, 1)
        return self._summed(first, N, self._shared, gap)

    def _new_merit(self, first: int, N: int, gap: float) -> float:
        """Return the merit of what was flown, and write its slacks."""
        self._new_values(first, N)
        self._new_end(first + N, 1)
        return self._summed(first, N, self._new_shared, gap)

    def _summed(self, first: int, N: int, shared: Array, gap: float) -> float:
        own, violation = np.sum(self._summary[first : first + N], axis=0)
        missed = self._errors + self._offset
        merit = self._numbers[SHARED] * shared[0] + own + self._weight[0] * (missed @ missed) / 2
        return float(merit + self._price[0] * gap + self._price[1] * violation)


def _numbers(*shape: int) -> Array:
    """Return zeros of this `shape`, aligned as compiled programs like them."""
    array: Array = lanes(*shape, width=1)[..., 0]
    return array
