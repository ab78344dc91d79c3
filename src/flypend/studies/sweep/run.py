"""Flies a study into its store, and resumes after an interruption."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack, closing
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

from flypend import errors, signals
from flypend.flight.kernels.stopping import interruptible, join
from flypend.signals import polling
from flypend.studies.sweep import cluster
from flypend.studies.sweep.chunk import fly_chunk, fly_range, program_digest
from flypend.studies.sweep.claim import check_place, lock_name
from flypend.studies.sweep.store import discard, open_store
from flypend.studies.sweep.study import Study
from flypend.studies.sweep.study import study as study_from

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], Any]
DEATHS = 3  # times that worker processes may die in a row, with no chunk in between


@errors.named_arguments
@signals.defer()
def sweep(
    study: Study | str | Path | Mapping[str, Any],
    store: str | Path,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    processes: bool = False,
    force: bool = False,
    progress: Progress = lambda *_: None,
) -> xarray.Dataset:
    """Fly a study into a Zarr store, and return the store as a lazily loaded `xarray.Dataset`.

    After any interruption, the same call resumes the sweep; the result is bit-identical to an uninterrupted one. A
    complete store is left unchanged.

    Parameters
    ----------
    study : Study, path or dict
        The study, or its TOML file or content; docs/studies/studies.md lists the keys.
    store : path
        The store; its name ends in .zarr.
    scheduler : str, optional
        Address of a Dask scheduler, such as tls://host:8786; default this machine. Whoever can connect to a scheduler
        without TLS runs code as you, here and on its workers.
    workers : int, optional
        Cores of this machine to use; default all.
    processes : bool
        Whether to use worker processes on this machine; no port is opened. Threads are as fast for compiled laws.
    force : bool
        Whether to start over, discarding the store of an earlier sweep.
    progress : callable
        Called with `(done, total)` runs.

    Raises
    ------
    InputError
        If the study is invalid; if the store belongs to another study (naming the first difference), is not writable or
        is in use by another sweep; or if the scheduler does not answer.
    """
    for module in ("zarr", "xarray", "scipy", *(["distributed"] if scheduler is not None else [])):
        errors.require(module, extra="studies", for_="sweep")
    if workers is not None:
        errors.integer("workers", workers, 1)
    for name, given in (("workers", workers is not None), ("processes", processes)):
        if scheduler is not None and given:
            raise errors.InputError(name, "nothing beside a scheduler, which has workers of its own", "it")
    check_place(store)
    made = study if isinstance(study, Study) else study_from(study)
    if scheduler is not None:
        cluster.check_answers(scheduler)
    fly_range(made, 0, 1)  # a law that cannot be flown leaves no store
    program = program_digest(made)
    with lock_name(store):
        if force:
            discard(store)
        kept = open_store(store, made, program, versions())
        missing = [number for number in range(made.chunks) if not kept.whole(number)]
        done = made.runs - sum(len(made.rows(number)) for number in missing)
        progress(done, made.runs)
        if scheduler is None:
            flown = _fly_here(made.text(), program, missing, workers or os.cpu_count() or 1, processes)
        else:
            flown = cluster.fly_chunks(made.text(), program, missing, scheduler)
        if missing:
            with closing(flown):
                for number, columns in flown:
                    kept.write(number, columns)
                    done += len(made.rows(number))
                    progress(done, made.runs)
    return dataset(kept.path)


def _fly_here(
    text: str, program: str, numbers: Sequence[int], workers: int, processes: bool
) -> Generator[tuple[int, dict[str, Any]], None, None]:
    """Yield chunks `numbers` of the study in the TOML string `text`, and their columns, as they complete.

    They are flown by threads, or by processes connected by pipes only, of which another takes over from one that dies.
    Raises InputError if processes die again and again.
    """
    left, deaths = list(numbers), 0
    while left:
        try:
            with closing(_fly_numbers(text, program, left, workers, processes)) as coming:
                for number, columns in coming:
                    left.remove(number)
                    deaths = 0
                    yield number, columns
        except BrokenProcessPool as error:
            deaths += 1
            if deaths == DEATHS:
                given = str(error).split(". ")[0]
                raise errors.InputError("processes", "worker processes that survive (rerun to resume)", given) from None


def _fly_numbers(
    text: str, program: str, numbers: Sequence[int], workers: int, processes: bool
) -> Generator[tuple[int, dict[str, Any]], None, None]:
    """Yield number and result of each chunk, in the order in which they end."""
    with ExitStack() as stack:
        if processes:
            submit, stop = stack.enter_context(polling.processes(workers)), None
        else:
            submit, stop = stack.enter_context(polling.threads(workers)).submit, stack.enter_context(interruptible())
        for call in polling.as_they_come([submit(_fly, text, number, program, stop) for number in numbers]):
            yield call.result()


def _fly(text: str, number: int, program: str, stop: Any) -> tuple[int, dict[str, Any]]:
    """Return number and result of a chunk; `stop` is the word of the process that asks."""
    with join(stop):
        return number, fly_chunk(text, number, program)


def dataset(path: str | Path) -> xarray.Dataset:
    """Return the store at `path` as a lazily loaded `xarray.Dataset`."""
    errors.require("xarray", extra="studies", for_="store")
    import xarray

    found: xarray.Dataset = xarray.open_zarr(path, chunks=None, consolidated=False)
    return found


def versions() -> dict[str, str]:
    """Return the versions of the packages on which the results of a run depend."""
    return {name: metadata.version(name) for name in ("flypend", "casadi", "llvmlite", "numpy", "scipy")}
