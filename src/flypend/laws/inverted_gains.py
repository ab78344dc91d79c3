"""Gains of the inverted law: bandwidths, damping ratios, speeds and times; and what a vehicle suggests for them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from flypend.errors import InputError
from flypend.laws.bound import Computer
from flypend.laws.gain import NOT_NEGATIVE, POSITIVE, POSITIVE_SHARE, SHARE, Bounds, Gain, table
from flypend.model import Vehicle

SEPARATION, LEAST_RATIO = 1.5, 2.0
# The attitude loop stays this share below the cut-off of the rotors, 1/lag; a lag below the second counts as none, s.
LAG_SHARE, LEAST_LAG = 0.9, 1e-3
# The law plans for no more delay than sensors, computer and rotors of the vehicles here have, s.
LONGEST_LATENCY = 0.024

# Pure numbers, found by CMA-ES on success and excursion of random starts of hehn2011 (see docs/laws/inverted.md).
# Times are in √(l/g), speeds in √(g l), lengths in l, the attitude bandwidth in the root of the angular acceleration
# that the rotors can give, as is the rate of turning.
AGILE: Mapping[str, float] = MappingProxyType(
    {
        "position_bandwidth": 0.56, "position_damping": 1.0, "height_bandwidth": 0.74, "height_damping": 0.82,
        "rod_bandwidth": 1.8, "rod_damping": 0.40, "attitude_bandwidth": 1.4, "attitude_damping": 0.87,
        "turn_rate": 1.8, "rate_feedforward": 0.64, "coast": 1.2, "thrust_coast": 1.0, "latency": 0.46, "lead": 2.1,
        "throw_speed": 0.90, "flip_speed": 0.51, "flip_by_rod": 0.84, "flip_by_height": 0.46, "flip_width": 0.20,
        "hanging_share": 0.64, "low_below": 0.80, "high_above": 0.97, "position_reach": 6.0, "descent": 0.9,
        "level": 6.0, "tilt_limit": 3.1, "pump_share": 0.0, "pump_rate": 1.0,
    }
)  # fmt: skip
# For a vehicle that turns too slowly to flip its rod, found in the same way on nayak2018: level, pump, catch.
SLOW: Mapping[str, float] = MappingProxyType(
    {
        **AGILE,
        "position_bandwidth": 0.30, "position_damping": 0.79, "height_bandwidth": 0.25, "height_damping": 0.79,
        "rod_bandwidth": 0.55, "rod_damping": 0.63, "attitude_bandwidth": 2.4, "attitude_damping": 0.67,
        "turn_rate": 1.15, "rate_feedforward": 0.26, "coast": 1.05, "thrust_coast": 0.0, "throw_speed": 0.046,
        "low_below": 0.51, "high_above": 0.88, "position_reach": 22.0, "descent": 0.152, "level": 0.53,
        "tilt_limit": 0.80, "pump_share": 1.0, "pump_rate": 2.0,
    }
)  # fmt: skip
# α l/g, α being that acceleration, from which on a vehicle is agile.
LEAST_AGILITY = 3.0


class Scales(NamedTuple):
    """What the gains of a vehicle are measured in.

    √(l/g) in s, √(g l) in m/s, root of its angular authority in rad/s, and whether it is agile.
    """

    time: float
    speed: float
    turn: float
    agile: bool

    @property
    def numbers(self) -> Mapping[str, float]:
        """The pure numbers for a vehicle of this kind."""
        return AGILE if self.agile else SLOW


@lru_cache(maxsize=256)
def scales(vehicle: Vehicle) -> Scales:
    """The scales of `vehicle`, from its rod, its inertia and its rotor limits."""
    authority = angular_authority(vehicle)
    return Scales(
        time=np.sqrt(vehicle.l / vehicle.g),
        speed=np.sqrt(vehicle.g * vehicle.l),
        turn=np.sqrt(authority),
        agile=authority * vehicle.l >= LEAST_AGILITY * vehicle.g,
    )


def angular_authority(vehicle: Vehicle) -> float:
    """Largest angular acceleration, rad/s², of roll or pitch, whichever is less, about hover: arm · range / inertia."""
    low, high = vehicle.rotor_limits
    lever = np.abs(vehicle.mixing()[1:3]).sum(axis=1) / 2
    return float(np.min(lever * (high - low) / np.diag(vehicle.inertia)[:2]))


def _attitude_bandwidth(vehicle: Vehicle) -> float:
    """What the rotors can give; at least what balancing takes, where small moments do; at most what they can follow."""
    s = scales(vehicle)
    wanted = max(s.numbers["attitude_bandwidth"] * s.turn, LEAST_RATIO * s.numbers["rod_bandwidth"] / s.time)
    return float(min(wanted, LAG_SHARE / max(vehicle.rotor_lag, LEAST_LAG)))


def _number(name: str) -> Callable[[Vehicle], float]:
    return lambda vehicle: scales(vehicle).numbers[name]


def _per_time(name: str) -> Callable[[Vehicle], float]:
    return lambda vehicle: scales(vehicle).numbers[name] / scales(vehicle).time


def _speed(name: str) -> Callable[[Vehicle], float]:
    return lambda vehicle: scales(vehicle).numbers[name] * scales(vehicle).speed


ANGLE = Bounds(0.0, math.pi, open_low=True)
HEIGHT = Bounds(-1.0, 1.0)

GAINS = table(
    (
        Gain(
            "position_bandwidth", _per_time("position_bandwidth"), "rad/s",
            "Natural frequency of the horizontal loop of the bob", POSITIVE, label="position",
        ),
        Gain(
            "position_damping", _number("position_damping"), "", "Damping ratio of the horizontal loop of the bob",
            POSITIVE,
        ),
        Gain(
            "height_bandwidth", _per_time("height_bandwidth"), "rad/s",
            "Natural frequency of the vertical loop of the bob", POSITIVE, label="height",
        ),
        Gain(
            "height_damping", _number("height_damping"), "", "Damping ratio of the vertical loop of the bob", POSITIVE,
        ),
        Gain(
            "position_reach", lambda v: scales(v).numbers["position_reach"] * v.l, "m",
            "Position errors are softly limited to this length", POSITIVE,
        ),
        Gain(
            "descent_limit", lambda v: scales(v).numbers["descent"] * v.g, "m/s²",
            "Largest downward acceleration asked of the bob; below g, so that it alone cannot turn the target over",
            POSITIVE,
        ),
        Gain(
            "level_limit", lambda v: scales(v).numbers["level"] * v.g, "m/s²",
            "Largest horizontal acceleration asked of the bob", POSITIVE,
        ),
        Gain(
            "rod_bandwidth", _per_time("rod_bandwidth"), "rad/s", "Natural frequency of the rod on S²", POSITIVE,
            label="rod",
        ),
        Gain("rod_damping", _number("rod_damping"), "", "Damping ratio of the rod", POSITIVE, label="rod damping"),
        Gain(
            "attitude_bandwidth", _attitude_bandwidth, "rad/s", "Natural frequency of the thrust axis on S²", POSITIVE,
            label="attitude",
        ),
        Gain(
            "attitude_damping", _number("attitude_damping"), "", "Damping ratio of the thrust axis on S²", POSITIVE,
            label="attitude damping",
        ),
        Gain(
            "turn_rate", lambda v: scales(v).numbers["turn_rate"] * scales(v).turn, "rad/s",
            "The thrust axis is turned towards its target no faster than this", POSITIVE,
        ),
        Gain(
            "tilt_limit", _number("tilt_limit"), "rad",
            "The thrust axis is never asked to lean further than this from e₃; near π for no limit", ANGLE,
        ),
        Gain(
            "rate_feedforward", _number("rate_feedforward"), "",
            "Share of the rate of the desired thrust axis that is fed forward", SHARE,
        ),
        Gain(
            "coast_time", lambda v: scales(v).numbers["coast"] / _attitude_bandwidth(v), "s",
            "The desired thrust axis is that for the rod this much later", POSITIVE, label="look ahead",
        ),
        Gain(
            "thrust_coast_share", _number("thrust_coast"), "",
            "The thrust is that for the rod after this share of coast_time", SHARE, fixed=True,
        ),
        Gain(
            "throw_speed", _speed("throw_speed"), "m/s", "Upward speed of the bob asked for while the rod hangs",
            NOT_NEGATIVE, label="throw speed",
        ),
        Gain(
            "flip_speed", _speed("flip_speed"), "m/s",
            "The rod may flip once v + flip_by_height · h + flip_by_rod · y₃ passes this, with v (m/s) the upward "
            "speed of the bob and h (m) the height of the pivot above its reference",
        ),
        Gain("flip_by_rod", _speed("flip_by_rod"), "m/s", "What the rod's height y₃ counts towards flip_speed"),
        Gain("flip_by_height", _per_time("flip_by_height"), "1/s", "What the pivot's height counts towards flip_speed"),
        Gain("flip_width", _speed("flip_width"), "m/s", "Band of speed over which the permission comes", POSITIVE),
        Gain(
            "hanging_share", _number("hanging_share"), "",
            "Until it may flip, the rod is held hanging with this share of its stiffness", SHARE,
        ),
        Gain(
            "pump_share", _number("pump_share"), "",
            "Share of a swing-up by the energy of the rod while it is low, for a vehicle too slow to throw and flip",
            SHARE, fixed=True,
        ),
        Gain(
            "pump_rate", _per_time("pump_rate"), "1/s", "How fast that energy is brought to its value upright",
            NOT_NEGATIVE,
        ),
        Gain("low_below", _number("low_below"), "", "y₃ below which a rod is low", HEIGHT),
        Gain("high_above", _number("high_above"), "", "y₃ above which it is not low at all", HEIGHT),
        Gain("yaw_damping", 5.0, "1/s", "Decay of the yaw rate", NOT_NEGATIVE),
        # Below 1, so that a rotor at its limit still has something left to steer with.
        Gain("thrust_share", 0.993, "", "Share of the largest thrust that is used", POSITIVE_SHARE),
        Gain(
            "lead", lambda v: scales(v).numbers["lead"] if v.rotor_lag > 0 else 1.0, "",
            "Rotors are commanded f̂ + lead (f − f̂), f̂ being their modelled force", Bounds(low=1.0),
        ),
        Gain(
            "latency", lambda v: min(LONGEST_LATENCY, scales(v).numbers["latency"] / _attitude_bandwidth(v)), "s",
            "Delay that the flight computer plans for", NOT_NEGATIVE,
        ),
        Gain("observer", 1.5, "1/s", "Bandwidth of the observer of external forces; 0 for none", NOT_NEGATIVE),
        Gain(
            "form", "full", doc="light does three quarters of the work, for processors that are short of time: the "
            "direction of the demand turns steadily, without the demand's second derivative", choices=("full", "light"),
        ),
    )
)  # fmt: skip


def go_together(gains: Mapping[str, Any]) -> None:
    """Raise InputError unless the bandwidths of `gains` are separated and its heights in order."""
    slow, middle, fast = (gains[f"{loop}_bandwidth"] for loop in ("position", "rod", "attitude"))
    if not (SEPARATION * slow <= middle and SEPARATION * middle <= fast):
        raise InputError(
            "bandwidths",
            f"position, rod and attitude each {SEPARATION:g} times the one before",
            f"{slow:.3g}, {middle:.3g}, {fast:.3g} rad/s",
        )
    low, high = gains["low_below"], gains["high_above"]
    if not low < high < 1:
        raise InputError("high_above", "low_below < high_above < 1", f"{low:g}, {high:g}")


def computer_of(gains: Mapping[str, Any]) -> Computer:
    """The flight computer around the law with these `gains`."""
    return Computer(lead=gains["lead"], latency=gains["latency"], observer=gains["observer"])
