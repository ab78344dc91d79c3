"""How runs are timed: by the processor's time on one core, so that other programs do not count; by the wall on all."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

REPEATS = 5


def processor(*tasks: Callable[[], Any], repeats: int = REPEATS) -> list[float]:
    """Seconds of processor time of each task, the least of some repeats, the tasks taking turns."""
    best = [float("inf")] * len(tasks)
    for _ in range(repeats):
        for i, task in enumerate(tasks):
            begin = time.process_time()
            task()
            best[i] = min(best[i], time.process_time() - begin)
    return best


def wall(*tasks: Callable[[], Any], repeats: int = REPEATS) -> list[float]:
    """Seconds on the wall of each task, the least of some repeats, the tasks taking turns."""
    best = [float("inf")] * len(tasks)
    for _ in range(repeats):
        for i, task in enumerate(tasks):
            begin = time.perf_counter()
            task()
            best[i] = min(best[i], time.perf_counter() - begin)
    return best
