"""The claims of Theorems A and B, each checked on a flight in the ideal plant, and the flights that check them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from flypend.flight.simulate import simulate
from flypend.flight.trajectory import Trajectory
from flypend.geometry import E3, norm, rotation_from_vector
from flypend.laws import almost_global
from flypend.model import State, vehicle
from flypend.paper.claims import SETTLED, Verdict, claim, largest_rise, pivot_acceleration, theorem_claims
from flypend.paper.table import experiment, experiment_names

# The limits are approached like e^(−0.9 t) or faster: `SETTLED` leaves less than 1e-9.
RTOL = 1e-11
LIMIT = 1e-7  # of every limit: far above the error of the integration, far below what a speed floor leaves
RISE = 1e-9  # of V over V(0): the error of the integration
RATE = 1e-9  # of V̇ against its formula, over the largest |V̇|: roundoff
LEAST = 1e-12  # N, of a thrust that is not zero


def claims_of(run: Trajectory, settled: Trajectory) -> list[Verdict]:
    """Return the verdicts on the theorem of the law of `run`; `settled` is the same flight over `SETTLED` seconds."""
    if run.law == "repaired":
        return theorem_a_claims(settled)
    return theorem_b_claims(settled) if run.law == "almost_global" else theorem_claims(run, settled)


def theorem_a_claims(run: Trajectory) -> list[Verdict]:
    """Return the verdict on each claim of Theorem A for a `run` of the repaired law over `SETTLED` s."""
    share = np.abs(run.thrust) / run.vehicle.weight
    D = run.gains["damping_share"]
    within = max(np.max(share) - (1 + D), (1 - D) - np.min(share))
    return [
        *_both(run),
        claim(run, "ẍ → 0", "|ẍ| in m/s² at the end", norm(pivot_acceleration(run)[-1]), LIMIT, above=False),
        claim(run, "f in bounds", "excess of |f|/((M+m)g) over 1±D", within, 0.0, above=False),
    ]


def theorem_b_claims(run: Trajectory) -> list[Verdict]:
    """Return the verdict on each claim of Theorem B for a `run` of the almost global law over `SETTLED` s."""
    reference = run.x if run.x_ref is None else run.x_ref
    return [
        *_both(run),
        claim(run, "x → x_ref", "|x − x_ref| in m at the end", norm(run.x - reference)[-1], LIMIT, above=False),
        claim(run, "f > 0", "least thrust in N", float(np.min(run.thrust)), LEAST, above=True),
    ]


def _both(run: Trajectory) -> list[Verdict]:
    V, rate = run.signals["V"], run.signals["V_rate"]
    rise = largest_rise(V) / (V[0] or 1.0)
    mismatch = np.max(np.abs(rate - run.signals["V_rate_claimed"])) / (np.max(np.abs(rate)) or 1.0)
    return [
        claim(run, "y → e₃", "|y − e₃| at the end", norm(run.y[-1] - E3), LIMIT, above=False),
        claim(run, "z → e₃", "|z − e₃| at the end", norm(run.z[-1] - E3), LIMIT, above=False),
        claim(run, "V falls", "largest rise of V over V(0) at the samples", rise, RISE, above=False),
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
