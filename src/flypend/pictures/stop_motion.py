"""Stop-motion pictures of a run, gravity pointing down, and their positions on the path."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from flypend import errors, geometry
from flypend.flight.trajectory import Trajectory
from flypend.pages import sketch
from flypend.pages.sketch import project
from flypend.palette import GREEN, GREY, INK, ORANGE, RED
from flypend.pictures import drawing
from flypend.pictures.drawing import TRAIL
from flypend.pictures.style import LABEL, SMALL, Style, decimals, letter, new_figure, style_of, title

PICTURES = 0.726  # fraction of the figure width for the stop-motion pictures


def stop_motion(run: Trajectory, count: int = 12, *, view: str = "side", style: str | Style = "paper") -> Figure:
    """Draw `run` as `count` stop-motion pictures, and their positions on its path; two columns wide.

    The vehicle may travel a hundred metres while a half-metre rod turns over, so the pictures follow the pivot. Each
    shows the path of the bob about the pivot since the previous picture, with the rod at equally spaced times. The
    pictures are taken at equal increments of rotation (`snapshot_times`). Next to them, the path is drawn to scale in
    side view, with the rod enlarged by the stated factor.

    Parameters
    ----------
    run : Trajectory
        A run in either frame; the pictures do not depend on it.
    count : int
        Number of pictures, >= 1. A run of zero length has one.
    view : "side" or "axis"
        Camera of the pictures; see `flypend.pictures.drawing.camera_for`.
    style : "paper", "slides" or Style
        Figure format.

    Raises
    ------
    InputError
        If the view or style is unknown, or the count is below 1.
    """
    form = style_of(style)
    count = int(errors.number("count", count, at_least=1))
    reach = sketch.reach(run.vehicle)
    camera = drawing.camera_for(run, view, distance=drawing.EYE * reach)
    times = snapshot_times(run, count)
    columns = max(int(np.ceil(np.sqrt(form.wide * len(times)))), 3)
    rows = -(-len(times) // columns)
    width, height = 2.3 * reach, 2.55 * reach
    inch = columns * width / (PICTURES * form.full[0])  # m of the drawing per inch of paper
    needed = rows * height / inch + 0.6
    figure = new_figure(form.full[0], form.full[1] if form.fixed else max(2.8, needed), form.dpi)
    path, pictures = figure.subplots(1, 2, width_ratios=(1 - PICTURES, PICTURES))
    pictures.set_axis_off()
    pictures.set(xlim=(0, columns * width), ylim=(-rows * height - 0.4 * inch, 0), aspect="equal", anchor="N")
    for i, t in enumerate(times):
        left, top = i % columns * width, -(i // columns) * height
        middle = (left + 0.5 * width, top - 0.55 * height)
        drawing.draw(pictures, run, camera, middle, t, since=times[max(i - 1, 0)])
        words = {"fontsize": SMALL, "va": "top", "color": INK}
        pictures.text(left + 0.04 * width, top, f"{i + 1}", weight="bold", **words)
        pictures.text(left + 0.96 * width, top, f"{t:.{decimals(run)}f} s", ha="right", **words)
    if run.outcome.status != "completed":
        words["color"] = RED
        pictures.text(left + 0.96 * width, top - 0.14 * inch, run.outcome.status, ha="right", **words)
    _key(pictures, run, view, -rows * height - 0.22 * inch, columns * width)
    _path(path, run, times)
    seen = "seen from above" if view == "axis" else "seen from the side"
    if form.titled:
        pictures.set_title(f"{title(run)}, {seen}", fontsize=LABEL)
    return letter(figure, form)


def snapshot_times(run: Trajectory, count: int) -> Any:
    """`count` times of `run` (s), first and last included, at equal increments of rotation of rod and thrust axis.

    A small part of each increment is plain time, so a vehicle at rest also gets pictures. The rotation rate is capped
    at twice the pendulum frequency, so a rod whirling at the end does not take them all.
    """
    start, end = float(run.t[0]), float(run.t[-1])
    if end <= start or count == 1:
        return np.array([end])
    t = np.linspace(start, end, 2001)
    states = drawing.states_at(run, t)
    turning = geometry.norm(states.y_dot) + np.hypot(states.omega[:, 0], states.omega[:, 1])
    rate = np.minimum(turning, 2 * np.sqrt(max(run.vehicle.gravity, 1.0) / run.vehicle.rod_length))
    rate += 0.1 * np.mean(rate) + 1e-9
    turned = np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2)])
    return np.interp(np.linspace(0.0, turned[-1], count), turned, t)


def _key(ax: Any, run: Trajectory, view: str, level: float, width: float) -> None:
    """Draw the key below the pictures, at height `level`: scale bar of one rod length, gravity, legend."""
    bar, x = run.vehicle.rod_length, 0.02 * width
    ax.plot([x, x + bar], [level, level], color=INK, linewidth=2.0, solid_capstyle="butt")
    ax.text(x + bar + 0.01 * width, level, f"{bar:g} m", fontsize=SMALL, va="center")
    drawing.gravity_symbol(ax, view, (0.285 * width, level), 0.028 * width, fontsize=LABEL)
    front = {"color": ORANGE, "markeredgecolor": INK, "markeredgewidth": 0.6, "marker": "o", "markevery": [1]}
    entries = (
        ("front rotor", {**front, "linestyle": ""}, 0.33),
        ("thrusts, sum in outline", {"color": GREEN, "linewidth": 1.8}, 0.5),
        ("path of the bob", TRAIL, 0.8),
    )
    for words, style, start in entries:
        ax.plot([start * width, (start + 0.035) * width], [level, level], **style)
        ax.text((start + 0.05) * width, level, words, fontsize=SMALL, va="center")


def _path(ax: Any, run: Trajectory, times: Any) -> None:
    """Draw the paths of pivot and bob to scale in side view, with enlarged rods at the times of the pictures."""
    camera = drawing.camera_for(run, "side", elevation=0.0)
    shown = np.unique(np.concatenate([np.linspace(run.t[0], run.t[-1], 1001), times]))
    states = drawing.states_at(run, shown)
    rod = run.vehicle.rod_length
    pivots, bobs = (project(camera, p - states.x[0]) for p in (states.x, states.x + rod * states.y))
    extent = max(np.ptp(pivots, axis=0).max(), 2 * rod)
    factor = max(k for k in (1, 2, 5, 10, 20, 50, 100, 200) if k == 1 or k * rod < 0.07 * extent)
    ax.plot(*bobs.T, color=RED, linewidth=0.7)
    ax.plot(*pivots.T, color=INK, linewidth=1.0)
    at = np.searchsorted(shown, times)
    sticks = np.stack([pivots[at], pivots[at] + factor * (bobs[at] - pivots[at])], axis=1)
    ax.add_collection(LineCollection(list(sticks), color=RED, linewidth=1.2, zorder=3))
    ax.plot(*sticks[:, 1].T, "o", markersize=3, color=RED, markeredgecolor=INK, markeredgewidth=0.4)
    ax.plot(*sticks[:, 0].T, "s", markersize=2.2, color=INK)
    ax.set_aspect("equal", adjustable="datalim")
    ax.margins(0.08)
    _number(ax, sticks[:, 0], np.concatenate([pivots, bobs, *sticks]))
    ax.tick_params(labelsize=SMALL, width=0.6, length=2.5)
    ax.set_xlabel("horizontal travel (m)", fontsize=LABEL)
    ax.set_ylabel("height above the start (m)", fontsize=LABEL)
    ax.set_title("path to scale" + (f", rods × {factor}" if factor > 1 else ""), fontsize=LABEL)


def _number(ax: Any, points: Any, everything: Any) -> None:
    """Number `points` (n, 2) in a legible column to the right of `ax`, which shows `everything` (k, 2)."""
    tall = max(np.ptp(everything[:, 1]), 2.6 * np.ptp(everything[:, 0]))  # the axes are about 2.6 times as tall as wide
    gap = 0.036 * tall
    every = -(-len(points) // 24)  # at most 24 numbers fit
    order = np.argsort(-points[:, 1], kind="stable")[::every]
    heights = points[order, 1]
    for i in range(1, len(heights)):
        heights[i] = min(heights[i], heights[i - 1] - gap)
    heights[-1] = max(heights[-1], (everything[:, 1].min() + everything[:, 1].max() - tall) / 2)
    for i in range(len(heights) - 1, 0, -1):
        heights[i - 1] = max(heights[i - 1], heights[i] + gap)
    line = {"arrowstyle": "-", "color": GREY, "linewidth": 0.4, "shrinkA": 1, "shrinkB": 2}
    style = {"fontsize": SMALL - 1, "va": "center", "xycoords": "data", "textcoords": ax.get_yaxis_transform()}
    for i, height in zip(order, heights, strict=True):
        ax.annotate(f"{i + 1}", points[i], (1.05, height), arrowprops=line, **style)
