"""Gains of the inverted law: bandwidths, damping ratios, speeds and times; and what a vehicle suggests for them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any

import numpy as np

from flypend.errors import InputError
from flypend.laws.law import Computer
from flypend.model import Vehicle

SEPARATION, LEAST_RATIO = 1.5, 2.0


@dataclass(frozen=True, kw_only=True)
class Gains:
    """Gains of the inverted law.

    Parameters
    ----------
    position_bandwidth, position_damping : float
        Horizontal loop of the bob: natural frequency (rad/s) and damping ratio.
    height_bandwidth, height_damping : float
        Vertical loop of the bob, likewise.
    position_reach : float
        Position errors are softly limited to this length, m.
    descent_limit : float
        Largest downward acceleration asked of the bob, m/s²; below g, so that it alone cannot turn the target over.
    level_limit : float
        Largest horizontal acceleration asked of the bob, m/s².
    rod_bandwidth, rod_damping : float
        Rod on S², rad/s and ratio.
    attitude_bandwidth, attitude_damping : float
        Thrust axis on S², rad/s and ratio.
    turn_rate : float
        The thrust axis is turned towards its target no faster than this, rad/s.
    tilt_limit : float
        The thrust axis is never asked to lean further than this from e₃, rad; near π for no limit.
    rate_feedforward : float
        Share of the rate of the desired thrust axis that is fed forward.
    coast_time, thrust_coast_share : float
        The desired thrust axis is that for the rod this much later, s; the thrust that for the rod after this share of
        that time.
    throw_speed : float
        Upward speed of the bob asked for while the rod hangs, m/s.
    flip_speed, flip_by_rod, flip_by_height, flip_width : float
        The rod may flip once v + flip_by_height · h + flip_by_rod · y₃ passes flip_speed (m/s), with v (m/s) the
        upward speed of the bob, h (m) the height of the pivot above its reference, in a band of flip_width (m/s).
    hanging_share : float
        Until then the rod is held hanging with this share of its gain.
    pump_share, pump_rate : float
        Share of a swing-up by the energy of the rod while it is low, for a vehicle too slow to throw and flip, and how
        fast that energy is brought to its value upright, 1/s.
    low_below, high_above : float
        y₃ below which a rod is low and above which it is not at all.
    yaw_damping : float
        Decay of the yaw rate, 1/s.
    thrust_share : float
        Share of the largest thrust that is used.
    lead, latency, observer : float
        Of the flight computer: see `laws.Computer`.
    """

    position_bandwidth: float
    position_damping: float
    height_bandwidth: float
    height_damping: float
    position_reach: float
    descent_limit: float
    level_limit: float
    rod_bandwidth: float
    rod_damping: float
    attitude_bandwidth: float
    attitude_damping: float
    turn_rate: float
    tilt_limit: float
    rate_feedforward: float
    coast_time: float
    thrust_coast_share: float
    throw_speed: float
    flip_speed: float
    flip_by_rod: float
    flip_by_height: float
    flip_width: float
    hanging_share: float
    pump_share: float
    pump_rate: float
    low_below: float
    high_above: float
    yaw_damping: float
    thrust_share: float
    lead: float
    latency: float
    observer: float

    def __post_init__(self) -> None:
        slow, middle, fast = self.position_bandwidth, self.rod_bandwidth, self.attitude_bandwidth
        if not (SEPARATION * slow <= middle and SEPARATION * middle <= fast):
            raise InputError(
                "bandwidths",
                f"position, rod and attitude each {SEPARATION:g} times the one before",
                f"{slow:.3g}, {middle:.3g}, {fast:.3g} rad/s",
            )
        if not self.low_below < self.high_above < 1:
            raise InputError("high_above", "low_below < high_above < 1", f"{self.low_below:g}, {self.high_above:g}")


# Least value of each gain; those of the flip may have either sign.
_SIGNED = {"flip_speed", "flip_by_rod", "flip_by_height", "low_below", "high_above"}
_POSITIVE = {
    "level_limit",
    "turn_rate",
    "tilt_limit",
    "flip_width",
    "coast_time",
    "position_reach",
    "descent_limit",
    "thrust_share",
} | {entry.name for entry in fields(Gains) if entry.name.endswith(("_bandwidth", "_damping"))}
BOUNDS: Mapping[str, float | None] = MappingProxyType(
    {entry.name: None if entry.name in _SIGNED else 1e-9 if entry.name in _POSITIVE else 0.0 for entry in fields(Gains)}
)

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


def gains_for(vehicle: Vehicle, **given: float) -> Gains:
    """The gains that the law proposes for `vehicle`, from its rod, its inertia, its rotor limits and their lag.

    Fields `given` replace proposals. Raises InputError for bandwidths that are not separated.
    """
    n = AGILE if angular_authority(vehicle) * vehicle.l >= LEAST_AGILITY * vehicle.g else SLOW
    time, speed = np.sqrt(vehicle.l / vehicle.g), np.sqrt(vehicle.g * vehicle.l)
    # A vehicle too slow to turn for its rod is given the bandwidth that balancing takes: near upright small moments do.
    attitude = max(
        n["attitude_bandwidth"] * np.sqrt(angular_authority(vehicle)), LEAST_RATIO * n["rod_bandwidth"] / time
    )
    attitude = min(attitude, 0.9 / max(vehicle.rotor_lag, 1e-3))
    values: dict[str, Any] = {
        "position_bandwidth": n["position_bandwidth"] / time,
        "position_damping": n["position_damping"],
        "height_bandwidth": n["height_bandwidth"] / time,
        "height_damping": n["height_damping"],
        "position_reach": n["position_reach"] * vehicle.l,
        "descent_limit": n["descent"] * vehicle.g,
        "level_limit": n["level"] * vehicle.g,
        "rod_bandwidth": n["rod_bandwidth"] / time,
        "rod_damping": n["rod_damping"],
        "attitude_bandwidth": attitude,
        "attitude_damping": n["attitude_damping"],
        "turn_rate": n["turn_rate"] * np.sqrt(angular_authority(vehicle)),
        "tilt_limit": n["tilt_limit"],
        "rate_feedforward": n["rate_feedforward"],
        "coast_time": n["coast"] / attitude,
        "thrust_coast_share": n["thrust_coast"],
        "throw_speed": n["throw_speed"] * speed,
        "flip_speed": n["flip_speed"] * speed,
        "flip_by_rod": n["flip_by_rod"] * speed,
        "flip_by_height": n["flip_by_height"] / time,
        "flip_width": n["flip_width"] * speed,
        "hanging_share": n["hanging_share"],
        "pump_share": n["pump_share"],
        "pump_rate": n["pump_rate"] / time,
        "low_below": n["low_below"],
        "high_above": n["high_above"],
        "yaw_damping": 5.0,
        "thrust_share": 0.993,
        "lead": n["lead"] if vehicle.rotor_lag > 0 else 1.0,
        "latency": min(0.024, n["latency"] / attitude),
        "observer": 1.5,
    }
    return Gains(**({name: float(value) for name, value in values.items()} | given))


def angular_authority(vehicle: Vehicle) -> float:
    """Largest angular acceleration, rad/s², of roll or pitch, whichever is less, about hover: arm · range / inertia."""
    low, high = vehicle.rotor_limits
    lever = np.abs(vehicle.mixing()[1:3]).sum(axis=1) / 2
    return float(np.min(lever * (high - low) / np.diag(vehicle.inertia)[:2]))


def computer_of(gains: Gains) -> Computer:
    """The flight computer around the law with these `gains`."""
    return Computer(lead=gains.lead, latency=gains.latency, observer=gains.observer)
