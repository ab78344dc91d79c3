"""Waiting that polls: for threads, for worker processes, and for other programs."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager, suppress
from threading import Thread, current_thread, main_thread
from typing import TYPE_CHECKING, Any, TypeVar

from flypend.signals import PERIOD, is_ending, poll

if TYPE_CHECKING:
    from subprocess import CompletedProcess

T = TypeVar("T")
Submit = Callable[..., "Future[Any]"]
IDLE = 30.0  # s after which a worker process that has nothing to do ends
# Workers share the cores; their matrices are small.
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


def result_of(call: Future[T]) -> T:
    """Return the result of a `call`; raise what it raises, or what `poll` does."""
    while wait([call], PERIOD).not_done:
        poll()
    poll()
    return call.result()


def call_in_thread(call: Callable[[], T]) -> T:
    """Return `call()`, which nothing can stop, such as a compiler, made in a thread of its own.

    A signal is raised in the main thread within a tenth of a second; what the call returns later is dropped. Other
    threads call directly.
    """
    if current_thread() is not main_thread():
        return call()
    result: Future[T] = Future()

    def answer() -> None:
        try:
            result.set_result(call())
        except BaseException as error:  # raised where the result is asked for
            result.set_exception(error)

    Thread(target=answer, name="flypend-aside").start()
    return result_of(result)


def as_they_come(calls: Sequence[Future[T]]) -> Iterator[Future[T]]:
    """Yield `calls` as they are done, those done at once in their order; raise what `poll` does."""
    left = list(calls)
    del calls  # with what they return
    while left:
        done = wait(left, PERIOD, FIRST_COMPLETED).done
        poll()
        coming, left = [call for call in left if call in done], [call for call in left if call not in done]
        yield from coming


@contextmanager
def threads(number: int, *, last: bool = True) -> Iterator[ThreadPoolExecutor]:
    """Yield a pool of `number` threads; calls that have not begun at the end of the block are dropped.

    Those that have are waited for if the `last` results count, and never in a command that is about to end: one may be
    in a compiler.
    """
    pool = ThreadPoolExecutor(number)
    try:
        yield pool
    finally:
        pool.shutdown(wait=last and not is_ending(), cancel_futures=True)


@contextmanager
def _mask() -> Iterator[None]:
    """Block SIGINT for what is started here, threads that start others included; this process hears by others."""
    if os.name != "posix":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def processes(number: int) -> Iterator[Submit]:
    """Yield `submit(function, *arguments)`, which calls a function in one of `number` processes.

    They hear no Ctrl-C, which a terminal sends to all of its processes. If the block raises they are killed, and if
    this process is, they end.
    """
    from joblib.externals.loky import get_reusable_executor
    from joblib.externals.loky.backend import resource_tracker

    if os.name == "posix":
        resource_tracker.ensure_running()  # it would lift the mask
    with _mask():  # a pool of another size starts workers here
        pool = get_reusable_executor(number, timeout=IDLE, env=ENVIRONMENT)

    def submit(function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        with _mask():
            call: Future[Any] = pool.submit(function, *arguments)
        return call

    try:
        yield submit
    except BaseException:
        # `shutdown(kill_workers=True)` trips over calls that are queued; of dead workers the pool gathers the rest.
        for worker in list(pool._processes or ()):
            with suppress(ProcessLookupError):
                os.kill(worker, getattr(signal, "SIGKILL", signal.SIGTERM))
        pool.shutdown()
        raise


def run(command: Sequence[str], **options: Any) -> CompletedProcess[Any]:
    """Run another program as `subprocess.run` does, its output captured; kill it if `poll` raises."""
    import subprocess

    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options) as process:  # noqa: S603
        try:
            while True:
                try:
                    out, err = process.communicate(timeout=PERIOD)
                    break
                except subprocess.TimeoutExpired:
                    poll()
        except BaseException:
            process.kill()
            raise
    poll()
    return subprocess.CompletedProcess(command, process.returncode, out, err)
