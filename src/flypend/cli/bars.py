"""Progress bars of a terminal."""

from __future__ import annotations

from rich.console import Console
from rich.progress import (
    BarColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.text import Text


class _Rate(ProgressColumn):
    """Column of the progress bar: runs per second."""

    def render(self, task: Task) -> Text:
        return Text("" if task.speed is None else f"{task.speed:,.0f}/s")


class _Done(ProgressColumn):
    """Column of the progress bar: how much is done, in words that cannot be taken for successes."""

    def render(self, task: Task) -> Text:
        return Text("" if task.total is None else f"{task.completed:,.0f} of {task.total:,.0f} done")


def progress_bar(on: Console, *, rate: bool = False) -> Progress:
    """Return an empty progress bar, with the `rate` of runs and the remaining time, or else with the elapsed time."""
    times = (_Rate(), TimeRemainingColumn()) if rate else (TimeElapsedColumn(),)
    return Progress(TextColumn("{task.description}"), BarColumn(), _Done(), *times, console=on, transient=True)
