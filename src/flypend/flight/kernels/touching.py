"""What ends a flight as collided, compiled for kernels."""

from __future__ import annotations

from flypend.compile.program import lower
from flypend.compile.touch import Touch
from flypend.flight.touch import room, touching
from flypend.model import Vehicle
from flypend.model.state import E3Direction


def touch_of(vehicle: Vehicle, e3: E3Direction, *, by_rotors: bool, floor: float | None) -> Touch | None:
    """Return what `vehicle` can touch, None on a gimbal without a floor; arguments as in `flight.touch.touching`."""
    if vehicle.mount == "gimbal" and floor is None:
        return None
    bound, search = (make(vehicle, e3, by_rotors=by_rotors, floor=floor) for make in (room, touching))
    return Touch(lower(bound), lower(search))
