"""Vehicles by name: those of the package, and files of one's own."""

from __future__ import annotations

from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any

from flypend import errors
from flypend.model.table import file_of, on_base, vehicle_names
from flypend.model.vehicle import Vehicle


@errors.named_arguments
def vehicle(name: str | Path) -> Vehicle:
    """Load the vehicle `name` shipped with the package, or the TOML file at the path `name`. Raises InputError.

    Parameters
    ----------
    name : str or Path
        Name of a vehicle, such as "hehn2011", or the path of a file with the fields of `Vehicle`. With a `base`, the
        name of a vehicle or a path from the folder of the file, it needs only those that differ.
    """
    with file_of(name) as path:
        return Vehicle.from_toml(path)


def vehicle_table(value: Any) -> dict[str, Any]:
    """Return all fields of a vehicle, given by name or as a table on top of `base`. Raises InputError."""
    table = {"base": value} if isinstance(value, str) else value
    known = {entry.name: entry.default for entry in fields(Vehicle) if entry.default not in (MISSING, None)}
    plain = {name: list(default) if isinstance(default, tuple) else default for name, default in known.items()}
    found = on_base(table, Path(), field="vehicle" if isinstance(value, str) else "vehicle.base")
    return plain | found if "base" in table else found


def vehicle_text(name: str | Path) -> str:
    """Return the TOML of the vehicle `name`, comments and sources included. Raises InputError."""
    with file_of(name) as path:
        vehicle(path)
        return path.read_text(encoding="utf-8")


def name_with_changes(machine: Vehicle) -> str:
    """Return the name of a vehicle with what differs from the shipped vehicle of that name: "hehn2011, mass 0.6"."""
    if machine.name not in vehicle_names():
        return machine.name
    own, shipped = machine.to_dict(), vehicle(machine.name).to_dict()
    changed = {name: value for name, value in own.items() if value != shipped.get(name)}
    return ", ".join([machine.name, *(f"{name} {_short(value)}".strip() for name, value in changed.items())])


def _short(value: Any) -> str:
    """Format a value for a line; nothing for a table."""
    if isinstance(value, dict):
        return ""
    return f"{value:g}" if isinstance(value, float) else str(value)
