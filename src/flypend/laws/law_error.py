"""Mistakes in a law of the user's own, on one line with file and line number."""

from __future__ import annotations

import difflib
import inspect
import traceback
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from flypend.building import no_numbers
from flypend.errors import InputError
from flypend.model import Wrench

PACKAGE = Path(__file__).parents[1]


class LawError(InputError):
    """A mistake in a custom law, reported on one line with file and line number.

    `where` is file:line, `name` that of the law (may be empty), `said` what went wrong.
    """

    def __init__(self, where: str, name: str, said: str) -> None:
        super().__init__("law", said, name)
        self.where, self.name, self.said = where, name, " ".join(said.split())
        self.args = (f"{where}: {self.said}" + (f" (in the law {name})" if name else ""),)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the three fields, so that the error survives the trip between processes."""
        return (LawError, (self.where, self.name, self.said))


@dataclass(frozen=True, eq=False)
class Located:
    """A `function` of the law `name` whose errors are reported with file and line, on one line.

    With `inner` it returns another function of the law, which is treated alike.
    """

    function: Callable[..., Any]
    name: str
    inner: bool = False

    def __call__(self, *arguments: Any, **gains: Any) -> Any:
        """Call the function. Raises LawError for any exception but InputError, and for an impossible wrench."""
        try:
            with no_numbers() if isinstance(next(iter(arguments), None), ca.SX) else nullcontext():
                result = self.function(*arguments, **gains)
        except (Exception, SystemExit) as error:  # a law must not end the program
            if isinstance(error, InputError) and not error.field.startswith("wrench"):
                raise
            raise law_error(error, self.function, self.name) from error
        return Located(result, self.name) if self.inner and not isinstance(result, Located) else result


def innermost(function: Any) -> Any:
    """Return the function inside the records that wrap it."""
    while hasattr(function, "function"):
        function = function.function
    return function


def is_own(function: Any) -> bool:
    """Whether the code of `function` is the user's and not the package's."""
    return not Path(file_of(innermost(function)) or PACKAGE).is_relative_to(PACKAGE)


def wrench_of(answer: Any, function: Any, name: str) -> Wrench:
    """Return the wrench in what the `function` of the law `name` answers. Raises LawError if there is none."""
    found = getattr(answer, "wrench", answer)
    if isinstance(found, Wrench):
        return found
    problem = f"it returns {type(answer).__name__}, not a Wrench: return flypend.Wrench(thrust, moment)"
    raise LawError(location(innermost(function)), name, problem)


def law_error(error: BaseException, function: Any, name: str) -> LawError:
    """Return the `LawError` for an `error` raised by the `function` of the law `name`."""
    file = file_of(function)
    frames = traceback.extract_tb(error.__traceback__)
    frame = next((f for f in reversed(frames) if f.filename == file), frames[-1])
    return LawError(f"{relative_path(frame.filename)}:{frame.lineno}", name, explain(error))


def explain(error: BaseException) -> str:
    """Return what an `error` of a law says, with the remedy where there is a usual one."""
    said = str(error)
    if isinstance(error, InputError):
        return said
    if "truth value" in said:
        return "an if on symbols, which need casadi.if_else, or on arrays"
    if isinstance(error, AttributeError) and error.obj is not None:
        known = [name for name in dir(error.obj) if not name.startswith("_")]
        near = difflib.get_close_matches(str(error.name), known, n=1, cutoff=0.5)
        said += f" (did you mean {near[0]!r}?)" if near else ""
    return f"{type(error).__name__}: {said}".split("Possible prototypes")[0].rstrip(": \n")


def relative_path(file: str) -> str:
    """Return the path of `file`, relative to the current folder if it lies below it."""
    path = Path(file)
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else file


def file_of(function: Any) -> str:
    """Return the file of the code of `function`; empty for none."""
    code = getattr(inspect.unwrap(function), "__code__", None) or getattr(type(function).__call__, "__code__", None)
    return getattr(code, "co_filename", "")


def location(function: Any) -> str:
    """Return file:line where a function begins."""
    code = getattr(inspect.unwrap(function), "__code__", None)
    return f"{relative_path(code.co_filename)}:{code.co_firstlineno}" if code else repr(function)


def check_finite(wrenches: Any, function: Any, name: str) -> None:
    """Raise LawError if none of the `wrenches` (n, 4) of the `function` of the law `name` is finite."""
    finite = np.isfinite(wrenches)
    if not np.any(np.all(finite, axis=1)):
        part, value = ("thrust", wrenches[0][0]) if not finite[0][0] else ("moment", wrenches[0][1:])
        said = f"its {part} is {value}, as in every state that is tried: expected finite numbers"
        raise LawError(location(innermost(function)), name, said)
