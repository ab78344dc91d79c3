"""What is found in the paper: verdicts on the claims of Theorem 1, each on a run, and the record of a defect."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend.flight.trajectory import Trajectory
from flypend.geometry import norm
from flypend.model import equations_of_motion

# Duration, s, after which the rod is at rest, so that the limit of ẍ can be measured.
SETTLED = 30.0


@dataclass(frozen=True)
class Verdict:
    """One claim on one run.

    Parameters
    ----------
    claim : str
        The paper's claim.
    measured : str
        The measured quantity, with its unit.
    value : float
        Its value.
    criterion : str
        The bound on the value.
    holds : bool
        Whether the value meets the criterion and the run is completed.
    """

    claim: str
    measured: str
    value: float
    criterion: str
    holds: bool


def pivot_acceleration(run: Trajectory) -> Any:
    """Return ẍ (n, 3) along `run`, m/s², from the equations of motion."""
    return equations_of_motion(run.states, run.wrench, run.vehicle, run.e3).x_ddot


def largest_rise(values: Any) -> float:
    """Return the largest rise of the sequence `values` (n,) above its running minimum; 0 if it never increases."""
    values = np.asarray(values)
    return float(np.max(values - np.minimum.accumulate(values)))


def claim(run: Trajectory, what: str, measured: str, value: float, bound: float, above: bool, why: str = "") -> Verdict:
    """Return the verdict on the claim `what` about `run`: a `measured` `value` at or `above` (or below) a `bound`."""
    met = value >= bound if above else value <= bound
    return Verdict(
        claim=what,
        measured=measured,
        value=float(value),
        criterion=f"{'≥' if above else '≤'} {bound:g}{f' ({why})' if why else ''}",
        holds=bool(met and run.outcome.status == "completed"),
    )


def _rod(run: Trajectory, _: Trajectory) -> Verdict:
    return claim(run, "y → e₃", f"y₃ at {run.t[-1]:.4g} s", run.y[-1, 2], 0.998, above=True)


def _thrust_axis(run: Trajectory, _: Trajectory) -> Verdict:
    return claim(run, "z → e₃", f"z₃ at {run.t[-1]:.4g} s", run.z[-1, 2], 0.9999, above=True)


def _lyapunov(run: Trajectory, _: Trajectory) -> Verdict:
    rise = largest_rise(run.signals["V"]) / (run.signals["V"][0] or 1.0)  # avoids 0/0 for a run that starts at its goal
    return claim(run, "V falls", "largest rise of V over V(0) at the samples", rise, 1e-6, above=False)


def _zero_dynamics(run: Trajectory, settled: Trajectory) -> Verdict:
    value = norm(pivot_acceleration(settled)[-1])
    measured = f"|ẍ| in m/s² at {settled.t[-1]:.4g} s"
    return claim(run, "ẍ → 0", measured, value, 0.1, above=False, why="the speed floor leaves g s/(1+s)")


def _thrust(run: Trajectory, _: Trajectory) -> Verdict:
    value = np.max(np.abs(run.thrust)) / run.vehicle.weight
    return claim(run, "f bounded", "largest |f| over (M+m)g", value, 2.0, above=False)


CLAIMS: tuple[Callable[[Trajectory, Trajectory], Verdict], ...] = (
    _rod,
    _thrust_axis,
    _lyapunov,
    _zero_dynamics,
    _thrust,
)


def theorem_claims(run: Trajectory, settled: Trajectory | None = None) -> list[Verdict]:
    """Return the verdict on each claim of Theorem 1 for a `run` of one of its laws.

    The limit ẍ → 0 is measured on `settled`, the same flight over a longer duration; default `run` itself.
    """
    with np.errstate(all="ignore"):  # a diverged run may hold huge values, which meet no criterion
        return [judge(run, settled or run) for judge in CLAIMS]


@dataclass(frozen=True)
class Finding:
    """One defect of the paper.

    Parameters
    ----------
    title : str
        The defect in a few words.
    printed, corrected : str
        The formula as printed, and as it should read.
    evidence : dict
        The computed values, by name.
    shown : bool
        Whether these values show the defect.
    """

    title: str
    printed: str
    corrected: str
    evidence: Mapping[str, float]
    shown: bool


@dataclass(frozen=True)
class Runs:
    """Runs of the experiments by name: as printed, printed without beta, corrected, corrected with printed beta."""

    printed: Mapping[str, Trajectory]
    without_beta: Mapping[str, Trajectory]
    corrected: Mapping[str, Trajectory]
    corrected_singular: Mapping[str, Trajectory]
