"""Recoveries of a flight: each time that it leaves the tolerances of its criterion, and how it comes back."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend import errors
from flypend.flight.criterion import Criterion
from flypend.flight.metrics import SAME, worst_excess
from flypend.geometry import norm

Trajectory = Any  # flypend.Trajectory, not imported: its module judges runs for the replay


@errors.named_arguments
@dataclass(frozen=True)
class Recovery:
    """A stretch of a flight outside the tolerances of a criterion, until they hold again for `Criterion.hold` seconds.

    Parameters
    ----------
    begin : float
        First time outside the tolerances, s.
    time : float
        Time from `begin` until the tolerances hold again, s; NaN where the flight ends before they have held.
    distance : float
        Largest distance of the pivot from its reference, among samples outside the tolerances, m.
    height_lost : float
        Largest drop of the pivot below its height at `begin`, along gravity, among the same samples, m; at least 0.
    """

    begin: float
    time: float
    distance: float
    height_lost: float


@errors.named_arguments
def recoveries(run: Trajectory, criterion: Criterion | None = None) -> list[Recovery]:
    """Return the recoveries of `run`, by `criterion` (default `Criterion()`: inverted), judged at its samples.

    If a flight starts outside the tolerances, its first recovery begins at 0 s. If there is no other, the time of that
    recovery is `Metrics.settling`. Its distance is `Metrics.excursion`, unless the vehicle strays farther within the
    tolerances.
    """
    errors.check_kind("run", run, "Trajectory")
    criterion = criterion or Criterion()
    t, outside = run.t, np.flatnonzero(~(worst_excess(run, criterion) <= 0))
    distance, height = norm(run.x - run.x_ref), run.x[:, 2] * (1.0 if run.e3 == "up" else -1.0)
    # The flight is back between two samples outside if it has been within for longer than the criterion holds.
    back = np.flatnonzero(t[outside[1:] - 1] - t[outside[:-1]] > criterion.hold + SAME)
    found = []
    for part in np.split(outside, back + 1) if len(outside) else ():
        end = part[-1] + 1 if t[-1] - t[part[-1]] > criterion.hold + SAME else None
        begin, time = float(t[part[0]]), math.nan if end is None else float(t[end] - t[part[0]])
        found.append(
            Recovery(begin, time, float(np.max(distance[part])), float(height[part[0]] - np.min(height[part])))
        )
    return found
