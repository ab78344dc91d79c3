"""The records that cross the border to C: one table for the header, the symbols and the memory layout.

With a vehicle whose numbers are symbols, so that exported code takes them at run time.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.record import Field, Record
from flypend.errors import InputError
from flypend.laws import BoundLaw
from flypend.model import Vehicle
from flypend.model.state import FLIP, SIZE

# A law follows pivot and bob up to their snap; the bob's snap takes eight derivatives of the pivot's path.
ORDERS = ("", "_dot", "_ddot", "_dddot", "_ddddot")
PATH_ORDERS = 9
FORCES = 6  # external forces on vehicle and bob
# What Python has as names, but C or C++ for something else. Gains are fields of a struct.
RESERVED = (
    "alignas alignof and_eq asm auto bitand bitor bool case catch char char16_t char32_t char8_t co_await co_return "
    "co_yield compl concept const const_cast consteval constexpr constinit decltype default delete do double "
    "dynamic_cast enum explicit export extern false float friend goto inline int long mutable namespace new noexcept "
    "not_eq nullptr operator or_eq private protected public register reinterpret_cast requires restrict short signed "
    "sizeof static static_assert static_cast struct switch template this thread_local throw true typedef typeid "
    "typename typeof union unsigned using virtual void volatile wchar_t xor xor_eq"
)
UNITS = ("m", "m/s", "m/s²", "m/s³", "m/s⁴")

_MOTION = (
    Field("x", 3, "position of the pivot, world, m"),
    Field("x_dot", 3, "its velocity, world, m/s"),
    Field("R", 9, "rotation from body to world, by rows"),
    Field("omega", 3, "angular velocity, body, rad/s"),
    Field("y", 3, "unit vector from the pivot to the bob, world"),
    Field("y_dot", 3, "its rate, world, 1/s; tangent: y . y_dot = 0"),
)
MEASUREMENT = Record(
    "measurement",
    "State of vehicle and pendulum as measured. World frame with z up, body frame front-left-up.",
    _MOTION,
)
STATE = Record(
    "state",
    "State of vehicle and pendulum, for those who estimate external forces themselves.",
    (
        *_MOTION,
        Field("force_on_vehicle", 3, "estimated external force on the vehicle, world, N; 0 if there is none"),
        Field("force_on_bob", 3, "the same on the bob, world, N"),
    ),
)
assert STATE.length == SIZE + FORCES
REFERENCE = Record(
    "reference",
    "What the law follows, world frame; all 0 but the bob's height l for hover at the origin.",
    tuple(
        Field(f"{name}{order}", 3, f"{what}, world, {unit}")
        for name, what in (("x", "pivot"), ("p", "bob, p = x + l y"))
        for order, unit in zip(ORDERS, UNITS, strict=True)
    ),
)
PATH = Record(
    "path",
    "Path of the pivot: its position and time derivatives. Leave those that you do not have at 0.",
    tuple(
        Field(f"x{i}", 3, f"derivative {i} of the position, world, m/s^{i}" if i else "position, world, m")
        for i in range(PATH_ORDERS)
    ),
)
WRENCH = Record(
    "wrench",
    "What the rotors shall do.",
    (Field("thrust", 0, "along the body's z axis, up, N"), Field("moment", 3, "body frame front-left-up, N m")),
)


def rotors_record(vehicle: Vehicle) -> Record:
    """Forces of the rotors of `vehicle`, in its order."""
    forces = (Field("force", len(vehicle.rotor_spins), "N"),)
    return Record("rotors", "Forces of the rotors, in the order of the vehicle.", forces)


def _constants(vehicle: Vehicle) -> list[tuple[Field, Any]]:
    """What the C code takes of `vehicle` at run time: each field with its numbers."""
    I, (tilting, per_yaw, spins), mixing = vehicle.inertia, vehicle.sharing(), vehicle.mixing()
    n, principal = len(spins), np.diag(I)
    inertia: tuple[Field, Any] = (
        Field("inertia", 3, "principal moments about the body axes x, y, z, kg m^2"),
        principal,
    )
    if not np.array_equal(I, np.diag(principal)):
        full = Field("inertia", 6, "xx, yy, zz, xy, xz, yz entries of the inertia matrix, body, kg m^2")
        inertia = (full, [*principal, I[0, 1], I[0, 2], I[1, 2]])
    least, largest = vehicle.rotor_limits
    return [
        (Field("mass", 0, "M, of the vehicle without the pendulum that swings as its rod does, kg"), vehicle.M),
        (Field("bob_mass", 0, "m, of the bob of that pendulum, kg"), vehicle.m),
        (Field("rod_length", 0, "l, of that pendulum, m"), vehicle.l),
        (Field("gravity", 0, "g, m/s^2"), vehicle.gravity),
        inertia,
        (Field("rotor_least", 0, "least force of one rotor, N"), least),
        (Field("rotor_largest", 0, "largest force of one rotor, N"), largest),
        (Field("per_roll", n, "force of each rotor per moment about x, N/(N m)"), tilting[:, 0]),
        (Field("per_pitch", n, "force of each rotor per moment about y, N/(N m)"), tilting[:, 1]),
        (Field("per_yaw", 0, "size of the force of each rotor per moment about z, N/(N m)"), per_yaw),
        (Field("roll_arm", n, "moment about x per force of each rotor, m"), mixing[1]),
        (Field("pitch_arm", n, "moment about y per force of each rotor, m"), mixing[2]),
        (Field("yaw_arm", 0, "size of the moment about z per force of each rotor, m"), abs(mixing[3, 0])),
        (Field("spin", n, "+1 or -1: sign of the moment about z of each rotor; the code is for these"), spins),
    ]


def params_record(vehicle: Vehicle) -> Record:
    """The constants of `vehicle` that the C code takes at run time."""
    return Record("params", "The vehicle.", tuple(field for field, _ in _constants(vehicle)))


def params_of(vehicle: Vehicle) -> Any:
    """The numbers of `params_record` for `vehicle`."""
    return np.concatenate([np.ravel(numbers) for _, numbers in _constants(vehicle)])


def gains_record(law: BoundLaw, names: Sequence[str]) -> Record:
    """The gains `names` of `law` that its equations contain. Raises InputError for a name that C or C++ reserves."""
    if taken := set(RESERVED.split()).intersection(names):
        raise InputError("law", "gains with other names than words of C and C++", ", ".join(sorted(taken)))
    fields = tuple(Field(name, 0, law.table[name].describe() or "see the law") for name in names)
    return Record("gains", f"Gains of the {law.name} law.", fields or (Field("none", 0, "no gain is left; keep 0"),))


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
        self.rod_inertia = 0.0  # of the equivalent simple pendulum
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
