"""Worlds drawn from the bands of a vehicle: what may fly where its file says something near."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from flypend.errors import InputError
from flypend.flight.ensemble import Ensemble
from flypend.flight.request import Flight
from flypend.model import Vehicle
from flypend.plants import Sampled, as_sampled
from flypend.studies.compare import fly_each, joined, shared

DRAWS = 8
LEAST = 1e-3  # factor of a number whose band begins at zero


def worlds_within(vehicle: Vehicle, plant: Sampled, seed: int, draws: int = DRAWS) -> dict[str, Sampled]:
    """Return `plant` for `vehicle` as written, then for vehicles drawn from its bands, uniformly and independently.

    Drawn are masses, rod, inertia (one factor), torque ratio, lag, thrust and strengths, spin-up, sag, delay and the
    pivot's offset; limits and drag of rotors and the latency of poses stay. The law believes `vehicle`. Raises
    InputError if it has no bands.
    """
    check_bands(vehicle)
    rng = np.random.default_rng(seed)
    worlds = [_draw(vehicle, plant, rng) for _ in range(draws)]
    return {"as written": plant, **{f"drawn {i + 1}": world for i, world in enumerate(worlds)}}


def fly_within(
    flight: Flight, seed: int, workers: int | None = None, progress: Callable[[int, int], Any] = lambda *_: None
) -> Ensemble:
    """Fly `flight`, whose starts are shared by the worlds that `worlds_within` draws from `seed`.

    `workers` as in `simulate_ensemble`; `progress` is called with (runs begun, all). Raises InputError without bands.
    """
    worlds = list(worlds_within(flight.vehicle, as_sampled(flight.plant), seed).values())
    parts = {str(place): part for place, part in enumerate(shared(flight, worlds))}
    begun = dict.fromkeys(parts, 0)

    def tell(name: str, done: int, total: int) -> None:
        begun[name] = done
        progress(sum(begun.values()), flight.runs)

    return joined(list(fly_each(parts, workers, tell).values()))


def check_bands(vehicle: Vehicle) -> None:
    """Raise InputError if `vehicle` has no bands."""
    if not vehicle.bands:
        raise InputError("vehicle.bands", "bands, as flypend vehicle new and flypend identify write them", "none")


def _draw(vehicle: Vehicle, plant: Sampled, rng: np.random.Generator) -> Sampled:
    bands = dict(vehicle.bands or {})
    return world_of(vehicle, plant, {name: rng.uniform(*map(np.array, band)) for name, band in bands.items()})


def world_of(vehicle: Vehicle, plant: Sampled, found: Mapping[str, Any]) -> Sampled:
    """Return `plant` for `vehicle` if some of its numbers, named as its bands are, are `found` to be others."""
    written = {name: getattr(vehicle, name) for name in ("mass", "bob_mass", "rod_length", "drag_ratio", "rotor_lag")}
    factors = {name: found[name] / value for name, value in written.items() if name in found and value > 0}
    if "inertia" in found:
        factors["inertia"] = float(np.exp(np.mean(np.log(found["inertia"] / np.diag(vehicle.inertia)))))
    factors["rod_inertia"] = factors.get("bob_mass", 1.0) * factors.get("rod_length", 1.0) ** 2
    mismatch = {
        name: float(max(LEAST, plant.mismatch.get(name, 1.0) * factors.get(name, 1.0)))
        for name in {**plant.mismatch, **factors}
    }
    push = found.get("thrust_scale", vehicle.thrust_scale) / vehicle.thrust_scale
    strength = push * np.broadcast_to(found.get("strength", plant.strength), (len(vehicle.rotor_spins),))
    changes: dict[str, Any] = {name: float(found[name]) for name in ("spin_up", "sag", "delay") if name in found}
    if "pivot_offset" in found:
        changes["pivot_offset"] = found["pivot_offset"] - vehicle.pivot_offset
    return plant.replace(mismatch=mismatch, strength=strength.tolist(), **changes)
