"""Shared by all commands: the console, progress bars and the formatting of paths."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

console = Console()
LAW_HELP = (
    "a name (inverted, almost_global, repaired, lqr, corrected, printed, detuned), file.py:function or module:function"
)


@contextmanager
def counter() -> Iterator[Callable[[str, int, int], None]]:
    """Yield the callback `(name, done, total)` of a progress bar."""
    with progress() as bar:
        task = bar.add_task("starting", total=None)
        yield lambda what, done, total: bar.update(task, description=what, completed=done, total=total)


def progress() -> Progress:
    """Return an empty progress bar on stderr; it is silent if stderr is not a terminal."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    on = Console(stderr=True)
    return Progress(*columns, console=on, transient=True, disable=not on.is_terminal)


def bold(path: Path) -> str:
    """Return `path` in bold, any markup in its name escaped."""
    return f"[bold]{escape(str(path))}[/bold]"


def stepped(law: Any) -> bool:
    """Whether `law` flies step by step in Python, so that only processes can use more than one core."""
    from flypend.laws import Controller

    return isinstance(law, Controller)


def tell_how(law: Any) -> None:
    """Print one line on stderr if `law` cannot be compiled."""
    from flypend.settings.laws import note

    if said := note(law):
        Console(stderr=True, soft_wrap=True, highlight=False).print(said, markup=False)
