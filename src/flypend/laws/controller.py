"""A law that is a plain Python callable: not symbolic, so slower, and always sampled."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.geometry import Numbers
from flypend.laws.bound import Computer
from flypend.laws.gain import Gain, Tunable, check_gains, is_number, table
from flypend.laws.located import Located, is_own, wrench_of
from flypend.laws.references import Reference, check_reference
from flypend.model import State, Vehicle, Wrench
from flypend.model.state import E3Direction, convert_packed

Steering = Callable[[float, State], Wrench]


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Controller(Tunable):
    """State feedback by any Python callable: not symbolic, so slower, and always sampled.

    Parameters
    ----------
    name : str
        Name for tables and files.
    function : callable
        `function(t, state) -> Wrench`, with t (s) and the measured `State`, in the frame given by `e3`.
    e3 : "up" or "down"
        Direction of the world's third axis in the function's frame.
    rate : float
        Control rate in the ideal plant, Hz; other plants have their own.
    reference : callable, optional
        Pivot position to hold or follow, as a CasADi function of time.
    gains : dict
        Gain values by name.
    computer : Computer
        Lead, prediction and observer around the law in a sampled flight.
    flight_computer : callable, optional
        `flight_computer(loop, rotors)` returns an object that replaces the whole flight computer in a sampled flight.
        Its method `command(t, state)` returns the command for time t (s) and a measured state (24,), e₃ up. `loop` is
        a `plants.loop.Loop`; `rotors` (n,) are the initial rotor forces, N.
    steering : callable, optional
        `steering(vehicle, gains)` returns the `function` for a vehicle, if it depends on vehicle or gains.
    table : dict of Gain, optional
        Registry of the gains; default made from `gains`, without bounds.
    because : str
        Why it is not symbolic, in a few words.
    """

    name: str
    function: Steering
    e3: E3Direction = "up"
    rate: float = 500.0
    reference: Reference | None = None
    gains: Mapping[str, Any] = field(default_factory=dict)
    computer: Computer = field(default_factory=Computer)
    flight_computer: Callable[[Any, Any], Any] | None = None
    steering: Callable[[Vehicle, Mapping[str, Any]], Steering] | None = None
    table: Mapping[str, Gain] = field(default_factory=dict)
    because: str = ""

    def __post_init__(self) -> None:
        errors.one_of("controller.e3", self.e3, ("up", "down"))
        errors.check_arguments("controller.function", self.function, "(t, state)")
        errors.number("controller.rate", self.rate, above=0, unit="Hz")
        check_reference(self.reference)
        object.__setattr__(self, "table", table(self.table or self.gains))
        object.__setattr__(self, "gains", MappingProxyType(dict(self.gains)))

    def bind(self, vehicle: Vehicle) -> Controller:
        """Return the controller for `vehicle`: itself, unless it depends on vehicle or gains."""
        if self.steering is None:
            return self
        steering = Located(self.steering, self.name, inner=True) if is_own(self.steering) else self.steering
        return replace(self, function=steering(vehicle.commanded(), self.gains))

    @property
    def numbers(self) -> dict[str, float]:
        """The real-valued gains, in order."""
        return {name: float(value) for name, value in self.gains.items() if is_number(value)}

    @property
    def given(self) -> dict[str, Any]:
        """The gains whose values differ from their defaults."""
        return {name: value for name, value in self.gains.items() if value != self.table[name].default}

    def gains_for(self, _: Vehicle) -> dict[str, Any]:
        """Gain values by name, the same for every vehicle."""
        return dict(self.gains)

    def with_gains(self, given: Mapping[str, Any], prefix: str = "") -> Controller:
        """Return a copy with the gains `given`, checked like `Law.with_gains`; messages begin with `prefix`."""
        return replace(self, gains={**self.gains, **check_gains(self.table, given, prefix)})

    def upright(self, t: float, packed: Numbers) -> NDArray[Any]:
        """Return thrust and moment (4,), e₃ up, at time `t` (s) for a `packed` state (24,), e₃ up."""
        answer = self._answer(t, State.trusted(convert_packed(packed, self.e3)))
        wrench = wrench_of(answer, self.function, self.name).in_frame(self.e3)
        return np.append(wrench.thrust, wrench.moment)

    @cached_property
    def _answer(self) -> Steering:
        """The function; that of a user with its mistakes on one line."""
        return Located(self.function, self.name) if is_own(self.function) else self.function
