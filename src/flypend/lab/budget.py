"""What one answer may cost, and whether anybody still waits for it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from flypend.board.computer import FlightComputer, SteppedBoard
from flypend.errors import InputError
from flypend.lab.setting import SYMBOLS
from flypend.laws import Controller
from flypend.plants.loop import Loop

MOST_STEPS = 20_000  # of the ideal plant, over all parts of a flight; usual gains need less than 1,000 for 30 s
SPENT = f"the laboratory stops a flight after {MOST_STEPS:,} integration steps; flypend run does not"
SECONDS = 3.0  # of processor time, without compiling


class Abandoned(Exception):  # noqa: N818  the way an answer ends, not a mistake
    """Nobody waits for the answer any more."""


@dataclass
class Budget:
    """What is left for a flight; it begins when it is made.

    Parameters
    ----------
    wanted : callable
        Whether somebody still waits for the flight.
    steps : int
        Steps of the ideal plant that are left.
    seconds : float
        Processor time that the flight may take in its thread, s. Waiting for other pages does not count.
    """

    wanted: Callable[[], bool] = lambda: True
    steps: int = MOST_STEPS
    seconds: float = SECONDS
    begun: float = field(default_factory=time.thread_time)

    def check(self, t: float) -> None:
        """Raise Abandoned if nobody waits, and InputError if the processor time is spent, at flight time `t` (s)."""
        if not self.wanted():
            raise Abandoned
        if time.thread_time() - self.begun > self.seconds:
            most = f"at most {self.seconds:g} s of processor time in the laboratory"
            raise InputError("flight", most, f"more after {t:.3g} s of flight")

    def watch(self, law: Controller) -> Controller:
        """Return `law`, a Python function, with a check at every control tick."""

        def computer(loop: Loop, rotors: Any) -> _Watched:
            with SYMBOLS:
                made = law.flight_computer(loop, rotors) if law.flight_computer else SteppedBoard(loop, rotors)
            return _Watched(made, self)

        return replace(law, flight_computer=computer)


@dataclass(frozen=True)
class _Watched:
    """A flight computer that stops when its `budget` is spent."""

    computer: FlightComputer
    budget: Budget

    def command(self, t: float, measured: Any) -> Any:
        """Return the command of the computer for the `measured` state (24,) at time `t` (s)."""
        self.budget.check(t)
        return self.computer.command(t, measured)
