"""How far the rod is from leaving its mount: clearance of the rod to discs and arms, room in a cup."""

from __future__ import annotations

import casadi as ca
import numpy as np

from flypend.geometry import Numbers, Scalar, Vector, apply, clip, cross, is_symbolic, transpose
from flypend.model.body import Body
from flypend.model.dynamics import rod_tension
from flypend.model.state import FLIP, E3Direction, State, Wrench
from flypend.model.vehicle import Vehicle

# Iterations for the point of the rod nearest to a disc: Newton steps within a bracket.
ITERATIONS = 8


def margins(state: State, wrench: Wrench, vehicle: Vehicle, e3: E3Direction) -> Numbers:
    """Return what keeps the rod on its mount, (..., k) in the order of `part_names`; a flight ends where one is < 0.

    On a hub, `clearances`; in a cup, the signed distance of the rod's end to the cup's cone (m) and the force of the
    rod on its cup (N); nothing on a gimbal. `state` and `wrench` are NumPy batches or CasADi expressions in the frame
    `e3`.
    """
    push = -rod_tension(state, wrench, vehicle)
    return margins_of(rod_in_body(state, e3)[0], push, vehicle)


def margins_of(rod: Vector, push: Scalar, vehicle: Vehicle) -> Numbers:
    """Return `margins` for the `rod` (..., 3) in the e₃-up body frame and its `push` (...,) on the vehicle, N."""
    symbolic = is_symbolic(rod)
    if vehicle.mount == "hub":
        return clearances(rod, vehicle.rotors_from_pivot, vehicle.reach, vehicle.body)
    if vehicle.mount == "cup":
        room = _to_cone(rod[2] if symbolic else rod[..., 2], vehicle)
        return ca.vertcat(room, push) if symbolic else np.stack([room, push], axis=-1)
    return ca.SX(0, 1) if symbolic else np.zeros((*rod.shape[:-1], 0))


def least_margin(rod: Vector, push: Scalar, vehicle: Vehicle) -> tuple[Scalar, Scalar, Scalar]:
    """Return the smallest entry of `margins_of`, its place, and the clearance, the smallest distance, in CasADi.

    Among rotors of equal height and distance from the pivot, disc and arm in whose direction the rod points most are
    the nearest; the others are left out.
    """
    centres = vehicle.rotors_from_pivot
    if vehicle.mount != "hub" or not _alike(centres):
        margins = margins_of(rod, push, vehicle)
        least, place = _smallest(margins)
        return least, place, least if vehicle.mount == "hub" else margins[0]  # a force is no distance
    _, at = _smallest(ca.vertcat(*(-_inner(rod, centre) for centre in centres)))
    nearest = [sum(ca.if_else(at == k, c[i], 0) for k, c in enumerate(centres)) for i in (0, 1)]
    disc = _to_disc(rod, [*nearest, float(centres[0, 2])], vehicle.reach, vehicle.body)
    length = float(np.linalg.norm(centres[0]))
    along = (_inner(rod, [*nearest, float(centres[0, 2])])) / length
    arm = _to_arm(along, vehicle.body)
    least = ca.fmin(disc, arm)
    return least, ca.if_else(disc <= arm, at, at + len(centres)), least


def _alike(centres: Numbers) -> bool:
    """Whether all rotors are as high, and as far from the pivot."""
    distances = np.linalg.norm(centres, axis=1)
    return bool(np.allclose(centres[:, 2], centres[0, 2]) and np.allclose(distances, distances[0]))


def _smallest(values: Numbers) -> tuple[Scalar, Scalar]:
    """Smallest entry and its place."""
    value, place = values[0], ca.SX(0)
    for i in range(1, values.numel()):
        place = ca.if_else(values[i] < value, i, place)
        value = ca.fmin(values[i], value)
    return value, place


def rod_in_body(state: State, e3: E3Direction) -> tuple[Vector, Vector]:
    """Return the rod Rᵀy and its rate Rᵀẏ − ω × Rᵀy (1/s), each (..., 3), in the e₃-up body frame.

    `state` is in the frame `e3`, whose body frame points e₃ down along with the world's.
    """
    turned = transpose(state.R)
    rod = apply(turned, state.y)
    rate = apply(turned, state.y_dot) - cross(state.omega, rod)
    return (rod, rate) if e3 == "up" else (apply(FLIP, rod), apply(FLIP, rate))


def part_names(vehicle: Vehicle) -> list[str]:
    """Return the names of the parts of `margins`."""
    count = range(1, 1 + len(vehicle.rotor_spins))
    if vehicle.mount == "hub":
        return [f"disc {i}" for i in count] + [f"arm {i}" for i in count]
    return ["cone", "cup"] if vehicle.mount == "cup" else []


def _to_cone(cosine: Scalar, vehicle: Vehicle) -> Scalar:
    """Signed distance of the rod's far end to the cone of the cup, m."""
    sine = _sqrt(_most(1 - cosine**2, 0.0))
    angle = vehicle.body.cup_angle
    inside = vehicle.reach * (np.sin(angle) * cosine - np.cos(angle) * sine)
    return _where(cosine > -np.sin(angle), inside, -vehicle.reach)  # nearest to the apex beyond


def clearances(rod: Vector, centres: Numbers, length: float, body: Body) -> Numbers:
    """Return the signed distances (..., 2n) from the rod to the n rotor discs, then to the n arms, m.

    Negative values are depths: of the rod's surface inside a disc's rim or an arm.

    Parameters
    ----------
    rod : (..., 3)
        Unit vectors from the pivot along the rod, in the e₃-up body frame; NumPy, or a CasADi vector (3, 1).
    centres : (n, 3)
        Centres of the rotor discs relative to the pivot, body frame, m.
    length : float
        Length of the rod, m.
    body : Body
        The radii.
    """
    discs = [_to_disc(rod, centre, length, body) for centre in centres]
    lengths = np.linalg.norm(centres, axis=1)  # 0 at the pivot: no arm there, or one on the other side
    arms = [_to_arm(_inner(rod, c) / (s or 1.0) - float(s == 0), body) for c, s in zip(centres, lengths, strict=True)]
    return ca.vertcat(*discs, *arms) if is_symbolic(rod) else np.stack([*discs, *arms], axis=-1)


def _to_arm(cosine: Scalar, body: Body) -> Scalar:
    """Signed distance to an arm at an angle of this `cosine` to the rod.

    Two rays from one point are closest where they begin, here at the hub's rim: 2 r sin(θ/2) apart.
    """
    chord = _sqrt(_most(2 * (1 - cosine), 0.0))  # 2 sin(θ/2)
    return body.hub_radius * chord - (body.arm_radius + body.rod_radius)


def _to_disc(rod: Vector, centre: Vector, length: float, body: Body) -> Scalar:
    """Signed distance from the rod to a flat disc about `centre`, normal to the body's e₃.

    The distance to a convex body is convex along a line. Within the cylinder over the disc it is |height|, linear on
    either side of the disc; where the rod leaves the cylinder its derivative tells on which side the minimum lies.
    """
    u = [rod[i] if is_symbolic(rod) else rod[..., i] for i in range(3)]
    c = list(centre)
    first, last = body.hub_radius, length
    entry, leaving, meets = _cylinder(u, c, body.disc_radius)
    before = (entry * u[2] - c[2]) * u[2] >= 0  # the distance rises where the rod enters the cylinder
    after = (leaving * u[2] - c[2]) * u[2] <= 0
    low = _where(meets, _where(before, first, _where(after, leaving, entry)), first)
    high = _where(meets, _where(before, entry, _where(after, last, leaving)), last)
    low, high = clip(low, first, last), clip(high, first, last)
    flat = _both(u[2] < 1e-12, u[2] > -1e-12)
    crossing = clip(_where(flat, entry, c[2] / _where(flat, 1.0, u[2])), first, last)
    s = _where(meets, _where(before, high, _where(after, low, crossing)), clip(_inner(rod, c), first, last))
    for _ in range(ITERATIONS):
        slope, curvature = _slope(s, u, c, body.disc_radius)
        low, high = _where(slope < 0, s, low), _where(slope < 0, high, s)
        s = clip(s - slope / _most(curvature, 1e-12), low, high)
    from_axis = _sqrt((s * u[0] - c[0]) ** 2 + (s * u[1] - c[1]) ** 2)
    beyond, above = from_axis - body.disc_radius, s * u[2] - c[2]
    distance = _sqrt(_most(beyond, 0.0) ** 2 + above**2)
    return _where(distance > 0, distance, _least(beyond, 0.0)) - body.rod_radius


def _cylinder(u: Vector, c: Vector, radius: float) -> tuple[Scalar, Scalar, Scalar]:
    """Where the line s u enters and leaves the cylinder over the disc, and whether it meets it."""
    level = _most(u[0] ** 2 + u[1] ** 2, 1e-18)
    middle = (u[0] * c[0] + u[1] * c[1]) / level
    half = middle**2 - (c[0] ** 2 + c[1] ** 2 - radius**2) / level
    root = _sqrt(_most(half, 0.0))
    return middle - root, middle + root, half > 0


def _slope(s: Scalar, u: Vector, c: Vector, radius: float) -> tuple[Scalar, Scalar]:
    """First and second derivative of half the squared distance from the point s u to the disc."""
    p = [s * u[i] - c[i] for i in range(3)]
    from_axis = _sqrt(p[0] ** 2 + p[1] ** 2 + 1e-18)
    beyond = _most(from_axis - radius, 0.0)
    outward = (p[0] * u[0] + p[1] * u[1]) / from_axis
    level = u[0] ** 2 + u[1] ** 2
    bent = _where(beyond > 0, outward**2 + beyond * (level - outward**2) / from_axis, 0.0)
    return beyond * outward + p[2] * u[2], bent + u[2] ** 2


def _inner(rod: Vector, fixed: Vector) -> Scalar:
    return sum((rod[i] if is_symbolic(rod) else rod[..., i]) * fixed[i] for i in range(3))


def _most(a: Scalar, b: Scalar) -> Scalar:
    return ca.fmax(a, b) if is_symbolic(a) or is_symbolic(b) else np.maximum(a, b)


def _least(a: Scalar, b: Scalar) -> Scalar:
    return ca.fmin(a, b) if is_symbolic(a) or is_symbolic(b) else np.minimum(a, b)


def _sqrt(a: Scalar) -> Scalar:
    return ca.sqrt(a) if is_symbolic(a) else np.sqrt(a)


def _where(condition: Scalar, yes: Scalar, no: Scalar) -> Scalar:
    return ca.if_else(condition, yes, no) if is_symbolic(condition) else np.where(condition, yes, no)


def _both(a: Scalar, b: Scalar) -> Scalar:
    return ca.logic_and(a, b) if is_symbolic(a) else a & b
