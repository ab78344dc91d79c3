"""A plan in flight: followed with feedback, and solved again from where the flight is, stage by stage."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.model.state import SIZE
from flypend.planning.feedback import Feedback, regulator
from flypend.planning.nominal import Follower
from flypend.planning.realtime import RealTime
from flypend.planning.request import Request
from flypend.planning.result import Plan

# Least number of stages of the horizon, and stages of hover behind the plan, after which it has missed hover.
LEAST, TAIL = 50, 100
SUBSTEPS = 3  # of the prediction until the stage that is solved for
# A plan is lost when the rod is so far from it, rad, or the pivot, rod lengths, or so many iterations fail in a row.
FAR_ROD, FAR_PIVOT, MOST_FAILED = 0.8, 1.0, 10
OF_STAGES = 150  # for which a time of computing is told

Array = NDArray[np.float64]


class Flown:
    """A `plan` in flight since `begin` (s), relative to the target.

    Parameters
    ----------
    plan : Plan
        The plan.
    asked : Request
        What it answers.
    begin : float
        When it begins, s.
    computing : float, optional
        Time that an iteration of OF_STAGES stages takes, s; None to measure it.

    Attributes
    ----------
    spent : list of float
        Processor time of every iteration here, s.
    """

    def __init__(self, plan: Plan, asked: Request, begin: float, computing: float | None) -> None:
        self._feedback = feedback = _with_tail(regulator(plan))
        self._follower = Follower(feedback, plan.vehicle)
        self._own, self._begin, self._stage = asked.units.states(asked.rotors), begin, plan.stage
        self._weight = plan.vehicle.weight
        self._force, self._length = asked.units.force, asked.units.length
        states, commands = feedback.states / self._own, feedback.commands[:-1] / self._force
        count = len(plan.commands)
        self._realtime = RealTime(asked, states, commands, plan.stage / asked.units.time, count, LEAST)
        self._count, self._computing = count, computing
        self._expected = 0.0 if computing is None else computing
        self._next, self._failed, self._been = 1, 0, 0.0
        self._due: tuple[float, int, int] | None = None
        self.spent: list[float] = []

    def over(self, t: float) -> bool:
        """Whether the plan has ended at `t` (s)."""
        return t - self._begin > self._stage * self._count

    def command(self, t: float, here: Any, rotors: Any, outside: Any) -> tuple[Any, str]:
        """Return the command (n,), N, and why the plan is lost; "" if it is not.

        Parameters
        ----------
        t : float
            When the command acts, s.
        here, rotors : (24,), (n,)
            State and rotor forces then.
        outside : (6,)
            Forces from outside on vehicle and bob, weights.
        """
        self._been = max(self._been, float(np.linalg.norm(here[:3])) / self._length)
        self._take(t)
        command, off = self._follower.command(t - self._begin, here, rotors)
        if not np.linalg.norm(off[12:15]) < FAR_ROD or not np.linalg.norm(off[:3]) < FAR_PIVOT * self._length:
            return command, "it is too far from the plan"
        if self._failed >= MOST_FAILED:
            return command, f"{MOST_FAILED} iterations failed"
        if t - self._begin > self._stage * (self._count + TAIL - LEAST):
            return command, "the plan misses hover"
        self._improve(t, here, rotors, outside)
        return command, ""

    def _take(self, t: float) -> None:
        """Take over the result of an iteration, if it is there."""
        if self._due is None or t + 1e-9 < self._due[0]:
            return
        _, first, last = self._due
        self._due = None
        own, f = self._realtime, self._feedback
        f.states[first : last + 1] = own.states[first : last + 1] * self._own
        f.commands[first:last] = own.commands[first:last] * self._force

    def _improve(self, t: float, here: Any, rotors: Any, outside: Any) -> None:
        """Begin an iteration for the next stage that its result can reach, if it is time."""
        took = self._expected * max(self._count - self._next, LEAST) / OF_STAGES
        first = int(np.ceil((t + took - self._begin) / self._stage - 1e-9))
        if self._due is not None or first < self._next or not self._realtime.covers(first):
            return
        begun = time.process_time()
        there = self._ahead(t, here, rotors, outside * self._weight, self._begin + first * self._stage)
        good = self._realtime.improve(first, there / self._own, self._been, outside)
        self.spent.append(time.process_time() - begun)
        if self._computing is None:
            took = self.spent[-1]
            self._expected = max(took, 0.9 * self._expected)
        self._failed = 0 if good else self._failed + 1
        self._next = first + 1
        if good:
            self._due = (t + took, first, first + self._realtime.horizon(first))

    def _ahead(self, t: float, here: Any, rotors: Any, forces: Any, until: float) -> Any:
        """Return state and rotor forces (24 + n,) at `until` (s), with feedback along the plan as it is."""
        h, there = (until - t) / SUBSTEPS, np.append(here, rotors)
        for i in range(SUBSTEPS if h > 1e-9 else 0):
            state, forced = there[:SIZE], there[SIZE:]
            command, _ = self._follower.command(t + i * h - self._begin, state, forced)
            there = self._follower.stepped(state, forced, command, h, forces)
        return there


def _with_tail(feedback: Feedback) -> Feedback:
    """Return `feedback` with TAIL stages of hover, in arrays of its own."""

    def longer(values: Array) -> Array:
        return np.concatenate([values, np.repeat(values[-1:], TAIL, axis=0)])

    return Feedback(feedback.stage, longer(feedback.states), longer(feedback.commands), longer(feedback.gains))
