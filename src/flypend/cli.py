"""Command line: arguments in, one call, a table out. Bad input is one line and exit code 2."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from typer.exceptions import TyperException

from flypend import __version__
from flypend.errors import InputError

app = typer.Typer(
    help="Spherical pendulum on a quadrotor: reproduce the paper, fly experiments, see what holds.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)
console = Console()

Out = Annotated[Path, typer.Option("--out", "-o", help="Folder that receives the results.")]


def _version(wanted: bool) -> None:
    if wanted:
        console.print(f"flypend {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    pass


@app.command()
def paper(
    out: Out = Path("paper-out"),
    quick: Annotated[bool, typer.Option("--quick", help="Leave the movies out: seconds instead of a minute.")] = False,
) -> None:
    """Fly the paper's five experiments and say for every claim whether it holds.

    Writes figures, stop-motion, movies, every run as NetCDF, report.md and report.json.
    """
    from flypend.report.paper import reproduce
    from flypend.report.text import findings_table, summary_table

    with _progress() as bar:
        task = bar.add_task("starting", total=None)
        result = reproduce(
            out,
            quick=quick,
            progress=lambda what, done, total: bar.update(task, description=what, completed=done, total=total),
        )
    console.print(summary_table(result.verdicts))
    console.print(findings_table(result.findings))
    console.print(
        f"Report, figures{'' if quick else ', movies'} and runs are in [bold]{out}[/bold]; read report.md first."
    )


@app.command()
def run(
    what: Annotated[
        str, typer.Argument(help="An experiment of the paper (1, 2, 2-projected, 3, 4, 5) or a TOML file.")
    ],
    out: Out = Path("run-out"),
    override: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="KEY=VALUE", help="Override a setting, such as law.gains.k_d=2 or law.name=printed."
        ),
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Leave the movies out.")] = False,
    figures: Annotated[bool, typer.Option(help="Draw the figures (--no-figures leaves movies out as well).")] = True,
) -> None:
    """Fly one experiment, or one's own vehicle, law, gains and start.

    A TOML file has the keys [bold]vehicle[/bold] (a name, or a table), [bold]law[/bold] (name, gains),
    [bold]start[/bold] (x, x_dot, R, omega, y, y_dot), [bold]duration[/bold] in seconds, and optionally
    [bold]experiment[/bold], which brings all of them, and [bold]rtol[/bold].
    """
    from flypend.experiments.claims import SETTLED
    from flypend.report.staging import check_writable
    from flypend.runfile import flight

    chosen = flight(what, override or ())
    check_writable(out)
    trajectory = chosen.fly()
    settled = chosen.fly(max(SETTLED, chosen.duration)) if "V" in trajectory.signals else None
    from flypend.report.flight import write_flight
    from flypend.report.text import summary_table

    verdicts = write_flight(
        trajectory,
        chosen.settings,
        out,
        settled=settled,
        with_figures=figures,
        with_movies=figures and not quick,
        progress=_run_tasks,
    )
    console.print(f"{trajectory.law} on {trajectory.vehicle.name}: {trajectory.outcome}")
    if verdicts:
        console.print(summary_table({(trajectory.law, what): verdicts}))
    console.print(f"Results are in [bold]{out}[/bold].")


def _progress() -> Progress:
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(*columns, console=Console(stderr=True), transient=True)


def _run_tasks(tasks: Iterable[tuple[str, Callable[[], Any]]]) -> None:
    listed = list(tasks)
    with _progress() as bar:
        shown = bar.add_task("", total=len(listed))
        for name, task in listed:
            bar.update(shown, description=f"drawing {name}")
            task()
            bar.advance(shown)


def main() -> None:
    """Run the command line; bad input prints one line and exits with code 2."""
    try:
        code = app(standalone_mode=False)
    except (InputError, TyperException) as error:
        message = error.format_message() if isinstance(error, TyperException) else str(error)
        if message:  # without arguments the help has been printed already
            Console(stderr=True, soft_wrap=True, highlight=False).print(f"flypend: {message}", markup=False)
        sys.exit(2)
    sys.exit(code or 0)
