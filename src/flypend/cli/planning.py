"""The command that plans a flight."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import flypend as fp
from flypend.cli.options import FIGURE, Output, option, options_of, out_option, refuse_idle, vehicle_option
from flypend.cli.terminal import bold, console, counter
from flypend.errors import array, number, one_of
from flypend.files.whole import save_figure

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

CELLS = 10  # of the map, along each side of a hemisphere


@dataclass(frozen=True)
class Kept:
    """How a plan ends and what it keeps: `Constraints`, with a cube about the target for a box, angles in degrees."""

    end: str = option(
        "How it ends: in hover with the rod inverted or hanging, or at the start of a run file.", default="inverted"
    )
    floor: float | None = option("Minimum height of pivot and rod.", metavar="M")
    ceiling: float | None = option("Maximum height of pivot and rod.", metavar="M")
    cube: float | None = option("Side of a cube about the target, in which pivot and rod stay.", metavar="M")
    speed: float | None = option("Maximum speed of the pivot.", metavar="M/S")
    lean: float | None = option("Maximum angle between rod and vertical; 90 keeps it above the horizon.", metavar="DEG")
    window: tuple[tuple[float, ...], ...] = option(
        "Opening to fly through, in a wall normal to the x axis; repeatable.",
        type=float,
        nargs=5,
        multiple=True,
        metavar="X Y Z WIDTH HEIGHT",
    )
    waypoints: tuple[tuple[float, ...], ...] = option(
        "Point that the pivot passes; repeatable, in order.",
        "--waypoint",
        type=float,
        nargs=3,
        multiple=True,
        metavar="X Y Z",
    )
    path: str | None = option("Path of the pivot in time, to fly in the --duration.", metavar="FILE.py:FUNCTION")
    clearance: float | None = option("Distance that rod and machine keep from mount and frames.", metavar="M")
    keep: str | None = option(
        'What must always hold, such as "norm(x) < 1, y[2] > 0"; or file.py:function.', metavar="EXPR"
    )
    cost: str | None = option(
        'Term whose square adds to the cost, such as "x_dot[0]"; or file.py:function.', metavar="EXPR"
    )

    def refuse_other_end(self, *options: str) -> None:
        """Raise InputError for the first of `options` that was given if the flight is not to one place, inverted."""
        if self.path is not None or self.end != "inverted":
            refuse_idle(*options, why=f"beside {'--path' if self.path else f'--end {self.end}'}")

    def state(self, target: ArrayLike) -> fp.State | None:
        """Return the state in which it ends at the `target`, m; None for the end of a path."""
        if self.path is not None:
            refuse_idle("target", "end", why="beside --path, at whose end it hovers")
            return None
        if self.end.endswith(".toml"):
            refuse_idle("target", why=f"beside --end {self.end}, which says where")
            return _from(self.end, "")[1]
        up = one_of("--end", self.end, ("inverted", "hanging")) == "inverted"
        return fp.State(x=array("target", target, (3,)), y=(0.0, 0.0, 1.0 if up else -1.0))

    def constraints(self, target: fp.State | None, duration: float | None, given: Mapping[str, Any]) -> fp.Constraints:
        """Return the constraints of a flight to the `target`, or along a path, that takes the `duration`, s.

        They are those `given`, but for what the options say.
        """
        import numpy as np

        from flypend.planning.problem import end_of
        from flypend.settings.laws import own_from

        path, box = None if self.path is None else own_from(self.path, None, "path", "--path"), None
        if self.cube is not None:
            half = number("--cube", self.cube, above=0, unit="m") / 2
            box = np.add(((-half,) * 3, (half,) * 3), end_of(path, duration, None) if target is None else target.x)
        own = {
            "floor": self.floor, "ceiling": self.ceiling, "speed": self.speed, "clearance": self.clearance,
            "box": box, "path": path,
            "lean": None if self.lean is None else np.radians(self.lean),
            "window": [fp.Window(place[:3], *place[3:]) for place in self.window] or None,
            "waypoints": self.waypoints or None,
            "keep": None if self.keep is None else own_from(self.keep, None, "keep", "--keep"),
            "cost": None if self.cost is None else own_from(self.cost, None, "cost", "--cost"),
        }  # fmt: skip
        return fp.Constraints(**{**given, **{name: value for name, value in own.items() if value is not None}})


@dataclass(frozen=True)
class Outputs:
    """What is made of a plan beside its file."""

    fly: str | None = option("Also fly the plan with feedback: rotors or mujoco.", metavar="PLANT")
    in_c: Path | None = option("Also write the plan with its gains as a table in C.", "--c", type=Output())
    csv: Path | None = option("Also write the plan as a table (.csv).", type=Output(".csv"))
    figure: Path | None = option("Also draw the plan; with --fly, beside its flight.", type=FIGURE)
    front: Path | None = option("Also draw excursion against allowed time.", type=FIGURE)
    sphere: Path | None = option(
        "Also draw how far plans, nmpc and the inverted law stray from rest, over all directions of the rod.",
        "--map",
        type=FIGURE,
    )
    html: Path | None = option("Also write the replay; with --fly, the plan is the ghost.", type=Output(".html"))


@click.command()
@click.argument("what", required=False)
@vehicle_option
@out_option("plan.nc", "Output file (.nc): the plan.", ".nc")
@click.option("--objective", help="What to minimise: excursion (default), effort, time, or cost (--cost alone).")
@click.option("--duration", type=float, help="Time until hover, s; default as long as it takes.")
@click.option("--target", type=float, nargs=3, metavar="X Y Z", help="Where the pivot hovers; default the origin.")
@options_of(Kept, "keep")
@options_of(Outputs, "also")
def plan(
    what: str | None,
    vehicle: str,
    out: Path,
    objective: str | None,
    duration: float | None,
    target: tuple[float, float, float] | None,
    keep: Kept,
    also: Outputs,
) -> None:
    """Plan a flight to hover: from the start in WHAT, a run file, or else from hanging at rest.

    The run file also gives the vehicle and, if its law is "plan", objective, target and constraints, which options
    override. Any other law, and the duration, are ignored. Figures are .png, .pdf or .svg.
    """
    from flypend.plants import plant

    if what is not None:
        refuse_idle("vehicle", why=f"beside {what}, which names its own")
    if also.fly is not None:
        plant(one_of("--fly", also.fly, ("rotors", "mujoco")))
    keep.refuse_other_end("front", *["fly", "in_c"] * (keep.end == "hanging"))
    machine, start, asked = _from(what, vehicle)
    given = {"objective": "excursion", "target": (0.0, 0.0, 0.0), **asked}
    given |= {name: value for name, value in {"objective": objective, "target": target}.items() if value is not None}
    aim, place = given.pop("objective"), given.pop("target")
    end = keep.state(place)
    kept = keep.constraints(end, duration, given)
    found = fp.plan(machine, start, aim, duration=duration, target=end, constraints=kept)
    console.print(f"{machine.name}: {found.summary}", markup=False)
    found.save(out)
    console.print(f"The plan is {bold(out)}.")
    if also.csv is not None:
        found.to_csv(also.csv)
        console.print(f"The table is {bold(also.csv)}.")
    if not found:
        sys.exit(1)
    if also.in_c is not None:
        fp.export_plan(found, also.in_c)
        console.print(f"The table in C is in {bold(also.in_c)}.")
    shown, flown = found.trajectory, None
    if also.fly is not None:
        shown = flown = fp.simulate(machine, fp.track(found), start, found.duration + 2, plant=also.fly)
        judged = fp.metrics(flown)
        verdict = "stands" if judged.success else f"does not stand ({judged.cause})"
        console.print(f"Flown on {also.fly}: {verdict}, excursion {judged.excursion:.3f} m.")
    if also.html is not None:
        shown.to_html(also.html, ghost=[] if flown is None else [found.trajectory], windows=found.windows)
        console.print(f"The replay is {bold(also.html)}.")
    if also.figure or also.front or also.sphere:
        _draw(found, flown, start, kept, also)


def _draw(found: fp.Plan, flown: fp.Trajectory | None, start: fp.State, kept: fp.Constraints, also: Outputs) -> None:
    """Draw the figures of a plan that was `found` from `start` with the constraints `kept`.

    A front shows the inverted law beside the plans, which knows nothing of constraints.
    """
    from flypend.pictures.plans import front_figure, plan_figure, strays_figure
    from flypend.studies.limit import DURATION, front, strays

    def save(figure: Figure, path: Path) -> None:
        save_figure(figure, path)
        console.print(f"The figure is {bold(path)}.")

    with counter() as tell:
        if also.figure is not None:
            save(plan_figure(found, flown, kept.windows), also.figure)
        if also.front is not None:
            plans = front(
                found.vehicle, start, progress=partial(tell, "planning"), target=found.target, constraints=kept
            )
            law = fp.simulate(found.vehicle, fp.laws.inverted(fp.laws.references.hover(found.target)), start, DURATION)
            save(front_figure(plans, law), also.front)
        if also.sphere is not None:
            save(strays_figure(strays(found.vehicle, (fp.laws.inverted(), fp.nmpc()), CELLS, tell=tell)), also.sphere)


def _from(what: str | None, name: str) -> tuple[fp.Vehicle, fp.State, dict[str, Any]]:
    """Return vehicle and start (e₃ up) of the run file `what`, and the arguments of `plan` if its law is "plan".

    Without a run file, the vehicle is `name`, with its rod hanging.
    """
    from flypend.settings.laws import plan_from
    from flypend.settings.runfile import run_file

    if what is None:
        return fp.vehicle(name), fp.State(y=(0.0, 0.0, -1.0)), {}
    flight, settings = run_file(what)
    law = settings["law"]
    arguments = plan_from(law) if law.get("name") == "plan" else {}
    return flight.vehicle, flight.starts.in_frame(flight.law.e3), arguments
