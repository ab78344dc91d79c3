"""A setting as a run file for `flypend run`, and as equivalent Python."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from flypend.files.toml import toml_text
from flypend.lab.setting import Setting
from flypend.model import vehicle
from flypend.pages.offers import plain
from flypend.plants import ROTORS, AnyPlant, Ideal, Sampled
from flypend.plants.defects import NAMES, names_drawn
from flypend.plants.sensors import SUITES, Sensors

OWN = "from flypend.settings.laws import law_from\n"
POKED = "# The pokes of the laboratory are left out.\n"


def toml(setting: Setting) -> str:
    """Return the run file of `setting`, without its pokes."""
    return (POKED if setting.pokes else "") + toml_text(_table(setting))


def python(setting: Setting) -> str:
    """Return Python code that computes the trajectory `run` of `setting`, without its pokes."""
    table, law = _table(setting), setting.law
    changed, plant = table["vehicle"], table["plant"]
    machine = f"fp.vehicle({setting.flight.vehicle.name!r})"
    machine += f".replace({_arguments(changed)})" if isinstance(changed, dict) else ""
    called = f"law_from({table['law']!r})" if setting.where else f"fp.laws.{law.name}({_arguments(law.given)})"
    world = f"fp.Plant({_arguments(plant)})" if isinstance(plant, dict) else repr(plant)
    start = ",\n".join(f"    {name}={value!r}" for name, value in table["start"].items())
    return (
        f"import flypend as fp\n"
        f"{OWN if setting.where else ''}\n"
        f"{POKED if setting.pokes else ''}vehicle = {machine}\n"
        f"law = {called}\n"
        f"start = fp.State(\n{start},\n)\n"
        f"run = fp.simulate(vehicle, law, start, duration={table['duration']!r}, plant={world})\n"
        f"print(run.outcome)\n"
    )


def _table(setting: Setting) -> dict[str, Any]:
    """The content of a run file; vehicle and plant are names, or tables of the fields that differ from `base`."""
    flight, law, base = setting.flight, setting.law, setting.flight.vehicle.name
    shipped = vehicle(base).to_dict()
    changed = {name: value for name, value in flight.vehicle.to_dict().items() if value != shipped.get(name)}
    said = {"function": setting.where} if setting.where else {"name": law.name}
    return {
        "duration": flight.duration,
        "plant": _plant(flight.plant),
        "vehicle": {"base": base, **changed} if changed else base,
        "law": said | ({"gains": dict(law.given)} if law.given else {}),
        "start": plain(flight.starts),
    }


def _plant(plant: AnyPlant) -> str | dict[str, Any]:
    """The plant, as in a run file: "ideal", "rotors", or a table on top of "rotors"."""
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


def _arguments(values: Mapping[str, Any]) -> str:
    """The entries of a table, but for its base, as the arguments of a call in Python."""
    return ", ".join(f"{name}={_code(name, value)}" for name, value in values.items() if name != "base")


def _code(name: str, value: Any) -> str:
    kind = {"noise": "fp.Noise", "wind": "fp.Wind"}.get(name)
    return f"{kind}({_arguments(value)})" if kind else repr(value)
