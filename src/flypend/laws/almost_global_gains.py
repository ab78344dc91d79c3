"""Gains of the almost global law, and their defaults for a vehicle: times scale with √(l/g), lengths with l."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any

from flypend.errors import InputError
from flypend.laws.gain import DELAY_REACH, NOT_NEGATIVE, POSITIVE, POSITIVE_SHARE, Bounds, Gain, check_gravity, table
from flypend.laws.step import Step
from flypend.model import Vehicle


def _scale(factor: float, length: float, time: float) -> Callable[[Vehicle], float]:
    """Return `factor` in units of l^`length` √(l/g)^`time`, as a function of the vehicle."""

    def value(vehicle: Vehicle) -> float:
        check_gravity(vehicle)
        return float(factor * vehicle.l**length * math.sqrt(vehicle.l / vehicle.g) ** time)

    return value


def _lead(vehicle: Vehicle) -> float:
    return 2.1 if vehicle.rotor_lag > 0 else 1.0


def _latency(vehicle: Vehicle) -> float:
    """Return what `lead` leaves of the lag, and the sampling at 500 Hz, roughly."""
    return 0.75 * vehicle.rotor_lag


FADE = Bounds(0.5, 1.0)

# Tuned by CMA-ES under rotors on hehn2011 and made dimensionless; the theorem holds for all positive values.
GAINS = table(
    (
        Gain(
            "position_stiffness", _scale(0.23, 0, -2), "1/s²", "k_x: stiffness of the bob's horizontal position",
            POSITIVE, label="position",
        ),
        Gain("position_reach", _scale(2.3, 1, 0), "m", "L: error beyond which the pull hardly grows", POSITIVE),
        Gain(
            "position_damping", _scale(0.69, 0, -1), "1/s", "k_v: damping of the bob's horizontal velocity", POSITIVE,
            label="position damping",
        ),
        Gain(
            "position_speed", _scale(3.7, 1, -1), "m/s", "L_v: speed beyond which it hardly grows", POSITIVE,
        ),
        Gain(
            "height_stiffness", _scale(0.57, 0, -2), "1/s²", "k_z: stiffness of the bob's height", POSITIVE,
            label="height",
        ),
        Gain("height_reach", _scale(0.82, 1, 0), "m", "L_z: error beyond which the pull hardly grows", POSITIVE),
        Gain(
            "height_damping", _scale(0.435, 0, -1), "1/s", "k_vz: damping of the bob's vertical velocity", POSITIVE,
            label="height damping",
        ),
        Gain(
            "height_speed", _scale(0.48, 1, -1), "m/s", "L_vz: speed beyond which it hardly grows", POSITIVE,
        ),
        Gain(
            "fall_damping", _scale(0.155, 0, -1), "1/s", "k_f: damping that grows without limit in a fall only",
            NOT_NEGATIVE,
        ),
        Gain("fall_speed", _scale(0.425, 1, -1), "m/s", "b: speed over which k_f fades in", POSITIVE),
        Gain(
            "shear", 0.2, "", "s: share of the height error that pulls sideways; moves -d off the rod at rest",
            Bounds(-1.0, 1.0),
        ),
        Gain("rod_stiffness", _scale(1.2, 0, -2), "1/s²", "k_y/ρ_y: spring of the rod", POSITIVE, label="rod"),
        Gain("rod_alignment", _scale(0.34, 0, -1), "1/s", "Damping of the rod's direction", POSITIVE),
        Gain("rod_damping", _scale(1.02, 0, -1), "1/s", "Damping of the rod's rate", POSITIVE, label="rod damping"),
        Gain("rod_weight", _scale(15.8, 2, 0), "m²", "ρ_y: weight of the rod's rate in V", POSITIVE),
        Gain("rod_barrier", 1.0, "", "Share of the potential that bars y = -d", POSITIVE_SHARE),
        Gain("rod_fade", 0.5, "", "1: the rod carries its full demand always; 0.5: none near y = -d", FADE),
        Gain(
            "axis_stiffness", _scale(3.4, 0, -2), "1/s²", "k/ρ: spring of the thrust axis", POSITIVE, label="axis",
        ),
        Gain("axis_alignment", _scale(3.1, 0, -1), "1/s", "Damping of the thrust axis's direction", POSITIVE),
        Gain(
            "axis_damping", _scale(5.4, 0, -1), "1/s", "Damping of the thrust axis's rate", POSITIVE,
            label="axis damping",
        ),
        Gain("axis_weight", _scale(7.4, 2, 0), "m²", "ρ: weight of the thrust axis's rate in V", POSITIVE),
        Gain("axis_barrier", 0.2, "", "Share of the potential that bars z = -z_d", POSITIVE_SHARE),
        Gain("axis_fade", 0.5, "", "1: full thrust always; 0.5: thrust fades near z = -z_d", FADE),
        Gain("yaw_damping", _scale(1.2, 0, -1), "1/s", "Decay of the yaw rate", NOT_NEGATIVE),
        # The theorem knows of no rotors. With them, these two make up for most of their lag.
        Gain("lead", _lead, "", "Rotors are commanded f̂ + lead (f − f̂), f̂ being their modelled force", Bounds(low=1.0)),
        Gain("latency", _latency, "s", "Delay that the flight computer compensates by prediction", NOT_NEGATIVE),
        Gain("delay_reach", 0.0, "s", DELAY_REACH, NOT_NEGATIVE),
    )
)  # fmt: skip


def rod_step(k: SimpleNamespace) -> Step:
    """Return the gains of Lemma S for the rod."""
    return Step(k.rod_stiffness, k.rod_alignment, k.rod_damping, k.rod_weight, k.rod_barrier, k.rod_fade)


def axis_step(k: SimpleNamespace) -> Step:
    """Return the gains of Lemma S for the thrust axis."""
    return Step(k.axis_stiffness, k.axis_alignment, k.axis_damping, k.axis_weight, k.axis_barrier, k.axis_fade)


def demand_stays_upward(vehicle: Vehicle, gains: Mapping[str, Any]) -> Mapping[str, Any]:
    """Raise InputError unless the largest downward part of σ_p + σ_v is below g, so that A·e₃ > 0. Prepares nothing."""
    most = largest_descent(gains)
    if most >= vehicle.gravity:
        bound = f"|shear| k_x L + k_z L_z + k_vz L_vz + k_f b < {vehicle.gravity:g} m/s², gravity"
        raise InputError("gains", bound, f"{most:.4g} m/s²")
    return {}


def largest_descent(gains: Mapping[str, Any]) -> float:
    """Return |s| k_x L + k_z L_z + k_vz L_vz + k_f b, m/s²: the largest downward acceleration demanded of the bob."""
    return float(
        abs(gains["shear"]) * gains["position_stiffness"] * gains["position_reach"]
        + gains["height_stiffness"] * gains["height_reach"]
        + gains["height_damping"] * gains["height_speed"]
        + gains["fall_damping"] * gains["fall_speed"]
    )
