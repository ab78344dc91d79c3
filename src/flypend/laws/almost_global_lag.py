"""The law of Theorem B through rotors with a known lag: Theorem D, docs/laws/theorem-proof.md.

Lemma L (`laws.lag`) around `almost_global`: one more derivative of that law, and a V' that falls along every solution.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import Scalar
from flypend.laws import almost_global_gains
from flypend.laws.almost_global import OUTSIDE, almost_global_control, certify
from flypend.laws.almost_global_bounds import theorem_d
from flypend.laws.bound import COMPUTER, Control
from flypend.laws.gain import document_gains, table
from flypend.laws.lag import GAINS as LAG_GAINS
from flypend.laws.lag import through_lag
from flypend.laws.law import Law
from flypend.laws.references import Path, Reference, hover
from flypend.laws.throw import carrying
from flypend.model import State, Vehicle, Wrench

GAINS = table(
    (
        *(gain for gain in almost_global_gains.GAINS.values() if gain.name not in COMPUTER),
        *LAG_GAINS,
    )
)


@errors.named_arguments
@document_gains(
    GAINS,
    "; from `bind`, if the demand on the bob could point downward, or the vehicle has no lag; and in another plant",
    ", with eleven bounded derivatives",
)
def almost_global_lag(reference: Reference | None = None, **gains: float) -> Law:
    """Build the law of Theorem D about a `reference` for the pivot: `almost_global` through rotors that lag.

    Every start reaches the reference, whatever the initial rotor forces, except those with y = -d or z = -z_d, as
    without lag. The law assumes that all rotors have the lag of the vehicle, `rotor_lag`, and no limits, and that their
    forces are known. So it flies in `flypend.Ideal(lag=True)`.
    """
    followed = reference or hover()
    return Law(
        name="almost_global_lag",
        e3="up",
        gains=GAINS,
        given=gains,
        control=_control,
        guard=OUTSIDE,
        uses_wrench=True,
        reference=followed,
        path=carrying(followed),
        prepare=_prepare,
        theorem=theorem_d,
        certify=certify,
    )


def _prepare(vehicle: Vehicle, gains: Mapping[str, Any]) -> Mapping[str, Any]:
    if vehicle.rotor_lag <= 0:
        raise InputError("vehicle.rotor_lag", "a lag > 0 s; without one, almost_global", f"{vehicle.rotor_lag:g} s")
    return almost_global_gains.demand_stays_upward(vehicle, gains)


def _control(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, *, path: Path, acting: Wrench) -> Control:
    """Evaluate the law for symbols `t` (s), `state` and `acting`, with the gains `k` of `almost_global_lag`."""
    wanted = almost_global_control(t, state, vehicle, k, path=path)
    return through_lag(wanted, t, state, acting, vehicle, k, "up")
