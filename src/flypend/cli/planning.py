"""The command that plans a flight."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from flypend.cli.options import out_option, path, refuse_idle, vehicle_option
from flypend.cli.terminal import bold, console, counter

if TYPE_CHECKING:
    from flypend.model import State, Vehicle


@click.command()
@click.argument("what", required=False)
@vehicle_option
@out_option("plan.nc", "Output file (.nc): the plan.")
@click.option("--objective", default="excursion", help="What to make small: excursion, effort or time.")
@click.option("--duration", type=float, help="Time until hover, s; default long enough.")
@click.option("--floor", type=float, metavar="M", help="Lowest height of pivot and rod.")
@click.option("--ceiling", type=float, metavar="M", help="Largest height of pivot and rod.")
@click.option("--cube", type=float, metavar="M", help="Side of a cube about the target that pivot and rod stay in.")
@click.option("--speed", type=float, metavar="M/S", help="Largest speed of the pivot.")
@click.option(
    "--lean", type=float, metavar="DEG", help="Largest angle between rod and vertical; 90: above the horizon."
)
@click.option("--target", type=float, nargs=3, default=(0.0, 0.0, 0.0), metavar="X Y Z", help="Where the pivot hovers.")
@click.option(
    "--window",
    type=float,
    nargs=5,
    multiple=True,
    metavar="X Y Z WIDTH HEIGHT",
    help="Opening to fly through, in a wall normal to the x axis. Several are possible.",
)
@click.option(
    "--waypoint", type=float, nargs=3, multiple=True, metavar="X Y Z", help="Point that the pivot passes; in order."
)
@click.option("--fly", metavar="PLANT", help="Also fly the plan with feedback: rotors or mujoco.")
@click.option("--c", "in_c", type=path, metavar="FOLDER", help="Also write the plan with its gains as a table in C.")
@click.option("--figure", type=path, metavar="FILE", help="Also draw the plan; with --fly, beside its flight.")
@click.option("--front", type=path, metavar="FILE", help="Also draw excursion against allowed time.")
@click.option(
    "--map",
    "sphere",
    type=path,
    metavar="FILE",
    help="Also draw how far plans, nmpc and the inverted law stray from rest, over all directions of the rod.",
)
@click.option("--html", type=path, metavar="FILE", help="Also write the replay; with --fly, the plan is the ghost.")
def plan(
    what: str | None,
    vehicle: str,
    out: Path,
    objective: str,
    duration: float | None,
    floor: float | None,
    ceiling: float | None,
    cube: float | None,
    speed: float | None,
    lean: float | None,
    target: tuple[float, float, float],
    window: tuple[tuple[float, ...], ...],
    waypoint: tuple[tuple[float, ...], ...],
    fly: str | None,
    in_c: Path | None,
    figure: Path | None,
    front: Path | None,
    sphere: Path | None,
    html: Path | None,
) -> None:
    """Plan an optimal flight to inverted hover: from the start in WHAT, a run file, or else from hanging at rest.

    A run file also names the vehicle; its law and duration do not matter. Figures are .png, .pdf or .svg.
    """
    import numpy as np

    from flypend import errors
    from flypend.files.whole import FIGURES
    from flypend.flight.metrics import metrics
    from flypend.flight.simulate import simulate
    from flypend.planning import Constraints, Window, track
    from flypend.planning import plan as planned

    figures = {"--figure": figure, "--front": front, "--map": sphere}
    pages = {"--out": (out, (".nc",)), "--html": (html, (".html",))}
    _check_files(pages | {option: (file, FIGURES) for option, file in figures.items()})
    _check_options(what, fly, in_c)
    machine, start = _from(what, vehicle)
    half = None if cube is None else errors.number("--cube", cube, above=0, unit="m") / 2
    box = None if half is None else ((-half,) * 3, (half,) * 3)
    windows = [Window(place[:3], *place[3:]) for place in window]
    kept = Constraints(
        floor=floor, ceiling=ceiling, speed=speed, window=windows or None, waypoints=waypoint or None,
        box=None if box is None else np.add(box, target), lean=None if lean is None else np.radians(lean),
    )  # fmt: skip
    found = planned(machine, start, objective, duration=duration, target=target, constraints=kept)
    console.print(f"{machine.name}: {found.told}", markup=False)
    found.save(out)
    console.print(f"The plan is {bold(out)}.")
    if not found:
        sys.exit(1)
    if in_c is not None:
        from flypend.export import export_plan

        export_plan(found, in_c)
        console.print(f"The table in C is in {bold(in_c)}.")
    shown, ghosts = found.trajectory, []
    if fly is not None:
        shown, ghosts = simulate(machine, track(found), start, found.duration + 2, plant=fly), [found.trajectory]
        flown = metrics(shown)
        verdict = "stands" if flown.success else f"does not stand ({flown.cause})"
        console.print(f"Flown on {fly}: {verdict}, excursion {flown.excursion:.3f} m.")
    if html is not None:
        shown.to_html(html, ghost=ghosts, windows=found.windows)
        console.print(f"The replay is {bold(html)}.")
    with counter() as tell:
        if figure is not None:
            _drawn("draw_plan", figure, found, shown if ghosts else None, windows)
        if front is not None:
            _drawn("draw_front", front, found, start, kept, tell)
        if sphere is not None:
            _drawn("draw_strays", sphere, found, tell)


def _check_options(what: str | None, fly: str | None, in_c: Path | None) -> None:
    """Raise InputError for a vehicle beside a run file, another plant, or a folder that cannot be written."""
    from flypend import errors
    from flypend.files.staging import check_writable
    from flypend.plants import plant

    if what is not None:
        refuse_idle("vehicle", why=f"beside {what}, which names its own")
    if fly is not None:
        plant(errors.one_of("--fly", fly, ("rotors", "mujoco")))
    if in_c is not None:
        check_writable(in_c)


def _check_files(files: dict[str, tuple[Path | None, tuple[str, ...]]]) -> None:
    """Raise InputError unless all `files`, option → (file, endings), can be written, and none is named twice."""
    from flypend.errors import InputError
    from flypend.files.whole import check_file

    taken: dict[Path, str] = {}
    for option, (file, endings) in files.items():
        if file is None:
            continue
        check_file(file, endings)
        if (other := taken.setdefault(file.absolute(), option)) != option:
            raise InputError(option, f"another file than {other}", str(file))


def _drawn(what: str, path: Path, *drawn: Any) -> None:
    """Draw `what`, a function of `report.plans`, to `path`, and say so."""
    from flypend.report import plans

    getattr(plans, what)(path, *drawn)
    console.print(f"The figure is {bold(path)}.")


def _from(what: str | None, name: str) -> tuple[Vehicle, State]:
    """Return vehicle and start, e₃ up, of the run file `what`; without one, the vehicle `name` with its rod hanging."""
    from flypend import model
    from flypend.settings.runfile import run_file

    if what is None:
        return model.vehicle(name), model.State(y=(0.0, 0.0, -1.0))
    flight = run_file(what).flight
    return flight.vehicle, flight.starts.seen(flight.law.e3)
