"""A vehicle in its own units: rod length l, √(l/g), mass M + m. One compiled solver serves all vehicles of n rotors.

Rotor forces are in units of the hover force (M+m) g/n. With these units l = g = M + m = 1, and hover takes forces of 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend.errors import InputError
from flypend.model import Vehicle
from flypend.model.state import SIZE


@dataclass(frozen=True)
class Scaled:
    """Symbols of a vehicle in its own units, with the attributes that the equations of motion read.

    Parameters
    ----------
    numbers : SX (k, 1)
        Bob mass, inverse inertia and inertia (upper triangles), the rows of the mixing matrix for the moment, and
        constant forces from outside on vehicle and bob, in weights.
    rotors : int
        Number of rotors n.
    """

    numbers: Any
    rotors: int

    @classmethod
    def symbols(cls, rotors: int) -> Scaled:
        """Return the symbols of a vehicle with this many rotors."""
        return cls(ca.SX.sym("vehicle", size(rotors)), rotors)

    l = property(lambda self: 1.0, doc="Length of the rod.")
    g = property(lambda self: 1.0, doc="Gravitational acceleration.")
    m = property(lambda self: self.numbers[0], doc="Mass of the bob.")
    M = property(lambda self: 1 - self.numbers[0], doc="Mass that moves with the pivot.")
    I_inv = property(lambda self: _symmetric(self.numbers[1:7]), doc="Inverse of the inertia matrix.")
    I = property(lambda self: _symmetric(self.numbers[7:13]), doc="Inertia matrix, body frame.")

    @property
    def outside(self) -> Any:
        """Forces from outside on vehicle and bob (6, 1)."""
        return self.numbers[-6:]

    @property
    def vehicle(self) -> Any:
        """The machine itself, as what equations take for a `Vehicle`."""
        return self

    def mixing(self) -> Any:
        """Return the matrix (4, n) from rotor forces to thrust and moment in the body frame."""
        n = self.rotors
        return ca.vertcat(ca.DM.ones(1, n) / n, ca.reshape(self.numbers[13 : 13 + 3 * n], n, 3).T)


def size(rotors: int) -> int:
    """Return the number of numbers of a vehicle with this many rotors."""
    return 13 + 3 * rotors + 6


def _symmetric(upper: Any) -> Any:
    a, b, c, d, e, f = ca.vertsplit(upper)
    return ca.vertcat(ca.horzcat(a, b, c), ca.horzcat(b, d, e), ca.horzcat(c, e, f))


@dataclass(frozen=True)
class Units:
    """The units of a vehicle: `length` (m), `time` (s), `force` (N, of one rotor)."""

    length: float
    time: float
    force: float

    @classmethod
    def of(cls, vehicle: Vehicle) -> Units:
        """Return the units of `vehicle`. Raises InputError without gravity, which gives no unit of time."""
        if vehicle.gravity == 0:
            raise InputError("vehicle.gravity", "gravity > 0, without which no pose is inverted", "0 m/s²")
        return cls(vehicle.l, float(np.sqrt(vehicle.l / vehicle.g)), vehicle.weight / len(vehicle.rotor_spins))

    def numbers(self, vehicle: Vehicle) -> NDArray[np.float64]:
        """Return the numbers of `vehicle` in its own units, without forces from outside, for symbols of `Scaled`."""
        mass, upper = vehicle.M + vehicle.m, np.triu_indices(3)
        inertia = vehicle.I / (mass * self.length**2)
        moments = vehicle.mixing()[1:] * self.force / (mass * vehicle.g * self.length)
        return np.concatenate(
            [[vehicle.m / mass], np.linalg.inv(inertia)[upper], inertia[upper], moments.ravel(), np.zeros(6)]
        )

    @property
    def of_state(self) -> NDArray[np.float64]:
        """Units of the entries of a packed state (24,)."""
        rate = 1 / self.time
        entries = [[self.length] * 3, [self.length * rate] * 3, [1.0] * 9, [rate] * 3, [1.0] * 3, [rate] * 3]
        return np.concatenate(entries)

    def states(self, rotors: int) -> NDArray[np.float64]:
        """Return the units of the entries of a packed state followed by the forces of `rotors` rotors."""
        return np.append(self.of_state, np.full(rotors, self.force))


assert len(Units(1.0, 1.0, 1.0).of_state) == SIZE
