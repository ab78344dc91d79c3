"""Which command acts when: the same in every control period of a flight, so it is worked out once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flypend.plants.plant import Plant

# Times closer than this are one, s.
SAME = 1e-9
PLANT_STEP = 1e-3  # s, of the Runge-Kutta method: a rotor lags 20 times as long


class Segment(NamedTuple):
    """A while of `duration` (s) under the command computed `age` control periods ago."""

    age: int
    duration: float


def within_period(latency: float, period: float) -> tuple[Segment, ...]:
    """What acts during a control period (s), from its beginning, if commands act `latency` s after their measurement.

    The command computed at that beginning has age 0.
    """
    whole, rest = _split(latency, period)
    if rest > 0:
        return (Segment(whole + 1, rest), Segment(whole, period - rest))
    return (Segment(whole, period),)


def ahead(latency: float, period: float) -> tuple[Segment, ...]:
    """What acts from a measurement until its own command does, `latency` s later."""
    whole, rest = _split(latency, period)
    before = (Segment(whole + 1, rest),) if rest > 0 else ()
    return (*before, *(Segment(age, period) for age in range(whole, 0, -1)))


def _split(latency: float, period: float) -> tuple[int, float]:
    whole = int(np.floor((latency + SAME) / period))
    rest = latency - whole * period
    return whole, rest if rest > SAME else 0.0


def steps_in(duration: float, plant: Plant, longest: float | None = None) -> int:
    """Number of equal steps of an engine in `duration` (s), none longer than `longest` (s).

    Default is the step of the rate loop, or that of the equations; MuJoCo divides a step by itself.
    """
    if longest is None:
        own = duration if plant.engine == "mujoco" else PLANT_STEP
        longest = 1 / plant.rate_loop_rate if plant.interface == "rates" else own
    return max(1, int(np.ceil(duration / longest - SAME)))
