"""How much room a swing-up takes, from flights of the exported law in flypend's own model."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flypend.errors import InputError
from flypend.flight.ensemble import fly_many
from flypend.flight.request import Flight
from flypend.flight.tasks import TICK, task_starts
from flypend.laws import BoundLaw, Law
from flypend.model import Vehicle
from flypend.plants import ROTORS

SEED, DIRECTIONS, DURATION = 1, 24, 10.0  # s
MARGIN = 1.5  # of what the model needs: for a machine that is not the model, and for PID to recover from a swing-up
STEP = 0.5  # m, to which the room is rounded up


class Room(NamedTuple):
    """Room around a vehicle that hovers with the rod hanging, before a swing-up.

    Parameters
    ----------
    height : float
        Above the ground, m.
    aside : float
        In any other direction, m.
    """

    height: float
    aside: float


def swing_up_room(law: Law | BoundLaw, vehicle: Vehicle, rate: float) -> Room:
    """Return the room that `law`, called at `rate` (Hz), takes to swing the rod up on `vehicle`.

    Starts hang at rest at 25 headings; vehicle and rod stay within the room with a `MARGIN`. Raises InputError for a
    law that does not swing up from all of them.
    """
    starts = task_starts(vehicle, 1, SEED, DIRECTIONS).get("hanging")
    if starts is None:
        raise InputError("vehicle", "a mount that lets the rod hang", vehicle.mount)
    bound = law.bind(vehicle)
    flown = fly_many(
        Flight(
            vehicle=vehicle,
            law=bound,
            starts=starts.in_frame(bound.e3),
            duration=DURATION,
            plant=ROTORS.replace(rate=rate),
            times=np.arange(0, DURATION, TICK),
        )
    )
    if not flown.success.all():
        came = f"{bound.name}: {flown.success.sum()} of {len(flown)} within {DURATION:g} s"
        raise InputError("law", f"one that swings the rod up on {vehicle.name}, or a height", came)
    assert flown.samples is not None  # since times were given
    motion = flown.samples.in_frame(bound.e3)  # back to e₃ up
    bob = motion.x + vehicle.l * motion.y
    lowest = min(motion.x[..., 2].min(), bob[..., 2].min())
    farthest = max(np.hypot(end[..., 0], end[..., 1]).max() for end in (motion.x, bob))
    highest = max(motion.x[..., 2].max(), bob[..., 2].max())
    return Room(_rounded(-lowest), _rounded(max(farthest, highest)))


def _rounded(length: float) -> float:
    return float(STEP * np.ceil(MARGIN * length / STEP))
