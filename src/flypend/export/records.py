"""The records that cross the border to C: one table for the header, the symbols and the memory layout."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from flypend.compile.record import Field, Record
from flypend.laws import BoundLaw
from flypend.model import State, Vehicle

# A law follows pivot and bob up to their snap; the bob's snap takes eight derivatives of the pivot's path.
ORDERS = ("", "_dot", "_ddot", "_dddot", "_ddddot")
PATH_ORDERS = 9
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
    forces = Field("force", _count(vehicle), "N")
    return Record("rotors", "Forces of the rotors, in the order of the vehicle.", (forces,))


def params_record(vehicle: Vehicle) -> Record:
    """The constants of `vehicle` that the C code takes at run time."""
    inertia = [Field("inertia", 3, "principal moments about the body axes x, y, z, kg m^2")]
    if not _diagonal(vehicle):
        inertia = [Field("inertia", 6, "xx, yy, zz, xy, xz, yz entries of the inertia matrix, body, kg m^2")]
    return Record(
        "params",
        "The vehicle.",
        (
            Field("mass", 0, "M, of the vehicle without the pendulum that swings as its rod does, kg"),
            Field("bob_mass", 0, "m, of the bob of that pendulum, kg"),
            Field("rod_length", 0, "l, of that pendulum, m"),
            Field("gravity", 0, "g, m/s^2"),
            *inertia,
            Field("rotor_least", 0, "least force of one rotor, N"),
            Field("rotor_largest", 0, "largest force of one rotor, N"),
            Field("per_roll", _count(vehicle), "force of each rotor per moment about x, N/(N m)"),
            Field("per_pitch", _count(vehicle), "force of each rotor per moment about y, N/(N m)"),
            Field("per_yaw", 0, "size of the force of each rotor per moment about z, N/(N m)"),
            Field("roll_arm", _count(vehicle), "moment about x per force of each rotor, m"),
            Field("pitch_arm", _count(vehicle), "moment about y per force of each rotor, m"),
            Field("yaw_arm", 0, "size of the moment about z per force of each rotor, m"),
            Field("spin", _count(vehicle), "+1 or -1: sign of the moment about z of each rotor; the code is for these"),
        ),
    )


def gains_record(law: BoundLaw, names: Sequence[str]) -> Record:
    """The gains `names` of `law` that its equations contain."""
    fields = tuple(Field(name, 0, law.table[name].describe() or "see the law") for name in names)
    return Record("gains", f"Gains of the {law.name} law.", fields or (Field("none", 0, "no gain is left; keep 0"),))


def params_of(vehicle: Vehicle) -> Any:
    """The numbers of `params_record` for `vehicle`."""
    I, (tilting, per_yaw, spins), mixing = vehicle.inertia, vehicle.sharing(), vehicle.mixing()
    inertia = np.diag(I) if _diagonal(vehicle) else [*np.diag(I), I[0, 1], I[0, 2], I[1, 2]]
    return np.concatenate(
        [
            [vehicle.M, vehicle.m, vehicle.l, vehicle.gravity],
            inertia,
            vehicle.rotor_limits,
            tilting[:, 0],
            tilting[:, 1],
            [per_yaw],
            mixing[1],
            mixing[2],
            [abs(mixing[3, 0])],
            spins,
        ]
    )


def state_numbers(packed: Any, forces: Any) -> Any:
    """The numbers of `STATE`, (..., 30), for packed states (..., 24) and external forces (..., 6), e₃ up."""
    return np.concatenate([packed, forces], axis=-1)


def _count(vehicle: Vehicle) -> int:
    return len(vehicle.rotor_spins)


def _diagonal(vehicle: Vehicle) -> bool:
    return bool(np.array_equal(vehicle.inertia, np.diag(np.diag(vehicle.inertia))))


assert STATE.length == State(y=(0, 0, 1)).packed().size + 6
