"""What a control law is: one function of symbols, its gains, and the frame it is written in."""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType, SimpleNamespace
from typing import Any

from flypend import errors
from flypend.model import State, Vehicle, Wrench
from flypend.model.state import E3Direction

BUILT_IN = ("printed", "corrected")


@dataclass(frozen=True)
class Guard:
    """A quantity that must not vanish: where `signal` falls below `threshold` the law is undefined for `reason`."""

    signal: str
    threshold: float
    reason: str


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


@dataclass(frozen=True, kw_only=True)
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
    guard : Guard, optional
        Where the law stops being defined.
    """

    name: str
    e3: E3Direction
    control: Callable[[Any, State, Vehicle, Any], Control | Wrench]
    gains: Mapping[str, Any] = field(default_factory=dict)
    guard: Guard | None = None

    def __post_init__(self) -> None:
        errors.one_of("law.e3", self.e3, ("up", "down"))
        object.__setattr__(self, "gains", MappingProxyType(dict(self.gains)))

    def evaluate(self, t: Any, state: State, vehicle: Vehicle) -> Control:
        """The control for symbols of time `t` (s) and `state`, for `vehicle`."""
        control = self.control(t, state, vehicle, SimpleNamespace(**self.gains))
        return Control(wrench=control) if isinstance(control, Wrench) else control


def law_names() -> list[str]:
    """Names of the laws that come with the package."""
    return list(BUILT_IN)


def law_from_dict(values: Mapping[str, Any], key: str = "law") -> Law:
    """The law of a TOML table `{name = ..., gains = {...}}`; messages begin with `key`.

    Raises InputError for an unknown law or gain (with the nearest known name) and for gains out of range.
    """
    errors.only_known(key, values, ("name", "gains"))
    name = errors.one_of(f"{key}.name", values.get("name"), BUILT_IN)
    gains = values.get("gains", {})
    if not isinstance(gains, Mapping):
        raise errors.InputError(f"{key}.gains", "a table of gains", repr(gains))
    factory = getattr(importlib.import_module(f"flypend.laws.{name}"), name)
    errors.only_known(f"{key}.gains", gains, inspect.signature(factory).parameters)
    try:
        law: Law = factory(**gains)
    except errors.InputError as error:
        raise errors.InputError(f"{key}.gains.{error.field}", error.expected, error.got) from None
    return law
