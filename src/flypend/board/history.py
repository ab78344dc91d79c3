"""What an estimator remembers of the last control periods, to place readings that arrive late.

It remembers the motion relative to now, which corrections of the estimate leave alone to first order: a reading of age
a is compared with x − a ẋ + W(a), W(a) = ∫ (τ − s) ẍ dτ over the a seconds since its instant s, and a correction of x
and ẋ moves that by δx − a δẋ. Attitude is remembered as Gᵀ R, with G the product of all corrections (world frame): the
attitude then, as known now, is G times what is remembered. Between ticks the memory is linear in time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from flypend.plants.sensors import Sensors
from flypend.plants.timing import timing

# Numbers per tick of each quantity, and the streams that are compared with it. "x" and "y" are W of pivot and rod,
# "turning" is ω and "swinging" ẏ less their present values, "attitude" is Gᵀ R by rows, and "force" the specific force
# expected of the accelerometer at that tick.
QUANTITIES: Mapping[str, tuple[int, tuple[str, ...]]] = {
    "x": (3, ("position",)),
    "y": (3, ("rod", "joints", "rod_gyro")),
    "turning": (3, ("gyro",)),
    "swinging": (3, ("rod_gyro",)),
    "attitude": (9, ("attitude", "joints", "rod_gyro")),
    "force": (3, ("accelerometer",)),
}


@dataclass(frozen=True)
class History:
    """Layout of the memory of the past of an estimator.

    Parameters
    ----------
    depths : dict of int
        Number of past ticks that each of QUANTITIES is remembered for.
    period : float
        Control period, s.
    """

    depths: Mapping[str, int]
    period: float

    @classmethod
    def of(cls, sensors: Sensors, period: float) -> History:
        """Return the history that the latest readings of `sensors` need at a control `period` (s)."""
        depth = {name: timing(sensor, period).depth for name, sensor in sensors.streams.items()}
        found = {name: max(depth.get(stream, 0) for stream in streams) for name, (_, streams) in QUANTITIES.items()}
        found["force"] += "accelerometer" in depth  # that of the period that has just ended
        return cls(found, period)

    def oldest(self, stream: str) -> float:
        """Return the age (s) up to which readings of `stream` can be placed, with half a period to spare."""
        depths = [depth for name, depth in self.depths.items() if stream in QUANTITIES[name][1]]
        return (min(depths) + 0.5) * self.period

    @property
    def size(self) -> int:
        """Length of the memory."""
        return sum(QUANTITIES[name][0] * depth for name, depth in self.depths.items())

    def split(self, memory: Any) -> dict[str, list[Any]]:
        """Return the entries of each quantity, newest first, of a `memory`."""
        found, place = {}, 0
        for name, depth in self.depths.items():
            width = QUANTITIES[name][0]
            found[name] = [memory[place + i * width : place + (i + 1) * width] for i in range(depth)]
            place += depth * width
        return found

    def joined(self, entries: Mapping[str, Sequence[Any]]) -> Any:
        """Return the memory of `entries`, of which the oldest are dropped."""
        return ca.vertcat(*(ca.vertcat(*entries[name][:depth]) for name, depth in self.depths.items() if depth))

    def begun(self, attitude: Any, force: Any) -> Any:
        """Return the memory at rest in `attitude` (9,) by rows under a specific `force` (3,), body frame, m/s²."""
        still = {"attitude": attitude, "force": force}
        return self.joined(
            {name: [still.get(name, np.zeros(QUANTITIES[name][0]))] * depth for name, depth in self.depths.items()}
        )

    def at(self, entries: Sequence[Any], now: Any, age: Any) -> Any:
        """Return a quantity `age` seconds ago, from its `now` and its `entries`."""
        ticks, found = age / self.period, 0.0
        for i, entry in enumerate([now, *entries]):
            weight = ca.fmax(0, 1 - ca.fabs(ticks - i)) if entries else 1
            found = found + weight * entry
        return found

    def moved(self, entries: Sequence[Any], begin: Any, begin_rate: Any, end: Any, end_rate: Any) -> list[Any]:
        """Return the entries of W after a period in which a quantity went from `begin` to `end`, with those rates."""
        gained = begin - end + self.period * end_rate
        change = self.period * (end_rate - begin_rate)
        return [gained, *(entry + gained + (i + 1) * change for i, entry in enumerate(entries))]

    def shifted(self, entries: Sequence[Any], begin: Any, end: Any) -> list[Any]:
        """Return the entries of a rate, less its present value, after a period in which it changed so."""
        change = begin - end
        return [change, *(entry + change for entry in entries)]
