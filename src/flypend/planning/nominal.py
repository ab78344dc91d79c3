"""A nominal flight with gains, followed: what it commands at a time and a state."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from flypend.compile.numeric import as_numpy
from flypend.model import Vehicle
from flypend.model.state import SIZE
from flypend.planning.feedback import Feedback, deviation, hovering
from flypend.plants.equations import rotor_step
from flypend.plants.lag import step_timing

STILL = np.zeros(6)


class Follower:
    """The feedback of a `vehicle` along a nominal flight; its last stage is held for ever."""

    def __init__(self, feedback: Feedback, vehicle: Vehicle) -> None:
        self.feedback = feedback
        (self._deviation, self._hovering), self.stepped = _deviations(len(vehicle.rotor_spins)), stepping(vehicle)
        self._limits = vehicle.rotor_limits

    def command(self, t: float, state: Any, rotors: Any) -> tuple[Any, Any]:
        """Return the command (n,), N, at `t` (s) for a `state` (24,) and `rotors` (n,), and the deviation (18 + n,)."""
        wanted, nominal, k = self.nominal(t)
        deviation = self._hovering if k == len(self.feedback.commands) - 1 else self._deviation
        off = deviation(nominal, np.append(state, rotors))
        return np.clip(wanted - self.feedback.gains[k] @ off, *self._limits), off

    def nominal(self, t: float) -> tuple[Any, Any, int]:
        """Return the nominal command and state (24 + n,) at `t` (s), and the number of the stage."""
        f = self.feedback
        k = min(int(t / f.stage + 1e-9), len(f.commands) - 1)
        into = t - k * f.stage
        if k == len(f.commands) - 1 or into < 1e-9:
            return f.commands[k], f.states[k], k
        return f.commands[k], self.stepped(f.states[k, :SIZE], f.states[k, SIZE:], f.commands[k], into), k


@lru_cache(maxsize=16)
def stepping(vehicle: Vehicle) -> Any:
    """Return (state, rotors, command, duration, forces) → state and rotor forces (24 + n,), a step of the plant later.

    A duration is in s; `forces` (6,), N, are those from outside.
    """
    step, lag = as_numpy(rotor_step(vehicle)), vehicle.rotor_lag

    def stepped(state: Any, rotors: Any, command: Any, duration: float, forces: Any = STILL) -> Any:
        return np.append(*step(state, rotors, command, forces, step_timing(lag, round(duration, 9))))

    return stepped


@lru_cache(maxsize=4)
def _deviations(rotors: int) -> tuple[Any, Any]:
    """Return the deviations from a nominal state, and from hover with any heading."""
    return as_numpy(deviation(rotors)), as_numpy(hovering(rotors))
