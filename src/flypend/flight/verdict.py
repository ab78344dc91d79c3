"""How a flight ended, in one line for a page: by the criterion that the studies use, or as a plan says."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.flight.criterion import Criterion
from flypend.flight.metrics import metrics, worst_excess
from flypend.flight.touch import part_of
from flypend.model.state import E3Direction

POSE = "upright"
HANGS = "rod hangs"
MISSED = {"rod": "rod not settled", "axis": "vehicle not level", "position": "off its reference"}
STATES = ("done", "recovering", "failed")

Run = Any  # flypend.Trajectory, not imported: its module imports this one


def goal(e3: E3Direction) -> Criterion:
    """Return the goal of a law: inverted at the reference if `e3` is up, else y → e₃ at any position."""
    return Criterion() if e3 == "up" else Criterion(target="e3", position=np.inf)


def verdict(run: Run) -> dict[str, Any]:
    """Judge `run` by the `goal` of its frame; a plan tells its own verdict.

    Returns
    -------
    dict
        `words`, one line; `good`, whether it succeeded; `state`, one of `STATES`: "done" where the rod stands at the
        reference, "recovering" where the goal was reached but the vehicle falls, as under laws that let the rod hang;
        `settling` (s) and `excursion` (m), or None; `reason` why a run ended early, or ""; `part`, what the rod of a
        collided run touched, or None; `excess` (n,), by how much the samples exceed the tolerances, at most 0 within;
        `hold` (s), for how long the tolerances have to hold.
    """
    criterion = goal(run.e3)
    judged = metrics(run, criterion)
    good = bool(judged.success)
    part = part_of(run.vehicle, run.outcome.reason)
    distance = f"excursion {_round(judged.excursion)} m" if run.e3 == "up" else fall(run)
    if run.planned is not None:  # and ends once it has arrived
        words, good = run.planned
    elif run.outcome.status != "completed":
        time = run.outcome.time
        words = f"{run.outcome.status} {f'after {time:.3g} s' if time > 0 else 'at the start'}"
        if part is not None:
            words += f", {run.outcome.reason}"
    elif not good:
        words = f"{MISSED.get(judged.cause, judged.cause)} during the last second, {distance}"
    else:
        words = f"{POSE if run.e3 == 'up' else HANGS} after {judged.settling:.1f} s, {distance}"
    return {
        "words": words,
        "good": good,
        "state": STATES[2] if not good else STATES[0] if run.e3 == "up" else STATES[1],
        "settling": judged.settling if judged.success else None,
        "excursion": judged.excursion if np.isfinite(judged.excursion) else None,
        "reason": run.outcome.reason,
        "part": part,
        "excess": worst_excess(run, criterion),
        "hold": criterion.hold,
    }


def fall(run: Run) -> str:
    """Return in words how far the vehicle of `run`, in a frame with e₃ along gravity, fell or rose."""
    metres = float(run.x[-1, 2] - run.x[0, 2])
    return f"vehicle {'fell' if metres >= 0 else 'rose'} {_round(abs(metres))} m"


def _round(metres: float) -> str:
    return f"{float(f'{round(metres, 2):.3g}'):g}"
