"""Input validation. Every bad input raises InputError with one line: field, expected value, value received."""

from __future__ import annotations

import difflib
import functools
import importlib.util
import inspect
from collections.abc import Iterable, Mapping
from numbers import Integral
from typing import Any, TypeVar

import numpy as np

C = TypeVar("C")


class InputError(ValueError):
    """Bad input. The message is one line: `field: expected ..., got ...`."""

    def __init__(self, field: str, expected: str, got: object) -> None:
        self.field, self.expected, self.got = field, expected, got
        super().__init__(f"{field}: expected {expected}, got {' '.join(str(got).split())}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the three fields, so that the error survives the trip between processes."""
        return (InputError, (self.field, self.expected, str(self.got)))


def array(field: str, value: Any, shape: tuple[int | None, ...], *, batch: bool = False) -> Any:
    """Convert `value` to a finite float array of `shape` (None: any length); `batch` allows leading batch axes.

    Raises InputError.
    """
    wanted = "(" + ", ".join("n" if n is None else str(n) for n in shape) + ")"
    try:
        result = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise InputError(field, f"numbers of shape {wanted}", repr(value)) from None
    trailing = result.shape[result.ndim - len(shape) :]
    if (
        result.ndim < len(shape)
        or (result.ndim > len(shape) and not batch)
        or any(n not in (None, m) for n, m in zip(shape, trailing, strict=True))
    ):
        raise InputError(field, f"numbers of shape {wanted}", f"shape {result.shape}")
    if not np.all(np.isfinite(result)):
        raise InputError(field, "finite numbers", f"{np.count_nonzero(~np.isfinite(result))} that are NaN or infinite")
    return result


def number(
    field: str,
    value: Any,
    *,
    above: float | None = None,
    at_least: float | None = None,
    at_most: float | None = None,
    unit: str = "",
) -> float:
    """Convert `value` to a finite float within the given bounds. Raises InputError."""
    bound = f" > {above:g}" if above is not None else f" >= {at_least:g}" if at_least is not None else ""
    expected = f"a finite number{bound}{' ' + unit if unit else ''}"
    if isinstance(value, bool | str):
        raise InputError(field, expected, repr(value))
    try:
        result = float(value)
    except (TypeError, ValueError):
        raise InputError(field, expected, repr(value)) from None
    inside = (above is None or result > above) and (at_least is None or result >= at_least)
    if not (np.isfinite(result) and inside):
        raise InputError(field, expected, f"{result:g}")
    if at_most is not None and result > at_most:
        raise InputError(field, f"at most {at_most:g}{' ' + unit if unit else ''}", f"{result:g}")
    return result


def integer(field: str, value: Any, least: int, most: int | None = None) -> int:
    """Return `value` as an int. Raises InputError unless it is an integer of at least `least`, and at most `most`."""
    upper = "" if most is None else f" and <= {most}"
    whole = isinstance(value, Integral) and not isinstance(value, bool)
    if not whole or value < least or (most is not None and value > most):
        raise InputError(field, f"an integer >= {least}{upper}", repr(value))
    return int(value)


def one_of(field: str, value: Any, known: Iterable[str]) -> str:
    """Return `value` if it is in `known`. Otherwise raise InputError, suggesting the closest known name."""
    names = list(known)
    if value in names:
        return str(value)
    near = difflib.get_close_matches(str(value), names, n=1, cutoff=0.4)
    hint = f" (did you mean {near[0]!r}?)" if near else ""
    raise InputError(field, "one of " + ", ".join(names), f"{value!r}{hint}")


def only_known(field: str, given: Iterable[str], known: Iterable[str]) -> None:
    """Raise InputError for the first name in `given` that is not in `known`."""
    names = list(known)
    for name in given:
        if name not in names:
            one_of(f"{field}.{name}" if field else name, name, names)


def named_arguments(cls: type[C]) -> type[C]:
    """Class decorator for records: a call with wrong arguments raises InputError, as a wrong value does."""
    build = cls.__init__
    signature = inspect.signature(build)

    @functools.wraps(build)
    def checked(self: Any, *args: Any, **given: Any) -> None:
        try:
            build(self, *args, **given)
        except TypeError:
            _check_call(cls.__name__, signature, args, given)
            raise

    cls.__init__ = checked  # type: ignore[method-assign]
    return cls


def _check_call(name: str, signature: inspect.Signature, args: tuple[Any, ...], given: Mapping[str, Any]) -> None:
    """Raise InputError if a call of the class `name` does not fit its constructor's `signature`."""
    known = list(signature.parameters.values())[1:]
    only_known(name, given, [parameter.name for parameter in known])
    by_place = [parameter.name for parameter in known if parameter.kind is not inspect.Parameter.KEYWORD_ONLY]
    if len(args) > len(by_place):
        raise InputError(name, f"arguments by name, such as {known[0].name}=", f"{len(args)} without")
    for parameter in known:
        missing = parameter.name not in given and parameter.name not in by_place[: len(args)]
        if missing and parameter.default is inspect.Parameter.empty:
            raise InputError(f"{name}.{parameter.name}", "a value", "nothing")


def check_arguments(field: str, function: Any, form: str) -> None:
    """Raise InputError unless `function` can be called as in `form`, such as "(t, state)".

    Arguments in square brackets may be left out. A function that does not tell its arguments passes.
    """
    if not callable(function):
        raise InputError(field, f"a function {form}", repr(function)[:80])
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):  # written in C
        return
    names = form.strip("()").replace("]", "").replace("[", "").split(", ")
    needed = form.strip("()").split("[")[0].rstrip(", ").split(", ")
    for count in range(len(needed), len(names) + 1):
        by_name = {"path": None} if "path" in signature.parameters else {}
        try:
            signature.bind(*[None] * count, **by_name)
        except TypeError:
            continue
        return
    raise InputError(field, f"a function {form}", f"one {signature}")


def require(module: str, *, extra: str, for_: str) -> None:
    """Raise InputError unless `module` is installed. `extra` is the extra that installs it, `for_` the field to blame.

    The module is located, not imported. Call this before doing any work.
    """
    if importlib.util.find_spec(module) is None:
        wanted = f"the extra flypend[{extra}] (pip install 'flypend[{extra}]')"
        raise InputError(for_, wanted, f"no module {module}")
