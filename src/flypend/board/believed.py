"""The nominal vehicle of the flight computer: numeric, or symbolic for exported code that receives it at run time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import casadi as ca

from flypend.geometry import Numbers
from flypend.model import Vehicle
from flypend.model.altered import Altered


@dataclass(frozen=True)
class Believed:
    """The nominal vehicle, with numeric or symbolic parameters.

    Parameters
    ----------
    vehicle : Vehicle
        A vehicle, or an object with the same attributes as symbols.
    rotors : int
        Number of its rotors.
    lag : float
        Time constant of its rotors, s. Always a number: no generated code evaluates an exponential at run time.
    symbols : SX (k, 1)
        The symbols of `vehicle`; empty for a numeric vehicle.
    """

    vehicle: Any
    rotors: int
    lag: float
    symbols: Numbers = field(default_factory=lambda: ca.SX(0, 1))

    @classmethod
    def numbers(cls, vehicle: Vehicle) -> Believed:
        """The nominal `vehicle` with its parameters as constants of the equations."""
        return cls(vehicle, len(vehicle.rotor_spins), vehicle.rotor_lag)

    @classmethod
    def limited(cls, vehicle: Vehicle) -> Believed:
        """The nominal `vehicle` with its parameters as constants, and symbols for least and largest rotor force, N."""
        limits = ca.SX.sym("limits", 2)
        limited = Altered(vehicle, rotor_limits=(limits[0], limits[1]))
        return cls(limited, len(vehicle.rotor_spins), vehicle.rotor_lag, limits)
