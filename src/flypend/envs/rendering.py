"""Pictures of worlds as arrays of pixels, drawn without a display."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from flypend.geometry import E3, Numbers
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.pages.sketch import BOB_SHARE, Camera, depth, magnification, project, reach, sketch
from flypend.palette import PAGE

PIXELS = 480  # sides of a picture; even, as encoders of videos want them
FINER = 2  # drawn so many times larger and then averaged, which smooths edges
WIDE = 1.3  # half the width of a picture over the reach of the drawing: room for what is around the vehicle
EYE = 8.0  # distance of the camera over the reach of the drawing
GRID = 0.5  # m between lines
# The camera looks across e₁, turned by 20° so that no arm hides another, and from 12° above: discs are ellipses.
BEARING, ELEVATION = np.deg2rad(20.0), np.deg2rad(12.0)
ACROSS = np.array([-np.sin(BEARING), np.cos(BEARING), 0.0])
VIEW = {
    "direction": np.cos(ELEVATION) * ACROSS - np.sin(ELEVATION) * E3,
    "up": np.sin(ELEVATION) * ACROSS + np.cos(ELEVATION) * E3,
}
COLORS = PAGE["light"]

MODES = ("rgb_array",)


def picture(vehicle: Vehicle, state: Numbers, goal: Numbers) -> NDArray[np.uint8]:
    """Return a picture (480, 480, 3) of `vehicle` in `state` with rotor forces (24 + n,), e₃ up.

    The camera follows the pivot along a grid of 0.5 m in the vertical plane through the pivot. A thin line leads to
    the `goal` (3,), m, which is a ring if it is in the picture. Arrows are the forces of the rotors.
    """
    side, half = PIXELS * FINER, WIDE * reach(vehicle)
    x = np.asarray(state[:3])
    camera = Camera(centre=x, distance=EYE * reach(vehicle), **VIEW)
    shape = sketch(State.trusted(np.asarray(state[:SIZE])), vehicle, rotor_forces=np.asarray(state[SIZE:]))

    def pixels(points: Any) -> list[tuple[float, float]]:
        flat = side / 2 * (1 + np.asarray(project(camera, points)) / half * (1, -1))
        return [(float(across), float(down)) for across, down in flat.reshape(-1, 2)]

    image = Image.new("RGB", (side, side), COLORS["sky"])
    pen = ImageDraw.Draw(image)

    def line(points: Any, role: str, width: float) -> None:
        pen.line(pixels(points), fill=COLORS[role], width=round(width * FINER), joint="curve")

    def ball(point: Any, radius: float, **style: Any) -> None:
        ((across, down),) = pixels(point)
        r = radius * side / 2 / half
        pen.ellipse((across - r, down - r, across + r, down + r), **style)

    for segment in _grid(x, camera.right, 2 * half):
        line(segment, "line", 1)
    line([x, goal], "reference", 1)
    ball(goal, 0.04 * reach(vehicle), outline=COLORS["reference"], width=2 * FINER)

    def rod() -> None:
        line(shape.rod, "rod", 4)
        ball(shape.bob, BOB_SHARE * vehicle.rod_length * float(magnification(camera, shape.bob)), fill=COLORS["rod"])

    behind = depth(camera, shape.bob) > 0
    if behind:
        rod()
    for disc, front in zip(shape.discs, shape.front, strict=True):
        pen.polygon(pixels(disc), fill=COLORS["front" if front else "rear"], outline=COLORS["body"])
    for arm, force in zip(shape.arms, shape.rotor_thrusts, strict=True):
        line(arm, "body", 3)
        line(force, "thrust", 2)
    if not behind:
        rod()
    return np.array(image.reduce(FINER))


def _grid(x: Numbers, right: Numbers, beyond: float) -> Iterator[Numbers]:
    """Yield lines (2, 3) in the vertical plane through `x` along `right`, as far as `beyond`, m, from it."""
    for along, other in ((right, E3), (E3, right)):
        at = float(x @ along)
        for tick in GRID * np.arange(np.ceil((at - beyond) / GRID), np.floor((at + beyond) / GRID) + 1):
            yield x + (tick - at) * along + np.outer((-beyond, beyond), other)
