"""`nmpc`: a controller that plans, flies, and plans again in flight, with the inverted law to fall back on.

    waiting   the law, or a sketch of the plan that is under way, flies
    planned   a plan is flown, and improved in every stage
    hovering  the law flies; the rod is about to stand

Times are those at which commands act, `latency` after their measurement. Plans are flown relative to the reference.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal, NamedTuple, Unpack

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from flypend import errors
from flypend.building import builds, built
from flypend.compile.llvm.stagewise import WIDTH
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.geometry import E3, norm
from flypend.laws import Computer, Controller, Law
from flypend.laws.references import Reference, hover
from flypend.laws.throw import derivatives
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.planning.constraints import Constraints, Keywords, gather
from flypend.planning.dynamics import Array, Units
from flypend.planning.fallback import CHARGES, LONGEST, Fallback, Schedule
from flypend.planning.model_error import ModelError
from flypend.planning.multistart import SOFT_LAST, Found, work
from flypend.planning.planner import plan_within
from flypend.planning.problem import STAGES_PER_UNIT, Request, request
from flypend.planning.real_time import OF_STAGES, PlanInFlight, falls, hovers, in_weights, upright
from flypend.planning.result import Plan
from flypend.planning.search import plan_of, stages_of
from flypend.planning.tracking import Boards, fallback_law, rotors_only
from flypend.plants.loop import Loop

Level = tuple[Array, Array]  # rod and thrust axis in hover

COMPUTING = 0.001  # s
# Horizon, √(l/g), and iterations of the first attempt, and of those after failures. After 22 iterations all of 160
# random starts have a plan, which goes 4 % farther than the best on average, and 2 % with eight guesses to the end.
ATTEMPTS = ((12.5, 22), (12.5, 40), (20.0, 60), (32.0, 60), (12.5, 40))
ROUNDS = {4: 4, 8: 2}  # see `multistart.Race`
# An iteration of a guess takes so many times what is charged for a real-time iteration, which has to be there in time.
OF_GUESS = 0.7
LATE = 2.0  # after a plan that was late, the next is given so many times as long
MEASURED_AT_FIRST = 2e-3  # s, expected of an iteration that is measured
# In hover an estimator learns slowly of forces that last; until then the law is shown a position that is off by the
# integral of the distance, of this rate, √(g/l), and at most so long, rod lengths.
INTEGRAL, MOST_OFF = 0.06, 1.0
# Weight of walls in flight. With that of mounts the merit bends so sharply at a wall that none of the few lengths of an
# iteration lowers it, ten times in a row; with this the flight is beyond a wall by less than a millimetre where it can.
WALL = 1.0
MARGIN = 0.01  # rod lengths, by which iterations keep off a wall: the flight is up to 5 mm off what they predict
PAUSE = 1.0  # √(l/g), after the second failure in a row, and ever longer; after the last attempt the law flies to hover
# Constraints that are not kept in flight, and why; and those that do not say where or how fast the pivot may be.
NOT_IN_FLIGHT = {
    "waypoints": "a plan that begins in flight does not know which are passed; use plan and track",
    "path": "the reference is the path",
}
IN_ANY_FRAME = ("lean", "clearance")
# A plan that is lost may have met a blow, and the next one catches it with half the law's excursion. When that is lost
# too, the model is wrong, and the law flies to hover.
MOST_LOST = 2


@errors.named_arguments
@builds
def nmpc(
    vehicle: Vehicle | None = None,
    *,
    reference: Reference | None = None,
    latency: float = 0.0,
    computing: float | Literal["measured"] = COMPUTING,
    otherwise: Law | None = None,
    constraints: Constraints | None = None,
    **keywords: Unpack[Keywords],
) -> Controller:
    """Return a controller that plans the way to inverted hover in flight, and again whenever it is thrown off.

    It is a flight computer. At the start, and whenever the rod is about to fall, it plans from the state in which it
    will be when the plan is ready; until then a sketch of it flies, or the inverted law. A plan is flown with feedback,
    and the rest of it is solved again in every stage, by one real-time iteration. In hover the inverted law takes over.
    docs/planning/nmpc.md says who flies when.

    Parameters
    ----------
    vehicle : Vehicle, optional
        If given, it is checked at once whether plans for it can be made. The controller serves any vehicle.
    reference : callable, optional
        Pivot position to hold or follow; see `laws.references`. Default that of `otherwise`, or the origin.
    latency : float
        Delay to compensate while a plan is flown, s, as in `laws.Computer`; that of `otherwise` is its own. A further
        delay is found in flight, as far as `otherwise` searches for one.
    computing : float or "measured"
        Time that a real-time iteration of 150 stages takes on the flight computer, s. Its result is used that much
        later; the first plan is late in proportion. With "measured", the processor time on this machine counts, and
        flights are not repeatable.
    otherwise : Law, optional
        What flies until there is a plan, in hover, and when there is none; default the inverted law about `reference`.
    constraints : Constraints, optional
        Constraints on its plans, at first and in every iteration: all but waypoints and path. A window counts until the
        pivot is through. Constraints on the position or speed of the pivot need a reference at rest. If no plan keeps a
        box, floor, ceiling, speed or `keep` in time, or the flight has broken it already, a plan that breaks it is
        flown. The laws that fly between plans keep only the clearance.
    **keywords
        Fields of `Constraints` one by one.

    Raises
    ------
    InputError
        If an argument is out of range or a constraint cannot be kept in flight; and from a flight, if hover at the
        reference breaks one, or the plant takes no rotor forces.
    """
    delay = Computer(latency=latency).latency
    if isinstance(computing, str):
        if computing != "measured":
            raise InputError("computing", "'measured', or a number of seconds", repr(computing))
    else:
        errors.number("computing", computing, above=0, unit="s")
    kept = gather("nmpc", constraints, keywords)
    law = fallback_law(otherwise, reference or hover())
    followed = reference or law.reference or hover()
    _check_in_flight(kept, followed)
    receding = Receding(followed, law, delay, None if computing == "measured" else computing, kept)
    if vehicle is not None:
        receding.check(vehicle)
    return Controller(
        name="nmpc",
        function=rotors_only("nmpc"),
        reference=followed,
        flight_computer=receding,
        because="it solves a problem in every stage",
    )


def _check_in_flight(kept: Constraints, reference: Reference) -> None:
    """Raise InputError if a constraint makes no sense in flight, or none about a `reference` that moves."""
    t = ca.SX.sym("t")
    moves = not ca.jacobian(ca.densify(reference(t)), t).is_zero()
    for name, value in kept.given.items():
        if name in NOT_IN_FLIGHT:
            raise InputError(name, f"nothing: {NOT_IN_FLIGHT[name]}", repr(value)[:80])
        if moves and name not in IN_ANY_FRAME:
            raise InputError(name, "nothing beside a reference that moves", repr(value)[:80])


@dataclass(frozen=True, eq=False)
class Receding:
    """What the pilots of a controller have in common; called, it makes one. See `nmpc` for the fields.

    `law` is what flies otherwise, `latency` what the board predicts over for plans, and `computing` None if measured.
    """

    reference: Reference
    law: Law
    latency: float
    computing: float | None
    constraints: Constraints

    def __call__(self, loop: Loop, rotors: ArrayLike) -> Pilot:
        """Return the flight computer for a `loop` and initial `rotors` (n,), N. Raises InputError; see `check`."""
        if self.constraints.given:
            self.check(loop.vehicle)
        return Pilot(self, loop, rotors)

    def check(self, vehicle: Vehicle) -> None:
        """Raise InputError if there are no plans for `vehicle`, or hover at the reference breaks a constraint."""
        there = _reference_program(self.reference)(0.0)[:3]
        hovering = State(x=there, y=E3)
        request(vehicle, hovering, "excursion", there, kept=self.kept(there, there))
        for window in self.constraints.windows:
            if not window.room(State.trusted(hovering.packed()[None]), vehicle)[0] > 0:
                raise InputError("window", "a wall that hover at the reference is clear of", window.centre.tolist())

    @property
    def mount(self) -> Constraints:
        """What plans keep where none keeps all: the clearance."""
        return Constraints(clearance=self.constraints.given.get("clearance"))

    def kept(self, x: Array, target: Array) -> Constraints:
        """Return the constraints of a plan from `x` (3,) to the `target` (3,), m: without windows that lie behind."""
        kept = self.constraints
        ahead = [each for each in kept.windows if each.inside(x)[2] * each.inside(target)[2] < 0]
        return kept if len(ahead) == len(kept.windows) else Constraints(**{**kept.given, "window": ahead or None})


class Coming(NamedTuple):
    """A plan under way: it is there at `due` (s) and begins at `begin` (s); without one, `why`.

    `schedule` are commands that fly until then; without, the law. `scales` (2,) are what it was planned for.
    """

    plan: Plan | None
    asked: Request | None
    why: str
    due: float
    begin: float
    schedule: Schedule | None
    scales: Array


class Pilot(Boards):
    """The flight computer of `nmpc`, for one flight: `receding` is what it has in common with others; see `Boards`.

    `changes` say when it changed hands, s, to which mode, and why; `plans` are those that were flown, and `spent` is
    the processor time of each real-time iteration, s.
    """

    def __init__(self, receding: Receding, loop: Loop, rotors: ArrayLike) -> None:
        super().__init__(loop, receding.law, receding.latency, rotors)
        self._common, self._vehicle = receding, loop.vehicle
        self._units, self._m = Units.of(loop.vehicle), loop.vehicle.m / (loop.vehicle.M + loop.vehicle.m)
        self._where = _reference_program(receding.reference)
        self._error = ModelError(loop.vehicle, 1 / loop.sampled.rate)
        self._fallback = Fallback(self._by_law, receding.constraints.clearance or 0.0)
        self._mode = "waiting"
        self._coming: Coming | None = None
        self._flight: PlanInFlight | None = None
        self._failures, self._not_before, self._patience = 0, -np.inf, 1.0
        self._command: Array | None = None
        self.changes: list[tuple[float, str, str]] = []
        self.plans: list[Plan] = []
        self.spent: list[float] = []

    def planned(self, t: float, state: Array, rotors: Array, outside: Array) -> Array | None:
        """See `Boards`."""
        self._error.update(state, rotors)
        here, outside = self._relative(t, state), in_weights(self._error.forces, self._where(t)[6:], self._vehicle)
        level = upright(outside, self._m)[:2]
        if self._coming is not None and t + 1e-9 >= self._coming.due:
            self._arrive(t, self._coming)
        if self._flight is not None:
            self._command = self._follow(self._flight, t, here, rotors, outside, level)
        elif self._mode == "hovering":
            if falls(here, level, self._units):
                self._change(t, "waiting", "the rod falls")
            elif self._by_law.sampled.sensors is not None:
                self._integrate(here[:3])
        if self._mode == "waiting":
            if hovers(here, level, self._units):
                self._hover(t)
            elif self._coming is None and t >= self._not_before and self._due(here, level):
                self._coming = self._begin(t, state, rotors)
            if self._coming is not None and self._coming.schedule is not None:
                self._command = self._coming.schedule.at(t)
        return self._command

    def _integrate(self, x: Array) -> None:
        """Add a distance `x` (3,), m, of one period to the integral."""
        off = self.off + INTEGRAL / self._units.time / self._by_law.sampled.rate * x
        self.off = off / max(1.0, float(norm(off)) / (MOST_OFF * self._units.length))

    def _follow(
        self, flight: PlanInFlight, t: float, here: Array, rotors: Array, outside: Array, level: Level
    ) -> Array | None:
        """Return the command of a plan that is flown; None if it ends now."""
        command, lost = flight.command(t, here, rotors, outside, self._error.scales)
        if lost:
            self._fail(t, lost, MOST_LOST)
        elif hovers(here, level, self._units) or (flight.over(t) and not falls(here, level, self._units)):
            self._hover(t)
        return None if self._flight is None else command

    def _due(self, here: Array, level: Level) -> bool:
        """Whether a plan is due: at the beginning wherever the vehicle is, later if the law would drop the rod."""
        return not self.changes or falls(here, level, self._units)

    def _change(self, t: float, mode: str, why: str) -> None:
        if self._flight is not None:
            self.spent += self._flight.spent
        self._mode, self._coming, self._flight, self._command = mode, None, None, None
        self.off = np.zeros(3)
        self.changes.append((t, mode, why))

    def _hover(self, t: float) -> None:
        self._change(t, "hovering", "the rod stands")
        self._failures, self._patience, self._not_before = 0, 1.0, -np.inf

    def _fail(self, t: float, why: str, most: int = len(ATTEMPTS)) -> None:
        """Let the law fly, after `most` failures until it hovers."""
        self._change(t, "waiting", why)
        self._failures += 1
        pause = (2.0 ** (self._failures - 1) - 1) * PAUSE * self._units.time
        self._not_before = t + pause if self._failures < most else np.inf

    def _arrive(self, t: float, coming: Coming) -> None:
        if coming.plan is None or coming.asked is None:
            self._fail(t, coming.why)
            return
        self._change(t, "planned", coming.plan.summary)
        self.plans.append(coming.plan)
        self._flight = PlanInFlight(
            coming.plan, coming.asked, coming.begin, self._common.computing, self._vehicle, coming.scales
        )

    def _relative(self, t: float, state: Array) -> Array:
        """Return the `state` (24,) at time `t` relative to the reference."""
        here = state.copy()
        here[:6] -= self._where(t)[:6]
        return here

    def _begin(self, t: float, state: Array, rotors: Array) -> Coming:
        """Plan from where the vehicle will be by the time the plan is there, and a sketch before it, which is flown.

        The sketch becomes the plan, but with constraints, which take a race of their own. After a failure there is no
        sketch, as only the law is known to lead somewhere, nor for a slow computer.
        """
        horizon, iterations = ATTEMPTS[self._failures]
        each = MEASURED_AT_FIRST if self._common.computing is None else self._common.computing
        each *= OF_GUESS * horizon * STAGES_PER_UNIT / OF_STAGES * self._patience
        alone = each * work(ROUNDS, WIDTH, iterations) * (1 + self._common.kept(state[:3], self._where(t)[:3]).loose)
        if alone > horizon * self._units.time:
            return Coming(None, None, "a plan would take longer than its flight", t, t, None, self._error.scales)
        here, begun, measured = np.append(state, rotors), time.process_time(), self._common.computing is None
        self._fallback.scales = self._error.scales
        if self._failures or alone > LONGEST * self._units.time:
            lead = self._fallback.until(t, here, alone)
        else:
            first, *legs = (each * charge for charge in CHARGES)
            legs = [] if self._common.constraints.given.keys() - {"clearance"} else legs
            try:
                lead = self._fallback.sketch(t, here, horizon, first, legs, alone, self._ask, measured=measured)
            except InputError:
                lead = self._fallback.until(t, here, first + alone)
        found, asked, why = self._plan(t + lead.wait, lead.there, horizon, iterations, lead.found)
        took = time.process_time() - begun if measured else lead.wait
        if took > lead.wait:
            found, why, self._patience = None, "the plan is late", LATE * self._patience
        due, begin = t + max(took, lead.wait), t + lead.wait
        return Coming(found, asked, why, due, begin, lead.schedule, self._error.scales)

    def _ask(self, t: float, here: Array) -> Request:
        """Return the request for a plan from state and rotor forces `here` (24 + n,) at `t` (s). Raises InputError.

        Where it breaks a wall already, walls do not count: even such a plan goes less far than the law.
        """
        begin, target = self._relative(t, here[:SIZE]), self._where(t)[:3]
        begin[:3] = here[:3]  # constraints are about the world
        rotors, kept = np.clip(here[SIZE:], *self._vehicle.rotor_limits), self._common.kept(here[:3], target)
        ask = partial(request, self._error.machine, State.from_packed(begin), "excursion", target, rotors)
        try:
            return ask(kept)
        except InputError:
            if not kept.loose:
                raise
            return ask(self._common.mount)

    def _plan(
        self, t: float, here: Array, horizon: float, iterations: int, begun: Found | None
    ) -> tuple[Plan | None, Request | None, str]:
        """Return a plan from `here` as in `_ask`, what it answers, and why there is none.

        It is what was `begun`, if that is given.
        """
        try:
            asked = self._ask(t, here)
        except InputError as error:
            return None, None, str(error)
        if begun is None:
            found = plan_within(asked, horizon, iterations, ROUNDS, self._common.mount)
        else:
            found = plan_of(asked, begun, stages_of(horizon)[1] * len(begun.commands))
        its = asked.structure
        if its.soft:
            asked.numbers[-2] = SOFT_LAST if its.mounted or its.gates else WALL
        if its.box:
            asked.numbers[its.slices["box"]][1:] += MARGIN * np.repeat([1, -1], 3)
        return (found if found else None), asked, found.reason


@built(maxsize=16)
def _reference_program(reference: Reference) -> Any:
    """Return the function from time (s) to position, velocity and acceleration (9,) of `reference`."""
    t = ca.SX.sym("t")
    position = ca.densify(reference(t))
    return as_numpy(ca.Function("where", [t], [ca.densify(ca.vertcat(position, *derivatives(position, t, 2)))]))
