"""A plan in flight: followed with feedback, and solved again from where the flight is, one iteration at a time.

An iteration is that of `solver.Solver`, begun from the last one with its multipliers. Its first state is that of the
flight, so that only the first stage has a gap, which a full step closes. The barrier stays where it is: commands keep
away from their limits, for feedback to use. Under constant forces from outside the end is the hover in which rod and
thrust lean against them.
"""

from __future__ import annotations

import math
import time

import numpy as np

from flypend.model import Vehicle
from flypend.model.state import SIZE
from flypend.planning.dynamics import Array, Units
from flypend.planning.feedback import AS_MODELLED, Feedback, Follower, regulator
from flypend.planning.inequalities import OF_FORCE, SHARED
from flypend.planning.problem import Request
from flypend.planning.result import Plan
from flypend.planning.solver import Problem, Settings, Solver, one_lane, programs_of

SETTINGS = Settings(barrier=3e-5, shrinks=(0.4, 0.375), most_damping=1.0, inside=0.005, margin=(0.02, 1e-4))
SUNK = 0.05  # of the weight of the excursion, where the flight has been farther out already
# Least number of stages of the horizon, and stages of hover behind the plan, after which it has missed hover.
LEAST, TAIL = 50, 100
SUBSTEPS = 3  # of the prediction until the stage that is solved for
# A plan is lost when pivot and rod, with their rates, are so far from where the plan of the stage before had them, own
# units, at so many stages in a row. Without a blow the gap is at most 0.17, on sensors or with a delay yet to be found;
# a blow makes one too, but where an iteration can follow it is closed in the next stage.
GAP, STAGES_OF_GAP = 0.5, 2
MOST_FAILED = 10  # iterations in a row, after which a plan is lost, too
OF_STAGES = 150  # for which a time of computing is told

TINY = 1e-3  # weights: shorter forces have no direction
# In hover, own units, are at most: distance, speed, lean of the thrust axis (rad), spin, lean of the rod, its rate.
SETTLED = (0.15, 0.15, 0.2, 0.5, 0.1, 0.2)
# It is over when y + ẏ, which grows if nothing is done, is so far from upright, or the pivot so far away.
FALLING, AWAY = 0.35, 2.0
MOVED = [*range(6), *range(12, 18)]  # of a deviation: pivot, rod and their rates
ATTITUDE, ROD, AXIS = slice(6, 15), slice(18, 21), [8, 11, 14]  # of a packed state


def in_weights(forces: Array, acceleration: Array, vehicle: Vehicle) -> Array:
    """Return `forces` (6,) on vehicle and bob, N, in weights, in a frame with an `acceleration` (3,), m/s²."""
    found: Array = np.concatenate([forces[:3] - vehicle.M * acceleration, forces[3:] - vehicle.m * acceleration])
    return found / vehicle.weight


def upright(outside: Array, m: float) -> tuple[Array, Array, float]:
    """Return directions of rod and thrust (3,), and the thrust, in hover under forces `outside` (6,), all in weights.

    `m` is the share of the bob in the mass.
    """
    rod, thrust = -outside[3:], -outside[:3] - outside[3:]
    rod[2] += m
    thrust[2] += 1
    size = math.sqrt(thrust @ thrust)
    return rod / max(math.sqrt(rod @ rod), TINY * m), thrust / max(size, TINY), size


def hover_under(outside: Array, m: float, rotors: int) -> Array:
    """Return state and `rotors` (24 + n,), own units, of hover under forces `outside` (6,); see `upright`."""
    y, z, thrust = upright(outside, m)
    a, b, c = z.tolist()  # the first axis is e₁ without its part along z
    level = math.sqrt(1 - a * a)
    rows = level, 0.0, a, -a * b / level, c / level, b, -a * c / level, -b / level, c
    found = np.zeros(SIZE + rotors)
    found[ATTITUDE], found[ROD], found[SIZE:] = rows, y, thrust
    return found


def hovers(here: Array, level: tuple[Array, Array], units: Units) -> bool:
    """Whether the state `here` (24,), relative to the reference, is so near hover that the law keeps it there.

    `level` are the directions of rod and thrust axis in hover, (3,) each, and `units` those of the vehicle.
    """
    own, (y, z) = here / units.of_state, level
    rod, axis = own[ROD], own[AXIS]
    if rod @ y < 0 or axis @ z < 0:
        return False
    # Spin about the thrust axis does no harm.
    off = (own[:3], own[3:6], axis - z, own[15:17], rod - y, own[21:24])
    return all(e @ e < most * most for e, most in zip(off, SETTLED, strict=True))


def falls(here: Array, level: tuple[Array, Array], units: Units) -> bool:
    """Whether a state is so far from hover that a plan is due; see `hovers`."""
    own, (y, _) = here / units.of_state, level
    rod, x = own[ROD], own[:3]
    falling = rod + own[21:24] - y
    return bool(rod @ y < 0 or falling @ falling > FALLING**2 or x @ x > AWAY**2)


class RealTime:
    """What is left of a plan for what was `asked`, in own units about the target.

    `states` (stages + 1, 24 + n), with rotor forces, and `commands` (stages, n), each for a `stage`, are those of the
    plan, and later the best known. At stage `planned` the flight is to hover: the horizon ends there, or `least`
    stages ahead, which are at least `stagewise.WIDTH`, whichever is later.
    """

    def __init__(self, asked: Request, states: Array, commands: Array, stage: float, planned: int, least: int) -> None:
        vehicle, problem = asked.vehicle, Problem.of([asked], len(commands), stage)
        self._numbers = problem.vehicle[:, 0].copy()
        self._solver = Solver(programs_of(asked), problem, one_lane(states), one_lane(commands), SETTINGS)
        self.states, self.commands = self._solver.states[..., 0], self._solver.commands[..., 0]
        self._planned, self._least, self._of_excursion = planned, least, float(asked.numbers[SHARED])
        self._m, self._scale, self._asked = vehicle.m / (vehicle.M + vehicle.m), 1.0, asked

    def covers(self, first: int) -> bool:
        """Whether there is a horizon from stage `first` on."""
        return first + self._least <= len(self.commands)

    def horizon(self, first: int) -> int:
        """Return the number of stages of the horizon from stage `first` on."""
        return max(self._planned - first, self._least)

    def improve(self, first: int, state: Array, been: float, outside: Array, scales: Array = AS_MODELLED) -> bool:
        """Do one iteration from stage `first` on, which begins at `state` (24 + n,).

        `been` is the largest distance from the target so far; `outside` (6,) are forces on vehicle and bob, weights,
        under which the end is hover, and `scales` (2,) thrust and moment over those of the machine that was planned
        for. Returns whether the iteration succeeded; if not, everything is as before, but for the first state.
        """
        solver, stages = self._solver, slice(first, first + self.horizon(first))
        numbers, (thrust, moment) = self._numbers.copy(), scales
        numbers[-6:] = outside
        numbers[1:7] *= moment / thrust
        numbers[7:13] *= thrust / moment
        hover = hover_under(outside, self._m, self.commands.shape[1])
        solver.aim(numbers[:, None], hover[:, None], self._scale / thrust)
        self._scale = thrust
        if (own := self._asked.structure.slices.get("own")) is not None:
            force = own.start + OF_FORCE
            solver.insist(force, self._asked.numbers[force] / thrust, 0)
        solver.restart(stages, state[:, None])
        farther = solver.shared[0] > been**2
        solver.insist(SHARED, self._of_excursion * (1.0 if farther else SUNK), 0)
        length, most = solver.step()
        if length == most:
            solver.damp(np.maximum(SETTINGS.better * solver.damping, SETTINGS.least_damping))
        elif not length:
            solver.damp(np.minimum(SETTINGS.worse * solver.damping, SETTINGS.most_damping))
        return bool(length)


class PlanInFlight:
    """A `plan` for what was `asked` in flight since `begin` (s), relative to the target.

    An iteration of OF_STAGES stages takes `computing` (s); None to measure it. `scales` (2,) are thrust and moment of
    the `vehicle` over those of its model, as the plan takes them. `spent` is the processor time of each iteration, s.
    """

    def __init__(
        self, plan: Plan, asked: Request, begin: float, computing: float | None, vehicle: Vehicle, scales: Array
    ) -> None:
        self._feedback = feedback = _with_tail(regulator(plan))
        feedback.states[:, :3] -= plan.target
        self._follower = Follower(feedback, vehicle)
        self._follower.scales = self._planned_for = scales
        self._weight, self._of_deviation = vehicle.weight, asked.units.deviations(asked.rotors)
        self._own, self._begin, self._stage = asked.units.states(asked.rotors), begin, plan.stage
        self._length = asked.units.length
        states, commands = feedback.states / self._own, feedback.commands[:-1] / asked.units.force
        count = len(plan.commands)
        self._realtime = RealTime(asked, states, commands, plan.stage / asked.units.time, count, LEAST)
        self._count, self._computing = count, computing
        self._expected = 0.0 if computing is None else computing
        self._next, self._failed, self._been, self._gaps = 1, 0, 0.0, 0
        self._due: tuple[float, int, int, Array] | None = None
        self.spent: list[float] = []

    def over(self, t: float) -> bool:
        """Whether the plan has ended at `t` (s)."""
        return t - self._begin > self._stage * self._count

    def command(self, t: float, here: Array, rotors: Array, outside: Array, scales: Array) -> tuple[Array, str]:
        """Return the command (n,), N, that acts at `t` (s), and why the plan is lost; "" if it is not.

        `here` (24,) and `rotors` (n,), N, are state and rotor forces then, `outside` (6,) the forces from outside on
        vehicle and bob, weights, and `scales` (2,) thrust and moment over those of the model.
        """
        self._been = max(self._been, float(np.linalg.norm(here[:3])) / self._length)
        self._take(t)
        command, off = self._follower.command(t - self._begin, here, rotors)
        if self._gaps >= STAGES_OF_GAP:
            return command, "the flight is not as predicted"
        if self._failed >= MOST_FAILED:
            return command, f"{MOST_FAILED} iterations failed"
        if t - self._begin > self._stage * (self._count + TAIL - LEAST):
            return command, "the plan misses hover"
        self._improve(t, np.append(here, rotors), off, outside, scales)
        return command, ""

    def _take(self, t: float) -> None:
        """Take over the result of an iteration, if it is there."""
        if self._due is None or t + 1e-9 < self._due[0]:
            return
        _, first, last, scales = self._due
        self._due = None
        own, f = self._realtime, self._feedback
        units = self._units(scales)
        f.states[first : last + 1] = own.states[first : last + 1] * units
        f.commands[first:last] = own.commands[first:last] * units[SIZE:]
        self._follower.scales = scales

    def _units(self, scales: Array) -> Array:
        """Return the units of states and rotor forces (24 + n,) under `scales`."""
        own = self._own.copy()
        own[SIZE:] *= self._planned_for[0] / scales[0]
        return own

    def _improve(self, t: float, here: Array, off: Array, outside: Array, scales: Array) -> None:
        """Begin an iteration for the next stage that its result can reach, if it is time.

        `here` (24 + n,) are state and rotor forces, and `off` (18 + n,) is their deviation; the rest as in `command`.
        """
        took = self._expected * max(self._count - self._next, LEAST) / OF_STAGES
        first = int(np.ceil((t + took - self._begin) / self._stage - 1e-9))
        if self._due is not None or first < self._next or not self._realtime.covers(first):
            return
        gap = (off / self._of_deviation)[MOVED]
        self._gaps = 0 if gap @ gap < GAP**2 else self._gaps + 1
        begun = time.process_time()
        there = self._predict(t, here, outside * self._weight, scales, self._begin + first * self._stage)
        relative = scales / self._planned_for
        good = self._realtime.improve(first, there / self._units(scales), self._been, outside, relative)
        self.spent.append(time.process_time() - begun)
        if self._computing is None:
            took = self.spent[-1]
            self._expected = max(took, 0.9 * self._expected)
        self._failed = 0 if good else self._failed + 1
        self._next = first + 1
        if good:
            self._due = (t + took, first, first + self._realtime.horizon(first), scales)

    def _predict(self, t: float, here: Array, forces: Array, scales: Array, until: float) -> Array:
        """Return state and rotor forces (24 + n,) at `until` (s), with feedback along the plan as it is."""
        h, there = (until - t) / SUBSTEPS, here
        for i in range(SUBSTEPS if h > 1e-9 else 0):
            state, forced = there[:SIZE], there[SIZE:]
            command, _ = self._follower.command(t + i * h - self._begin, state, forced)
            there = self._follower.stepped(state, forced, command, h, forces, scales)
        return there


def _with_tail(feedback: Feedback) -> Feedback:
    """Return `feedback` with TAIL stages of hover, in arrays of its own."""
    parts = feedback.states, feedback.commands, feedback.gains
    return Feedback(feedback.stage, *(np.concatenate([part, np.repeat(part[-1:], TAIL, axis=0)]) for part in parts))
