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

from flypend.compile.record import Field, Record
from flypend.geometry import Numbers, Scalar, Vector
from flypend.plants.defects import POSES
from flypend.plants.schedule import timing
from flypend.plants.sensors import Sensors

# Numbers per tick of each quantity, the streams that are compared with it, and what it is. "x" and "y" are W of pivot
# and rod, "turning" is ω and "swinging" ẏ less their present values, "attitude" is Gᵀ R by rows, and "force" the
# specific force expected of the accelerometer at that tick.
QUANTITIES: Mapping[str, tuple[int, tuple[str, ...], str]] = {
    "x": (3, ("position",), "by how much acceleration has moved the pivot since, m"),
    "y": (3, ("rod", "joints", "rod_gyro"), "the same of the rod"),
    "turning": (3, ("gyro",), "omega then less omega now, rad/s"),
    "swinging": (3, ("rod_gyro",), "y_dot then less y_dot now, 1/s"),
    "attitude": (9, ("attitude", "joints", "rod_gyro"), "R then, without the corrections in `turned`, by rows"),
    "force": (3, ("accelerometer",), "specific force expected of the accelerometer, m/s^2"),
}

# How much older than told poses may be, s.
REACH = 0.024


def finds_latency(sensors: Sensors) -> bool:
    """Whether a measured attitude tells, beside the gyroscope, how much older poses of `sensors` are than told."""
    return sensors.attitude is not None


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
        if finds_latency(sensors):
            depth |= {name: depth[name] + int(np.ceil(REACH / period)) for name in POSES if name in depth}
        found = {name: max(depth.get(stream, 0) for stream in streams) for name, (_, streams, _) in QUANTITIES.items()}
        found["force"] += "accelerometer" in depth  # that of the period that has just ended
        return cls(found, period)

    def oldest(self, stream: str) -> float:
        """Return the age (s) up to which readings of `stream` can be placed, with half a period to spare."""
        depths = [depth for name, depth in self.depths.items() if stream in QUANTITIES[name][1]]
        return (min(depths) + 0.5) * self.period

    @property
    def record(self) -> Record:
        """Table of the memory."""
        kinds = ((name, depth, *QUANTITIES[name]) for name, depth in self.depths.items() if depth)
        fields = tuple(Field(name, depth * length, what) for name, depth, length, _, what in kinds)
        return Record("past", "The last control periods, newest first.", fields)

    def split(self, memory: Numbers) -> dict[str, list[Numbers]]:
        """Return the entries of each quantity, newest first, of a `memory`."""
        found: dict[str, list[Any]] = {name: [] for name in self.depths}
        for name, numbers in self.record.split(memory).items():
            found[name] = ca.vertsplit(numbers, QUANTITIES[name][0])
        return found

    def join(self, entries: Mapping[str, Sequence[Any]]) -> Numbers:
        """Return the memory of `entries`, of which the oldest are dropped."""
        return self.record.join({name: ca.vertcat(*some[: self.depths[name]]) for name, some in entries.items()})

    def begin(self, attitude: Numbers, force: Vector) -> Numbers:
        """Return the memory at rest in `attitude` (9,) by rows under a specific `force` (3,), body frame, m/s²."""
        still = {"attitude": attitude, "force": force}
        return self.join(
            {name: [still.get(name, np.zeros(QUANTITIES[name][0]))] * depth for name, depth in self.depths.items()}
        )

    def at(self, entries: Sequence[Any], now: Numbers, age: Scalar) -> Numbers:
        """Return a quantity `age` seconds ago, from its `now` and its `entries`."""
        ticks, found = age / self.period, 0.0
        for i, entry in enumerate([now, *entries]):
            weight = ca.fmax(0, 1 - ca.fabs(ticks - i)) if entries else 1
            found = found + weight * entry
        return found

    def move(
        self, entries: Sequence[Any], begin: Vector, begin_rate: Vector, end: Vector, end_rate: Vector
    ) -> list[Vector]:
        """Return the entries of W after a period in which a quantity went from `begin` to `end`, with those rates."""
        gained = begin - end + self.period * end_rate
        change = self.period * (end_rate - begin_rate)
        return [gained, *(entry + gained + (i + 1) * change for i, entry in enumerate(entries))]

    def shift(self, entries: Sequence[Any], begin: Vector, end: Vector) -> list[Vector]:
        """Return the entries of a rate, less its present value, after a period in which it changed so."""
        change = begin - end
        return [change, *(entry + change for entry in entries)]
