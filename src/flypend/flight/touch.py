"""Whether and where a machine touches itself or a floor within an interval; one source for kernels and reference."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.building import built
from flypend.compile import problem
from flypend.compile.numeric import as_numpy
from flypend.compile.program import lower
from flypend.geometry import Numbers, dot, unit
from flypend.model import State, Vehicle, Wrench, rod_tension
from flypend.model.mount import least_margin, part_names, rod_in_body
from flypend.model.outline import outline, outline_parts
from flypend.model.state import SIZE, E3Direction, convert_packed

_End = tuple[Any, Any, Any]  # rod in the body frame, its rate, its push on the vehicle
# Points within a control period at which the rod is looked at. At 500 Hz they are 0.5 ms apart: the tip of a rod of
# half a metre at 15 rad/s moves 4 mm, less than the thickness of the rod.
POINTS = 4
BOUNDS = {"gimbal": np.inf, "cup": -1.0}  # `room` where it is not computed
LANDED = "floor: "  # begins the name of what has met the floor
NEVER = 2.0  # the share of an interval in which nothing is touched
NO_NUMBERS = ca.SX(0, 1)


def touch_of(
    vehicle: Any, e3: E3Direction, *, by_rotors: bool, floor: float | None, numbers: Numbers = NO_NUMBERS
) -> problem.Touch | None:
    """Return what `vehicle` can touch, for kernels, None on a gimbal without a floor; arguments as in `touching`."""
    if vehicle.mount == "gimbal" and floor is None:
        return None
    bound, search = (make(vehicle, e3, by_rotors=by_rotors, floor=floor, numbers=numbers) for make in (room, touching))
    return problem.Touch(lower(bound), lower(search))


def touching(
    vehicle: Any, e3: E3Direction = "up", *, by_rotors: bool = True, floor: float | None = None,
    numbers: Numbers = NO_NUMBERS,
) -> ca.Function:  # fmt: skip
    """Build (before, after, period) → (clearance, share, part) for two states in the frame `e3`, `period` (s) apart.

    Each state is followed by the rotor forces, (24 + n,), or unless `by_rotors` by the thrust, (25,); that before also
    by the `numbers` (k,) of `vehicle`, symbols that differ from one machine to another. In between the
    rod moves in the body frame along the cubic through directions and rates at both ends, and is looked at in `POINTS`
    equally spaced shares of the interval. `clearance` is the smallest distance there, m, `share` the first at which a
    margin of `model.mount` is negative, `NEVER` if none is, and `part` the place of that margin in `touchable`.

    A part of the machine that is below the height `floor` (m, upward whatever the frame) at the end of the interval has
    passed it at the share that its heights at both ends give. Whoever comes back up within the interval is missed: in
    2 ms by less than 0.1 mm.
    """
    before, after, period, ends = _ends(vehicle, e3, by_rotors)
    given = [ca.vertcat(before, numbers), after, period]
    least, share, part = ca.SX(np.inf), ca.SX(NEVER), ca.SX(-1)
    for k in range(POINTS, 0, -1) if vehicle.mount != "gimbal" else ():
        smallest, place, clearance = least_margin(*_between(ends, period, k / POINTS), vehicle)
        least = ca.fmin(least, clearance)
        share = ca.if_else(smallest < 0, k / POINTS, share)
        part = ca.if_else(smallest < 0, place, part)
    if floor is not None:
        high, low = (_heights(packed, vehicle, e3, floor) for packed in (before, after))
        share, part = _first_touch(high, low, vehicle, share, part)
    return ca.Function("touching", given, [ca.cse(ca.vertcat(least, share, part))])


def _heights(packed: Numbers, vehicle: Vehicle, e3: E3Direction, floor: float) -> Numbers:
    """Heights (k, 1) of the lowest points of the parts of the outline above the `floor`, m."""
    low, _ = outline(State.symbolic(convert_packed(packed[:SIZE], e3)), vehicle)
    return low[:, 2] - floor


def _first_touch(
    before: Numbers, after: Numbers, vehicle: Vehicle, share: Numbers, part: Numbers
) -> tuple[Numbers, Numbers]:
    """Share and part of the first touch: that of the mount at `share` by `part`, or where a height falls below 0."""
    first = len(part_names(vehicle))
    for k, (high, low) in enumerate(zip(ca.vertsplit(before), ca.vertsplit(after), strict=True)):
        when = ca.if_else(high > 0, high / (high - low), 0)
        earlier = ca.logic_and(low < 0, when < share)
        share, part = ca.if_else(earlier, when, share), ca.if_else(earlier, first + k, part)
    return share, part


def room(
    vehicle: Any, e3: E3Direction = "up", *, by_rotors: bool = True, floor: float | None = None,
    numbers: Numbers = NO_NUMBERS,
) -> ca.Function:  # fmt: skip
    """Build (before, after, period), as in `touching`, → a lower bound of every distance in between, m, much cheaper.

    A point of a disc at height h and radius ρ is at least ρ |u₃| − |h| from a rod u in the body frame, one of an arm at
    least 2 ρ sin(ε/2), sin ε = |u₃|. In between, |u₃| changes by at most |u̇| for half the interval. In a cup nothing is
    bounded: the result is negative. So it is where the machine has come below the `floor`.
    """
    before, after, period, ends = _ends(vehicle, e3, by_rotors)
    bound = _room_on_hub(vehicle, period, *ends) if vehicle.mount == "hub" else ca.SX(BOUNDS[vehicle.mount])
    if floor is not None:
        bound = ca.if_else(ca.mmin(_heights(after, vehicle, e3, floor)) < 0, -1, bound)
    return ca.Function("room", [ca.vertcat(before, numbers), after, period], [ca.cse(bound)])


def _room_on_hub(vehicle: Vehicle, period: Any, before: _End, after: _End) -> Any:
    """See `room`."""
    (u_0, rate_0, _), (u_1, rate_1, _) = before, after
    body, centres = vehicle.body, vehicle.rotors_from_pivot
    inner = float(np.min(np.linalg.norm(centres[:, :2], axis=1))) - body.disc_radius
    speed = ca.fmax(ca.sqrt(dot(rate_0, rate_0)), ca.sqrt(dot(rate_1, rate_1)))
    up = ca.fmin(ca.fabs(u_0[2]), ca.fabs(u_1[2]))
    up = ca.if_else(u_0[2] * u_1[2] > 0, ca.fmax(up - 0.75 * period * speed, 0), 0)  # a cubic overshoots a little
    discs = inner * up - float(np.max(np.abs(centres[:, 2]))) - body.rod_radius
    chord = ca.sqrt(2 * up**2 / (1 + ca.sqrt(ca.fmax(1 - up**2, 0))))  # 2 sin(ε/2) without cancellation
    arms = body.hub_radius * chord - body.arm_radius - body.rod_radius
    return ca.fmin(discs, arms)


def touchable(vehicle: Vehicle) -> list[str]:
    """Return the names of what `touching` tells apart: the parts of the mount, then those that can meet a floor."""
    return part_names(vehicle) + [f"{LANDED}{part}" for part in outline_parts(vehicle)]


def reason_of(vehicle: Vehicle, part: int) -> str:
    """Return the reason of an outcome, for the `part` of `touching`."""
    name = touchable(vehicle)[part]
    if name.startswith(LANDED):
        return f"the {name.removeprefix(LANDED)} touched the floor"
    if vehicle.mount == "hub":
        return f"the rod touched {name}"
    return "the rod left the cone of its cup" if name == "cone" else "the cup would have had to pull the rod"


def part_of(vehicle: Vehicle, reason: str) -> str | None:
    """Return the name in `touchable` of the part that an outcome's `reason` is about; None if it is about none."""
    names = touchable(vehicle)
    return next((name for part, name in enumerate(names) if reason_of(vehicle, part) == reason), None)


class Touch(NamedTuple):
    """A touch: at which `share` of an interval, and the `reason` for an outcome."""

    share: float
    reason: str


Watch = Callable[[Any, Any, float], Touch | None]


@built(maxsize=64)
def watcher(vehicle: Vehicle, e3: E3Direction = "up", *, by_rotors: bool = True, floor: float | None = None) -> Watch:
    """Return (before, after, period) → the first touch between two states; arguments as in `touching`."""
    if vehicle.mount == "gimbal" and floor is None:
        return lambda *_: None
    look = as_numpy(touching(vehicle, e3, by_rotors=by_rotors, floor=floor))

    def watch(before: Numbers, after: Numbers, period: float) -> Touch | None:
        _, share, part = look(before, after, period)
        return Touch(float(share), reason_of(vehicle, int(part))) if share <= 1 else None

    return watch


def _ends(vehicle: Vehicle, e3: E3Direction, by_rotors: bool) -> tuple[Any, Any, Any, tuple[_End, _End]]:
    """Symbols of states and period; and per state, the rod in the body frame, its rate, its push on the vehicle."""
    n = len(vehicle.rotor_spins) if by_rotors else 1
    before, after, period = ca.SX.sym("before", SIZE + n), ca.SX.sym("after", SIZE + n), ca.SX.sym("period")
    to_thrust = ca.DM(vehicle.mixing(e3))[0, :] if by_rotors else ca.DM(1)

    def end(packed: Numbers) -> _End:
        state = State.symbolic(packed[:SIZE])
        thrust = ca.mtimes(to_thrust, packed[SIZE:])
        return (*rod_in_body(state, e3), -rod_tension(state, Wrench(thrust, ca.SX(3, 1)), vehicle))

    return before, after, period, (end(before), end(after))


def _between(ends: tuple[_End, _End], period: Any, share: float) -> tuple[Any, Any]:
    """Rod in the body frame and its push at a `share` of the interval."""
    (u_0, rate_0, push_0), (u_1, rate_1, push_1) = ends
    s, r = share, 1 - share
    u = (1 + 2 * s) * r**2 * u_0 + s**2 * (3 - 2 * s) * u_1 + period * (s * r**2 * rate_0 - s**2 * r * rate_1)
    return unit(u), r * push_0 + s * push_1
