"""The axes of a study: each quantity that varies, as a range or uniform distribution to sample, or as a grid."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.laws import BoundLaw, Controller
from flypend.settings.runfile import table_at

# Dimensions of the sample: y uniform on S², R on SO(3), vectors in balls, y_dot in a tangent disc. Scalars have ranges.
UNIFORM = {"y": 2, "R": 3}
BALLS = {"x": ("ball", 3), "x_dot": ("ball", 3), "omega": ("ball", 3), "y_dot": ("disc", 2)}
# The rod by angles, e₃ up: tilt from inverted, azimuth, magnitude of its rate, and heading of the rate (0: tilt grows).
ANGLES = ("tilt", "azimuth", "rate", "heading")
MOST_POINTS = 100_000


@dataclass(frozen=True)
class Axis:
    """One quantity that varies: sampled over a range, or on a grid."""

    group: str  # what it belongs to: "start", "gains" or "plant"
    name: str  # a field of the start or an angle, a gain, or a plant parameter ("mismatch.mass")
    dimensions: int  # of the sample that it uses; 0 on a grid
    low: float = 0.0  # the range; for a ball or a disc, 0 and the radius
    high: float = 0.0
    log: bool = False  # whether the range is logarithmic
    values: tuple[float, ...] = ()  # grid points; empty if sampled

    def at(self, u: Any) -> Any:
        """Return the values at the fractions u (n,) of the range."""
        if self.log:
            return self.low * (self.high / self.low) ** u
        return self.low + (self.high - self.low) * u


def axes(table: Mapping[str, Any], law: BoundLaw | Controller, plant: bool) -> tuple[Axis, ...]:
    """Return the axes in the table `vary` of a study under `law`; `plant` states whether the plant is sampled.

    Raises InputError if anything is unknown or out of range.
    """
    errors.only_known("vary", table, ("start", "gains", "plant"))
    found = []
    plants, gains, start = (table_at(table, key, f"vary.{key}") for key in ("plant", "gains", "start"))
    for name, value in plants.items():
        found += _plant_axes(name, value, plant)
    for name, value in gains.items():
        errors.only_known("vary.gains", [name], law.numbers)
        axis = _range("gains", name, value)
        law.check_gain(name, axis.values or (axis.low, axis.high), "vary.gains")
        found.append(axis)
    errors.only_known("vary.start", start, (*UNIFORM, *BALLS, *ANGLES))
    for two, one in ((("tilt", "azimuth"), "y"), (("rate", "heading"), "y_dot")):
        if one in start and set(two) & set(start):
            raise InputError("vary.start", f"{one}, or " + " and ".join(two), "both")
    if set(ANGLES[2:]) & set(start) and "y" in start:
        raise InputError("vary.start", "rate and heading with tilt and azimuth", "rate or heading with y")
    found += [_start_axis(name, value) for name, value in start.items()]
    return tuple(found)


def _start_axis(name: str, value: Any) -> Axis:
    if name in ANGLES:
        axis = _range("start", name, value)
        numbers = axis.values or (axis.low, axis.high)
        if name == "tilt" and not (min(numbers) >= 0 and max(numbers) <= np.pi * (1 + 1e-9)):
            raise InputError("vary.start.tilt", "angles from 0 (inverted) to pi (hanging), rad", numbers)
        if name == "rate" and min(numbers) < 0:
            raise InputError("vary.start.rate", "rates >= 0, 1/s", numbers)
        return axis
    if name in UNIFORM:
        if value != "uniform":
            raise InputError(f"vary.start.{name}", "'uniform'", repr(value))
        return Axis("start", name, UNIFORM[name])
    kind, dimensions = BALLS[name]
    if not isinstance(value, Mapping) or set(value) != {kind}:
        raise InputError(f"vary.start.{name}", f"{{ {kind} = radius }}", repr(value))
    radius = errors.number(f"vary.start.{name}.{kind}", value[kind], above=0)
    return Axis("start", name, dimensions, 0.0, radius)


def _plant_axes(name: str, value: Any, sampled: bool) -> list[Axis]:
    """Axes of plant parameters, nested tables included; all on grids, since runs on one plant fly together."""
    if not sampled:
        raise InputError("vary.plant", "a plant with numbers, such as 'rotors'", "the ideal plant")
    if isinstance(value, Mapping) and not set(value) & {"from", "to", "points", "values", "scale"}:
        return [axis for inner, entry in value.items() for axis in _plant_axes(f"{name}.{inner}", entry, sampled)]
    axis = _range("plant", name, value)
    if not axis.values:
        raise InputError(
            f"vary.plant.{name}", "a grid (points or values): runs of one plant are flown together", repr(value)
        )
    return [axis]


def _range(group: str, name: str, value: Any) -> Axis:
    """Parse a range: {from, to} is sampled, {points} or {values} makes a grid; scale = "log" is logarithmic."""
    field = f"vary.{group}.{name}"
    if not isinstance(value, Mapping):
        raise InputError(field, "{ from, to }, { from, to, points } or { values }", repr(value))
    errors.only_known(field, value, ("from", "to", "points", "scale", "values"))
    if "values" in value:
        if len(value) > 1:
            raise InputError(field, "values alone", repr(dict(value)))
        listed = errors.array(f"{field}.values", value["values"], (None,))
        if not 1 <= len(listed) <= MOST_POINTS:
            raise InputError(field, f"1 to {MOST_POINTS} points", len(listed))
        return Axis(group, name, 0, values=tuple(listed.tolist()))
    for key in ("from", "to"):
        if key not in value:
            raise InputError(f"{field}.{key}", "a number", "nothing")
    log = errors.one_of(f"{field}.scale", value.get("scale", "linear"), ("linear", "log")) == "log"
    low = errors.number(f"{field}.from", value["from"], above=0 if log else None)
    high = errors.number(f"{field}.to", value["to"], above=low)
    if not np.isfinite(high - low):
        raise InputError(field, "a range of finite length", f"{low:g} to {high:g}")
    if "points" not in value:
        return Axis(group, name, 1, low, high, log)
    points = errors.integer(f"{field}.points", value["points"], 2, MOST_POINTS)
    spaced = np.geomspace(low, high, points) if log else np.linspace(low, high, points)
    return Axis(group, name, 0, values=tuple(spaced.tolist()))
