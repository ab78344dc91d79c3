"""The command about the cache of machine code."""

from __future__ import annotations

from pathlib import Path

import click

from flypend.cli.options import path
from flypend.cli.terminal import bold, console


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
