"""A vehicle some of whose numbers are others, such as symbols, which `Vehicle` itself would refuse."""

from __future__ import annotations

from typing import Any

import casadi as ca

from flypend.geometry import Numbers
from flypend.model.state import E3Direction


class Altered:
    """`vehicle` with `others` in place of some of its attributes; those that follow from them do not change.

    Only the mixing follows another `drag_ratio`.
    """

    def __init__(self, vehicle: Any, **others: Any) -> None:
        self._vehicle, self._others = vehicle, others
        self.__dict__ |= others

    def __getattr__(self, name: str) -> Any:
        return getattr(self._vehicle, name)

    def in_frame(self, e3: E3Direction) -> Altered:
        """As `Vehicle.in_frame`; only with e₃ up if the inertia is another."""
        assert e3 == "up" or "I" not in self._others
        return Altered(self._vehicle.in_frame(e3), **self._others)

    def mixing(self, e3: E3Direction = "up") -> Numbers:
        """As `Vehicle.mixing`; only with e₃ up if the `drag_ratio` is another."""
        rows = self._vehicle.mixing(e3)
        if "drag_ratio" not in self._others:
            return rows
        assert e3 == "up"
        return ca.vertcat(rows[:3], self.drag_ratio * ca.DM(self.rotor_spins).T)
