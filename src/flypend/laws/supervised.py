"""A supervisor: any law first, the almost global law in the set in which rotor limits are proved not to matter.

The set S = {V ≤ c, |ω₃| ≤ w} is one that the almost global law does not leave (Theorem C, docs/laws/theorem-proof.md).
So the state alone decides, without memory: outside S the first law flies, in S the almost global law, for good. A
flight of the first law that enters S converges. Through rotors that lag S is a set of states and rotor forces, and the
law in it that of Theorem D.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import lru_cache, partial
from types import SimpleNamespace
from typing import Any

import casadi as ca

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import Scalar, Vector
from flypend.laws.almost_global import almost_global, almost_global_lag
from flypend.laws.almost_global_bounds import stands
from flypend.laws.bound import Control
from flypend.laws.certified import ratios
from flypend.laws.gain import POSITIVE, Gain, document_gains, table
from flypend.laws.inverted import inverted
from flypend.laws.lag import LEAD, lead_wrench
from flypend.laws.law import Law
from flypend.laws.references import Reference, hover
from flypend.laws.throw import bob_path
from flypend.model import State, Vehicle, Wrench


@lru_cache(maxsize=64)
def _certified_numbers(vehicle: Vehicle, lag: bool) -> tuple[float, float]:
    """Return c and w of the certified set of the default almost global law on `vehicle`, through its `lag` or not."""
    found = (almost_global_lag() if lag else almost_global()).bind(vehicle).certified_set()
    return found.c, found.yaw_rate


def _gains(lag: bool) -> Mapping[str, Gain]:
    def of_certificate(place: int) -> Callable[[Vehicle], float]:
        return lambda vehicle: _certified_numbers(vehicle, lag)[place]

    return table(
        (
            Gain(
                "level", of_certificate(0), "m²/s²", "Largest V at which the almost global law flies", POSITIVE,
                label="c",
            ),
            Gain("yaw_rate", of_certificate(1), "rad/s", "Largest |ω₃| at which it flies", POSITIVE, label="w"),
            *([LEAD] if lag else []),
        )
    )  # fmt: skip


GAINS, LAGGED_GAINS = _gains(lag=False), _gains(lag=True)


@errors.named_arguments
@document_gains(GAINS)
def supervised(
    reference: Reference | None = None, *, first: Law | None = None, lag: bool = False, **gains: float
) -> Law:
    """Build the law that flies `first` until the state is in a certified set of `almost_global`, then `almost_global`.

    On a plant with rotor limits, a flight that enters the set converges: there the limits never act. Without `lag` the
    plant is `flypend.Ideal(limits=True)`, and with it `flypend.Ideal(limits=True, lag=True)`; sampled plants are not
    covered.

    Parameters
    ----------
    reference : callable, optional
        Pivot position (3,), m, as a CasADi function of time, at rest; default that of `first`, or hover at the origin.
        See `laws.references`.
    first : Law, optional
        A law with e₃ up; default `inverted`. A `reference` moves it there, if it has a path. Its flight computer flies
        both.
    lag : bool
        Whether rotors lag. The second law is then `almost_global_lag`, with a set of states and rotor forces. The
        commands of the first law then get a `lead`, a further gain: see `laws.lag.lead_wrench`.
    **gains : float
        Any of the gains below, in the stated unit. Their defaults come from the `certified_set` of the second law on
        the vehicle, which takes a few seconds to compute, through a lag about ten.

    {gains}

    Raises
    ------
    InputError
        If a gain is unknown or out of bounds, or `first` has e₃ down or flies only where the wrench is known; and from
        `bind`, as in either law and `certified_set`.
    """
    errors.check_kind("lag", lag, bool)
    before = first or inverted(reference)
    if before.e3 != "up" or before.uses_wrench:
        raise InputError("first", "a law with e3 up that does not take the wrench", before.name)
    if reference is not None and before.path is not None:
        before = replace(before, reference=reference, path=bob_path(reference))
    followed = reference or before.reference or hover()
    second = almost_global_lag(followed) if lag else almost_global(followed)
    return Law(
        name="supervised", e3="up", gains=LAGGED_GAINS if lag else GAINS, given=gains, control=_control,
        computer=lambda known: known["first"].computer, uses_forces=before.uses_forces, uses_wrench=lag,
        reference=followed, prepare=partial(_both, before, second),
    )  # fmt: skip


def _both(first: Law, second: Law, vehicle: Vehicle, gains: Mapping[str, Any]) -> Mapping[str, Any]:
    """Bind both laws to `vehicle`; the second holds one place. Raises InputError."""
    assert second.reference is not None
    if not stands(second.reference):
        raise InputError("law.reference", "one at rest", "one that moves")
    return {"first": first.bind(vehicle), "second": second.bind(vehicle)}


def _control(
    t: Scalar,
    state: State,
    vehicle: Vehicle,
    k: SimpleNamespace,
    *forces: tuple[Vector, Vector],
    acting: Wrench | None = None,
) -> Control:
    """Evaluate both laws for symbols `t` (s) and `state`; `forces` (3, 1), N, on vehicle and bob go to the first."""
    first = k.first.evaluate(t, state, vehicle, *forces).wrench
    if acting is not None:
        first = lead_wrench(first, acting, k.lead)
    second = k.second.evaluate(t, state, vehicle, acting=acting)
    V = sum(second.lyapunov.values())
    found = ratios(V, state, acting, vehicle, k.second.gains["yaw_damping"], k.level, k.yaw_rate)
    inside = ca.mmax(found) <= 1  # false where V is not a number
    return Control(
        wrench=Wrench(
            ca.if_else(inside, second.wrench.thrust, first.thrust),
            ca.if_else(inside, second.wrench.moment, first.moment),
        ),
        signals={"certified": inside, "V_almost_global": V},
    )
