"""Shared by figures and movies: cameras, interpolated states, and drawing the vehicle into axes.

Both draw the same points (`flypend.pages.sketch`) through the same cameras. Everything here is in the e₃-up frame,
whatever the frame of the run, so gravity points down the screen in every horizontal view (the view "axis" looks along
gravity).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Circle

from flypend import errors, geometry
from flypend.flight.trajectory import Trajectory
from flypend.model import State, Vehicle
from flypend.model.state import project as project_states
from flypend.pages import sketch
from flypend.pages.sketch import BOB_SHARE, Camera, Sketch, depth, magnification, project
from flypend.palette import BLUE, GREEN, INK, ORANGE, REAR, RED

VIEWS = ("side", "axis")

ROD: dict[str, Any] = {"color": RED, "linewidth": 3.0, "solid_capstyle": "round"}
TRAIL: dict[str, Any] = {"color": BLUE, "linewidth": 1.0, "linestyle": (0, (3, 1))}
SUM_STYLE: dict[str, Any] = {"facecolor": "none", "edgecolor": GREEN, "linewidth": 0.8, "zorder": 0.9}
ROTOR_STYLE: dict[str, Any] = {"facecolor": GREEN, "edgecolor": "white", "linewidth": 0.3, "zorder": 3.2}

GHOSTS = 5  # faint rods along the path of the bob
EYE = 8.0  # camera distance over the reach of the drawing
ELEVATION = np.deg2rad(12.0)  # of the side camera: level rotors appear as thin ellipses, not lines


def camera_for(run: Trajectory, view: str, *, elevation: float = ELEVATION, distance: float = np.inf) -> Camera:
    """Return the camera for a `view` of `run`. It looks at the origin; subtract the pivot to follow the vehicle.

    "side" looks horizontally, across the direction in which the rod moves most; gravity points down the screen. "axis"
    is the paper's camera on its −e₃ axis. In the paper e₃ points along gravity, so the camera looks down: gravity
    points into the screen, and a hanging rod appears as a point. `elevation` (rad) is that of the side camera above
    the horizon, `distance` (m) from the origin. Raises InputError if the view is unknown.
    """
    if errors.one_of("view", view, VIEWS) == "axis":
        return Camera(direction=-geometry.E3, up=geometry.E2, distance=distance)
    right = sketch.main_direction(run.states.in_frame(run.e3))
    level = np.cross(geometry.E3, right)
    c, s = np.cos(elevation), np.sin(elevation)
    return Camera(direction=c * level - s * geometry.E3, up=s * level + c * geometry.E3, distance=distance)


def states_at(run: Trajectory, times: Any) -> State:
    """States of `run` at `times` (n,), s, in the e₃-up frame, from dense output or else interpolated between samples.

    Times outside the run are clipped to it. Between samples more than a quarter turn apart, the nearer sample is used.
    """
    times = np.clip(np.atleast_1d(np.asarray(times, dtype=float)), run.t[0], run.t[-1])
    if run.interpolant is not None:
        return run.at(times).in_frame(run.e3)
    last = len(run.t) - 1
    before = np.clip(np.searchsorted(run.t, times, side="right") - 1, 0, max(last - 1, 0))
    after = np.minimum(before + 1, last)
    gap = np.where(after > before, run.t[after] - run.t[before], 1.0)
    share = (times - run.t[before]) / gap
    turned = np.einsum("tij,tij->t", run.R[before], run.R[after]) < 1  # trace(RᵀR′) < 1: more than a quarter turn
    far = turned | (geometry.dot(run.y[before], run.y[after]) < 0)
    share = np.where(far, np.round(share), share)[:, None]
    packed = run.states.packed()
    between = project_states((1 - share) * packed[before] + share * packed[after])[0]
    return State.from_packed(between).in_frame(run.e3)


def sketch_at(run: Trajectory, times: Any, states: State) -> Sketch:
    """Points of the drawing of `run` at `times` (n,), s, where its `states` are known, with the pivot at the origin."""
    sign = 1.0 if run.e3 == "up" else -1.0
    rotors = np.reshape(run.rotor_forces, (len(run.t), -1)).T
    forces = np.stack([np.interp(times, run.t, force) for force in rotors], axis=-1)
    centred = replace(states, x=np.zeros_like(states.x))
    return sketch.sketch(centred, run.vehicle, sign * np.interp(times, run.t, run.thrust), forces)


def draw(ax: Any, run: Trajectory, camera: Camera, middle: Any, t: float, *, since: float) -> None:
    """Draw `run` at time `t` around the point `middle` of `ax`, with the path of its bob and faint rods along it.

    `ax` is in metres; at `middle` (2,) is the pivot, which is at the origin, where `camera` looks. The path begins at
    `since`, s; of a whirling rod it is at most the last turn.
    """

    def screen(points: Any) -> Any:
        return np.add(middle, project(camera, points))

    vehicle = run.vehicle
    rate = max(float(geometry.norm(states_at(run, t).y_dot)[0]), 1e-9)
    states = states_at(run, np.linspace(max(since, t - 2 * np.pi / rate), t, 40 * GHOSTS + 1))
    bobs = vehicle.rod_length * states.y
    shape = sketch_at(run, t, states[-1])
    behind = depth(camera, shape.bob) > 0

    rods = [screen(np.array([shape.pivot, bob])) for bob in bobs[:-1:40]]
    ax.add_collection(LineCollection(rods, color="#c4c4c4", linewidth=0.8, zorder=1))
    ax.plot(*screen(bobs).T, **TRAIL, zorder=1.5)
    for front, color in ((False, REAR), (True, ORANGE)):
        style = {"facecolor": color, "edgecolor": INK, "linewidth": 0.6, "alpha": 0.6, "zorder": 3}
        ax.add_collection(PolyCollection(list(screen(shape.discs[shape.front == front])), **style))
    ax.add_collection(LineCollection(list(screen(shape.arms)), color=INK, linewidth=1.6, zorder=3.1))
    for arrows, form, style in ((shape.thrust[None], SUM, SUM_STYLE), (shape.rotor_thrusts, ROTOR, ROTOR_STYLE)):
        ax.add_collection(PolyCollection(list(middle + outlines(project(camera, arrows), vehicle, form)), **style))
    ax.plot(*screen(shape.rod).T, **ROD, zorder=2 if behind else 4)
    radius = BOB_SHARE * vehicle.rod_length * float(magnification(camera, shape.bob))
    ball = {"facecolor": RED, "edgecolor": INK, "linewidth": 0.7, "zorder": 2.1 if behind else 4.1}
    ax.add_patch(Circle(screen(shape.bob), radius, **ball))


class Form(NamedTuple):
    """An arrow: width of its shaft, length and half width of its head, over the rod length."""

    shaft: float
    head: float
    barb: float


SUM = Form(0.11, 0.2, 0.12)  # wide enough for the rod to stand inside
ROTOR = Form(0.03, 0.12, 0.045)


def outlines(segments: Any, vehicle: Vehicle, form: Form) -> Any:
    """Outlines (n, 7, 2) of arrows along `segments` (n, 2, 2), on the screen; a short one is smaller."""
    along = segments[:, 1] - segments[:, 0]
    length = np.linalg.norm(along, axis=1)[:, None]
    along = along / np.maximum(length, 1e-9)
    side = np.stack([-along[:, 1], along[:, 0]], axis=1)
    size = vehicle.rod_length * np.minimum(1.0, length / (1.2 * form.head * vehicle.rod_length))
    tail, tip = segments[:, 0], segments[:, 1]
    neck, shaft, barb = tip - form.head * size * along, 0.5 * form.shaft * size * side, form.barb * size * side
    return np.stack([tail + shaft, neck + shaft, neck + barb, tip, neck - barb, neck - shaft, tail - shaft], axis=1)


def gravity_symbol(ax: Any, view: str, at: Any, size: float, *, fontsize: float) -> None:
    """Draw the letter g, in `fontsize` pt, with an arrow down the screen, or ⊗ if the `view` is along gravity.

    In the units of `ax`, whose axes are equal, its centre is `at` (2,), and half of the arrow is `size` long.
    """
    x, y = at
    if view == "axis":
        ax.add_patch(Circle((x, y), 0.75 * size, facecolor="white", edgecolor=INK, linewidth=1.2))
        d = 0.75 * size * np.sqrt(0.5)
        for tilt in (-1, 1):
            ax.plot([x - d, x + d], [y - tilt * d, y + tilt * d], color=INK, linewidth=1.2)
    else:
        style = {"arrowstyle": "-|>,head_width=0.18,head_length=0.35", "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", (x, y - size), (x, y + size), arrowprops={**style, "color": INK, "linewidth": 1.2}, zorder=2.0)
    ax.text(x + size, y, "g", fontsize=fontsize, va="center", style="italic")
