"""The commands that list what there is: laws with their gains, and vehicles."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from flypend.cli.options import path, vehicle_option
from flypend.cli.terminal import bold, console

WIDTH = 100  # of a table of gains, in which the meanings wrap


@click.command()
@click.argument("name", required=False)
@vehicle_option
def laws(name: str | None, vehicle: str) -> None:
    """List the laws with their gains: default for a vehicle, unit, meaning. NAME selects one, or a law of yours."""
    from flypend import model
    from flypend.laws import law_names
    from flypend.settings.laws import OTHERS, law_named

    machine = model.vehicle(vehicle)
    width = min(WIDTH, console.width)
    for each in [name] if name else law_names():
        law = law_named(each, key="law")
        console.print(f"{law.name} (e3 {law.e3}), defaults for {machine.name}", markup=False)
        console.print(_gains(law, machine) if law.table else "  no gains", width=width)
    for each, meaning in () if name else OTHERS.items():
        console.print(f"{each}: {meaning}", markup=False, width=width)


@click.command()
@click.argument("vehicle", required=False)
@click.option("-o", "--out", type=path, metavar="FILE", help="Draw VEHICLE into this file, .png, .pdf or .svg.")
def vehicles(vehicle: str | None, out: Path | None) -> None:
    """List the vehicles, or print the TOML of VEHICLE (a name or a file), or with -o draw it on its mounts."""
    from flypend import model
    from flypend.errors import InputError
    from flypend.model.shipped import vehicle_text

    if vehicle is None:
        if out is not None:
            raise InputError("-o", "a VEHICLE to draw", "none")
        console.print(_vehicles(), crop=False)
        return
    text = vehicle_text(vehicle)
    if out is None:
        click.echo(text, nl=False)
        return
    from flypend.files.whole import save_figure
    from flypend.pictures.machine import machine_figure

    save_figure(machine_figure(model.vehicle(vehicle)), out)
    console.print(f"The drawing is {bold(out)}.")


def _vehicles() -> Any:
    """The table of the package's vehicles."""
    from flypend import model
    from flypend.model.table import vehicle_names

    units = ("mass\nkg", "bob\nkg", "rod\nm", "thrust/\nweight", "lag\ns", "rotors", "g\nm/s²")
    found = _table("vehicle", *units)
    for name in vehicle_names():
        v = model.vehicle(name)
        rotors = len(v.rotor_spins)
        ratio = f"{rotors * v.rotor_limits[1] / v.weight:.3g}"
        numbers = (f"{x:g}" for x in (v.mass, v.bob_mass, v.rod_length))
        found.add_row(name, *numbers, ratio, f"{v.rotor_lag:g}", str(rotors), f"{v.gravity:g}")
    for column in found.columns:  # 80 columns; a narrower terminal wraps the lines, not the names
        column.min_width = max(map(len, column.cells))
    return found


def _gains(law: Any, machine: Any) -> Any:
    """The table of the gains of a law."""
    from flypend.errors import InputError

    found = _table("gain", "default", "unit", "meaning")
    for gain in law.table.values():
        try:
            value = law.given[gain.name] if gain.name in getattr(law, "given", {}) else gain.value(machine)
        except InputError:  # it has none for this vehicle
            value = "–"
        found.add_row(gain.name, f"{value:.4g}" if isinstance(value, float) else str(value), gain.unit or "–", gain.doc)
    return found


def _table(*names: str) -> Any:
    from rich.box import SIMPLE
    from rich.table import Table

    found = Table(box=SIMPLE, padding=(0, 1, 0, 0))
    for place, name in enumerate(names):
        number = 0 < place < len(names) - (names[-1] == "meaning") - (names[-2] == "unit")
        found.add_column(name, justify="right" if number else "left", overflow="fold")
    return found
