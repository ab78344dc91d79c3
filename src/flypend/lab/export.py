"""A setting as a run file for `flypend run`, and as equivalent Python."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from flypend.files.toml import toml_text
from flypend.lab.setting import Setting
from flypend.model import Vehicle, vehicle
from flypend.pages.offers import plain
from flypend.plants import ROTORS, AnyPlant, Ideal, Sampled
from flypend.plants.defects import NAMES, names_drawn
from flypend.plants.sensors import SUITES, Sensors

OWN = "from flypend.settings.laws import law_from\n"
POKED = "# The pokes of the laboratory are left out.\n"


def toml(setting: Setting) -> str:
    """Return the run file of `setting`, without its pokes."""
    flight = setting.flight
    base, changed = _vehicle(flight.vehicle)
    written = {
        "duration": flight.duration,
        "plant": _plant(flight.plant),
        "vehicle": {"base": base, **changed} if changed else base,
        "law": _law(setting),
        "start": plain(flight.starts),
    }
    return (POKED if setting.pokes else "") + toml_text(written)


def python(setting: Setting) -> str:
    """Return Python code that computes the trajectory `run` of `setting`, without its pokes."""
    flight = setting.flight
    base, changed = _vehicle(flight.vehicle)
    machine = f"fp.vehicle({base!r})" + (f".replace({_arguments(changed)})" if changed else "")
    start = ",\n".join(f"    {name}={value!r}" for name, value in plain(flight.starts).items())
    return (
        f"import flypend as fp\n"
        f"{OWN if setting.where else ''}\n"
        f"{POKED if setting.pokes else ''}vehicle = {machine}\n"
        f"law = {_law_call(setting)}\n"
        f"start = fp.State(\n{start},\n)\n"
        f"run = fp.simulate(vehicle, law, start, duration={flight.duration!r}, plant={_plant_call(flight.plant)})\n"
        f"print(run.outcome)\n"
    )


def _law(setting: Setting) -> dict[str, Any]:
    """The law, as in a run file."""
    law = setting.law
    said = {"function": setting.where} if setting.where else {"name": law.name}
    return said | ({"gains": dict(law.given)} if law.given else {})


def _law_call(setting: Setting) -> str:
    law = setting.law
    return f"law_from({_law(setting)!r})" if setting.where else f"fp.laws.{law.name}({_arguments(law.given)})"


def _vehicle(machine: Vehicle) -> tuple[str, dict[str, Any]]:
    """The vehicle's name, and the fields that differ from the shipped vehicle of that name."""
    own, named = machine.to_dict(), vehicle(machine.name).to_dict()
    return machine.name, {name: value for name, value in own.items() if value != named.get(name)}


def _plant(plant: AnyPlant) -> str | dict[str, Any]:
    """The plant, as in a run file: "ideal", "rotors", or a table of the fields that differ from "rotors"."""
    if isinstance(plant, Ideal):
        return "ideal"
    changed: dict[str, Any] = {}
    for entry in fields(Sampled):
        value = getattr(plant, entry.name)
        if value != getattr(ROTORS, entry.name):
            if entry.name in ("noise", "wind"):
                value = dict(vars(value))
            changed[entry.name] = _suite(value) if entry.name == "sensors" else value
    return {"base": "rotors", **changed} if changed else "rotors"


def _suite(sensors: Sensors) -> str | dict[str, Any]:
    """The name of the suite that `sensors` are, else a table on top of one that is told the same, else their own."""
    every = {name: suite for name, suite in SUITES.items() if suite is not None}
    named = next((name for name, suite in every.items() if suite in (sensors, sensors.replace(adjustable=()))), None)
    if named is not None and not names_drawn(every[named]):
        return named  # defects of size 0 leave no more than roundoff
    base = next((name for name, suite in every.items() if suite.told == sensors.told), None)
    if base is None:
        return sensors.to_dict()
    changed = {name: getattr(sensors, name) for name in NAMES if getattr(sensors, name) != getattr(every[base], name)}
    adjustable = "all" if sensors == sensors.replace(adjustable="all") else list(sensors.adjustable)
    return {"base": base, "adjustable": adjustable, **changed}


def _plant_call(plant: AnyPlant) -> str:
    """The plant as a Python expression."""
    table = _plant(plant)
    if isinstance(table, str):
        return repr(table)
    parts = []
    for name, value in table.items():
        kind = {"noise": "fp.Noise", "wind": "fp.Wind"}.get(name)
        if name != "base":
            parts.append(f"{name}={kind}({_arguments(value)})" if kind else f"{name}={value!r}")
    return f"fp.Plant({', '.join(parts)})"


def _arguments(values: Mapping[str, Any]) -> str:
    return ", ".join(f"{name}={value!r}" for name, value in values.items())
