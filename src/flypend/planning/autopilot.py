"""`plan_and_track`: a controller that plans from wherever its flight begins, and tracks that plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from flypend import errors
from flypend.board.computer import FlightComputer, SteppedBoard
from flypend.errors import InputError
from flypend.laws import Computer, Controller, Law
from flypend.laws.references import hover
from flypend.model import State
from flypend.planning.constraints import Constraints, Keywords, gathered
from flypend.planning.feedback import regulator
from flypend.planning.planner import plan
from flypend.planning.request import weights_of
from flypend.planning.tracking import Tracker, fallback, rotors_only
from flypend.plants.loop import Loop

PATIENT = 600.0  # s: how busy the machine is must not decide how a flight goes


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

    It flies, compares and is judged like a law, and plans for whatever vehicle it is told. Planning takes no time in
    the flight.

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
        If objective, constraints or `otherwise` are none; other errors of `plan` come when a flight begins.
    """
    weights_of(objective)
    kept = gathered("plan_and_track", constraints, keywords)
    if kept.path is not None:
        raise InputError("path", "nothing: flights begin where they are thrown", repr(kept.path)[:80])
    goal = errors.array("target", target, (3,))
    asked = partial(plan, objective=objective, duration=duration, target=goal, constraints=kept, time_limit=PATIENT)
    law = fallback(otherwise, hover(goal))
    return Controller(
        name="plan",
        function=rotors_only("plan"),
        reference=hover(goal),
        computer=Computer(latency=latency),
        flight_computer=lambda loop, rotors: Autopilot(asked, law, loop, rotors),
        because="it plans each flight and follows a table",
    )


class Autopilot:
    """The flight computer that plans with `asked` (vehicle, start) at its first command, and then tracks.

    Parameters
    ----------
    asked : callable
        (vehicle, start, rotors=) → plan.
    law : Law
        What flies without a plan.
    loop : Loop
        The closed loop that is flown.
    rotors : (n,)
        Initial rotor forces, N.
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
            self._flies, self._begin = self._planned(measured if self._estimate is None else self._estimate), t
        return self._flies.command(t - self._begin, measured)

    def _planned(self, state: Any) -> FlightComputer:
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
