"""A law that is any Python callable: not symbolic, so slower, and only ever sampled."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.laws.bound import Computer
from flypend.laws.gain import Gain, check_gain, checked, is_number, table
from flypend.laws.references import Reference
from flypend.model import State, Vehicle, Wrench
from flypend.model.state import E3Direction, seen_packed

Steering = Callable[[float, State], Wrench]


@dataclass(frozen=True, kw_only=True, eq=False)
class Controller:
    """A state feedback that is any Python callable: not symbolic, so slower, and only ever sampled.

    Parameters
    ----------
    name : str
        Name for tables and files.
    function : callable
        `function(t, state) -> Wrench` with t (s) and a `State` as measured, in the frame of `e3`.
    e3 : "up" or "down"
        Direction of the world's third axis that the function works in.
    rate : float
        Control rate in the ideal plant, Hz; other plants have a rate of their own.
    reference : callable, optional
        Position of the pivot that it holds or follows, as a CasADi function of time.
    gains : dict
        Values of its gains, by name.
    computer : Computer
        Lead, prediction and observer around it in a sampled flight.
    flight_computer : callable, optional
        `flight_computer(loop, rotors)` gives what stands for the whole flight computer in a sampled flight: its method
        `command(t, state)` answers a measured state (24,), e₃ up, at t (s) with a command. `loop` is a
        `plants.loop.Loop`, `rotors` (n,) are the forces that the rotors begin with, N.
    steering : callable, optional
        `steering(vehicle, gains)` gives the `function` for a vehicle, for one that depends on vehicle or gains.
    table : dict of Gain, optional
        The registry of its gains; default what `gains` says, without bounds.
    because : str
        Why it is not written in symbols, in a few words.
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
        errors.number("controller.rate", self.rate, above=0, unit="Hz")
        object.__setattr__(self, "table", table(self.table or self.gains))
        object.__setattr__(self, "gains", MappingProxyType(dict(self.gains)))

    def bind(self, vehicle: Vehicle) -> Controller:
        """As it flies `vehicle`: itself, unless it depends on the vehicle or on gains."""
        if self.steering is None:
            return self
        return replace(self, function=self.steering(vehicle, self.gains))

    @property
    def numbers(self) -> dict[str, float]:
        """Those of its gains that are real numbers, in their order."""
        return {name: float(value) for name, value in self.gains.items() if is_number(value)}

    @property
    def given(self) -> dict[str, Any]:
        """Values of those of its gains that are not the defaults."""
        return {name: value for name, value in self.gains.items() if value != self.table[name].default}

    def proposed(self, vehicle: Vehicle) -> dict[str, Any]:
        """The defaults of all gains for `vehicle`, by name."""
        return {name: gain.value(vehicle) for name, gain in self.table.items()}

    def gains_for(self, _: Vehicle) -> dict[str, Any]:
        """The values of its gains, by name, which are the same for every vehicle."""
        return dict(self.gains)

    def check_gain(self, name: str, values: Any, prefix: str = "gains") -> NDArray[Any]:
        """`values` of the gain called `name`, one or many, if it may take them; messages begin with `prefix`.

        Raises InputError for a name that is no number of the controller, and values out of bounds.
        """
        return check_gain(self.table, name, values, prefix)

    def with_gains(self, given: Mapping[str, Any], prefix: str = "") -> Controller:
        """The same with the gains `given`, checked; messages begin with `prefix`. Raises InputError."""
        return replace(self, gains={**self.gains, **checked(self.table, given, prefix)})

    def upright(self, t: float, packed: Any) -> NDArray[Any]:
        """Thrust and moment (4,) with e₃ up at time `t` (s), for a `packed` state (24,) with e₃ up."""
        wrench = self.function(t, State.from_packed(seen_packed(packed, self.e3))).seen(self.e3)
        return np.append(wrench.thrust, wrench.moment)
