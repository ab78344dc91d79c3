"""The region of attraction over the directions of the rod, chunk by chunk."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from flypend.flight.ensemble import fly_many
from flypend.lab.setting import Setting
from flypend.lab.tuning import Stepped, Tell, tuned, values
from flypend.model import State
from flypend.model.state import SHAPES
from flypend.plants import Ideal

RUNS, CHUNK = {"ideal": 3000, "sampled": 1200, "stepped": 96}, {"ideal": 200, "sampled": 24, "stepped": 2}
# Powers of the inverse of the root of x³ = x + 1: the additive sequence that fills a square most evenly.
STEPS = (0.7548776662466927, 0.5698402909980532)


def directions(count: int) -> Any:
    """`count` unit vectors (count, 3), each for the same area of S², and so in every beginning of them."""
    height, turn = (np.modf(0.5 + step * np.arange(count))[0] for step in STEPS)
    y_3 = 1 - 2 * height
    level = np.sqrt(1 - y_3**2)
    return np.stack([level * np.cos(2 * np.pi * turn), level * np.sin(2 * np.pi * turn), y_3], axis=-1)


def region(setting: Setting, tell: Tell = lambda: None) -> Iterator[dict[str, Any]]:
    """Flights of `setting` from rods at rest in all directions, the rest of its start as it is.

    Each chunk has `total`, `done`, and of its flights `y` (e₃ up), `settling` (s; None for a failure) and `cause`.
    """
    flight = setting.flight
    machine, gains = tuned(setting, tell), values(setting)
    kind = "ideal" if isinstance(flight.plant, Ideal) else "sampled"
    kind = "stepped" if isinstance(machine, Stepped) else kind
    count, done = RUNS[kind], 0
    rods = directions(count)
    tuning = {name: float(value) for name, value in zip(machine.names, gains, strict=True)}
    while done < count:
        y = rods[done : done + CHUNK[kind]]
        starts = _starts(setting.start, y)
        own = starts.seen(machine.law.e3)
        request = flight.replace(law=machine.law, starts=own, gains=tuning, criterion=machine.criterion)
        result = fly_many(request, workers=1)
        done += len(y)
        settling = [
            value if good else None for value, good in zip(result.settling.tolist(), result.success, strict=True)
        ]
        yield {
            "total": count, "done": done, "y": np.round(y, 5).tolist(), "settling": settling,
            "cause": [str(cause) for cause in result.cause],
        }  # fmt: skip


def _starts(start: State, y: Any) -> State:
    given = {name: np.broadcast_to(getattr(start, name), (len(y), *SHAPES[name])) for name in SHAPES}
    return State(**{**given, "y": y, "y_dot": np.zeros_like(y)})
