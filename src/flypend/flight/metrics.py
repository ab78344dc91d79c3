"""Success, settling, cost and recoveries of a flight; and confidence intervals of success rates."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np

from flypend import errors
from flypend.flight.criterion import PARTS, Criterion, lean
from flypend.geometry import Numbers, norm
from flypend.model import State, Vehicle
from flypend.model.outline import extent
from flypend.model.state import convert_packed

Trajectory = Any  # flypend.Trajectory, not imported: its module judges runs for the replay

# Tolerance for roundoff in times, s.
SAME = 1e-9


@errors.named_arguments
@dataclass(frozen=True)
class Metrics:
    """Metrics of one flight against its criterion, by default inverted hover at the reference.

    A trajectory is judged at its samples, and so are flights of an ensemble in a sampled plant; means over time follow
    the trapezoidal rule. A flight that ends early is judged at its last state as well. In the ideal plant an ensemble
    takes forces from the steps of the integration. The largest is that of all stages, so peaks between samples count;
    the mean uses the weights of the method. The excursion is taken at the samples, as accurately as the integration.

    Parameters
    ----------
    success : bool
        Whether the criterion holds. By default: rod and thrust axis within 0.05 of upright (plus the lean that a moving
        reference requires) and the pivot within 0.2 m of its reference, for the last second.
    settling : float
        Time from which the tolerances hold to the end, s; NaN for a failure.
    excursion : float
        Largest distance of the pivot from its reference, m.
    effort : float
        Root mean square over time of the rotor forces, relative to each rotor's share of the weight.
    peak_force : float
        Largest rotor force, N.
    end : float
        End time, s.
    clearance : float
        Smallest distance of the rod to what its mount lets it touch, m; infinite on a gimbal.
    lowest : float
        Height of the lowest point of hub, rod and rotor discs, m, upward from the origin; NaN in an ensemble through
        the ideal plant, as are the next three.
    box_x, box_y, box_z : float
        Sizes of the box, along the axes of the world, that holds the machine throughout, m; see `model.outline`.
    cause : str
        Cause of failure: "diverged", "singular" or "collided", else the first of "rod", "axis", "position" out of
        tolerance during the last `Criterion.hold` seconds. Empty for a success.
    """

    success: bool
    settling: float
    excursion: float
    effort: float
    peak_force: float
    end: float
    clearance: float
    lowest: float
    box_x: float
    box_y: float
    box_z: float
    cause: str


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
def metrics(run: Trajectory, criterion: Criterion | None = None) -> Metrics:
    """Return the metrics of `run` by `criterion` (default `Criterion()`: inverted), judged at its samples.

    Raises InputError if a completed run has no sample as late as the criterion looks.
    """
    errors.check_kind("run", run, "Trajectory")
    criterion = criterion or Criterion()
    latest = max(run.outcome.time - criterion.hold, 0.0)
    if run.outcome.status == "completed" and run.t[-1] < latest - SAME:
        raise errors.InputError("times", f"samples beyond {latest:g} s, to judge the run", f"{run.t[-1]:g} s at most")
    distance = norm(run.x - run.x_ref)
    excess = _excess(run, criterion)
    out = [~(part <= 0) for part in excess]
    reductions = [_since(run.t, np.any(out, axis=0)), *(_last(run.t, bad) for bad in out)]
    forces = run.rotor_forces
    low, high = extent(State.trusted(convert_packed(run.packed, run.e3)), run.vehicle)
    values = [
        *reductions, np.max(distance), _mean(run.t, np.mean(forces**2, axis=1)), np.max(forces),
        *np.max(high, axis=0), *np.max(-low, axis=0),
    ]  # fmt: skip
    columns = judge(
        np.array([values]), [run.outcome.status], np.array([run.outcome.time]), run.vehicle, criterion,
        clearance=np.array([np.min(run.clearance)]),
    )  # fmt: skip
    return Metrics(**{name: column[0].item() for name, column in columns.items()})


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


def worst_excess(run: Trajectory, criterion: Criterion) -> Any:
    """Return by how much the samples of `run` exceed `criterion` in their worst part (n,); at most 0 within."""
    return np.max(_excess(run, criterion), axis=0)


def _excess(run: Trajectory, criterion: Criterion) -> Any:
    return criterion.excess(run.y, run.z, norm(run.x - run.x_ref), _lean(run), run.e3)


def judge(
    reductions: Numbers,
    status: Numbers,
    end: Numbers,
    vehicle: Vehicle,
    criterion: Criterion,
    clearance: Numbers = None,
) -> dict[str, Any]:
    """Return the fields of `Metrics` as arrays (n,), from the reductions of n runs.

    Parameters
    ----------
    reductions : (n, 7) or (n, 13)
        See `criterion.REDUCTIONS`, and `EXTENTS` for the last six.
    status : (n,)
        "completed", "diverged", "singular" or "collided".
    end : (n,)
        End time of each run, s.
    vehicle, criterion
        Vehicle parameters, and success criterion.
    clearance : (n,), optional
        Least distance of the rod to what it can touch, m; default infinite.
    """
    since, last, excursion, square, peak = (
        reductions[:, 0], reductions[:, 1:4], reductions[:, 4], reductions[:, 5], reductions[:, 6]
    )  # fmt: skip
    extents = reductions[:, 7:] if reductions.shape[1] > 7 else np.full((len(end), 6), np.nan)
    room = {"lowest": -extents[:, 5]} | {f"box_{'xyz'[i]}": extents[:, i] + extents[:, 3 + i] for i in range(3)}
    status = np.asarray(status)
    late = (last >= 0) & (last >= (end - criterion.hold - SAME)[:, None])
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
        "clearance": np.full(len(end), np.inf) if clearance is None else clearance,
        # NaN in one form, since Zarr restores no other where nothing else is in a chunk.
        **{name: np.where(np.isnan(values), np.nan, values) for name, values in room.items()},
        "cause": np.where(success, "", cause),
    }


def _lean(run: Trajectory) -> Numbers:
    """Return the lean that the reference of `run` requires; 0 in hover."""
    if len(run.t) < 3 or not np.any(run.x_ref != run.x_ref[0]):
        return 0.0
    velocity = np.gradient(run.x_ref, run.t, axis=0, edge_order=2)
    acceleration = np.gradient(velocity, run.t, axis=0, edge_order=2)
    return lean(acceleration, run.vehicle.g, run.e3)


def _last(t: Numbers, bad: Numbers) -> float:
    """Return the last time at which `bad` is true; −1 if never."""
    found = np.flatnonzero(bad)
    return float(t[found[-1]]) if len(found) else -1.0


def _since(t: Numbers, bad: Numbers) -> float:
    """Return the first time after the last `bad` one; inf if that is the last sample."""
    found = np.flatnonzero(bad)
    place = found[-1] + 1 if len(found) else 0
    return float(t[place]) if place < len(t) else float("inf")


def _mean(t: Numbers, values: Numbers) -> float:
    """Return the mean of `values` (n,) over the times `t` (n,) by the trapezoidal rule; of one sample, its value."""
    if t[-1] <= t[0]:
        return float(values[-1])
    return float(np.sum(np.diff(t) * (values[1:] + values[:-1])) / (2 * (t[-1] - t[0])))


def wilson_bounds(successes: Any, runs: Any, confidence: float = 0.95) -> tuple[Numbers, Numbers]:
    """Return Wilson intervals (n,) of `successes` (n,) out of `runs` (n,) at `confidence`; 0 to 1 for no runs."""
    n, z = np.maximum(runs, 1), NormalDist().inv_cdf((1 + confidence) / 2)
    share = np.asarray(successes) / n
    middle = (share + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z / (1 + z**2 / n) * np.sqrt(share * (1 - share) / n + z**2 / (4 * n**2))
    none = np.asarray(runs) == 0  # ends at exactly 0 and 1, despite roundoff
    return np.where(none | (share == 0), 0.0, middle - half), np.where(none | (share == 1), 1.0, middle + half)


def wilson(successes: int, runs: int, confidence: float = 0.95) -> tuple[float, float]:
    """Return the Wilson interval of a success rate, `successes` out of `runs`, at `confidence`."""
    low, high = wilson_bounds(int(successes), int(runs), confidence)
    return float(low), float(high)


class Count(NamedTuple):
    """How many flights succeed.

    Parameters
    ----------
    successes, runs
        Flights that succeed, and all.
    shares
        Those of each vehicle, where several share the flights.
    """

    successes: int
    runs: int
    shares: tuple[Count, ...] = ()

    @property
    def rate(self) -> float:
        """Share of the flights that succeed."""
        return self.successes / self.runs

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson interval of the rate, 95 %; with `shares`, that for vehicles like these, each one a cluster."""
        if len(self.shares) > 1:
            return interval_over_clusters([one.successes for one in self.shares], [one.runs for one in self.shares])
        return wilson(self.successes, self.runs)

    @classmethod
    def together(cls, shares: Iterable[Count]) -> Count:
        """Return the count of all `shares`, one for each vehicle."""
        found = tuple(shares)
        return cls(sum(one.successes for one in found), sum(one.runs for one in found), found)

    def to_dict(self) -> dict[str, int]:
        """Return successes and runs by name."""
        return {"successes": self.successes, "runs": self.runs}

    def describe(self) -> str:
        """Return "48 of 50 (86.5 to 98.9 %)", with the `interval`."""
        low, high = self.interval
        return f"{self.successes} of {self.runs} ({100 * low:.1f} to {100 * high:.1f} %)"


def interval_over_clusters(successes: Any, runs: Any, confidence: float = 0.95) -> tuple[float, float]:
    """Return the interval, at `confidence`, of a rate of `successes` out of `runs`, both (n,): those of each cluster.

    Runs from one start, or with one drawn vehicle, depend on each other: they are a cluster. The variance of the rate
    over clusters (Cochran 1977, Sampling Techniques, ch. 9A) says how many independent runs would have it; the interval
    is Wilson's for that number (Korn and Graubard 1998, Survey Methodology 24, 193-201). They are no fewer than the
    clusters, and no more than the runs. With one run per cluster this is `wilson`. Where few clusters fail nearly
    always, and others hardly ever, a handful holds the rate of all less often than at `confidence`.
    """
    flown = np.asarray(runs, dtype=float)
    clusters, total = int(np.count_nonzero(flown)), float(np.sum(flown))
    rate = float(np.sum(successes)) / max(total, 1.0)
    spread = float(np.sum((successes - rate * flown) ** 2)) * clusters
    known = rate * (1 - rate) * (clusters - 1) * total**2
    # Few clusters know their variance badly: the quantile z of Wilson's interval stands for Student's t of so many
    # degrees of freedom, here by its expansion (Abramowitz and Stegun 26.7.5).
    z, freedom = NormalDist().inv_cdf((1 + confidence) / 2), max(clusters - 1, 1)
    student = z + (z**3 + z) / (4 * freedom) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * freedom**2)
    known *= (z / student) ** 2
    size = min(max(known / spread, clusters), total) if spread > 0 else total if known > 0 else clusters
    low, high = wilson_bounds(rate * size, size, confidence)
    return float(low), float(high)
