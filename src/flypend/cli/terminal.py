"""Shared by all commands: the console, progress bars and the formatting of paths."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape

console = Console()


def complaints() -> Console:
    """Return a console on stderr that neither wraps nor highlights."""
    return Console(stderr=True, soft_wrap=True, highlight=False)


@contextmanager
def counter() -> Iterator[Callable[[str, int, int], None]]:
    """Yield the callback `(name, done, total)` of a progress bar on stderr; it is silent if that is not a terminal."""
    on = complaints()
    if not on.is_terminal:
        yield lambda *_: None
        return
    from flypend.cli.bars import task_bar  # slow to import

    with task_bar(on) as bar:
        task = bar.add_task("starting", total=None)
        yield lambda what, done, total: bar.update(task, description=what, completed=done, total=total)


def draw(tasks: Iterable[tuple[str, Callable[[], Any]]]) -> None:
    """Do the named `tasks`, one after the other, behind a progress bar."""
    listed = list(tasks)
    with counter() as tell:
        for done, (name, task) in enumerate(listed):
            tell(f"drawing {name}", done, len(listed))
            task()


@contextmanager
def resumable() -> Iterator[None]:
    """Tell on stderr, if the block is interrupted, which command resumes it: this one, without --force."""
    try:
        yield
    except (KeyboardInterrupt, SystemExit):
        again = shlex.join(["flypend", *(word for word in sys.argv[1:] if word != "--force")])
        complaints().print(f"Stopped; every finished chunk is kept. To go on:\n  {again}", markup=False)
        raise


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
        complaints().print(said, markup=False)
