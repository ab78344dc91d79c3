"""Starts that a page offers."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.model import State
from flypend.model.state import SHAPES

# Directions of the rod, e₃ up, for starts at rest.
STARTS = {"hanging": (0.0, 0.0, -1.0), "level": (1.0, 0.0, 0.0), "leaning": (0.28, 0.0, 0.96)}
# 1/ρ and 1/ρ² for the plastic number ρ³ = ρ + 1: Roberts's R2 low-discrepancy sequence on the unit square.
STEPS = (0.7548776662466927, 0.5698402909980532)


def plain(state: State) -> dict[str, Any]:
    """Return the fields of `state` as lists."""
    return {name: getattr(state, name).tolist() for name in SHAPES}


def starts() -> dict[str, dict[str, Any]]:
    """Return the starts at rest by name, as lists."""
    return {name: plain(State(y=y)) for name, y in STARTS.items()}


def directions(count: int) -> Any:
    """Return `count` unit vectors (count, 3) spread evenly over S²; every prefix is spread evenly, too."""
    height, turn = (np.modf(0.5 + step * np.arange(count))[0] for step in STEPS)
    y_3 = 1 - 2 * height
    level = np.sqrt(1 - y_3**2)
    return np.stack([level * np.cos(2 * np.pi * turn), level * np.sin(2 * np.pi * turn), y_3], axis=-1)
