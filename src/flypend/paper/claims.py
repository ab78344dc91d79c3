"""The claims of Theorem 1, each checked on a run: a value beside the value that it should have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend.flight.trajectory import Trajectory
from flypend.geometry import norm
from flypend.model import equations_of_motion

# Seconds, long enough for the rod to come to rest, so that the limit of ẍ can be read.
SETTLED = 30.0


@dataclass(frozen=True)
class Verdict:
    """One claim on one run.

    Parameters
    ----------
    claim : str
        What the paper says.
    measured : str
        The name of the number below, with its unit.
    value : float
        What came out.
    criterion : str
        What it should be.
    holds : bool
        Whether value meets criterion, on a run that exists to its end.
    """

    claim: str
    measured: str
    value: float
    criterion: str
    holds: bool


def pivot_acceleration(run: Trajectory) -> Any:
    """ẍ (n, 3) along `run`, m/s², from the equations of motion."""
    return equations_of_motion(run.states, run.wrench, run.vehicle, run.e3).x_ddot


def largest_rise(values: Any) -> float:
    """Largest rise of a sequence `values` (n,) above its own running minimum; 0 if it never increases."""
    values = np.asarray(values)
    return float(np.max(values - np.minimum.accumulate(values)))


def upright_since(run: Trajectory, threshold: float = 0.99) -> float:
    """Time, s, after which y₃ of `run` stays above `threshold`; NaN if it is below at the end."""
    below = np.flatnonzero(run.y[:, 2] < threshold)
    if not len(below):
        return 0.0
    return float(run.t[below[-1] + 1]) if below[-1] + 1 < len(run.t) else float("nan")


def _claim(
    run: Trajectory, claim: str, measured: str, value: float, bound: float, above: bool, why: str = ""
) -> Verdict:
    met = value >= bound if above else value <= bound
    return Verdict(
        claim=claim,
        measured=measured,
        value=float(value),
        criterion=f"{'≥' if above else '≤'} {bound:g}{f' ({why})' if why else ''}",
        holds=bool(met and run.outcome.status == "completed"),
    )


def _rod(run: Trajectory, _: Trajectory) -> Verdict:
    return _claim(run, "y → e₃", f"y₃ at {run.t[-1]:.4g} s", run.y[-1, 2], 0.998, above=True)


def _thrust_axis(run: Trajectory, _: Trajectory) -> Verdict:
    return _claim(run, "z → e₃", f"z₃ at {run.t[-1]:.4g} s", run.z[-1, 2], 0.9999, above=True)


def _lyapunov(run: Trajectory, _: Trajectory) -> Verdict:
    rise = largest_rise(run.signals["V"]) / (run.signals["V"][0] or 1.0)  # 0/0 for a run that starts at its goal
    return _claim(run, "V falls", "largest rise of V over V(0) at the samples", rise, 1e-6, above=False)


def _zero_dynamics(run: Trajectory, settled: Trajectory) -> Verdict:
    value = norm(pivot_acceleration(settled)[-1])
    measured = f"|ẍ| in m/s² at {settled.t[-1]:.4g} s"
    return _claim(run, "ẍ → 0", measured, value, 0.1, above=False, why="the speed floor leaves g s/(1+s)")


def _thrust(run: Trajectory, _: Trajectory) -> Verdict:
    value = np.max(np.abs(run.thrust)) / run.vehicle.weight
    return _claim(run, "f bounded", "largest |f| over (M+m)g", value, 2.0, above=False)


CLAIMS: tuple[Callable[[Trajectory, Trajectory], Verdict], ...] = (
    _rod,
    _thrust_axis,
    _lyapunov,
    _zero_dynamics,
    _thrust,
)


def theorem_claims(run: Trajectory, settled: Trajectory | None = None) -> list[Verdict]:
    """Verdict on each claim of Theorem 1 for a `run` of one of its laws.

    `settled` is the same flight over a longer time, on which the limit ẍ → 0 is read; default `run` itself.
    """
    with np.errstate(all="ignore"):  # a run that diverged may hold numbers without bound, which meet no criterion
        return [claim(run, settled or run) for claim in CLAIMS]
