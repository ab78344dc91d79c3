"""What the flights of a training have in common."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend.model import Vehicle
from flypend.plants.sensors import Sensors


@dataclass(frozen=True)
class Course:
    """What the flights of a training have in common.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle, with rotors that have a lag.
    period, duration : float
        Control period and length of a flight, s.
    excursion : float
        Weight of the excursion, in rod lengths, in the cost.
    throughout, last : float
        Weights of the distance from hover (see `world.costs`): its mean over the flight, and over its last third.
    arms : float
        Weight of the largest nearness of the rod to an arm, for a vehicle with a hub.
    bands : bool
        Whether machines drawn from the bands of the vehicle fly, and commands are late.
    sensors : Sensors, optional
        Those with whose errors states are seen; default as they are.
    """

    vehicle: Vehicle
    period: float = 0.02
    duration: float = 3.0
    excursion: float = 1.0
    throughout: float = 0.3
    last: float = 2.0
    arms: float = 3.0
    bands: bool = False
    sensors: Sensors | None = None

    @property
    def steps(self) -> int:
        """Control periods of a flight."""
        return round(self.duration / self.period)

    @property
    def weights(self) -> Any:
        """Weights (steps,) of the distance from hover."""
        weights, last = np.full(self.steps, self.throughout / self.steps), self.steps // 3
        weights[-last:] += self.last / last
        return weights
