"""What a page offers: starts, and sliders of gains and of numbers of a plant, with their ranges and values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any, NamedTuple

import numpy as np

from flypend.errors import InputError
from flypend.laws import BoundLaw, Controller, Law
from flypend.model import State, Vehicle
from flypend.model.state import SHAPES
from flypend.plants import MOTION_CAPTURE, Noise, Sampled, Wind

# Directions of the rod, e₃ up, for starts at rest.
STARTS = {"hanging": (0.0, 0.0, -1.0), "level": (1.0, 0.0, 0.0), "leaning": (0.28, 0.0, 0.96)}
# 1/ρ and 1/ρ² for the plastic number ρ³ = ρ + 1: Roberts's R2 low-discrepancy sequence on the unit square.
STEPS = (0.7548776662466927, 0.5698402909980532)
_NOISE = {name: {"#": value} for name, value in asdict(MOTION_CAPTURE).items()}
BISECTIONS = 12  # to a fifth of a per cent of a slider with a range of a factor of four either way
FACTOR = 4.0  # a gain's slider spans its default divided and multiplied by this


_DEGREE, _PERCENT, _MILLI = np.pi / 180, 0.01, 1e-3
# Of each defect: words, the unit shown and its size in SI, and where its slider ends, in that unit: hehn2011 on the
# suite "mocap" falls there from hover or does not swing up from most starts, unless sensors take no more.
DEFECTS: Mapping[str, tuple[str, str, float, float]] = {
    "gyro_bias": ("gyro bias", "rad/s", 1.0, 5.0),
    "gyro_bias_walk": ("gyro bias, walk", "rad/s/√s", 1.0, 1.0),
    "gyro_scale": ("gyro scale", "%", _PERCENT, 40.0),
    "gyro_vibration": ("gyro vibration", "rad/s", 1.0, 10.0),
    "accelerometer_bias": ("accelerometer bias", "m/s²", 1.0, 10.0),
    "accelerometer_bias_walk": ("accelerometer bias, walk", "m/s²/√s", 1.0, 5.0),
    "accelerometer_scale": ("accelerometer scale", "%", _PERCENT, 50.0),
    "vibration": ("accelerometer vibration", "m/s²", 1.0, 100.0),
    "imu_turned": ("IMU misaligned", "°", _DEGREE, 20.0),
    "markers_off": ("markers off the pivot", "mm", _MILLI, 500.0),
    "markers_turned": ("markers misaligned", "°", _DEGREE, 20.0),
    "rod_markers_off": ("rod markers off", "°", _DEGREE, 15.0),
    "joints_off": ("joint zeros off", "°", _DEGREE, 15.0),
    "frame_off": ("cameras' origin off", "m", 1.0, 0.5),
    "frame_turned": ("cameras' frame turned", "°", _DEGREE, 20.0),
    "frame_scale": ("cameras' scale", "%", _PERCENT, 50.0),
    "outliers": ("poses of another body", "%", _PERCENT, 95.0),
    "bursts": ("bursts of loss", "1/s", 1.0, 10.0),
    "untold_latency": ("poses older than told", "ms", _MILLI, 40.0),
    "latency_jitter": ("jitter of poses", "ms", _MILLI, 20.0),
}


class Reach(NamedTuple):
    """Range of a slider, in its unit, and whether it is logarithmic."""

    low: float
    high: float
    log: bool = False


def sliders_of(law: Law | BoundLaw | Controller) -> tuple[str, ...]:
    """Return the names of the gains of `law` that have sliders: numeric gains with a label."""
    return tuple(name for name, gain in law.table.items() if gain.label and gain.numeric)


def gain_sliders(law: Law | BoundLaw | Controller, vehicle: Vehicle, given: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the sliders of the gains of `law` for `vehicle`, with the values `given`; see `slider`."""
    out = []
    for name in sliders_of(law):
        gain = law.table[name]
        low, high, log = _reach(gain.value(vehicle))
        reach = Reach(max(low, gain.bounds.low), min(high, gain.bounds.high), log)
        found = slider(f"law.gains.{name}", "gains", gain.label, gain.unit, given[name], reach)
        out.append(found | {"allowed": _allowed_range(law, given, name, found["low"], found["high"])})
    return out


def _allowed_range(
    law: Law | BoundLaw | Controller, given: Mapping[str, Any], name: str, low: float, high: float
) -> list[float]:
    """Between `low` and `high`, how far the gain `name` may go while the others stay as `given`."""
    check = None if isinstance(law, Controller) else law.check
    if check is None:
        return [low, high]

    def refused(value: float) -> bool:
        try:
            check({**given, name: value})
        except InputError:
            return True
        return False

    return [_last_good(refused, given[name], end) for end in (low, high)]


def _last_good(refused: Callable[[float], bool], good: float, end: float) -> float:
    """Where, on the way from a `good` value to `end`, values begin to be `refused`; `end` if none is. By bisection."""
    if not refused(end):
        return end
    bad = end
    for _ in range(BISECTIONS):
        middle = (good + bad) / 2
        good, bad = (good, middle) if refused(middle) else (middle, bad)
    return good


def _reach(usual: float) -> Reach:
    """Range of the slider of a gain whose default is `usual`."""
    if usual > 0:
        return Reach(usual / FACTOR, usual * FACTOR, log=True)
    return Reach(usual * FACTOR, -usual * FACTOR) if usual < 0 else Reach(-1.0, 1.0)


def plant_sliders(plant: Sampled, vehicle: Vehicle) -> list[dict[str, Any]]:
    """Return the sliders of the numbers of `plant` that a page may change, for a law of `vehicle`; see `slider`."""
    least, largest = vehicle.rotor_limits
    share = vehicle.weight / len(vehicle.rotor_spins)
    noise, wind = plant.noise or Noise(), plant.wind or Wind()
    level = noise.x / MOTION_CAPTURE.x
    high = 0.5 * vehicle.weight
    strongest = Reach(1.1 * share, 5 * share)
    seen = slider("plant.noise", "plant", "noise", "× motion capture", level, Reach(0.0, 10.0), put=_NOISE)
    return [
        slider("vehicle.rotor_limits", "plant", "rotor limit", "N", largest, strongest, put=[least, {"#": 1}]),
        slider("plant.lag", "plant", "rotor lag", "s", plant.true_vehicle(vehicle).rotor_lag, Reach(0.0, 0.2)),
        slider("plant.delay", "plant", "delay", "s", plant.delay, Reach(0.0, 0.1)),
        *([seen] if plant.sensors is None else []),  # sensors have noise of their own
        slider(
            "plant.wind.on_vehicle", "plant", "wind along e₁", "N", wind.on_vehicle[0], Reach(-high, high),
            put=[{"#": 1}, *map(float, wind.on_vehicle[1:])],
        ),
        slider("plant.wind.gust_on_vehicle", "plant", "gusts", "N", wind.gust_on_vehicle, Reach(0.0, high)),
    ]  # fmt: skip


def defect_sliders(plant: Sampled) -> list[dict[str, Any]]:
    """Return the sliders of the adjustable defects of the sensors of `plant`, each from 0; see `slider`."""
    if plant.sensors is None:
        return []
    return [
        slider(
            f"plant.defects.{name}", "defects", words, unit, getattr(plant.sensors, name) / factor, Reach(0.0, high),
            put={"#": factor},
        )
        for name, (words, unit, factor, high) in DEFECTS.items()
        if name in plant.sensors.adjustable and np.ndim(getattr(plant.sensors, name)) == 0
    ]  # fmt: skip


def slider(path: str, group: str, words: str, unit: str, value: float, reach: Reach, put: Any = None) -> dict[str, Any]:
    """One slider; its range is widened to include `value`, and logarithmic only if that is positive.

    `put` is what the page writes at `path`, where {"#": factor} stands for factor times the value; None for the value.
    """
    return {
        "path": path, "group": group, "words": words, "unit": unit, "value": float(value),
        "low": float(min(reach.low, value)), "high": float(max(reach.high, value)),
        "log": bool(reach.log and value > 0), "put": put, "allowed": None,
    }  # fmt: skip


def plain(state: State) -> dict[str, Any]:
    """Return the fields of `state` as lists."""
    return {name: getattr(state, name).tolist() for name in SHAPES}


def starts() -> dict[str, dict[str, Any]]:
    """Return the starts at rest by name, as lists."""
    return {name: plain(State(y=y)) for name, y in STARTS.items()}


def directions(count: int) -> Any:
    """Return `count` unit vectors (count, 3) spread evenly over S²; every prefix is spread evenly, too."""
    height, turn = (np.modf(0.5 + step * np.arange(count))[0] for step in STEPS)
    y_3 = 1 - 2 * height
    level = np.sqrt(1 - y_3**2)
    return np.stack([level * np.cos(2 * np.pi * turn), level * np.sin(2 * np.pi * turn), y_3], axis=-1)
