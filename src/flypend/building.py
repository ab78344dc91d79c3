"""Who builds expressions of CasADi: one thread at a time."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
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


@contextmanager
def no_numbers() -> Iterator[None]:
    """Let float() of a symbol raise TypeError: CasADi answers NaN, and an `if` on that always takes the same branch."""
    import casadi as ca  # not by commands that build nothing

    with building:
        as_float = ca.SX.__float__

        def refuse(expression: ca.SX) -> float:
            if not expression.is_constant():
                raise TypeError("a symbol is not a number, such as float() and math.sin() need")
            return as_float(expression)  # type: ignore[no-any-return]

        ca.SX.__float__ = refuse
        try:
            yield
        finally:
            ca.SX.__float__ = as_float
