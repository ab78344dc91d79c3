"""Kernel calls that can be stopped: they run in threads of their own, and poll a word that ends them.

Python runs signal handlers in the main thread, and only between its instructions: a call into machine code would hold
Ctrl-C back until it returns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar
from threading import current_thread, main_thread

import numpy as np
from numpy.typing import NDArray

from flypend import signals

Word = NDArray[np.int64]
SIGNAL: Word = np.frombuffer(signals.word, dtype=np.int64)  # stops every call that has no word of its own
_word: ContextVar[Word | None] = ContextVar("stop word", default=None)


class StoppedError(RuntimeError):
    """A kernel call was stopped on purpose; its results mean nothing."""


@contextmanager
def interruptible() -> Iterator[Word]:
    """Yield the stop word (1,) of all kernel calls in the block; it is set if the block is left by an exception.

    A block inside another shares the word of the outer one, which then also sets it.
    """
    outer = _word.get()
    if outer is not None:
        yield outer
        return
    word: Word = np.zeros(1, dtype=np.int64)
    with join(word), signals.defer():
        try:
            yield word
        except BaseException:
            word[0] = 1
            raise


@contextmanager
def join(word: Word | None) -> Iterator[None]:
    """Make `word`, which another thread may set, the stop word of all kernel calls in the block."""
    token = _word.set(word)
    try:
        yield
    finally:
        _word.reset(token)


def raise_if_stopped() -> None:
    """Raise StoppedError if the stop word of the block is set: for loops in Python."""
    word = _word.get()
    if word is not None and word[0]:
        raise StoppedError("stopped")


def heard(calls: Sequence[Callable[[Word], None]], tell: Callable[[], None] = lambda: None) -> None:
    """Make each of `calls`, with the stop word as argument, in a thread of its own, and wait for all.

    A signal sets the word and is raised once the calls have returned. `tell` is called ten times a second.

    Raises StoppedError if the word was set elsewhere.
    """
    if len(calls) == 1 and current_thread() is not main_thread():
        word = _word.get()
        word = SIGNAL if word is None else word
        calls[0](word)
        _check(word)
        return
    with interruptible() as word:
        with ThreadPoolExecutor(len(calls)) as pool:
            tasks = [pool.submit(call, word) for call in calls]
            try:
                while wait(tasks, timeout=signals.PERIOD).not_done:
                    signals.poll()
                    tell()
            except BaseException:
                word[0] = 1
                raise
        for task in tasks:
            task.result()
        _check(word)


def _check(word: Word) -> None:
    signals.poll()
    if word[0]:
        raise StoppedError("stopped")
