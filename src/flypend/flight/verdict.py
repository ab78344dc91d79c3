"""How a flight ended, in one line for a page: by the criterion that the studies use."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.flight.criterion import Criterion
from flypend.flight.metrics import metrics
from flypend.flight.touch import touched_part
from flypend.model.state import E3Direction

POSES = {"up": "upright", "down": "rod along e₃, which hangs,"}
MISSED = {"rod": "rod not settled", "axis": "vehicle not level", "position": "off its reference"}

Run = Any  # flypend.Trajectory, not imported: its module imports this one


def goal(e3: E3Direction) -> Criterion:
    """Return the goal of a law: inverted at the reference if `e3` is up, else y → e₃ at any position."""
    return Criterion() if e3 == "up" else Criterion(target="e3", position=np.inf)


def verdict(run: Run, criterion: Criterion | None = None) -> dict[str, Any]:
    """Judge `run` by `criterion`, by default the `goal` of its frame.

    Returns
    -------
    dict
        `words`, one line; `good`, whether it succeeded; `settling` (s) and `excursion` (m), or None; `reason` why a run
        ended early, or ""; `part`, what the rod of a collided run touched, or None.
    """
    judged = metrics(run, criterion or goal(run.e3))
    part = touched_part(run.vehicle, run.outcome.reason)
    distance = f"excursion {round(judged.excursion, 2):.3g} m"
    if run.outcome.status != "completed":
        words = f"{run.outcome.status} after {run.outcome.time:.3g} s"
        if part is not None:
            words += f", {run.outcome.reason}"
    elif judged.success:
        words = f"{POSES[run.e3]} after {judged.settling:.1f} s, {distance}"
    else:
        words = f"{MISSED.get(judged.cause, judged.cause)} during the last second, {distance}"
    return {
        "words": words,
        "good": bool(judged.success),
        "settling": judged.settling if judged.success else None,
        "excursion": judged.excursion if np.isfinite(judged.excursion) else None,
        "reason": run.outcome.reason,
        "part": part,
    }
