"""The nominal vehicle of the flight computer: numeric, or symbolic for exported code that receives it at run time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import casadi as ca

from flypend.geometry import Numbers
from flypend.model import Vehicle
from flypend.model.altered import Altered


@dataclass(frozen=True)
class Nominal:
    """The nominal vehicle, with numeric or symbolic parameters.

    Parameters
    ----------
    vehicle : Vehicle
        A vehicle, whose parameters are constants of the equations, or an object with the same attributes as symbols.
        The lag of its rotors is always a number: no generated code evaluates an exponential at run time.
    symbols : SX (k, 1)
        The symbols of `vehicle`; empty for a numeric vehicle.
    """

    vehicle: Any
    symbols: Numbers = field(default_factory=lambda: ca.SX(0, 1))

    rotors = property(lambda self: len(self.vehicle.rotor_spins), doc="Number of rotors.")
    lag = property(lambda self: self.vehicle.rotor_lag, doc="Time constant of the rotors, s.")

    @classmethod
    def limited(cls, vehicle: Vehicle) -> Nominal:
        """The nominal `vehicle` with its parameters as constants, and symbols for least and largest rotor force, N."""
        limits = ca.SX.sym("limits", 2)
        return cls(Altered(vehicle, rotor_limits=(limits[0], limits[1])), limits)
