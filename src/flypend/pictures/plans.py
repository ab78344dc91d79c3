"""Figures of plans: a plan and its flight, excursion against allowed time, and excursion over the sphere of the rod."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from flypend.flight.metrics import metrics
from flypend.flight.trajectory import Trajectory
from flypend.geometry import norm
from flypend.palette import BLUE, GREEN, GREY, INK, RED, SERIES
from flypend.pictures.maps import hemisphere
from flypend.pictures.style import LABEL, PAGE, SMALL, distribution, new_figure, plain, rule
from flypend.planning.result import Plan
from flypend.planning.window import Window
from flypend.studies.limit import Front, Strays
from flypend.studies.sweep.bins import EDGE

POSES = 22  # of a rod along its path
# A legend above the axes, clear of the curves.
ABOVE = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "ncols": 2, "fontsize": SMALL, "frameon": False}
WALL = 1.5  # of the height of an opening: what is drawn of its wall on either side


def plan_figure(plan: Plan, flown: Trajectory | None = None, windows: Sequence[Window] = ()) -> Figure:
    """Draw a `plan` from the side, and over time its distance, lean and rotor forces beside those of the run `flown`.

    The view is level, across the way from start to target, or along e₂ where that is vertical; poses are equally far
    apart in time. `windows` are drawn where they cross the middle of the view.
    """
    figure = new_figure(PAGE, 3.4)
    grid = figure.add_gridspec(3, 2, width_ratios=(1.1, 1))
    _side(figure.add_subplot(grid[:, 0]), plan, flown, windows)
    distance, lean, forces = (figure.add_subplot(grid[i, 1]) for i in range(3))
    runs = [(plan.trajectory, "plan", {"color": BLUE, "lw": 1.2})]
    if flown is not None:
        runs.append((flown, "flown", {"color": RED, "lw": 0.9, "ls": "--"}))
    for run, label, style in runs:
        distance.plot(run.t, norm(run.x - plan.target), label=label, **style)
        lean.plot(run.t, np.degrees(np.arccos(np.clip(run.y[:, 2], -1, 1))), **style)
        forces.plot(run.t, run.rotor_forces, **(style | {"lw": 0.6}))
    for limit in plan.vehicle.rotor_limits:
        forces.axhline(limit, color=GREY, lw=0.7, ls=":")
    distance.set(ylabel="distance (m)", ylim=(0, None))
    distance.legend(**ABOVE)
    lean.set(ylabel="rod lean (°)", ylim=(0, None))
    forces.set(ylabel="rotor forces (N)", xlabel="$t$ (s)")
    rule(figure.axes)
    return figure


def _side(axes: Any, plan: Plan, flown: Trajectory | None, windows: Sequence[Window]) -> None:
    """Draw rods and pivot in the vertical plane of the flight."""
    way = (plan.x[0] - plan.target) * (1, 1, 0)
    across = -way / norm(way) if norm(way) > plan.vehicle.l / 10 else np.array([1.0, 0.0, 0.0])
    view = np.array([across, (0.0, 0.0, 1.0)]).T
    tips = plan.x + plan.vehicle.reach * plan.y
    for k in np.unique(np.linspace(0, len(plan.t) - 1, POSES).astype(int)):
        shade = 0.25 + 0.75 * k / (len(plan.t) - 1)
        arm = 0.5 * plan.vehicle.l * plan.R[k] @ (np.eye(3)[:, :2] @ (plan.R[k].T @ across)[:2])
        for ends, color, width in (((plan.x[k], tips[k]), RED, 1.0), ((plan.x[k] - arm, plan.x[k] + arm), INK, 0.8)):
            axes.plot(*(np.array(ends) @ view).T, color=color, lw=width, alpha=shade)
    axes.plot(*(plan.x @ view).T, color=BLUE, lw=1.0, label="pivot")
    if flown is not None:
        axes.plot(*(flown.x @ view).T, color=GREEN, lw=0.8, ls="--", label="pivot, flown")
    for window in windows:
        along = window.axes[np.argmax(np.abs(window.axes[:2, 2]))]  # nearer to the vertical
        half = window.halves[np.argmax(np.abs(window.axes[:2, 2]))]
        for side in (-1, 1):
            ends = window.centre + side * np.outer((half, half + WALL * 2 * half), along)
            axes.plot(*(ends @ view).T, color=INK, lw=2.5, solid_capstyle="butt")
    axes.set(xlabel="along the way (m)", ylabel="height (m)", aspect="equal")
    axes.legend(**ABOVE)


def front_figure(front: Front, law: Trajectory | None = None) -> Figure:
    """Draw the excursion of the plans of a `front` against the time that they may take, and the run of a `law`."""
    figure = new_figure(PAGE / 2, 2.6)
    axes = figure.subplots()
    good = np.isfinite(front.excursion)
    axes.plot(front.durations[good], front.excursion[good], "o-", color=BLUE, ms=3.5, lw=1.2, label="plans")
    if np.any(good):
        axes.axvline(front.durations[good][0], color=GREY, lw=0.8, ls="--")
    if law is not None:
        judged = metrics(law)
        if judged.success:
            axes.plot(judged.settling, judged.excursion, "D", color=RED, ms=5, label=f"{law.law} law, settled")
    axes.set(xlabel="time until hover (s)", ylabel="excursion (m)", yscale="log")
    plain(axes.yaxis, 1.0, 3.0)
    axes.legend(fontsize=SMALL, frameon=False)
    rule([axes])
    return figure


def strays_figure(strays: Strays) -> Figure:
    """Draw the excursion of laws and plans over both hemispheres, how it is distributed, and what the plans cost."""
    rows = {**strays.by_law, "plan": strays.plans.excursion}
    figure = new_figure(PAGE, 0.3 + 1.95 * len(rows))
    grid = figure.add_gridspec(2 * len(rows), 3, width_ratios=(1, 1, 1.25))
    finite = np.concatenate([values[np.isfinite(values)] for values in rows.values()])
    scale = LogNorm(np.min(finite), np.max(finite))
    edges, discs = np.linspace(-EDGE, EDGE, strays.cells + 1), []
    for row, (name, values) in enumerate(rows.items()):
        for part in (0, 1):
            axes = figure.add_subplot(grid[2 * row : 2 * row + 2, part])
            hemisphere(axes, part)
            image = axes.pcolormesh(edges, edges, strays.disc(values, part), norm=scale, cmap="viridis", zorder=0.5)
            image.set_clip_path(Circle((0, 0), EDGE, transform=axes.transData))
            axes.set_title(name, fontsize=LABEL)
            discs.append(axes)
    bar = figure.colorbar(image, ax=discs, orientation="horizontal", shrink=0.8, aspect=40)
    bar.set_label("excursion (m)", fontsize=LABEL)
    plain(bar.ax.xaxis, 1.0, 3.0)
    bar.ax.tick_params(labelsize=SMALL)
    far, spent = figure.add_subplot(grid[: len(rows), 2]), figure.add_subplot(grid[len(rows) :, 2])
    for i, (name, values) in enumerate(rows.items()):
        distribution(far, values[np.isfinite(values)], len(values), color=SERIES[i], lw=1.2, label=name)
    times = strays.plans.solve_time
    distribution(spent, 1e3 * times[np.isfinite(times)], len(times), color=SERIES[len(rows) - 1], lw=1.2)
    far.set(xlabel="excursion (m)", ylabel="starts within (%)", xscale="log")
    plain(far.xaxis, 1.0, 3.0)
    far.legend(fontsize=SMALL, frameon=False)
    spent.set(xlabel="processor time of a plan (ms)", ylabel="plans within (%)")
    rule([far, spent])
    return figure
