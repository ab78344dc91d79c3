"""Rods as fields of a vehicle: mass, centre of mass and moment of inertia of what stands on the pivot."""

from __future__ import annotations

from typing import Any

from flypend import errors
from flypend.geometry import Vector


@errors.named_arguments
def uniform_rod(mass: float, length: float) -> dict[str, float]:
    """Return the fields of a `Vehicle` for a uniform rod of `mass` (kg) and `length` (m), held at one end.

    `vehicle.replace(**uniform_rod(0.05, 1.0))` is the vehicle with that rod. Raises InputError.
    """
    return rod_with_bob(mass, length, bob_mass=0.0)


@errors.named_arguments
def rod_with_bob(mass: float, length: float, bob_mass: float) -> dict[str, float]:
    """Return the fields of a `Vehicle` for a uniform rod that carries a point mass `bob_mass` (kg) at its far end.

    `mass` (kg) and `length` (m) are those of the rod alone. Raises InputError.
    """
    m = errors.number("mass", mass, at_least=0, unit="kg")
    L = errors.number("length", length, above=0, unit="m")
    b = errors.number("bob_mass", bob_mass, at_least=0, unit="kg")
    total = errors.number("mass", m + b, above=0, unit="kg")
    return {
        "bob_mass": total,
        "rod_length": L * ((m / 2 + b) / total),
        "rod_inertia": m * L**2 / 12 + m * b / total * (L / 2) ** 2,  # parallel axes
        "rod_end": L,
    }


def rod_inertia_factor(heavier: float, longer: float) -> float:
    """Return the factor of moments of inertia of a rod whose mass and lengths change by these factors."""
    return heavier * longer**2


def stretch(vehicle: Any, heavier: float, longer: float) -> dict[str, Any]:
    """Return the fields of the rod of `vehicle` with mass and lengths times these factors; it keeps its shape."""
    turned = rod_inertia_factor(heavier, longer)
    return {
        "bob_mass": heavier * vehicle.bob_mass,
        "rod_length": longer * vehicle.rod_length,
        "rod_inertia": turned * vehicle.rod_inertia,
        "rod_spin_inertia": turned * vehicle.rod_spin_inertia,
        "rod_end": None if vehicle.rod_end is None else longer * vehicle.rod_end,
    }


def is_point(vehicle: Any) -> bool:
    """Whether the rod of `vehicle`, whose other numbers may be symbols, is a point mass."""
    return bool(vehicle.rod_inertia == 0)


def share_out(on_rod: Vector, vehicle: Any) -> tuple[Vector, Vector]:
    """Return the parts of a force `on_rod` (..., 3), at its centre of mass, that act at the pivot and at the bob."""
    if is_point(vehicle):
        return 0 * on_rod, on_rod
    share = vehicle.m / vehicle.bob_mass  # the centre of mass is at this share of the bob's distance
    return (1 - share) * on_rod, share * on_rod
