"""The commands: parse arguments, make one call, print a table. Bad input prints one line and exits with code 2."""

from __future__ import annotations

import io
import signal
import sys
import traceback
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from typer.exceptions import TyperException

from flypend import __version__
from flypend.cli import examples, studies, theorem, viewing
from flypend.cli.terminal import LAW_HELP, bold, console, counter, progress, tell_how
from flypend.cli.viewing import Style
from flypend.errors import InputError

app = typer.Typer(
    help="Spherical pendulum on a quadrotor: reproduce the paper, test its claims, fly your own experiments.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)
app.add_typer(theorem.app)
app.add_typer(viewing.app)
app.add_typer(studies.app)
app.add_typer(examples.app)

Out = Annotated[Path, typer.Option("--out", "-o", help="Output folder.")]


def _version(wanted: bool) -> None:
    if wanted:
        console.print(f"flypend {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
    debug: Annotated[
        bool, typer.Option("--debug", help="Show the full traceback of an error, as in flypend --debug run 1.")
    ] = False,
) -> None:
    """Options common to all commands."""  # main looks for --debug itself: it must work even if parsing fails


@app.command()
def paper(
    out: Out = Path("paper-out"),
    quick: Annotated[bool, typer.Option("--quick", help="Skip the movies: seconds instead of a minute.")] = False,
    style: Style = "paper",
) -> None:
    """Fly the paper's five experiments and check every claim of its theorem.

    Writes figures, stop-motion, movies, every run as NetCDF, report.md and report.json.
    """
    from flypend.report.paper import reproduce
    from flypend.report.text import findings_table, judgement, summary_table

    with counter() as tell:
        result = reproduce(out, quick=quick, style=style, progress=tell)
    console.print(summary_table(result.verdicts))
    console.print(summary_table(result.repaired, title="Theorem 1 repaired: which claim holds after 30 s"))
    console.print(findings_table(result.findings))
    console.print(f"One swing-up by the inverted law, from hanging at rest: {judgement(result.swing_up)}.")
    console.print(f"Report, figures{'' if quick else ', movies'} and runs are in {bold(out)}; start with report.md.")


@app.command()
def run(
    what: Annotated[
        str, typer.Argument(help="An experiment of the paper (1, 2, 2-projected, 3, 4, 5) or a TOML file.")
    ],
    out: Out = Path("run-out"),
    law: Annotated[str | None, typer.Option("--law", help=f"Replace the law: {LAW_HELP}.")] = None,
    override: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="KEY=VALUE", help="Override a setting, such as law.gains.k_d=2 or law.name=printed."
        ),
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Skip the movies.")] = False,
    figures: Annotated[bool, typer.Option(help="Draw the figures (--no-figures also skips the movies).")] = True,
    controller: Annotated[
        str | None, typer.Option(help="python, or the law as exported, compiled C: c (double) or c-float.")
    ] = None,
    html: Annotated[
        Path | None, typer.Option("--html", metavar="FILE", help="Also write the replay, a page for any browser.")
    ] = None,
    style: Style = "paper",
) -> None:
    """Fly one experiment of the paper, or your own vehicle, law, gains and start.

    A TOML file has the keys [bold]vehicle[/bold] (a name or a table), [bold]law[/bold] (a name or a function, and
    gains), [bold]start[/bold] (x, x_dot, R, omega, y, y_dot) and [bold]duration[/bold] in seconds. Optional keys are
    [bold]plant[/bold] (ideal, rotors, mujoco, hehn2011, or a table), [bold]rtol[/bold], and [bold]experiment[/bold],
    which supplies missing values from the paper. A law that holds a position accepts a [bold]reference[/bold] (a shape
    and its parameters). [bold]controller[/bold] = "c" flies the law as exported C, on rotors and mujoco.
    """
    from flypend.files.staging import check_writable
    from flypend.files.whole import check_file
    from flypend.flight.simulate import fly
    from flypend.paper.claims import SETTLED
    from flypend.pictures.style import style_named
    from flypend.report.flight import check_movies
    from flypend.settings.runfile import run_file

    if figures and not quick:
        check_movies()
    changes = [*(override or ()), *([f"controller={controller}"] if controller is not None else [])]
    chosen = run_file(what, changes, law)
    flight = chosen.flight
    tell_how(flight.law)
    style_named(style)
    check_writable(out)
    if html is not None:
        check_file(html, (".html",))
    trajectory = fly(flight)
    # The printed law is not flown for longer: it drives the rod, and would spin it up without bound.
    longer = flight.replace(duration=max(SETTLED, flight.duration))
    settled = fly(longer) if trajectory.law in ("corrected", "repaired", "almost_global") else None
    from flypend.report.flight import THEOREMS, write_flight
    from flypend.report.text import judgement, summary_table

    verdicts = write_flight(
        trajectory,
        chosen.settings,
        out,
        settled=settled,
        with_figures=figures,
        with_movies=figures and not quick,
        style=style,
        progress=_run_tasks,
    )
    if html is not None:
        trajectory.to_html(html)
    console.print(f"{trajectory.law} on {trajectory.vehicle.name}: {trajectory.outcome}", markup=False)
    console.print(f"inverted: {judgement(trajectory)}")
    if verdicts:
        title = f"{THEOREMS.get(trajectory.law, 'Theorem 1')}: which claim holds"
        console.print(summary_table({(trajectory.law, what): verdicts}, title=title))
    console.print(f"Results are in {bold(out)}{f', the replay is {bold(html)}' if html else ''}.")


Laws = Annotated[
    list[str] | None,
    typer.Option("--law", help=f"Law to fly: {LAW_HELP}; repeatable."),
]
Starts = Annotated[str, typer.Option("--starts", help="random, or paper: its five starts, read in the e₃-up frame.")]
Runs = Annotated[int, typer.Option("--runs", help="Number of random starts.", min=1)]
Seed = Annotated[int, typer.Option("--seed", help="Seed of the random starts.", min=0)]
VehicleName = Annotated[str, typer.Option("--vehicle", help="Vehicle name or TOML file.")]
Duration = Annotated[float, typer.Option("--duration", help="Seconds per flight.")]


@app.command()
def compare(
    law: Laws = None,
    out: Out = Path("compare-out"),
    starts: Starts = "random",
    runs: Runs = 100,
    seed: Seed = 1,
    vehicle: VehicleName = "hehn2011",
    plant: Annotated[str, typer.Option("--plant", help="ideal, rotors, mujoco or hehn2011.")] = "rotors",
    duration: Duration = 10.0,
) -> None:
    """Compare laws, your own included, from the same starts: one table, one figure.

    A run succeeds if, during the last second, |y - e₃| and |z - e₃| stay below 0.05 and the pivot stays within 0.2 m of
    its reference.
    """
    from flypend.files.staging import check_writable
    from flypend.report.studies import comparison_table, write_comparison
    from flypend.studies import compare as fly

    chosen = _plant(plant)
    names = law or ["inverted", "lqr", "corrected", "detuned"]
    laws, batch, machine, settings = _study(names, starts, runs, seed, vehicle, duration)
    settings = {**settings, "plant": plant}
    check_writable(out)
    with counter() as tell:
        result = fly(machine, laws, batch, duration, plant=chosen, progress=tell)
    write_comparison(result, settings, out)
    console.print(comparison_table(result))
    console.print(f"Report and figure are in {bold(out)}.")


@app.command()
def ladder(
    law: Laws = None,
    out: Out = Path("ladder-out"),
    starts: Starts = "random",
    runs: Runs = 100,
    seed: Seed = 1,
    vehicle: VehicleName = "hehn2011",
    duration: Duration = 10.0,
    rung: Annotated[list[str] | None, typer.Option("--rung", help="Fly only this rung; repeatable.")] = None,
) -> None:
    """Find what breaks each law: rotor limits, lag, sampling, delay, noise, model mismatch or a pivot offset."""
    from flypend import errors
    from flypend.files.staging import check_writable
    from flypend.report.studies import ladder_table, write_ladder
    from flypend.studies import ladder as climb
    from flypend.studies.ladder import RUNGS

    laws, batch, machine, settings = _study(law or ["inverted", "lqr"], starts, runs, seed, vehicle, duration)
    chosen = {errors.one_of("--rung", name, RUNGS): RUNGS[name] for name in rung or RUNGS}
    check_writable(out)
    with counter() as tell:
        result = climb(machine, laws, batch, duration, rungs=chosen, progress=tell)
    write_ladder(result, settings, out)
    console.print(ladder_table(result))
    console.print(f"Report and figure are in {bold(out)}.")


@app.command()
def circles(law: Laws = None, seed: Seed = 1) -> None:
    """Fly hover and two circles in the set-up of Hehn and D'Andrea (2011), next to their published results."""
    from flypend.report.studies import tracking_table
    from flypend.studies.hehn import hehn2011

    console.print(tracking_table(hehn2011(tuple(law or ("inverted", "lqr")), seed)))


@app.command()
def lab(
    host: Annotated[str, typer.Option("--host", help="Address to listen on; the default admits this machine only.")] = (
        "127.0.0.1"
    ),
    port: Annotated[int, typer.Option("--port", help="Port; 0 picks a free one.", min=0, max=65535)] = 0,
    browser: Annotated[bool, typer.Option(help="Open the page in a browser.")] = True,
    law: Annotated[
        list[str] | None,
        typer.Option("--law", help="Custom law to offer, file.py:function or module:function; repeatable."),
    ] = None,
) -> None:
    """Open the laboratory in a browser: move sliders, drag the rod, poke it, and watch the flight. Ctrl-C stops it."""
    from flypend.lab import serve
    from flypend.settings.laws import law_named

    def announce(url: str) -> None:
        console.print(f"The laboratory is at {url}", soft_wrap=True)

    for name in law or ():
        tell_how(law_named(name))
    serve(host, port, browser=browser, laws=law or (), announce=announce)


@app.command("export-c")
def export_c(
    law: Annotated[str, typer.Option("--law", help=f"Law to export: {LAW_HELP}.")] = "inverted",
    vehicle: VehicleName = "hehn2011",
    out: Out = Path("c-out"),
    precision: Annotated[str, typer.Option("--precision", help="double or float.")] = "double",
    rate: Annotated[float, typer.Option("--rate", help="Control rate, Hz.")] = 500.0,
    light: Annotated[bool, typer.Option("--light", help="Export the light form of the inverted law.")] = False,
) -> None:
    """Export the flight computer of a law as C99: observer, prediction, law, allocation, lead; see docs/export."""
    from flypend import errors, model
    from flypend.compile.c99 import PRECISIONS
    from flypend.export import export_c as write
    from flypend.laws import Law, inverted
    from flypend.studies import law_named

    if light:
        errors.one_of("--law", law, ("inverted",))
    chosen = inverted(form="light") if light else law_named(law)
    if not isinstance(chosen, Law):
        because = f" ({chosen.because})" if chosen.because else ""
        raise InputError("--law", "a law written in symbols", f"{law}, which is not{because}")
    kind = next(known for known in PRECISIONS if known == errors.one_of("--precision", precision, PRECISIONS))
    write(chosen, model.vehicle(vehicle), out, precision=kind, rate=rate)
    console.print(f"C code of the {chosen.name} law is in {bold(out)}; start with README.md.")


def _study(
    names: list[str], starts: str, runs: int, seed: int, vehicle: str, duration: float
) -> tuple[list[Any], Any, Any, dict[str, Any]]:
    """Return the validated laws, starts and vehicle of a study, and the settings for its report."""
    from flypend import errors, model
    from flypend.studies import law_named, paper_starts, random_starts

    laws = [law_named(name) for name in names]
    for law in laws:
        tell_how(law)
    machine = model.vehicle(vehicle)
    errors.number("--duration", duration, above=0, unit="s")
    kind = errors.one_of("--starts", starts, ("random", "paper"))
    batch = paper_starts() if kind == "paper" else random_starts(runs, seed)
    settings = {"laws": names, "vehicle": machine.name, "starts": kind, "runs": len(batch), "duration": duration}
    return laws, batch, machine, settings | ({"seed": seed} if kind == "random" else {})


def _plant(name: str) -> Any:
    from flypend import errors
    from flypend.plants import PRESETS, plant

    return plant(errors.one_of("--plant", name, PRESETS))  # raises if an extra is not installed


def _run_tasks(tasks: Iterable[tuple[str, Callable[[], Any]]]) -> None:
    listed = list(tasks)
    with progress() as bar:
        shown = bar.add_task("", total=len(listed))
        for name, task in listed:
            bar.update(shown, description=f"drawing {name}")
            task()
            bar.advance(shown)


def main() -> None:
    """Run the command line; bad input prints one line and exits with code 2."""
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))  # clean up, as on Ctrl-C
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # the terminal's encoding may lack ✓ or ẍ
    try:
        code = app(standalone_mode=False)
    except (InputError, TyperException) as error:
        if "--debug" in sys.argv[1:]:
            traceback.print_exc()
        message = error.format_message() if isinstance(error, TyperException) else str(error)
        if message:  # empty without arguments: the help has already been printed
            line = " ".join(f"flypend: {message}".split())
            Console(stderr=True, soft_wrap=True, highlight=False).print(line, markup=False)
        sys.exit(2)
    sys.exit(code or 0)
