"""`nmpc`: a controller that plans, flies, and plans again in flight, with the inverted law to fall back on."""

from __future__ import annotations

from typing import Literal, Unpack

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import E3
from flypend.laws import Computer, Controller, Law
from flypend.laws.references import Reference, hover
from flypend.model import State, Vehicle
from flypend.planning.constraints import Constraints, Keywords, gathered
from flypend.planning.pilot import Receding
from flypend.planning.request import request
from flypend.planning.tracking import fallback, rotors_only

COMPUTING = 0.001  # s


@errors.named_arguments
def nmpc(
    vehicle: Vehicle | None = None,
    *,
    reference: Reference | None = None,
    latency: float = 0.0,
    computing: float | Literal["measured"] = COMPUTING,
    otherwise: Law | None = None,
    constraints: Constraints | None = None,
    **keywords: Unpack[Keywords],
) -> Controller:
    """Return a controller that plans the way to inverted hover in flight, and again whenever it is thrown off.

    It is a flight computer: at once, and whenever the rod is not about to stand, it plans from where it will be when
    the plan is ready, and until then the inverted law flies. A plan is flown with feedback, and what is left of it is
    solved again in every stage, by one real-time iteration. In hover the inverted law takes over. docs/planning/nmpc.md
    says when it changes hands.

    Parameters
    ----------
    vehicle : Vehicle, optional
        If given, it is checked at once whether plans for it can be made. The controller serves any vehicle.
    reference : callable, optional
        Pivot position to hold or follow; see `laws.references`. Default that of `otherwise`, or the origin.
    latency : float
        Delay to compensate while a plan is flown, s, as in `laws.Computer`; that of `otherwise` is its own. What
        exceeds it is found in flight as far as `otherwise` looks for it.
    computing : float or "measured"
        Time that a real-time iteration of 150 stages takes on the flight computer, s; its result, and that of the first
        plan in proportion, is there that much later. "measured" takes the processor time that it took here, and flights
        do not repeat.
    otherwise : Law, optional
        What flies until there is a plan, in hover, and when there is none; default the inverted law about `reference`.
    constraints : Constraints, optional
        What its plans keep: the clearance. The laws that fly between plans keep nothing else.
    **keywords
        The same field of `Constraints` by itself.

    Raises
    ------
    InputError
        If an argument is out of range or another constraint is given; and from a flight, if the plant takes no rotor
        forces.
    """
    delay = Computer(latency=latency).latency
    if isinstance(computing, str):
        errors.one_of("computing", computing, ("measured", "a number of seconds"))
    else:
        errors.number("computing", computing, above=0, unit="s")
    kept = gathered("nmpc", constraints, keywords)
    for name, value in kept.given.items():
        if name != "clearance":
            raise InputError(name, "nothing: nmpc keeps the clearance alone", repr(value)[:80])
    if vehicle is not None:
        request(vehicle, State(y=E3), "excursion", (0.0, 0.0, 0.0), kept=kept)
    law = fallback(otherwise, reference or hover())
    followed = reference or law.reference or hover()
    return Controller(
        name="nmpc",
        function=rotors_only("nmpc"),
        reference=followed,
        flight_computer=Receding(followed, law, delay, None if computing == "measured" else computing, kept),
        because="it solves a problem in every stage",
    )
