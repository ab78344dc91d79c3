"""What flies until there is a plan: sketches of it, or the law; or constant rotor forces, to touch nothing.

The law does not know which way a plan will go, and where the optimum is small, going the other way is most of the
excursion. A few iterations from all guesses tell the way; until then rotors are held. While the best guess is flown,
stage by stage, those that go on are solved on from where it leads, until it is the plan. Nor does the law guarantee the
clearance of the mount. Constant forces may: all rotors at a limit or in hover, or one side of the pivot at one limit,
the other at the other.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Sequence
from dataclasses import replace
from time import process_time
from typing import Any, NamedTuple

import numpy as np

from flypend import signals
from flypend.board.computer import SteppedBoard
from flypend.compile.llvm.stagewise import WIDTH
from flypend.model import State, Vehicle, Wrench
from flypend.model.mount import margins
from flypend.model.state import SIZE
from flypend.planning.dynamics import Array
from flypend.planning.feedback import AS_MODELLED, step_program
from flypend.planning.multistart import Found, work
from flypend.planning.problem import Request
from flypend.planning.search import Relay, stages_of
from flypend.plants.loop import Loop

DIRECTIONS, STEPS, SUBSTEPS = 8, 12, 4
BEYOND = 0.5  # of the wait, so much longer the rod has to keep away: a plan must be able to begin

# How many guesses go on after how many iterations; iterations until the first sketch, and of legs, each of which takes
# a stage on hehn2011; and what they are in iterations of single guesses. More before the first sketch come too late,
# fewer choose worse.
ROUNDS, LEGS = {1: 3, 13: 2}, (4, 9, 14)
CHARGES = np.diff([work(ROUNDS, WIDTH, int(done)) for done in np.cumsum((0, *LEGS))]).tolist()
SOFT = 0.1  # first weight of being too near: a few iterations must know what the rod may not touch
NEARER = 0.75  # a sketch may come nearer than the clearance if it keeps so much of what the rod keeps without it
LONGEST = 0.6  # √(l/g), for which a sketch, which knows no feedback, may fly
# (t (s), state and rotor forces (24 + n,)) → the request for a plan from there; raises InputError.
Ask = Callable[[float, Any], Request]


def room(path: Array, vehicle: Vehicle) -> float:
    """Return the least margin of the mount along a `path` (k, 24 + n) of states and rotor forces; see `model.mount`."""
    wrench = path[:, SIZE:] @ vehicle.mixing().T
    found = margins(State.trusted(path[:, :SIZE]), Wrench(wrench[:, 0], wrench[:, 1:]), vehicle, "up")
    return float(np.min(found))


def evasion(
    vehicle: Vehicle, state: Array, rotors: Array, wait: float, scales: Array = AS_MODELLED
) -> tuple[Array, float, Array]:  # fmt: skip
    """Return the constant command (n,), N, that keeps the rod best on its mount for a `wait` (s), its `room`, the end.

    `state` (24,) and `rotors` (n,), N, are those at the beginning, the end (24 + n,) are those after the wait. `scales`
    (2,) are thrust and moment over those of the `vehicle`.
    """
    begin = np.append(state, rotors)
    times = (wait / STEPS * np.arange(round(STEPS * (1 + BEYOND)) + 1)).tolist()
    held = [Schedule(times, [command] * (len(times) - 1)) for command in commands(vehicle)]
    paths = [schedule.fly(vehicle, begin, scales, 1) for schedule in held]
    schedule, path = max(zip(held, paths, strict=True), key=lambda flown: room(flown[1], vehicle))
    return schedule.commands[0], room(path, vehicle), path[STEPS]


def commands(vehicle: Vehicle) -> list[Array]:
    """Return the commands (n,), N, that are tried."""
    low, high = (float(limit) for limit in vehicle.rotor_limits)
    n, centres = len(vehicle.rotor_spins), vehicle.rotors_from_pivot
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    sides = np.sign(np.round(np.column_stack([np.cos(angles), np.sin(angles)]) @ centres[:, :2].T / vehicle.l, 6))
    even = [np.full(n, force) for force in (low, vehicle.weight / n, high)]
    return [*even, *((low + high) / 2 + (high - low) / 2 * sides)]


class Schedule(NamedTuple):
    """Commands (k, n), N, each from one of `times` (k + 1,), s, to the next."""

    times: Sequence[float]
    commands: Sequence[Array]

    def at(self, t: float) -> Array | None:
        """Return the command (n,), N, at `t` (s); None where the law flies."""
        place = bisect_right(self.times, t + 1e-9)
        return self.commands[place - 1] if 0 < place < len(self.times) else None

    def then(self, later: Schedule) -> Schedule:
        """Return these commands until the `later` ones begin, and then those."""
        place = bisect_left(self.times, later.times[0] - 1e-9)
        return Schedule([*self.times[:place], *later.times], [*self.commands[:place], *later.commands])

    def fly(
        self, vehicle: Vehicle, begin: Array, scales: Array = AS_MODELLED, substeps: int = SUBSTEPS
    ) -> Array:  # fmt: skip
        """Return states and rotor forces (substeps · k + 1, 24 + n) from `begin` (24 + n,) to the end.

        `scales` (2,) are thrust and moment over those of `vehicle`.
        """
        step, path = step_program(vehicle), [begin]
        for command, h in zip(self.commands, np.diff(self.times) / substeps, strict=True):
            for _ in range(substeps):
                path.append(step(path[-1][:SIZE], path[-1][SIZE:], command, h, scales=scales))
        return np.array(path)


class Lead(NamedTuple):
    """What leads to a plan: a `schedule`, or the law without one, for a `wait` (s), to `there` (24 + n,).

    If guesses were solved on all the way, `found` begins there.
    """

    schedule: Schedule | None
    there: Array
    wait: float
    found: Found | None = None


class Fallback:
    """What flies until there is a plan, on the closed loop `by_law`; the rod keeps `clearance` (m) if it can.

    `scales` (2,) are those of thrust and moment, true over those of the vehicle.
    """

    def __init__(self, by_law: Loop, clearance: float) -> None:
        self._vehicle, self._clearance, self.scales = by_law.vehicle, clearance, AS_MODELLED
        self._loop = replace(by_law, plant=by_law.sampled.replace(sensors=None))

    def until(self, t: float, begin: Array, wait: float) -> Lead:
        """Return what flies instead of the law for a `wait` (s) from `t` on, if it must, and where it leads.

        `begin` are state and rotor forces (24 + n,).
        """
        return self._instead(t, begin, wait)[1]

    def _instead(self, t: float, begin: Array, wait: float) -> tuple[float, Lead]:
        """Return what the rod keeps, m, before the answer of `until`."""
        path = self._under_law(t, begin, wait)
        if (kept := self._kept(path)) < self._clearance:
            command, better, there = evasion(self._vehicle, begin[:SIZE], begin[SIZE:], wait, self.scales)
            if better > kept:
                return better, Lead(Schedule((t, math.inf), (command,)), there, wait)
        return kept, Lead(None, path[-1], wait)

    def sketch(
        self, t: float, begin: Array, horizon: float, first: float, legs: Sequence[float], alone: float, ask: Ask,
        *, measured: bool,
    ) -> Lead:  # fmt: skip
        """Return a sketch of a plan with a `horizon` (√(l/g)) that is there after `first` (s), and what it becomes.

        Until then rotors are held. In each of `legs`, whole stages of at least so many seconds, guesses are solved on
        from where the best so far leads by its end. Without legs, or where they would take longer, the sketch flies for
        as long as a plan takes `alone` (s). Nothing that is `measured` and late is flown. There is no sketch if the rod
        would come too near to what it may touch; then as `until`. Raises InputError as `ask` does.
        """
        held = Schedule((t, t + first), (np.clip(begin[SIZE:], *self._vehicle.rotor_limits),))
        path, begun = held.fly(self._vehicle, begin, self.scales), process_time()
        asked = ask(t + first, path[-1])
        # Walls, which so few iterations cannot keep, would only choose the way worse.
        relay = Relay(asked.without_constraints() if asked.kept.loose else asked, horizon, ROUNDS, SOFT)
        found, stage, force = relay.leg(LEGS[0]), stages_of(horizon)[1] * asked.units.time, asked.units.force
        counts = [math.ceil(leg / stage - 1e-9) for leg in legs]
        if stage * sum(counts) > alone:
            counts = []
        now, wait = t + first, first + (stage * sum(counts) if counts else alone)
        sketch = _schedule(found.commands * force, now, t + wait, stage)
        ahead = sketch.fly(self._vehicle, path[-1], self.scales)
        late = measured and process_time() - begun > first
        kept = -math.inf if late else self._kept(np.concatenate([path, ahead]))
        if not kept >= self._clearance:
            # From a start that is nearer than that, constant forces that keep away best lead nowhere.
            least, instead = self._instead(t, begin, first + alone)
            if not kept >= NEARER * least:
                return instead
        flies, passed = held.then(sketch), 0
        for count, iterations in zip(counts, LEGS[1:], strict=False):
            now, passed, ahead, begun = now + stage * count, passed + count, ahead[SUBSTEPS * count :], process_time()
            relay.begin_at(passed, ask(now, ahead[0]).start)
            found = relay.leg(iterations)
            sketch = _schedule(found.commands * force, now, t + wait, stage)
            path = sketch.fly(self._vehicle, ahead[0], self.scales)
            late = measured and process_time() - begun > stage * count
            if not late and self._kept(path) >= min(self._clearance, self._kept(ahead)):
                flies, ahead = flies.then(sketch), path
        return Lead(flies, ahead[-1], wait, found if counts else None)

    def _kept(self, path: Array) -> float:
        return math.inf if self._vehicle.mount == "gimbal" else room(path, self._vehicle)

    def _under_law(self, t: float, begin: Array, duration: float) -> Array:
        """Return states and rotor forces (k, 24 + n) for a `duration` (s) from `t` on under the law."""
        path, passed, period = [begin], 0.0, 1 / self._loop.sampled.rate
        board, step = SteppedBoard(self._loop, begin[SIZE:]), step_program(self._vehicle)
        while passed < duration - 1e-9:
            signals.poll()
            h, here = min(period, duration - passed), path[-1]
            command = board.command(t + passed, here[:SIZE])
            path.append(step(here[:SIZE], here[SIZE:], command, h, scales=self.scales))
            passed += h
        return np.array(path)


def _schedule(commands: Array, begin: float, end: float, stage: float) -> Schedule:
    """Return the first of `commands` (k, n), each for a `stage`, from `begin` to `end` (s)."""
    count = math.ceil((end - begin) / stage - 1e-9)
    return Schedule([*(begin + stage * np.arange(count)).tolist(), end], [*commands[:count]])
