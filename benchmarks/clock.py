"""How runs are timed: by the processor's time on one core, so that other programs do not count; by the wall on all."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

REPEATS = 5


def processor(*tasks: Callable[[], Any], repeats: int = REPEATS) -> list[float]:
    """Seconds of processor time of each task, the least of some repeats, the tasks taking turns."""
    return _least(time.process_time, tasks, repeats)


def wall(*tasks: Callable[[], Any], repeats: int = REPEATS) -> list[float]:
    """Seconds on the wall of each task, the least of some repeats, the tasks taking turns."""
    return _least(time.perf_counter, tasks, repeats)


def _least(now: Callable[[], float], tasks: Sequence[Callable[[], Any]], repeats: int) -> list[float]:
    best = [float("inf")] * len(tasks)
    for _ in range(repeats):
        for i, task in enumerate(tasks):
            begin = now()
            task()
            best[i] = min(best[i], now() - begin)
    return best
