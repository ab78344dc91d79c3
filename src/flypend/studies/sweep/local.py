"""Chunks on the cores of this machine, by threads or by processes connected by pipes only."""

from __future__ import annotations

import os
from collections.abc import Generator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from typing import Any

from flypend.errors import InputError
from flypend.flight.kernels.stopping import interruptible, join
from flypend.signals import waiting
from flypend.studies.sweep.chunk import fly_chunk

# Times that workers may die in a row, with no chunk in between.
DEATHS = 3


def fly_chunks(
    text: str, program: str, numbers: Sequence[int], *, workers: int | None, processes: bool
) -> Generator[tuple[int, dict[str, Any]], None, None]:
    """Fly chunks `numbers` of a study, and yield each with its columns as it completes.

    Parameters
    ----------
    text, program, numbers
        The study as TOML; the digest of its program; the indices of the chunks.
    workers : int, optional
        Threads or processes; default one per core.
    processes : bool
        Whether to use processes instead of threads. Another takes over from one that dies.

    Raises
    ------
    InputError
        If processes die again and again.
    """
    left, deaths = list(numbers), 0
    while left:
        try:
            with closing(_fly_numbers(text, program, left, workers or os.cpu_count() or 1, processes)) as coming:
                for number, columns in coming:
                    left.remove(number)
                    deaths = 0
                    yield number, columns
        except BrokenProcessPool as error:
            deaths += 1
            if deaths == DEATHS:
                told = str(error).split(". ")[0]
                raise InputError("processes", "worker processes that survive (rerun to resume)", told) from None


def _fly_numbers(
    text: str, program: str, numbers: Sequence[int], workers: int, processes: bool
) -> Generator[tuple[int, dict[str, Any]], None, None]:
    """Yield number and result of each chunk, in the order in which they end."""
    if processes:
        with waiting.processes(workers) as submit:
            for call in waiting.as_they_come([submit(_fly, text, number, program, None) for number in numbers]):
                yield call.result()
    else:
        with waiting.threads(workers) as pool, interruptible() as stop:
            for call in waiting.as_they_come([pool.submit(_fly, text, number, program, stop) for number in numbers]):
                yield call.result()


def _fly(text: str, number: int, program: str, stop: Any) -> tuple[int, dict[str, Any]]:
    """Return number and result of a chunk; `stop` is the word of the process that asks."""
    with join(stop):
        return number, fly_chunk(text, number, program)
