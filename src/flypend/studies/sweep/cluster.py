"""Chunks on an existing Dask cluster."""

from __future__ import annotations

import logging
import re
import time
from collections.abc import Generator, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from typing import Any

from flypend.errors import InputError
from flypend.signals import PERIOD, poll
from flypend.studies.sweep.chunk import fly_chunk

# Chunks submitted per core: one runs, one waits.
AHEAD = 2
CONNECT = 10.0
# Seconds for the columns of a chunk to come, at most some megabytes, before the connection is looked at.
PATIENCE = 60.0
STAYS = "a cluster that stays up (rerun the same command to resume)"
ADDRESS = re.compile(r"([a-z]+://)?([\w.-]+|\[[0-9a-fA-F:.]+\]):\d{1,5}", re.ASCII)


def fly_chunks(
    text: str, program: str, numbers: Iterable[int], scheduler: str
) -> Generator[tuple[int, dict[str, Any]], None, None]:
    """Fly chunks `numbers` of a study on the cluster of a Dask `scheduler`, and yield each with its columns.

    `text` is the study as TOML, `program` the digest of its program. Raises InputError if the scheduler does not answer
    or is lost, or if workers die repeatedly or compile other equations.
    """
    import distributed

    as_completed: Any = distributed.as_completed

    waiting = iter(numbers)
    with _client(scheduler) as client:
        cores = sum(client.nthreads().values()) or 1

        def submit(number: int) -> Any:
            _check_running(client)
            return client.submit(fly_chunk, text, number, program, key=f"flypend-{number}-{hash(text)}", pure=False)

        futures = {submit(number): number for _, number in zip(range(AHEAD * cores), waiting, strict=False)}
        coming = as_completed(futures)
        while futures:
            try:
                while not coming.has_ready():  # `next` would wait for ever for a scheduler that is gone
                    _check_running(client)
                    poll()
                    time.sleep(PERIOD)
                future = next(coming)
                yield futures.pop(future), _result(future, client)
                number = next(waiting, None)
                if number is not None:
                    following = submit(number)
                    futures[following] = number
                    coming.add(following)
            except (CancelledError, OSError, distributed.KilledWorker) as error:
                reason = str(error).rpartition("reason: ")[2].split(". ")[0] or type(error).__name__
                raise InputError("scheduler", STAYS, reason) from None


def _result(future: Any, client: Any) -> dict[str, Any]:
    """Return the columns of a chunk that is done, or raise what it raised."""
    while True:
        try:
            columns: dict[str, Any] = future.result(PATIENCE)
        except TimeoutError:
            _check_running(client)
        else:
            return columns


def _check_running(client: Any) -> None:
    if client.status != "running":
        raise InputError("scheduler", STAYS, "a lost connection to the scheduler")


def check_answers(scheduler: str) -> None:
    """Raise InputError unless a Dask `scheduler` answers at its address."""
    if not ADDRESS.fullmatch(scheduler):  # Dask would look for a long time
        raise InputError("scheduler", "the address of a Dask scheduler, such as tls://host:8786", repr(scheduler))
    with _client(scheduler):
        pass


@contextmanager
def _client(scheduler: str) -> Iterator[Any]:
    import dask
    import distributed

    make: Any = distributed.Client
    with dask.config.set({"distributed.comm.timeouts.connect": CONNECT}):
        try:
            client = make(scheduler, timeout=CONNECT)
        except (OSError, ValueError, TimeoutError) as error:
            reason = f"{scheduler} ({error})"
            raise InputError("scheduler", "the address of a Dask scheduler that answers", reason) from None
        logger = logging.getLogger("distributed.client")
        level = logger.level
        logger.setLevel(logging.CRITICAL)  # of a lost scheduler it writes pages, of which one line is told
        try:
            with client:
                yield client
        finally:
            logger.setLevel(level)
