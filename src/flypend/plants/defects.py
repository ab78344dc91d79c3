"""Defects of sensors as data: what may be wrong beyond noise, how large, and how many random numbers it takes."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError

# Those that only say how large, how long or how fast another is.
MEASURES = ("vibration_rate", "outlier_off", "outlier_turned", "burst_time")
# Longest delay of poses, s, for which there is room if it may change: the smallest of these that is enough.
ROOMS = (0.02, 0.06, 0.16, 0.4)
# Streams that cameras send, all of a frame together.
POSES = ("position", "attitude", "rod")
# The size of a defect where only that there is one matters.
SOME = 0.1
# Errors that last: their lengths, largest sizes and units.
CONSTANT: Mapping[str, tuple[int, float, str]] = MappingProxyType(
    {
        "gyro_bias": (3, 5.0, "rad/s"),
        "gyro_scale": (3, 0.5, ""),
        "accelerometer_bias": (3, 10.0, "m/s^2"),
        "accelerometer_scale": (3, 0.5, ""),
        "imu_turned": (3, 1.0, "rad"),
        "markers_off": (3, 1.0, "m"),
        "markers_turned": (3, 1.0, "rad"),
        "rod_markers_off": (2, 1.0, "rad"),
        "joints_off": (2, 1.0, "rad"),
        "frame_off": (3, 100.0, "m"),
        "frame_turned": (3, np.pi, "rad"),
        "frame_scale": (3, 0.5, ""),
    }
)
# Numbers: their largest values and units. Some only say how large another defect is, and have a default.
NUMBERS: Mapping[str, tuple[float, str]] = MappingProxyType(
    {
        "gyro_bias_walk": (1.0, "rad/s/sqrt(s)"),
        "accelerometer_bias_walk": (10.0, "m/s^2/sqrt(s)"),
        "vibration": (100.0, "m/s^2"),
        "gyro_vibration": (10.0, "rad/s"),
        "vibration_rate": (1e4, "Hz"),
        "outliers": (0.99, ""),
        "outlier_off": (100.0, "m"),
        "outlier_turned": (np.pi, "rad"),
        "bursts": (10.0, "1/s"),
        "burst_time": (10.0, "s"),
        "untold_latency": (0.2, "s"),
        "latency_jitter": (0.2, "s"),
    }
)
NAMES = (*CONSTANT, *NUMBERS)
# The stream that a defect takes; what is not here is possible with any sensors.
NEEDS: Mapping[str, str] = MappingProxyType(
    {
        "accelerometer_bias": "accelerometer",
        "accelerometer_scale": "accelerometer",
        "accelerometer_bias_walk": "accelerometer",
        "vibration": "accelerometer",
        "markers_turned": "attitude",
        "rod_markers_off": "rod",
        "joints_off": "joints",
    }
)


def check_defects(sensors: Any) -> None:
    """Check the defects of `sensors`, and replace vectors by tuples of floats. Raises InputError."""
    for name, (length, largest, unit_) in CONSTANT.items():
        value = getattr(sensors, name)
        if np.ndim(value) == 0:
            errors.number(f"sensors.{name}", value, at_least=0, at_most=largest, unit=unit_)
            continue
        vector = errors.array(f"sensors.{name}", value, (length,))
        errors.number(f"sensors.{name}", np.abs(vector).max(), at_most=largest, unit=unit_)
        object.__setattr__(sensors, name, tuple(vector.tolist()) if np.any(vector) else 0.0)
    for name, (largest, unit_) in NUMBERS.items():
        errors.number(f"sensors.{name}", getattr(sensors, name), at_least=0, at_most=largest, unit=unit_)
    for name, stream in NEEDS.items():
        if getattr(sensors, name) and stream not in sensors.streams:
            raise InputError(f"sensors.{name}", f"0 without sensors.{stream}", repr(getattr(sensors, name)))


def check_adjustable(sensors: Any) -> None:
    """Put the names in `adjustable` of `sensors` in order, those possible in place of "all". Raises InputError."""
    possible = [
        name for name in NAMES if name not in MEASURES and (name not in NEEDS or NEEDS[name] in sensors.streams)
    ]
    given = possible if sensors.adjustable == "all" else sensors.adjustable
    if not isinstance(given, list | tuple):
        raise InputError("sensors.adjustable", "'all' or names of defects", repr(given))
    for name in given:
        errors.one_of("sensors.adjustable", name, possible)
    object.__setattr__(sensors, "adjustable", tuple(name for name in possible if name in given))


def present(sensors: Any, name: str) -> bool:
    """Whether the defect `name` is part of the program: it is not 0, or adjustable."""
    return name in sensors.adjustable or bool(np.any(getattr(sensors, name)))


def names_drawn(sensors: Any) -> list[str]:
    """Return the names of errors that are drawn anew for each flight."""
    return [name for name in CONSTANT if np.ndim(getattr(sensors, name)) == 0 and present(sensors, name)]


def shifts(sensors: Any) -> bool:
    """Whether each pose is late by a part of its own, which is a number at run time."""
    return present(sensors, "latency_jitter") or "untold_latency" in sensors.adjustable


def room(sensors: Any) -> float:
    """Return the longest such part for which there is room, s."""
    return next(longest for longest in ROOMS if sensors.untold_latency + sensors.latency_jitter <= longest)


def blank(sensors: Any) -> Any:
    """Return `sensors` without what is a number at run time: if equal, they share one program.

    It keeps which defects there are, which of them are given as vectors, and the room for late poses.
    """
    sizes: dict[str, Any] = {name: getattr(sensors.told, name) for name in MEASURES}
    for name in NAMES:
        if name not in MEASURES and (name != "untold_latency" or shifts(sensors)):
            some = SOME if present(sensors, name) else 0.0
            sizes[name] = (some,) * CONSTANT[name][0] if np.ndim(getattr(sensors, name)) else some
    if shifts(sensors):
        own = present(sensors, "latency_jitter")
        sizes |= {"untold_latency": room(sensors) / (1 + own), "latency_jitter": room(sensors) / 2 if own else 0.0}
    return sensors.replace(**sizes)


def random_numbers(sensors: Any) -> dict[str, int]:
    """Return how many random numbers a tick each defect takes."""
    wanted = {
        "gyro_bias_walk": 3,
        "accelerometer_bias_walk": 3,
        "outliers": 11,  # vehicle: whether, where to, about what; rod: whether, where to
        "bursts": 1,
        "latency_jitter": 4,
    }
    return {name: count for name, count in wanted.items() if present(sensors, name)}
