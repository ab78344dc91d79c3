"""The region of attraction over initial directions of the rod, chunk by chunk."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from flypend.flight.ensemble import fly_many
from flypend.lab.flying import MOST_STEPS
from flypend.lab.setting import Setting
from flypend.lab.tuning import Stepped, Tell, tune_loop, values
from flypend.model import State
from flypend.model.state import SHAPES
from flypend.pages.starts import directions
from flypend.plants import Ideal

RUNS = {"ideal": 3000, "sampled": 1200, "stepped": 96}
FIRST, MOST = {"ideal": 16, "sampled": 16, "stepped": 2}, {"ideal": 256, "sampled": 64, "stepped": 8}  # of a chunk
CHUNK_TIME = 0.1  # s of processor time that a chunk should take, to be seen as it comes


def region(setting: Setting, tell: Tell = lambda: None) -> Iterator[dict[str, Any]]:
    """Fly `setting` with the rod at rest in all directions, the rest of its start unchanged, and yield chunks.

    A chunk holds `total`, `done` and, for each of its flights, `y` (e₃ up), `settling` (s; None for a failure) and
    `cause`. A flight of more than MOST_STEPS counts as diverged.
    """
    flight = setting.flight
    machine, gains = tune_loop(setting, tell), values(setting)
    kind = "ideal" if isinstance(flight.plant, Ideal) else "sampled"
    kind = "stepped" if isinstance(machine, Stepped) else kind
    count, done, size = RUNS[kind], 0, FIRST[kind]
    rods = directions(count)
    tuning = {name: float(value) for name, value in zip(machine.names, gains, strict=True)}
    exact = replace(flight.tolerances, max_steps=MOST_STEPS)
    while done < count:
        begun = time.thread_time()
        y = rods[done : done + size]
        own = _starts(setting.start, y).in_frame(machine.law.e3)
        request = flight.replace(
            law=machine.law, starts=own, gains=tuning, criterion=machine.criterion, tolerances=exact
        )
        result = fly_many(request, workers=1)
        done += len(y)
        settling = [
            value if good else None for value, good in zip(result.settling.tolist(), result.success, strict=True)
        ]
        yield {
            "total": count, "done": done, "y": np.round(y, 5).tolist(), "settling": settling,
            "cause": [str(cause) for cause in result.cause],
        }  # fmt: skip
        took = max(time.thread_time() - begun, 1e-3)
        size = int(np.clip(size * CHUNK_TIME / took, FIRST[kind], min(2 * size, MOST[kind])))


def _starts(start: State, y: Any) -> State:
    given = {name: np.broadcast_to(getattr(start, name), (len(y), *SHAPES[name])) for name in SHAPES}
    return State(**{**given, "y": y, "y_dot": np.zeros_like(y)})
