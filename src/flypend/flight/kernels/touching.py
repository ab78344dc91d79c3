"""What ends a flight as collided, compiled for kernels."""

from __future__ import annotations

from flypend.compile.program import lower
from flypend.compile.touch import Touch
from flypend.flight.touch import room, touching
from flypend.model import Vehicle
from flypend.model.state import E3Direction


def touch_of(vehicle: Vehicle, e3: E3Direction, *, by_rotors: bool) -> Touch | None:
    """Return what the rod of `vehicle` can touch, None on a gimbal; arguments as in `flight.touch.touching`."""
    if vehicle.mount == "gimbal":
        return None
    bound, search = room(vehicle, e3, by_rotors=by_rotors), touching(vehicle, e3, by_rotors=by_rotors)
    return Touch(lower(bound), lower(search))
