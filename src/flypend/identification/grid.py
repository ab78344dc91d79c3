"""A log on the even grid of the filter: readings of each step averaged, with the age of the pose."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flypend.geometry import Numbers, project_rotation
from flypend.identification.log import Log

STEP = 5e-3  # s; the rotation's fastest change, within the rotors' lag of 20 ms or more, takes four


class Grid(NamedTuple):
    """Readings at even instants `t` (k,), s, of `values` (k, 21) in the order of `model.CHANNELS`.

    The attitude has nine numbers, by rows. `counts` (k, 5) says how many rows each channel had there, `age` (k,) how
    long before the instant poses were taken, s, on average.
    """

    t: Numbers
    values: Numbers
    counts: Numbers
    age: Numbers


def grid_step(log: Log) -> float:
    """Return the step of the grid, s: about `STEP`, of whole rows, so that none is far from its instant."""
    apart = float(np.median(np.diff(log.t)))
    return apart * max(1, int(STEP / apart + 0.2))


def to_grid(log: Log, latency: float) -> Grid:
    """Return `log` on the grid, with poses as old as `latency` (s) when they are written."""
    step, apart = grid_step(log), float(np.median(np.diff(log.t)))
    t = np.arange(log.t[0] + (step - apart) / 2, log.t[-1] + step / 2, step)  # in the middle of the rows of a step
    rows = len(log.t)
    streams = [log.position, log.rotation.reshape(rows, 9), log.gyro, log.force, log.rod]
    values, counts, age = np.zeros((len(t), 21)), np.zeros((len(t), 5)), np.zeros(len(t))
    begin = 0
    for channel, stream in enumerate(streams):
        pose, width = channel in (0, 1, 4), stream.shape[1]
        times = log.t - (latency if pose else 0.0)
        known = np.isfinite(stream).all(axis=1) & (times > t[0] - step / 2) & (times < t[-1] + step / 2)
        at = np.rint((times[known] - t[0]) / step).astype(int)
        counts[:, channel] = np.bincount(at, minlength=len(t))
        share = np.maximum(counts[:, channel], 1)
        for i in range(width):
            values[:, begin + i] = np.bincount(at, stream[known, i], len(t)) / share
        if channel == 0:
            age = np.bincount(at, t[at] - times[known], len(t)) / share
        begin += width
    some = counts[:, 1] > 0
    values[some, 3:12] = project_rotation(values[some, 3:12].reshape(-1, 3, 3)).reshape(-1, 9)
    return Grid(t, values, counts, age)
