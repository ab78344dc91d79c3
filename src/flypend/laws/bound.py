"""What flies: a law with all its gains for one vehicle, and what it answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType, SimpleNamespace
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.laws.gain import Gain, check_gain, is_number
from flypend.laws.references import Path, Reference
from flypend.model import State, Vehicle, Wrench
from flypend.model.state import FLIP_PACKED, E3Direction

# Thrust and moment from the frame with e₃ down to the one with e₃ up, and back.
FLIP_WRENCH = np.array([-1.0, 1.0, -1.0, -1.0])


@dataclass(frozen=True)
class Guard:
    """A quantity that must not vanish: where `signal` falls below `threshold` the law is undefined for `reason`."""

    signal: str
    threshold: float
    reason: str


@dataclass(frozen=True, kw_only=True)
class Computer:
    """What the flight computer does around a law in a sampled flight; in the ideal closed loop it has nothing to do.

    Parameters
    ----------
    lead : float
        Rotors are commanded f̂ + lead (f − f̂), f̂ being their modelled force: a lag of T acts like T/lead. 1 for none.
    latency : float
        Delay that is planned for, s: the law sees the state predicted this far ahead over the commands under way.
    observer : float
        Bandwidth of the observer of external forces, 1/s; 0 for none. Only for a law with `uses_forces`.
    force_limit : float
        Largest estimate of an external force, in weights of the machine.
    """

    lead: float = 1.0
    latency: float = 0.0
    observer: float = 0.0
    force_limit: float = 0.5

    def __post_init__(self) -> None:
        errors.number("lead", self.lead, at_least=1)
        errors.number("latency", self.latency, at_least=0, unit="s")
        errors.number("observer", self.observer, at_least=0, unit="1/s")
        errors.number("force_limit", self.force_limit, at_least=0)


@dataclass(frozen=True, kw_only=True)
class Control:
    """What a law answers: the wrench, and what it lets one see of itself.

    Parameters
    ----------
    wrench : Wrench
        Thrust and moment, in the frame of the law.
    lyapunov : dict
        Scalar expressions whose sum is the law's Lyapunov function V; the closed loop adds V and all rates.
    signals : dict
        Other scalar expressions to record.
    """

    wrench: Wrench
    lyapunov: Mapping[str, Any] = field(default_factory=dict)
    signals: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True, eq=False)
class BoundLaw:
    """A law that flies: its gains have values for one vehicle. `Law.bind` makes it.

    Parameters
    ----------
    name, e3, control, uses_forces, reference, path
        As in `Law`.
    vehicle : Vehicle
        The vehicle that it believes in.
    table : dict of Gain
        The registry of its gains.
    gains : dict
        Their values by name.
    prepared : dict
        What the law worked out for the vehicle beforehand; its equations see it beside the gains.
    guard : Guard, optional
        Where it stops being defined.
    computer : Computer
        Lead, prediction and observer around it in a sampled flight.
    fixed : tuple of str
        Gains that exported code holds as constants.
    """

    name: str
    e3: E3Direction
    vehicle: Vehicle
    control: Callable[..., Control | Wrench]
    table: Mapping[str, Gain] = field(default_factory=dict)
    gains: Mapping[str, Any] = field(default_factory=dict)
    prepared: Mapping[str, Any] = field(default_factory=dict)
    guard: Guard | None = None
    computer: Computer = field(default_factory=Computer)
    uses_forces: bool = False
    reference: Reference | None = None
    path: Path | None = None
    fixed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "gains", MappingProxyType(dict(self.gains)))

    def bind(self, vehicle: Vehicle) -> BoundLaw:
        """Itself, which is bound to `vehicle` already. Raises InputError if it is bound to another one."""
        if vehicle != self.vehicle:
            raise errors.InputError("law", f"one bound to {vehicle.name}", f"{self.name} bound to {self.vehicle.name}")
        return self

    @property
    def numbers(self) -> dict[str, float]:
        """Those of its gains that are real numbers, in their order: what may vary from run to run in one program."""
        return {name: float(value) for name, value in self.gains.items() if is_number(value)}

    @property
    def options(self) -> dict[str, str]:
        """Those of its gains that are words."""
        return {name: value for name, value in self.gains.items() if isinstance(value, str)}

    @property
    def along(self) -> Callable[[Path], BoundLaw] | None:
        """The same law along another path (see `laws.references.Path`); None for a law that follows none."""
        return None if self.path is None else self._along

    def _along(self, path: Path) -> BoundLaw:
        return replace(self, path=path)

    def check_gain(self, name: str, values: Any, prefix: str = "gains") -> NDArray[Any]:
        """`values` of the gain called `name`, one or many, if it may take them; messages begin with `prefix`.

        Raises InputError for a name that is no number of the law, and values out of bounds.
        """
        return check_gain(self.table, name, values, prefix)

    def evaluate(
        self,
        t: Any,
        state: State,
        vehicle: Vehicle,
        forces: tuple[Any, Any] | None = None,
        gains: Mapping[str, Any] | None = None,
    ) -> Control:
        """The control for symbols of time `t` (s) and `state`, for `vehicle` under external `forces` (default none).

        `gains` are symbols that stand for some of the law's numbers. `vehicle` is that of the law, or one whose
        constants are symbols.
        """
        given = SimpleNamespace(**{**self.prepared, **self.gains, **(gains or {})})
        known = (forces or (ca.SX.zeros(3), ca.SX.zeros(3)),) if self.uses_forces else ()
        followed = {} if self.path is None else {"path": self.path}
        try:
            control = self.control(t, state, vehicle, given, *known, **followed)
        except RuntimeError as error:
            if "truth value" not in str(error):
                raise
            raise errors.InputError("law", "cases by casadi.if_else, since it is written in symbols", "an if") from None
        if not isinstance(control, Control | Wrench):
            raise errors.InputError("law", "a Control or a Wrench", type(control).__name__)
        return Control(wrench=control) if isinstance(control, Wrench) else control

    def upright(
        self,
        t: Any,
        packed: Any,
        forces: Any = None,
        gains: Mapping[str, Any] | None = None,
        vehicle: Vehicle | None = None,
    ) -> Any:
        """Thrust and moment (4, 1) with e₃ up, whatever the law's own frame, for symbols.

        Parameters
        ----------
        t, packed : SX
            Time, a symbol or an expression, and the packed state (24, 1) with e₃ up, a symbol.
        forces : SX (6, 1), optional
            External forces on vehicle and bob, N; default none.
        gains : dict, optional
            Symbols that stand for some of the law's numbers.
        vehicle : Vehicle, optional
            A vehicle whose constants are symbols; default the law's own.
        """
        external = None if forces is None else (forces[:3], forces[3:])
        time = t if isinstance(t, ca.SX) and t.is_symbolic() else ca.SX.sym("t")  # references are differentiated by it
        wrench = self.evaluate(time, State.symbolic(packed), vehicle or self.vehicle, external, gains).wrench
        stacked = ca.densify(ca.vertcat(wrench.thrust, wrench.moment))
        if time is not t:
            stacked = ca.substitute(stacked, time, t)
        if self.e3 == "up":
            return stacked
        return ca.substitute(stacked, packed, packed * FLIP_PACKED) * FLIP_WRENCH
