"""When commands act and readings arrive, by control periods. All periods of a flight share one schedule."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from flypend.plants.plant import Plant
from flypend.plants.sensors import Sensor

# Times closer than this are considered equal, s; those of readings closer than this share of a control period.
SAME, SAME_SHARE = 1e-9, 1e-6
# Readings from which the oldest is found: more than any common multiple of rates in use.
READINGS = 2000
# Longest step of the equations, s. Against steps of 0.1 ms a flight of hehn2011 is off by 2e-8 after 2 s in the median,
# by 2e-6 at most.
PLANT_STEP = 2e-3


class Segment(NamedTuple):
    """An interval of `duration` (s) during which the command computed `age` control periods ago is applied."""

    age: int
    duration: float


def segments_within(latency: float, period: float) -> tuple[Segment, ...]:
    """Segments of one control `period` (s), in order, for commands applied `latency` (s) after their measurement.

    The command computed at the start of the period has age 0.
    """
    whole, rest = _split(latency, period)
    if rest > 0:
        return (Segment(whole + 1, rest), Segment(whole, period - rest))
    return (Segment(whole, period),)


def segments_ahead(latency: float, period: float) -> tuple[Segment, ...]:
    """Segments from a measurement until its own command is applied, `latency` (s) later; `period` in s."""
    whole, rest = _split(latency, period)
    before = (Segment(whole + 1, rest),) if rest > 0 else ()
    return (*before, *(Segment(age, period) for age in range(whole, 0, -1)))


def _split(latency: float, period: float) -> tuple[int, float]:
    whole = int(np.floor((latency + SAME) / period))
    rest = latency - whole * period
    return whole, rest if rest > SAME else 0.0


def steps_in(duration: float, plant: Plant, longest: float | None = None) -> int:
    """Number of equal engine steps in `duration` (s), none longer than `longest` (s).

    The default is the period of the rate loop, or else the step of the equations. MuJoCo substeps internally.
    """
    if longest is None:
        inside = plant.engine == "mujoco" and plant.interface != "rates"
        longest = duration if inside else longest_step(plant)
    return fewest_steps(duration, longest)


def fewest_steps(duration: float, longest: float) -> int:
    """Return the fewest equal steps, at least one, in `duration`, none longer than `longest` (s), up to roundoff."""
    return max(1, int(np.ceil(duration / longest - SAME)))


def longest_step(plant: Plant) -> float:
    """Return the longest step of the equations through `plant`, s: the period of the rate loop, if there is one."""
    return 1 / plant.rate_loop_rate if plant.interface == "rates" else PLANT_STEP


def in_steps(segments: Sequence[Segment], longest: float) -> list[tuple[Segment, ...]]:
    """Divide consecutive `segments` among as few steps as possible, about equal and of about `longest` (s) at most.

    A step may span several segments; a segment longer than `longest` is divided into equal parts.
    """
    parts: list[Segment] = []
    for age, duration in segments:
        count = fewest_steps(duration, longest)
        parts += [Segment(age, duration / count)] * count
    whole = sum(part.duration for part in parts)
    count = fewest_steps(whole, longest)
    steps: dict[int, list[Segment]] = {}
    begin = 0.0
    for part in parts:
        middle = begin + part.duration / 2
        steps.setdefault(int(middle / whole * count), []).append(part)
        begin += part.duration
    return [tuple(step) for step in steps.values()]


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
        return int(np.ceil(self.oldest - SAME_SHARE))


def timing(sensor: Sensor, period: float) -> Timing:
    """Return the timing of `sensor` for a control `period`, s."""
    per_tick = sensor.rate * period
    every = per_tick >= 1 - SAME_SHARE and abs(per_tick - round(per_tick)) < SAME_SHARE
    late = sensor.latency / period
    whole = int(np.floor(late + SAME_SHARE))
    rest = late - whole if late - whole > SAME_SHARE else 0.0
    taken = np.arange(READINGS) / per_tick
    ages = np.ceil(taken + late - SAME_SHARE) - taken
    oldest = float(late if every and rest == 0 else min(np.max(ages), late + 1))
    return Timing(every, whole, rest, oldest)
