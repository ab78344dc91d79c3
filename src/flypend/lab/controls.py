"""What the page offers: laws, plants, presets, a story in five flights, and the sliders of a setting."""

from __future__ import annotations

from typing import Any

from flypend import palette
from flypend.lab.own import OwnLaws
from flypend.lab.setting import LONGEST, Setting
from flypend.laws import law_names
from flypend.model import State
from flypend.model.table import vehicle_names
from flypend.pages import replay
from flypend.pages.sliders import gain_sliders, plant_sliders, slider
from flypend.pages.starts import STARTS, plain, starts
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


SHOWN = "3"  # the experiment of the paper whose printed law flies longest
LASTING = 10.0  # s: the paper ends at 6.5 s, before the rod has come to rest
LEVEL = plain(State(y=STARTS["level"]))


def story() -> list[dict[str, Any]]:
    """Return the steps: a `title`, `words` on what to see, and the `setting` of the flight."""
    return [
        _paper(
            "printed",
            "As printed, it fails",
            "Experiment 3 of the paper under its law, letter by letter. The damping has the wrong sign, and a feedback "
            "term becomes singular: the flight ends there.",
        ),
        _paper(
            "corrected",
            "Corrected, it hangs",
            "The sign is right and the singular term gone. The rod comes to the pose that the paper calls inverted, "
            "along its e₃. But e₃ points along gravity: the rod hangs, and the vehicle falls.",
        ),
        _paper(
            "repaired",
            "Repaired, it is proved",
            "It still hangs, now with a theorem behind it: a Lyapunov function falls along every solution, and from "
            "almost every start the rod comes to rest.",
        ),
        _level(
            "lqr",
            "Balancing is not swinging up",
            "LQR about hover, with rotors that have limits and lag. It balances a rod that leans a little. This one "
            "begins level: the machine tumbles.",
        ),
        _level(
            "inverted",
            "Inverted, it stands",
            "The same start, the same rotors, another law: it throws the bob, flips the rod and catches it. Poke it, "
            "drag the rod elsewhere, or let it fly live.",
        ),
    ]


def _paper(law: str, title: str, words: str) -> dict[str, Any]:
    """A step with the paper's vehicle, start and plant, flown for longer; `repaired` has gains of its own."""
    row = experiment(SHOWN)
    gains = {} if law == "repaired" else dict(row.gains)
    machine = {"base": row.vehicle.name, "mount": row.vehicle.mount}
    return _step(title, words, machine, law, gains, row.plant, plain(row.start.flipped()), LASTING)


def _level(law: str, title: str, words: str) -> dict[str, Any]:
    """A step with rotors, from a level rod."""
    return _step(title, words, {"base": "hehn2011", "mount": "gimbal"}, law, {}, "rotors", LEVEL, 6.0)


def _step(
    title: str,
    words: str,
    vehicle: dict[str, str],
    law: str,
    gains: dict[str, float],
    plant: str,
    start: dict[str, Any],
    duration: float,
) -> dict[str, Any]:
    setting = {
        "vehicle": vehicle, "law": {"name": law, "gains": gains}, "plant": {"base": plant}, "start": start,
        "duration": duration, "pokes": [],
    }  # fmt: skip
    return {"title": title, "words": words, "setting": setting}


PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>flypend laboratory</title>
</head>
<body>
<noscript>The laboratory needs JavaScript.</noscript>
<script id="flypend-data" type="application/json">{data}</script>
<script src="lab.js"></script>
</body>
</html>
"""


def page(own: OwnLaws | None = None) -> str:
    """Return the page as HTML, offering the custom laws `own`."""
    data = {"title": "flypend laboratory", "layout": "overlay", "speed": 1.0, "palette": palette.PAGE, "runs": []}
    return PAGE.format(data=replay.embedded({**data, "offer": offer(own)}))
