"""Theorem 1 exactly as printed. It does not do what it claims: see docs/paper/errata.md."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from flypend import errors
from flypend.laws.bound import Control, Guard
from flypend.laws.gain import NOT_NEGATIVE, Gain, documented, table
from flypend.laws.law import Law
from flypend.laws.theorem1 import BETA_GUARD, PAPER_GAINS, theorem_1
from flypend.model import State, Vehicle

GAINS = table(
    (
        *PAPER_GAINS,
        # As printed it is 0, and the law is undefined at ẏ = 0, where experiment 4 starts. The default lets that run
        # start; no result depends on its value.
        Gain("speed_floor", 1e-6, "rad/s", "s in √(|ẏ|² + s²), which replaces |ẏ| in (kpeqn)", NOT_NEGATIVE),
        Gain(
            "beta", "minimum-norm", doc="minimum-norm A, as printed; off isolates the effect of the damping sign",
            choices=("minimum-norm", "off"),
        ),
    )
)  # fmt: skip


@errors.named_arguments
@documented(GAINS)
def printed(**gains: float | str) -> Law:
    """Build Theorem 1 with the printed damping sign and the minimum-norm beta, in the paper's frame (e₃ along gravity).

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
    return Law(name="printed", e3="down", gains=GAINS, given=gains, control=_control, guard=_guard)


def _control(t: Any, state: State, vehicle: Vehicle, k: Any) -> Control:
    return theorem_1(
        t, state, vehicle, k_d=k.k_d, k_1=k.k_1, k_2=k.k_2, damping_sign=+1, speed_floor=k.speed_floor,
        beta_floor=0.0 if k.beta == "minimum-norm" else None,
    )  # fmt: skip


def _guard(gains: Mapping[str, Any]) -> Guard | None:
    return BETA_GUARD if gains["beta"] == "minimum-norm" else None
