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


def task_bar(on: Console) -> Progress:
    """Return an empty progress bar with the elapsed time."""
    columns = (TextColumn("{task.description}"), BarColumn(), _Done(), TimeElapsedColumn())
    return Progress(*columns, console=on, transient=True)


def run_bar(on: Console) -> Progress:
    """Return an empty progress bar with the rate and the remaining time."""
    columns = (TextColumn("{task.description}"), BarColumn(), _Done(), _Rate(), TimeRemainingColumn())
    return Progress(*columns, console=on, transient=True)
