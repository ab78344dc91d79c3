"""A supervisor: any law first, the almost global law in the set in which rotor limits are proved not to matter.

The set S = {V ≤ c, |ω₃| ≤ w} is one that the almost global law does not leave (Theorem C, docs/laws/theorem-proof.md).
So the state alone decides, without memory: outside S the first law flies, in S the almost global law, for good. A
flight of the first law that enters S converges.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from types import SimpleNamespace
from typing import Any

import casadi as ca

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import Scalar, Vector
from flypend.laws.almost_global import almost_global
from flypend.laws.almost_global_bounds import stands
from flypend.laws.bound import Control
from flypend.laws.gain import POSITIVE, Gain, documented, table
from flypend.laws.inverted import inverted
from flypend.laws.law import Law
from flypend.laws.references import Reference, hover
from flypend.model import State, Vehicle, Wrench


@lru_cache(maxsize=64)
def _certified(vehicle: Vehicle) -> tuple[float, float]:
    """Return c and w of the certified set of the default almost global law on `vehicle`."""
    found = almost_global().bind(vehicle).certified_set()
    return found.c, found.yaw_rate


def _of_certificate(place: int) -> Callable[[Vehicle], float]:
    return lambda vehicle: _certified(vehicle)[place]


GAINS = table(
    (
        Gain(
            "level", _of_certificate(0), "m²/s²", "Largest V at which the almost global law flies", POSITIVE, label="c"
        ),
        Gain("yaw_rate", _of_certificate(1), "rad/s", "Largest |ω₃| at which it flies", POSITIVE, label="w"),
    )
)


@errors.named_arguments
@documented(GAINS)
def supervised(reference: Reference | None = None, *, first: Law | None = None, **gains: float) -> Law:
    """Build the law that flies `first` until the state is in a certified set of `almost_global`, and that law there.

    On a plant with rotor limits and without lag, a flight that enters the set converges: there the limits never act.
    With lag nothing is proved. `flypend.Ideal(limits=True)` is that plant.

    Parameters
    ----------
    reference : callable, optional
        Pivot position (3,), m, as a CasADi function of time, at rest; default that of `first`, or hover at the origin.
        See `laws.references`.
    first : Law, optional
        A law with e₃ up; default `inverted` about the reference. Its flight computer flies both.
    **gains : float
        Any of the gains below, in the stated unit. Their defaults are the `certified_set` of `almost_global` on the
        vehicle, which takes seconds and the extra "proof".

    {gains}

    Raises
    ------
    InputError
        If a gain is unknown or out of bounds, or `first` has e₃ down or flies only where the wrench is known; and from
        `bind`, as in either law and `certified_set`.
    """
    before = first or inverted(reference)
    if before.e3 != "up" or before.uses_wrench:
        raise InputError("first", "a law with e3 up that does not take the wrench", before.name)
    followed = reference or before.reference or hover()
    return Law(
        name="supervised",
        e3="up",
        gains=GAINS,
        given=gains,
        control=_control,
        computer=lambda known: known["first"].computer,
        uses_forces=before.uses_forces,
        reference=followed,
        prepare=partial(_both, before, almost_global(followed)),
    )


def _both(first: Law, second: Law, vehicle: Vehicle, gains: Mapping[str, Any]) -> Mapping[str, Any]:
    assert second.reference is not None
    if not stands(second.reference):
        raise InputError("law.reference", "one at rest", "one that moves")
    return {"first": first.bind(vehicle), "second": second.bind(vehicle)}


def _control(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, *forces: tuple[Vector, Vector]) -> Control:
    """Evaluate both laws for symbols `t` (s) and `state`; `forces` (3, 1), N, on vehicle and bob go to the first."""
    first = k.first.evaluate(t, state, vehicle, *forces).wrench
    second = k.second.evaluate(t, state, vehicle)
    V = sum(second.lyapunov.values())
    inside = ca.logic_and(k.level >= V, ca.fabs(state.omega[2]) <= k.yaw_rate)  # false where V is not a number
    return Control(
        wrench=Wrench(
            ca.if_else(inside, second.wrench.thrust, first.thrust),
            ca.if_else(inside, second.wrench.moment, first.moment),
        ),
        signals={"certified": inside, "V_almost_global": V},
    )
