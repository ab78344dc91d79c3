"""What a control law is: one function of symbols, its gains, and the frame it is written in."""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType, SimpleNamespace
from typing import Any

import casadi as ca

from flypend import errors
from flypend.laws.references import Path
from flypend.model import State, Vehicle, Wrench
from flypend.model.state import E3Direction

BUILT_IN = ("printed", "corrected", "inverted", "lqr")


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
class Law:
    """A state feedback.

    Parameters
    ----------
    name : str
        Name for tables and files.
    e3 : "up" or "down"
        Direction of the world's third axis in which the law is written; states given to a run are in this frame.
    gains : dict
        Its numbers and options, as given to its factory.
    control : callable
        `control(t, state, vehicle, gains) -> Control` (or a bare `Wrench`) in CasADi expressions; `gains.k` is gain k.
        With `uses_forces` it takes a fifth argument, the estimated external forces (on vehicle, on bob), each (3, 1).
    guard : Guard, optional
        Where the law stops being defined.
    computer : Computer
        Lead, prediction and observer around the law in a sampled flight.
    uses_forces : bool
        Whether the law compensates external forces.
    reference : callable, optional
        Position (3, 1) of the pivot that the law holds or follows, as a CasADi function of time; None for none.
    for_vehicle : callable, optional
        For a law that takes its gains from the vehicle: the law with the gains for a vehicle.
    along : callable, optional
        For a bound law that follows a path: the same law along another path (see `laws.references.Path`).
    fixed : tuple of str
        Gains that decide how much there is to compute: exported code holds them as constants.
    """

    name: str
    e3: E3Direction
    control: Callable[..., Control | Wrench]
    gains: Mapping[str, Any] = field(default_factory=dict)
    guard: Guard | None = None
    computer: Computer = field(default_factory=Computer)
    uses_forces: bool = False
    reference: Callable[[Any], Any] | None = None
    for_vehicle: Callable[[Vehicle], Law] | None = None
    along: Callable[[Path], Law] | None = None
    fixed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        errors.one_of("law.e3", self.e3, ("up", "down"))
        object.__setattr__(self, "gains", MappingProxyType(dict(self.gains)))
        errors.only_known("law.fixed", dict.fromkeys(self.fixed), self.numbers)

    def bound(self, vehicle: Vehicle) -> Law:
        """The law as it flies `vehicle`: itself, or with the gains that it takes from the vehicle."""
        return self.for_vehicle(vehicle) if self.for_vehicle is not None else self

    @property
    def numbers(self) -> dict[str, float]:
        """Those of its gains that are real numbers, in their order: what may vary from run to run in one program."""
        return {name: float(value) for name, value in self.gains.items() if type(value) in (float, int)}

    def evaluate(
        self,
        t: Any,
        state: State,
        vehicle: Vehicle,
        forces: tuple[Any, Any] | None = None,
        gains: Mapping[str, Any] | None = None,
    ) -> Control:
        """The control for symbols of time `t` (s) and `state`, for `vehicle` under external `forces` (default none).

        `gains` are symbols that stand for some of the law's numbers.
        """
        known = (forces or (ca.SX.zeros(3), ca.SX.zeros(3)),) if self.uses_forces else ()
        try:
            control = self.control(t, state, vehicle, SimpleNamespace(**{**self.gains, **(gains or {})}), *known)
        except RuntimeError as error:
            if "truth value" not in str(error):
                raise
            raise errors.InputError("law", "cases by casadi.if_else, since it is written in symbols", "an if") from None
        if not isinstance(control, Control | Wrench):
            raise errors.InputError("law", "a Control or a Wrench", type(control).__name__)
        return Control(wrench=control) if isinstance(control, Wrench) else control


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
        Numbers to keep with the run.
    computer : Computer
        Lead, prediction and observer around it in a sampled flight.
    flight_computer : callable, optional
        `flight_computer(loop, rotors)` gives what stands for the whole flight computer in a sampled flight: its method
        `command(t, state)` answers a measured state (24,), e₃ up, at t (s) with a command. `loop` is a
        `plants.loop.Loop`, `rotors` (n,) are the forces that the rotors begin with, N.
    """

    name: str
    function: Callable[[float, State], Wrench]
    e3: E3Direction = "up"
    rate: float = 500.0
    reference: Callable[[Any], Any] | None = None
    gains: Mapping[str, Any] = field(default_factory=dict)
    computer: Computer = field(default_factory=Computer)
    flight_computer: Callable[[Any, Any], Any] | None = None

    def __post_init__(self) -> None:
        errors.one_of("controller.e3", self.e3, ("up", "down"))
        errors.number("controller.rate", self.rate, above=0, unit="Hz")

    def bound(self, _: Vehicle) -> Controller:
        """Itself: a callable does not take gains from the vehicle."""
        return self


def law_names() -> list[str]:
    """Names of the laws that come with the package."""
    return list(BUILT_IN)


def law_from_dict(values: Mapping[str, Any], key: str = "law") -> Law:
    """The law of a TOML table `values`, {name, gains = {...}, reference = {...}}; messages begin with `key`.

    A reference has a `shape` (hover, line, circle, lemniscate) and the arguments of that function in `laws.references`.

    Raises InputError for an unknown law or gain (with the nearest known name) and for gains out of range.
    """
    errors.only_known(key, values, ("name", "gains", "reference"))
    name = errors.one_of(f"{key}.name", values.get("name"), BUILT_IN)
    gains = values.get("gains", {})
    if not isinstance(gains, Mapping):
        raise errors.InputError(f"{key}.gains", "a table of gains", repr(gains))
    factory = getattr(importlib.import_module(f"flypend.laws.{name}"), name)
    parameters = inspect.signature(factory).parameters
    known = getattr(factory, "known_gains", None) or [parameter for parameter in parameters if parameter != "reference"]
    errors.only_known(f"{key}.gains", gains, known)
    extra = {}
    if "reference" in values:
        if "reference" not in parameters:
            raise errors.InputError(f"{key}.reference", "nothing: the law has none", repr(values["reference"]))
        extra["reference"] = _reference(values["reference"], f"{key}.reference")
    try:
        law: Law = factory(**gains, **extra)
    except errors.InputError as error:
        raise errors.InputError(f"{key}.gains.{error.field}", error.expected, error.got) from None
    return law


def _reference(values: Any, key: str) -> Callable[[Any], Any]:
    references = importlib.import_module("flypend.laws.references")
    if not isinstance(values, Mapping):
        raise errors.InputError(key, "a table with a shape", repr(values))
    arguments = dict(values)
    shape = errors.one_of(f"{key}.shape", arguments.pop("shape", None), ("hover", "line", "circle", "lemniscate"))
    factory = getattr(references, shape)
    errors.only_known(key, arguments, inspect.signature(factory).parameters)
    made: Callable[[Any], Any] = factory(**arguments)
    return made
