"""The commands for single flights: fly, replay, film and draw them, and change them in the laboratory."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import click

import flypend as fp
from flypend.cli.options import LAW_HELP, Output, option, options_of, out_option, path, refuse_idle, style_option
from flypend.cli.terminal import bold, console, counter, draw, is_missing, say, tell_how
from flypend.errors import InputError, one_of, require
from flypend.files.staging import staging
from flypend.files.whole import whole_file


@dataclass(frozen=True)
class Shown:
    """What is drawn of a flight."""

    quick: bool = option("Skip the movies.")
    figures: bool = option(
        "Draw the figures (--no-figures also skips the movies).", "--figures/--no-figures", default=True
    )
    html: Path | None = option("Also write the replay, a page that opens in any browser.", type=Output(".html"))
    live: bool = option("Make the page of --html interactive: poke, pull, start anywhere, move gains.")


@click.command()
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
    what: str, out: Path, law: str | None, override: tuple[str, ...], controller: str | None, shown: Shown, style: str
) -> None:
    """Fly WHAT: an experiment of the paper (1, 2, 2-projected, 3, 4, 5), or a TOML file of your own.

    A TOML file has the keys vehicle (a name or a table), law (a name or a function, and gains), start (x, x_dot, R,
    omega, y, y_dot) and duration in seconds. Optional keys are plant (ideal, rotors, mujoco, hehn2011, laboratory, or a
    table), rtol, and experiment, which supplies missing values from the paper. A law that holds a position accepts a
    reference (a shape and its parameters). controller = "c" flies the law as exported C, on rotors and mujoco.
    """
    from flypend.flight.feasibility import forewarn
    from flypend.flight.simulate import fly
    from flypend.model.by_name import name_with_changes
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
    if shown.live:
        if shown.html is None:
            raise InputError("--live", "--html FILE, the page that flies", "none")
        from flypend.flight.live import live_loop

        live_loop(flight)
    movies = shown.figures and not (shown.quick or is_missing("movies", check_movies))
    trajectory = fly(flight)
    # The printed law is not flown for longer: it drives the rod, and would spin it up without bound.
    longer = flight.replace(duration=max(SETTLED, flight.duration))
    limits = trajectory.interpolant is not None and trajectory.law in ("corrected", "repaired", "almost_global")
    settled = fly(longer) if limits else None
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


@click.command()
@click.argument("runs", type=path, nargs=-1, required=True)
@out_option("replay.html", "Output page (.html), or a file for Foxglove (.mcap).", ".html", ".mcap")
@click.option(
    "--beside", is_flag=True, help="One panel per run, instead of one panel with ghosts; the page can switch."
)
@click.option("--title", help="Title; by default the laws and vehicles.")
@click.option("--speed", default=1.0, help="Flight time over playback time; 0.25 is slow motion.")
def replay(runs: tuple[Path, ...], out: Path, beside: bool, title: str | None, speed: float) -> None:
    """Write saved runs as one self-contained page for any browser, offline: play, scrub, rotate, compare.

    RUNS are one to four files saved by flypend (.nc); the camera follows the first. With --out flight.mcap, one run is
    written for Foxglove, PlotJuggler and ROS 2's tools, which needs the extra logs.
    """
    first, *others = [fp.load(path) for path in runs]
    if out.suffix.lower() == ".mcap":
        if others:
            raise InputError("RUNS", "one run, for a file .mcap", f"{len(runs)}")
        first.to_mcap(out)
        console.print(f"Open {bold(out)} in Foxglove or PlotJuggler.")
        return
    first.to_html(out, ghost=others, title=title, layout="beside" if beside else "overlay", speed=speed)
    console.print(f"Open {bold(out)} in a browser.")


@click.command()
@click.argument("run", type=path)
@out_option("flight.mp4", "Output movie (.mp4 or .gif).", ".mp4", ".gif")
@click.option("--camera", default="side", help="side, or axis (from above, along gravity).")
@click.option("--speed", default=0.25, help="Flight time over playback time; 0.25 is slow motion.")
@click.option("--fps", default=30.0, help="Frames per second of playback.")
@click.option(
    "--size", type=(int, int), default=(640, 640), metavar="WIDTH HEIGHT", help="Size in pixels; even numbers."
)
def movie(run: Path, out: Path, camera: str, speed: float, fps: float, size: tuple[int, int]) -> None:
    """Write a slow-motion movie of RUN, a file saved by flypend (.nc)."""
    from flypend.pictures.animate import check_encoder
    from flypend.pictures.animate import movie as film
    from flypend.pictures.drawing import VIEWS

    view = one_of("--camera", camera, VIEWS)
    flight = fp.load(run)
    check_encoder(out)
    with counter() as tell:
        film(flight, out, view=view, speed=speed, fps=fps, size=size, progress=lambda *n: tell("filming", *n))
    console.print(f"The movie is {bold(out)}.")


@click.command()
@click.argument("run", type=path)
@out_option("figures-out")
@style_option
@click.option("--font", default="", help="Font family, such as serif or 'Times New Roman'; embedded in the .pdf.")
@click.option("--title/--no-title", "titles", default=True, help="Draw titles; a figure with a caption needs none.")
def figures(run: Path, out: Path, style: str, font: str, titles: bool) -> None:
    """Draw the figures of RUN, a file saved by flypend (.nc), each as .pdf and .png."""
    from flypend.pictures.style import style_named
    from flypend.report.flight import figure_tasks

    form = style_named(style, font=font, titled=titles)
    flight = fp.load(run)
    with staging(out) as folder:
        draw(figure_tasks(flight, folder, style=form))
    console.print(f"Figures are in {bold(out)}.")


@click.command()
@click.option("--host", default="127.0.0.1", help="Address to listen on; the default accepts this machine only.")
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port; 0 picks a free one.")
@click.option("--browser/--no-browser", default=True, help="Open the page in a browser.")
@click.option("--law", multiple=True, help="Your own law, file.py:function or module:function; repeatable.")
@click.option("--html", type=Output(".html"), help="Write the laboratory as one page that needs no server, and exit.")
def lab(host: str, port: int, browser: bool, law: tuple[str, ...], html: Path | None) -> None:
    """Open the laboratory in a browser: move sliders, drag the rod, poke it, watch the flight. Ctrl-C ends it."""
    if html is not None:
        refuse_idle("host", "port", "browser", "law", why="beside --html, whose page has no server")
        from flypend.lab.standalone import lab_page

        with whole_file(html, (".html",)) as written, counter() as tell:
            written.write_text(lab_page(tell=tell), encoding="utf-8")
        console.print(f"The laboratory is in {bold(html)}.")
        return
    require("tornado", extra="lab", for_="lab")
    from multiprocessing import get_all_start_methods

    if "forkserver" not in get_all_start_methods():
        raise InputError("lab", "a system that forks processes, or --html, which has no server", sys.platform)
    from flypend.lab.server import serve
    from flypend.settings.laws import law_named

    for name in law:
        tell_how(law_named(name))
    announce = partial(console.print, "The laboratory is at", soft_wrap=True)
    serve(host, port, browser=browser, laws=law, announce=announce)
