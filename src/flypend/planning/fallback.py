"""What flies until there is a plan: the law, then a sketch of the plan; or constant rotor forces, to touch nothing.

The law does not know which way a plan will go, and where the optimum is small, going the other way is most of the
excursion. A few iterations from all guesses tell the way. Nor does the law guarantee the clearance of the mount.
Constant forces may: all rotors at a limit or in hover, or one side of the pivot at one limit, the other at the other.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from flypend import signals
from flypend.board.computer import SteppedBoard
from flypend.compile.llvm.stagewise import WIDTH
from flypend.errors import InputError
from flypend.model import State, Vehicle, Wrench
from flypend.model.mount import margins
from flypend.model.state import SIZE
from flypend.planning.feedback import stepping
from flypend.planning.problem import Request
from flypend.planning.search import stages_of, together
from flypend.plants.loop import Loop

DIRECTIONS, STEPS = 8, 12
BEYOND = 0.5  # of the wait, so much longer the rod has to keep away: a plan must be able to begin

Array = NDArray[np.float64]
# How many guesses go on after how many iterations of a sketch, guesses, and iterations; see `search.work`.
SKETCH = ({1: 3}, WIDTH, 4)
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


def evasion(vehicle: Vehicle, state: Array, rotors: Array, wait: float) -> tuple[Array, float, Array]:
    """Return the constant command that keeps the rod best on its mount for a `wait` (s), that room, and the end.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle, with a mount that limits the rod.
    state, rotors : (24,), (n,)
        State and rotor forces at the beginning.
    wait : float
        Duration, s.

    Returns
    -------
    command, room, end : (n,), float, (24 + n,)
        The command, N, its `room`, and state and rotor forces after the wait.
    """
    paths = [(command, *_fly_command(vehicle, state, rotors, command, wait)) for command in commands(vehicle)]
    command, path, end = max(paths, key=lambda flown: room(flown[1], vehicle))
    return command, room(path, vehicle), end


def commands(vehicle: Vehicle) -> list[Array]:
    """Return the commands (n,), N, that are tried."""
    low, high = (float(limit) for limit in vehicle.rotor_limits)
    n, centres = len(vehicle.rotor_spins), vehicle.rotors_from_pivot
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    sides = np.sign(np.round(np.column_stack([np.cos(angles), np.sin(angles)]) @ centres[:, :2].T / vehicle.l, 6))
    even = [np.full(n, force) for force in (low, vehicle.weight / n, high)]
    return [*even, *((low + high) / 2 + (high - low) / 2 * sides)]


def _fly_command(vehicle: Vehicle, state: Array, rotors: Array, command: Array, wait: float) -> tuple[Array, Array]:
    """Return the path under a `command` through the `wait` and `BEYOND`, and where it is after the wait."""
    step, h = stepping(vehicle), wait / STEPS
    path = [np.append(state, rotors)]
    for _ in range(round(STEPS * (1 + BEYOND))):
        path.append(step(path[-1][:SIZE], path[-1][SIZE:], command, h))
    return np.array(path), path[STEPS]


class Schedule(NamedTuple):
    """Commands (k, n), N, that fly from `begin` to `end` (s), each for a `stage` (s)."""

    begin: float
    end: float
    stage: float
    commands: Array

    def at(self, t: float) -> Array | None:
        """Return the command (n,), N, at `t` (s); None where the law flies."""
        if not self.begin - 1e-9 <= t < self.end - 1e-9:
            return None
        command: Array = self.commands[min(int((t - self.begin) / self.stage + 1e-9), len(self.commands) - 1)]
        return command

    def flown(self, vehicle: Vehicle, begin: Array) -> Array:
        """Return states and rotor forces (k, 24 + n) from `begin` (24 + n,) to the end."""
        step, path, passed = stepping(vehicle), [begin], 0.0
        for command in self.commands:
            h = min(self.stage, self.end - self.begin - passed)
            if h < 1e-9:
                break
            path.append(step(path[-1][:SIZE], path[-1][SIZE:], command, h))
            passed += h
        return np.array(path)


class Fallback:
    """What flies until there is a plan, on the closed loop `by_law`; the rod keeps `clearance` (m) if it can."""

    def __init__(self, by_law: Loop, clearance: float) -> None:
        self._vehicle, self._clearance = by_law.vehicle, clearance
        self._loop = replace(by_law, plant=by_law.sampled.replace(sensors=None))

    def until(self, t: float, begin: Array, wait: float) -> tuple[Schedule | None, Array]:
        """Return what flies instead of the law for a `wait` (s) from `t` on, if it must, and where it leads.

        `begin` and what is returned are states and rotor forces (24 + n,).
        """
        _, schedule, there = self._instead(t, begin, wait)
        return schedule, there

    def _instead(self, t: float, begin: Array, wait: float) -> tuple[float, Schedule | None, Array]:
        """Return what the rod keeps, m, before the answer of `until`."""
        path = self._under_law(t, begin, wait)
        if (kept := self._kept(path)) < self._clearance:
            command, better, there = evasion(self._vehicle, begin[:SIZE], begin[SIZE:], wait)
            if better > kept:
                return better, Schedule(t, math.inf, math.inf, command[None]), there
        return kept, None, path[-1]

    def sketch(
        self, t: float, begin: Array, horizon: float, first: float, wait: float, ask: Ask, *, measured: bool
    ) -> tuple[Schedule | None, Array]:
        """Return as `until`, but with a sketch of a plan with a `horizon` (√(l/g)) that is there after `first` (s).

        There is none if the rod would come too near to what it may touch, or if the time is `measured` and it is late.
        """
        path, begun = self._under_law(t, begin, first), time.process_time()
        try:
            found = make_sketch(ask(t + first, path[-1]), horizon, t + first, t + wait)
        except InputError:
            return self.until(t, begin, wait)
        late = measured and time.process_time() - begun > first
        path = np.concatenate([path, found.flown(self._vehicle, path[-1])])
        kept = -math.inf if late else self._kept(path)
        if kept >= self._clearance:
            return found, path[-1]
        # From a start that is nearer than that, constant forces that keep away best lead nowhere.
        least, schedule, there = self._instead(t, begin, wait)
        return (found, path[-1]) if kept >= NEARER * least else (schedule, there)

    def _kept(self, path: Array) -> float:
        return math.inf if self._vehicle.mount == "gimbal" else room(path, self._vehicle)

    def _under_law(self, t: float, begin: Array, duration: float) -> Array:
        """Return states and rotor forces (k, 24 + n) for a `duration` (s) from `t` on under the law."""
        path, passed, period = [begin], 0.0, 1 / self._loop.sampled.rate
        board, step = SteppedBoard(self._loop, begin[SIZE:]), stepping(self._vehicle)
        while passed < duration - 1e-9:
            signals.poll()
            h, here = min(period, duration - passed), path[-1]
            command = board.command(t + passed, here[:SIZE])
            path.append(step(here[:SIZE], here[SIZE:], command, h))
            passed += h
        return np.array(path)


def make_sketch(asked: Request, horizon: float, begin: float, end: float) -> Schedule:
    """Return what a few iterations from all guesses make of what is `asked`, to fly from `begin` to `end` (s).

    They do not know of walls, which so few cannot keep: they would only choose the way worse.
    """
    rounds, _, iterations = SKETCH
    found = together(asked.unconstrained() if asked.kept.loose else asked, horizon, math.inf, iterations, rounds, SOFT)
    return Schedule(begin, end, stages_of(horizon)[1] * asked.units.time, found.commands * asked.units.force)
