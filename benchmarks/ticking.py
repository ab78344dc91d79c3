"""Flights tick by tick beside a firmware."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable


class Ticking(ABC):
    """What flies in ticks of `period` seconds."""

    period: float

    @abstractmethod
    def tick(self) -> None:
        """One period."""

    def fly(self, duration: float, until: Callable[[], bool] = lambda: False) -> bool:
        """Fly for `duration` (s), or `until` something; whether that came."""
        for _ in range(round(duration / self.period)):
            if until():
                return True
            self.tick()
        return until()
