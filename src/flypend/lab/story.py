"""The story of the package in five flights, from the paper's law as printed to the one that stands the rod up."""

from __future__ import annotations

from typing import Any

from flypend.model import State
from flypend.pages.starts import STARTS, plain
from flypend.paper import experiment

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
