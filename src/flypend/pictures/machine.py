"""The drawing of a machine: from above with the gaps for its rod, and from the side on each mount, to scale."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Wedge

from flypend.errors import InputError
from flypend.model.body import MOUNTS
from flypend.model.mount import clearances
from flypend.model.vehicle import Vehicle
from flypend.palette import BLUE, GREEN, GREY, INK, ORANGE, REAR, RED
from flypend.pictures.style import LABEL, PAGE, SMALL, new_figure

LEAN = np.radians(20.0)  # of the rod in the side views
BEARINGS = np.radians(np.arange(0.0, 360.0, 0.5))


def machine_figure(vehicle: Vehicle) -> Figure:
    """Draw `vehicle` to scale.

    Left, from above, front up: discs with their numbers and spins, arms, hub, and green the bearings at which a level
    rod touches nothing on a hub. Right, from the left side, front to the left: the three mounts, that of the vehicle
    in bold. Raises InputError for a vehicle without a body.
    """
    body = vehicle.body
    if body is None:
        raise InputError("vehicle", "disc_radius, to be drawn", f"{vehicle.name} without a body")
    figure = new_figure(PAGE, 3.4)
    grid = figure.add_gridspec(1, 4, width_ratios=(2.1, 1, 1, 1))
    _from_above(figure.add_subplot(grid[0]), vehicle)
    for i, mount in enumerate(MOUNTS):
        _from_the_side(figure.add_subplot(grid[i + 1]), vehicle, mount)
    return figure


def gaps(vehicle: Vehicle) -> list[tuple[float, float]]:
    """Return the sectors of bearings (from front to left, rad) in which a level rod touches neither disc nor arm."""
    level = np.stack([np.cos(BEARINGS), np.sin(BEARINGS), np.zeros_like(BEARINGS)], axis=-1)
    free = (clearances(level, vehicle.rotors_from_pivot, vehicle.reach, vehicle.body) > 0).all(axis=-1)
    if free.all():
        return [(0.0, 2 * np.pi)]
    begins = np.flatnonzero(free & ~np.roll(free, 1))
    lengths = [int(np.argmin(np.roll(free, -b))) for b in begins]
    step = BEARINGS[1]
    return [(float(BEARINGS[b]), float(BEARINGS[b] + (n - 1) * step)) for b, n in zip(begins, lengths, strict=True)]


def _from_above(axes: Any, vehicle: Vehicle) -> None:
    """The plan view: the body's front is up and its left is left, so (x, y) is drawn at (−y, x)."""
    body, centres = vehicle.body, vehicle.rotors_from_pivot
    span, free = 1.15 * _reach(vehicle), gaps(vehicle)
    for low, high in free:
        axes.add_patch(Wedge((0, 0), span, np.degrees(low) + 90, np.degrees(high) + 90, color=GREEN, alpha=0.18, lw=0))
    for i, (x, y, _) in enumerate(centres):
        front = ORANGE if x > 1e-9 else REAR
        axes.plot([0, -y], [0, x], color=INK, lw=2, solid_capstyle="round", zorder=2)
        axes.add_patch(Circle((-y, x), body.disc_radius, facecolor=front, edgecolor=INK, alpha=0.9, lw=0.7, zorder=3))
        turn = "↺" if vehicle.rotor_spins[i] < 0 else "↻"  # the reaction torque is opposite to the turning
        axes.text(-y, x, f"{i + 1} {turn}", ha="center", va="center", fontsize=SMALL, zorder=4)
    axes.add_patch(Circle((0, 0), body.hub_radius, facecolor="white", edgecolor=INK, lw=1, zorder=3))
    axes.annotate("front", (-0.9 * span, 0.97 * span), (-0.9 * span, 0.7 * span), ha="center", fontsize=SMALL,
                  arrowprops={"arrowstyle": "->", "lw": 0.8})  # fmt: skip
    axes.set_title(f"{vehicle.name}, from above", fontsize=LABEL)
    axes.set(xlim=(-span, span), ylim=(-span, span), aspect="equal")
    axes.set_xlabel(_sizes(vehicle, free), fontsize=SMALL)
    axes.set(xticks=[], yticks=[])


def _reach(vehicle: Vehicle) -> float:
    """How far the discs reach from the pivot, m."""
    assert vehicle.body is not None
    return float(np.max(np.linalg.norm(vehicle.rotors_from_pivot[:, :2], axis=1)) + vehicle.body.disc_radius)


def _sizes(vehicle: Vehicle, free: list[tuple[float, float]]) -> str:
    assert vehicle.body is not None
    arm = float(np.linalg.norm(vehicle.rotors_from_pivot[0]))
    sizes = f"arm {100 * arm:.1f} cm, disc ⌀ {200 * vehicle.body.disc_radius:.1f} cm, rod {100 * vehicle.reach:.0f} cm"
    if not free:
        return f"{sizes}\nno gap for a level rod"
    widths = ", ".join(sorted({f"{np.degrees(high - low):.0f}°" for low, high in free}))
    return f"{sizes}\ngaps for a level rod: {len(free)} of {widths}"


def _from_the_side(axes: Any, vehicle: Vehicle, mount: str) -> None:
    """The elevation from the left: front to the left, so (x, z) is drawn at (−x, z); the rod leans backwards."""
    body, centres, reach = vehicle.body, vehicle.rotors_from_pivot, vehicle.reach
    machine = _reach(vehicle)
    rod = np.array([np.sin(LEAN), np.cos(LEAN)])
    for x, _, z in centres:
        axes.plot([0, -x], [0, z], color=INK, lw=1.6)
        axes.plot([-x - body.disc_radius, -x + body.disc_radius], [z, z], color=ORANGE if x > 1e-9 else GREY, lw=2.4)
    begin = 0.0
    if mount == "gimbal":
        begin = 1.15 * machine
        axes.add_patch(Circle((0, 0), begin, fill=False, edgecolor=BLUE, lw=1.2))
    elif mount == "hub":
        axes.plot([0, 0], [0, -reach], color=RED, lw=1.2, ls=(0, (3, 2)), alpha=0.6)
        axes.add_patch(Circle((0, 0), body.hub_radius, facecolor="white", edgecolor=INK, lw=1, zorder=3))
        axes.plot(0, 0, "o", color=BLUE, ms=3, zorder=4)
    else:
        side = 0.4 * reach * np.array([np.sin(body.cup_angle), np.cos(body.cup_angle)])
        axes.plot([-side[0], 0, side[0]], [side[1], 0, side[1]], color=BLUE, lw=0.8, ls="--")
        axes.plot([-side[0] / 5, 0, side[0] / 5], [side[1] / 5, 0, side[1] / 5], color=BLUE, lw=2)
    axes.plot(*np.transpose([begin * rod, reach * rod]), color=RED, lw=2, solid_capstyle="round", zorder=5)
    axes.plot(*(reach * rod), "o", color=RED, ms=4, zorder=5)
    wide = 1.25 * max(machine, reach * np.sin(LEAN))
    axes.set(xlim=(-wide, wide), ylim=(-1.08 * reach, 1.08 * reach), aspect="equal", xticks=[], yticks=[])
    own = mount == vehicle.mount
    axes.set_title(mount, fontsize=LABEL, fontweight="bold" if own else "normal")
    notes = {
        "gimbal": "a ring about it all;\nnothing is in the way",
        "hub": "a ball joint; swings\nthrough a gap",
        "cup": f"stands loosely, to\n{np.degrees(body.cup_angle):.0f}° from the thrust",
    }
    axes.set_xlabel(notes[mount], fontsize=SMALL)
