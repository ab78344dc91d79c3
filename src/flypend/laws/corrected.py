"""Theorem 1 with three defects fixed: damping sign, speed floor, and beta (dropped or regularised). It has no proof."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from flypend import errors
from flypend.laws.bound import Control, Guard
from flypend.laws.gain import NOT_NEGATIVE, POSITIVE, Gain, documented, table
from flypend.laws.law import Law
from flypend.laws.theorem1 import BETA_GUARD, PAPER_GAINS, theorem_1
from flypend.model import State, Vehicle

GAINS = table(
    (
        *PAPER_GAINS,
        Gain(
            "speed_floor", 1e-2, "rad/s", "s in √(|ẏ|² + s²), which replaces |ẏ| in (kpeqn) and keeps it smooth",
            POSITIVE,
        ),
        Gain(
            "beta", "off", doc="off leaves a cascade; regularized divides by |v_e|² + beta_floor², and is worse",
            choices=("off", "regularized"),
        ),
        Gain("beta_floor", 0.1, "1/s", "Floor of |v_e| in beta; at 0 beta is minimum-norm, and singular", NOT_NEGATIVE),
        Gain(
            "yaw_damping", 0.0, "1/s", "Third component of I⁻¹mu over ω₃; (setmu) leaves it free", NOT_NEGATIVE,
        ),
    )
)  # fmt: skip


@errors.named_arguments
@documented(GAINS)
def corrected(**gains: float | str) -> Law:
    """Build Theorem 1 with f_p = k_p e₃ − k_d ẏ, in the paper's frame, where y = e₃ hangs along gravity.

    The paper's five experiments converge, and so do most random starts. Some run away: the rod spins ever faster
    (docs/paper/errata.md, defect 9).

    Parameters
    ----------
    **gains : float or str
        Any of the gains below, in the stated unit.

    {gains}

    Raises
    ------
    InputError
        If a gain is unknown or out of bounds.
    """
    return Law(name="corrected", e3="down", gains=GAINS, given=gains, control=_control, guard=_guard)


def _control(t: Any, state: State, vehicle: Vehicle, k: Any) -> Control:
    return theorem_1(
        t, state, vehicle, k_d=k.k_d, k_1=k.k_1, k_2=k.k_2, damping_sign=-1, speed_floor=k.speed_floor,
        beta_floor=k.beta_floor if k.beta == "regularized" else None, yaw_damping=k.yaw_damping,
    )  # fmt: skip


def _guard(gains: Mapping[str, Any]) -> Guard | None:
    return BETA_GUARD if gains["beta"] == "regularized" and gains["beta_floor"] == 0 else None
