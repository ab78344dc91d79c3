"""Worlds drawn from the bands of a vehicle: what may fly where its file says something near."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from flypend.flight.ensemble import Ensemble
from flypend.flight.request import Flight
from flypend.model import Vehicle
from flypend.plants import Sampled, as_sampled
from flypend.plants.bands import check_bands, draw_world
from flypend.studies.compare import fly_each, join_ensembles, split_flight

DRAWS = 8


def worlds_within(vehicle: Vehicle, plant: Sampled, seed: int, draws: int = DRAWS) -> dict[str, Sampled]:
    """Return `plant` for `vehicle` as written, then for vehicles drawn from its bands, uniformly and independently.

    Drawn are masses, rod, inertia (one factor), torque ratio, lag, thrust and strengths, spin-up, sag, delay and the
    pivot's offset; limits and drag of rotors and the latency of poses stay. The law believes `vehicle`. Raises
    InputError if it has no bands.
    """
    check_bands(vehicle)
    rng = np.random.default_rng(seed)
    worlds = [draw_world(vehicle, plant, rng) for _ in range(draws)]
    return {"as written": plant, **{f"drawn {i + 1}": world for i, world in enumerate(worlds)}}


def fly_within(
    flight: Flight, seed: int, workers: int | None = None, progress: Callable[[int, int], Any] = lambda *_: None
) -> Ensemble:
    """Fly `flight`, whose starts are shared by the worlds that are drawn from `seed` as in `worlds_within`.

    `workers` as in `simulate_ensemble`; `progress` is called with (runs begun, all). Raises InputError without bands.
    """
    _, *worlds = worlds_within(flight.vehicle, as_sampled(flight.plant), seed).values()
    parts = {str(place): part for place, part in enumerate(split_flight(flight, worlds))}
    begun = dict.fromkeys(parts, 0)

    def tell(name: str, done: int, total: int) -> None:
        begun[name] = done
        progress(sum(begun.values()), flight.runs)

    return join_ensembles(list(fly_each(parts, workers, tell).values()))
