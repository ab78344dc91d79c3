"""The commands: parse arguments, make one call, print a table. Bad input prints one line and exits with code 2."""

from __future__ import annotations

import signal
import sys
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from flypend import __version__, signals
from flypend.cli import (
    cache,
    check,
    examples,
    export,
    identification,
    learning,
    listing,
    planning,
    studies,
    theorem,
    viewing,
)
from flypend.cli.options import (
    LAW_HELP,
    bands_option,
    floor_option,
    laws_option,
    option,
    options_of,
    out_option,
    path,
    plant_asked,
    refuse_idle,
    sensors_option,
    style_option,
    within_bands,
)
from flypend.cli.terminal import (
    bold,
    console,
    counter,
    draw,
    import_in_background,
    lacking,
    say,
    tell_how,
)
from flypend.errors import InputError, require

if TYPE_CHECKING:
    from flypend.flight.request import Flight
    from flypend.plants import AnyPlant


class _Commands(click.Group):
    """Lists the commands in the order in which they are added, each with its whole first sentence."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(self.commands)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, some.get_short_help_str(1000)) for name, some in self.commands.items()])


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"], "show_default": True, "max_content_width": 100},
)
@click.version_option(__version__, message="%(prog)s %(version)s", prog_name="flypend")
@click.option("--debug", is_flag=True, help="Show the full traceback of an error: flypend --debug run 1.")
def app(debug: bool) -> None:
    """A spherical pendulum on a quadrotor: fly laws, compare them, study a vehicle, export C, reproduce the paper."""
    # main looks for --debug itself: it must work even if parsing fails


@app.command()
@out_option("paper-out")
@click.option("--quick", is_flag=True, help="Skip the movies.")
@style_option
def paper(out: Path, quick: bool, style: str) -> None:
    """Fly the paper's five experiments and check every claim of its theorem.

    Writes figures, stop-motion, movies, every run as NetCDF, report.md and report.json.
    """
    from flypend.report.flight import check_movies
    from flypend.report.paper import reproduce
    from flypend.report.text import findings_table, judgement, summary_table

    movies = not (quick or lacking("movies", check_movies))
    with counter() as tell:
        result = reproduce(out, quick=not movies, style=style, progress=tell)
    console.print(summary_table(result.verdicts))
    console.print(summary_table(result.repaired, title="Theorem 1 repaired: which claim holds after 30 s"))
    console.print(findings_table(result.findings))
    console.print(f"One swing-up by the inverted law, from hanging at rest: {judgement(result.swing_up)}.")
    console.print(f"Report, figures{', movies' if movies else ''} and runs are in {bold(out)}; start with report.md.")


@dataclass(frozen=True)
class Shown:
    """What is drawn of a flight."""

    quick: bool = option("--quick", is_flag=True, help="Skip the movies.")
    figures: bool = option(
        "--figures/--no-figures", default=True, help="Draw the figures (--no-figures also skips the movies)."
    )
    html: Path | None = option(
        "--html", type=path, metavar="FILE", help="Also write the replay, a page that opens in any browser."
    )
    live: bool = option(
        "--live", is_flag=True, help="Make the page of --html interactive: poke, pull, start anywhere, move gains."
    )


@app.command()
@click.argument("what")
@out_option("run-out")
@click.option("--law", help=f"Replace the law: {LAW_HELP}.")
@click.option(
    "--set",
    "override",
    metavar="KEY=VALUE",
    multiple=True,
    help="Override a setting, such as law.gains.k_d=2 or law.name=printed.",
)
@click.option("--controller", help="python, or the law as compiled C: c (double) or c-float.")
@options_of(Shown, "shown")
@style_option
def run(
    what: str,
    out: Path,
    law: str | None,
    override: tuple[str, ...],
    controller: str | None,
    shown: Shown,
    style: str,
) -> None:
    """Fly WHAT: an experiment of the paper (1, 2, 2-projected, 3, 4, 5), or a TOML file of your own.

    A TOML file has the keys vehicle (a name or a table), law (a name or a function, and gains), start (x, x_dot, R,
    omega, y, y_dot) and duration in seconds. Optional keys are plant (ideal, rotors, mujoco, hehn2011, laboratory, or a
    table), rtol, and experiment, which supplies missing values from the paper. A law that holds a position accepts a
    reference (a shape and its parameters). controller = "c" flies the law as exported C, on rotors and mujoco.
    """
    from flypend.files.staging import check_writable
    from flypend.files.whole import check_file
    from flypend.flight.feasibility import forewarn
    from flypend.flight.simulate import fly
    from flypend.model.shipped import name_with_changes
    from flypend.paper.claims import SETTLED
    from flypend.pictures.style import style_named
    from flypend.report.flight import THEOREMS, check_movies, write_flight
    from flypend.report.text import judgement, summary_table
    from flypend.settings.laws import describe_law
    from flypend.settings.runfile import run_file

    if not shown.figures:
        refuse_idle("style", why="beside --no-figures")
    chosen = run_file(what, _changes(override, law, controller), law)
    flight = chosen.flight
    if chosen.settings.get("controller", "python") == "python":  # of compiled C, the note would be wrong
        tell_how(flight.law)
    for doubt in forewarn(flight):
        say(f"flypend: warning: {doubt}")
    style_named(style)
    check_writable(out)
    if shown.html is not None:
        check_file(shown.html, (".html",))
    if shown.live:
        check_live(flight, shown.html)
    movies = shown.figures and not (shown.quick or lacking("movies", check_movies))
    trajectory = fly(flight)
    # The printed law is not flown for longer: it drives the rod, and would spin it up without bound.
    longer = flight.replace(duration=max(SETTLED, flight.duration))
    settled = fly(longer) if trajectory.law in ("corrected", "repaired", "almost_global") else None
    verdicts = write_flight(
        trajectory,
        chosen.settings,
        out,
        settled=settled,
        with_figures=shown.figures,
        with_movies=movies,
        style=style,
        progress=draw,
    )
    if shown.html is not None:
        trajectory.to_html(shown.html, live=shown.live)
    console.print(
        f"{describe_law(flight.law, flight.vehicle)} on {name_with_changes(flight.vehicle)}: {trajectory.outcome}",
        markup=False,
    )
    console.print(f"Goal: {judgement(trajectory)}.")
    if verdicts:
        title = f"{THEOREMS.get(trajectory.law, 'Theorem 1')}: which claim holds"
        console.print(summary_table({(trajectory.law, what): verdicts}, title=title))
    page = f", the {'live page' if shown.live else 'replay'} is {bold(shown.html)}" if shown.html else ""
    console.print(f"Results are in {bold(out)}{page}.")
    if trajectory.outcome.status != "completed":
        sys.exit(1)


def _changes(override: Sequence[str], law: str | None, controller: str | None) -> list[str]:
    """Return the overrides of a run file. Raises InputError for a --set that says what --law or --controller says."""
    for named, given, key in (("--law", law, "law"), ("--controller", controller, "controller")):
        for one in override if given is not None else ():
            if one.partition("=")[0].strip() in (key, f"{key}.name", f"{key}.function"):
                raise InputError(named, f"nothing beside --set {one}", repr(given))
    return [*override, *([f"controller={controller}"] if controller is not None else [])]


def check_live(flight: Flight, html: Path | None) -> None:
    """Raise InputError unless a page `html` is asked for, and can fly `flight` by itself."""
    from flypend.flight.live import live_loop

    if html is None:
        raise InputError("--live", "--html FILE, the page that flies", "none")
    live_loop(flight)


@dataclass(frozen=True)
class Starts:
    """Which vehicle flies from where, and for how long."""

    starts: str = option(
        "--starts", default="random", help="random, or paper: the five starts of the paper, in the e₃-up frame."
    )
    runs: int = option("--runs", type=click.IntRange(min=1), default=100, help="Number of random starts.")
    seed: int = option("--seed", type=click.IntRange(min=0), default=1, help="Seed of the random starts.")
    vehicle: str = option("--vehicle", default="hehn2011", help="Vehicle name or TOML file.")
    duration: float = option("--duration", type=float, default=10.0, help="Seconds per flight.")

    def of(self, names: Sequence[str]) -> tuple[list[Any], Any, Any, dict[str, Any]]:
        """Return the laws called `names`, starts and vehicle, and the settings for a report. Raises InputError."""
        from flypend import errors, model
        from flypend.studies import law_named, paper_starts, random_starts

        laws = [law_named(name) for name in names]
        for law in laws:
            tell_how(law)
        machine = model.vehicle(self.vehicle)
        errors.number("--duration", self.duration, above=0, unit="s")
        kind = errors.one_of("--starts", self.starts, ("random", "paper"))
        if kind == "paper":
            refuse_idle("runs", "seed", why="beside --starts paper, which are five")
        batch = paper_starts() if kind == "paper" else random_starts(self.runs, self.seed)
        settings = {"laws": list(names), "vehicle": machine.name, "starts": kind, "runs": len(batch)}
        settings["duration"] = self.duration
        return laws, batch, machine, settings | ({"seed": self.seed} if kind == "random" else {})


@app.command()
@laws_option
@out_option("compare-out")
@options_of(Starts, "chosen")
@click.option("--plant", default="rotors", help="ideal, rotors, mujoco, hehn2011 or laboratory.")
@sensors_option
@bands_option
@floor_option
@click.option("--keep", type=path, metavar="DIR", help="Also save each failed flight in DIR (.nc).")
def compare(
    law: tuple[str, ...],
    out: Path,
    chosen: Starts,
    plant: str,
    sensors: str,
    bands: bool,
    floor: float | None,
    keep: Path | None,
) -> None:
    """Compare laws, your own included, from the same starts, in one table and one figure.

    The first 100 failures of each law become run files for flypend run, in the folder failed of the output.

    A run succeeds if, during the last second, |y - e₃| and |z - e₃| stay below 0.05 and the pivot stays within 0.2 m of
    its reference.
    """
    from flypend.files.staging import check_writable, staging
    from flypend.report.studies import comparison_table, write_comparison
    from flypend.settings.runfile import plant_of
    from flypend.studies import compare as fly
    from flypend.studies.compare import files_of_failures, fly_again

    asked, duration = plant_asked(plant, sensors, floor), chosen.duration
    world = plant_of(asked)
    names = law or ("inverted", "lqr", "corrected", "detuned")
    laws, batch, machine, settings = chosen.of(names)
    settings = {**settings, "plant": asked} | ({"bands": True} if bands else {})
    drawn = list(within_bands(machine, asked, chosen.seed).values()) if bands else []
    for folder in (out, keep) if keep is not None else (out,):
        check_writable(folder)
    import_in_background(lambda: import_module("flypend.pictures.studies"))
    with counter() as tell:
        flying = lambda name, done, total: tell(f"flying {name}", done, total)  # noqa: E731
        result = fly(machine, laws, batch, duration, plant=drawn or world, progress=flying)
    failed = files_of_failures(result, names, asked, duration, drawn)
    write_comparison(result, settings, out, failed)
    if keep is not None:
        with staging(keep) as folder, counter() as tell:
            fly_again(failed, folder, tell)
    console.print(comparison_table(result))
    again = f", {len(failed)} failed flights in {bold(out / 'failed')}" if failed else ""
    console.print(f"Report and figure are in {bold(out)}{again}.")


@app.command()
@laws_option
@out_option("ladder-out")
@options_of(Starts, "chosen")
@click.option(
    "--rung", multiple=True, help="Fly only this rung; repeatable. Combine departures with commas: 'noise, rod +10 %'."
)
@click.option("--sensors", help="Fly a rung for each error of these sensors instead: mocap or onboard.")
@bands_option
def ladder(
    law: tuple[str, ...],
    out: Path,
    chosen: Starts,
    rung: tuple[str, ...],
    sensors: str | None,
    bands: bool,
) -> None:
    """Find what breaks each law: limits, lag, motors, air, sampling, delay, noise, wrong models, or several at once."""
    from flypend.files.staging import check_writable
    from flypend.plants import plant
    from flypend.report.studies import ladder_table, write_ladder
    from flypend.studies import ladder as climb
    from flypend.studies.ladder import rung_named, rungs_for, sensor_rungs

    laws, batch, machine, settings = chosen.of(law or ("inverted", "lqr"))
    if bands:
        rungs: Mapping[str, AnyPlant] = within_bands(machine, plant_asked("rotors", sensors or "perfect"), chosen.seed)
    else:
        rungs = rungs_for(machine) if sensors is None else sensor_rungs(sensors)
    flown = {
        name: rung_named(name, rungs)
        for name in rung or rungs
        if rung or not lacking(f"the rung {name}", partial(plant, rungs[name]))
    }
    check_writable(out)
    import_in_background(lambda: import_module("flypend.pictures.studies"))
    with counter() as tell:
        result = climb(machine, laws, batch, chosen.duration, rungs=flown, progress=tell)
    write_ladder(result, settings, out)
    console.print(ladder_table(result))
    console.print(f"Report and figure are in {bold(out)}.")


LOCAL = "127.0.0.1"


@app.command()
@click.option("--host", default=LOCAL, help="Address to listen on; the default accepts this machine only.")
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port; 0 picks a free one.")
@click.option("--browser/--no-browser", default=True, help="Open the page in a browser.")
@click.option("--law", multiple=True, help="Your own law, file.py:function or module:function; repeatable.")
@click.option(
    "--html",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Write the laboratory as one page that needs no server, and exit.",
)
def lab(host: str, port: int, browser: bool, law: tuple[str, ...], html: Path | None) -> None:
    """Open the laboratory in a browser: move sliders, drag the rod, poke it, watch the flight. Ctrl-C ends it."""
    if html is not None:
        served = {"--law": law, "--host": host != LOCAL, "--port": port, "--no-browser": not browser}
        write_laboratory(html, [name for name, given in served.items() if given])
        return
    require("tornado", extra="lab", for_="lab")
    from flypend.lab.server import serve
    from flypend.settings.laws import law_named

    for name in law:
        tell_how(law_named(name))
    announce = partial(console.print, "The laboratory is at", soft_wrap=True)
    serve(host, port, browser=browser, laws=law, announce=announce)


def write_laboratory(html: Path, served: list[str]) -> None:
    """Write the laboratory as the page `html`. Raises InputError if options are given that only a server has."""
    from flypend.files.whole import whole_file
    from flypend.lab.alone import page_alone

    if served:
        raise InputError(served[0], "nothing beside --html, whose page has no server", "it")
    with whole_file(html, (".html",)) as partial, counter() as tell:
        partial.write_text(page_alone(tell=tell), encoding="utf-8")
    console.print(f"The laboratory is in {bold(html)}.")


for _command in (
    theorem.theorem, planning.plan, learning.learn, studies.sweep, studies.draw_map, studies.tune,
    identification.vehicle, identification.identify, check.check, viewing.replay, viewing.movie, viewing.figures,
    listing.laws, listing.vehicles, examples.examples, cache.cache, export.export_c, export.export_app,
):  # fmt: skip
    app.add_command(_command)


def main() -> None:
    """Call the command of the arguments and exit; bad input prints one line and exits with code 2."""
    sys.exit(_call())


def _call() -> int:
    """Call the command of the arguments, and return its exit code."""
    try:
        return app(prog_name="flypend", standalone_mode=False) or 0
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        return 2
    except (InputError, click.ClickException) as error:
        signals.poll()  # what the signal has ended is no bad input
        if "--debug" in sys.argv[1:]:
            traceback.print_exc()
        message = error.format_message() if isinstance(error, click.ClickException) else str(error)
        if isinstance(error, click.UsageError) and error.ctx is not None:
            message += f" See {error.ctx.command_path} --help."
        say(" ".join(f"flypend: {message}".split()))
        return 2
    except (KeyboardInterrupt, click.Abort):
        return 128 + signal.SIGINT
