"""`Window`: an opening in a wall to fly through; how much room a machine leaves in it; the funnel that leads there.

A wall with a hole allows what is not convex. About each window, with coordinates (u, v) along the wall and s across it,
every point of the machine keeps

    u² ≤ b_u² + k_u max(0, s² − d²),   v² ≤ b_v² + k_v max(0, s² − d²),

a funnel on either side of a neck of half width b and half depth d. It leads a flight that would hit the wall towards
the opening; and as start and end are on different sides, the flight passes through. A waypoint is a small window for
the pivot alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from flypend import errors
from flypend.building import built
from flypend.errors import InputError
from flypend.geometry import E3, cross, dot, norm
from flypend.model import State, Vehicle
from flypend.model.body import Body
from flypend.model.state import SIZE
from flypend.planning.dynamics import Array, Units

RIM = 24  # corners of the polygons that stand for discs
STEEP = 1e-3  # least sine between the normal and what is up in the window
TINY = 1e-12

# Numbers of a gate: centre, axes; half widths, slopes and half depth of the neck; reach, and radius and height of the
# body.
CENTRE, AXES, HALF, SLOPES, DEPTH, BODY = slice(0, 3), slice(3, 12), slice(12, 14), slice(14, 16), 16, slice(17, 20)
NUMBERS = BODY.stop
SLOPE = 4.0  # k: about 63° between the funnel and the normal, far away
ROOM = 1.3  # factor of a slope that start or end needs
NECK = 0.15  # rod lengths: the funnel's half depth beyond the wall's, for what is between two stages
INSET = 3e-3  # rod lengths, by which the neck is narrower than the opening, likewise
NEAR = 0.05  # rod lengths, within which a flight passes a waypoint
NECK_OF_POINT = 0.1  # rod lengths: half depth of its gate, which no stage up to 5 m/s on hehn2011 steps over
LEVEL = 1e-4  # keeps the direction finite in which a body normal to an axis extends most


@errors.named_arguments
@dataclass(frozen=True, eq=False)
class Window:
    """A rectangular opening in an infinite plane wall, world frame with e₃ up.

    Parameters
    ----------
    centre : (3,)
        Centre of the opening, m.
    width, height : float
        Its sides, m: width level, or normal to `up`; height along `up`.
    normal : (3,)
        Direction normal to the wall, either way.
    up : (3,)
        Direction along which the height is measured; its part along the normal does not count.
    depth : float
        Thickness of the wall, m.

    Raises
    ------
    InputError
        If a side is not positive, the depth negative, or `up` normal to the wall.
    """

    centre: Any
    width: float
    height: float
    normal: Any = (1.0, 0.0, 0.0)
    up: Any = (0.0, 0.0, 1.0)
    depth: float = 0.0

    def __post_init__(self) -> None:
        for name in ("centre", "normal", "up"):
            object.__setattr__(self, name, errors.array(f"window.{name}", getattr(self, name), (3,)))
        for name in ("width", "height"):
            object.__setattr__(self, name, errors.number(f"window.{name}", getattr(self, name), above=0, unit="m"))
        object.__setattr__(self, "depth", errors.number("window.depth", self.depth, at_least=0, unit="m"))
        if not norm(self.normal) > 0:
            raise InputError("window.normal", "a direction", self.normal.tolist())
        if not norm(cross(self.normal, self.up)) > STEEP * norm(self.normal) * norm(self.up):
            raise InputError("window.up", "a direction along the wall", self.up.tolist())

    @property
    def axes(self) -> Array:
        """Unit vectors (3, 3), as rows: along the width, along the height, and normal to the wall."""
        n = self.normal / norm(self.normal)
        v = self.up - np.dot(self.up, n) * n
        v /= norm(v)
        return np.array([cross(v, n), v, n])

    @property
    def halves(self) -> Array:
        """Half of width and height (2,), m."""
        return np.array([self.width, self.height]) / 2

    def inside(self, points: ArrayLike) -> Array:
        """Return `points` (..., 3), world, about the centre along the `axes`, m."""
        about: Array = (np.asarray(points) - self.centre) @ self.axes.T
        return about

    def room(self, states: State, vehicle: Vehicle) -> Array:
        """Return how much room a vehicle leaves between itself and the frame, (n,), m; negative where they overlap.

        The room is the smallest distance, along the wall, between the frame and the parts inside the wall: rod, arms,
        hub and rotor discs, each with its radius. It is infinite while no part is inside.

        Parameters
        ----------
        states : State
            A batch of n states, e₃ up.
        vehicle : Vehicle
            The vehicle.

        Raises
        ------
        InputError
            If the vehicle has no body.
        """
        first, last, radii = _edges(states, vehicle)
        a, b = self.inside(first), self.inside(last)
        run = b[..., 2] - a[..., 2]
        run = np.where(np.abs(run) < TINY, TINY, run)
        deep = self.depth / 2 + radii
        meets = np.sort([(-deep - a[..., 2]) / run, (deep - a[..., 2]) / run], axis=0)
        enters, leaves = np.maximum(meets[0], 0.0), np.minimum(meets[1], 1.0)
        across = [np.abs(a + share[..., None] * (b - a))[..., :2] for share in (enters, leaves)]
        left = np.min(self.halves - across, axis=(0, -1)) - radii  # along a straight edge the ends are nearest
        least: Array = np.min(np.where(enters <= leaves, left, np.inf), axis=-1)
        return least


def body_of(vehicle: Vehicle) -> tuple[float, float, float]:
    """Return radius and height over the pivot of a disc about all discs of `vehicle`, and the radius of its parts.

    That is the larger one of rod and arms; all in m. Raises InputError without a body.
    """
    body, centres = _parts(vehicle), vehicle.rotors_from_pivot
    radius = float(np.max(np.linalg.norm(centres[:, :2], axis=1))) + body.disc_radius
    return radius, float(np.mean(centres[:, 2])), max(body.rod_radius, body.arm_radius)


def _parts(vehicle: Vehicle) -> Body:
    """Return the body of `vehicle`. Raises InputError if it has none."""
    body: Body | None = vehicle.body
    if body is None:
        raise InputError("vehicle.body", "the radii of the machine's parts, to fly through a window", "nothing")
    return body


def _edges(states: State, vehicle: Vehicle) -> tuple[Array, Array, Array]:
    """Return the ends (n, k, 3), world, of the edges of a machine, and how thick they are (k,), m.

    They are the rod, the arms, and polygons about rotor discs and hub. Raises InputError without a body.
    """
    body, centres = _parts(vehicle), vehicle.rotors_from_pivot
    turn = 2 * np.pi * np.arange(RIM) / RIM
    circle = np.stack([np.cos(turn), np.sin(turn), np.zeros(RIM)], axis=-1) / np.cos(np.pi / RIM)
    discs = [(centre, body.disc_radius) for centre in centres] + [(np.zeros(3), body.hub_radius)]
    corners = np.concatenate([centre + radius * circle for centre, radius in discs])
    following = np.concatenate([centre + radius * np.roll(circle, -1, axis=0) for centre, radius in discs])
    begin = np.concatenate([np.zeros_like(centres), corners])
    end = np.concatenate([centres, following])
    x, R = states.x[:, None, :], states.R
    first = np.concatenate([x, x + begin @ np.swapaxes(R, -1, -2)], axis=1)
    last = np.concatenate([x + vehicle.reach * states.y[:, None, :], x + end @ np.swapaxes(R, -1, -2)], axis=1)
    thick = np.concatenate([[body.rod_radius], np.full(len(centres), body.arm_radius), np.zeros(len(corners))])
    return first, last, thick


def funnel_margins(state: ca.SX, about: ca.SX, numbers: ca.SX) -> ca.SX:
    """Return g (10, 1), of which all are ≥ 0 in the funnel of a window; in rod lengths, as distances near its edge.

    Of the rod in a `state` (24 + n, 1) both ends and the worst point between count, which is found in the state `about`
    which derivatives are taken, of the body the points farthest out. For the `numbers` (NUMBERS, 1) see `through`.
    """
    half, slope, depth = numbers[HALF], numbers[SLOPES], numbers[DEPTH]

    def room(axis: int, point: ca.SX) -> ca.SX:
        beyond = ca.fmax(0, point[2] ** 2 - depth**2)
        return (half[axis] ** 2 + slope[axis] * beyond - point[axis] ** 2) / (2 * half[axis])

    return ca.vertcat(*(room(axis, point) for axis, point in _points(state, about, numbers)))


def _points(state: ca.SX, about: ca.SX, numbers: ca.SX) -> list[tuple[int, ca.SX]]:
    """Return pairs (axis, point about the centre along the axes) of the points that count."""
    axes, slopes = ca.reshape(numbers[AXES], 3, 3).T, numbers[SLOPES]
    reach, radius, height = ca.vertsplit(numbers[BODY])
    s, held = State.symbolic(state[:SIZE]), State.symbolic(about[:SIZE])

    def seen(point: ca.SX) -> ca.SX:
        return ca.mtimes(axes, point - numbers[CENTRE])

    pivot, tip = seen(s.x), seen(s.x + reach * s.y)
    first, run = seen(held.x), reach * ca.mtimes(axes, held.y)
    middle, found = seen(s.x + height * s.z), []
    for axis in (0, 1):
        share = _worst(first, run, axis, slopes[axis])
        e = axes[axis, :].T
        level = e - dot(e, s.z) * s.z
        out = radius * ca.mtimes(axes, level) / ca.sqrt(dot(level, level) + LEVEL)
        found += [(axis, p) for p in (pivot, tip, (1 - share) * pivot + share * tip, middle + out, middle - out)]
    return found


def _worst(first: ca.SX, run: ca.SX, axis: int, slope: ca.SX) -> ca.SX:
    """Return the share of a segment from `first` by `run` at which slope s² − a² is least, a being along `axis`."""
    curvature = slope * run[2] ** 2 - run[axis] ** 2
    still = -(slope * first[2] * run[2] - first[axis] * run[axis]) / ca.fmax(curvature, LEVEL)
    return ca.fmin(ca.fmax(still, 0), 1)


def through(window: Window, vehicle: Vehicle, route: Sequence[State], target: Array, clearance: float) -> Array:
    """Return the numbers (NUMBERS,) of a `window` for `funnel_margins`, in own units about the `target` (3,), m.

    The funnel keeps `vehicle` a `clearance` (m) from the frame. The `route`, which is start, waypoints and end, is to
    be in it, start and end on different sides of the wall. Raises InputError if the opening is too small for the rod
    alone, start and end are on one side, or something is in the wall.
    """
    radius, height, margin = body_of(vehicle)
    near = margin + clearance + INSET * vehicle.l
    if np.any(window.halves <= near):
        given = f"{window.width:g} m by {window.height:g} m"
        raise InputError("window", f"an opening of more than {2 * near:.3g} m, for rod and clearance", given)
    sides = [window.inside(end.x)[2] for end in (route[0], route[-1])]
    if sides[0] * sides[1] >= 0:
        given = " and ".join(f"{side:+.3g} m" for side in sides)
        raise InputError("window", "one between start and target", f"both on one side of the wall, {given} from it")
    neck = np.array([*(window.halves - near), window.depth / 2 + margin + NECK * vehicle.l])
    return _numbers(window, neck, np.array([vehicle.reach, radius, height]), route, target, Units.of(vehicle), "window")


def gates_at(points: Array, vehicle: Vehicle, ends: Sequence[State], target: Array) -> list[Array]:
    """Return the numbers (NUMBERS,) for `funnel_margins` of gates about each of `points` (k, 3), m; for the pivot.

    A gate is normal to the line from the point before to that after it, `ends` being the first and the last; its size
    keeps the pivot within `NEAR` of the point. Raises InputError if a point is not between those before and after it.
    """
    path = np.array([ends[0].x, *points, ends[1].x])
    route, side = [State(x=x, y=E3) for x in path], np.sqrt(2) * NEAR * vehicle.l
    neck, found = np.array([side / 2, side / 2, NECK_OF_POINT * vehicle.l]), []
    for i in range(1, len(path) - 1):
        way = path[i + 1] - path[i - 1]
        distances = (path - path[i]) @ way
        if not (np.all(distances[:i] < 0) and np.all(distances[i + 1 :] > 0)):
            raise InputError(
                "waypoints", "points that follow each other from start to target without a turn back", path[i].tolist()
            )
        gate = Window(path[i], side, side, way, np.eye(3)[np.argmin(np.abs(way))])
        found.append(_numbers(gate, neck, np.zeros(3), route, target, Units.of(vehicle), "waypoints"))
    return found


def _numbers(
    gate: Window, neck: Array, body: Array, route: Sequence[State], target: Array, units: Units, name: str
) -> Array:
    """Return the numbers of a `gate`; `neck` (3,) are its half sizes and depth, `body` (3,) the last numbers, m.

    The funnel is as steep as it must be to hold the `route`. Raises InputError in `name` if no funnel does.
    """
    slopes, length = np.full(2, SLOPE), units.length
    place, axes = (gate.centre - target) / length, gate.axes.ravel()
    own = np.concatenate([place, axes, neck[:2] / length, slopes, neck[2:] / length, body / length])
    for state in route:
        packed = state.packed()
        packed[:3] -= target
        for axis, *point in np.array(_locate()(packed / units.of_state, own)):
            out, beyond = point[int(axis)] ** 2 - own[HALF][int(axis)] ** 2, point[2] ** 2 - own[DEPTH] ** 2
            if out > 0 >= beyond and not np.allclose(state.x, gate.centre):
                raise InputError(name, "walls that start, target and waypoints are clear of", gate.centre.tolist())
            if out > 0:
                slopes[int(axis)] = max(slopes[int(axis)], ROOM * out / beyond)
    own[SLOPES] = slopes
    return own


@built(maxsize=1)
def _locate() -> ca.Function:
    """Return (state, numbers) → the points that count, as rows (axis, u, v, s)."""
    state, numbers = ca.SX.sym("state", SIZE), ca.SX.sym("numbers", NUMBERS)
    rows = [ca.horzcat(axis, point.T) for axis, point in _points(state, state, numbers)]
    return ca.Function("located", [state, numbers], [ca.vertcat(*rows)])
