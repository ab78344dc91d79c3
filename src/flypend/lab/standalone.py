"""The laboratory as one file: machine code for each vehicle, law and plant that it offers, and no server."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from types import SimpleNamespace
from typing import Any

from flypend import errors
from flypend.flight.live import draw_starts, engine_facts, live_loop
from flypend.flight.verdict import goal
from flypend.lab.controls import figures, offer, sliders
from flypend.lab.setting import Setting, setting_of
from flypend.laws import law_names
from flypend.pages import replay

VEHICLES, PLANTS = ("hehn2011", "nayak2018"), ("rotors", "ideal")
LAWS = tuple(name for name in law_names() if name != "learned")  # its network would double the file
TITLE, CHAPTERS = "flypend laboratory", "How a quadrotor throws and catches a rod"
Tell = Callable[[str, int, int], Any]


def lab_page(vehicles: Sequence[str] = VEHICLES, laws: Sequence[str] = LAWS, *, tell: Tell = lambda *_: None) -> str:
    """Return the laboratory as HTML that computes its flights itself, offline.

    Parameters
    ----------
    vehicles, laws : sequence of str
        Vehicles and laws of the package that it offers, each through the plants `PLANTS`, on a gimbal.
    tell : callable
        Called with (name, done, all) before each vehicle, law and plant, whose machine code takes a second or two.

    Raises
    ------
    InputError
        If there is none, or the package has no such vehicle or law.
    """
    every = offer()
    for name, chosen in (("vehicle", vehicles), ("law", laws)):
        if not chosen:
            raise errors.InputError(f"{name}s", "one at least", "none")
        for one in chosen:
            errors.one_of(name, one, every[f"{name}s"])
    settings = [
        {
            **every["first"], "vehicle": {"base": vehicle, "mount": "gimbal"}, "law": {"name": law, "gains": {}},
            "plant": {"base": plant},
        }
        for vehicle, law, plant in product(vehicles, laws, PLANTS)
    ]  # fmt: skip
    return _page(every, settings, TITLE, tell)


def chapters_page() -> str:
    """Return the derivation in eight chapters as HTML that computes its flights itself, offline; it opens at the first.

    With an address that ends in ?figure= and the name of a step of `story` or `figures` it is a figure of that step.
    """
    every, more = offer(), figures()
    settings = {_kind(step["setting"]): step["setting"] for step in [*every["story"], *more]}
    first = every["story"][0]["setting"]
    every |= {"first": first, "chapters": True, "figures": more}
    return _page(every, list(settings.values()), CHAPTERS, lambda *_: None)


def _page(every: dict[str, Any], settings: Sequence[dict[str, Any]], title: str, tell: Tell) -> str:
    """The page that offers of `every` what can be flown with machine code for `settings`."""
    engines = {}
    for number, setting in enumerate(settings):
        tell(_kind(setting), number, len(settings))
        engines[_kind(setting)] = _engine(setting_of(setting))
    choices = {**_available(every, settings, engines), **draw_starts()}
    return replay.document(replay.LIVE_POLICY, {"title": title, "engines": engines, "offer": choices})


def _kind(setting: dict[str, Any]) -> str:
    """What machine code is for: the `kind` of web/src/lab/setting.js."""
    vehicle, law, plant = setting["vehicle"], setting["law"], setting["plant"]
    return "/".join((vehicle["base"], vehicle["mount"], law["name"], plant["base"], plant.get("sensors", "perfect")))


def _engine(setting: Setting) -> dict[str, Any]:
    """Return machine code, sliders, and the record of a flight without its columns."""
    flight, law = setting.flight, setting.law
    flown = SimpleNamespace(law=law.name, gains=setting.gains, vehicle=flight.vehicle)
    record = {
        **replay.names([flown])[0], "law": law.name, "e3": law.e3, "direction": [1.0, 0.0, 0.0],
        "vehicle": replay.describe_machine(flight.vehicle), "hold": goal(law.e3).hold,
    }  # fmt: skip
    loop = live_loop(flight)
    fixed = {f"law.gains.{name}" for name in setting.gains if name not in loop.parameters} | {"vehicle.rotor_limits"}
    offered = [entry for entry in sliders(setting) if entry["path"] not in fixed]
    return {"engine": engine_facts(loop, flight.tolerances), "sliders": offered, "record": record}


def _available(every: dict[str, Any], settings: Sequence[dict[str, Any]], engines: dict[str, Any]) -> dict[str, Any]:
    """Return of `every` choice those that there is machine code for."""
    story = [step for step in every["story"] if _kind(step["setting"]) in engines]
    papers = {name: setting for name, setting in every["experiments"].items() if _kind(setting) in engines}
    first = every["first"] if _kind(every["first"]) in engines else settings[0]
    return {
        "vehicles": list(dict.fromkeys(setting["vehicle"]["base"] for setting in settings)),
        "mounts": {"gimbal": every["mounts"]["gimbal"]},
        "laws": list(dict.fromkeys(setting["law"]["name"] for setting in settings)),
        "plants": {name: every["plants"][name] for name in PLANTS}, "sensors": {"perfect": every["sensors"]["perfect"]},
        "first": first, "starts": every["starts"], "story": story, "experiments": papers, "alone": True,
        "chapters": every.get("chapters", False), "figures": every.get("figures", []),
    }  # fmt: skip
