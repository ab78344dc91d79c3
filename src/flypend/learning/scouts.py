"""Short flights that find the starts from which the rod of a hub comes nearest to an arm."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from flypend.learning.flights import Course, Flights
from flypend.learning.network import Weights

AHEAD = 0.3  # s: what touches does so soon, or can be helped later
AMONG = 4  # starts flown for each that is kept


class Scouts:
    """Memory of short flights in the manner of a `course`, of which the `kept` most dangerous count."""

    def __init__(self, course: Course, kept: int) -> None:
        self._flights, self._kept = Flights(replace(course, duration=AHEAD), AMONG * kept), kept

    @property
    def count(self) -> int:
        """Starts that are flown."""
        return self._flights.count

    def dangerous(self, weights: Weights, starts: Any) -> Any:
        """Return those of `starts` (count, 24 + n), own units, whose rods come nearest to an arm under `weights`."""
        self._flights.fly(weights, starts)
        near = self._flights.costs[:, :, 2].max(axis=0).ravel()
        return starts[np.argsort(-near, kind="stable")[: self._kept]]
