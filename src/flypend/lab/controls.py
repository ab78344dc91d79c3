"""The controls of the page: laws, plants, presets, and the sliders of a setting with their ranges and values."""

from __future__ import annotations

from typing import Any

from flypend.lab.own import OwnLaws
from flypend.lab.setting import LONGEST, Setting
from flypend.lab.story import story
from flypend.laws import law_names
from flypend.model import State
from flypend.model.table import vehicle_names
from flypend.pages.sliders import gain_sliders, plant_sliders, slider
from flypend.pages.starts import plain, starts
from flypend.paper import experiment, experiment_names
from flypend.plants import Sampled

MOUNTS = {"gimbal": "gimbal, no limit", "hub": "hub, between arms", "cup": "cup, on top"}
PLANTS = {"rotors": "rotors, 500 Hz", "hehn2011": "rates at 50 Hz", "ideal": "ideal"}
SENSORS = {"perfect": "perfect", "mocap": "motion capture", "onboard": "on board"}


def offer(own: OwnLaws | None = None) -> dict[str, Any]:
    """Return the choices (including the custom laws `own`), the presets, and the initial setting."""
    mine = list(own or ())
    first = {
        "vehicle": {"base": "hehn2011", "mount": "gimbal"},
        "law": {"name": mine[0] if mine else "inverted", "gains": {}},
        "plant": {"base": "rotors"},
        "start": plain(State(y=(0.0, 0.0, -1.0))),
        "duration": 6.0,
        "pokes": [],
    }
    return {
        "vehicles": vehicle_names(),
        "mounts": MOUNTS,
        "laws": [*law_names(), *mine],
        "plants": PLANTS,
        "sensors": SENSORS,
        "first": first,
        "starts": starts(),
        "story": story(),
        "experiments": {name: _preset(name) for name in experiment_names() if "-" not in name},
    }


def _preset(name: str) -> dict[str, Any]:
    """An experiment of the paper as a setting, its start flipped into the e₃-up frame."""
    row = experiment(name)
    return {
        "vehicle": {"base": row.vehicle.name, "mount": row.vehicle.mount},
        "law": {"name": "corrected", "gains": dict(row.gains)},
        "plant": {"base": row.plant},
        "start": plain(row.start.flipped()),
        "duration": row.duration,
        "pokes": [],
    }


def sliders(setting: Setting) -> list[dict[str, Any]]:
    """Return the sliders of `setting`: path in it, group, label, unit, value, range, and whether logarithmic."""
    flight, law = setting.flight, setting.law
    out = gain_sliders(law, flight.vehicle, setting.gains)
    if isinstance(flight.plant, Sampled):
        out += plant_sliders(flight.plant, flight.vehicle)
    return [*out, slider("duration", "flight", "duration", "s", flight.duration, 2.0, LONGEST)]
