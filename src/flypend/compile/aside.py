"""Calls that nothing can stop, such as compilers: an interrupt is raised at once, and the call is left to its end."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, wait
from threading import Thread, current_thread, main_thread
from typing import Any, TypeVar

T = TypeVar("T")
PERIOD = 0.1  # s between looks at signals
_left: list[Future[Any]] = []


def aside(call: Callable[[], T]) -> T:
    """Return `call()`, made in a thread of its own.

    An interrupt in the main thread is raised within a tenth of a second; what the call returns later is dropped.
    Other threads hear no signals, and call directly.
    """
    if current_thread() is not main_thread():
        return call()
    result: Future[T] = Future()
    thread = Thread(target=_answer, args=(call, result), name="flypend-aside")
    try:
        thread.start()
        # Not Thread.join: interrupted, it takes the thread for ended (CPython before 3.13).
        while wait([result], PERIOD).not_done:
            pass
    except BaseException:
        _left.append(result)
        raise
    return result.result()


def _answer(call: Callable[[], T], result: Future[T]) -> None:
    try:
        result.set_result(call())
    except BaseException as error:  # raised where the result is asked for
        result.set_exception(error)


def left_behind() -> bool:
    """Whether a call goes on whose result nobody waits for; the end of the process would wait for it."""
    return not all(result.done() for result in _left)
