"""Commands for studies of many flights: arguments in, one call, what came of it out."""

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

from flypend.cli.terminal import bold, console

app = typer.Typer()

StudyFile = Annotated[Path, typer.Argument(help="TOML file of the study; docs/studies/studies.md lists its keys.")]
Store = Annotated[Path, typer.Option("--out", "-o", help="Zarr store that receives the runs, ending in .zarr.")]
Scheduler = Annotated[
    str | None, typer.Option("--scheduler", metavar="ADDRESS", help="Dask scheduler to use, such as tcp://host:8786.")
]
Workers = Annotated[int | None, typer.Option("--workers", min=1, help="Cores of this machine to use; default all.")]
Processes = Annotated[bool, typer.Option("--processes", help="Use worker processes in place of threads.")]
Force = Annotated[bool, typer.Option("--force", help="Begin anew, whatever a sweep has left there.")]


@app.command()
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
    from flypend.studies.sweep import study as study_from
    from flypend.studies.sweep import sweep as fly

    made = study_from(study)
    with run_counter(made.law.name) as tell:
        flown = fly(made, out, scheduler=scheduler, workers=workers, processes=processes, force=force, progress=tell)
    console.print(f"{told(int(flown.success.sum()), made.runs)} Runs are in {bold(out)}.")


@app.command("map")
def draw_map(
    what: Annotated[
        Path | None, typer.Argument(help="Store of a sweep (.zarr), or the TOML file of a study, which is flown first.")
    ] = None,
    out: Annotated[Path, typer.Option("--out", "-o", help="Picture: .png, .pdf or .svg.")] = Path("map.png"),
    x: Annotated[
        str | None, typer.Option("--x", help="Quantity along the plane, such as tilt, rate or gains.k_d.")
    ] = None,
    y: Annotated[str | None, typer.Option("--y", help="Quantity up the plane.")] = None,
    law: Annotated[
        str | None, typer.Option("--law", help="In place of a store: fly this law from random starts.")
    ] = None,
    vehicle: Annotated[str | None, typer.Option("--vehicle", help="With --law: name of a vehicle.")] = None,
    plant: Annotated[str, typer.Option("--plant", help="With --law: rotors, ideal or hehn2011.")] = "rotors",
    runs: Annotated[int, typer.Option("--runs", min=1, help="With --law: number of runs.")] = 100_000,
    seed: Annotated[int, typer.Option("--seed", min=0, help="With --law: seed of the starts.")] = 1,
    duration: Annotated[float | None, typer.Option("--duration", help="With --law: seconds per run.")] = None,
    workers: Workers = None,
    force: Force = False,
) -> None:
    """Draw where the rod may start: success, settling time, excursion, causes of failure, on the sphere and in a plane.

    With a study or --law the runs are kept in a store beside the picture, so that a run that is stopped goes on.
    """
    from flypend.errors import InputError, require
    from flypend.files.whole import FIGURES, save_figure
    from flypend.pictures.maps import map_figure
    from flypend.studies.sweep import study as study_from
    from flypend.studies.sweep.study import standard

    for module in ("zarr", "xarray", "distributed", "scipy"):
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
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder that receives the results.")] = Path("tune-out"),
    workers: Workers = None,
) -> None:
    """Improve gains on the objective of a study, by CMA-ES; report on starts that were not tuned on.

    Writes tuned.toml, which [bold]flypend run[/bold] takes, and the history of the search with its picture.
    """
    from flypend.files.staging import check_writable
    from flypend.report.tuning import told as told_of
    from flypend.report.tuning import write_tuned
    from flypend.studies.sweep import study as study_from
    from flypend.studies.tune import tune as search

    made = study_from(study)
    check_writable(out)
    with run_counter("generations") as tell:
        result = search(made, workers=workers, progress=tell)
    write_tuned(result, out)
    console.print(f"before: {told_of(result.before)}", markup=False)
    console.print(f"after:  {told_of(result.after)}", markup=False)
    console.print(", ".join(f"{name} = {value:g}" for name, value in result.gains.items()), markup=False)
    console.print(f"Results are in {bold(out)}.")


def sweep_into(store: Path, content: dict[str, Any], workers: int | None, force: bool) -> None:
    """Fly the study with this `content` into `store`, with a progress bar, and say what came of it."""
    from flypend.studies.sweep import study as study_from
    from flypend.studies.sweep import sweep as fly

    made = study_from(content)
    with run_counter(made.law.name) as tell:
        flown = fly(made, store, workers=workers, force=force, progress=tell)
    console.print(f"{told(int(flown.success.sum()), made.runs)} Runs are in {bold(store)}.")


def told(successes: int, runs: int) -> str:
    """A success rate with its interval, in words."""
    from flypend.flight.metrics import wilson

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
