"""The commands for studies of many flights: sweep, map and tune."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

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

from flypend.cli.terminal import LAW_HELP, bold, console, resumable, stepped, tell_how

app = typer.Typer()

StudyFile = Annotated[Path, typer.Argument(help="TOML file of the study; docs/studies/studies.md lists the keys.")]
Store = Annotated[Path, typer.Option("--out", "-o", help="Zarr store for the runs; its name ends in .zarr.")]
Scheduler = Annotated[
    str | None, typer.Option("--scheduler", metavar="ADDRESS", help="Dask scheduler to use, such as tcp://host:8786.")
]
Workers = Annotated[int | None, typer.Option("--workers", min=1, help="Cores of this machine to use; default all.")]
Processes = Annotated[bool, typer.Option("--processes", help="Use worker processes instead of threads.")]
Law = Annotated[str | None, typer.Option("--law", help=f"Replace the law of the study: {LAW_HELP}.")]
Force = Annotated[bool, typer.Option("--force", help="Start over: discard the store of an earlier sweep.")]


@app.command()
def sweep(
    study: StudyFile,
    out: Store,
    scheduler: Scheduler = None,
    workers: Workers = None,
    processes: Processes = False,
    force: Force = False,
    law: Law = None,
) -> None:
    """Fly a study of up to 10⁷ runs into a Zarr store.

    After any interruption, the same command resumes the sweep. The result is bit-identical to an uninterrupted one.
    """
    from flypend.studies.sweep import study as study_from
    from flypend.studies.sweep import sweep as fly

    made = study_from(study, law)
    tell_how(made.law)
    processes = processes or stepped(made.law)
    with resumable(), run_counter(made.law.name) as tell:
        flown = fly(made, out, scheduler=scheduler, workers=workers, processes=processes, force=force, progress=tell)
    console.print(f"{told(int(flown.success.sum()), made.runs)} Runs are in {bold(out)}.")


@app.command("map")
def draw_map(
    what: Annotated[
        Path | None, typer.Argument(help="Store of a sweep (.zarr), or the TOML file of a study to fly first.")
    ] = None,
    out: Annotated[Path, typer.Option("--out", "-o", help="Output file: .png, .pdf or .svg.")] = Path("map.png"),
    x: Annotated[
        str | None, typer.Option("--x", help="Quantity on the horizontal axis, such as tilt, rate or gains.k_d.")
    ] = None,
    y: Annotated[str | None, typer.Option("--y", help="Quantity on the vertical axis.")] = None,
    law: Annotated[
        str | None, typer.Option("--law", help=f"Fly this law from random starts, not a study: {LAW_HELP}.")
    ] = None,
    vehicle: Annotated[str | None, typer.Option("--vehicle", help="With --law: vehicle name or TOML file.")] = None,
    plant: Annotated[str, typer.Option("--plant", help="With --law: rotors, ideal or hehn2011.")] = "rotors",
    runs: Annotated[int, typer.Option("--runs", min=1, help="With --law: number of runs.")] = 100_000,
    seed: Annotated[int, typer.Option("--seed", min=0, help="With --law: seed of the starts.")] = 1,
    duration: Annotated[float | None, typer.Option("--duration", help="With --law: seconds per run.")] = None,
    workers: Workers = None,
    force: Force = False,
) -> None:
    """Map success, settling time, excursion and causes of failure over the initial rod: on the sphere and in a plane.

    With a study or --law, the runs are saved to a store next to the map, and an interrupted command resumes.
    """
    from flypend.errors import InputError, require
    from flypend.files.whole import FIGURES, save_figure
    from flypend.pictures.maps import map_figure
    from flypend.studies.sweep import study as study_from
    from flypend.studies.sweep.study import standard

    for module in ("zarr", "xarray", "scipy"):
        require(module, extra="studies", for_="map")
    if (what is None) == (law is None):
        raise InputError("map", "a store, a study, or --law", "none" if what is None else "two of them")
    if out.suffix.lower() not in FIGURES:
        raise InputError("--out", "a file name ending in " + " or ".join(FIGURES), str(out))
    if law is not None:
        content = standard(law, vehicle, plant, runs, seed, duration)
    elif what is not None and what.suffix == ".toml":
        content = study_from(what).settings
    else:
        content = None
    store = what
    if content is not None:
        store = out.with_suffix(".zarr")
        sweep_into(store, content, workers, force)
    assert store is not None
    save_figure(map_figure(store, x=x, y=y), out)
    console.print(f"The map is in {bold(out)}.")


@app.command()
def tune(
    study: StudyFile,
    out: Annotated[Path, typer.Option("--out", "-o", help="Output folder.")] = Path("tune-out"),
    workers: Workers = None,
    law: Law = None,
) -> None:
    """Tune gains on the objective of a study, by CMA-ES, and report on held-out starts.

    Writes tuned.toml, an input of [bold]flypend run[/bold], and the history of the search as JSON and as a figure.
    """
    from flypend.files.staging import check_writable
    from flypend.report.tuning import told as told_of
    from flypend.report.tuning import write_tuned
    from flypend.studies.sweep import study as study_from
    from flypend.studies.tune import tune as search

    made = study_from(study, law)
    tell_how(made.law)
    check_writable(out)
    with run_counter("generations") as tell:
        result = search(made, workers=workers, progress=tell)
    write_tuned(result, out)
    console.print(f"before: {told_of(result.before)}", markup=False)
    console.print(f"after:  {told_of(result.after)}", markup=False)
    console.print(", ".join(f"{name} = {value:g}" for name, value in result.gains.items()), markup=False)
    console.print(f"Results are in {bold(out)}.")


def sweep_into(store: Path, content: dict[str, Any], workers: int | None, force: bool) -> None:
    """Fly the study with this `content` into `store`, show a progress bar, and print the success rate."""
    from flypend.studies.sweep import study as study_from
    from flypend.studies.sweep import sweep as fly

    made = study_from(content)
    tell_how(made.law)
    with resumable(), run_counter(made.law.name) as tell:
        flown = fly(made, store, workers=workers, processes=stepped(made.law), force=force, progress=tell)
    console.print(f"{told(int(flown.success.sum()), made.runs)} Runs are in {bold(store)}.")


def told(successes: int, runs: int) -> str:
    """Format a success rate with its 95 % confidence interval."""
    from flypend.flight.metrics import wilson

    low, high = wilson(successes, runs)
    share = 100 * successes / runs
    return f"{successes} of {runs} runs succeed: {share:.4g} % (95 % interval {100 * low:.4g} to {100 * high:.4g} %)."


class _Rate(ProgressColumn):
    """Column of the progress bar: runs per second."""

    def render(self, task: Task) -> Text:
        return Text("" if task.speed is None else f"{task.speed:,.0f}/s")


@contextmanager
def run_counter(name: str) -> Iterator[Callable[[int, int], None]]:
    """Yield the callback `(done, total)` of a progress bar with rate and remaining time; silent off a terminal."""
    on = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), _Rate(), TimeRemainingColumn())
    with Progress(*columns, console=on, transient=True, disable=not on.is_terminal) as bar:
        tasks: list[TaskID] = []

        def tell(done: int, total: int) -> None:
            if not tasks:  # runs flown earlier do not count towards the rate
                tasks.append(bar.add_task(escape(name), total=total, completed=done))
            bar.update(tasks[0], completed=done)

        yield tell
