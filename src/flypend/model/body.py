"""Mounts, and the parts of a machine that its rod can touch.

A rod on a `gimbal` turns freely about the whole machine. On a `hub`, a ball joint between the arms, it must not touch
rotor discs or arms. In a `cup` on top it stands loosely: it is lost beyond the cup's cone, or if the cup had to pull.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields
from typing import Literal

import numpy as np

from flypend import errors

MountKind = Literal["gimbal", "hub", "cup"]
MOUNTS: tuple[MountKind, ...] = ("gimbal", "hub", "cup")


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Body:
    """The solid parts of a machine that the rod can touch, around its pivot, m.

    Parameters
    ----------
    disc_radius : float
        Radius of every rotor disc, which is flat and lies at its rotor's position.
    arm_radius : float
        Radius of the arms, capsules from the rim of the hub to the rotors.
    hub_radius : float
        Radius of the hub. Slots between the arms let the rod pass through it.
    rod_radius : float
        Radius of the rod, a capsule from the rim of the hub to the bob.
    cup_angle : float
        Largest angle between rod and thrust axis in a cup, rad.

    Raises
    ------
    InputError
        If a radius is not positive or the angle is not between 0 and π/2.
    """

    disc_radius: float
    arm_radius: float
    hub_radius: float
    rod_radius: float = 0.005
    cup_angle: float = np.pi / 3

    def __post_init__(self) -> None:
        for entry in fields(self):
            most = np.pi / 2 if entry.name == "cup_angle" else None
            unit = "rad" if entry.name == "cup_angle" else "m"
            value = errors.number(f"body.{entry.name}", getattr(self, entry.name), above=0, at_most=most, unit=unit)
            object.__setattr__(self, entry.name, value)

    def to_dict(self) -> dict[str, float]:
        """Return the fields as numbers, as in a vehicle TOML file."""
        return asdict(self)
