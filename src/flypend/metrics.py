"""Whether a flight succeeded, how soon and at what cost; and how sure a success rate is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import binomtest

from flypend.geometry import E3, norm
from flypend.trajectory import Trajectory

# Success: |y − e₃| and |z − e₃| (e₃ up), and |x − x_ref| in m, below these during the last second.
ROD_TOLERANCE, AXIS_TOLERANCE, POSITION_TOLERANCE, HOLD = 0.05, 0.05, 0.2, 1.0


@dataclass(frozen=True)
class Metrics:
    """One flight, judged by what it should do: stand inverted at its reference.

    Parameters
    ----------
    success : bool
        Rod and thrust axis within 0.05 of upright (more by the lean that a moving reference takes) and the pivot within
        0.2 m of its reference, for the last second.
    settling : float
        Time after which all that holds to the end, s; NaN if it does not.
    excursion : float
        Largest distance of the pivot from its reference, m.
    effort : float
        Root mean square of the rotor forces over their share of the weight.
    peak_force : float
        Largest force of a rotor, N.
    end : float
        When the flight ended, s.
    cause : str
        Of a failure: "diverged" or "singular", else what was out of tolerance during the last second: the first of
        "rod", "axis", "position". Empty for a success.
    """

    success: bool
    settling: float
    excursion: float
    effort: float
    peak_force: float
    end: float
    cause: str


def metrics(run: Trajectory) -> Metrics:
    """Metrics of `run`; a run in the frame with e₃ down is turned up first."""
    run = run if run.e3 == "up" else run.flipped()
    distance = norm(run.x - run.x_ref)
    lean = _lean(run)
    within = {
        "rod": norm(run.y - E3) < ROD_TOLERANCE + lean,
        "axis": norm(run.z - E3) < AXIS_TOLERANCE + lean,
        "position": distance < POSITION_TOLERANCE,
    }
    good = np.logical_and.reduce(list(within.values()))
    completed = run.outcome.status == "completed"
    last = run.t >= run.t[-1] - HOLD - 1e-9
    success = bool(completed and np.all(good[last]))
    out = [name for name, inside in within.items() if not np.all(inside[last])]
    share = run.vehicle.weight / run.rotor_forces.shape[1]
    return Metrics(
        success=success,
        settling=_settled_since(run.t, good) if success else float("nan"),
        excursion=float(np.max(distance)),
        effort=float(np.sqrt(np.mean(run.rotor_forces**2)) / share),
        peak_force=float(np.max(run.rotor_forces)),
        end=float(run.outcome.time),
        cause="" if success else out[0] if completed else run.outcome.status,
    )


def _lean(run: Trajectory) -> Any:
    """How far one leans who follows the reference: |d − e₃|, d being the direction of ẍ_ref + g e₃; 0 in hover.

    On a circle rod and axis lean a little less, since the bob goes round on a smaller one than the pivot. No level
    reference allows as much as √2, so a rod that hangs is never let pass.
    """
    if len(run.t) < 3 or not np.any(run.x_ref != run.x_ref[0]):
        return 0.0
    velocity = np.gradient(run.x_ref, run.t, axis=0, edge_order=2)
    a_1, a_2, a_3 = np.gradient(velocity, run.t, axis=0, edge_order=2).T
    return 2 * np.sin(np.arctan2(np.hypot(a_1, a_2), run.vehicle.g + a_3) / 2)


def wilson(successes: int, runs: int, confidence: float = 0.95) -> tuple[float, float]:
    """Wilson interval of a success rate: `successes` out of `runs`, at `confidence`."""
    interval = binomtest(int(successes), int(runs)).proportion_ci(confidence, method="wilson")
    return float(interval.low), float(interval.high)


def _settled_since(t: Any, good: Any) -> float:
    bad = np.flatnonzero(~good)
    return float(t[0] if not len(bad) else t[bad[-1] + 1])
