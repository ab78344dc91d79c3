"""The commands for saved runs: replay, movie and figures."""

from __future__ import annotations

from pathlib import Path

import click

from flypend.cli.options import out_option, path, style_option
from flypend.cli.terminal import bold, console, counter, draw


@click.command()
@click.argument("runs", type=path, nargs=-1, required=True)
@out_option("replay.html", "Output page (.html), or a file for Foxglove (.mcap).")
@click.option(
    "--beside", is_flag=True, help="One panel per run, instead of one panel with ghosts; the page can switch."
)
@click.option("--title", help="Title; by default the laws and vehicles.")
@click.option("--speed", type=float, default=1.0, help="Flight time over playback time; 0.25 is slow motion.")
def replay(runs: tuple[Path, ...], out: Path, beside: bool, title: str | None, speed: float) -> None:
    """Write saved runs as one self-contained page for any browser, offline: play, scrub, rotate, compare.

    RUNS are one to four files saved by flypend (.nc); the camera follows the first. With --out flight.mcap, one run is
    written for Foxglove, PlotJuggler and ROS 2's tools, which needs the extra logs.
    """
    from flypend import errors
    from flypend.flight.trajectory import load

    first, *others = [load(path) for path in runs]
    if out.suffix.lower() == ".mcap":
        if others:
            raise errors.InputError("RUNS", "one run, for a file .mcap", f"{len(runs)}")
        first.to_mcap(out)
        console.print(f"Open {bold(out)} in Foxglove or PlotJuggler.")
        return
    first.to_html(out, ghost=others, title=title, layout="beside" if beside else "overlay", speed=speed)
    console.print(f"Open {bold(out)} in a browser.")


@click.command()
@click.argument("run", type=path)
@out_option("flight.mp4", "Output movie (.mp4 or .gif).")
@click.option("--camera", default="side", help="side, or axis (from above, along gravity).")
@click.option("--speed", type=float, default=0.25, help="Flight time over playback time; 0.25 is slow motion.")
@click.option("--fps", type=float, default=30.0, help="Frames per second of playback.")
@click.option(
    "--size", type=(int, int), default=(640, 640), metavar="WIDTH HEIGHT", help="Size in pixels; even numbers."
)
def movie(run: Path, out: Path, camera: str, speed: float, fps: float, size: tuple[int, int]) -> None:
    """Write a slow-motion movie of RUN, a file saved by flypend (.nc)."""
    from flypend import errors
    from flypend.flight.trajectory import load
    from flypend.pictures.animate import check_encoder
    from flypend.pictures.animate import movie as film
    from flypend.pictures.drawing import VIEWS

    view = errors.one_of("--camera", camera, VIEWS)
    flight = load(run)
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
    from flypend.files.staging import check_writable, staging
    from flypend.flight.trajectory import load
    from flypend.pictures.style import style_named
    from flypend.report.flight import figure_tasks

    form = style_named(style, font=font, titled=titles)
    flight = load(run)
    check_writable(out)
    with staging(out) as folder:
        draw(figure_tasks(flight, folder, style=form))
    console.print(f"Figures are in {bold(out)}.")
