"""The almost global law's gains, their defaults for a vehicle, and the outer loop that they set, (B1) and (B2)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import casadi as ca

from flypend.errors import InputError
from flypend.geometry import Scalar, Vector
from flypend.laws.gain import DELAY_REACH, NOT_NEGATIVE, POSITIVE, POSITIVE_SHARE, Bounds, Gain, check_gravity, table
from flypend.laws.step import Step
from flypend.model import Vehicle

# Powers of l and of √(l/g) with which a default grows, by its unit.
POWERS = {"m": (1, 0), "m²": (2, 0), "m/s": (1, -1), "1/s": (0, -1), "1/s²": (0, -2)}


def _gain(name: str, factor: float, unit: str, doc: str, bounds: Bounds = POSITIVE, label: str = "") -> Gain:
    """Return the gain `name`, whose default is `factor` in the vehicle's own `unit`."""
    length, time = POWERS[unit]

    def value(vehicle: Vehicle) -> float:
        check_gravity(vehicle)
        return float(factor * vehicle.l**length * math.sqrt(vehicle.l / vehicle.g) ** time)

    return Gain(name, value, unit, doc, bounds, label=label)


FADE = Bounds(0.5, 1.0)

# Tuned by CMA-ES under rotors on hehn2011 and made dimensionless: times scale with √(l/g), lengths with l. The theorem
# holds for all positive values.
GAINS = table(
    (
        _gain("position_stiffness", 0.23, "1/s²", "k_x: stiffness of the bob's horizontal position", label="position"),
        _gain("position_reach", 2.3, "m", "L: error beyond which the pull hardly grows"),
        _gain(
            "position_damping", 0.69, "1/s", "k_v: damping of the bob's horizontal velocity", label="position damping"
        ),
        _gain("position_speed", 3.7, "m/s", "L_v: speed beyond which it hardly grows"),
        _gain("height_stiffness", 0.57, "1/s²", "k_z: stiffness of the bob's height", label="height"),
        _gain("height_reach", 0.82, "m", "L_z: error beyond which the pull hardly grows"),
        _gain("height_damping", 0.435, "1/s", "k_vz: damping of the bob's vertical velocity", label="height damping"),
        _gain("height_speed", 0.48, "m/s", "L_vz: speed beyond which it hardly grows"),
        _gain("fall_damping", 0.155, "1/s", "k_f: damping that grows without limit in a fall only", NOT_NEGATIVE),
        _gain("fall_speed", 0.425, "m/s", "b: speed over which k_f fades in"),
        Gain(
            "shear", 0.2, "", "s: share of the height error that pulls sideways; moves -d off the rod at rest",
            Bounds(-1.0, 1.0),
        ),
        _gain("rod_stiffness", 1.2, "1/s²", "k_y/ρ_y: spring of the rod", label="rod"),
        _gain("rod_alignment", 0.34, "1/s", "Damping of the rod's direction"),
        _gain("rod_damping", 1.02, "1/s", "Damping of the rod's rate", label="rod damping"),
        _gain("rod_weight", 15.8, "m²", "ρ_y: weight of the rod's rate in V"),
        Gain("rod_barrier", 1.0, "", "Share of the potential that bars y = -d", POSITIVE_SHARE),
        Gain("rod_fade", 0.5, "", "1: the rod carries its full demand always; 0.5: none near y = -d", FADE),
        _gain("axis_stiffness", 3.4, "1/s²", "k/ρ: spring of the thrust axis", label="axis"),
        _gain("axis_alignment", 3.1, "1/s", "Damping of the thrust axis's direction"),
        _gain("axis_damping", 5.4, "1/s", "Damping of the thrust axis's rate", label="axis damping"),
        _gain("axis_weight", 7.4, "m²", "ρ: weight of the thrust axis's rate in V"),
        Gain("axis_barrier", 0.2, "", "Share of the potential that bars z = -z_d", POSITIVE_SHARE),
        Gain("axis_fade", 0.5, "", "1: full thrust always; 0.5: thrust fades near z = -z_d", FADE),
        _gain("yaw_damping", 1.2, "1/s", "Decay of the yaw rate", NOT_NEGATIVE),
        # The theorem knows of no rotors. With them, these two make up for most of their lag.
        Gain(
            "lead", lambda v: 2.1 if v.rotor_lag > 0 else 1.0, "",
            "Rotors are commanded f̂ + lead (f − f̂), f̂ being their modelled force", Bounds(low=1.0),
        ),
        # What `lead` leaves of the lag, and the sampling at 500 Hz, roughly.
        Gain(
            "latency", lambda v: 0.75 * v.rotor_lag, "s", "Delay that the flight computer compensates by prediction",
            NOT_NEGATIVE,
        ),
        Gain("delay_reach", 0.0, "s", DELAY_REACH, NOT_NEGATIVE),
    )
)  # fmt: skip


def rod_step(k: SimpleNamespace) -> Step:
    """Return the gains of Lemma S for the rod."""
    return Step(k.rod_stiffness, k.rod_alignment, k.rod_damping, k.rod_weight, k.rod_barrier, k.rod_fade)


def axis_step(k: SimpleNamespace) -> Step:
    """Return the gains of Lemma S for the thrust axis."""
    return Step(k.axis_stiffness, k.axis_alignment, k.axis_damping, k.axis_weight, k.axis_barrier, k.axis_fade)


def spring(e: Vector, k: SimpleNamespace) -> tuple[Scalar, Vector]:
    """Return U, m²/s², and σ_p = ∇U (3, 1), m/s², at position error `e` of the bob, m: (B1)."""
    sheared = ca.vertcat(e[0] + k.shear * e[2], e[1], e[2])
    L, L_z = k.position_reach, k.height_reach
    level = ca.sqrt(1 + (sheared[0] ** 2 + sheared[1] ** 2) / L**2)
    upright = ca.sqrt(1 + sheared[2] ** 2 / L_z**2)
    U = k.position_stiffness * L**2 * (level - 1) + k.height_stiffness * L_z**2 * (upright - 1)
    pull = k.position_stiffness / level * sheared[:2]
    lift = k.height_stiffness / upright * sheared[2]
    return U, ca.vertcat(pull, lift + k.shear * pull[0])


def damper(v: Vector, k: SimpleNamespace) -> Vector:
    """Return σ_v (3, 1), m/s², at velocity error `v` of the bob, m/s: σ_v·v > 0 for v ≠ 0. (B2)."""
    level = k.position_damping / ca.sqrt(1 + (v[0] ** 2 + v[1] ** 2) / k.position_speed**2) * v[:2]
    upright = k.height_damping / ca.sqrt(1 + v[2] ** 2 / k.height_speed**2) * v[2]
    b = k.fall_speed
    return ca.vertcat(level, upright + k.fall_damping * (v[2] + b - ca.sqrt(v[2] ** 2 + b**2)))


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
