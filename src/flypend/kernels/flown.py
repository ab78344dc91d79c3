"""What a kernel gives, and the flying of many runs on all cores: in pieces, each a call that lets Python go on."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

Progress = Callable[[int, int], Any]

# Words of `Trajectory.outcome` for the codes of `flypend.compile.runge_kutta`.
STATUS: Any = np.array(["completed", "diverged", "singular", "singular", "diverged", "diverged"])


@dataclass(frozen=True)
class Flown:
    """Results of n runs.

    Parameters
    ----------
    final : (n, 24)
        Packed final states.
    end : (n,)
        When each run ended, s.
    code : (n,)
        How: see `flypend.compile.runge_kutta`; `STATUS` has the words.
    reductions : (n, 7)
        As `criterion.REDUCTIONS` has it.
    samples : (n, times, 24 or more), optional
        States at the sample times, followed by the rotor forces in a sampled flight; NaN after the end.
    steps : (n,), optional
        Steps tried, in the ideal plant.
    """

    final: Any
    end: Any
    code: Any
    reductions: Any
    samples: Any = None
    steps: Any = None

    def __len__(self) -> int:
        """Number of runs."""
        return len(self.end)

    @property
    def status(self) -> Any:
        """How each run ended, in words (n,)."""
        return STATUS[self.code]


def in_pieces(
    fly: Callable[[slice], Flown], runs: int, piece: int, workers: int | None, progress: Progress = lambda *_: None
) -> Flown:
    """The results of `runs` runs, `fly` being called with slices of `piece` runs from `workers` threads.

    `progress` is told (done, runs) after each piece. A run gives the same result in any slice and on any thread.
    """
    slices = [slice(start, min(start + piece, runs)) for start in range(0, runs, piece)]
    count = min(workers or os.cpu_count() or 1, len(slices))
    parts: list[Flown] = []
    if count == 1:
        for part in slices:
            parts.append(fly(part))
            progress(part.stop, runs)
        return joined(parts)
    with ThreadPoolExecutor(count) as pool:
        try:
            for part, result in zip(slices, pool.map(fly, slices), strict=True):
                parts.append(result)
                progress(part.stop, runs)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return joined(parts)


def joined(parts: list[Flown]) -> Flown:
    """Results of runs that follow each other, as one."""
    if len(parts) == 1:
        return parts[0]
    columns = {entry.name: [getattr(part, entry.name) for part in parts] for entry in fields(Flown)}
    return Flown(**{name: None if column[0] is None else np.concatenate(column) for name, column in columns.items()})


def address(array: Any) -> int | None:
    """Where the numbers of a contiguous `array` are, for a kernel; None for none."""
    return None if array is None else array.ctypes.data
