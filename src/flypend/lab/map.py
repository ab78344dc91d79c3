"""The region of attraction over the directions of the rod, chunk by chunk."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from flypend.ensemble import simulate_ensemble
from flypend.lab.setting import Setting
from flypend.lab.tuning import Tell, tuned, values
from flypend.model import State
from flypend.model.state import SHAPES

RUNS, CHUNK = {"ideal": 3000, "sampled": 1200}, {"ideal": 200, "sampled": 24}
GOLDEN = (3 - 5**0.5) * np.pi


def directions(count: int) -> Any:
    """`count` unit vectors (count, 3), each for the same area of S², from +e₃ to −e₃ along a spiral."""
    i = np.arange(count)
    height = 1 - (2 * i + 1) / count
    level = np.sqrt(1 - height**2)
    return np.stack([level * np.cos(GOLDEN * i), level * np.sin(GOLDEN * i), height], axis=-1)


def spread(count: int) -> Any:
    """The numbers below `count` in an order whose beginnings are spread over all of them."""
    return np.argsort(np.modf(np.arange(count) * (5**0.5 - 1) / 2)[0], kind="stable").argsort(kind="stable")


def region(setting: Setting, tell: Tell = lambda: None) -> Iterator[dict[str, Any]]:
    """Flights of `setting` from rods at rest in all directions, the rest of its start as it is.

    Each chunk has `total`, `done`, and of its flights `y` (e₃ up), `settling` (s; None for a failure) and `cause`.
    """
    flight = setting.flight
    machine, gains = tuned(flight, tell), values(flight)
    kind = "ideal" if machine.plant is None else "sampled"
    count, done = RUNS[kind], 0
    rods = directions(count)[spread(count)]
    tuning = {name: float(value) for name, value in zip(machine.names, gains, strict=True)}
    plant = "ideal" if machine.plant is None else flight.plant
    while done < count:
        y = rods[done : done + CHUNK[kind]]
        starts = _starts(setting.start, y)
        result = simulate_ensemble(
            flight.vehicle, machine.law, starts if machine.law.e3 == "up" else starts.flipped(), flight.duration,
            plant=plant, gains=tuning, criterion=machine.criterion, workers=1,
        )  # fmt: skip
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
