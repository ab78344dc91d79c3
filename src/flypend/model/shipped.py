"""Vehicles by name: those of the package, and files of one's own."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import resources
from pathlib import Path
from typing import Any

from flypend import errors
from flypend.model.vehicle import Vehicle


def vehicle_names() -> list[str]:
    """Names of the vehicles shipped with the package."""
    folder = resources.files("flypend") / "vehicles"
    return sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml"))


def vehicle(name: str | Path) -> Vehicle:
    """Load the vehicle `name` shipped with the package, or the TOML file at the path `name`. Raises InputError."""
    with _file_of(name) as path:
        return Vehicle.from_toml(path)


@contextmanager
def _file_of(name: str | Path) -> Iterator[Path]:
    """Yield the file of the vehicle `name`."""
    if isinstance(name, Path) or (isinstance(name, str) and name.endswith(".toml")):
        yield Path(name)
        return
    errors.one_of("vehicle", name, vehicle_names())
    with resources.as_file(resources.files("flypend") / "vehicles" / f"{name}.toml") as path:
        yield path


def vehicle_text(name: str | Path) -> str:
    """Return the TOML of the vehicle `name`, comments and sources included. Raises InputError."""
    with _file_of(name) as path:
        vehicle(path)
        return path.read_text(encoding="utf-8")


def told(machine: Vehicle) -> str:
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
