"""A vehicle whose numbers are symbols, so that exported code takes them at run time."""

from __future__ import annotations

from typing import Any

import casadi as ca

from flypend.compile.record import Record
from flypend.model import Vehicle
from flypend.model.state import FLIP


class SymbolicVehicle:
    """A vehicle whose constants are the `symbols` of `records.params_record`, with what equations ask a `Vehicle` for.

    Spins and lag of its rotors are those of `vehicle`.
    """

    def __init__(self, symbols: Any, record: Record, vehicle: Vehicle) -> None:
        v = record.split(symbols)
        self.values = v
        self.M = self.mass = v["mass"]
        self.m = self.bob_mass = v["bob_mass"]
        self.l = self.rod_length = v["rod_length"]
        self.g = self.gravity = v["gravity"]
        self.I = self.inertia = _inertia(v["inertia"])
        self.rotor_limits = (v["rotor_least"], v["rotor_largest"])
        self.rotor_spins, self.rotor_lag = vehicle.sharing()[2], vehicle.rotor_lag
        self.weight = (self.M + self.m) * self.g
        self.name = "symbolic"

    def sharing(self) -> tuple[Any, Any, Any]:
        """As `Vehicle.sharing`, from the symbols."""
        tilting = ca.horzcat(self.values["per_roll"], self.values["per_pitch"])
        return tilting, self.values["per_yaw"], self.rotor_spins

    def mixing(self) -> Any:
        """As `Vehicle.mixing` with e₃ up, from the symbols."""
        v, spins = self.values, ca.DM(self.rotor_spins)
        return ca.vertcat(ca.SX.ones(1, spins.numel()), v["roll_arm"].T, v["pitch_arm"].T, (v["yaw_arm"] * spins).T)

    @property
    def I_inv(self) -> Any:
        """Inverse of the inertia matrix."""
        return ca.inv_minor(self.I)

    def in_frame(self, e3: str) -> SymbolicVehicle:
        """The vehicle in the body frame of `e3`."""
        if e3 == "up" or self.I.nnz() == 3:
            return self
        turned = object.__new__(SymbolicVehicle)
        turned.__dict__.update(self.__dict__, I=FLIP @ self.I @ FLIP)
        return turned


def _inertia(entries: Any) -> Any:
    if entries.numel() == 3:
        return ca.diag(entries)
    xx, yy, zz, xy, xz, yz = ca.vertsplit(entries)
    return ca.vertcat(ca.horzcat(xx, xy, xz), ca.horzcat(xy, yy, yz), ca.horzcat(xz, yz, zz))
