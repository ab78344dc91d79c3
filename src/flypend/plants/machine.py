"""A machine whose numbers are symbols: inputs of machine code, which machines that differ only in them share."""

from __future__ import annotations

import numpy as np

from flypend.geometry import Numbers, Scalar
from flypend.model import Vehicle
from flypend.model.altered import Altered
from flypend.plants.plant import Plant

# Ratios of a plant's `mismatch` that are inputs of sampled flights.
RATIOS = ("mass", "bob_mass", "rod_length", "rod_inertia", "inertia", "drag_ratio")
SIZE = 7  # numbers of a machine without those of its motors


class Machine(Altered):
    """`vehicle` with other masses, rod, inertia and torque ratio, which may be symbols; all else is the vehicle's own.

    Parameters
    ----------
    vehicle : Vehicle
        What it is like.
    mass, bob_mass : scalar
        Of the vehicle itself and of the rod with its bob, kg.
    M, m, l : scalar
        Masses and length of the equivalent point bob, as in `Vehicle`.
    inertia : scalar
        Factor of the vehicle's inertia.
    drag_ratio : scalar
        Torque per thrust of a rotor, m.
    others : scalar
        Any other attributes of `Vehicle` by name.
    """

    def __init__(
        self, vehicle: Vehicle, mass: Scalar, bob_mass: Scalar, M: Scalar, m: Scalar, l: Scalar, inertia: Scalar,
        drag_ratio: Scalar, **others: Scalar,
    ) -> None:  # fmt: skip
        super().__init__(
            vehicle, mass=mass, bob_mass=bob_mass, M=M, m=m, l=l, I=inertia * vehicle.I, I_inv=vehicle.I_inv / inertia,
            drag_ratio=drag_ratio, **others,
        )  # fmt: skip


def is_wrong(plant: Plant) -> bool:
    """Whether masses, rod, inertia or motors of `plant` differ from those that the law believes."""
    return bool(plant.mismatch.keys() & set(RATIOS)) or plant.strength != 1.0 or plant.sag > 0


def as_nominal(plant: Plant) -> Plant:
    """Return `plant` with the numbers of `machine_numbers` as the law believes them."""
    mismatch = {name: ratio for name, ratio in plant.mismatch.items() if name not in RATIOS}
    return plant.replace(mismatch=mismatch, strength=1.0, sag=0.0)


def machine_numbers(vehicle: Vehicle, plant: Plant) -> Numbers:
    """Return the numbers (7 + n + 1,) of the machine that flies as `vehicle` through `plant`, of its n rotors and sag.

    They are the arguments of `Machine` in SI units, the strength of each rotor, and the battery's sag.
    """
    true = plant.true_vehicle(vehicle)
    inertia = plant.mismatch.get("inertia", 1.0)
    own = (true.mass, true.bob_mass, true.M, true.m, true.l, inertia, true.drag_ratio)
    return np.concatenate([own, np.broadcast_to(plant.strength, len(true.rotor_spins)), [plant.sag]])
