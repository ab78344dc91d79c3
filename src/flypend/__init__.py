"""flypend models, controls and simulates a spherical pendulum on a quadrotor, on R³ × SO(3) × S².

Names are imported when they are first used, from where `__init__.pyi` says.
"""

from __future__ import annotations

from functools import partial
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from flypend.registry import LAWS

__version__ = "0.3.6"

_lines = [line.split() for line in __loader__.get_data(f"{__file__}i").decode().splitlines()]
_MODULES = {words[3]: words[1] for words in _lines if words[:1] == ["from"] and words[1] != "flypend"}

__all__ = sorted(["laws", *_MODULES])


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        found = getattr(import_module(_MODULES[name]), name)
    elif not name.startswith("_") and find_spec(f"flypend.{name}") is not None:
        found = import_module(f"flypend.{name}")
    else:
        raise AttributeError(f"module 'flypend' has no attribute {name!r}")
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted(__all__)


LAWS |= {name: partial(__getattr__, name) for name in ("nmpc", "plan_and_track", "track")}
