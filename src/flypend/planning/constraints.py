"""`Constraints`: what a flight keeps, and whether its states keep it: the last word before a plan may be flown."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, NamedTuple, TypedDict

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from flypend import errors
from flypend.errors import InputError
from flypend.flight.touch import reason_of
from flypend.geometry import norm
from flypend.laws.references import Reference, check_reference
from flypend.model import State, Vehicle, Wrench
from flypend.model.mount import margins
from flypend.model.state import SIZE
from flypend.planning.dynamics import Array
from flypend.planning.window import NEAR, Window

CLEARANCE = 0.01  # m
TOLERANCE = 1e-3  # rod lengths, by which a limit may be exceeded
OWN_TOLERANCE = 1e-3  # the same of `Constraints.keep`, in its unit


# What is 0 or 1: constant but for jumps, so that no solver sees which way leads to it.
TRUTHS = (ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NE, ca.OP_NOT, ca.OP_AND, ca.OP_OR)


class Motion(NamedTuple):
    """What constraints and costs of one's own are made of: CasADi expressions in SI units, world frame with e₃ up."""

    x: Any  # (3, 1), m: position of the pivot
    x_dot: Any  # (3, 1), m/s
    R: Any  # (3, 3): rotation from body to world
    omega: Any  # (3, 1), body frame, rad/s
    y: Any  # (3, 1): direction of the rod, from the pivot to the bob
    y_dot: Any  # (3, 1), 1/s
    rotor_forces: Any  # (n, 1), N


Own = Callable[[Motion], Any]


class Keywords(TypedDict, total=False):
    """The fields of `Constraints`, given one by one."""

    box: ArrayLike | None
    floor: float | None
    ceiling: float | None
    speed: float | None
    lean: float | None
    window: Window | Sequence[Window] | None
    waypoints: ArrayLike | None
    path: Reference | None
    clearance: float | None
    keep: Own | None
    cost: Own | None


FIELDS = tuple(Keywords.__annotations__)


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Constraints:
    """Constraints on a flight, beside the limits of its rotors; SI units, world frame with e₃ up.

    Parameters
    ----------
    box : (2, 3), optional
        Lowest and highest corner of a box that pivot and rod stay in, m; infinite entries for no wall.
    floor, ceiling : float, optional
        Lowest and highest height of pivot and rod, m.
    speed : float, optional
        Largest speed of the pivot, m/s.
    lean : float, optional
        Largest angle between the rod and the vertical, rad: π/2 keeps it above the horizon.
    window : Window or several, optional
        Openings in walls between start and target, to fly through: rod and machine keep clear of the frame.
    waypoints : (k, 3), optional
        Points that the pivot passes, one after the other on the way from start to target, within a twentieth of the
        rod's length, m.
    path : callable, optional
        Where the pivot is to be, m, as a function of time, with CasADi's functions (see `laws.references`): circles,
        figures of eight. The excursion is measured from it. It takes the `duration` of the plan, and ends in hover.
    clearance : float, optional
        Distance that the rod of a hub or cup keeps from what it can touch, and the machine from a window's frame, m;
        default 0.01.
    keep : callable, optional
        A constraint of your own: a function of `m`, with m.x, m.x_dot, m.R, m.omega, m.y, m.y_dot as in `State` and
        m.rotor_forces (N). It returns one or several CasADi expressions that must stay ≥ 0. They are kept to within
        0.001, so scale them to the order of one. They must be smooth wherever the flight may go, and positive at the
        start and in hover at the target.
    cost : callable, optional
        A cost of your own, besides the objective: like `keep`, a function of `m` that returns one or several
        expressions. Half the sum of their squares, integrated over time in units of √(l/g), is added. For scale: an
        excursion of one rod length has the weight 1.

    Attributes
    ----------
    given : dict
        The fields that were named, as they were.
    walls : (2, 3), optional
        Lowest and highest corner, m, of the box with floor and ceiling; None without a wall.
    windows : tuple of Window
        The windows, none or several.
    points : (k, 3)
        The waypoints, m, none or several.

    Raises
    ------
    InputError
        If a field is out of range, or the lowest corner not below the highest.
    """

    box: ArrayLike | None = None
    floor: float | None = None
    ceiling: float | None = None
    speed: float | None = None
    lean: float | None = None
    window: Window | Sequence[Window] | None = None
    waypoints: ArrayLike | None = None
    path: Reference | None = None
    clearance: float | None = None
    keep: Own | None = None
    cost: Own | None = None
    given: dict[str, Any] = field(init=False, repr=False)
    walls: Array | None = field(init=False, repr=False)
    windows: tuple[Window, ...] = field(init=False, repr=False)
    points: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        given = {name: value for name in FIELDS if (value := getattr(self, name)) is not None}
        apart = errors.number("clearance", given.get("clearance", CLEARANCE), at_least=0, unit="m")
        for height in ("floor", "ceiling"):
            if height in given:
                errors.number(height, given[height], unit="m")
        if self.speed is not None:
            errors.number("speed", self.speed, above=0, unit="m/s")
        if self.lean is not None and errors.number("lean", self.lean, above=0, unit="rad") > np.pi:
            raise InputError("lean", f"at most {angle(np.pi)}", angle(self.lean))
        check_reference(self.path, "path")
        for name in ("keep", "cost"):
            if name in given:
                try_rotors(partial(own_function, given[name], name=name))
        points = np.zeros((0, 3)) if self.waypoints is None else errors.array("waypoints", self.waypoints, (None, 3))
        walls, windows = self._walls(), _several(self.window)
        found = {"given": given, "walls": walls, "windows": windows, "points": points, "clearance": apart}
        for name, value in found.items():
            object.__setattr__(self, name, value)

    @property
    def loose(self) -> bool:
        """Whether a flight that ignores these constraints often keeps them: walls, a speed, or your own."""
        return not {"box", "floor", "ceiling", "speed", "keep"}.isdisjoint(self.given) and not (
            self.windows or self.lean or len(self.points)
        )

    def _walls(self) -> Array | None:
        walls = np.array([[-np.inf] * 3, [np.inf] * 3])
        if self.box is not None:
            try:
                walls = np.array(self.box, dtype=float)
            except (TypeError, ValueError):
                walls = np.array(np.nan)
            if walls.shape != (2, 3) or np.any(np.isnan(walls)):
                raise InputError("box", "numbers of shape (2, 3)", repr(self.box)[:80])
            if np.any(walls[0] >= walls[1]):
                raise InputError("box", "a lowest corner below the highest", walls.tolist())
        if self.floor is not None and self.ceiling is not None and self.floor >= self.ceiling:
            raise InputError("floor", f"a height below the ceiling, {self.ceiling:g} m", f"{self.floor:g}")
        walls[0, 2] = max(walls[0, 2], -np.inf if self.floor is None else self.floor)
        walls[1, 2] = min(walls[1, 2], np.inf if self.ceiling is None else self.ceiling)
        if walls[0, 2] >= walls[1, 2]:
            raise InputError("floor, ceiling", "a lowest corner below the highest", walls.tolist())
        return None if np.all(np.isinf(walls)) else walls


def try_rotors(attempt: Callable[[int], Any]) -> None:
    """Call `attempt` with numbers of rotors until one is accepted, since the vehicle's is not known yet.

    Raises the InputError of four if none is.
    """
    refusals = []
    for rotors in range(4, 13):
        try:
            attempt(rotors)
        except InputError as error:
            refusals.append(error)
        else:
            return
    raise refusals[0]


def own_function(own: Own, rotors: int, name: str) -> ca.Function:
    """Return the field `name`, with so many `rotors`, as (packed state (24,), rotor forces, N) → values (k, 1).

    Raises InputError unless it gives expressions of what it is given.
    """
    packed, forces = ca.SX.sym("s", SIZE), ca.SX.sym("f", rotors)
    s, what = State.symbolic(packed), "a function of a Motion that gives CasADi expressions"
    try:
        values = own(Motion(s.x, s.x_dot, s.R, s.omega, s.y, s.y_dot, forces))
        values = ca.vertcat(*values) if isinstance(values, list | tuple) else ca.SX(values)
        function = ca.Function(name, [packed, forces], [ca.densify(ca.vec(values))])
    except Exception as error:
        raise InputError(name, what, f"one that fails: {type(error).__name__}: {error}"[:160]) from error
    if not values.numel():
        raise InputError(name, what, "one that gives none")
    if any(value.op() in TRUTHS for value in ca.vertsplit(ca.vec(ca.densify(ca.SX(values))))):
        raise InputError(name, "values such as a difference, which change along the way", "a comparison: 0 or 1")
    return function


def _several(window: Any) -> tuple[Window, ...]:
    """Return windows, none or several, of the field `window`. Raises InputError."""
    several = () if window is None else (window,) if isinstance(window, Window) else window
    if not isinstance(several, list | tuple) or not all(isinstance(each, Window) for each in several):
        raise InputError("window", "a Window, or several", repr(window)[:80])
    return tuple(several)


def gather(function: str, constraints: Constraints | None, keywords: Mapping[str, Any]) -> Constraints:
    """Return the `constraints` of a call of `function` with the fields that were given one by one, `keywords`.

    Raises InputError if a field is unknown or given in both ways.
    """
    errors.only_known(function, keywords, FIELDS)
    given = {} if constraints is None else constraints.given
    for name in keywords:
        if name in given:
            raise InputError(name, "one value, by itself or in constraints", "two")
    return Constraints(**given, **keywords)


def angle(radians: float) -> str:
    """Return an angle in both units: the command takes degrees."""
    return f"{radians:.3g} rad ({np.degrees(radians):.4g}°)"


def broken(packed: Array, rotor_forces: Array, vehicle: Vehicle, kept: Constraints) -> str:
    """Return what the states `packed` (n, 24) with `rotor_forces` (n, k) of `vehicle` break most of `kept`; or "".

    A length or, in m/s, a speed or, in rad, an angle may be exceeded by `TOLERANCE`, what is one's own by
    `OWN_TOLERANCE`. The mount's limits count too: what the rod touches ends a flight.
    """
    state, tolerance = State.trusted(packed), TOLERANCE * vehicle.l
    if kept.walls is not None:
        points = np.stack([state.x, state.x + vehicle.reach * state.y])
        out = float(np.max(np.maximum(kept.walls[0] - points, points - kept.walls[1])))
        if out > tolerance:
            return f"the box is left by {out:.3g} m"
    if kept.speed is not None and (over := float(np.max(norm(state.x_dot))) - kept.speed) > tolerance:
        return f"the speed is exceeded by {over:.3g} m/s"
    if kept.lean is not None and (over := float(np.arccos(np.min(state.y[:, 2]))) - kept.lean) > tolerance:
        return f"the rod leans {angle(over)} too far"
    for window in kept.windows:
        if (room := float(np.min(window.room(state, vehicle)))) < 0:
            return f"the frame of a window is {-room:.3g} m too near"
    for point in kept.points:
        if (off := float(np.min(norm(state.x - point)))) > NEAR * vehicle.l:
            return f"a waypoint is missed by {off:.3g} m"
    return _own_broken(packed, rotor_forces, kept) or _touched_part(state, rotor_forces, vehicle)


def _own_broken(packed: Array, rotor_forces: Array, kept: Constraints) -> str:
    """Return by how much a constraint of one's own is broken; or ""."""
    if kept.keep is None:
        return ""
    values = np.array(own_function(kept.keep, rotor_forces.shape[1], "keep")(packed.T, rotor_forces.T))
    lacking = -float(np.min(values))
    return "" if lacking <= OWN_TOLERANCE else f"keep is broken by {lacking:.3g}"  # NaN breaks it, too


def begins_touching(packed: Array, rotor_forces: Array, vehicle: Vehicle) -> str:
    """Return what the rod touches at the first of the states `packed` (n, 24), from where no plan leads; or ""."""
    found = _touched_part(State.trusted(packed[:1]), rotor_forces[:1], vehicle)
    return found and f"{found} at the start"


def _touched_part(state: State, rotor_forces: Array, vehicle: Vehicle) -> str:
    """Return what the rod of `vehicle` touches most in a batch of states with `rotor_forces` (n, k); or ""."""
    if vehicle.mount == "gimbal":
        return ""
    wrench = rotor_forces @ vehicle.mixing().T
    found = margins(state, Wrench(wrench[:, 0], wrench[:, 1:]), vehicle, "up")
    least = np.min(found, axis=0)
    return reason_of(vehicle, int(np.argmin(least))) if np.min(least) < 0 else ""
