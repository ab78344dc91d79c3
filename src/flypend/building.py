"""Who builds expressions of CasADi: one thread at a time."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import lru_cache, wraps
from threading import RLock
from typing import Any, TypeVar, cast

# Expressions share the nodes of their constants, and CasADi 3.8 lets go of the interpreter: where one thread frees the
# last use of a number while another one looks it up, the process crashes. One thread builds at a time.
building = RLock()
if hasattr(os, "register_at_fork"):  # a process that is forked has no thread that would let go
    os.register_at_fork(before=building.acquire, after_in_parent=building.release, after_in_child=building.release)
F = TypeVar("F", bound=Callable[..., Any])


def builds(function: F) -> F:
    """Let one thread at a time call `function`, which builds expressions of CasADi."""

    @wraps(function)
    def call(*args: Any, **given: Any) -> Any:
        with building:
            return function(*args, **given)

    return cast("F", call)


def built(maxsize: int | None) -> Callable[[F], F]:
    """Let one thread at a time call a function that builds, and keep what it returned for the last `maxsize` calls."""

    def decorate(function: F) -> F:
        return cast("F", wraps(function)(builds(lru_cache(maxsize)(function))))

    return decorate
