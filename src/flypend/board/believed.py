"""The vehicle that the flight computer believes in: its numbers, or symbols that exported code fills in at run time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import casadi as ca

from flypend.model import Vehicle


@dataclass(frozen=True)
class Believed:
    """A vehicle that equations can be written for.

    Parameters
    ----------
    vehicle : Vehicle
        A vehicle, or what has its attributes as symbols.
    rotors : int
        Number of its rotors.
    lag : float
        Time constant of its rotors, s, always a number: no code takes an exponential at run time.
    symbols : SX (k, 1)
        The symbols that it is written in; none for a vehicle of numbers.
    """

    vehicle: Any
    rotors: int
    lag: float
    symbols: Any = field(default_factory=lambda: ca.SX(0, 1))

    @classmethod
    def numbers(cls, vehicle: Vehicle) -> Believed:
        """A `vehicle` whose numbers are constants of the equations."""
        return cls(vehicle, len(vehicle.rotor_spins), vehicle.rotor_lag)
