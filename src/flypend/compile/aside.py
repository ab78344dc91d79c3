"""Calls that nothing can stop, such as compilers: a signal is raised at once, and the call is left to its end."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread, current_thread, main_thread
from typing import TypeVar

from flypend.signals.waiting import result_of

T = TypeVar("T")


def call_in_thread(call: Callable[[], T]) -> T:
    """Return `call()`, made in a thread of its own.

    A signal is raised in the main thread within a tenth of a second; what the call returns later is dropped. Other
    threads call directly.
    """
    if current_thread() is not main_thread():
        return call()
    result: Future[T] = Future()
    Thread(target=_answer, args=(call, result), name="flypend-aside").start()
    return result_of(result)


def _answer(call: Callable[[], T], result: Future[T]) -> None:
    try:
        result.set_result(call())
    except BaseException as error:  # raised where the result is asked for
        result.set_exception(error)
