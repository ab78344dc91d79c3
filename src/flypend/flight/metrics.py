"""Whether a flight succeeded, how soon and at what cost; and how sure a success rate is."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist
from typing import Any

import numpy as np

from flypend.flight.criterion import PARTS, Criterion, lean
from flypend.flight.trajectory import Trajectory
from flypend.geometry import norm
from flypend.model import Vehicle

# Roundoff of times, s.
SAME = 1e-9


@dataclass(frozen=True)
class Metrics:
    """One flight, judged by what it should do: stand inverted at its reference.

    Parameters
    ----------
    success : bool
        Rod and thrust axis within 0.05 of upright (more by the lean that a moving reference takes) and the pivot within
        0.2 m of its reference, for the last second; or whatever else the criterion says.
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


def metrics(run: Trajectory, criterion: Criterion | None = None) -> Metrics:
    """Metrics of `run` by `criterion` (default: inverted, as `Criterion` has it)."""
    criterion = criterion or Criterion()
    distance = norm(run.x - run.x_ref)
    excess = criterion.excess(run.y, run.z, distance, _lean(run), run.e3)
    out = [~(part <= 0) for part in excess]
    reductions = [_since(run.t, np.any(out, axis=0)), *(_last(run.t, bad) for bad in out)]
    forces = run.rotor_forces
    values = [*reductions, np.max(distance), np.mean(forces**2), np.max(forces)]
    columns = judged(np.array([values]), [run.outcome.status], np.array([run.outcome.time]), run.vehicle, criterion)
    return Metrics(**{name: column[0].item() for name, column in columns.items()})


def judged(reductions: Any, status: Any, end: Any, vehicle: Vehicle, criterion: Criterion) -> dict[str, Any]:
    """The fields of `Metrics` as arrays (n,), from what runs were reduced to.

    Parameters
    ----------
    reductions : (n, 7)
        As `criterion.REDUCTIONS` has it.
    status : (n,)
        "completed", "diverged" or "singular".
    end : (n,)
        When each run ended, s.
    vehicle, criterion
        What flew, and what it should do.
    """
    since, last, excursion, square, peak = (
        reductions[:, 0], reductions[:, 1:4], reductions[:, 4], reductions[:, 5], reductions[:, 6]
    )  # fmt: skip
    status = np.asarray(status)
    late = last >= (end - criterion.hold - SAME)[:, None]
    success = (status == "completed") & ~np.any(late, axis=1)
    cause = np.where(status != "completed", status, np.array(PARTS)[np.argmax(late, axis=1)])
    share = vehicle.weight / len(vehicle.rotor_spins)
    return {
        "success": success,
        "settling": np.where(success, since, np.nan),
        "excursion": excursion,
        "effort": np.sqrt(square) / share,
        "peak_force": peak,
        "end": end,
        "cause": np.where(success, "", cause),
    }


def _lean(run: Trajectory) -> Any:
    """The lean that the reference of `run` takes; 0 in hover."""
    if len(run.t) < 3 or not np.any(run.x_ref != run.x_ref[0]):
        return 0.0
    velocity = np.gradient(run.x_ref, run.t, axis=0, edge_order=2)
    acceleration = np.gradient(velocity, run.t, axis=0, edge_order=2)
    return lean(acceleration * (1.0 if run.e3 == "up" else np.array([1.0, -1.0, -1.0])), run.vehicle.g)


def _last(t: Any, bad: Any) -> float:
    """Last time at which `bad`; −1 if never."""
    found = np.flatnonzero(bad)
    return float(t[found[-1]]) if len(found) else -1.0


def _since(t: Any, bad: Any) -> float:
    """First time after the last `bad` one; inf if that is the last of all."""
    found = np.flatnonzero(bad)
    place = found[-1] + 1 if len(found) else 0
    return float(t[place]) if place < len(t) else float("inf")


def wilson_bounds(successes: Any, runs: Any, confidence: float = 0.95) -> tuple[Any, Any]:
    """Wilson intervals (n,) of success rates: `successes` (n,) of `runs` (n,), at `confidence`; 0 to 1 for no runs."""
    n, z = np.maximum(runs, 1), NormalDist().inv_cdf((1 + confidence) / 2)
    share = np.asarray(successes) / n
    middle = (share + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z / (1 + z**2 / n) * np.sqrt(share * (1 - share) / n + z**2 / (4 * n**2))
    none = np.asarray(runs) == 0  # exactly 0 and 1 at the ends, which roundoff would miss
    return np.where(none | (share == 0), 0.0, middle - half), np.where(none | (share == 1), 1.0, middle + half)


def wilson(successes: int, runs: int, confidence: float = 0.95) -> tuple[float, float]:
    """Wilson interval of a success rate: `successes` out of `runs`, at `confidence`."""
    low, high = wilson_bounds(int(successes), int(runs), confidence)
    return float(low), float(high)
