"""`track`: a controller that flies a plan with feedback, and gives way to another law if it is thrown off."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.laws import Computer, Controller, Law, inverted
from flypend.laws.references import Reference, hover
from flypend.model import State, Vehicle, Wrench
from flypend.planning.boards import Boards
from flypend.planning.feedback import Feedback, regulator
from flypend.planning.nominal import Follower
from flypend.planning.result import Plan
from flypend.planning.scaled import Units
from flypend.plants.loop import Loop

# The plan is left when the rod is this far from where it should be, rad, or the pivot, rod lengths.
FAR_ROD, FAR_PIVOT = 0.8, 1.5


@errors.named_arguments
def track(plan: Plan, *, latency: float = 0.0, otherwise: Law | None = None) -> Controller:
    """Return a controller that flies `plan` from time 0 and then hovers at its target.

    Parameters
    ----------
    plan : Plan
        The plan, which starts where the flight starts.
    latency : float
        Delay to compensate, s, as in `laws.Computer`. What exceeds it is found in flight as far as `otherwise` looks
        for it.
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
    law = fallback(otherwise, hover(plan.target))
    feedback = regulator(plan)
    return Controller(
        name="track",
        function=rotors_only("track"),
        reference=plan.reference,
        computer=Computer(latency=latency),
        flight_computer=lambda loop, rotors: Tracker(feedback, plan.vehicle, law, loop, rotors),
        because="it follows a table",
    )


def fallback(otherwise: Any, reference: Reference) -> Law:
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


class Tracker:
    """The flight computer of a tracked plan: a `feedback` on a board of its own, and the law's, which takes over.

    Parameters
    ----------
    feedback : Feedback
        The plan with its gains.
    vehicle : Vehicle
        The vehicle of the plan.
    law : Law
        What takes over.
    loop : Loop
        The closed loop that is flown.
    rotors : (n,)
        Initial rotor forces, N.

    Attributes
    ----------
    following : bool
        Whether the plan is still followed.
    """

    def __init__(self, feedback: Feedback, vehicle: Vehicle, law: Law, loop: Loop, rotors: Any) -> None:
        if loop.sampled.interface != "wrench":
            raise InputError("plant.interface", "wrench: a plan commands rotor forces", loop.sampled.interface)
        if loop.vehicle != vehicle:
            raise InputError(
                "vehicle", f"that of the plan, {vehicle.name}; Plant(mismatch=…) changes it", loop.vehicle.name
            )
        self._loop = replace(loop, law=law.bind(vehicle))
        self._latency, self._rotors = loop.law.computer.latency, np.asarray(rotors, dtype=float)
        self._follower, self._far = Follower(feedback, vehicle), FAR_PIVOT * Units.of(vehicle).length
        self.following = True
        if loop.sampled.sensors is None:
            self.estimate_from(None)

    def estimate_from(self, estimate: Any) -> None:
        """Begin with the `estimate` (24,) of the state, e₃ up."""
        self._boards = Boards(self._loop, self._latency, self._followed, self._rotors, estimate)

    def command(self, t: float, measured: Any) -> Any:
        """Return the rotor forces (n,), N, for the `measured` state (24,), e₃ up, or readings, at time `t` (s)."""
        return self._boards.command(t, measured)

    def _followed(self, t: float, state: Any, rotors: Any, _: Any) -> Any:
        """Return the command (n,), N, at `t` (s) for state and rotors then; None once they are far from the plan."""
        if not self.following:
            return None
        command, off = self._follower.command(t, state, rotors)
        self.following = bool(np.linalg.norm(off[12:15]) < FAR_ROD and np.linalg.norm(off[:3]) < self._far)
        return command if self.following else None
