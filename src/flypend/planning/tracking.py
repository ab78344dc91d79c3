"""`track` and `plan_and_track`: controllers that fly a plan with feedback, and give way to a law if thrown off."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from flypend import errors
from flypend.board.computer import FlightComputer, SteppedBoard
from flypend.building import builds
from flypend.errors import InputError
from flypend.geometry import Numbers
from flypend.laws import BoundLaw, Computer, Controller, Law, inverted
from flypend.laws.references import Reference, hover
from flypend.model import State, Vehicle, Wrench
from flypend.planning.constraints import Constraints, Keywords, gather
from flypend.planning.dynamics import Array, Units
from flypend.planning.feedback import Feedback, Follower, regulator
from flypend.planning.planner import plan
from flypend.planning.problem import weights_of
from flypend.planning.result import Plan
from flypend.plants.loop import Loop

PATIENT = 600.0  # s: how busy the machine is must not decide how a flight goes
# The plan is left when the rod is this far from where it should be, rad, or the pivot, rod lengths.
FAR_ROD, FAR_PIVOT = 0.8, 1.5


class Boards(ABC):
    """The flight computer of a planned flight: two boards, each of which is told every measurement and every command.

    One predicts for the plan, the other flies the law, which so takes over as if it had always flown. Both find their
    delay if the law's does, and use the same estimator.

    The closed `loop` is flown from initial `rotors` (n,), N, by `law` where no plan does; the plan's board begins with
    a delay of `latency` (s). To the position that the law is shown, `off` (3,), m, is added.
    """

    def __init__(self, loop: Loop, law: Law, latency: float, rotors: ArrayLike) -> None:
        if loop.sampled.interface != "wrench":
            raise InputError("plant.interface", "wrench: a plan commands rotor forces", loop.sampled.interface)
        self._by_law, self._latency = replace(loop, law=law.bind(loop.vehicle)), latency
        self._rotors, self.off = np.asarray(rotors, dtype=float), np.zeros(3)
        if loop.sampled.sensors is None:
            self.estimate_from(None)

    def estimate_from(self, estimate: Array | None) -> None:
        """Begin with the `estimate` (24,) of the state, e₃ up."""
        by_plan = replace(self._by_law, law=for_plans(self._by_law.law, self._latency))
        self._for_plan = SteppedBoard(by_plan, self._rotors, estimate, self._steer)
        self._for_law = SteppedBoard(self._by_law, self._rotors, estimate, self._or_law)

    def command(self, t: float, measured: Any) -> Numbers:
        """Return the rotor forces (n,), N, for the `measured` state (24,), e₃ up, or readings, at time `t` (s)."""
        self._measured = t, measured
        command = self._for_plan.ask(t, measured)
        by_law = self._given is None
        flies, other = (self._for_law, self._for_plan) if by_law else (self._for_plan, self._for_law)
        other.take_trim(flies)  # of what is sent there is one trim
        return flies.trim(command)

    @abstractmethod
    def planned(self, t: float, state: Array, rotors: Array, outside: Array) -> Array | None:
        """Return the command (n,), N, that acts at `t` (s); None if the law flies.

        `state` (24,), `rotors` (n,), N, and `outside` (8,), `board.command.OUTSIDE`, are those predicted for then.
        """

    def _steer(self, *predicted: Any) -> Numbers:
        self._given = self.planned(*predicted)
        return self._for_law.ask(*self._measured)

    def _or_law(self, t: float, state: Array, rotors: Array, outside: Array) -> Numbers:
        """Return the rotor forces of the plan, N, or those of the law where there is no plan."""
        if self._given is not None:
            return self._given
        shown = state.copy()
        shown[:3] += self.off
        return self._for_law.law(t, shown, rotors, outside)


@lru_cache(maxsize=16)
def for_plans(law: BoundLaw, latency: float) -> BoundLaw:
    """Return `law` on a board that predicts over a `latency` (s) and what it finds, but not over the rotors' lag."""
    return replace(law, computer=replace(law.computer, latency=latency, lead=1.0, models_lag=True))


@errors.named_arguments
@builds
def track(plan: Plan, *, latency: float = 0.0, otherwise: Law | None = None) -> Controller:
    """Return a controller that flies `plan` from time 0 and then hovers at its target.

    Parameters
    ----------
    plan : Plan
        The plan, which starts where the flight starts.
    latency : float
        Delay to compensate, s, as in `laws.Computer`. A further delay is found in flight, as far as `otherwise`
        searches for one.
    otherwise : Law, optional
        The law that takes over for good once rod or pivot are too far from the plan; default the inverted law about the
        target.

    Raises
    ------
    InputError
        If the plan failed, or `otherwise` is no law.
    """
    if not isinstance(plan, Plan) or not plan:
        raise InputError("plan", "a plan that can be flown", getattr(plan, "reason", "") or repr(plan)[:80])
    law = fallback_law(otherwise, hover(plan.target))
    feedback = regulator(plan)
    return Controller(
        name="track",
        function=rotors_only("track"),
        reference=plan.reference,
        computer=Computer(latency=latency),
        flight_computer=lambda loop, rotors: Tracker(feedback, plan.vehicle, law, loop, rotors),
        because="it follows a table",
    )


def fallback_law(otherwise: Any, reference: Reference) -> Law:
    """Return the law that flies where no plan does, `otherwise`, or the inverted law about `reference`.

    Raises InputError if it is no law in symbols.
    """
    if otherwise is not None and not isinstance(otherwise, Law):
        raise InputError("otherwise", "a Law", repr(otherwise)[:80])
    return otherwise or inverted(reference)


def rotors_only(name: str) -> Callable[[float, State], Wrench]:
    """Return the wrench of the controller `name` that has none: its flight computer commands the rotors one by one."""

    def refuse(t: float, state: State) -> Wrench:
        raise InputError("law", "one that gives a wrench", f"{name}, which commands rotor forces")

    return refuse


class Tracker(Boards):
    """The flight computer of a tracked plan for `vehicle`, with its gains in `feedback`; the rest as for `Boards`.

    The law takes over once the flight is too far from the plan, which it is not `following` then.
    """

    def __init__(self, feedback: Feedback, vehicle: Vehicle, law: Law, loop: Loop, rotors: ArrayLike) -> None:
        super().__init__(loop, law, loop.law.computer.latency, rotors)
        if loop.vehicle != vehicle:
            wanted = f"that of the plan, {vehicle.name}; Plant(mismatch=…) changes it"
            raise InputError("vehicle", wanted, loop.vehicle.name)
        self._follower, self._far = Follower(feedback, vehicle), FAR_PIVOT * Units.of(vehicle).length
        self.following = True

    def planned(self, t: float, state: Array, rotors: Array, outside: Array) -> Array | None:
        """See `Boards`; None once the state is far from the plan."""
        if not self.following:
            return None
        command, off = self._follower.command(t, state, rotors)
        self.following = bool(np.linalg.norm(off[12:15]) < FAR_ROD and np.linalg.norm(off[:3]) < self._far)
        return command if self.following else None


@errors.named_arguments
def plan_and_track(
    objective: str | Mapping[str, float] = "excursion",
    *,
    target: ArrayLike = (0.0, 0.0, 0.0),
    latency: float = 0.0,
    otherwise: Law | None = None,
    duration: float | None = None,
    constraints: Constraints | None = None,
    **keywords: Unpack[Keywords],
) -> Controller:
    """Return a controller that plans a flight from its first measurement, tracks the plan, and hovers.

    Use it like a law, for any vehicle. Planning takes no simulated time.

    Parameters
    ----------
    objective, target
        As in `plan`.
    latency : float
        As in `track`.
    otherwise : Law, optional
        The law that flies where there is no plan, or takes over once a flight is too far from it; default the inverted
        law about the target.
    duration, constraints, **keywords
        As in `plan`, except a path.

    Raises
    ------
    InputError
        If objective, constraints or `otherwise` are invalid. Other errors of `plan` are raised when a flight begins.
    """
    weights_of(objective)
    kept = gather("plan_and_track", constraints, keywords)
    if kept.path is not None:
        raise InputError("path", "nothing: flights begin where they are thrown", repr(kept.path)[:80])
    goal = errors.array("target", target, (3,))
    asked = partial(plan, objective=objective, duration=duration, target=goal, constraints=kept, time_limit=PATIENT)
    law = fallback_law(otherwise, hover(goal))
    return Controller(
        name="plan",
        function=rotors_only("plan"),
        reference=hover(goal),
        computer=Computer(latency=latency),
        flight_computer=lambda loop, rotors: Autopilot(asked, law, loop, rotors),
        because="it plans each flight and follows a table",
    )


class Autopilot:
    """The flight computer that plans with `asked`, (vehicle, start, rotors=) → plan, at its first command, and tracks.

    Without a plan `law` flies the closed `loop`, from initial `rotors` (n,), N.
    """

    def __init__(self, asked: Any, law: Law, loop: Loop, rotors: Any) -> None:
        self._asked, self._law, self._loop, self._rotors = asked, law, loop, np.asarray(rotors, dtype=float)
        self._flies: FlightComputer | None = None
        self._begin, self._estimate = 0.0, None

    def estimate_from(self, estimate: Any) -> None:
        """Begin with the `estimate` (24,) of the state, e₃ up, and plan from there."""
        self._estimate = estimate

    def command(self, t: float, measured: Any) -> Any:
        """Return the rotor forces (n,), N, for the `measured` state (24,), e₃ up, or readings, at time `t` (s)."""
        if self._flies is None:
            self._flies, self._begin = self._plan_computer(measured if self._estimate is None else self._estimate), t
        return self._flies.command(t - self._begin, measured)

    def _plan_computer(self, state: Any) -> FlightComputer:
        """Return what flies from a `state` (24,) on."""
        vehicle = self._loop.vehicle
        forces = np.clip(self._rotors, *vehicle.rotor_limits)
        found = self._asked(vehicle, State.trusted(np.array(state)), rotors=forces)
        if not found:
            return SteppedBoard(replace(self._loop, law=self._law.bind(vehicle)), self._rotors, self._estimate)
        tracker = Tracker(regulator(found), vehicle, self._law, self._loop, self._rotors)
        if self._estimate is not None:
            tracker.estimate_from(self._estimate)
        return tracker
