"""The command that writes the examples: run files, a study, and a custom law."""

from __future__ import annotations

from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path, PurePosixPath

import click

from flypend.cli.options import out_option
from flypend.cli.terminal import bold, console
from flypend.files.staging import check_writable, staging
from flypend.files.whole import check_same

SUFFIXES = (".toml", ".py")


@click.command()
@out_option("examples")
@click.option("--force", is_flag=True, help="Overwrite files that differ from the examples.")
def examples(out: Path, force: bool) -> None:
    """Write the examples: a run file, a study, a custom law. Files that you changed are kept, unless --force."""
    contents = {name: source.read_bytes() for name, source in read_shipped().items()}
    check_writable(out)
    if not force:
        for name, content in contents.items():
            check_same(out / name, content, "the example")
    with staging(out) as folder:
        for name, content in contents.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)
    for name in contents:
        console.print(str(out / name), markup=False, soft_wrap=True)
    console.print(f"Try: flypend run {bold(out / 'swing-up.toml')}", soft_wrap=True)


def read_shipped() -> dict[PurePosixPath, Traversable]:
    """Return the examples shipped with the package, by path relative to the output folder."""

    def walk(folder: Traversable, name: PurePosixPath) -> dict[PurePosixPath, Traversable]:
        found: dict[PurePosixPath, Traversable] = {}
        for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
            if entry.is_dir():
                found |= walk(entry, name / entry.name)
            elif entry.name.endswith(SUFFIXES):  # skips Python's bytecode
                found[name / entry.name] = entry
        return found

    return walk(resources.files("flypend") / "examples", PurePosixPath())
