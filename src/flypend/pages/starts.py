"""Starts that a page offers."""

from __future__ import annotations

from typing import Any

from flypend.model import State
from flypend.model.state import SHAPES

# Directions of the rod, e₃ up, for starts at rest.
STARTS = {"hanging": (0.0, 0.0, -1.0), "level": (1.0, 0.0, 0.0), "leaning": (0.28, 0.0, 0.96)}


def plain(state: State) -> dict[str, Any]:
    """Return the fields of `state` as lists."""
    return {name: getattr(state, name).tolist() for name in SHAPES}


def starts() -> dict[str, dict[str, Any]]:
    """Return the starts at rest by name, as lists."""
    return {name: plain(State(y=y)) for name, y in STARTS.items()}
