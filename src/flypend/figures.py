"""Figures of one run: the paper's two panels, everything over time, and the motion in stop-motion pictures.

Each returns a matplotlib `Figure` that no window and no pyplot state knows of; `save_figure` writes it. SI units. The
curves are in the frame of the run, the pictures show gravity pointing down.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from uuid import uuid4

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from flypend import drawing, errors, geometry
from flypend.drawing import BLUE, GREEN, GREY, INK, ORANGE, RED, THRUST, TRAIL
from flypend.trajectory import Trajectory

COLUMN, PAGE = 3.4, 7.16  # widths of one and of two columns of a paper, in
PICTURES = 5.2  # width of the stop-motion pictures on the page, in
LABEL, SMALL = 8.0, 7.0  # font sizes, pt
COMPONENTS = ((BLUE, "-"), (RED, "--"), (GREEN, "-."))  # of a vector; the line style tells them apart in grey


def paper_figure(run: Trajectory) -> Figure:
    """The paper's figure: y₃ and z₃ of `run` against time, in the frame of the run, one column wide."""
    figure = _new_figure(COLUMN, 3.3)
    rows = figure.subplots(2, 1, sharex=True, squeeze=False)
    t, vectors = _unit_vectors(run)
    for ax, name in zip(rows[:, 0], "yz", strict=True):
        _between_poles(ax, run, name)
        ax.plot(t, vectors[name][:, 2], color=BLUE, **_line(t))
        ax.set_ylabel(f"${name}_3$ (–)", fontsize=LABEL)
    rows[0, 0].set_title(_title(run, "\n"), fontsize=LABEL)
    _finish(rows, run)
    return figure


def full_figure(run: Trajectory) -> Figure:
    """Every quantity of `run` against time: y, z, x, thrust, moment and the Lyapunov functions, two columns wide.

    A run of a law without Lyapunov functions shows the rate of the rod in their place.
    """
    figure = _new_figure(PAGE, 6.4)
    rows = figure.subplots(3, 2, sharex=True)
    t, vectors = _unit_vectors(run)
    for ax, name in zip(rows[0], "yz", strict=True):
        _between_poles(ax, run, name)
        _components(ax, t, name, vectors[name], "–")
    _components(rows[1, 0], run.t, "x", run.x, "m", word="position ")
    rows[1, 1].plot(run.t, run.thrust, color=BLUE, label="$f$", **_line(run.t))
    hover = run.vehicle.weight if run.e3 == "up" else -run.vehicle.weight
    rows[1, 1].axhline(hover, color=INK, linewidth=0.8, linestyle=":", label="hover")
    rows[1, 1].set_ylabel("thrust $f$ (N)", fontsize=LABEL)
    _components(rows[2, 0], run.t, r"\tau", run.moment, "N m", word="moment ")
    if "V" in run.signals:
        _lyapunov(rows[2, 1], run)
    else:
        _components(rows[2, 1], run.t, r"\dot{y}", run.y_dot, "1/s")
    _mind_spikes(rows[1, 1], run.thrust, "N")
    _mind_spikes(rows[2, 0], run.moment, "N m")
    for ax in rows.flat:  # above the axes, where no curve can run into it
        at = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.1, "borderpad": 0.1}
        ax.legend(fontsize=SMALL, ncols=3, frameon=False, columnspacing=1.2, **at)
    along = "along" if run.e3 == "down" else "against"
    figure.suptitle(f"{_title(run)}; $e_3$ {along} gravity", fontsize=LABEL + 1)
    _finish(rows, run)
    return figure


def stop_motion(run: Trajectory, count: int = 12, *, view: str = "side") -> Figure:
    """The motion of `run` in `count` pictures, and where on its path each was taken; two columns wide.

    The vehicle may travel a hundred metres while a rod of half a metre turns over. So the pictures follow the pivot;
    each shows the path of the bob about the pivot since the one before, with the rod at equal times in between. They
    are taken at equal increments of turning (`snapshot_times`). The path is drawn to scale beside them, seen from the
    side, with the rod enlarged by the factor stated.

    Parameters
    ----------
    run : Trajectory
        In either frame; the pictures are the same.
    count : int
        Number of pictures, >= 1. A run that ends where it starts has one.
    view : "side" or "axis"
        Camera of the pictures, see `flypend.drawing.camera_for`.

    Raises
    ------
    InputError
        For an unknown view or a count below 1.
    """
    count = int(errors.number("count", count, at_least=1))
    reach = drawing.reach(run.vehicle)
    camera = drawing.camera_for(run, view, distance=drawing.EYE * reach)
    times = snapshot_times(run, count)
    columns = max(int(np.ceil(np.sqrt(4 / 3 * len(times)))), 3)
    rows = -(-len(times) // columns)
    width, height = 2.3 * reach, 2.55 * reach
    inch = columns * width / PICTURES  # metres of the pictures per inch of paper
    figure = _new_figure(PAGE, max(2.8, rows * height / inch + 0.6))
    path, pictures = figure.subplots(1, 2, width_ratios=(PAGE - PICTURES, PICTURES))
    pictures.set_axis_off()
    pictures.set(xlim=(0, columns * width), ylim=(-rows * height - 0.4 * inch, 0), aspect="equal", anchor="N")
    for i, t in enumerate(times):
        left, top = i % columns * width, -(i // columns) * height
        middle = (left + 0.5 * width, top - 0.55 * height)
        drawing.draw(pictures, run, camera, middle, t, since=times[max(i - 1, 0)])
        words = {"fontsize": SMALL, "va": "top", "color": INK}
        pictures.text(left + 0.04 * width, top, f"{i + 1}", weight="bold", **words)
        pictures.text(left + 0.96 * width, top, f"{t:.{_decimals(run)}f} s", ha="right", **words)
    if run.outcome.status != "completed":
        words["color"] = RED
        pictures.text(left + 0.96 * width, top - 0.14 * inch, run.outcome.status, ha="right", **words)
    _key(pictures, run, view, -rows * height - 0.22 * inch, columns * width)
    _path(path, run, times)
    seen = "seen from above" if view == "axis" else "seen from the side"
    pictures.set_title(f"{_title(run)}, {seen}", fontsize=LABEL)
    return figure


def snapshot_times(run: Trajectory, count: int) -> Any:
    """`count` instants of `run` (s), first and last included, at equal increments of turning of rod and thrust axis.

    A tenth of the increments is plain time, so that a vehicle at rest is seen as well, and turning faster than twice
    the frequency of the pendulum counts no more than that, so that a rod whirling at the end does not take all.
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


def save_figure(figure: Figure, path: str | Path) -> None:
    """Write `figure` to `path` (.png at 200 dots per inch, .pdf or .svg), whole or not at all.

    Raises InputError for another suffix or a file that cannot be written.
    """
    with whole_file(path, (".png", ".pdf", ".svg")) as partial:
        # Type 42 keeps text in a PDF as text, which publishers ask for; no dates, so equal figures are equal files.
        metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(partial.suffix.lower())
        with mpl.rc_context({"pdf.fonttype": 42, "svg.hashsalt": "flypend"}):
            figure.savefig(partial, dpi=200, metadata=metadata)


@contextmanager
def whole_file(path: str | Path, suffixes: Sequence[str]) -> Iterator[Path]:
    """Yield a name beside `path` to write to; what is there when the block ends becomes `path`, else it is removed.

    Raises InputError if `path` ends in none of `suffixes` or cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() not in suffixes:
        raise errors.InputError("path", "a file name ending in " + " or ".join(suffixes), str(path))
    partial = path.with_name(f".{uuid4().hex}{path.suffix}")
    try:
        if path.is_dir():
            raise errors.InputError(str(path), "a file that can be written", "a folder")
        partial.touch(exist_ok=False)
        yield partial
        partial.replace(path)
    except OSError as error:
        raise errors.InputError(str(path), "a file that can be written", error.strerror or error) from None
    finally:
        partial.unlink(missing_ok=True)


def _new_figure(width: float, height: float) -> Figure:
    """An empty figure of `width` × `height` inches on the Agg canvas, known to no pyplot state."""
    figure = Figure(figsize=(width, height), dpi=150, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def _title(run: Trajectory, between: str = ", ") -> str:
    """Law, its options and its gains."""
    options = [f"{name} {value}" for name, value in run.gains.items() if isinstance(value, str)]
    gains = [f"${name}$ = {value:g}" for name, value in run.gains.items() if name.startswith("k_")]
    return between.join(filter(None, [", ".join([f"{run.law} law", *options]), ", ".join(gains)]))


def _decimals(run: Trajectory) -> int:
    """Digits after the point that tell the instants of `run` apart."""
    return int(np.clip(2 - np.floor(np.log10(run.t[-1])), 2, 6)) if run.t[-1] > 0 else 2


def _between_poles(ax: Any, run: Trajectory, name: str) -> None:
    """Scale `ax` for components of the unit vector `name` ("y" or "z") of `run`, and name the poses at ±1.

    The body frame turns over with the world frame, so z₃ = 1 is the upright vehicle in both.
    """
    poses = ("upright", "upside down") if name == "z" else ("inverted", "hanging")
    if name == "y" and run.e3 == "down":
        poses = poses[::-1]
    ax.set_ylim(-1.12, 1.12)
    ax.set_yticks([-1, -0.5, 0, 0.5, 1])
    for level, pose in zip((1, -1), poses, strict=True):
        ax.axhline(level, color=GREY, linewidth=0.6)
        ax.text(1.01, level, pose, transform=ax.get_yaxis_transform(), fontsize=SMALL - 1, color=GREY, va="center")


def _unit_vectors(run: Trajectory) -> tuple[Any, dict[str, Any]]:
    """Times, and y and z at them: the samples, or more if the rod or the vehicle turns too fast for these."""
    rate = max(geometry.norm(run.y_dot).max(), geometry.norm(run.omega).max())
    steps = int(min(rate * (run.t[-1] - run.t[0]) / 0.2, 20_000))
    if run.interpolant is None or steps < len(run.t):
        return run.t, {"y": run.y, "z": run.z}
    t = np.linspace(run.t[0], run.t[-1], steps + 1)
    states = run.at(t)
    return t, {"y": states.y, "z": states.z}


def _line(t: Any) -> dict[str, Any]:
    return {"linewidth": 1.2, "marker": "." if len(t) < 3 else None}


def _components(ax: Any, t: Any, name: str, values: Any, unit: str, word: str = "") -> None:
    for i, (color, style) in enumerate(COMPONENTS):
        ax.plot(t, values[:, i], color=color, linestyle=style, label=f"${name}_{i + 1}$", **_line(t))
    ax.set_ylabel(f"{word}${name}$ ({unit})", fontsize=LABEL)


def _lyapunov(ax: Any, run: Trajectory) -> None:
    """V and its terms V_1, V_2, ... on a logarithmic axis that leaves out what is zero to rounding."""
    terms = [name for name in run.signals if name.startswith("V_") and name[2:].isdigit()]
    styles = ((INK, "-"), (RED, "--"), (GREEN, "-."), (BLUE, ":"))
    for name, (color, style) in zip(["V", *terms], styles, strict=False):
        label = "$V = " + " + ".join(terms) + "$" if name == "V" and terms else f"${name}$"
        values = np.where(run.signals[name] > 0, run.signals[name], np.nan)
        ax.plot(run.t, values, color=color, linestyle=style, label=label, **_line(run.t))
    ax.set_yscale("log")
    ax.set_ylim(bottom=max(ax.get_ylim()[0], 1e-8 * np.nanmax(run.signals["V"], initial=1e-8)))
    ax.set_ylabel("Lyapunov function (1/s²)", fontsize=LABEL)


def _mind_spikes(ax: Any, values: Any, unit: str) -> None:
    """Keep a spike of `values` (a singular law ends in one) from flattening the curves of `ax`, and name its height."""
    size = np.abs(values)
    usual, peak = np.percentile(size, 95), size.max()
    if peak > 10 * usual > 0:
        ax.set_ylim(-4 * usual, 4 * usual)
        words = f"off the scale: {peak:.2g} {unit}"
        ax.text(0.02, 0.04, words, transform=ax.transAxes, fontsize=SMALL, color=RED)


def _finish(rows: Any, run: Trajectory) -> None:
    """Style the grid of axes `rows`, label their common time axis, and mark how `run` ended if it did not complete."""
    end, completed = float(run.t[-1]), run.outcome.status == "completed"
    for ax in rows.flat:
        ax.set_xlim(run.t[0], end if completed else max(1.45 * end, 1e-3))
        ax.tick_params(which="both", labelsize=SMALL, width=0.6, length=2.5)
        ax.grid(visible=True, color="#e3e3e3", linewidth=0.5)
        ax.set_axisbelow(True)
        if not completed:
            ax.axvline(run.outcome.time, color=RED, linewidth=1.2, linestyle=":")
    for ax in rows[-1]:
        ax.set_xlabel("time (s)", fontsize=LABEL)
    if not completed:
        words = f"{run.outcome.status}\nat {run.outcome.time:.{_decimals(run)}f} s"
        at = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
        rows[0, 0].annotate(words, (end, 0.5), xytext=(4, 0), color=RED, fontsize=SMALL, va="center", **at)


def _key(ax: Any, run: Trajectory, view: str, level: float, width: float) -> None:
    """Below the pictures, at height `level`: scale bar of the length of the rod, gravity, what the lines mean."""
    bar, x = run.vehicle.rod_length, 0.02 * width
    ax.plot([x, x + bar], [level, level], color=INK, linewidth=2.0, solid_capstyle="butt")
    ax.text(x + bar + 0.01 * width, level, f"{bar:g} m", fontsize=SMALL, va="center")
    drawing.gravity_symbol(ax, view, (0.285 * width, level), 0.028 * width, fontsize=LABEL)
    front = {"color": ORANGE, "markeredgecolor": INK, "markeredgewidth": 0.6, "marker": "o", "markevery": [1]}
    entries = (
        ("front rotor", {**front, "linestyle": ""}, 0.35),
        ("thrust", THRUST, 0.53),
        ("bob since the last picture", TRAIL, 0.665),
    )
    for words, style, start in entries:
        ax.plot([start * width, (start + 0.035) * width], [level, level], **style)
        ax.text((start + 0.05) * width, level, words, fontsize=SMALL, va="center")


def _path(ax: Any, run: Trajectory, times: Any) -> None:
    """Paths of pivot and bob from the side, to scale, with the instants of the pictures and the rods enlarged."""
    camera = drawing.camera_for(run, "side", elevation=0.0)
    shown = np.unique(np.concatenate([np.linspace(run.t[0], run.t[-1], 1001), times]))
    states = drawing.states_at(run, shown)
    rod = run.vehicle.rod_length
    pivots, bobs = (drawing.project(camera, p - states.x[0]) for p in (states.x, states.x + rod * states.y))
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
    """Number `points` (n, 2) in a column right of `ax`, which shows `everything` (k, 2), apart enough to be read."""
    tall = max(np.ptp(everything[:, 1]), 2.6 * np.ptp(everything[:, 0]))  # the axes are about 2.6 times as high as wide
    gap = 0.036 * tall
    every = -(-len(points) // 24)  # more numbers than this find no place
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
