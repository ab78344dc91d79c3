"""Figures of one run: the paper's two panels, all quantities over time, and stop-motion pictures.

Each function returns a matplotlib `Figure` that is independent of pyplot; `save_figure` writes it. SI units. Curves are
in the frame of the run; stop-motion pictures show gravity pointing down.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from flypend import geometry
from flypend.files.whole import save_figure
from flypend.flight.trajectory import Trajectory
from flypend.laws.named import THEOREM_1
from flypend.palette import BLUE, GREEN, GREY, INK, RED
from flypend.pictures.canvas import LABEL, SMALL, decimals, new_figure, title
from flypend.pictures.descent import lyapunov_curves
from flypend.pictures.stop_motion import snapshot_times, stop_motion
from flypend.pictures.style import style_named

__all__ = ["full_figure", "paper_figure", "save_figure", "snapshot_times", "stop_motion"]

LYAPUNOV_UNITS = {**dict.fromkeys(THEOREM_1, "1/s²"), "almost_global": "m²/s²"}
COMPONENTS = ((BLUE, "-"), (RED, "--"), (GREEN, "-."))  # vector components; line styles distinguish them in greyscale


def paper_figure(run: Trajectory, *, style: str = "paper") -> Figure:
    """The paper's figure: y₃ and z₃ of `run` over time, in the frame of the run, one column wide.

    `style` is "paper" or "slides". Raises InputError for any other.
    """
    form = style_named(style)
    figure = new_figure(*form.half, form.dpi)
    rows = figure.subplots(2, 1, sharex=True, squeeze=False)
    t, vectors = _unit_vectors(run)
    for ax, name in zip(rows[:, 0], "yz", strict=True):
        _between_poles(ax, run, name)
        ax.plot(t, vectors[name][:, 2], color=BLUE, **_line(t))
        ax.set_ylabel(f"${name}_3$ (–)", fontsize=LABEL)
    rows[0, 0].set_title(title(run, "\n"), fontsize=LABEL)
    _finish(rows, run)
    return figure


def full_figure(run: Trajectory, *, style: str = "paper") -> Figure:
    """All quantities of `run` over time: y, z, x, thrust, moment and the Lyapunov functions, two columns wide.

    If the law has no Lyapunov functions, the rod rate is shown instead. `style` is "paper" or "slides"; raises
    InputError for any other.
    """
    form = style_named(style)
    figure = new_figure(*form.full, form.dpi)
    rows = figure.subplots(6 // form.columns, form.columns, sharex=True)
    panels = rows.ravel()
    t, vectors = _unit_vectors(run)
    for ax, name in zip(panels[:2], "yz", strict=True):
        _between_poles(ax, run, name)
        _components(ax, t, name, vectors[name], "–")
    _components(panels[2], run.t, "x", run.x, "m", word="position ")
    panels[3].plot(run.t, run.thrust, color=BLUE, label="$f$", **_line(run.t))
    hover = run.vehicle.weight if run.e3 == "up" else -run.vehicle.weight
    panels[3].axhline(hover, color=INK, linewidth=0.8, linestyle=":", label="hover")
    panels[3].set_ylabel("thrust $f$ (N)", fontsize=LABEL)
    _components(panels[4], run.t, r"\tau", run.moment, "N m", word="moment ")
    if "V" in run.signals:
        _lyapunov(panels[5], run)
    else:
        _components(panels[5], run.t, r"\dot{y}", run.y_dot, "1/s")
    _clip_spikes(panels[3], run.thrust, "N")
    _clip_spikes(panels[4], run.moment, "N m")
    for ax in panels:  # above the axes, clear of the curves
        at = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.1, "borderpad": 0.1}
        ax.legend(fontsize=SMALL, ncols=3, frameon=False, columnspacing=1.2, **at)
    along = "along" if run.e3 == "down" else "against"
    figure.suptitle(f"{title(run)}; $e_3$ {along} gravity", fontsize=LABEL + 1)
    _finish(rows, run)
    return figure


def _between_poles(ax: Any, run: Trajectory, name: str) -> None:
    """Scale `ax` for components of the unit vector `name` ("y" or "z") of `run`, and label the poses at ±1.

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


def _unit_vectors(run: Trajectory) -> tuple[Any, dict[str, Any]]:
    """Times, and y and z at those times: the samples, or finer if rod or vehicle turn too fast for them."""
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
    """Plot V and its terms, in the unit of the law's V where that is known."""
    lyapunov_curves(ax, run)
    unit = LYAPUNOV_UNITS.get(run.law, "")
    ax.set_ylabel(f"Lyapunov function{unit and f' ({unit})'}", fontsize=LABEL)


def _clip_spikes(ax: Any, values: Any, unit: str) -> None:
    """Clip `ax` if `values` have a spike (as a singular law does at its end), and state the height of the spike."""
    size = np.abs(values)
    usual, peak = np.percentile(size, 95), size.max()
    if peak > 10 * usual > 0:
        ax.set_ylim(-4 * usual, 4 * usual)
        words = f"off the scale: {peak:.2g} {unit}"
        ax.text(0.02, 0.04, words, transform=ax.transAxes, fontsize=SMALL, color=RED)


def _finish(rows: Any, run: Trajectory) -> None:
    """Style the grid of axes `rows`, label the time axis, and mark the outcome of `run` if it did not complete."""
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
        words = f"{run.outcome.status}\nat {run.outcome.time:.{decimals(run)}f} s"
        at = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
        rows[0, 0].annotate(words, (end, 0.5), xytext=(4, 0), color=RED, fontsize=SMALL, va="center", **at)
