"""Worlds in which a vehicle is another, within its bands, than the one that its law believes in."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from flypend.errors import InputError
from flypend.model import Vehicle
from flypend.model.rod import rod_inertia_factor
from flypend.plants.plant import Sampled

LEAST = 1e-3  # factor of a number whose band begins at zero


def check_bands(vehicle: Vehicle) -> None:
    """Raise InputError if `vehicle` has no bands."""
    if not vehicle.bands:
        raise InputError("vehicle.bands", "bands, as flypend vehicle new and flypend identify write them", "none")


def draw_world(vehicle: Vehicle, plant: Sampled, rng: np.random.Generator) -> Sampled:
    """Return `plant` for a vehicle drawn from the bands of `vehicle`, uniformly and independently."""
    bands = dict(vehicle.bands or {})
    return world_of(vehicle, plant, {name: rng.uniform(*map(np.array, band)) for name, band in bands.items()})


def world_of(vehicle: Vehicle, plant: Sampled, found: Mapping[str, Any]) -> Sampled:
    """Return `plant` for `vehicle` if some of its numbers, named as its bands are, are `found` to be others.

    What is found replaces the plant's own spin_up, sag, delay, strength and pivot_offset, and multiplies its mismatch.
    """
    written = {name: getattr(vehicle, name) for name in ("mass", "bob_mass", "rod_length", "drag_ratio", "rotor_lag")}
    factors = {name: found[name] / value for name, value in written.items() if name in found and value > 0}
    if "inertia" in found:
        factors["inertia"] = float(np.exp(np.mean(np.log(found["inertia"] / np.diag(vehicle.inertia)))))
    factors["rod_inertia"] = rod_inertia_factor(factors.get("bob_mass", 1.0), factors.get("rod_length", 1.0))
    mismatch = {
        name: float(max(LEAST, plant.mismatch.get(name, 1.0) * factors.get(name, 1.0)))
        for name in {**plant.mismatch, **factors}
    }
    push = found.get("thrust_scale", vehicle.thrust_scale) / vehicle.thrust_scale
    strength = push * np.broadcast_to(found.get("strength", plant.strength), (len(vehicle.rotor_spins),))
    changes: dict[str, Any] = {name: float(found[name]) for name in ("spin_up", "sag", "delay") if name in found}
    if "rotor_lag" in found and vehicle.rotor_lag == 0 and plant.lag is None:
        changes["lag"] = float(found["rotor_lag"])
    if "pivot_offset" in found:
        changes["pivot_offset"] = found["pivot_offset"] - vehicle.pivot_offset
    return plant.replace(mismatch=mismatch, strength=strength.tolist(), **changes)
