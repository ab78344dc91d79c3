"""A supervisor: the inverted law first, the almost global law from a given time on, for good.

A law has no memory of having handed over; time has. From every state in which the first law leaves the system inside
the domain of Theorem B, the second converges: docs/laws/theorem-appendix.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from types import SimpleNamespace
from typing import Any

import casadi as ca

from flypend import errors
from flypend.geometry import Scalar, Vector
from flypend.laws.almost_global import almost_global
from flypend.laws.bound import Control
from flypend.laws.gain import NOT_NEGATIVE, Bounds, Gain, documented, table
from flypend.laws.inverted import inverted
from flypend.laws.inverted_gains import computer_of
from flypend.laws.law import Law
from flypend.laws.references import Reference, hover
from flypend.model import State, Vehicle, Wrench


def _as_inverted(name: str) -> Callable[[Vehicle], float]:
    return lambda vehicle: float(inverted().gains_for(vehicle)[name])


GAINS = table(
    (
        Gain("handover", 6.0, "s", "Time from which the almost global law flies", NOT_NEGATIVE, label="handover"),
        Gain("lead", _as_inverted("lead"), "", "As in the inverted law", Bounds(low=1.0)),
        Gain("latency", _as_inverted("latency"), "s", "As in the inverted law", NOT_NEGATIVE),
        Gain("delay_reach", _as_inverted("delay_reach"), "s", "As in the inverted law", NOT_NEGATIVE),
        Gain("observer", _as_inverted("observer"), "1/s", "As in the inverted law, as long as it flies", NOT_NEGATIVE),
    )
)


@errors.named_arguments
@documented(GAINS)
def supervised(reference: Reference | None = None, **gains: float) -> Law:
    """Build the law that flies `inverted` until `handover` and `almost_global` from then on, about one `reference`.

    It depends on time, so it cannot be exported as C.

    Parameters
    ----------
    reference : callable, optional
        Pivot position (3,), m, as a CasADi function of time; default hover at the origin. See `laws.references`.
    **gains : float
        Any of the gains below, in the stated unit. Both laws have their defaults for the vehicle.

    {gains}

    Raises
    ------
    InputError
        If a gain is unknown or out of bounds; and from `bind`, as in either law.
    """
    followed = reference or hover()
    return Law(
        name="supervised",
        e3="up",
        gains=GAINS,
        given=gains,
        control=_control,
        computer=computer_of,
        uses_forces=True,
        reference=followed,
        prepare=partial(_both, followed),
    )


def _both(reference: Reference, vehicle: Vehicle, gains: Mapping[str, Any]) -> Mapping[str, Any]:
    return {"first": inverted(reference).bind(vehicle), "second": almost_global(reference).bind(vehicle)}


def _control(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, forces: tuple[Vector, Vector]) -> Control:
    """Evaluate both laws for symbols `t` (s) and `state`; `forces` (3, 1), N, on vehicle and bob go to the first."""
    first = k.first.evaluate(t, state, vehicle, forces).wrench
    second = k.second.evaluate(t, state, vehicle)
    early = t < k.handover
    domain = second.signals["domain"]
    return Control(
        wrench=Wrench(
            ca.if_else(early, first.thrust, second.wrench.thrust), ca.if_else(early, first.moment, second.wrench.moment)
        ),
        signals={"domain": domain, "V_almost_global": sum(second.lyapunov.values())},
    )
