"""Rotor forces under held commands: a first-order lag, in closed form.

A motion that is integrated over a whole step needs of the forces r(t) within it only the mean and the first moment; the
rest changes its result in a higher order. `Ramp` is the linear force with both, which exists however often the command
changed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import groupby
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Scalar

TIMING_SIZE = 4


class Ramp(NamedTuple):
    """A quantity that changes linearly over a step: its `mean`, and its `change` from beginning to end."""

    mean: Numbers
    change: Numbers

    @property
    def start(self) -> Numbers:
        """Value at the beginning of the step."""
        return self.mean - self.change / 2

    @property
    def end(self) -> Numbers:
        """Value at the end of the step."""
        return self.mean + self.change / 2

    def mix(self, matrix: Numbers) -> Ramp:
        """Return the ramp of `matrix` times the quantity."""
        return Ramp(ca.mtimes(matrix, self.mean), ca.mtimes(matrix, self.change))


@lru_cache(maxsize=256)
def step_timing(lag: float, duration: float) -> Numbers:
    """Numbers (4,) of a step of `duration` h under one command for a `lag` T (s): h, d, and the weights w and v.

    With the initial deviation r₀ − u from the command u, the deviation is d = e^{−h/T} of it at the end, w on average,
    and changes by v in the ramp. Without a lag it decays at once.
    """
    if lag <= 0:
        return np.array([duration, 0.0, 0.0, 0.0])
    end = np.exp(-duration / lag)
    mean = -np.expm1(-duration / lag) * lag / duration
    return np.array([duration, end, mean, _change(1.0, end, mean, lag / duration)])


def symbolic_timing(lag: Scalar, duration: Scalar, exp: Callable[[Any], Any] = ca.exp) -> Numbers:
    """Return `step_timing` (4, 1) of a `lag` > 0 that is a CasADi expression, as may be the `duration`, s."""
    end = exp(-duration / lag)
    mean = (1 - end) * lag / duration
    return ca.vertcat(duration, end, mean, _change(1.0, end, mean, lag / duration))


def hold(rotors: Numbers, command: Numbers, timing: Numbers) -> tuple[Ramp, Numbers]:
    """Return the ramp of the forces `rotors` (n,) over a step under one `command` (n,), N, and their end.

    `timing` is the result of `step_timing`.
    """
    deviation = rotors - command
    ramp = Ramp(command + timing[2] * deviation, timing[3] * deviation)
    return ramp, command + timing[1] * deviation


def join_ramps(first: Ramp, second: Ramp, before: Scalar, after: Scalar) -> Ramp:
    """Return the ramp with mean and first moment of `first`, for `before` seconds, and then `second`, for `after`."""
    whole = before + after
    mean = (before * first.mean + after * second.mean) / whole
    apart = 6 * before * after * (second.mean - first.mean)
    return Ramp(mean, (apart + before**2 * first.change + after**2 * second.change) / whole**2)


def hold_in_turn(
    rotors: Numbers, commands: Sequence[Any], durations: Sequence[float], lag: float
) -> tuple[Ramp, Numbers]:
    """Return the ramp of the forces `rotors` (n,) over a step under several `commands`, oldest first, and their end.

    Integrating T ṙ = u − r over the step, once as it is and once times t, yields mean and first moment of r from those
    of u, whatever the number of commands.

    Parameters
    ----------
    rotors : (n,)
        Forces at the beginning, N.
    commands : sequence of (n,)
        Forces commanded in turn, N.
    durations : sequence of float
        For how long each command is held, s.
    lag : float
        T, s.
    """
    whole, begin, end = sum(durations), 0.0, rotors
    mean, moment = 0.0, 0.0  # of the command: its average, and that of u (t/H − 1/2)
    for duration, together in groupby(zip(durations, commands, strict=True), key=lambda pair: round(pair[0], 12)):
        held_now, share = [command for _, command in together], duration / whole
        count, decay = len(held_now), step_timing(lag, duration)[1]
        total, totals, weighted = (held_now[0],) * 3  # Σ u_j, Σ (n − j) u_j, Σ d^(n−1−j) u_j
        for command in held_now[1:]:
            total = total + command
            totals, weighted = totals + total, command + decay * weighted
        mean = mean + share * total
        moment = moment + share * ((begin + (count + 0.5) * share - 0.5) * total - share * totals)
        end = (1 - decay) * weighted + decay**count * end
        begin += count * share
    ratio = lag / whole
    mean = mean + ratio * (rotors - end)
    return Ramp(mean, 12 * moment + _change(rotors, end, mean, ratio)), end


def _change(start: Numbers, end: Numbers, mean: Numbers, ratio: Scalar) -> Numbers:
    """Return the part of a ramp's change, 12 times the first moment, that the lag adds; `ratio` is T/H."""
    return 12 * ratio * (mean - (start + end) / 2)


def largest_lead(lag: float, period: float) -> float:
    """Return 1/(1 − e^{−h/T}) for a `lag` T and a `period` h, s: more made a rotor overshoot between commands."""
    return float(1 / -np.expm1(-period / max(lag, 1e-9)))
