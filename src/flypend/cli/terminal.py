"""Shared by all commands: the console, progress bars and the formatting of paths."""

from __future__ import annotations

import os
import shlex
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.markup import escape
from rich.text import Text

from flypend import signals
from flypend.errors import InputError

if TYPE_CHECKING:
    from rich.progress import Progress

# Off a terminal, lines are as long as they are: whoever reads a file or a pipe wraps them.
_free = not sys.stdout.isatty() and "COLUMNS" not in os.environ
console = Console(width=1000 if _free else None)
# Without a terminal, a line on stderr tells how far a long command is: every 30 s.
EVERY = 30.0


def complaints() -> Console:
    """Return a console on stderr that neither wraps nor highlights."""
    return Console(stderr=True, soft_wrap=True, highlight=False)


def say(line: str) -> None:
    """Print `line` on stderr, as it is."""
    complaints().print(line, markup=False)


@contextmanager
def counter(*, rate: bool = False) -> Iterator[Callable[[str, int, int], None]]:
    """Yield the callback `(name, done, total)` of a progress bar on stderr, or of a line now and then.

    With `rate` the bar shows runs per second and the time left.
    """
    on = complaints()
    if not on.is_terminal:
        yield lines(on)
        return
    with progress_bar(on, rate=rate) as bar:
        task = bar.add_task("starting", total=None)

        def tell(what: str, done: int, total: int) -> None:
            if bar.tasks[task].total is None:  # runs flown earlier do not count towards the rate
                bar.reset(task, completed=done)
            bar.update(task, description=escape(what), completed=done, total=total)

        yield tell


def progress_bar(on: Console, *, rate: bool = False) -> Progress:
    """Return an empty progress bar, with the `rate` of runs and the remaining time, or else with the elapsed time."""
    from rich import progress  # slow to import

    class Told(progress.ProgressColumn):
        """A column that says of a task what the function `tell` does."""

        def __init__(self, tell: Callable[[progress.Task], str]) -> None:
            super().__init__()
            self.tell = tell

        def render(self, task: progress.Task) -> Text:
            return Text(self.tell(task))

    # In words that cannot be taken for successes.
    done = Told(lambda task: "" if task.total is None else f"{task.completed:,.0f} of {task.total:,.0f} done")
    speed = Told(lambda task: "" if task.speed is None else f"{task.speed:,.0f}/s")
    times = (speed, progress.TimeRemainingColumn()) if rate else (progress.TimeElapsedColumn(),)
    name = progress.TextColumn("{task.description}")
    return progress.Progress(name, progress.BarColumn(), done, *times, console=on, transient=True)


def lines(on: Console) -> Callable[[str, int, int], None]:
    """Return a callback `(name, done, total)` that prints a line now and then, with the time left."""
    due = time.monotonic() + EVERY
    begin, first, last, whole = 0.0, 0, 0, -1  # of the count that is running

    def tell(what: str, done: int, total: int) -> None:
        nonlocal due, begin, first, last, whole
        now = time.monotonic()
        if total != whole or done < last:  # another count, at a pace of its own
            begin, first, whole = now, done, total  # what an earlier command has done costs no time
        last = done
        if now < due or done >= total:
            return
        due = now + EVERY
        fresh = done - first
        left = f", about {_span((now - begin) * (total - done) / fresh)} left" if fresh > 0 else ""
        on.print(f"{what}: {done} of {total} done{left}", markup=False)

    return tell


def _span(seconds: float) -> str:
    """Format a time to come: 40 s, 12 min, 3.5 h."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def draw(tasks: Iterable[tuple[str, Callable[[], Any]]]) -> None:
    """Do the named `tasks`, one after the other, behind a progress bar."""
    listed = list(tasks)
    with counter() as tell:
        for done, (name, task) in enumerate(listed):
            signals.poll()
            tell(f"drawing {name}", done, len(listed))
            task()


def is_missing(what: str, check: Callable[[], Any]) -> bool:
    """Whether `check` raises InputError. If so, one line on stderr says that `what` is left out, and what it needs."""
    try:
        check()
    except InputError as missing:
        say(f"flypend: without {what}: needs {missing.expected}")
        return True
    return False


@contextmanager
def resumable() -> Iterator[None]:
    """Tell on stderr, if the block is interrupted, which command resumes it: this one, without --force."""
    try:
        yield
    except BaseException as error:
        if signals.word[0] or isinstance(error, KeyboardInterrupt):
            again = shlex.join(["flypend", *(word for word in sys.argv[1:] if word != "--force")])
            say(f"Finished work is kept. To resume: {again}")
        raise


def bold(path: Path) -> str:
    """Return `path` in bold, any markup in its name escaped."""
    return f"[bold]{escape(str(path))}[/bold]"


def tell_how(law: Any) -> None:
    """Print one line on stderr if `law` cannot be compiled."""
    from flypend.settings.laws import note

    if said := note(law):
        say(said)


def import_in_background(bring: Callable[[], Any]) -> None:
    """Call `bring`, which imports, in a thread. What fails there fails again, and is told, where it is used."""

    def run() -> None:
        with suppress(Exception):
            bring()

    Thread(target=run, daemon=True, name="flypend-imports").start()
