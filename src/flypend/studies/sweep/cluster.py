"""Chunks on Dask: on threads of this process, on local worker processes, or on an existing cluster."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from flypend.errors import InputError
from flypend.studies.sweep.chunk import fly_chunk

# Chunks submitted per core: one runs, one waits.
AHEAD = 2
CONNECT = 10.0


def flown_chunks(
    text: str,
    program: str,
    numbers: Iterable[int],
    *,
    scheduler: str | None,
    workers: int | None,
    processes: bool,
) -> Iterator[tuple[int, dict[str, Any]]]:
    """Fly chunks `numbers` of a study, and yield each with its columns as it completes.

    Parameters
    ----------
    text, program, numbers
        The study as TOML; the digest of its program; the indices of the chunks.
    scheduler : str, optional
        Address of a Dask scheduler; default a local cluster.
    workers : int, optional
        Threads or processes of the local cluster; default one per core.
    processes : bool
        Whether the local cluster uses processes instead of threads.

    Raises
    ------
    InputError
        If the scheduler does not answer or is lost, or if workers die repeatedly or compile other equations.
    """
    import distributed

    as_completed: Any = distributed.as_completed

    waiting = iter(numbers)
    with _client(scheduler, workers, processes) as client:
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
def _client(scheduler: str | None, workers: int | None, processes: bool) -> Iterator[Any]:
    import dask
    import distributed

    made: tuple[Any, Any] = (distributed.Client, distributed.LocalCluster)
    Client, LocalCluster = made

    count = workers or os.cpu_count() or 1
    settings = {"distributed.comm.timeouts.connect": CONNECT, "distributed.worker.daemon": True}
    with dask.config.set(settings):
        if scheduler is not None:
            try:
                client = Client(scheduler, timeout=CONNECT)
            except (OSError, ValueError, TimeoutError) as error:
                raise InputError(
                    "scheduler", "the address of a Dask scheduler that answers", f"{scheduler} ({error})"
                ) from None
            with client:
                yield client
            return
        size = (
            {"n_workers": count, "threads_per_worker": 1}
            if processes
            else {"n_workers": 1, "threads_per_worker": count}
        )
        with (
            LocalCluster(
                processes=processes,
                dashboard_address="127.0.0.1:0",
                worker_dashboard_address="127.0.0.1:0",
                memory_limit=0,
                silence_logs=50,
                **size,
            ) as cluster,
            Client(cluster) as client,
        ):
            yield client
