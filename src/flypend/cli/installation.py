"""The commands about what an installation holds: laws, vehicles, examples, and compiled machine code."""

from __future__ import annotations

from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path, PurePosixPath
from typing import Any

import click

import flypend as fp
from flypend.cli.options import FIGURE, out_option, path, vehicle_option
from flypend.cli.terminal import bold, console
from flypend.errors import InputError
from flypend.files.staging import write_texts
from flypend.files.whole import check_same, save_figure

WIDTH = 100  # of a table of gains, in which the meanings wrap
SUFFIXES = (".toml", ".py")  # of examples; others are Python's bytecode


@click.command()
@click.argument("name", required=False)
@vehicle_option
def laws(name: str | None, vehicle: str) -> None:
    """List the laws with their gains: default for a vehicle, unit, meaning. NAME selects one, or a law of yours."""
    from flypend.laws import law_names
    from flypend.settings.laws import OTHERS, law_named

    machine = fp.vehicle(vehicle)
    width = min(WIDTH, console.width)
    for each in [name] if name else law_names():
        law = law_named(each, key="law")
        console.print(f"{law.name} (e3 {law.e3}), defaults for {machine.name}", markup=False)
        console.print(_gains(law, machine) if law.table else "  no gains", width=width)
    for each, meaning in () if name else OTHERS.items():
        console.print(f"{each}: {meaning}", markup=False, width=width)


@click.command()
@click.argument("vehicle", required=False)
@click.option("-o", "--out", type=FIGURE, help="Draw VEHICLE into this file, .png, .pdf or .svg.")
def vehicles(vehicle: str | None, out: Path | None) -> None:
    """List the vehicles, or print the TOML of VEHICLE (a name or a file), or with -o draw it on its mounts."""
    from flypend.model.by_name import vehicle_text

    if vehicle is None:
        if out is not None:
            raise InputError("-o", "a VEHICLE to draw", "none")
        console.print(_vehicles(), crop=False)
        return
    text = vehicle_text(vehicle)
    if out is None:
        click.echo(text, nl=False)
        return
    from flypend.pictures.machine import machine_figure

    save_figure(machine_figure(fp.vehicle(vehicle)), out)
    console.print(f"The drawing is {bold(out)}.")


def _vehicles() -> Any:
    """The table of the package's vehicles."""
    from flypend.model.table import vehicle_names

    units = ("mass\nkg", "bob\nkg", "rod\nm", "thrust/\nweight", "lag\ns", "rotors", "g\nm/s²")
    found = _table("vehicle", *units)
    for name in vehicle_names():
        v = fp.vehicle(name)
        rotors = len(v.rotor_spins)
        ratio = f"{rotors * v.rotor_limits[1] / v.weight:.3g}"
        numbers = (f"{x:g}" for x in (v.mass, v.bob_mass, v.rod_length))
        found.add_row(name, *numbers, ratio, f"{v.rotor_lag:g}", str(rotors), f"{v.gravity:g}")
    for column in found.columns:  # 80 columns; a narrower terminal wraps the lines, not the names
        column.min_width = max(map(len, column.cells))
    return found


def _gains(law: Any, machine: Any) -> Any:
    """The table of the gains of a law."""
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
    for name in names:
        worded = name in ("vehicle", "gain", "unit", "meaning")
        found.add_column(name, justify="left" if worded else "right", overflow="fold")
    return found


@click.command()
@out_option("examples")
@click.option("--force", is_flag=True, help="Overwrite files that differ from the examples.")
def examples(out: Path, force: bool) -> None:
    """Write the examples: a run file, a study, a custom law. Files that you changed are kept, unless --force."""
    texts = {str(name): source.read_text(encoding="utf-8") for name, source in read_shipped().items()}
    if not force:
        for name, text in texts.items():
            check_same(out / name, text.encode(), "the example")
    write_texts(out, texts)
    for name in texts:
        console.print(str(out / name), markup=False, soft_wrap=True)
    console.print(f"Try: flypend run {bold(out / 'swing-up.toml')}", soft_wrap=True)


def read_shipped() -> dict[PurePosixPath, Traversable]:
    """Return the examples shipped with the package, by path relative to the output folder."""

    def walk(folder: Traversable, name: PurePosixPath) -> dict[PurePosixPath, Traversable]:
        found: dict[PurePosixPath, Traversable] = {}
        for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
            if entry.is_dir():
                found |= walk(entry, name / entry.name)
            elif entry.name.endswith(SUFFIXES):
                found[name / entry.name] = entry
        return found

    return walk(resources.files("flypend") / "examples", PurePosixPath())


@click.group(invoke_without_command=True)
@click.pass_context
def cache(context: click.Context) -> None:
    """Show where compiled machine code is kept and how much there is; clear or move it."""
    if context.invoked_subcommand is None:
        from flypend.compile.cache import summarise

        found = summarise()
        console.print(f"Machine code is in {bold(found.place.folder)} ({found.place.named_by}).", soft_wrap=True)
        console.print(f"{found.entries} entries, {_megabytes(found.size)} of at most {_megabytes(found.place.limit)}.")


@cache.command()
def clear() -> None:
    """Remove all machine code. Commands compile what they need again."""
    from flypend.compile.cache import summarise

    gone = summarise(clear=True)
    console.print(f"Removed {gone.entries} entries, {_megabytes(gone.size)}.")


@cache.command()
@click.argument("folder", metavar="DIR", type=path)
def move(folder: Path) -> None:
    """Move machine code to DIR, and keep it there from now on. The variable FLYPEND_CACHE, if set, overrides DIR."""
    from flypend.compile.cache import move as move_to

    move_to(folder)
    console.print(f"Machine code is in {bold(folder.absolute())}.", soft_wrap=True)


def _megabytes(size: float) -> str:
    return f"{size / 1e6:.3g} MB"
