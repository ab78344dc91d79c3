"""Commands for studies of many flights: arguments in, one call, what came of it out."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text

console = Console()

StudyFile = Annotated[Path, typer.Argument(help="TOML file of the study; docs/studies.md lists its keys.")]
Store = Annotated[Path, typer.Option("--out", "-o", help="Zarr store that receives the runs, ending in .zarr.")]
Scheduler = Annotated[
    str | None, typer.Option("--scheduler", metavar="ADDRESS", help="Dask scheduler to use, such as tcp://host:8786.")
]
Workers = Annotated[int | None, typer.Option("--workers", min=1, help="Cores of this machine to use; default all.")]
Processes = Annotated[bool, typer.Option("--processes", help="Use worker processes in place of threads.")]
Force = Annotated[bool, typer.Option("--force", help="Begin anew, whatever a sweep has left there.")]


def sweep(
    study: StudyFile,
    out: Store,
    scheduler: Scheduler = None,
    workers: Workers = None,
    processes: Processes = False,
    force: Force = False,
) -> None:
    """Fly a study of up to 10⁷ runs into a Zarr store.

    Stopped in any way, the same command goes on where it was; the result is the same to the last bit.
    """
    from flypend.sweep import study as study_from
    from flypend.sweep import sweep as fly

    made = study_from(study)
    with run_counter(made.law.name) as tell:
        flown = fly(made, out, scheduler=scheduler, workers=workers, processes=processes, force=force, progress=tell)
    console.print(f"{told(int(flown.success.sum()), made.runs)} Runs are in [bold]{escape(str(out))}[/bold].")


def told(successes: int, runs: int) -> str:
    """A success rate with its interval, in words."""
    from flypend.metrics import wilson

    low, high = wilson(successes, runs)
    share = 100 * successes / runs
    return f"{successes} of {runs} runs succeed: {share:.4g} % (95 % interval {100 * low:.4g} to {100 * high:.4g} %)."


class _Rate(ProgressColumn):
    """Runs per second."""

    def render(self, task: Task) -> Text:
        return Text("" if task.speed is None else f"{task.speed:,.0f}/s")


@contextmanager
def run_counter(name: str) -> Iterator[Callable[[int, int], None]]:
    """A progress bar with rate and remaining time, told (done, total); on a terminal only."""
    on = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), _Rate(), TimeRemainingColumn())
    with Progress(*columns, console=on, transient=True, disable=not on.is_terminal) as bar:
        tasks: list[TaskID] = []

        def tell(done: int, total: int) -> None:
            if not tasks:  # what was there already is not counted into the rate
                tasks.append(bar.add_task(escape(name), total=total, completed=done))
            bar.update(tasks[0], completed=done)

        yield tell
