"""What commands share: the console, progress bars, and how a path is shown."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

console = Console()
LAW_HELP = "a name (inverted, lqr, corrected, printed, detuned), file.py:function or module:function"


@contextmanager
def counter() -> Iterator[Callable[[str, int, int], None]]:
    """A progress bar that is told what is done, of how many, under which name."""
    with progress() as bar:
        task = bar.add_task("starting", total=None)
        yield lambda what, done, total: bar.update(task, description=what, completed=done, total=total)


def progress() -> Progress:
    """An empty progress bar, on stderr if that is a terminal and nowhere else."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    on = Console(stderr=True)
    return Progress(*columns, console=on, transient=True, disable=not on.is_terminal)


def bold(path: Path) -> str:
    """`path` in bold, whatever is in its name."""
    return f"[bold]{escape(str(path))}[/bold]"


def stepped(law: Any) -> bool:
    """Whether a `law` flies step by step in Python, so that only processes make use of more than one core."""
    from flypend.laws import Controller

    return isinstance(law, Controller)


def tell_how(law: Any) -> None:
    """Say in one line, on stderr, that no compiled code flies a `law`, where that is so."""
    from flypend.settings.laws import note

    if said := note(law):
        Console(stderr=True, soft_wrap=True, highlight=False).print(said, markup=False)
