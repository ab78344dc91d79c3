"""A setting as the TOML that `flypend run` takes, and as the Python lines that do the same."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from flypend.lab.setting import Setting, law_of
from flypend.model import State, Vehicle, vehicle
from flypend.model.state import SHAPES
from flypend.plants import Plant
from flypend.plants import plant as plant_named

POKED = "# The pokes of the laboratory are left out: this is the flight without them.\n"


def toml(setting: Setting) -> str:
    """The run file of `setting`, without its pokes."""
    flight = setting.flight
    base, changed = _vehicle(flight.vehicle)
    plant = flight.plant if isinstance(flight.plant, str) else _plant(flight.plant)
    lines = [f"duration = {_value(flight.duration)}"]
    if isinstance(plant, str):
        lines.append(f"plant = {_value(plant)}")
    if not changed:
        lines.append(f"vehicle = {_value(base)}")
    else:
        lines += _table("vehicle", {"base": base, **changed})
    lines += _table("law", {"name": law_of(flight).name, "gains": dict(law_of(flight).given)})
    if isinstance(plant, dict):
        lines += _table("plant", plant)
    lines += _table("start", _start(flight.start))
    return (POKED if setting.pokes else "") + "\n".join(lines) + "\n"


def python(setting: Setting) -> str:
    """Lines of Python that make the trajectory `run` of `setting`, without its pokes."""
    flight = setting.flight
    base, changed = _vehicle(flight.vehicle)
    machine = f"fp.vehicle({base!r})" + (f".replace({_arguments(changed)})" if changed else "")
    start = ",\n".join(f"    {name}={value!r}" for name, value in _start(flight.start).items())
    return (
        f"import flypend as fp\n\n"
        f"{POKED if setting.pokes else ''}vehicle = {machine}\n"
        f"law = fp.laws.{law_of(flight).name}({_arguments(law_of(flight).given)})\n"
        f"start = fp.State(\n{start},\n)\n"
        f"run = fp.simulate(vehicle, law, start, duration={flight.duration!r}, plant={_plant_call(flight.plant)})\n"
        f"print(run.outcome)\n"
    )


def _vehicle(machine: Vehicle) -> tuple[str, dict[str, Any]]:
    """The vehicle's name, and the fields in which it differs from the one of that name."""
    own, named = machine.to_dict(), vehicle(machine.name).to_dict()
    return machine.name, {name: value for name, value in own.items() if value != named[name]}


def _plant(plant: Plant) -> str | dict[str, Any]:
    """The plant as a run file has it: "rotors", or a table of what differs from it."""
    base = plant_named("rotors")
    changed: dict[str, Any] = {}
    for entry in fields(Plant):
        value = getattr(plant, entry.name)
        if value != getattr(base, entry.name):
            is_record = entry.name in ("noise", "wind")
            changed[entry.name] = _record(value) if is_record else value
    return {"base": "rotors", **changed} if changed else "rotors"


def _record(record: Any) -> dict[str, Any]:
    """The fields of a noise or a wind, lists for tuples."""
    return {name: list(value) if isinstance(value, tuple) else value for name, value in vars(record).items()}


def _plant_call(plant: str | Plant) -> str:
    """The plant as an expression."""
    if isinstance(plant, str):
        return repr(plant)
    table = _plant(plant)
    if isinstance(table, str):
        return repr(table)
    parts = []
    for name, value in table.items():
        kind = {"noise": "fp.Noise", "wind": "fp.Wind"}.get(name)
        if name != "base":
            parts.append(f"{name}={kind}({_arguments(value)})" if kind else f"{name}={value!r}")
    return f"fp.Plant({', '.join(parts)})"


def _start(state: State) -> dict[str, Any]:
    return {name: getattr(state, name).tolist() for name in SHAPES}


def _arguments(values: Mapping[str, Any]) -> str:
    return ", ".join(f"{name}={value!r}" for name, value in values.items())


def _table(name: str, values: Mapping[str, Any]) -> list[str]:
    """A table of TOML, its own tables below it."""
    inner = {key: value for key, value in values.items() if isinstance(value, Mapping)}
    lines = ["", f"[{name}]", *(f"{key} = {_value(value)}" for key, value in values.items() if key not in inner)]
    for key, value in inner.items():
        if value:
            lines += _table(f"{name}.{key}", value)
    return lines


def _value(value: Any) -> str:
    """A number, a word or a list in TOML; floats to the last bit."""
    return repr(value) if isinstance(value, float) else json.dumps(value)
