"""Kernel results, and scheduling of many runs on all cores, from a queue or in pieces. Calls release the GIL."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import partial
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.compile.llvm.jit import Native
from flypend.compile.numeric import allocate_aligned
from flypend.errors import InputError
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.stopping import Word, heard
from flypend.geometry import Numbers
from flypend.plants.loop import Loop

Progress = Callable[[int, int], Any]

# Fewest runs worth a thread.
LEAST_SHARE = 64

# Status strings of `Outcome` for the codes of `flypend.compile.llvm.runge_kutta`.
STATUS: Any = np.array(["completed", "diverged", "singular", "singular", "diverged", "diverged", "collided"])


@dataclass(frozen=True, eq=False)
class Kernel:
    """A compiled closed loop.

    Parameters
    ----------
    loop : Loop
        Vehicle, law and plant; its `parameters` are the gains that may differ between runs.
    criterion : Criterion
        Success criterion.
    function : Native
        The compiled kernel.
    key : str
        Cache key: everything that determines the kernel, except processor and versions.
    """

    loop: Loop
    criterion: Criterion
    function: Native
    key: str


@dataclass(frozen=True)
class Flown:
    """Results of n runs.

    Parameters
    ----------
    final : (n, 24)
        Packed final states; (n, 28) with the wrench that acts, in the ideal plant with lag.
    end : (n,)
        End time of each run, s.
    code : (n,)
        How it ended: see `flypend.compile.llvm.runge_kutta`. `STATUS` maps codes to strings.
    reductions : (n, 7) or (n, 13), optional
        See `criterion.REDUCTIONS`, and in a sampled plant `EXTENTS`.
    samples : (n, times, 24 or more), optional
        States at the sample times, followed by rotor forces in a sampled flight, and by the wrench that acts in the
        ideal plant with lag; NaN after the end.
    steps : (n,)
        Attempted steps, in the ideal plant; 0 in a sampled one.
    clearance, part : (n,), optional
        Least distance (m) of the rod to what it can touch, and the part that was touched, −1 for none; see
        `flypend.flight.touch`.
    """

    final: Numbers
    end: Numbers
    code: Numbers
    reductions: Numbers
    samples: Numbers = None
    steps: Numbers = None
    clearance: Numbers = None
    part: Numbers = None

    @classmethod
    def of_size(
        cls, runs: int, size: int, *, samples: tuple[int, int] | None = None, judged: int = 0, touching: bool = False
    ) -> Flown:
        """Allocate results for `runs` runs with states of `size`.

        `samples` is (times, length) if they are kept, `judged` the number of reductions, 0 for none.
        """
        return cls(
            final=np.empty((runs, size)),
            end=np.empty(runs),
            code=np.empty(runs, dtype=np.int64),
            reductions=np.empty((runs, judged)) if judged else None,
            samples=None if samples is None else allocate_aligned((runs, *samples)),
            steps=np.zeros(runs, dtype=np.int64),
            clearance=np.empty(runs) if touching else None,
            part=np.empty(runs, dtype=np.int64) if touching else None,
        )

    def of(self, runs: slice) -> Flown:
        """Return views of the results of `runs`."""
        columns = {entry.name: getattr(self, entry.name) for entry in fields(self)}
        return Flown(**{name: None if column is None else column[runs] for name, column in columns.items()})

    def __len__(self) -> int:
        """Number of runs."""
        return len(self.end)

    @property
    def status(self) -> Numbers:
        """Status string of each run (n,)."""
        return STATUS[self.code]


def in_pieces(
    fly: Callable[[slice, Flown, Word], None],
    out: Flown,
    piece: int,
    workers: int | None,
    progress: Progress = lambda *_: None,
) -> Flown:
    """Call `fly` on pieces of at most `piece` runs in `workers` threads, and return `out`, which they fill.

    `progress` is called with (done, runs) ten times a second. Results do not depend on piece size or thread.
    """
    runs, done = len(out), [0]
    slices = [slice(start, min(start + piece, runs)) for start in range(0, runs, piece)]
    waiting = iter(slices)  # shared by the threads: the next piece is taken atomically

    def work(stop: Word) -> None:
        for part in waiting:
            if stop[0]:
                return
            fly(part, out.of(part), stop)
            done.append(part.stop - part.start)

    threads = min(workers or os.cpu_count() or 1, len(slices))
    heard([work] * threads, lambda: progress(sum(done), runs))
    progress(runs, runs)
    return out


def from_queue(
    fly: Callable[[Any, Word], None], runs: int, workers: int | None, progress: Progress = lambda *_: None
) -> None:
    """Call `fly` in `workers` threads; all take their runs from one queue (1,), the index of the next run.

    `progress` is called with (started, runs) ten times a second.
    """
    queue = np.zeros(1, dtype=np.int64)
    threads = max(1, min(workers or os.cpu_count() or 1, runs // LEAST_SHARE))
    heard([partial(fly, queue)] * threads, lambda: progress(min(int(queue[0]), runs), runs))
    progress(runs, runs)


def inputs_of(loop: Loop, given: Numbers, runs: int) -> NDArray[np.float64]:
    """Return the inputs (runs, k) of a kernel of `loop`: `given`, or by default the gains of its law."""
    names = loop.parameters
    if given is None:
        given = np.broadcast_to([loop.symbolic.numbers[name] for name in names], (runs, len(names)))
    values = np.ascontiguousarray(given, dtype=float)
    if values.shape != (runs, len(names)):
        raise InputError("parameters", f"an array of shape {(runs, len(names))}", f"shape {values.shape}")
    return values


def in_order(names: Sequence[str], given: Mapping[str, Any]) -> list[Any]:
    """Return the arguments `given` by name in the order of a kernel's `names`: numbers, addresses of arrays, None."""
    values = [given[name] for name in names]
    return [value if value is None or isinstance(value, Real) else value.ctypes.data for value in values]
