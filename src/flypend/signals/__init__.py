"""SIGINT and SIGTERM set a word; `poll`, called where it is safe to stop, raises. No handler raises.

An exception raised by a handler comes up in whatever runs at that moment. CasADi's wrapper, for one, has a bare
`except: pass` in vertcat and a dozen more, in which it vanishes.

The command line takes both signals over for good (`install`). Scripts and notebooks keep their own handlers: while a
long call runs (`defer`), what a handler raises is kept for the next `poll`.

Kernels read the word by its address. Nothing here imports NumPy: the command line comes here first.
"""

from __future__ import annotations

import atexit
import os
import select
import signal
import sys
import time
from array import array
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Thread, current_thread, main_thread
from types import FrameType
from typing import Any

NUMBERS = (signal.SIGINT, signal.SIGTERM)
PERIOD = 0.1  # s between polls of what waits
# A second signal ends the process at once, unless it comes so soon: timeout(1) and other wrappers send each twice.
ECHO = 0.5  # s
# A process whose main thread does not poll ends after so many seconds of its own work, or of waiting.
GRACE, PATIENCE = 5.0, 20.0
ENDS = {signal.SIGINT: b"flypend: interrupted\n", signal.SIGTERM: b"flypend: terminated\n"}
SHOW_CURSOR = b"\x1b[?25h"  # progress bars hide it

word = array("q", [0])  # the number of the signal that asks for an end; 0 for none
_raised: list[BaseException] = []  # by the handlers of a script
_polled = False
_taken = False  # whether the handlers are ours


def poll() -> None:
    """Raise if a signal has asked for an end: in the command line SystemExit, with the exit code.

    In a script it is whatever its own handler has raised: KeyboardInterrupt, unless it has another.
    """
    global _polled
    if not word[0]:
        return
    if current_thread() is not main_thread():
        raise SystemExit(128 + word[0])
    _polled = True
    raise _raised[0] if _raised else SystemExit(128 + word[0])


def is_accepted() -> bool:
    """Whether a signal has asked for an end, which is the way that what runs ends: it is no interruption any more."""
    global _polled
    if not word[0] or _raised:
        return bool(word[0])
    _polled = True
    word[0] = 0
    return True


def is_ending() -> bool:
    """Whether a signal is about to end a command."""
    return bool(word[0]) and not _raised


def _set(number: int, _frame: FrameType | None = None) -> None:
    if not word[0]:
        word[0] = number


class _Imports:
    """Makes imports poll, once: they are most of the time until a command begins, or draws.

    Not those of NumPy: where machine code imports it and fails, it ends the process by itself (`import_array`).
    """

    @staticmethod
    def find_spec(name: str, _path: Any = None, _target: Any = None) -> None:
        if not _polled and not name.startswith("numpy"):
            poll()


def install() -> None:
    """Let SIGINT and SIGTERM do nothing but set the word, for as long as the process lives: for the command line.

    A signal that is ignored, as under nohup, stays so.
    """
    global _taken
    _taken = True
    for number in NUMBERS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _set)
    atexit.register(_ignore)
    sys.meta_path.insert(0, _Imports)


def _ignore() -> None:
    """Ignore signals while the interpreter ends, which undoes handlers: the process has done its work."""
    for number in NUMBERS:
        signal.signal(number, signal.SIG_IGN)


def watch() -> None:
    """Start the thread that ends the process at a second signal, or if the main thread does not poll after the first.

    It hears signals even while the main thread is in a call that returns to no Python code.
    """
    if os.name != "posix":  # elsewhere signals can only be written to sockets
        return
    read_end, write_end = os.pipe()
    os.set_blocking(write_end, False)
    signal.set_wakeup_fd(write_end, warn_on_full_buffer=False)
    Thread(target=_watch, args=(read_end,), name="flypend-signals", daemon=True).start()


def _watch(read_end: int) -> None:
    number = _next(read_end, None)
    assert number is not None
    if not _polled:
        _set(number)
    begun, worked = time.monotonic(), time.process_time()
    while _next(read_end, ECHO) is not None:
        pass
    while _next(read_end, PERIOD) is None:
        late = time.process_time() - worked > GRACE or time.monotonic() - begun > PATIENCE
        if late and not _polled:
            break
    end(number)


def _next(read_end: int, timeout: float | None) -> int | None:
    """Return the number of the next signal to end; None if there is none for `timeout` seconds."""
    while select.select([read_end], [], [], timeout)[0]:
        number = os.read(read_end, 1)[0]
        if number in NUMBERS and signal.getsignal(number) is not signal.SIG_IGN:
            return number
    return None


def end(number: int) -> None:
    """End the process after signal `number`: one line on stderr, exit code 128 + `number`.

    Not through the end of the interpreter, which would wait for threads, compilers among them, that nothing can stop.
    """
    if (shared := sys.modules.get("multiprocessing.util")) is not None:
        with suppress(Exception):
            shared._run_finalizers(0)  # semaphores, whose tracker would complain
    line = ENDS[signal.Signals(number)]
    with suppress(OSError):  # nobody reads it
        os.write(2, SHOW_CURSOR + line if os.isatty(2) else line)
    os._exit(128 + number)


@contextmanager
def defer() -> Iterator[None]:
    """Keep what the handlers of SIGINT and SIGTERM raise in the block until `poll`, or until the block ends.

    A second signal is handled as outside the block. Handlers that raise nothing, signals without a Python handler, and
    threads but the main one are left alone; so are blocks inside another.
    """
    global _taken
    before: dict[int, Callable[..., Any]] = {}

    def keep(number: int, frame: FrameType | None) -> None:
        if word[0]:
            before[number](number, frame)
            return
        try:
            before[number](number, frame)
        except BaseException as error:
            _raised.append(error)
            word[0] = number

    if _taken or current_thread() is not main_thread():
        yield
        return
    try:
        _taken = True
        for number in NUMBERS:
            handler = signal.getsignal(number)
            if callable(handler):
                before[number] = handler
                signal.signal(number, keep)
        yield
    finally:
        for caught, own in before.items():
            signal.signal(caught, own)
        kept, word[0], _taken = _raised[:], 0, False
        _raised.clear()
        if kept:
            raise kept[0] from None
