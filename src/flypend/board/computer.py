"""The flight computer stepped from Python: the reference for the kernels, and the only way to fly a callable law."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from flypend.board.command import finish, law_command, steering
from flypend.board.nominal import Nominal
from flypend.board.program import (
    Parts,
    carry_program,
    computer_view,
    filters,
    initial_memory,
    parts,
    predict_program,
    remember_program,
    trim_program,
)
from flypend.building import built
from flypend.compile.numeric import as_numpy
from flypend.geometry import Numbers
from flypend.laws import Controller
from flypend.plants.loop import Loop

NONE = np.zeros(0)

# (t (s), state (24,), rotor forces (n,), `command.OUTSIDE` (8,)) → command, all for when it acts, as predicted, e₃ up.
Steer = Callable[[float, Any, Any, Any], Any]


class FlightComputer(Protocol):
    """A flight computer, called once per control period."""

    def command(self, t: float, measured: Numbers) -> Numbers:
        """Return the command at time `t` (s) for the `measured` state (24,), e₃-up frame, or readings of sensors."""


@runtime_checkable
class Estimating(Protocol):
    """A flight computer that estimates the state from readings of sensors."""

    def estimate_from(self, estimate: Numbers) -> None:
        """Begin with the `estimate` (24,) of the state, e₃ up."""


class SteppedBoard:
    """The board of `loop`, stage by stage, with initial rotor forces `rotors` (n,), N.

    A plant with sensors needs an `estimate` (24,) of the state to begin with, e₃ up. `predicted` holds the state (24,),
    rotor forces (n,) and `OUTSIDE` (8,) that the last command was computed for, `estimated` the state (24,) that
    the sensors told, and `filtered` the memory of the estimator with which they told it.

    What commands is `law`, that of the loop, unless there is a `steer` in its place: a program of any kind around which
    the board keeps its estimator, prediction and rotor model.
    """

    def __init__(self, loop: Loop, rotors: Numbers, estimate: Numbers = None, steer: Steer | None = None) -> None:
        self._stages = _stages(replace(loop, plant=computer_view(loop.sampled)))
        self.law: Steer = self._stages.steer
        self._steer = steer or self.law
        memory = initial_memory(loop, np.asarray(rotors, dtype=float), estimate)
        self._memory, self._expecting = np.split(memory, [self._stages.made.own.length])
        self.predicted: tuple[Any, Any, Any] | None = None
        self.estimated: Any = None
        self.filtered: Any = None

    @property
    def delay(self) -> float | None:
        """The delay from measurement to command, s, that it has found; None if it does not look for it."""
        return self._stages.made.delay(self._memory)

    def command(self, t: float, measured: Numbers) -> Numbers:
        """Return the command at time `t` (s) for the `measured` state (24,), e₃-up frame, or readings of sensors."""
        return self.trim(self.ask(t, measured))

    def trim(self, command: Numbers) -> Numbers:
        """Return what is to be sent for the last `command` that was asked for."""
        return self._stages.trim(self._memory, command, NONE)

    def take_trim(self, other: SteppedBoard) -> None:
        """Go on with the trim of the board `other`, by which the last command was sent."""
        if self._stages.made.finding is not None and other._stages.made.finding is not None:
            mine, theirs = (board._stages.made.own.place("delay.trim") for board in (self, other))
            self._memory[mine] = other._memory[theirs]

    def ask(self, t: float, measured: Numbers) -> Numbers:
        """As `command`, before it is trimmed."""
        stages, outside, extra = self._stages, None, []
        if stages.correct is not None:
            self.filtered, measured, outside = stages.correct(self._expecting, measured, NONE)
            extra = [outside] if filters(stages.made.loop.sampled) else []
        self.estimated = measured
        measurement = np.append(t, measured)
        kept, forces, state, rotors, horizon = stages.predict(self._memory, measurement, NONE, *extra)
        self.predicted = (state, rotors, forces)
        command = self._steer(t + horizon.item(), state, rotors, forces)
        after = stages.remember(self._memory, kept, measurement, forces, command, NONE)
        if stages.carry is not None:
            self._expecting = stages.carry(self.filtered, outside, command, self._memory, after, NONE)
        self._memory = after
        return command


class _Stages(NamedTuple):
    """Compiled stages of a board; without an estimator, it neither corrects nor carries."""

    made: Parts
    steer: Steer
    predict: Callable[..., Any]
    remember: Callable[..., Any]
    trim: Callable[..., Any]
    correct: Callable[..., Any] | None = None
    carry: Callable[..., Any] | None = None


@built(maxsize=64)
def _stages(loop: Loop) -> _Stages:
    made = parts(loop)
    programs = [predict_program(made), remember_program(made), trim_program(made)]
    if made.estimator is not None:
        programs += [made.estimator.correct(), carry_program(made)]
    return _Stages(made, _steer(loop, made.nominal), *map(as_numpy, programs))


def _steer(loop: Loop, nominal: Nominal) -> Steer:
    if isinstance(loop.law, Controller):
        law, end = loop.law, as_numpy(finish(loop, nominal))
        return lambda t, state, rotors, _: end(law.upright(t, state), state, rotors, NONE)
    command = as_numpy(law_command(loop, nominal, steering(loop.symbolic)))
    return lambda t, state, rotors, forces: command(t, 0.0, state, rotors, forces, NONE, NONE, NONE)
