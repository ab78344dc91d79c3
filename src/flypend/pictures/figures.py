"""Figures of one run: the paper's two panels, all quantities over time, and stop-motion pictures.

Each function returns a matplotlib `Figure` that is independent of pyplot; `save_figure` writes it. SI units. Curves are
in the frame of the run; stop-motion pictures show gravity pointing down.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from flypend import geometry
from flypend.files.whole import save_figure
from flypend.flight.trajectory import Trajectory
from flypend.palette import BLUE, GREEN, GREY, INK, PAGE, PINK, RED
from flypend.pictures.descent import lyapunov_curves, lyapunov_label
from flypend.pictures.stop_motion import snapshot_times, stop_motion
from flypend.pictures.style import LABEL, SMALL, Style, decimals, letter, new_figure, rule, style_of, title

__all__ = ["full_figure", "paper_figure", "save_figure", "snapshot_times", "stop_motion"]

COMPONENTS = ((BLUE, "-"), (RED, "--"), (GREEN, "-."))  # vector components; line styles distinguish them in greyscale
ROTORS = (*COMPONENTS, (PINK, (0, (4, 1, 1, 1, 1, 1))))
FAR = 1.6  # limits of the rotors up to this many times the largest force are shown
CUT, KEPT = 10, 4  # a peak of more than ten times the usual is cut off at four times that


def paper_figure(run: Trajectory, *, style: str | Style = "paper") -> Figure:
    """The paper's figure: y₃ and z₃ of `run` over time, in the frame of the run, one column wide.

    `style` is "paper", "slides" or a `Style`. Raises InputError for any other.
    """
    form = style_of(style)
    figure = new_figure(*form.half, form.dpi)
    rows = figure.subplots(2, 1, sharex=True, squeeze=False)
    t, vectors = unit_vectors(run)
    for ax, name in zip(rows[:, 0], "yz", strict=True):
        between_poles(ax, run, name)
        ax.plot(t, vectors[name][:, 2], color=BLUE, **line_style(t))
        ax.set_ylabel(f"${name}_3$ (–)", fontsize=LABEL)
    if form.titled:
        rows[0, 0].set_title(title(run, "\n"), fontsize=LABEL)
    _finish(rows, run)
    return letter(figure, form)


def full_figure(run: Trajectory, *, style: str | Style = "paper") -> Figure:
    """All quantities of `run` over time, two columns wide.

    These are y, z, x and its distance from the reference, thrust, rotor forces with their limits, moment, and the
    Lyapunov functions or, for a law that has none, the rod rate. Slides leave out distance and moment. `style` is
    "paper", "slides" or a `Style`; raises InputError for any other.
    """
    form = style_of(style)
    figure = new_figure(*form.full, form.dpi)
    rows = figure.subplots(len(form.panels) // form.columns, form.columns, sharex=True)
    for ax, name in zip(rows.flat, form.panels, strict=True):
        PANELS[name](ax, run)
        # Above the axes, clear of the curves.
        at = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.1, "borderpad": 0.1}
        narrow = {"fontsize": SMALL, "ncols": 5, "frameon": False, "columnspacing": 0.8, "handlelength": 1.5}
        ax.legend(**narrow, handletextpad=0.4, **at)
    along = "along" if run.e3 == "down" else "against"
    if form.titled:
        figure.suptitle(f"{title(run)}; $e_3$ {along} gravity", fontsize=LABEL + 1)
    _finish(rows, run)
    return letter(figure, form)


def _finish(rows: Any, run: Trajectory) -> None:
    """Style the grid of axes `rows`, label the time axis, and mark the outcome of `run` if it did not complete."""
    end, completed = float(run.t[-1]), run.outcome.status == "completed"
    rule(rows.flat)
    for ax in rows.flat:
        ax.set_xlim(run.t[0], end if completed else max(1.45 * end, 1e-3))
        if not completed:
            ax.axvline(run.outcome.time, color=RED, linewidth=1.2, linestyle=":")
    for ax in rows[-1]:
        ax.set_xlabel("time (s)", fontsize=LABEL)
    if not completed:
        words = f"{run.outcome.status}\nat {run.outcome.time:.{decimals(run)}f} s"
        at = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
        rows[0, 0].annotate(words, (end, 0.5), xytext=(4, 0), color=RED, fontsize=SMALL, va="center", **at)


# Panels: each draws one quantity over time into axes ------------------------------------------------------------------


def unit_vectors(run: Trajectory) -> tuple[Any, dict[str, Any]]:
    """Times, and y and z at those times: the samples, or finer if rod or vehicle turn too fast for them."""
    rate = max(geometry.norm(run.y_dot).max(), geometry.norm(run.omega).max())
    steps = int(min(rate * (run.t[-1] - run.t[0]) / 0.2, 20_000))
    if run.interpolant is None or steps < len(run.t):
        return run.t, {"y": run.y, "z": run.z}
    t = np.linspace(run.t[0], run.t[-1], steps + 1)
    states = run.at(t)
    return t, {"y": states.y, "z": states.z}


def between_poles(ax: Any, run: Trajectory, name: str) -> None:
    """Scale `ax` for components of the unit vector `name` ("y" or "z") of `run`, and label the poles at ±1.

    The body frame flips together with the world frame, so z₃ = 1 is the upright vehicle in either.
    """
    poses = ("upright", "upside down") if name == "z" else ("inverted", "hanging")
    if name == "y" and run.e3 == "down":
        poses = poses[::-1]
    ax.set_ylim(-1.12, 1.12)
    ax.set_yticks([-1, -0.5, 0, 0.5, 1])
    for level, pose in zip((1, -1), poses, strict=True):
        ax.axhline(level, color=GREY, linewidth=0.6)
        ax.text(1.01, level, pose, transform=ax.get_yaxis_transform(), fontsize=SMALL - 1, color=GREY, va="center")


def line_style(t: Any) -> dict[str, Any]:
    """Width of a line over the times `t`, and a marker for a run too short for a line."""
    return {"linewidth": 1.2, "marker": "." if len(t) < 3 else None}


def _unit_vector(ax: Any, run: Trajectory, name: str) -> None:
    t, vectors = unit_vectors(run)
    between_poles(ax, run, name)
    _components(ax, t, name, vectors[name], "–")


def _position(ax: Any, run: Trajectory) -> None:
    _components(ax, run.t, "x", run.x, "m", word="position ")
    for i, (color, _) in enumerate(COMPONENTS):
        label = "reference" if i == 0 else f"_reference {i + 1}"
        ax.plot(run.t, run.x_ref[:, i], color=color, linewidth=0.7, linestyle=(0, (1, 1.5)), label=label, zorder=1.5)


def _distance(ax: Any, run: Trajectory) -> None:
    away = geometry.norm(run.x - run.x_ref)
    ax.plot(run.t, away, color=BLUE, label=r"$\|x-x_{\mathrm{ref}}\|$", **line_style(run.t))
    ax.set_ylabel("distance from ref. (m)", fontsize=LABEL)
    ax.set_ylim(0.0, max(1.06 * away.max(), 0.05))


def _thrust(ax: Any, run: Trajectory) -> None:
    ax.plot(run.t, run.thrust, color=BLUE, label="$f$", **line_style(run.t))
    hover = run.vehicle.weight if run.e3 == "up" else -run.vehicle.weight
    ax.axhline(hover, color=INK, linewidth=0.8, linestyle=":", label="hover")
    ax.set_ylabel("thrust $f$ (N)", fontsize=LABEL)
    _clip_spikes(ax, run.thrust, "N")


def _rotors(ax: Any, run: Trajectory) -> None:
    """Rotor forces; what the rotors cannot give is shaded. In the ideal plant a law may demand it."""
    for k, force in enumerate(run.rotor_forces.T):
        color, style = ROTORS[k % len(ROTORS)]
        ax.plot(run.t, force, color=color, linestyle=style, label=f"$f_{k + 1}$", **line_style(run.t))
    ax.set_ylabel("rotor forces (N)", fontsize=LABEL)
    _clip_spikes(ax, run.rotor_forces, "N")
    low, high = ax.get_ylim()
    least, most = run.vehicle.rotor_limits
    low = min(low, -0.04 * high)
    high = 1.06 * most if most < FAR * high and most > high else high
    shade = {"facecolor": PAGE["light"]["barred"], "edgecolor": "none", "zorder": 0.5}
    for start, end in ((most, high), (low, least)):
        if end > start:
            ax.axhspan(start, end, label="_beyond", **shade)
    for limit in (least, most):
        ax.axhline(
            limit, color=INK, linewidth=0.7, linestyle=(0, (5, 2)), label="limits" if limit == most else "_limit"
        )
    ax.set_ylim(low, high)


def _moment(ax: Any, run: Trajectory) -> None:
    _components(ax, run.t, r"\tau", run.moment, "N m", word="moment ")
    _clip_spikes(ax, run.moment, "N m")


def _signal(ax: Any, run: Trajectory) -> None:
    """V and its terms, in the unit of the law's V where that is known; the rod rate for a law that has none."""
    if "V" in run.signals:
        lyapunov_curves(ax, run)
        ax.set_ylabel(lyapunov_label(run, "Lyapunov function"), fontsize=LABEL)
    else:
        _components(ax, run.t, r"\dot{y}", run.y_dot, "1/s")


def _components(ax: Any, t: Any, name: str, values: Any, unit: str, word: str = "") -> None:
    """Plot the three components of `values` (n, 3) over times `t` (n,), s."""
    for i, (color, style) in enumerate(COMPONENTS):
        ax.plot(t, values[:, i], color=color, linestyle=style, label=f"${name}_{i + 1}$", **line_style(t))
    ax.set_ylabel(f"{word}${name}$ ({unit})", fontsize=LABEL)


def _clip_spikes(ax: Any, values: Any, unit: str) -> None:
    """Clip `ax` if `values` have a spike (as a singular law does at its end), and state the height of the spike."""
    size = np.abs(values)
    usual, peak = np.percentile(size, 95), size.max()
    if peak > CUT * usual > 0:
        ax.set_ylim(-KEPT * usual, KEPT * usual)
        words = f"cut off, peak {peak:.2g} {unit}"
        ax.text(0.02, 0.04, words, transform=ax.transAxes, fontsize=SMALL, color=RED)


PANELS: Mapping[str, Callable[[Any, Trajectory], None]] = {
    "y": lambda ax, run: _unit_vector(ax, run, "y"),
    "z": lambda ax, run: _unit_vector(ax, run, "z"),
    "x": _position,
    "distance": _distance,
    "thrust": _thrust,
    "rotors": _rotors,
    "moment": _moment,
    "signal": _signal,
}
