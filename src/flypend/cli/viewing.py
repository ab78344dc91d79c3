"""The commands for saved runs: replay, movie and figures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from flypend.cli.terminal import bold, console, counter, progress

app = typer.Typer()

Saved = Annotated[Path, typer.Argument(help="A run saved by flypend (.nc).")]
Style = Annotated[str, typer.Option("--style", help="paper (one or two columns) or slides (16:9, larger fonts).")]


@app.command()
def replay(
    runs: Annotated[list[Path], typer.Argument(help="One to four saved runs (.nc); the camera follows the first.")],
    out: Annotated[Path, typer.Option("--out", "-o", help="Output page (.html).")] = Path("replay.html"),
    beside: Annotated[
        bool, typer.Option("--beside", help="One panel per run; default one panel with ghosts. The page can switch.")
    ] = False,
    title: Annotated[str | None, typer.Option("--title", help="Title; default the laws and vehicles.")] = None,
    speed: Annotated[float, typer.Option("--speed", help="Flight time over playback time.")] = 1.0,
) -> None:
    """Write saved runs as one self-contained page for any browser, offline: play, scrub, rotate, compare."""
    from flypend.flight.trajectory import load

    first, *others = [load(path) for path in runs]
    first.to_html(out, ghost=others, title=title, layout="beside" if beside else "overlay", speed=speed)
    console.print(f"Open {bold(out)} in a browser.")


@app.command()
def movie(
    run: Saved,
    out: Annotated[Path, typer.Option("--out", "-o", help="Output movie (.mp4 or .gif).")] = Path("flight.mp4"),
    camera: Annotated[str, typer.Option("--camera", help="side, or axis (from above, along gravity).")] = "side",
    speed: Annotated[float, typer.Option("--speed", help="Flight time over playback time.")] = 0.25,
    fps: Annotated[float, typer.Option("--fps", help="Frames per second of playback.")] = 30,
    size: Annotated[
        tuple[int, int], typer.Option("--size", metavar="WIDTH HEIGHT", help="Size in pixels; even numbers.")
    ] = (640, 640),
) -> None:
    """Write a slow-motion movie of a saved run."""
    from flypend import errors
    from flypend.flight.trajectory import load
    from flypend.pictures.animate import check_encoder
    from flypend.pictures.animate import movie as film
    from flypend.pictures.drawing import VIEWS

    view = errors.one_of("--camera", camera, VIEWS)
    check_encoder(out)
    flight = load(run)
    with counter() as tell:
        film(flight, out, view=view, speed=speed, fps=fps, size=size, progress=lambda *n: tell("filming", *n))
    console.print(f"The movie is {bold(out)}.")


@app.command()
def figures(
    run: Saved,
    out: Annotated[Path, typer.Option("--out", "-o", help="Output folder.")] = Path("figures-out"),
    style: Style = "paper",
    font: Annotated[
        str, typer.Option("--font", help="Font family, such as serif or 'Times New Roman'; embedded in the .pdf.")
    ] = "",
    titles: Annotated[
        bool, typer.Option("--title/--no-title", help="Titles; a figure with a caption needs none.")
    ] = True,
) -> None:
    """Draw the figures of a saved run, each as .pdf and .png."""
    from flypend.files.staging import check_writable, staged
    from flypend.flight.trajectory import load
    from flypend.pictures.style import style_named
    from flypend.report.flight import figure_tasks

    form = style_named(style, font=font, titled=titles)
    flight = load(run)
    check_writable(out)
    with staged(out) as folder, progress() as bar:
        for name, task in bar.track(figure_tasks(flight, folder, style=form), description="drawing"):
            bar.update(bar.task_ids[0], description=f"drawing {name}")
            task()
    console.print(f"Figures are in {bold(out)}.")
