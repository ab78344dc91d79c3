"""Custom laws: a Python function becomes a `Law` if it works on symbols, otherwise a `Controller`.

    def balance(t, state, vehicle, *, k_p=4.0): ...

Arguments are recognised by name: `t`, `state`, `vehicle`, and gains, which have defaults.
"""

from __future__ import annotations

import hashlib
import inspect
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from pathlib import Path
from types import MappingProxyType, SimpleNamespace
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.building import builds
from flypend.errors import InputError
from flypend.geometry import Numbers
from flypend.laws.bound import Computer
from flypend.laws.gain import Gain, Tunable, check_gains, is_number, pickle_by_code, table
from flypend.laws.law import Law
from flypend.laws.law_error import LawError, Located, check_finite, file_of, innermost, is_own, location, wrench_of
from flypend.laws.references import Reference, check_reference
from flypend.model import State, Vehicle, Wrench, vehicle
from flypend.model.state import SIZE, E3Direction, convert_packed

# Argument names recognised in a custom law. The fourth role, gains, dates from version 0.1.
ROLES: Mapping[str, tuple[str, ...]] = {
    "t": ("t", "time"),
    "state": ("state", "s"),
    "vehicle": ("vehicle", "v"),
    "gains": ("gains", "k"),
}
FORMS = (("t", "state"), ("t", "state", "vehicle"), ("t", "state", "vehicle", "gains"))
# CasADi warns of NumPy functions on symbols. Here their results are checked against numbers, so no warning is needed.
warnings.filterwarnings("ignore", message=r"\s*casadi: a numpy function", category=FutureWarning)
EXPECTED = "a function of (t, state, vehicle, *, gain=default, ...)"
# In how many states each function is tried on a known vehicle; symbolic and numeric results must agree to this.
_TRIED, _AGREEMENT = 8, 1e-9


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
    __reduce__ = pickle_by_code

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


@errors.named_arguments
@builds
def from_function(
    function: Callable[..., Any],
    *,
    name: str | None = None,
    e3: E3Direction = "up",
    gains: Iterable[Gain] = (),
    rate: float = 500.0,
) -> Law | Controller:
    """Build a law from a Python function.

    Parameters
    ----------
    function : callable
        `function(t, state, vehicle, *, k_p=4.0, ...) -> Wrench` or `Control`. Arguments with defaults, numbers or
        strings, are its gains. A function of CasADi expressions becomes a `Law`, which is compiled and can be exported.
        One that needs numbers (NumPy, an `if` on values) becomes a `Controller`, which flies step by step.
        `function(t, state)` always becomes a `Controller`.
    name : str, optional
        Name for tables and files; default that of the function.
    e3 : "up" or "down"
        Direction of the world's third axis in the function's frame.
    gains : list of Gain, optional
        Records with unit, bounds and label for any of the gains.
    rate : float
        Control rate of a `Controller` in the ideal plant, Hz.

    Raises
    ------
    InputError
        If an argument has another name, a gain has no default, or the function fails when tried; the message then gives
        file and line.
    """
    name = name or str(getattr(function, "__name__", type(function).__name__))
    form, table = _read(function, name, {gain.name: gain for gain in gains})
    call = Located(function, name)
    if form == FORMS[2]:
        if table:
            raise InputError("law", EXPECTED, f"{name}, which has gains and an argument for them")
        return Law(name=name, e3=e3, control=call)
    defaults = {gain.name: gain.default for gain in table.values()}
    because = "a function of time and state alone"
    if form == FORMS[1]:
        because = _why_not_symbolic(call, defaults)
        if not because:
            return Law(name=name, e3=e3, control=_Control(call, tuple(table)), gains=table)
    return Controller(
        name=name, e3=e3, rate=rate, gains=defaults, table=table, because=because,
        function=_Steering(call, None, defaults), steering=_Steer(call, with_vehicle=form == FORMS[1]),
    )  # fmt: skip


def fingerprint(controller: Controller) -> bytes:
    """Return a digest of a `controller`: its name, settings and gains, the text of its source file, and some answers.

    The answers tell of what it imports and reads; a law that does not repeat them is known by its text alone.
    """
    function: Any = innermost(controller.steering or controller.function)
    file, code = Path(file_of(function)), getattr(function, "__code__", None)
    text = file.read_bytes() if file.is_file() else code.co_code if code else b""
    said = repr((controller.name, dict(controller.gains), controller.e3, controller.rate, controller.computer))
    answers = {_answers(controller), _answers(controller)}
    return hashlib.sha256(said.encode() + text + (answers.pop() if len(answers) == 1 else b"")).digest()


def _answers(controller: Controller) -> bytes:
    machine, times, states = _example()
    try:
        steer = controller.bind(machine).function
        found = [steer(t, state) for t, state in zip(times, states, strict=True)]
        return np.array([[wrench.thrust, *wrench.moment] for wrench in found], dtype=float).tobytes()
    except Exception:  # it fails in some states, or has no wrench
        return b""


def is_factory(function: Callable[..., Any]) -> bool:
    """Whether a `function` can be called without arguments, and so may be a factory of laws."""
    return all(p.default is not p.empty for p in _parameters(function))


@dataclass(frozen=True, eq=False)
class _Control:
    """`Law.control` of a function whose gains are keyword arguments."""

    function: Located
    gains: tuple[str, ...]

    def __call__(self, t: Any, state: State, vehicle: Vehicle, k: SimpleNamespace) -> Any:
        """Return what the function answers, its gains by name."""
        return self.function(t, state, vehicle, **{name: getattr(k, name) for name in self.gains})


@dataclass(frozen=True, eq=False)
class _Steer:
    """`Controller.steering` of a function."""

    function: Located
    with_vehicle: bool

    def __call__(self, vehicle: Vehicle, gains: Mapping[str, Any]) -> Steering:
        return _Steering(self.function, vehicle if self.with_vehicle else None, dict(gains))


@dataclass(frozen=True, eq=False)
class _Steering:
    """A function of time and state, all other arguments fixed; its output is checked."""

    function: Located
    vehicle: Vehicle | None
    gains: Mapping[str, Any]

    def __call__(self, t: float, state: State) -> Wrench:
        answer = self.function(t, state, *(() if self.vehicle is None else (self.vehicle,)), **self.gains)
        values = _numbers(answer, self.function)
        return Wrench(float(values[0]), values[1:])


def _read(
    function: Callable[..., Any], name: str, records: Mapping[str, Gain]
) -> tuple[tuple[str, ...], dict[str, Gain]]:
    """Return the form of a function, one of `FORMS`, and its gains."""
    arguments = _parameters(function)
    needed = [p for p in arguments if p.default is p.empty]
    form = tuple(_role(parameter.name, place) for place, parameter in enumerate(needed))
    bare = [p.name for p in needed if p.kind is p.KEYWORD_ONLY]
    if bare:
        raise InputError("law", "a default for every gain", f"{name} without one for {bare[0]}")
    if form not in FORMS:
        got = ", ".join(p.name for p in needed) or "nothing"
        raise InputError("law", EXPECTED, f"{name} of ({got})")
    table = {p.name: records.get(p.name, Gain(p.name, p.default, label=p.name)) for p in arguments if p not in needed}
    for gain in table.values():
        if not (is_number(gain.default) or isinstance(gain.default, str)):
            raise InputError("law", "gains that are numbers or words", f"{name} with {gain.name} = {gain.default!r}")
        gain.check(gain.default, f"law.gains.{gain.name}")
    for other in set(records) - set(table):
        raise InputError("law", f"a gain among the arguments of {name}", other)
    return form, table


def _role(name: str, place: int) -> str:
    """Return the role of an argument from its name; if it is called _, from its position."""
    bare = name.strip("_").lower()
    if not bare:
        return (*ROLES, *[name] * (place + 1))[place]
    return next((role for role, names in ROLES.items() if bare in names), name)


def _parameters(function: Callable[..., Any]) -> list[inspect.Parameter]:
    try:
        found = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):  # some functions written in C
        raise InputError("law", EXPECTED, f"{function!r}, which does not name its arguments") from None
    return [p for p in found if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]


def _why_not_symbolic(call: Located, gains: Mapping[str, Any]) -> str:
    """Return why a function is not symbolic, "" if it is, by trying it on symbols and on numbers.

    Raises LawError if it fails on both.
    """
    machine, times, states = _example()
    refused: InputError | None = None
    numbers: list[NDArray[Any]] = []
    try:
        for t, state in zip((*times, times[0]), (*states, states[0]), strict=True):
            numbers.append(_numbers(call(t, state, machine, **gains), call))
        if not np.array_equal(numbers.pop(), numbers[0], equal_nan=True):
            return "it answers the same state differently when asked again"  # symbols would stay in what it remembers
    except InputError as error:
        if numbers:
            return f"it fails in some states: {error}"
        refused = error
    time, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
    failure: LawError | None = None
    try:
        wrench = wrench_of(call(time, State.symbolic(packed), machine, **gains), call, call.name)
        stacked = ca.vertcat(ca.SX(wrench.thrust), ca.SX(wrench.moment))
        symbolic = ca.Function("try", [time, packed], [ca.densify(stacked)])
        answers = [np.array(symbolic(t, state.packed())).ravel() for t, state in zip(times, states, strict=True)]
    except LawError as error:
        failure = error
    except Exception as error:  # the result is not an expression
        failure = LawError(location(call.function), call.name, f"its wrench is not made of symbols: {error}")
    if refused is not None:
        if failure is None:
            return ""  # uses CasADi functions that accept symbols only
        cause = refused if "SX" in failure.said or "an if on" in failure.said else failure
        raise cause from cause.__cause__
    if failure is not None:
        return f"{failure.said}, {failure.where}"
    check_finite(numbers, call, call.name)
    same = np.allclose(answers, numbers, rtol=_AGREEMENT, atol=_AGREEMENT, equal_nan=True)
    return "" if same else "its symbols do not say what its numbers say"


@lru_cache(maxsize=1)
def _example() -> tuple[Vehicle, tuple[float, ...], tuple[State, ...]]:
    """Return a vehicle, and times (s) and states on which laws are tried: away from the goal, the rod up and down."""
    rng = np.random.default_rng(0)
    states = replace(State.random(rng, _TRIED), x=rng.normal(size=(_TRIED, 3)))
    return vehicle("hehn2011"), (0.0, *rng.uniform(0, 5, _TRIED - 1).tolist()), tuple(states[i] for i in range(_TRIED))


def _numbers(answer: Any, call: Located) -> NDArray[np.float64]:
    """Return thrust and moment (4,) from a function's numeric output."""
    wrench = wrench_of(answer, call, call.name)
    try:
        parts = [np.asarray(part, dtype=float).ravel() for part in (wrench.thrust, wrench.moment)]
    except (TypeError, ValueError, RuntimeError):
        raise LawError(location(call.function), call.name, "its wrench is not made of numbers") from None
    return np.concatenate(parts)
