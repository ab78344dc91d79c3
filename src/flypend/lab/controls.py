"""What the page offers: laws, plants, presets, the derivation in eight chapters, and the sliders of a setting."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.lab.own import OwnLaws
from flypend.lab.setting import LONGEST, Setting
from flypend.laws import law_names
from flypend.model import State
from flypend.model.table import vehicle_names
from flypend.pages import replay
from flypend.pages.offers import Reach, defect_sliders, gain_sliders, plain, plant_sliders, slider, starts
from flypend.paper import experiment, experiment_names
from flypend.plants import Sampled

MOUNTS = {"gimbal": "gimbal, no limit", "hub": "hub, between arms", "cup": "cup, on top"}
PLANTS = {"rotors": "rotors, 500 Hz", "hehn2011": "rates at 50 Hz", "ideal": "ideal"}
SENSORS = {
    "perfect": "perfect",
    "mocap": "motion capture",
    "onboard": "on board",
    "laboratory": "motion capture, a laboratory",
}


def _setting(
    start: dict[str, Any],
    law: str = "inverted",
    plant: str = "rotors",
    duration: float = 6.0,
    gains: dict[str, float] | None = None,
    vehicle: dict[str, str] | None = None,
) -> dict[str, Any]:
    """A flight without pokes, as `flypend.lab.setting` reads it."""
    return {
        "vehicle": vehicle or {"base": "hehn2011", "mount": "gimbal"}, "law": {"name": law, "gains": gains or {}},
        "plant": {"base": plant}, "start": start, "duration": duration, "pokes": [],
    }  # fmt: skip


def _experiment(name: str, law: str, duration: float | None = None) -> dict[str, Any]:
    """An experiment of the paper under `law`, for a `duration` (s) if not its own; its start is flipped to e₃ up."""
    row = experiment(name)
    machine = {"base": row.vehicle.name, "mount": row.vehicle.mount}
    return _setting(plain(row.start.flipped()), law, row.plant, duration or row.duration, dict(row.gains), machine)


def offer(own: OwnLaws | None = None) -> dict[str, Any]:
    """Return the choices (including the custom laws `own`), the presets, and the initial setting."""
    mine = list(own or ())
    return {
        "vehicles": vehicle_names(),
        "mounts": MOUNTS,
        "laws": [*law_names(), *mine],
        "plants": PLANTS,
        "sensors": SENSORS,
        "first": _setting(starts()["hanging"], mine[0] if mine else "inverted"),
        "starts": starts(),
        "story": story(),
        "experiments": {name: _experiment(name, "corrected") for name in experiment_names() if "-" not in name},
    }


def sliders(setting: Setting) -> list[dict[str, Any]]:
    """Return the sliders of `setting`: path in it, group, label, unit, value, range, and whether logarithmic."""
    flight, law = setting.flight, setting.law
    out = gain_sliders(law, flight.vehicle, setting.gains)
    if isinstance(flight.plant, Sampled):
        out += plant_sliders(flight.plant, flight.vehicle) + defect_sliders(flight.plant)
    return [*out, slider("duration", "flight", "duration", "s", flight.duration, Reach(2.0, LONGEST))]


SHOWN = "3"  # the experiment of the paper whose printed law flies longest
LASTING = 10.0  # s: the paper ends at 6.5 s, before the rod has come to rest
TILT = "start.y.tilt"  # of the rod from upright
LEAN = 20.0  # degrees, of a rod that is balanced at once
# What a figure plots: `plain` in web/src/series.js.
ROD, THRUST, ROTORS = "Rod y₃ and thrust axis z₃", "Thrust", "Rotor forces"
DISTANCE, CLEARANCE, LYAPUNOV = "Distance from the reference", "Clearance of the rod", "Lyapunov function V"


def story() -> list[dict[str, Any]]:
    """Return the chapters of the derivation, which share one scene.

    Each has a `name`, a `title`, `words`, the `setting` of its flight, `drag`, the path of the slider beside the words,
    and `plot`, the quantity that a figure of it shows (`plain` in web/src/series.js); some have a `phase` of the flight
    (web/src/phases.js) at which it is shown.
    """
    return [
        _step(
            "joint", "A rod on a ball joint", DISTANCE,
            "No motor turns the rod. The thrust moves the joint: its part across the rod turns the rod, its part along "
            "the rod carries the bob. Let the rod lean further, and the vehicle has to travel further to get below it.",
            TILT, _setting(_tilt(LEAN)),
        ),
        _step(
            "printed", "Why the printed law fails", ROD,
            "Experiment 3 of the paper under its law, letter by letter. The damping has the wrong sign: it drives the "
            "rod. With any gain of this slider the flight ends at a singular term, or the rod never comes to rest.",
            "law.gains.k_d", _experiment(SHOWN, "printed", LASTING),
        ),
        _step(
            "carry", "Carry the bob", ROD,
            "With the sign corrected the rod comes to rest, but along gravity: it hangs, and the vehicle falls. This "
            "law shapes the thrust across the rod and leaves the bob to gravity. It falls wherever the rod starts.",
            TILT, _experiment(SHOWN, "corrected", LASTING),
        ),
        _step(
            "throw", "Throw", THRUST,
            "The inverted law uses both parts of the thrust. To flip a hanging rod it must push down for a moment, and "
            "nothing is held up. So it throws the bob first. Throw faster, and the bob rises higher.",
            "law.gains.throw_speed", _setting(_tilt(180.0)), phase="climbs",
        ),
        _step(
            "flip", "Flip", ROD,
            "The vehicle turns over, dives past the bob, and the rod swings up. Turning takes time, so the thrust axis "
            "aims at the force that will be needed when it arrives. Look ahead too little or too far, and it fails.",
            "law.gains.coast_time", _setting(_tilt(180.0)), phase="flips",
        ),
        _step(
            "catch", "Catch", ROD,
            "Below the bob the vehicle pushes up again, and damping stops the swing. With little damping the rod takes "
            "longer to come to rest; with too much of it the catch is missed.",
            "law.gains.rod_damping", _setting(_tilt(180.0)), phase="catches",
        ),
        _step(
            "proof", "V falls", LYAPUNOV,
            "Another law for the same machine comes with a proof: a Lyapunov function V falls along every solution. "
            "Start the rod elsewhere, and V still falls (second plot). The proof is for ideal rotors.",
            TILT, _setting(_tilt(150.0), "almost_global", plant="ideal", duration=LASTING),
        ),
        _step(
            "rotors", "What the rotors forbid", ROTORS,
            "Rotors push one way, up to a limit, and answer late. Drag the lag to its end, and the machine turns too "
            "slowly to catch the rod.",
            "plant.lag", _setting(_tilt(180.0)),
        ),
    ]  # fmt: skip


def figures() -> list[dict[str, Any]]:
    """Return what figures of the documentation show beyond the chapters, as `story` does."""
    seen = _setting(_tilt(180.0))
    seen["plant"] = {"base": "rotors", "sensors": "mocap"}
    hub = {"base": "hehn2011", "mount": "hub"}
    return [
        _step("lqr", "An LQR", ROD, "", TILT, _setting(_tilt(15.0), "lqr")),
        _step("mocap", "Motion capture", ROD, "", "plant.defects.untold_latency", seen),
        _step("hub", "Between the arms", CLEARANCE, "", TILT, _setting(_tilt(180.0), vehicle=hub), "flips"),
    ]  # fmt: skip


def _tilt(degrees: float) -> dict[str, Any]:
    """A start at rest with the rod so far from upright."""
    lean = np.radians(degrees)
    return plain(State(y=(np.sin(lean), 0.0, np.cos(lean))))


def _step(
    name: str, title: str, plot: str, words: str, drag: str, setting: dict[str, Any], phase: str | None = None
) -> dict[str, Any]:
    """Return one chapter of the tour as the page reads it."""
    return {
        "name": name, "title": title, "plot": plot, "words": words, "drag": drag, "setting": setting, "phase": phase,
    }  # fmt: skip


def page(own: OwnLaws | None = None) -> str:
    """Return the page as HTML, offering the custom laws `own`."""
    return replay.document("", {"title": "flypend laboratory", "offer": offer(own)})
