"""Defects of sensors as data: what may be wrong beyond noise, how large, and how many random numbers it takes."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError

# Streams that cameras send, all of a frame together.
POSES = ("position", "attitude", "rod")
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


def names_drawn(sensors: Any) -> list[str]:
    """Return the names of errors that are drawn anew for each flight."""
    return [name for name in CONSTANT if np.ndim(value := getattr(sensors, name)) == 0 and value]


def random_numbers(sensors: Any) -> dict[str, int]:
    """Return how many random numbers a tick each defect takes."""
    wanted = {
        "gyro_bias_walk": 3,
        "accelerometer_bias_walk": 3,
        "outliers": 11,  # vehicle: whether, where to, about what; rod: whether, where to
        "bursts": 1,
        "latency_jitter": 4,
    }
    return {name: count for name, count in wanted.items() if getattr(sensors, name)}
