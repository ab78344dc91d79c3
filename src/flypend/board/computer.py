"""The flight computer step by step in Python: the reference of the kernels, and the way of laws that are no symbols."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any, Protocol

import numpy as np

from flypend.board.believed import Believed
from flypend.board.command import finish, law_command, steering
from flypend.board.program import initial_memory, known, predicting, remembering
from flypend.compile.numeric import as_numpy
from flypend.laws import Controller
from flypend.plants.loop import Loop

NONE = np.zeros(0)


class FlightComputer(Protocol):
    """What a sampled flight asks once per control period."""

    def command(self, t: float, measured: Any) -> Any:
        """The command for the state `measured` (24,), e₃ up, at time `t` (s)."""


class SteppedBoard:
    """The board of `loop`, stage by stage, starting with rotor forces `rotors` (n,), N.

    `predicted` is the last state (24,), rotor forces (n,) and external forces (6,) that a command was computed for.
    """

    def __init__(self, loop: Loop, rotors: Any) -> None:
        self._predict, self._steer, self._remember = _stages(replace(loop, plant=known(loop.sampled)))
        self._memory = initial_memory(loop, np.asarray(rotors, dtype=float))
        self.predicted: tuple[Any, Any, Any] | None = None

    def command(self, t: float, measured: Any) -> Any:
        """The command for the state `measured` (24,), e₃ up, at time `t` (s)."""
        measurement = np.append(t, measured)
        kept, forces, state, rotors = self._predict(self._memory, measurement, NONE)
        self.predicted = (state, rotors, forces)
        command = self._steer(t, state, rotors, forces)
        self._memory = self._remember(self._memory, kept, measurement, forces, command, NONE)
        return command


@lru_cache(maxsize=64)
def _stages(loop: Loop) -> tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]]:
    believed = Believed.numbers(loop.vehicle)
    steer = _called(loop, loop.law) if isinstance(loop.law, Controller) else _compiled(loop, believed)
    return as_numpy(predicting(loop, believed)), steer, as_numpy(remembering(loop, believed))


def _compiled(loop: Loop, believed: Believed) -> Callable[..., Any]:
    law = as_numpy(law_command(loop, believed, steering(loop.symbolic)))
    return lambda t, state, rotors, forces: law(t, state, rotors, forces, NONE, NONE, NONE)


def _called(loop: Loop, law: Controller) -> Callable[..., Any]:
    """The same for a `law` that is a Python callable."""
    end = as_numpy(finish(loop, Believed.numbers(loop.vehicle)))
    latency = law.computer.latency
    return lambda t, state, rotors, _: end(law.upright(t + latency, state), state, rotors, NONE)
