"""Maps of a store of runs: outcomes by initial rod direction on the sphere, and in a plane of two quantities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import ListedColormap, LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Patch
from matplotlib.ticker import MultipleLocator

from flypend import palette
from flypend.errors import InputError
from flypend.palette import INK
from flypend.pictures.style import LABEL, PAGE, SMALL, new_figure, symbol
from flypend.studies.sweep.bins import EDGE, Cells, Runs, check_plane, default_plane, label, plane, side, sphere
from flypend.studies.sweep.chunk import CAUSES
from flypend.studies.sweep.tally import Tally

FAILED = [palette.CAUSES[name] for name in CAUSES[1:]]  # success is white
EMPTY = "#e4e4e4"
# Cells with a wider confidence interval are hatched.
WIDE = 0.2
RINGS = (30, 60)
DEGREES = 45  # between the ticks of an angle
HATCH = "//////"


@dataclass(frozen=True, eq=False)
class _Panel:
    """One panel: its title, its cells and their edges, and the hemisphere if it is a disc."""

    name: str
    cells: Cells
    edges: tuple[Any, Any]
    part: int | None = None  # hemisphere

    def square(self, values: Any) -> Any:
        """Reshape values of the cells (n,) to rows and columns."""
        shape = (len(self.edges[1]) - 1, len(self.edges[0]) - 1)
        size = shape[0] * shape[1]
        return values[(self.part or 0) * size :][:size].reshape(shape)


def map_figure(store: str | Path, *, x: str | None = None, y: str | None = None, cells: int | None = None) -> Figure:
    """Draw success, settling time, excursion and causes of failure of the runs of a store, one row each.

    If the study varies the initial rod direction, its sphere is shown as two hemispheres in Lambert's equal-area
    projection; a plane of two quantities comes last. Cells without runs are grey. In the success row, cells whose
    Wilson interval (95 %), in which every start counts once, is wider than 20 % are hatched.

    Parameters
    ----------
    store : path
        Store written by `sweep`, possibly unfinished. It is read chunk by chunk.
    x, y : str, optional
        Axes of the plane: tilt, rate, spin, speed, body_tilt, or any quantity that the study varies; default: tilt and
        rate.
    cells : int, optional
        Number of cells per side; default: from the number of runs.

    Raises
    ------
    InputError
        If the store has no runs or lacks a quantity.
    """
    runs = Runs(store)
    tally = Tally(runs.study)
    panels, names = _panels(runs, x, y, cells, tally)
    figure = new_figure(PAGE if len(panels) > 1 else 0.6 * PAGE, 9.2)
    figure.suptitle(_headline(tally), fontsize=LABEL + 1)
    rows = figure.subplots(4, len(panels), squeeze=False, width_ratios=[1] * (len(panels) - 1) + [1.15])
    total = panels[-1].cells
    _row(figure, rows[0], panels, "success rate (%)", lambda c: 100 * c.rate, "cividis", _rates(panels))
    for axis, panel in zip(rows[0], panels, strict=True):
        _hatch(axis, panel)
        axis.set_title(panel.name, fontsize=LABEL)
    _row(figure, rows[1], panels, "mean settling time (s)", lambda c: c.settling, "viridis", None)
    _row(figure, rows[2], panels, "mean excursion (m)", lambda c: c.excursion, "viridis", None)
    _causes(figure, rows[3], panels, total)
    for place, row in enumerate(rows):
        for axis, panel in zip(row, panels, strict=True):
            _frame(axis, panel, names, last=place == len(rows) - 1)
    return figure


def _panels(
    runs: Runs, x: str | None, y: str | None, cells: int | None, tally: Tally
) -> tuple[list[_Panel], tuple[str, str] | None]:
    """The panels, gathered in one pass over the store, and the quantities of the plane; `tally` gets all runs."""
    check_plane(runs.study, x, y)
    names = (x, y) if x and y else default_plane(runs)
    grids = []
    per_side = cells or side(runs.number, 2)
    if "y" in runs.names and not {"tilt", "azimuth"} & set(runs.names):
        grids.append(sphere(runs.study, per_side))
    edges = None
    if names is not None:
        grid, edges = plane(runs, names, cells or side(runs.number))
        grids.append(grid)
    if not grids:
        raise InputError("store", "a study in which two quantities vary", "fewer")
    gathered = runs.gather(grids, tally)
    panels = []
    if len(grids[0].shape) == 3:
        line = np.linspace(-EDGE, EDGE, per_side + 1)
        titles = ("rod above the horizon", "rod below the horizon")
        panels = [_Panel(title, gathered[0], (line, line), part) for part, title in enumerate(titles)]
    if edges is not None:
        panels.append(_Panel("all runs", gathered[-1], edges))
    return panels, names


def _headline(tally: Tally) -> str:
    """Title: law, vehicle, plant, duration, and the success rate with its interval."""
    study = tally.study
    plant = study.settings["plant"]
    plant = plant if isinstance(plant, str) else plant.get("base", "sampled plant")
    size = f"{tally.runs:,}".replace(",", "\u202f")
    return (
        f"{study.law.name} law on {study.flight.vehicle.name}, plant {plant}, {study.flight.duration:g} s\n"
        f"{100 * tally.rate:.4g} % of {size} runs succeed ({tally.describe_interval()})"
    )


def _row(
    figure: Figure, axes: Any, panels: Sequence[_Panel], words: str, of: Any, colours: str, norm: Normalize | None
) -> None:
    """Draw one quantity in every panel, on a common colour scale."""
    norm = norm or _scale([of(panel.cells) for panel in panels])
    values = [np.ma.masked_invalid(panel.square(of(panel.cells))) for panel in panels]
    _mesh(figure, axes, panels, words, values, cmap=colours, norm=norm)


def _mesh(figure: Figure, axes: Any, panels: Sequence[_Panel], words: str, values: Any, **scale: Any) -> Any:
    """Draw the `values` of all cells in every panel; return the colour bar of their common scale."""
    image = None
    for axis, panel, shown in zip(axes, panels, values, strict=True):
        image = axis.pcolormesh(*panel.edges, shown, rasterized=True, **scale)
        _clip(axis, panel, image)
    bar = figure.colorbar(image, ax=list(axes), shrink=0.85, pad=0.02, aspect=16)
    bar.set_label(words, fontsize=LABEL)
    bar.ax.tick_params(labelsize=SMALL)
    return bar


def _rates(panels: Sequence[_Panel]) -> Normalize:
    """Scale from 0 to 100 %, or to the 99th percentile of the cells, rounded up to 10 %, if that is at most 50 %."""
    known = np.concatenate([panel.cells.rate[panel.cells.runs > 0] for panel in panels])
    most = float(np.percentile(100 * known, 99))
    return Normalize(0, 100 if most > 50 else max(10.0, 10 * np.ceil(most / 10)))


def _scale(values: Sequence[Any]) -> Normalize:
    """Scale from the 2nd to the 98th percentile, logarithmic if that spans more than a factor of 20."""
    known = np.concatenate([np.ravel(value[np.isfinite(value)]) for value in values])
    if not len(known):
        return Normalize(0, 1)
    low, high = np.percentile(known, [2, 98])
    return LogNorm(low, high) if 0 < 20 * low < high else Normalize(low, high if high > low else low + 1)


def _hatch(axis: Any, panel: _Panel) -> None:
    """Hatch the cells whose success rate is uncertain."""
    unsure = panel.square(_unsure(panel))
    if np.any(unsure):
        cover = np.ma.masked_where(~unsure, np.zeros(unsure.shape))
        clear = ListedColormap([(1.0, 1.0, 1.0, 0.0)])
        style = {"cmap": clear, "hatch": HATCH, "edgecolor": "#808080", "linewidth": 0.0}
        _clip(axis, panel, axis.pcolor(*panel.edges, cover, **style))


def _unsure(panel: _Panel) -> Any:
    return (panel.cells.width > WIDE) & (panel.cells.runs > 0)


def _causes(figure: Figure, axes: Any, panels: Sequence[_Panel], total: Cells) -> None:
    """Draw the most frequent cause of failure in each cell; white where no run failed."""
    values = []
    for panel in panels:
        failures = panel.cells.causes[1:]
        most = np.where(failures.sum(axis=0) > 0, 1 + np.argmax(failures, axis=0), 0)
        values.append(np.ma.masked_where(panel.square(panel.cells.runs) == 0, panel.square(most)))
    scale = {"cmap": ListedColormap(["#ffffff", *FAILED]), "vmin": -0.5, "vmax": len(CAUSES) - 0.5}
    bar = _mesh(figure, axes, panels, "most frequent cause of failure", values, **scale)
    failed = max(float(total.causes[1:].sum()), 1.0)
    shares = [f"{name} {100 * total.causes[code].sum() / failed:.3g} %" for code, name in enumerate(CAUSES)][1:]
    bar.set_ticks(range(len(CAUSES)), labels=["none", *shares])
    bar.ax.tick_params(length=0)
    handles = [Patch(facecolor=EMPTY, label="no runs, or none settled")]
    if any(np.any(_unsure(panel)) for panel in panels):
        words = f"interval of the success rate wider than {100 * WIDE:.0f} %"
        handles.append(Patch(facecolor="white", edgecolor=INK, hatch=HATCH, label=words))
    figure.legend(handles=handles, loc="outside lower center", ncols=2, fontsize=SMALL, frameon=False)


def _clip(axis: Any, panel: _Panel, image: Any) -> None:
    """Clip the image of a hemisphere at the horizon."""
    if panel.part is not None:
        image.set_clip_path(Circle((0, 0), EDGE, transform=axis.transData))


def _frame(axis: Any, panel: _Panel, names: tuple[str, str] | None, *, last: bool) -> None:
    """Draw rings of equal tilt and the pole of a hemisphere, or label the axes of a plane."""
    axis.tick_params(labelsize=SMALL)
    if panel.part is None:
        assert names is not None
        axis.set_facecolor(EMPTY)
        axis.set_ylabel(_label(names[1]), fontsize=LABEL)
        if last:
            axis.set_xlabel(_label(names[0]), fontsize=LABEL)
        for line, name in ((axis.xaxis, names[0]), (axis.yaxis, names[1])):
            if "°" in label(name):
                line.set_major_locator(MultipleLocator(DEGREES))
        return
    hemisphere(axis, panel.part)


def hemisphere(axis: Any, part: int) -> None:
    """Draw the edge, the rings of equal tilt and the pole of a hemisphere on `axis`: `part` 0, the upper, or 1."""
    axis.set(xlim=(-1.03 * EDGE, 1.03 * EDGE), ylim=(-1.03 * EDGE, 1.03 * EDGE), aspect="equal")
    axis.axis("off")
    axis.add_patch(Circle((0, 0), EDGE, facecolor=EMPTY, edgecolor="none", zorder=0))
    axis.add_patch(Circle((0, 0), EDGE, facecolor="none", edgecolor=INK, linewidth=0.8, clip_on=False))
    for angle in RINGS:
        radius = 2 * np.sin(np.radians(angle) / 2)
        axis.add_patch(Circle((0, 0), radius, facecolor="none", edgecolor="white", linewidth=0.9))
        axis.add_patch(Circle((0, 0), radius, facecolor="none", edgecolor=INK, linewidth=0.5, linestyle=(0, (2, 2))))
        _note(axis, 0.0, -radius, f"{angle if part == 0 else 180 - angle}°")
    _note(axis, 0.0, -EDGE, "90°")
    axis.plot(0, 0, "+", color="white", markersize=6, markeredgewidth=2.2)
    axis.plot(0, 0, "+", color=INK, markersize=5, markeredgewidth=0.9)
    _note(axis, 0.0, 0.17, "inverted" if part == 0 else "hanging")


def _label(name: str) -> str:
    """The axis label of a quantity; a gain as figures write it."""
    return symbol(name.removeprefix("gains.")) if name.startswith("gains.") else label(name)


def _note(axis: Any, x: float, y: float, words: str) -> None:
    """Write `words` at (`x`, `y`) on a white box."""
    box = {"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}
    axis.text(x, y, words, fontsize=SMALL - 1, ha="center", va="center", color=INK, bbox=box)
