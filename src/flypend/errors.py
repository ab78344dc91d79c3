"""Input validation. Every bad input raises InputError with one line: field, expected value, value received."""

from __future__ import annotations

import difflib
import functools
import importlib.util
import inspect
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from numbers import Integral, Real
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, Literal, TypeVar, Union, cast, get_args, get_origin

import numpy as np

F = TypeVar("F", bound=Callable[..., Any])


class InputError(ValueError):
    """Bad input. The message is one line: `field: expected ..., got ...`."""

    def __init__(self, field: str, expected: str, got: object) -> None:
        self.field, self.expected, self.got = field, expected, got
        super().__init__(f"{field}: expected {expected}, got {' '.join(str(got).split())}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the three fields, so that the error survives the trip between processes."""
        return (InputError, (self.field, self.expected, str(self.got)))


def _as_floats(value: Any) -> Any:
    """Return `value` as an array of floats; complex numbers raise TypeError, where NumPy would only warn."""
    if isinstance(value, np.ndarray | np.generic | list | tuple) and np.iscomplexobj(value):
        raise TypeError
    return np.array(value, dtype=float)


def array(field: str, value: Any, shape: tuple[int | None, ...], *, batch: bool = False) -> Any:
    """Convert `value` to a finite float array of `shape` (None: any length); `batch` allows leading batch axes.

    Raises InputError.
    """
    wanted = "(" + ", ".join("n" if n is None else str(n) for n in shape) + ")"
    try:
        result = _as_floats(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(field, f"numbers of shape {wanted}", repr(value)[:80]) from None
    trailing = result.shape[result.ndim - len(shape) :]
    fits = result.ndim == len(shape) or (batch and result.ndim > len(shape))
    if not fits or any(n not in (None, m) for n, m in zip(shape, trailing, strict=True)):
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
    except (TypeError, ValueError, OverflowError):
        raise InputError(field, expected, repr(value)[:80]) from None
    inside = (above is None or result > above) and (at_least is None or result >= at_least)
    if not (np.isfinite(result) and inside):
        raise InputError(field, expected, f"{result:g}")
    if at_most is not None and result > at_most:
        meant = np.radians(result)  # of an angle in degrees
        hint = f" (in degrees? write {meant:.4g})" if unit == "rad" and meant <= at_most else ""
        raise InputError(field, f"at most {at_most:g}{' ' + unit if unit else ''}", f"{result:g}{hint}")
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


def named_arguments(target: F) -> F:
    """Decorator of public functions and records: a call with wrong arguments raises InputError, as a wrong value does.

    Arguments that are to be records, such as a Vehicle, or words are checked before the call; names and all other types
    only if it fails. A record's public methods are checked only if they fail: equations pass vehicles of symbols to
    them.
    """
    if not isinstance(target, type):
        bound = cast("Any", target).__code__.co_varnames[:1] == ("cls",)  # a class method's first is not the caller's
        return cast("F", _check_calls(target, target.__name__, target, bound=int(bound)))
    for name, member in list(vars(target).items()):
        if name == "__init__":
            setattr(target, name, _check_calls(member, target.__name__, target, bound=1))
        elif inspect.isfunction(member) and not name.startswith("_"):
            setattr(target, name, _check_calls(member, name, member, bound=1, before=False))
    return target


def _check_calls(function: Any, name: str, documented: Any, bound: int = 0, before: bool = True) -> Any:
    """Return `function`, which is called `name` in messages; its first `bound` arguments are not the caller's.

    Records and words among the arguments are checked `before` the call, if they are.
    """

    @functools.lru_cache(maxsize=1)  # annotations can be read once all modules are imported
    def signature() -> tuple[list[inspect.Parameter], list[tuple[int, str, Any]]]:
        known = list(inspect.signature(function).parameters.values())[bound:]
        kinds = [_kind_of(parameter.annotation, function) for parameter in known]
        named = [parameter.replace(annotation=kind) for parameter, kind in zip(known, kinds, strict=True)]
        early = [(bound + i, one.name, one.annotation) for i, one in enumerate(named) if _is_early(one.annotation)]
        return named, early if before else []

    @functools.wraps(function)
    def checked(*args: Any, **given: Any) -> Any:
        for place, field, kind in signature()[1]:
            if field in given or place < len(args):
                try:
                    check_kind(field, given[field] if field in given else args[place], kind)
                except InputError:  # a misspelt argument comes first
                    _check_names(name, signature()[0], given)
                    raise
        try:
            return function(*args, **given)
        except InputError:
            raise
        except Exception:
            _check_call(name, signature()[0], args[bound:], given, documented)
            raise

    return checked


def _check_call(
    name: str, known: Sequence[inspect.Parameter], args: Sequence[Any], given: Mapping[str, Any], documented: Any
) -> None:
    """Raise InputError if a call of `name` does not fit the `known` arguments of what is `documented`."""
    _check_names(name, known, given)
    kinds = {parameter.kind for parameter in known}
    by_place = [parameter for parameter in known if parameter.kind is parameter.POSITIONAL_OR_KEYWORD]
    if len(args) > len(by_place) and inspect.Parameter.VAR_POSITIONAL not in kinds:
        hint = f"such as {known[0].name}=" if known else "none"
        raise InputError(name, f"arguments by name, {hint}", f"{len(args)} without")
    values = {**dict(zip([parameter.name for parameter in by_place], args, strict=False)), **given}
    for parameter in known:
        if parameter.name in values:
            check_kind(parameter.name, values[parameter.name], parameter.annotation)
        elif parameter.default is parameter.empty and parameter.kind not in (
            parameter.VAR_POSITIONAL,
            parameter.VAR_KEYWORD,
        ):
            expected = documentation_of(documented, parameter.name, _names_of(parameter.annotation))
            raise InputError(f"{name}.{parameter.name}", expected, "nothing")


def _check_names(name: str, known: Sequence[inspect.Parameter], given: Mapping[str, Any]) -> None:
    """Raise InputError for the first argument `given` to `name` that is not `known`."""
    if not any(parameter.kind is parameter.VAR_KEYWORD for parameter in known):
        only_known(name, given, [parameter.name for parameter in known])


def documentation_of(target: Any, name: str, otherwise: str = "a value") -> str:
    """Return what the docstring of `target` says of its argument `name`: kind, meaning and unit, up to a full stop."""
    found = re.search(rf"^( *)(?:\w+, )*{name}(?:, \w+)* : (.*)\n((?:\1 +.*\n)+)", f"{target.__doc__}\n", re.MULTILINE)
    if found is None:
        return otherwise
    said = " ".join(found[3].split()).split(". ")[0].rstrip(".")
    kind = {"float": "a number", "int": "an integer", "str": "a word"}.get(found[2], found[2])
    return f"{kind}: {said[:1].lower()}{said[1:]}"


# Kinds of arguments ---------------------------------------------------------------------------------------------------

# What is checked before a call, and how one gets it.
RECORDS = {
    "Vehicle": "fp.vehicle('hehn2011')",
    "Law": "fp.laws.inverted()",
    "State": "fp.State(y=(0, 0, -1))",
    "Trajectory": "what fp.simulate and fp.load return",
    "Plan": "what fp.plan returns",
    "Flight": "fp.Flight(vehicle=..., law=..., starts=..., duration=...)",
    "Criterion": "fp.Criterion()",
    "Tolerances": "fp.Tolerances()",
}
_KINDS: tuple[tuple[Any, Any, str], ...] = (
    (float, Real, "a number"),
    (int, Integral, "an integer"),
    (bool, (bool, np.bool_), "true or false"),
    (str, str, "a word"),
    (Path, Path, "a path"),
)


def _kind_of(annotation: Any, function: Any) -> Any:
    """Return the kind that an `annotation` of `function` stands for; Any for one that only type checkers know."""
    if not isinstance(annotation, str):
        return annotation
    try:
        return eval(annotation, getattr(inspect.unwrap(function), "__globals__", {}))  # noqa: S307 (our own text)
    except (NameError, AttributeError, TypeError):
        return Any


def _members(kind: Any) -> tuple[Any, ...]:
    """Return the kinds of a union; of any other, itself."""
    return get_args(kind) if isinstance(kind, UnionType) or get_origin(kind) is Union else (kind,)


def _is_early(kind: Any) -> bool:
    """Whether a wrong value may do its harm far away: one of a record, or of a word, such as a vehicle's name."""
    return kind is str or any(_bare(one) in RECORDS for one in _members(kind))


def check_kind(field: str, value: Any, kind: Any) -> None:
    """Raise InputError unless `value` is of a `kind`: an annotation, or the name of a record."""
    if not any(_fits(value, one) for one in _members(kind)):
        raise InputError(field, _names_of(kind), repr(value)[:80])


def _names_of(kind: Any) -> str:
    """Return what values of a `kind` are called in a message, and how one gets a record."""
    if kind in (Any, inspect.Parameter.empty):
        return "a value"
    members = _members(kind)
    names = [_name_of(one) for one in members if one is not str or Path not in members]
    form = next((f", such as {RECORDS[one]}" for one in (_bare(each) for each in members) if one in RECORDS), "")
    return " or ".join(dict.fromkeys(names)) + form


def _bare(kind: Any) -> str:
    return str(getattr(kind, "__name__", kind))


def _name_of(kind: Any) -> str:
    """Return what a kind is called in a message."""
    if kind is None or kind is NoneType:
        return "None"
    if get_origin(kind) is Literal:
        return "one of " + ", ".join(map(repr, get_args(kind)))
    plain = next((words for known, _, words in _KINDS if kind is known), "")
    origin = get_origin(kind) or kind
    if plain or origin is Callable:
        return plain or "a function"
    return f"{'an' if _bare(origin)[0] in 'AEIO' else 'a'} {_bare(origin)}"


def _fits(value: Any, kind: Any) -> bool:
    """Whether `value` is of a `kind`; kinds that cannot be looked at fit always."""
    if kind is None or kind is NoneType:
        return value is None
    if isinstance(kind, str):
        return kind in (one.__name__ for one in type(value).__mro__)
    if get_origin(kind) is Literal:
        return isinstance(value, str) and value in get_args(kind)
    for known, accepted, _ in _KINDS:
        if kind is known:
            return isinstance(value, accepted) and (known is bool or not isinstance(value, bool))
    origin = get_origin(kind) or kind
    if origin is Callable:
        return callable(value)
    if isinstance(value, str) and origin in (Sequence, Iterable):
        return False
    if kind is Any or not isinstance(origin, type) or getattr(origin, "_is_protocol", False):
        return True  # ArrayLike is a union of protocols, of which a tuple is none
    return isinstance(value, origin)


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
        by_name = dict.fromkeys({"path", "acting"} & set(signature.parameters))
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
        raise InputError(for_, f"the extra {extra} ({install_command(extra)})", f"no module {module}")


def install_command(extra: str) -> str:
    """Return the pip command that adds `extra` to this installation of flypend, which is on no package index.

    What was installed from a folder, a file or a repository comes from there again, with the extra. If that place is
    gone or unknown, the command names the packages of the extra that are missing.
    """
    import json  # what only a missing extra needs is imported here: every command imports this module
    import shlex
    from importlib import metadata
    from urllib.parse import urlsplit
    from urllib.request import url2pathname

    def is_installed(requirement: str) -> bool:
        return any(metadata.distributions(name=re.split(r"[^\w.-]", requirement)[0]))

    own = next(iter(metadata.distributions(name="flypend")), None)
    if own is None:  # a source tree on the path
        return f"pip install '.[{extra}]' in a clone of flypend"
    origin = json.loads(own.read_text("direct_url.json") or "{}")
    url = origin.get("url", "")
    if vcs := origin.get("vcs_info"):
        return shlex.join(["pip", "install", f"flypend[{extra}] @ {vcs['vcs']}+{url}@{vcs['commit_id']}"])
    place = Path(url2pathname(urlsplit(url).path))
    if url.startswith("file:") and place.exists():
        editable = ["-e"] if origin.get("dir_info", {}).get("editable") else []
        return shlex.join(["pip", "install", *editable, f"{'.' if place == Path.cwd() else place}[{extra}]"])
    listed = (text.partition(";") for text in own.requires or ())
    wanted = [name.strip() for name, _, marker in listed if re.search(rf"extra == ['\"]{extra}['\"]", marker)]
    return shlex.join(["pip", "install", *([text for text in wanted if not is_installed(text)] or wanted)])
