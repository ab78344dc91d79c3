"""The flight computer of `nmpc`: who flies, and when a plan begins and ends.

    waiting   the law, or a sketch of the plan that is under way, flies
    planned   a plan is flown, and improved in every stage
    hovering  the law flies; the rod is about to stand

Times are those at which commands act, `latency` after their measurement. Plans are relative to the reference.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.compile.llvm.stagewise import WIDTH
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.geometry import norm
from flypend.laws import Law
from flypend.laws.references import Reference
from flypend.model import State
from flypend.model.state import SIZE
from flypend.planning import waiting
from flypend.planning.boards import Boards
from flypend.planning.constraints import Constraints
from flypend.planning.equilibrium import falls, hovers, upright, weighed
from flypend.planning.flown import OF_STAGES, Flown
from flypend.planning.planner import plan_within
from flypend.planning.race import work
from flypend.planning.request import STAGES_PER_UNIT, Request, request
from flypend.planning.result import Plan
from flypend.planning.scaled import Units
from flypend.planning.search import SOFT_LAST
from flypend.plants.loop import Loop

# Horizon, √(l/g), and iterations of the first attempt, and of those after failures. After 22 iterations all of 160
# random starts have a plan, which goes 4 % farther than the best on average, and 2 % with eight guesses to the end.
ATTEMPTS = ((12.5, 22), (12.5, 40), (20.0, 60), (32.0, 60), (12.5, 40))
ROUNDS = {4: 4, 8: 2}  # see `race`
# An iteration of a guess takes so many times what is charged for a real-time iteration, which has to be there in time.
OF_GUESS = 0.7
LATE = 2.0  # after a plan that was late, the next is given so many times as long
MEASURED_AT_FIRST = 2e-3  # s, expected of an iteration that is measured
# In hover an estimator learns slowly of forces that last; until then the law is shown a position that is off by the
# integral of the distance, of this rate, √(g/l), and at most so long, rod lengths.
INTEGRAL, MOST_OFF = 0.06, 1.0
PAUSE = 1.0  # √(l/g), after the second failure in a row, and ever longer; after the last attempt only the law flies


@dataclass(frozen=True, eq=False)
class Receding:
    """What the pilots of a controller have in common; called, it makes one. See `receding.nmpc` for the fields.

    `law` is what flies otherwise, `latency` what the board predicts over for plans, and `computing` None if measured.
    """

    reference: Reference
    law: Law
    latency: float
    computing: float | None
    constraints: Constraints

    def __call__(self, loop: Loop, rotors: Any) -> Pilot:
        """Return the flight computer for a `loop` and initial `rotors` (n,), N."""
        return Pilot(self, loop, rotors)


class Coming(NamedTuple):
    """A plan under way: it is there at `due` (s) and begins at `begin` (s); without one, `why`.

    `meanwhile` are commands that fly until then; without, the law.
    """

    plan: Plan | None
    asked: Request | None
    why: str
    due: float
    begin: float
    meanwhile: waiting.Meanwhile | None


class Pilot:
    """The flight computer of `nmpc`, for one flight.

    Parameters
    ----------
    receding : Receding
        What it has in common with others.
    loop : Loop
        The closed loop that is flown.
    rotors : (n,)
        Initial rotor forces, N.

    Attributes
    ----------
    changes : list of (float, str, str)
        When it changed hands, s, to which mode, and why.
    plans : list of Plan
        The plans that were flown.
    spent : list of float
        Processor time of each real-time iteration, s.
    """

    def __init__(self, receding: Receding, loop: Loop, rotors: Any) -> None:
        if loop.sampled.interface != "wrench":
            raise InputError("plant.interface", "wrench: nmpc commands rotor forces", loop.sampled.interface)
        self._common, self._vehicle = receding, loop.vehicle
        self._by_law = replace(loop, law=receding.law.bind(loop.vehicle))
        self._rotors = np.asarray(rotors, dtype=float)
        self._units, self._m = Units.of(loop.vehicle), loop.vehicle.m / (loop.vehicle.M + loop.vehicle.m)
        self._where = _moving(receding.reference)
        self._waits = waiting.Waits(self._by_law, receding.constraints.clearance)
        self._mode = "waiting"
        self._coming: Coming | None = None
        self._flown: Flown | None = None
        self._failures, self._not_before, self._patience = 0, -np.inf, 1.0
        self._planned_command: Any = None
        self.changes: list[tuple[float, str, str]] = []
        self.plans: list[Plan] = []
        self.spent: list[float] = []
        if loop.sampled.sensors is None:
            self.estimate_from(None)

    def estimate_from(self, estimate: Any) -> None:
        """Begin with the `estimate` (24,) of the state, e₃ up."""
        self._boards = Boards(self._by_law, self._common.latency, self._planned_for, self._rotors, estimate)

    def command(self, t: float, measured: Any) -> Any:
        """Return the rotor forces (n,), N, for the `measured` state (24,), e₃ up, or readings, at time `t` (s)."""
        return self._boards.command(t, measured)

    def _planned_for(self, now: float, state: Any, rotors: Any, forces: Any) -> Any:
        """Return the command (n,), N, for what is predicted for `now`, when it acts; None if the law flies."""
        here, outside = self._relative(now, state), weighed(forces, self._where(now)[6:], self._vehicle)
        level = upright(outside, self._m)[:2]
        if self._coming is not None and now + 1e-9 >= self._coming.due:
            self._arrive(now, self._coming)
        if self._flown is not None:
            self._planned_command = self._followed(self._flown, now, here, rotors, outside, level)
        elif self._mode == "hovering":
            if falls(here, level, self._units):
                self._change(now, "waiting", "the rod falls")
            elif self._by_law.sampled.sensors is not None:
                self._integrate(here[:3])
        if self._mode == "waiting":
            if hovers(here, level, self._units):
                self._hover(now)
            elif self._coming is None and now >= self._not_before and self._due(here, level):
                self._coming = self._begun(now, state, rotors)
            if self._coming is not None and self._coming.meanwhile is not None:
                self._planned_command = self._coming.meanwhile.at(now)
        return self._planned_command

    def _integrate(self, x: Any) -> None:
        """Add a distance `x` (3,), m, of one period to the integral."""
        off = self._boards.off + INTEGRAL / self._units.time / self._by_law.sampled.rate * x
        self._boards.off = off / max(1.0, float(norm(off)) / (MOST_OFF * self._units.length))

    def _followed(self, flown: Flown, t: float, here: Any, rotors: Any, outside: Any, level: Any) -> Any:
        """Return the command of a plan that is flown; None if it ends now."""
        command, lost = flown.command(t, here, rotors, outside)
        if lost:
            self._fail(t, lost)
        elif hovers(here, level, self._units) or (flown.over(t) and not falls(here, level, self._units)):
            self._hover(t)
        return None if self._flown is None else command

    def _due(self, here: Any, level: Any) -> bool:
        """Whether a plan is due: at the beginning wherever the vehicle is, later if the law would drop the rod."""
        return not self.changes or falls(here, level, self._units)

    def _change(self, t: float, mode: str, why: str) -> None:
        if self._flown is not None:
            self.spent += self._flown.spent
        self._mode, self._coming, self._flown, self._planned_command = mode, None, None, None
        self._boards.off = np.zeros(3)
        self.changes.append((t, mode, why))

    def _hover(self, t: float) -> None:
        self._change(t, "hovering", "the rod stands")
        self._failures, self._patience = 0, 1.0

    def _fail(self, t: float, why: str) -> None:
        """Let the law fly, for good after too many failures."""
        self._change(t, "waiting", why)
        self._failures += 1
        pause = (2.0 ** (self._failures - 1) - 1) * PAUSE * self._units.time
        self._not_before = t + pause if self._failures < len(ATTEMPTS) else np.inf

    def _arrive(self, t: float, coming: Coming) -> None:
        if coming.plan is None or coming.asked is None:
            self._fail(t, coming.why)
            return
        self._change(t, "planned", coming.plan.told)
        self.plans.append(coming.plan)
        self._flown = Flown(coming.plan, coming.asked, coming.begin, self._common.computing)

    def _relative(self, t: float, state: Any) -> Any:
        """Return the `state` (24,) at time `t` relative to the reference."""
        here = state.copy()
        here[:6] -= self._where(t)[:6]
        return here

    def _begun(self, t: float, state: Any, rotors: Any) -> Coming:
        """Plan from where the vehicle will be by the time the plan is there, and a sketch before it, which is flown.

        After a failure there is no sketch, as only the law is known to lead somewhere, nor for a slow computer.
        """
        horizon, iterations = ATTEMPTS[self._failures]
        each = MEASURED_AT_FIRST if self._common.computing is None else self._common.computing
        each *= OF_GUESS * horizon * STAGES_PER_UNIT / OF_STAGES * self._patience
        first, given = (each * work(*much) for much in (waiting.SKETCH, (ROUNDS, WIDTH, iterations)))
        if given > horizon * self._units.time:
            return Coming(None, None, "a plan would take longer than its flight", t, t, None)
        first *= not self._failures and given <= waiting.LONGEST * self._units.time
        given, begun = first + given, time.process_time()
        here = np.append(state, rotors)
        if first:
            measured = self._common.computing is None
            meanwhile, there = self._waits.sketched(t, here, horizon, first, given, self._asked, measured=measured)
        else:
            meanwhile, there = self._waits.until(t, here, given)
        found, asked, why = self._planned(t + given, there, horizon, iterations)
        took = time.process_time() - begun if self._common.computing is None else given
        if took > given:
            found, why, self._patience = None, "the plan is late", LATE * self._patience
        return Coming(found, asked, why, t + max(took, given), t + given, meanwhile)

    def _asked(self, t: float, here: Any) -> Request:
        """Return the request for a plan from state and rotor forces `here` (24 + n,) at `t` (s). Raises InputError."""
        start, forces = State.from_packed(self._relative(t, here[:SIZE])), here[SIZE:]
        rotors = np.clip(forces, *self._vehicle.rotor_limits)
        return request(self._vehicle, start, "excursion", np.zeros(3), rotors, self._common.constraints)

    def _planned(self, t: float, here: Any, horizon: float, iterations: int) -> tuple[Plan | None, Request | None, str]:
        """Return a plan from `here` as in `_asked`, what it answers, and why there is none."""
        try:
            asked = self._asked(t, here)
        except InputError as error:
            return None, None, str(error)
        found = plan_within(asked, horizon, iterations, ROUNDS)
        if asked.structure.mounted is not None:
            asked.numbers[-2] = SOFT_LAST
        return (found if found else None), asked, found.reason


@lru_cache(maxsize=16)
def _moving(reference: Reference) -> Any:
    """Return the function from time (s) to position, velocity and acceleration (9,) of `reference`."""
    t = ca.SX.sym("t")
    position = ca.densify(reference(t))
    velocity = ca.jacobian(position, t)
    moved = ca.vertcat(position, velocity, ca.jacobian(velocity, t))
    return as_numpy(ca.Function("where", [t], [ca.densify(moved)]))
