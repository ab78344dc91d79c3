"""Vehicles that differ from world to world: numbers drawn when a world begins."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.envs.draws import Draws
from flypend.errors import InputError
from flypend.model import Vehicle
from flypend.model.rod import rod_inertia_factor
from flypend.plants.machine import Machine

Interval = tuple[float, float]
LEAST = 0.05  # of a ratio that a band leaves open downwards


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Randomisation:
    """Intervals (low, high) from which numbers are drawn uniformly whenever a world begins.

    Parameters
    ----------
    mass, bob_mass, rod_length : (2,)
        Ratio of true to nominal value. Inertias scale with their mass, that of the rod also with its length squared.
    lag : (2,)
        Ratio of the true to the nominal time constant of the rotors.
    strength, thrust : (2,)
        Ratio of the force of a rotor to that commanded. It is the product of both: `strength` is drawn for each rotor,
        `thrust` for all rotors together.
    delay : (2,)
        Delay of the commands in addition to that of the plant, s.
    wind : (2,)
        Magnitude of a constant force on the vehicle, N, in any direction.

    Raises
    ------
    InputError
        If an interval is empty or out of range.
    """

    mass: Interval = (1.0, 1.0)
    bob_mass: Interval = (1.0, 1.0)
    rod_length: Interval = (1.0, 1.0)
    lag: Interval = (1.0, 1.0)
    strength: Interval = (1.0, 1.0)
    thrust: Interval = (1.0, 1.0)
    delay: Interval = (0.0, 0.0)
    wind: Interval = (0.0, 0.0)

    def __post_init__(self) -> None:
        for entry in fields(self):
            low, high = errors.array(f"randomise.{entry.name}", getattr(self, entry.name), (2,)).tolist()
            errors.number(f"randomise.{entry.name}", low, at_least=0)
            if low == 0 and entry.name not in ("delay", "wind"):
                raise InputError(f"randomise.{entry.name}", "ratios > 0", f"{low:g}")
            if high < low:
                raise InputError(f"randomise.{entry.name}", "an interval (low, high)", f"({low:g}, {high:g})")
            object.__setattr__(self, entry.name, (low, high))

    @property
    def varies(self) -> bool:
        """Whether the vehicle itself differs from world to world."""
        return any(
            getattr(self, name) != (1.0, 1.0) for name in ("mass", "bob_mass", "rod_length", "strength", "thrust")
        )

    @classmethod
    def within_bands(cls, vehicle: Vehicle, delay: float = 0.0) -> Randomisation:
        """Return the intervals that the bands of `vehicle` give for these numbers; its other bands are not used.

        `delay` is that of the plant, s, which a band of delays includes. If a band reaches zero or below, its interval
        begins at a twentieth of the number in the file. Raises InputError if the vehicle has no bands.
        """
        if not vehicle.bands:
            wanted = "bands in the vehicle's file, as flypend vehicle new and flypend identify write them"
            raise InputError("randomise", wanted, f"none in {vehicle.name}")
        bands, found = vehicle.bands, {}
        written = {name: getattr(vehicle, name) for name in ("mass", "bob_mass", "rod_length")}
        written |= {"lag": vehicle.rotor_lag, "thrust": vehicle.thrust_scale, "strength": 1.0}
        names = {"lag": "rotor_lag", "thrust": "thrust_scale"}
        for name, value in written.items():
            if (band := bands.get(names.get(name, name))) is not None and value > 0:
                low, high = float(np.min(band[0])) / value, float(np.max(band[1])) / value
                found[name] = (max(low, LEAST), max(high, LEAST))
        if "delay" in bands:
            found["delay"] = tuple(max(0.0, end - delay) for end in bands["delay"])
        return cls(**found)


class Varied(Machine):
    """`vehicle` with masses, rod and strengths scaled by symbols; what it does not scale is the vehicle's own.

    Parameters
    ----------
    vehicle : Vehicle
        The nominal vehicle.
    numbers : SX (3 + n, 1)
        Ratios of mass, bob_mass and rod_length, and the strength of each rotor.
    """

    def __init__(self, vehicle: Vehicle, numbers: Any) -> None:
        mass, bob, length = numbers[0], numbers[1], numbers[2]
        # The rod's inertia scales with its mass and the square of its length, so the share of the point bob stays.
        own, at_pivot = mass * vehicle.mass, bob * (vehicle.M - vehicle.mass)
        equivalent = (own + at_pivot, bob * vehicle.m, length * vehicle.l)
        super().__init__(
            vehicle, own, bob * vehicle.bob_mass, *equivalent, mass, vehicle.drag_ratio,
            reach=length * vehicle.reach, rod_spin_inertia=rod_inertia_factor(bob, length) * vehicle.rod_spin_inertia,
        )  # fmt: skip

    @staticmethod
    def drawn(vehicle: Vehicle, ranges: Randomisation, draws: Draws) -> Any:
        """Draw the numbers (3 + n, 1); none (0, 1) if nothing varies."""
        if not ranges.varies:
            return ca.SX(0, 1)
        ratios = [draws.between(*getattr(ranges, name)) for name in ("mass", "bob_mass", "rod_length")]
        strengths = ca.vertcat(*(draws.between(*ranges.strength) for _ in vehicle.rotor_spins))
        return ca.vertcat(*ratios, draws.between(*ranges.thrust) * strengths)
