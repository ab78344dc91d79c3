"""Laws by name: those of the package, and one's own as `module:name`."""

from __future__ import annotations

import importlib
import inspect
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from flypend.errors import InputError, one_of
from flypend.laws import Controller, Law, inverted, law_from_dict, law_names

# Gains of the inverted law with a slow attitude and no rate of its target: in the table to be seen failing.
DETUNED = {"attitude_bandwidth": 12.0, "rate_feedforward": 0.0}


def law_named(name: str) -> Law | Controller:
    """The law called `name`: one of the package, "detuned" (a negative control), or `module:name` of one's own.

    What `module:name` finds may be a Law, a Controller, a function of no arguments that gives one, a symbolic law
    `f(t, state, vehicle, gains)` (e₃ up, without gains) or a plain controller `f(t, state) -> Wrench` (500 Hz, e₃ up).
    The current folder is searched as well.

    Raises InputError if there is no such law.
    """
    if ":" not in name:
        if one_of("--law", name, (*law_names(), "detuned")) == "detuned":
            return replace(inverted().with_gains(DETUNED), name="detuned")
        return law_from_dict({"name": name})
    module_name, _, attribute = name.partition(":")
    if not all(part.isidentifier() for part in (*module_name.split("."), attribute)):
        raise InputError("--law", "module:name that can be imported", repr(name))
    if str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))
    try:
        found = getattr(importlib.import_module(module_name), attribute)
    except (ImportError, AttributeError) as error:
        raise InputError("--law", "module:name that can be imported", f"{name!r} ({error})") from None
    return _as_law(name, attribute, found)


def _as_law(name: str, attribute: str, found: Any) -> Law | Controller:
    if isinstance(found, Law | Controller):
        return found
    expected = "a Law, a Controller, or a function of (), (t, state) or (t, state, vehicle, gains)"
    if not callable(found):
        raise InputError("--law", expected, f"{name!r}, {type(found).__name__}")
    makers: dict[int, Callable[[], Any]] = {
        0: found,
        2: lambda: Controller(name=attribute, function=found),
        4: lambda: Law(name=attribute, e3="up", control=found),
    }
    required = _required(found)
    law = makers.get(required, lambda: None)()
    if not isinstance(law, Law | Controller):
        raise InputError("--law", expected, f"{name!r}, which is none")
    return law


def _required(function: Any) -> int:
    """Number of arguments that `function` cannot be called without; -1 if it does not say."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):  # some that are written in C
        return -1
    several = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    return sum(p.default is inspect.Parameter.empty and p.kind not in several for p in parameters)
