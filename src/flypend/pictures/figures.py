"""Figures of one run: the paper's two panels, all quantities over time, and stop-motion pictures.

Each function returns a matplotlib `Figure` that is independent of pyplot; `save_figure` writes it. SI units. Curves are
in the frame of the run; stop-motion pictures show gravity pointing down.
"""

from __future__ import annotations

from typing import Any

from matplotlib.figure import Figure

from flypend.files.whole import save_figure
from flypend.flight.trajectory import Trajectory
from flypend.palette import BLUE, RED
from flypend.pictures.canvas import LABEL, SMALL, decimals, new_figure, rule, title
from flypend.pictures.panels import PANELS, between_poles, line_style, unit_vectors
from flypend.pictures.stop_motion import snapshot_times, stop_motion
from flypend.pictures.style import Style, letter, style_of

__all__ = ["full_figure", "paper_figure", "save_figure", "snapshot_times", "stop_motion"]


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
