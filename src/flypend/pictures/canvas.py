"""Shared by all figures: font sizes, an empty figure, and the title of a run."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from flypend.flight.trajectory import Trajectory
from flypend.laws.named import FACTORIES

LABEL, SMALL = 8.0, 7.0  # font sizes, pt


def new_figure(width: float, height: float, dpi: float = 200) -> Figure:
    """Create an empty figure of `width` × `height` inches at `dpi` on an Agg canvas, independent of pyplot."""
    figure = Figure(figsize=(width, height), dpi=dpi, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def title(run: Trajectory, between: str = ", ") -> str:
    """The name of the law, those of its options that are not the usual ones, and its gains, joined by `between`."""
    usual = FACTORIES[run.law]().values if run.law in FACTORIES else {}
    chosen = {name: value for name, value in run.gains.items() if isinstance(value, str) and value != usual.get(name)}
    options = [f"{name} {value}" for name, value in chosen.items()]
    gains = [f"{symbol(name)} = {value:g}" for name, value in run.gains.items() if name.startswith("k_")]
    return between.join(filter(None, [", ".join([f"{run.law} law", *options]), ", ".join(gains)]))


def symbol(name: str) -> str:
    """How figures write the gain `name`: k_1 as a letter with its index, rod_damping in words."""
    return f"${name}$" if re.fullmatch(r"[a-zA-Z]_\w", name) else name.replace("_", " ")


def decimals(run: Trajectory) -> int:
    """Number of decimals that distinguish the snapshot times of `run`."""
    return int(np.clip(2 - np.floor(np.log10(run.t[-1])), 2, 6)) if run.t[-1] > 0 else 2


def rule(panels: Iterable[Any]) -> None:
    """Give each of the axes `panels` small numbers, labels of one size, and a light grid behind the data."""
    for axes in panels:
        axes.tick_params(which="both", labelsize=SMALL, width=0.6, length=2.5)
        axes.xaxis.label.set_size(LABEL)
        axes.yaxis.label.set_size(LABEL)
        axes.grid(visible=True, color="#e3e3e3", linewidth=0.5)
        axes.set_axisbelow(True)


def distribution(axes: Any, values: Any, total: int, **style: Any) -> None:
    """Draw the share of a `total` number of runs, in per cent, that has one of `values` up to each."""
    share = 100 * np.arange(1, len(values) + 1) / total
    axes.step(np.sort(values), share, where="post", **style)


def plain(axis: Any, *labelled: float) -> None:
    """Label the numbers `labelled` of each decade of a logarithmic `axis`, without exponents."""
    axis.set_major_locator(LogLocator(subs=labelled))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())
