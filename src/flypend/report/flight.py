"""The output of one run: its file, figures, movies and verdicts."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

from flypend import errors
from flypend.files import whole
from flypend.files.staging import staging
from flypend.flight.metrics import metrics
from flypend.flight.trajectory import Trajectory
from flypend.model.by_name import name_with_changes
from flypend.paper.claims import Verdict, claims_of
from flypend.pictures.style import Style
from flypend.report import text

VIEWS = ("side", "axis")
MOVIE_SPEED = 0.25
THEOREMS = {"repaired": "Theorem A", "almost_global": "Theorem B"}  # of docs/laws/theorem.md; else the paper's
Task = Callable[[], Any]


def figure_tasks(
    run: Trajectory, folder: Path, prefix: str = "", stop_motion: bool = True, style: str | Style = "paper"
) -> list[tuple[str, Task]]:
    """Return named tasks that draw the figures of `run` in `style` into `folder`; `prefix` starts each file name."""
    from flypend.pictures import figures  # imports matplotlib, which is slow and not needed without figures

    kinds: dict[str, Callable[..., Any]] = {"y3-z3": figures.paper_figure, "full": figures.full_figure}
    if stop_motion:
        kinds["stop-motion"] = figures.stop_motion
    named = {f"{prefix}{kind}": figure for kind, figure in kinds.items()}
    return [(name, partial(draw, figure, run, folder / name, style)) for name, figure in named.items()]


def check_movies() -> None:
    """Raise InputError if movies cannot be made. Call it before any flight."""
    errors.require("imageio_ffmpeg", extra="movies", for_="movies")


def movie_tasks(run: Trajectory, folder: Path, prefix: str = "") -> list[tuple[str, Task]]:
    """Return named tasks that write the movies of `run`, from the side and along e₃, into `folder`."""
    from flypend.pictures.animate import movie

    named = {f"{prefix}movie-{view}": view for view in VIEWS}
    return [
        (name, partial(movie, run, folder / f"{name}.mp4", view=view, speed=MOVIE_SPEED))
        for name, view in named.items()
    ]


def draw(figure: Callable[..., Any], run: Trajectory, path: Path, style: str | Style = "paper") -> None:
    """Draw one `figure` of `run` in `style` to `path` as .pdf and .png."""
    whole.save_both(figure(run, style=style), path)


def write_flight(
    run: Trajectory,
    settings: dict[str, Any],
    out: str | Path,
    *,
    settled: Trajectory | None = None,
    with_figures: bool = True,
    with_movies: bool = True,
    style: str = "paper",
    progress: Callable[[Iterable[tuple[str, Task]]], Any] | None = None,
) -> list[Verdict]:
    """Write run.nc, figures, movies, report.md and report.json of `run` into the folder `out`, all or nothing.

    `settings`, the content of the run file, is kept in report.json. Limits are measured on `settled`, the same flight
    over a longer duration. `progress` runs an iterable of named tasks, by default in silence. Return the verdicts on
    the claims of the law's theorem, none for a law without V. Raises InputError if `out` is not writable.
    """
    if with_movies:
        check_movies()
    ideal = run.interpolant is not None  # the theorem knows of no rotors
    verdicts = claims_of(run, settled or run) if ideal and "V" in run.signals else []
    with staging(out) as folder:
        run.save(folder / "run.nc")
        tasks = figure_tasks(run, folder, style=style) if with_figures else []
        tasks += movie_tasks(run, folder) if with_movies else []
        if progress is not None:
            progress(tasks)
        else:
            for _, task in tasks:
                task()
        key = (run.law, str(settings.get("experiment", "own start")))
        parts = [f"# A run of {run.law} on {name_with_changes(run.vehicle)}", f"Outcome: {run.outcome}."]
        if verdicts:
            table = text.verdicts_markdown({key: verdicts}, {key: str(run.outcome)})
            parts += [f"## Claims of {THEOREMS.get(run.law, 'Theorem 1')}", table]
        parts.append(f"Goal: {text.judgement(run)}.\n")
        content = {"settings": settings, "outcome": vars(run.outcome), "claims": verdicts}
        text.write_report(folder, "\n\n".join(parts), {**content, "inverted": vars(metrics(run))})
    return verdicts
