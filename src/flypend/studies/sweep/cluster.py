"""Chunks on an existing Dask cluster."""

from __future__ import annotations

import re
from collections.abc import Generator, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from flypend.errors import InputError
from flypend.studies.sweep.chunk import fly_chunk

# Chunks submitted per core: one runs, one waits.
AHEAD = 2
CONNECT = 10.0
ADDRESS = re.compile(r"([a-z]+://)?([\w.-]+|\[[0-9a-fA-F:.]+\]):\d{1,5}", re.ASCII)


def fly_chunks(
    text: str, program: str, numbers: Iterable[int], scheduler: str
) -> Generator[tuple[int, dict[str, Any]], None, None]:
    """Fly chunks `numbers` of a study on the cluster of a Dask `scheduler`, and yield each with its columns.

    `text` is the study as TOML, `program` the digest of its program.

    Raises
    ------
    InputError
        If the scheduler does not answer or is lost, or if workers die repeatedly or compile other equations.
    """
    import distributed

    as_completed: Any = distributed.as_completed

    waiting = iter(numbers)
    with _client(scheduler) as client:
        cores = sum(client.nthreads().values()) or 1

        def submit(number: int) -> Any:
            return client.submit(fly_chunk, text, number, program, key=f"flypend-{number}-{hash(text)}", pure=False)

        futures = {submit(number): number for _, number in zip(range(AHEAD * cores), waiting, strict=False)}
        coming = as_completed(futures)
        for future in coming:
            yield futures.pop(future), _result(future)
            number = next(waiting, None)
            if number is not None:
                following = submit(number)
                futures[following] = number
                coming.add(following)


def check_answers(scheduler: str) -> None:
    """Raise InputError unless a Dask `scheduler` answers at its address."""
    if not ADDRESS.fullmatch(scheduler):  # Dask would look for a long time
        raise InputError("scheduler", "the address of a Dask scheduler, such as tls://host:8786", repr(scheduler))
    with _client(scheduler):
        pass


def _result(future: Any) -> dict[str, Any]:
    """The columns of a chunk. Raises InputError if the cluster is lost or workers die."""
    from concurrent.futures import CancelledError

    import distributed

    try:
        columns: dict[str, Any] = future.result()
    except (CancelledError, OSError, distributed.KilledWorker) as error:
        told = str(error).split(". ")[0] or type(error).__name__
        raise InputError("scheduler", "a cluster that stays up (rerun the same command to resume)", told) from None
    return columns


@contextmanager
def _client(scheduler: str) -> Iterator[Any]:
    import dask
    import distributed

    make: Any = distributed.Client
    with dask.config.set({"distributed.comm.timeouts.connect": CONNECT}):
        try:
            client = make(scheduler, timeout=CONNECT)
        except (OSError, ValueError, TimeoutError) as error:
            told = f"{scheduler} ({error})"
            raise InputError("scheduler", "the address of a Dask scheduler that answers", told) from None
        with client:
            yield client
