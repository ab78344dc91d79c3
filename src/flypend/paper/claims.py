"""Verdicts on the claims of Theorem 1, and of Theorems A and B that are true, each on a run; the record of a defect."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend.flight.simulate import simulate
from flypend.flight.trajectory import Trajectory
from flypend.geometry import E3, norm, rotation_from_vector
from flypend.laws import almost_global
from flypend.model import State, equations_of_motion, vehicle
from flypend.paper.table import experiment, experiment_names

# Duration, s, after which the rod is at rest, so that the limit of ẍ can be measured.
SETTLED = 30.0
# The limits are approached like e^(−0.9 t) or faster: `SETTLED` leaves less than 1e-9.
RTOL = 1e-11
LIMIT = 1e-7  # of every limit: far above the error of the integration, far below what a speed floor leaves
RISE = 1e-9  # of V over V(0): the error of the integration
RATE = 1e-9  # of V̇ against its formula, over the largest |V̇|: roundoff
LEAST = 1e-12  # N, of a thrust that is not zero


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


def _falls(run: Trajectory, bound: float) -> Verdict:
    V = run.signals["V"]
    rise = largest_rise(V) / (V[0] or 1.0)  # avoids 0/0 for a run that starts at its goal
    return claim(run, "V falls", "largest rise of V over V(0) at the samples", rise, bound, above=False)


def claims_of(run: Trajectory, settled: Trajectory) -> list[Verdict]:
    """Return the verdicts on the theorem of the law of `run`; `settled` is the same flight over `SETTLED` seconds."""
    if run.law == "repaired":
        return theorem_a_claims(settled)
    return theorem_b_claims(settled) if run.law == "almost_global" else theorem_claims(run, settled)


def theorem_claims(run: Trajectory, settled: Trajectory | None = None) -> list[Verdict]:
    """Return the verdict on each claim of Theorem 1 for a `run` of one of its laws.

    The limit ẍ → 0 is measured on `settled`, the same flight over a longer duration; default `run` itself.
    """
    settled = settled or run
    with np.errstate(all="ignore"):  # a diverged run may hold huge values, which meet no criterion
        at_end, at_rest = f"at {run.t[-1]:.4g} s", f"|ẍ| in m/s² at {settled.t[-1]:.4g} s"
        limit, why = norm(pivot_acceleration(settled)[-1]), "the speed floor leaves g s/(1+s)"
        share = np.max(np.abs(run.thrust)) / run.vehicle.weight
        return [
            claim(run, "y → e₃", f"y₃ {at_end}", run.y[-1, 2], 0.998, above=True),
            claim(run, "z → e₃", f"z₃ {at_end}", run.z[-1, 2], 0.9999, above=True),
            _falls(run, 1e-6),
            claim(run, "ẍ → 0", at_rest, limit, 0.1, above=False, why=why),
            claim(run, "f bounded", "largest |f| over (M+m)g", share, 2.0, above=False),
        ]


def theorem_a_claims(run: Trajectory) -> list[Verdict]:
    """Return the verdict on each claim of Theorem A for a `run` of the repaired law over `SETTLED` s."""
    share = np.abs(run.thrust) / run.vehicle.weight
    D = run.gains["damping_share"]
    within = max(np.max(share) - (1 + D), (1 - D) - np.min(share))
    return [
        *_limits(run),
        claim(run, "ẍ → 0", "|ẍ| in m/s² at the end", norm(pivot_acceleration(run)[-1]), LIMIT, above=False),
        claim(run, "f in bounds", "excess of |f|/((M+m)g) over 1±D", within, 0.0, above=False),
    ]


def theorem_b_claims(run: Trajectory) -> list[Verdict]:
    """Return the verdict on each claim of Theorem B for a `run` of the almost global law over `SETTLED` s."""
    reference = run.x if run.x_ref is None else run.x_ref
    return [
        *_limits(run),
        claim(run, "x → x_ref", "|x − x_ref| in m at the end", norm(run.x - reference)[-1], LIMIT, above=False),
        claim(run, "f > 0", "least thrust in N", float(np.min(run.thrust)), LEAST, above=True),
    ]


def _limits(run: Trajectory) -> list[Verdict]:
    """What both theorems claim."""
    rate = run.signals["V_rate"]
    mismatch = np.max(np.abs(rate - run.signals["V_rate_claimed"])) / (np.max(np.abs(rate)) or 1.0)
    return [
        claim(run, "y → e₃", "|y − e₃| at the end", norm(run.y[-1] - E3), LIMIT, above=False),
        claim(run, "z → e₃", "|z − e₃| at the end", norm(run.z[-1] - E3), LIMIT, above=False),
        _falls(run, RISE),
        claim(run, "V̇ = claim", "largest error of the formula over the largest |V̇|", mismatch, RATE, above=False),
    ]


def fly_repaired() -> Mapping[str, Trajectory]:
    """Fly the paper's experiments under the repaired law with the paper's gains, for `SETTLED` seconds, by name."""
    out = {}
    for name in experiment_names():
        row = experiment(name)
        out[name] = simulate(row.vehicle, row.law("repaired"), row.start, SETTLED, plant=row.plant, rtol=RTOL)
    return out


# Rod and thrust axis at rest at the reference; "beside the edge" starts 1e-3 rad from the set z = −z_d.
SWING_UPS: Mapping[str, State] = {
    "hanging": State(y=(0.0, 0.0, -1.0)),
    "level": State(y=(1.0, 0.0, 0.0)),
    "upside down": State(y=(0.0, 0.0, -1.0), R=rotation_from_vector((3.0, 0.0, 0.0))),
    "beside the edge": State(y=(0.0, 0.0, 1.0), R=rotation_from_vector((np.pi - 1e-3, 0.0, 0.0))),
}


def fly_swing_ups() -> Mapping[str, Trajectory]:
    """Fly hehn2011 under the almost global law from `SWING_UPS`, for `SETTLED` seconds, by name."""
    law, machine = almost_global(), vehicle("hehn2011")
    return {name: simulate(machine, law, start, SETTLED, plant="ideal", rtol=RTOL) for name, start in SWING_UPS.items()}


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
