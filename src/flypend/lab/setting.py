"""A page's request: a setting in plain JSON, validated and turned into a flight and its pokes.

A setting has the keys of a run file (vehicle, law, plant, start, duration) and `pokes`. Its start and its pokes are in
the e₃-up frame whatever the law, so that a change of law keeps the start.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend import errors, geometry
from flypend.errors import InputError
from flypend.flight.request import Flight
from flypend.lab.own import NONE, OwnLaws
from flypend.laws import BoundLaw, Controller, Law, law_from_dict
from flypend.model import State, Vehicle
from flypend.model.by_name import vehicle_table
from flypend.model.state import SHAPES
from flypend.model.table import vehicle_names
from flypend.pages.offers import plain, sliders_of
from flypend.plants import Ideal
from flypend.plants.knobs import LONGEST_SHIFT
from flypend.plants.sensors import SUITES
from flypend.settings.runfile import check_plain, run_of, start_of, table_at

KEYS = ("vehicle", "law", "plant", "start", "duration", "pokes")
TABLES: Mapping[str, tuple[str, ...]] = {
    "vehicle": ("base", "mount", "rotor_limits"),
    "law": ("name", "gains"),
    "plant": ("base", "limits", "lag", "rate", "delay", "noise", "wind", "sensors", "defects", "seed"),
    "start": (*SHAPES, "random"),
}
LONGEST, MOST_POKES = 30.0, 20
# Bounds (low, high) of plant parameters that make a flight expensive.
BOUNDS = {"rate": (20.0, 2000.0), "delay": (0.0, 0.2), "lag": (0.0, 1.0)}
FURTHEST = 100.0  # largest ratio of a gain to its default, either way
# Largest magnitude of an entry of the start, SI.
LARGEST = {"x": 1e3, "x_dot": 1e3, "omega": 100.0, "y_dot": 100.0}
BODIES = ("bob", "vehicle")


@dataclass(frozen=True)
class Poke:
    """An impulse at `time` (s) on a body ("bob" or "vehicle"): its mass times `velocity` (3,), m/s, e₃ up."""

    time: float
    on: str
    velocity: Any


@dataclass(frozen=True)
class Setting:
    """A validated request: the flight, the law as requested, the pokes, and the start in the e₃-up frame.

    For a custom law, `where` is its location and `stamp` the digest of its file.
    """

    flight: Flight
    law: Law | Controller
    pokes: tuple[Poke, ...]
    start: State
    where: str = ""
    stamp: str = ""

    @property
    def gains(self) -> Mapping[str, Any]:
        """The gains flown: what is not given follows from vehicle and sensors."""
        flown = self.flight.law
        return flown.gains if isinstance(flown, BoundLaw) else self.law.gains_for(self.flight.vehicle)


def setting_of(asked: Any, own: OwnLaws = NONE) -> Setting:
    """Validate a page's request `asked`, which may name one of the custom laws `own`.

    Raises InputError for anything unknown, missing or out of range.
    """
    if not isinstance(asked, dict):
        raise InputError("setting", "a table", repr(asked)[:80])
    errors.only_known("", asked, KEYS)
    given = {key: dict(value) if isinstance(value, dict) else value for key, value in asked.items()}
    for key, known in TABLES.items():
        if isinstance(given.get(key), dict):
            errors.only_known(key, given[key], known)
    if isinstance(plant := given.get("plant"), dict):
        # Of the ideal plant, the page keeps the fields of the sampled one for later; ignore them.
        given["plant"] = "ideal" if plant.get("base") == "ideal" else _with_adjustable(plant)
    pokes = _pokes(given.pop("pokes", []))
    start = _start(given.get("start"))
    law = _law(given, own)
    given["start"] = plain(start.in_frame(law.e3))
    named = given["law"]["name"]
    if named not in own:
        flight = run_of(given).flight
        _check_size(flight)
        return Setting(flight, law, pokes, start)
    others = run_of({**given, "law": {"name": "corrected"}}).flight  # everything but the law
    _check_size(others)
    flight = others.replace(law=law.bind(others.vehicle), plant=others.plant)
    return Setting(flight, law, pokes, start, own[named].where, own[named].stamp)


def _with_adjustable(plant: dict[str, Any]) -> dict[str, Any]:
    """Return the table `plant` with sensors whose defects are adjustable, so that a size compiles nothing.

    Its `defects` are sizes in place of those of the suite; each flight draws what lasts from them.
    """
    table = dict(plant)
    name, sizes = table.pop("sensors", "perfect"), table.pop("defects", {})
    suite = SUITES[errors.one_of("plant.sensors", name, SUITES)]  # tables would each be compiled
    if not isinstance(sizes, dict):
        raise InputError("plant.defects", "a table", repr(sizes)[:80])
    if suite is None:
        errors.only_known("plant.defects", sizes, ())
        return table
    every = suite.replace(adjustable="all")
    errors.only_known("plant.defects", sizes, every.adjustable)
    for defect, size in sizes.items():
        errors.number(f"plant.defects.{defect}", size, at_least=0)
    late = sum(sizes.get(defect, getattr(suite, defect)) for defect in ("untold_latency", "latency_jitter"))
    if late > LONGEST_SHIFT:
        expected = f"at most {LONGEST_SHIFT:g} s with latency_jitter"
        raise InputError("plant.defects.untold_latency", expected, f"{late:g} s")
    try:
        every.replace(**sizes)
    except InputError as error:
        raise InputError(error.field.replace("sensors", "plant.defects"), error.expected, error.got) from None
    return {**table, "sensors": {"base": name, "adjustable": "all", **sizes}}


def _law(given: dict[str, Any], own: OwnLaws) -> Law | Controller:
    """The requested law, its gains close enough to the defaults for the integrator to resolve its loops."""
    for key in ("vehicle", "law"):
        check_plain(key, given.get(key, {}))
    machine = given.get("vehicle")
    named = machine.get("base") if isinstance(machine, dict) else machine
    errors.one_of("vehicle", named, vehicle_names())  # a page must not read files
    with np.errstate(all="ignore"):  # like `run_of`
        vehicle = Vehicle.from_dict(vehicle_table(given.get("vehicle")))
        table = table_at(given, "law")
        law = own[table["name"]].law if table.get("name") in own else law_from_dict({**table, "gains": {}})
        gains = table_at(table, "gains", "law.gains")
        errors.only_known("law.gains", gains, sliders_of(law))
        law = law.with_gains(gains, "law.gains")
        _check_gains(law, vehicle)
    return law


def _start(given: Any) -> State:
    """The state in the table `given`; if it has a seed `random`, the missing fields are random."""
    if not isinstance(given, dict):
        raise InputError("start", "a table", repr(given)[:80])
    fields = dict(given)
    if "random" in fields:
        seed = errors.number("start.random", fields.pop("random"), at_least=0)
        fields = plain(State.random(np.random.default_rng(int(seed)))) | fields
    y = errors.array("start.y", fields.get("y"), (3,))
    # Dragging the rod preserves neither unit length nor tangency.
    fields["y"] = y / errors.number("start.|y|", geometry.norm(y), above=1e-3)
    y_dot = errors.array("start.y_dot", fields.get("y_dot", (0.0, 0.0, 0.0)), (3,))
    fields["y_dot"] = geometry.project_tangent(fields["y"], y_dot)
    start = start_of(fields)
    for name, most in LARGEST.items():
        errors.number(f"start.{name}", np.max(np.abs(getattr(start, name))), at_most=most)
    return start


def _pokes(given: Any) -> tuple[Poke, ...]:
    if not isinstance(given, list) or len(given) > MOST_POKES:
        raise InputError("pokes", f"a list of at most {MOST_POKES}", repr(given)[:80])
    pokes: list[Poke] = []
    for entry in given:
        if not isinstance(entry, dict):
            raise InputError("pokes", "tables", repr(entry)[:80])
        errors.only_known("pokes", entry, ("time", "on", "velocity"))
        time = errors.number("pokes.time", entry.get("time"), at_least=0, at_most=LONGEST, unit="s")
        body = errors.one_of("pokes.on", entry.get("on"), BODIES)
        velocity = errors.array("pokes.velocity", entry.get("velocity"), (3,))
        if np.max(np.abs(velocity)) > 100:
            raise InputError("pokes.velocity", "at most 100 m/s", velocity.tolist())
        if pokes and time <= pokes[-1].time:
            raise InputError("pokes.time", "increasing times", f"{time:g} s")
        pokes.append(Poke(time, body, velocity))
    return tuple(pokes)


def _check_size(flight: Flight) -> None:
    errors.number("duration", flight.duration, at_most=LONGEST, unit="s")
    if isinstance(flight.plant, Ideal):
        return
    if flight.plant.engine != "equations":
        raise InputError("plant.engine", "equations, in the laboratory", flight.plant.engine)
    for name, (low, high) in BOUNDS.items():
        value = getattr(flight.plant, name)
        if value is not None and not low <= value <= high:
            raise InputError(f"plant.{name}", f"{low:g} to {high:g}", f"{value:g}")


def _check_gains(law: Law | Controller, vehicle: Vehicle) -> None:
    """Raise InputError if `law` rejects its gains for `vehicle`, or if a loop is too fast for the integrator."""
    proposed = law.propose(vehicle)
    for name, value in law.given.items():
        usual = proposed[name]
        if name in sliders_of(law) and usual > 0 and not usual / FURTHEST <= value <= usual * FURTHEST:
            expected = f"{usual / FURTHEST:.3g} to {usual * FURTHEST:.3g}, in the laboratory"
            raise InputError(f"law.gains.{name}", expected, f"{value:g}")
    try:
        law.bind(vehicle)
    except InputError as error:
        raise InputError(f"law.gains.{error.field}", error.expected, error.got) from None
