"""What is to be planned: checked, and in the machine's own units."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import E3, norm
from flypend.laws.references import check_reference, sample
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.planning.constraints import Constraints, angle, begins_touching, own_function
from flypend.planning.dynamics import Array, Units
from flypend.planning.inequalities import END, Structure
from flypend.planning.window import gates_at, through

STAGES_PER_UNIT = 12  # of √(l/g): 20 ms on hehn2011
TIGHTER = 3e-3  # by so much the height of the rod is kept above its limit, so that it is kept between stages too
HATCH = 0.1  # least level part of the normal of a window in which guesses lean
FAR = 1e6  # rod lengths: no wall
# The less the way matters beside the end, the fewer iterations the least time takes; some, or the machine wanders off.
# Each objective has a little of the other, without which its problem has no unique solution.
LEAST = {"excursion": 1e-3, "effort": 1e-4}
OBJECTIVES: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {"cost": {}, "excursion": {"excursion": 1.0}, "effort": {"effort": 1.0}, "time": {"excursion": 0.03}}
)


@dataclass(frozen=True)
class Request:
    """What is to be planned."""

    vehicle: Vehicle
    units: Units
    objective: dict[str, float]  # weights of "excursion" and "effort"
    target: Array  # (3,): where the pivot is to hover, m
    end: State  # how it is to end there
    start: Array  # (24 + n,): state and rotor forces at the start, own units, about the target
    kept: Constraints  # what every sample of the plan must keep
    structure: Structure  # the inequalities,
    numbers: Array  # and their numbers (k,), own units, about the target
    again: bool = False  # whether guesses that lean in windows are to lean in other ways; see `guess.WAYS`

    def places(self, t: Array) -> Array:
        """Return where the pivot is to be at times `t` (n,), (n, 3), own units."""
        assert self.kept.path is not None
        places: Array = (sample(self.kept.path, t * self.units.time) - self.target) / self.units.length
        return places

    @property
    def rotors(self) -> int:
        """Number of rotors."""
        return len(self.vehicle.rotor_spins)

    @property
    def constrained(self) -> bool:
        """Whether there are inequalities beyond those of the machine."""
        return self.structure != self.without_constraints().structure

    @property
    def begins_touching(self) -> bool:
        """Whether the rod touches something at the start, from where no plan leads."""
        start = self.start * self.units.states(self.rotors)
        return bool(begins_touching(start[None, :SIZE], start[None, SIZE:], self.vehicle))

    @property
    def falls(self) -> bool:
        """Whether the rod may fall and be pumped up again."""
        return not self.structure.lean and self.vehicle.mount != "cup"

    @property
    def leaning(self) -> bool:
        """Whether guesses are to lean in windows: where the rod may not fall, upright is a saddle."""
        walls = self.kept.windows
        level = all(float(np.hypot(*window.axes[2, :2])) > HATCH for window in walls)
        return self.structure.lean and len(walls) > 0 and level

    def without_constraints(self) -> Request:
        """The same within the limits of the machine alone; what comes of it is still held against `kept`."""
        its = self.structure
        free = Structure(path=its.path, cost=its.cost, end=its.end, mounted=its.mounted)
        numbers = [self.numbers[its.slices[name]] for name in free.slices]
        return replace(self, structure=free, numbers=np.concatenate(numbers))

    @property
    def waits(self) -> bool:
        """Whether it can stay as it is at the end: in hover, with the rod upright or hanging."""
        return _still(self.end)

    @property
    def rest(self) -> Array:
        """The end (24 + n,) with the forces of hover, own units, about the target."""
        state = self.end.packed()
        state[:3] = 0
        return np.append(state, np.full(self.rotors, self.units.force)) / self.units.states(self.rotors)


def request(
    vehicle: Vehicle,
    start: State,
    objective: str | Mapping[str, float],
    target: ArrayLike | State,
    rotors: ArrayLike | None = None,
    kept: Constraints | None = None,
) -> Request:
    """Check the arguments of `planning.plan`, and turn them into the machine's units. Raises InputError.

    `kept` is what the flight keeps, by default the limits of the machine alone.
    """
    kept = kept or Constraints()
    walls, speed, lean = kept.walls, kept.speed, kept.lean
    if not isinstance(vehicle, Vehicle):
        raise InputError("vehicle", "a Vehicle", repr(vehicle)[:80])
    vehicle.sharing()  # hover is the same force of each rotor
    if not isinstance(start, State) or start.batch_shape:
        raise InputError("start", "a single State", repr(start)[:80])
    vehicle = vehicle.commanded()
    units, n = Units.of(vehicle), len(vehicle.rotor_spins)
    low, high = (float(limit) for limit in vehicle.rotor_limits)
    if n * high <= vehicle.weight:
        raise InputError("vehicle", f"rotors that lift {vehicle.weight:.3g} N", f"{n * high:.3g} N at most")
    weights, end = weights_of(objective), _end(target)
    goal, ends = end.x, (start, end)
    per_command = weights["effort"] / STAGES_PER_UNIT / n
    numbers = [weights["excursion"], per_command, low / units.force, high / units.force]
    numbers.append(spin_tolerance(vehicle, units))
    other = _other_end(end, units)
    numbers += other
    if kept.keep is not None or kept.cost is not None:
        numbers += [*goal, units.length, units.time, units.force, STAGES_PER_UNIT**-0.5]
    if walls is not None:
        _check_inside(walls, vehicle, start.x, start.y, "start")
        _check_inside(walls, vehicle, goal, end.y, "target")
        numbers += [vehicle.reach / units.length, *np.clip((walls - goal) / units.length, -FAR, FAR).ravel()]
    if speed is not None:
        _check_below("speed", speed, [float(norm(state.x_dot)) for state in ends], "{:.3g} m/s".format)
        numbers.append(speed * units.time / units.length)
    if lean is not None:
        _check_below("lean", lean, [float(np.arccos(np.clip(state.y[2], -1, 1))) for state in ends], angle)
        lowest = np.cos(lean)
        numbers.append(lowest + min(TIGHTER, (float(start.y[2]) - lowest) / 2))
    forces = _forces(rotors, low, high, n)
    keep, cost = _own(kept, objective, {"start": (start, forces), "target": (end, np.full(n, units.force))}, n)
    apart, windows, points = kept.clearance or 0.0, kept.windows, kept.points
    route = (start, *(State(x=point, y=E3) for point in points), end)
    gates = [*(through(each, vehicle, route, goal, apart) for each in windows), *gates_at(points, vehicle, ends, goal)]
    structure = Structure(
        box=walls is not None, speed=speed is not None, lean=lean is not None, path=kept.path is not None,
        gates=len(gates), keep=keep, cost=cost, end=bool(other),
        mounted=None if vehicle.mount == "gimbal" else vehicle,
    )  # fmt: skip
    soft = [0.0, apart / units.length] if structure.soft else []
    packed = start.packed()
    packed[:3] -= goal
    begin = np.append(packed, forces) / units.states(n)
    return Request(vehicle, units, weights, goal, end, begin, kept, structure, np.concatenate([numbers, *gates, soft]))


def end_of(path: Any, duration: Any, target: Any, objective: Any = None) -> Any:
    """Return the `target`, or the end of a `path` of that `duration` (s). Raises InputError."""
    check_reference(path, "path")
    if path is None:
        return (0.0, 0.0, 0.0) if target is None else target
    if objective == "time":
        raise InputError("objective", "another beside a path, which takes the duration", "'time'")
    if duration is None:
        raise InputError("duration", "the time that the path takes, s", "nothing")
    if target is not None:
        raise InputError("target", "nothing beside a path, at whose end the pivot hovers", repr(target)[:80])
    return sample(path, np.array([errors.number("duration", duration, above=0, unit="s")]))[0]


def _check_inside(walls: Any, vehicle: Vehicle, x: Any, y: Any, where: str) -> None:
    """Raise InputError unless pivot `x` and rod `y` (both (..., 3)) are within `walls` (2, 3), m."""
    points = np.stack([x, x + vehicle.reach * y])
    if np.any(points <= walls[0]) or np.any(points >= walls[1]):
        field = "floor, ceiling" if np.all(np.isinf(walls[:, :2])) else "box"
        raise InputError(field, f"room for pivot and rod at the {where}, from corner to corner", walls.tolist())


def _own(kept: Constraints, objective: Any, ends: Mapping[str, tuple[State, Array]], rotors: int) -> list[str]:
    """Return the functions of one's own, keep and cost, as CasADi writes them, "" for none.

    Raises InputError if the objective is a cost that is not given, or keep is not positive at the `ends`.
    """
    if objective == "cost" and kept.cost is None:
        raise InputError("cost", "the cost that is the objective", "nothing")
    keep, cost = (own and own_function(own, rotors, name) for name, own in (("keep", kept.keep), ("cost", kept.cost)))
    if keep:
        for where, (state, forces) in ends.items():
            least = float(np.min(np.array(keep(state.packed(), forces))))
            if not least > 0:
                raise InputError("keep", f"values above 0 at the {where}", f"{least:.3g}")
    return ["" if own is None else str(own.serialize()) for own in (keep, cost)]


def _end(target: Any) -> State:
    """Return the state in which a plan ends at a `target`. Raises InputError."""
    if not isinstance(target, State):
        return State(x=errors.array("target", target, (3,)), y=E3)
    if target.batch_shape:
        raise InputError("target", "a position or a single State", repr(target)[:80])
    return target


def _other_end(end: State, units: Units) -> list[float]:
    """Return the numbers of an `end` that is not hover upright, own units; none if it is."""
    inverted = State(x=end.x, R=end.R, y=E3)
    if np.array_equal(inverted.packed(), end.packed()) and end.z[2] == 1:
        return []
    rates = end.x_dot * units.time / units.length, end.z, end.omega * units.time, end.y, end.y_dot * units.time
    return [*np.concatenate(rates), float(_still(end))]


def _still(end: State) -> bool:
    """Whether hover can stay in the state `end`, with the rod upright or hanging."""
    return not np.any(np.concatenate([end.x_dot, end.omega, end.y_dot, end.z[:2], end.y[:2]])) and bool(end.z[2] > 0)


def _check_below(name: str, limit: float, values: Sequence[float], write: Callable[[float], str]) -> None:
    """Raise InputError unless the limit `name` is above the `values` at start and target; `write` writes them."""
    for value, where in zip(values, ("start", "target"), strict=True):
        if value >= limit:
            raise InputError(name, f"more than the {write(value)} of the {where}", write(limit))


def _forces(rotors: Any, low: float, high: float, n: int) -> Any:
    """Return the `n` rotor forces at the start, N, by default the least. Raises InputError."""
    forces = np.full(n, low) if rotors is None else errors.array("rotors", rotors, (n,))
    if np.any(forces < low) or np.any(forces > high):
        raise InputError("rotors", f"forces from {low:g} to {high:g} N", forces.tolist())
    return forces


def spin_tolerance(vehicle: Vehicle, units: Units) -> float:
    """Return the tolerance of the spin about the thrust axis at the end, own units.

    It is that of the other axes if rotor drag can change the spin by a unit in a unit of time. With less, the spin of a
    start outlasts any plan, and hover does not need it to end.
    """
    low, high = vehicle.rotor_limits
    authority = np.sum(np.abs(vehicle.mixing()[3])) * (high - low) / 2 / vehicle.I[2, 2] * units.time**2
    return END["omega"] * max(1.0, 1 / float(authority))


def weights_of(objective: Any) -> dict[str, float]:
    """Return the weights of excursion and effort. Raises InputError."""
    if isinstance(objective, Mapping):
        errors.only_known("objective", objective, LEAST)
        given = {name: errors.number(f"objective.{name}", value, at_least=0) for name, value in objective.items()}
        if not any(given.values()):
            raise InputError("objective", "a weight > 0", dict(objective))
    else:
        given = dict(OBJECTIVES[errors.one_of("objective", objective, OBJECTIVES)])
    return {name: max(given.get(name, 0.0), least) for name, least in LEAST.items()}
