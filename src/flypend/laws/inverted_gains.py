"""Gains of the inverted law (bandwidths, damping ratios, speeds, times) and their defaults for a vehicle."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.errors import InputError
from flypend.laws.gain import ANY, DELAY_REACH, NOT_NEGATIVE, POSITIVE, SHARE, Bounds, Gain, check_gravity, table
from flypend.model import Vehicle

# Bandwidth of a loop over that of the one around it: at least this, or the law refuses to be built.
SEPARATION = 1.5
# Attitude over rod bandwidth, at least, where the rotors' lag limits the attitude loop.
LEAST_SEPARATION = 1.55
# Attitude bandwidth over the rotors' cut-off 1/lag, at most.
LAG_SHARE = 0.9
# Attitude bandwidth, in √(g/l), at least: 3.5 times the rod's of a vehicle that pumps. In hover moments are small, so
# the authority does not limit it.
LEAST_ATTITUDE = 1.93
# Share of the thrust axis's rate that is fed forward, at most this times α l/g: what is fed forward takes moment.
FEEDFORWARD = 0.4
# Upper limit of the default latency, s: the delay of sensors, computer and rotors of the vehicles here.
LONGEST_LATENCY = 0.028

# Dimensionless, tuned by CMA-ES for success and excursion from random starts of hehn2011 (see docs/laws/inverted.md).
# Units: √(l/g) for times, √(g l) for speeds, l for lengths, and √α for the attitude bandwidth, where α is the
# largest angular acceleration that the rotors can produce.
NUMBERS: Mapping[str, float] = MappingProxyType(
    {
        "position_bandwidth": 0.57, "height_bandwidth": 0.78, "position_damping": 0.865,
        "rod_bandwidth": 1.8, "rod_damping": 0.48, "attitude_bandwidth": 1.365, "attitude_damping": 0.855,
        "rate_feedforward": 0.66, "coast": 1.28, "latency": 0.52, "lead": 2.6,
        "throw_speed": 0.50, "flip_speed": 0.29, "flip_by_rod": 0.87, "flip_by_height": 0.72,
        "hanging_share": 0.77, "catch_time": 0.27, "catch_within": 0.092, "catch_width": 0.137, "catch_by_axis": 0.18,
        "descent": 0.55, "tilt_limit": 3.1, "pump_share": 0.0, "haste": 0.32, "shift": 0.12, "yaw_damping": 5.0,
    }
)  # fmt: skip
# What differs for a vehicle that turns too slowly to throw and flip its rod: it levels, pumps and catches. Tuned on
# nayak2018; each of the other numbers costs nothing there (`python -m benchmarks.constants`).
PUMPING: Mapping[str, float] = MappingProxyType(
    {
        "pump_share": 1.0, "tilt_limit": 0.65, "position_bandwidth": 0.30, "height_bandwidth": 0.30,
        "position_damping": 0.79, "rod_bandwidth": 0.55, "rod_damping": 0.63, "attitude_damping": 0.71, "coast": 1.11,
        "descent": 0.152, "catch_width": 0.37, "catch_time": 0.0, "catch_by_axis": 0.0, "haste": 0.0,
    }
)  # fmt: skip
# On a hub the rod is caught as long as it is above the rotor plane, in a cup always: 1 − y₃ is at most 2. On a hub it
# also leaves its hang more slowly, so that the vehicle has the time to yaw; it strays further, and touches less.
MOUNTED: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "hub": {
            "catch_within": 1.4, "catch_width": 0.1, "catch_by_axis": 0.0, "catch_time": 0.062, "haste": 0.0,
            "shift": 0.03, "yaw_damping": 12.5, "rod_bandwidth": 2.19, "rod_damping": 0.66,
            "attitude_bandwidth": 1.59, "attitude_damping": 1.49, "rate_feedforward": 0.685, "coast": 1.68,
            "position_bandwidth": 0.298, "height_bandwidth": 0.687, "position_damping": 0.747, "throw_speed": 0.529,
            "flip_speed": 0.317, "flip_by_rod": 0.469, "flip_by_height": 0.638, "hanging_share": 0.68, "latency": 0.257,
        },
        "cup": {"catch_within": 2.0, "catch_width": 0.1, "catch_by_axis": 0.0, "catch_time": 0.0},
    }
)  # fmt: skip
# Factors of the default gains with which hover trembles least where the state is estimated from noisy readings. They
# act near the reference, since they would enlarge a catch, and minimise the tremor of `plants.tremor` of 13 agile and
# 10 pumping vehicles of `benchmarks.vehicles` whose loops keep their damping with 15 % more or less gain and with
# delays of 5 ms and 0.15 lags more than believed. Two are brought back by flights: the position loop of an agile
# vehicle, for its excursion, and the rod's of a pumping one, so that the rod is still caught.
CALM: Mapping[bool, Mapping[str, float]] = MappingProxyType(
    {
        True: {
            "position_bandwidth": 0.75, "rod_damping": 1.22, "attitude_damping": 1.4, "rate_feedforward": 1.5,
            "coast_time": 1.45,
        },
        False: {
            "position_bandwidth": 0.75, "rod_bandwidth": 1.45, "rod_damping": 1.5, "attitude_bandwidth": 1.5,
            "attitude_damping": 1.4, "coast_time": 0.78,
        },
    }
)  # fmt: skip
# Attitude bandwidth of calm gains over 1/lag, at most: it is hover that counts, where rotors keep their linear range.
CALM_LAG_SHARE = 1.2
# A vehicle is agile, and flips its rod, if α l/g reaches the first, and the second times the rotors' thrust in weights:
# it turns over before it has fallen, or flown, too far. With more lag than the third, in √(l/g), its axis follows too
# late for a catch: 11 of 20 such random vehicles flip from 95 % of the starts and a known state, all 20 pump from them.
LEAST_AGILITY, LEAST_PER_POWER, MOST_LAG = 5.5, 2.0, 0.4


class Scales(NamedTuple):
    """Natural units of a vehicle's gains.

    √(l/g) in s, √(g l) in m/s, the square root of the angular authority α in rad/s, `agility` α l/g, the rotors'
    `power` in weights and their `lag` in √(l/g), and the mount.
    """

    time: float
    speed: float
    turn: float
    agility: float
    power: float
    lag: float
    mount: str

    @property
    def agile(self) -> bool:
        """Whether the vehicle throws and flips its rod; if not, it levels and pumps."""
        return self.agility >= max(LEAST_AGILITY, LEAST_PER_POWER * self.power) and self.lag <= MOST_LAG

    @property
    def numbers(self) -> Mapping[str, float]:
        """Dimensionless gains for a vehicle of this agility and mount."""
        return {**NUMBERS, **({} if self.agile else PUMPING), **MOUNTED.get(self.mount, {})}


@lru_cache(maxsize=256)
def scales(vehicle: Vehicle) -> Scales:
    """Return the scales of `vehicle`, from its rod, inertia, and rotor limits and lag."""
    check_gravity(vehicle)
    authority = angular_authority(vehicle)
    return Scales(
        time=np.sqrt(vehicle.l / vehicle.g),
        speed=np.sqrt(vehicle.g * vehicle.l),
        turn=np.sqrt(authority),
        agility=authority * vehicle.l / vehicle.g,
        power=vehicle.rotor_limits[1] * len(vehicle.rotor_spins) / vehicle.weight,
        lag=vehicle.rotor_lag / np.sqrt(vehicle.l / vehicle.g),
        mount=vehicle.mount,
    )


def angular_authority(vehicle: Any) -> Any:
    """Return the largest angular acceleration, rad/s², arm · range / inertia: the lesser of roll and pitch.

    The numbers of `vehicle` may be symbolic.
    """
    span, mixing = vehicle.rotor_limits[1] - vehicle.rotor_limits[0], vehicle.mixing()
    roll, pitch = (ca.sum2(ca.fabs(mixing[i : i + 1, :])) / 2 * span / vehicle.I[i - 1, i - 1] for i in (1, 2))
    least = ca.fmin(roll, pitch)
    return least if isinstance(least, ca.SX) else float(least)


def _attitude_bandwidth(vehicle: Vehicle) -> float:
    """Return what the authority allows; at least what balancing needs, at most what the lag allows."""
    s = scales(vehicle)
    wanted = max(s.numbers["attitude_bandwidth"] * s.turn, LEAST_ATTITUDE / s.time)
    return float(min(wanted, LAG_SHARE / vehicle.rotor_lag) if vehicle.rotor_lag else wanted)


def _rod_bandwidth(vehicle: Vehicle) -> float:
    """Return what the rod asks for; less where the rotors' lag keeps the attitude loop too slow for that."""
    s = scales(vehicle)
    return float(min(s.numbers["rod_bandwidth"] / s.time, _attitude_bandwidth(vehicle) / LEAST_SEPARATION))


def calm(vehicle: Vehicle, share: float) -> dict[str, float]:
    """Return gains that lie by `share`, 0 to 1, between the defaults for `vehicle` and the calmest, by `CALM`."""
    s = scales(vehicle)
    found = {name: GAINS[name].value(vehicle) * factor**share for name, factor in CALM[s.agile].items()}
    if "attitude_bandwidth" in found and vehicle.rotor_lag:
        most = max(GAINS["attitude_bandwidth"].value(vehicle), CALM_LAG_SHARE / vehicle.rotor_lag)
        found["attitude_bandwidth"] = min(found["attitude_bandwidth"], most)
    if "rod_bandwidth" in found:
        found["rod_bandwidth"] = min(found["rod_bandwidth"], found["attitude_bandwidth"] / LEAST_SEPARATION)
    if "rate_feedforward" in found:
        found["rate_feedforward"] = min(found["rate_feedforward"], 1.0)
    return found


# What a number without dimension is in the vehicle's own units.
UNITS: Mapping[str, Callable[[float, Scales], float]] = MappingProxyType(
    {
        "": lambda number, s: number, "rad": lambda number, s: number, "s": lambda number, s: number * s.time,
        "1/s": lambda number, s: number / s.time, "rad/s": lambda number, s: number / s.time,
        "m/s": lambda number, s: number * s.speed,
    }
)  # fmt: skip


def _gain(name: str, unit: str, doc: str, bounds: Bounds = ANY, label: str = "", *, fixed: bool = False) -> Gain:
    """Return the gain `name`, whose default is the vehicle's number of that name in its own `unit`."""

    def value(vehicle: Vehicle) -> float:
        s = scales(vehicle)
        return UNITS[unit](s.numbers[name], s)

    return Gain(name, value, unit, doc, bounds, label=label, fixed=fixed)


ANGLE = Bounds(0.0, math.pi, open_low=True)

GAINS = table(
    (
        _gain(
            "position_bandwidth", "rad/s", "Natural frequency of the bob's horizontal position loop", POSITIVE,
            "position",
        ),
        _gain("position_damping", "", "Damping ratio of the bob's position and height loops", POSITIVE),
        _gain("height_bandwidth", "rad/s", "Natural frequency of the bob's height loop", POSITIVE, "height"),
        Gain(
            "descent_limit", lambda v: scales(v).numbers["descent"] * v.g, "m/s²",
            "Largest downward acceleration demanded of the bob; below g, it alone cannot flip the rod's target",
            POSITIVE,
        ),
        Gain("rod_bandwidth", _rod_bandwidth, "rad/s", "Natural frequency of the rod on S²", POSITIVE, label="rod"),
        _gain("rod_damping", "", "Damping ratio of the rod", POSITIVE, "rod damping"),
        Gain(
            "attitude_bandwidth", _attitude_bandwidth, "rad/s", "Natural frequency of the thrust axis on S²", POSITIVE,
            label="attitude",
        ),
        _gain("attitude_damping", "", "Damping ratio of the thrust axis on S²", POSITIVE, "attitude damping"),
        _gain("tilt_limit", "rad", "Largest commanded tilt of the thrust axis from e₃; near π for no limit", ANGLE),
        Gain(
            "rate_feedforward",
            lambda v: min(scales(v).numbers["rate_feedforward"], FEEDFORWARD * scales(v).agility), "",
            "Share of the desired thrust axis's rate that is fed forward", SHARE,
        ),
        Gain(
            "coast_time", lambda v: scales(v).numbers["coast"] / _attitude_bandwidth(v), "s",
            "The desired thrust axis is computed for the rod predicted this far ahead; the thrust, for 1 - pump_share "
            "of this time", POSITIVE, label="look ahead",
        ),
        _gain(
            "throw_speed", "m/s", "Upward speed demanded of the bob while the rod hangs", NOT_NEGATIVE, "throw speed"
        ),
        _gain(
            "flip_speed", "m/s",
            "The rod may flip once v + flip_by_height · h + flip_by_rod · y₃ exceeds this; v (m/s) is the bob's "
            "upward speed, h (m) the pivot's height above its reference",
        ),
        _gain("flip_by_rod", "m/s", "Weight of the rod's height y₃ in flip_speed's sum"),
        _gain("flip_by_height", "1/s", "Weight of the pivot's height in flip_speed's sum"),
        _gain("hanging_share", "", "Share of the rod stiffness that holds the rod hanging until it may flip", SHARE),
        _gain(
            "pump_share", "",
            "Share of energy-based swing-up while the rod is low: 1 for a vehicle too slow to throw and flip, else 0",
            SHARE, fixed=True,
        ),
        _gain("catch_time", "s", "The rod can be caught if it leans little after coasting for this time", NOT_NEGATIVE),
        _gain("catch_within", "", "Lean 1 - y3 up to which the rod can be caught", POSITIVE),
        _gain("catch_width", "", "Range of the lean over which it becomes too low", POSITIVE),
        _gain("catch_by_axis", "", "Weight of the thrust axis in that lean"),
        Gain("yaw_damping", lambda v: scales(v).numbers["yaw_damping"], "1/s", "Decay of the yaw rate", NOT_NEGATIVE),
        Gain(
            "lead", lambda v: scales(v).numbers["lead"] if v.rotor_lag > 0 else 1.0, "",
            "Rotors are commanded f̂ + lead (f − f̂), where f̂ is their modelled force", Bounds(low=1.0),
        ),
        Gain(
            "latency", lambda v: min(LONGEST_LATENCY, scales(v).numbers["latency"] / _attitude_bandwidth(v)), "s",
            "Delay that the flight computer compensates by prediction; it begins with this to find the true one",
            NOT_NEGATIVE,
        ),
        Gain("delay_reach", 0.06, "s", DELAY_REACH, NOT_NEGATIVE),
        Gain("observer", 1.5, "1/s", "Bandwidth of the external-force observer; 0 for none", NOT_NEGATIVE),
        Gain(
            "form", "full", doc="light needs three quarters of the computation, for slow processors: the demand is "
            "assumed to turn at a constant rate, which saves its second derivative", choices=("full", "light"),
        ),
    )
)  # fmt: skip


def go_together(gains: Mapping[str, Any]) -> None:
    """Raise InputError unless the bandwidths in `gains` are separated."""
    slow, middle, fast = (gains[f"{loop}_bandwidth"] for loop in ("position", "rod", "attitude"))
    for inner, outer, name, other in ((fast, middle, "attitude", "rod"), (middle, slow, "rod", "position")):
        if inner < SEPARATION * outer:
            raise InputError(
                f"{name}_bandwidth",
                f"at least {SEPARATION:g} times the {other}_bandwidth, {SEPARATION * outer:.3g} rad/s: raise it, or "
                f"lower the {other}_bandwidth to {inner / SEPARATION:.3g} rad/s (default attitude_bandwidth falls with "
                "the rotor_lag of the vehicle, default rod_bandwidth rises with √(gravity / rod_length))",
                f"{inner:.3g} rad/s",
            )
