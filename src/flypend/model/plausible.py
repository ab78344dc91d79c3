"""Numbers of a vehicle that no machine has, and the unit that was probably meant: g, mm, g·mm², ms.

Each rule compares a number with what the vehicle's other numbers make of it, so that machines of any size pass.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from operator import attrgetter
from typing import Any

import numpy as np

from flypend.errors import InputError

EARTH = 9.81  # m/s²; not the vehicle's gravity, which may be that of the Moon
LENGTHS = {"mm": 1e-3, "cm": 1e-2}
MASSES = {"g": 1e-3}
INERTIAS = {"g·mm²": 1e-9, "kg·mm²": 1e-6, "g·cm²": 1e-7, "kg·cm²": 1e-4}
FORCES = {"gf": 9.81e-3, "mN": 1e-3}
TIMES = {"ms": 1e-3}
ACCELERATIONS = {"cm/s²": 1e-2, "mm/s²": 1e-3}


@dataclass(frozen=True)
class Rule:
    """A ratio that every machine keeps within limits.

    Parameters
    ----------
    what, because : str
        What the ratio is, and why it has its limits.
    ratio : callable
        Vehicle → ratio; NaN where there is nothing to compare.
    usual, low, high : float
        The ratio of a common machine, and its limits.
    suspects : tuple of (field, units)
        Numbers that may be in another unit, and factors to SI by unit.
    """

    what: str
    because: str
    ratio: Callable[[Any], Any]
    usual: float
    low: float
    high: float
    suspects: tuple[tuple[str, dict[str, float]], ...]


def arm(vehicle: Any) -> np.float64:
    """Return the largest distance of a rotor from the centre of mass, m: a number that may overflow without raising."""
    return np.float64(np.max(np.linalg.norm(vehicle.rotor_positions, axis=1)))


def _over_arm(vehicle: Any, name: str) -> float:
    """Return the ratio of a radius of the body to the nearest rotor's distance from the pivot."""
    distances = np.linalg.norm(vehicle.rotor_positions - vehicle.pivot_offset, axis=1)
    nearest = np.min(distances[distances > 0])  # one in the middle has no arm
    return float(getattr(vehicle.body, name) / nearest) if vehicle.body is not None else np.nan


# Limits are a hundred times from what machines have, a thousand where the factor of the wrong unit is larger still;
# radii of the body are geometry.
RULES: tuple[Rule, ...] = (
    Rule(
        "gravity, in that of the Earth,", "the Sun has 28",
        lambda v: v.gravity / EARTH, 1.0, 0.0, 50.0, (("gravity", ACCELERATIONS),),
    ),
    Rule(
        "thrust of all rotors over weight", "multirotors have 1.5 to 15",
        lambda v: v.thrust_scale * len(v.rotor_spins) * v.rotor_limits[1] / ((v.mass + v.bob_mass) * EARTH),
        2.0, 0.02, 200.0,
        (("mass", MASSES), ("bob_mass", MASSES), ("rotor_limits", FORCES)),
    ),
    Rule(
        "mass of the rod over that of the vehicle", "rods have 0.01 to 1",
        lambda v: v.bob_mass / v.mass, 0.1, 0.0, 30.0, (("bob_mass", MASSES),),
    ),
    Rule(
        "length of the rod over that of an arm", "rods have 1 to 12",
        lambda v: v.rod_length / arm(v), 4.0, 0.02, 150.0, (("rod_length", LENGTHS), ("rotor_positions", LENGTHS)),
    ),
    Rule(
        "end of the rod over its centre of mass", "a uniform rod has 2",
        lambda v: (v.rod_end or v.rod_length) / v.rod_length, 2.0, 0.0, 200.0,
        (("rod_end", LENGTHS), ("rod_length", LENGTHS)),
    ),
    Rule(
        "moment of inertia over mass times arm²", "machines have 0.1 to 4",
        lambda v: np.max(np.linalg.eigvalsh(v.inertia)) / (v.mass * arm(v) ** 2), 0.4, 1e-3, 100.0,
        (("inertia", INERTIAS), ("rotor_positions", LENGTHS), ("mass", MASSES)),
    ),
    Rule(
        "moment of inertia of the rod over its mass times (rod + arm)²", "rods have at most 1",
        lambda v: v.rod_inertia / (v.bob_mass * ((v.rod_end or v.rod_length) + arm(v)) ** 2), 0.1, 0.0, 100.0,
        (("rod_inertia", INERTIAS),),
    ),
    Rule(
        "torque per thrust over arm", "propellers have 0.02 to 0.5",
        lambda v: v.drag_ratio / arm(v), 0.1, 0.0, 20.0, (("drag_ratio", LENGTHS),),
    ),
    Rule(
        "lag of the rotors over √(l/g)", "rotors have 0.02 to 0.4",
        lambda v: v.rotor_lag / np.sqrt(v.rod_length / EARTH), 0.1, 0.0, 20.0, (("rotor_lag", TIMES),),
    ),
    Rule(
        "offset of the pivot over arm", "mounts have 0 to 1",
        lambda v: float(np.linalg.norm(v.pivot_offset)) / arm(v), 0.1, 0.0, 10.0, (("pivot_offset", LENGTHS),),
    ),
    Rule(
        "radius of the hub over the distance of the nearest rotor", "arms reach from the hub to the rotors",
        lambda v: _over_arm(v, "hub_radius"), 0.2, 0.0, 1.0, (("body.hub_radius", LENGTHS),),
    ),
    Rule(
        "radius of an arm over its length", "arms are slender",
        lambda v: _over_arm(v, "arm_radius"), 0.04, 0.0, 1.0, (("body.arm_radius", LENGTHS),),
    ),
    Rule(
        "radius of the rod over its length", "rods are slender",
        lambda v: np.nan if v.body is None else v.body.rod_radius / (v.rod_end or v.rod_length), 0.01, 0.0, 1.0,
        (("body.rod_radius", LENGTHS),),
    ),
)  # fmt: skip


def check_plausible(vehicle: Any) -> None:
    """Raise InputError for a number of `vehicle` that no machine has, with the unit that was probably meant."""
    with np.errstate(all="ignore"):  # numbers may be as large as they like
        for rule in RULES:
            if not (rule.low <= (ratio := rule.ratio(vehicle)) <= rule.high or np.isnan(ratio)):
                raise _refusal(rule, float(ratio), vehicle)
    _check_discs(vehicle)


def _refusal(rule: Rule, ratio: float, vehicle: Any) -> InputError:
    """Return the error for a `ratio` out of the limits of a `rule`."""
    units = sorted(_meant(rule, vehicle))
    field = units[0][1] if units else rule.suspects[0][0]
    hints = [
        f"in {unit}? write {_first(vehicle, name) * factor:.4g}" for _, name, unit, factor in units if name == field
    ]
    hint = f" ({'; '.join(hints)})" if hints else ""
    expected = f"{rule.what} between {rule.low:g} and {rule.high:g} ({rule.because})"
    return InputError(field, expected, f"{ratio:.3g} with {_first(vehicle, field):g}{hint}")


def _meant(rule: Rule, vehicle: Any) -> Iterator[tuple[float, str, str, float]]:
    """Yield (how unusual, field, unit, factor) of each unit in which a number would keep the `rule`, within a tenth."""
    for name, units in rule.suspects:
        for unit, factor in units.items():
            other = _Changed(vehicle, name, factor)
            if rule.low / 10 <= rule.ratio(other) <= rule.high:
                ratios = [(each.ratio(other), each.usual) for each in RULES]
                yield sum(abs(np.log(one / usual)) for one, usual in ratios if one > 0), name, unit, factor


class _Changed:
    """A vehicle, or its body, with one number times a factor."""

    def __init__(self, record: Any, field: str, factor: float) -> None:
        self._record, (self._name, _, self._rest), self._factor = record, field.partition("."), factor

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._record, name)
        if name != self._name or value is None:
            return value
        return _Changed(value, self._rest, self._factor) if self._rest else value * self._factor


def _first(vehicle: Any, field: str) -> float:
    """Return the first number other than 0 of a `field`."""
    numbers = np.ravel(attrgetter(field)(vehicle))
    return float(numbers[np.flatnonzero(numbers)[0]])


def _check_discs(vehicle: Any) -> None:
    """Raise InputError if two rotor discs of one height overlap; by half on a gimbal, whose rod does not meet them."""
    if vehicle.body is None:
        return
    radius, places = vehicle.body.disc_radius, vehicle.rotor_positions
    share = 1.0 if vehicle.mount == "gimbal" else 0.5
    for i, place in enumerate(places):
        for other in places[i + 1 :]:
            apart = float(np.hypot(*(place - other)[:2]))
            if abs(place[2] - other[2]) < 0.05 * radius and share * apart < radius:
                wanted = f"discs that do not overlap: at most {share * apart:.4g} m between these rotors"
                hint = f" (in mm? write {radius / 1e3:g})" if radius > 10 * apart else ""
                raise InputError("body.disc_radius", wanted, f"{radius:g}{hint}")
