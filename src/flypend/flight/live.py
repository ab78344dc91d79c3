"""What a page needs to fly by itself: what it may fly, and what it offers: sliders, starts, and the first setting."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import casadi as ca
import numpy as np

from flypend.errors import InputError
from flypend.flight.live_engine import engine_facts
from flypend.flight.request import Flight
from flypend.laws import BoundLaw
from flypend.model import State
from flypend.model.state import SIZE
from flypend.pages.offers import (
    Reach,
    defect_sliders,
    directions,
    gain_sliders,
    plain,
    plant_sliders,
    slider,
    sliders_of,
    starts,
)
from flypend.pages.replay import in_base64
from flypend.plants import AnyPlant, Sampled
from flypend.plants.loop import Loop

DURATIONS = (2.0, 30.0)  # s
FURTHEST = 2.0  # m, that the reference moves
RANDOM = 40  # starts that a page holds, each drawn from `State.random`
MAPPED = 1200  # directions of the rod that a map has


def live_data(flight: Flight | None) -> dict[str, Any]:
    """Return what the page of a live `flight` holds beside its replay: `offer` and `engine`.

    Raises InputError if a page cannot fly it.
    """
    loop = live_loop(flight)
    assert flight is not None
    return {"offer": choices(flight), "engine": engine_facts(loop, flight.tolerances)}


def live_loop(flight: Flight | None) -> Loop:
    """Return the loop of `flight` whose gains with sliders are inputs. Raises InputError if a page cannot fly it."""
    if flight is None:
        raise InputError("live", "a run flown in this session", "one from a file, a plan or a change of frame")
    if isinstance(flight.plant, Sampled) and flight.plant.engine != "equations":
        raise InputError(
            "live", "a plant of the built-in equations, such as rotors", f"the plant {flight.plant.engine}"
        )
    if not isinstance(flight.law, BoundLaw):
        raise InputError("live", "a law in symbols, which can be compiled", f"the callable {flight.law.name}")
    return replace(flight.loop, parameters=tunable(flight.law))


def tunable(law: BoundLaw) -> tuple[str, ...]:
    """Return the gains of `law` that a page may change: those that its equations read as they are."""
    t, packed, forces = ca.SX.sym("t"), ca.SX.sym("s", SIZE), ca.SX.sym("F", 6)
    gains = {name: ca.SX.sym(name) for name in sliders_of(law)}
    wrench = law.upright(t, packed, forces, gains)
    return tuple(name for name, symbol in gains.items() if ca.depends_on(wrench, symbol))


def choices(flight: Flight) -> dict[str, Any]:
    """Return the choices of the page: sliders, starts, and the setting to begin with."""
    law, vehicle, plant = flight.law, flight.vehicle, flight.plant
    assert isinstance(law, BoundLaw)
    turned = [*plant_sliders(plant, vehicle), *defect_sliders(plant)] if isinstance(plant, Sampled) else []
    paths = [f"law.gains.{name}" for name in tunable(law)]
    gains = [entry for entry in gain_sliders(law, vehicle, law.gains) if entry["path"] in paths]
    first = {
        "law": {"name": law.name, "gains": {}}, "plant": {}, "vehicle": {},
        "start": plain(flight.starts.in_frame(law.e3)), "duration": flight.duration, "pokes": [],
    }  # fmt: skip
    lasting = slider("duration", "flight", "duration", "s", flight.duration, Reach(*DURATIONS))
    return {
        "first": first, "sliders": [*gains, *turned, *_places(law, plant), lasting],
        "starts": {"as flown": first["start"], **starts()},
        **draw_starts(),
        "seed": flight.seed or 0,
    }  # fmt: skip


def draw_starts() -> dict[str, Any]:
    """Return the starts that a page draws from: `randoms`, and the `directions` of a map, in base64."""
    drawn = [State.random(np.random.default_rng(seed)) for seed in range(RANDOM)]
    return {"randoms": [plain(state) for state in drawn], "directions": in_base64(directions(MAPPED))}


def _places(law: BoundLaw, plant: AnyPlant) -> list[dict[str, Any]]:
    """Return the sliders that move the reference of a live flight, m: none without one, or with estimated places."""
    if law.reference is None or (isinstance(plant, Sampled) and plant.sensors is not None):
        return []
    words = {"x": "along e₁", "y": "along e₂", "z": "up"}
    reach = Reach(-FURTHEST, FURTHEST)
    return [slider(f"origin.{k}", "place", said, "m", 0.0, reach) for k, said in words.items()]
