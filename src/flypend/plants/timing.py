"""When readings reach the flight computer, counted in control periods."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flypend.plants.sensors import Sensor

# Times closer than this share of a control period are the same.
SAME = 1e-6
# Readings from which the oldest is found: more than any common multiple of rates in use.
READINGS = 2000


class Timing(NamedTuple):
    """Timing of a stream of readings against control periods.

    Parameters
    ----------
    every : bool
        Whether there is a reading at every control tick, taken at the tick itself.
    whole : int
        Whole control periods in the latency.
    rest : float
        The rest of the latency, as a share of a period; 0 ≤ rest < 1.
    oldest : float
        Greatest age of a reading when it reaches the flight computer, in periods.
    """

    every: bool
    whole: int
    rest: float
    oldest: float

    @property
    def waiting(self) -> int:
        """Number of control ticks whose readings are still to be delivered."""
        return self.whole + (self.rest > 0)

    @property
    def depth(self) -> int:
        """Number of past ticks that an estimator must remember to place a reading."""
        return int(np.ceil(self.oldest - SAME))


def timing(sensor: Sensor, period: float) -> Timing:
    """Return the timing of `sensor` for a control `period`, s."""
    per_tick = sensor.rate * period
    every = per_tick >= 1 - SAME and abs(per_tick - round(per_tick)) < SAME
    late = sensor.latency / period
    whole = int(np.floor(late + SAME))
    rest = late - whole if late - whole > SAME else 0.0
    taken = np.arange(READINGS) / per_tick
    ages = np.ceil(taken + late - SAME) - taken
    oldest = float(late if every and rest == 0 else min(np.max(ages), late + 1))
    return Timing(every, whole, rest, oldest)
