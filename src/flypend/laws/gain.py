"""The registry of gains: the single source of docstrings, checks, sliders and C comments."""

from __future__ import annotations

import inspect
import math
import pickle
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields
from numbers import Real
from types import MappingProxyType
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.model import Vehicle

F = TypeVar("F", bound=Callable[..., Any])


@errors.named_arguments
@dataclass(frozen=True)
class Bounds:
    """The interval [low, high] of valid gain values; (low, high] with `open_low`."""

    low: float = -math.inf
    high: float = math.inf
    open_low: bool = False

    def limits(self) -> dict[str, float]:
        """Return the interval as arguments of `errors.number`."""
        low = {} if math.isinf(self.low) else {"above" if self.open_low else "at_least": self.low}
        return low if math.isinf(self.high) else low | {"at_most": self.high}

    def hold(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return a mask of the `values` inside the interval."""
        above = values > self.low if self.open_low else values >= self.low
        inside: NDArray[Any] = np.isfinite(values) & above & (values <= self.high)
        return inside


ANY = Bounds()
POSITIVE = Bounds(low=0.0, open_low=True)
NOT_NEGATIVE = Bounds(low=0.0)
SHARE = Bounds(low=0.0, high=1.0)
# What the gain of that name says, in every law that has it.
DELAY_REACH = "Largest delay beyond `latency` that the flight computer finds in flight; 0 for none"
POSITIVE_SHARE = Bounds(low=0.0, high=1.0, open_low=True)


@errors.named_arguments
@dataclass(frozen=True)
class Gain:
    """One gain of a law.

    Parameters
    ----------
    name : str
        Name, the same everywhere.
    default : float, str or callable
        Default value: a number, a string, or a function of the vehicle.
    unit : str
        Unit; empty for a dimensionless gain.
    doc : str
        One line on what the gain does.
    bounds : Bounds
        Valid values of a numeric gain.
    choices : tuple of str
        Valid values of an option.
    label : str
        Short slider label; a gain without a label has no slider.
    fixed : bool
        Whether it determines the amount of computation; exported code then holds it as a constant.
    """

    name: str
    default: Any
    unit: str = ""
    doc: str = ""
    bounds: Bounds = ANY
    choices: tuple[str, ...] = ()
    label: str = ""
    fixed: bool = field(default=False, kw_only=True)

    @property
    def numeric(self) -> bool:
        """Whether it is a real number, which may vary from run to run, and not an option."""
        return callable(self.default) or is_number(self.default)

    def value(self, vehicle: Vehicle) -> Any:
        """Return the default for `vehicle`."""
        return float(self.default(vehicle)) if callable(self.default) else self.default

    def check(self, value: Any, name: str = "") -> Any:
        """Return `value`, checked; messages begin with `name`. Raises InputError if it is not valid for this gain."""
        name = name or self.name
        if self.choices:
            return errors.one_of(name, value, self.choices)
        if self.numeric:
            return errors.number(name, value, unit=self.unit, **self.bounds.limits())
        if isinstance(self.default, str) and not isinstance(value, str):
            raise errors.InputError(name, "a word", repr(value))
        return value

    def check_all(self, values: Any, name: str = "") -> NDArray[Any]:
        """Return `values`, a number or an array of any shape, checked.

        Messages begin with `name`. Raises InputError if any value is not valid for this gain.
        """
        name = name or self.name
        if not self.numeric:
            raise errors.InputError(name, "nothing: only numbers may vary from run to run", f"{self.name}, an option")
        found: NDArray[Any] = errors.array(name, values, (), batch=True)
        wrong = found[~self.bounds.hold(found)]
        if wrong.size:
            self.check(float(wrong.flat[0]), name)
        return found

    def describe(self) -> str:
        """Return a one-line description: doc and unit."""
        return f"{self.doc}{', ' + self.unit if self.unit and self.doc else self.unit}"


def pickle_by_code(law: Any) -> tuple[Any, ...]:
    """Reduce a `law` for `pickle`, and so for other processes, whose functions nobody could import by name."""
    import cloudpickle  # imported here: few laws are pickled

    values = {entry.name: getattr(law, entry.name) for entry in fields(law) if entry.init}
    return _unpickle, (type(law), cloudpickle.dumps(values))


def _unpickle(kind: Any, values: bytes) -> Any:
    return kind(**pickle.loads(values))  # noqa: S301  # part of what a pickle holds


class Tunable:
    """What has a `table` of gains: a law, bound to a vehicle or not, or a controller."""

    table: Mapping[str, Gain]

    def __copy__(self) -> Self:
        return self  # nothing of it changes

    def __deepcopy__(self, _: object) -> Self:
        return self

    def propose(self, vehicle: Vehicle) -> dict[str, Any]:
        """Default values of all gains for `vehicle`, by name, whatever is given."""
        return {name: gain.value(vehicle) for name, gain in self.table.items()}

    def check_gain(self, name: str, values: Any, prefix: str = "gains") -> NDArray[Any]:
        """Return `values`, one or many, of gain `name` for runs that differ in it; messages begin with `prefix`.

        Raises InputError if `name` is not a numeric gain, or a value is out of bounds.
        """
        errors.only_known(prefix, [name], [gain.name for gain in self.table.values() if gain.numeric])
        return self.table[name].check_all(values, f"{prefix}.{name}".lstrip("."))


def check_gravity(vehicle: Vehicle, pose: str = "is inverted") -> None:
    """Raise InputError for a `vehicle` without gravity, for which no `pose` is one."""
    if vehicle.gravity == 0:
        raise errors.InputError("vehicle.gravity", f"gravity > 0, without which no pose {pose}", "0 m/s²")


def is_number(value: object) -> bool:
    """Whether `value` is a real number; booleans do not count."""
    return isinstance(value, Real) and not isinstance(value, bool)


def table(gains: Mapping[str, Any] | Iterable[Gain]) -> Mapping[str, Gain]:
    """Return a table of gains by name, from records or from a dict of defaults (without bounds)."""
    errors.check_kind("gains", gains, Iterable)
    if isinstance(gains, Mapping):
        gains = [value if isinstance(value, Gain) else Gain(name, value) for name, value in gains.items()]
    listed = list(gains)
    for gain in listed:
        errors.check_kind("gains", gain, Gain)
    return MappingProxyType({gain.name: gain for gain in listed})


def check_gains(gains: Mapping[str, Gain], given: Mapping[str, Any], name: str = "") -> dict[str, Any]:
    """Return the values `given`, checked against the table `gains`.

    Messages begin with `name` and a dot. Raises InputError if a gain is unknown or out of bounds.
    """
    errors.only_known(name, given, gains)
    return {key: gains[key].check(value, f"{name}.{key}".lstrip(".")) for key, value in given.items()}


# What is said of the arguments of a law whose docstring says nothing of its own.
ARGUMENTS = """

Parameters
----------{reference}
**gains : float or str
    Any of the gains below, in the stated unit; the others get their defaults for the vehicle.

{{gains}}

Raises
------
InputError
    If a gain is unknown or out of bounds{more}.
"""
REFERENCE = """
reference : callable, optional
    Pivot position (3,), m, as a CasADi function of time{smooth}; default hover at the origin.
    See `laws.references`."""


def document_gains(gains: Mapping[str, Gain], more: str = "", smooth: str = "") -> Callable[[F], F]:
    """Return a decorator that replaces {gains} in a docstring by the table `gains`.

    A docstring without this line gets all of `ARGUMENTS`, with `more` mistakes that raise InputError, and how `smooth`
    a reference has to be.
    """

    def fill(function: F) -> F:
        text = inspect.getdoc(function) or ""
        if "{gains}" not in text:
            takes_reference = "reference" in inspect.signature(function).parameters
            text += ARGUMENTS.format(reference=REFERENCE.format(smooth=smooth) if takes_reference else "", more=more)
        function.__doc__ = text.replace("{gains}", "\n".join(_entries(gains)))
        return function

    return fill


def _entries(gains: Mapping[str, Gain]) -> list[str]:
    out = ["Gains", "-----"]
    for gain in gains.values():
        kind = " or ".join(f'"{word}"' for word in gain.choices) or ("float" if gain.numeric else "str")
        default = "" if callable(gain.default) else f", default {gain.default!r}"
        out += [f"{gain.name} : {kind}{default}", f"    {gain.describe()}"]
    return out
