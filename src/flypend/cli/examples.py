"""The command that writes the examples: files of flights and studies, and a law of one's own."""

from __future__ import annotations

from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path, PurePosixPath
from typing import Annotated

import typer

from flypend.cli.terminal import bold, console
from flypend.errors import InputError
from flypend.files.staging import staged

app = typer.Typer()
SUFFIXES = (".toml", ".py")


@app.command()
def examples(
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder that receives the examples.")] = Path("examples"),
    force: Annotated[bool, typer.Option("--force", help="Replace files that differ from the examples.")] = False,
) -> None:
    """Write the examples: run files, a study, a law of one's own. A file that is there already is left as it is."""
    contents = {name: source.read_bytes() for name, source in shipped().items()}
    if not force:
        _check_free(out, contents)
    with staged(out) as folder:
        for name, content in contents.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)
    for name in contents:
        console.print(str(out / name), markup=False, soft_wrap=True)
    console.print(f"Try: flypend run {bold(out / 'swing-up.toml')}", soft_wrap=True)


def shipped() -> dict[PurePosixPath, Traversable]:
    """The examples in this installation, by their names in the folder of examples."""

    def walk(folder: Traversable, name: PurePosixPath) -> dict[PurePosixPath, Traversable]:
        found: dict[PurePosixPath, Traversable] = {}
        for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
            if entry.is_dir():
                found |= walk(entry, name / entry.name)
            elif entry.name.endswith(SUFFIXES):  # and not what Python compiled
                found[name / entry.name] = entry
        return found

    return walk(resources.files("flypend") / "examples", PurePosixPath())


def _check_free(out: Path, contents: dict[PurePosixPath, bytes]) -> None:
    for name, content in contents.items():
        place = out / name
        if place.is_file() and place.read_bytes() != content:
            raise InputError(str(place), "nothing there, or the example (--force replaces it)", "another file")
