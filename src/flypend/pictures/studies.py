"""Figures of studies: distributions per law, and the ladder."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from flypend.palette import SERIES
from flypend.pictures.canvas import LABEL, SMALL, new_figure
from flypend.studies.compare import Comparison
from flypend.studies.ladder import Ladder

MARKERS = "osD^vPX"
WIDTH = 7.16  # two-column width of a paper, in


def comparison_figure(comparison: Comparison) -> Figure:
    """Cumulative distributions of settling time and excursion over all runs, one curve per law of `comparison`."""
    figure = new_figure(WIDTH, 2.9)
    axes = figure.subplots(1, 2, sharey=True)
    for i, (name, ensemble) in enumerate(comparison.ensembles.items()):
        label = f"{name}: {100 * ensemble.rate:.1f} % of {len(ensemble)}"
        for axis, field in zip(axes, ("settling", "excursion"), strict=True):
            values = np.sort(np.where(ensemble.success, getattr(ensemble, field), np.inf))
            share = 100 * np.arange(1, len(values) + 1) / len(values)
            axis.step(values, share, where="post", color=SERIES[i % len(SERIES)], label=label, ls=_dash(i))
    axes[0].set(xlabel="time (s)", ylabel="runs settled by then (%)", ylim=(0, 102))
    axes[1].set(xlabel="largest distance from the reference (m)", ylabel="runs settled within (%)")
    figure.legend(
        *axes[0].get_legend_handles_labels(), fontsize=SMALL, loc="outside upper left", ncols=2, frameon=False
    )
    for axis in axes:
        axis.set_xlim(left=0)
    _finish(axes)
    return figure


def ladder_figure(ladder: Ladder) -> Figure:
    """Success rate with its Wilson interval (95 %), and 95th percentile of the excursion, per rung of `ladder`."""
    rungs = list(ladder.rungs)
    figure = new_figure(WIDTH, 4.6)
    axes = figure.subplots(2, 1, sharex=True)
    laws = list(next(iter(ladder.rungs.values())).ensembles)
    for i, law in enumerate(laws):
        series = [ladder.rungs[rung].ensembles[law] for rung in rungs]
        place = np.arange(len(rungs)) + 0.12 * (i - (len(laws) - 1) / 2)
        rates = 100 * np.array([ensemble.rate for ensemble in series])
        spread = np.abs(100 * np.array([ensemble.interval for ensemble in series]).T - rates)
        style: dict[str, Any] = {"color": SERIES[i % len(SERIES)], "marker": MARKERS[i % len(MARKERS)], "ms": 4}
        axes[0].errorbar(place, rates, spread, ls="none", capsize=2, label=law, **style)
        excursion = [ensemble.percentile("excursion", 95) for ensemble in series]
        axes[1].plot(place, excursion, ls="none", **style)
    axes[0].set(ylabel="success (%)", ylim=(-4, 104))
    axes[1].set(ylabel="excursion (m), 95 %", yscale="log")
    axes[1].set_xticks(range(len(rungs)), rungs, rotation=55, ha="right", fontsize=8)
    axes[0].legend(fontsize=SMALL, frameon=False, ncols=len(laws), loc="lower left", bbox_to_anchor=(0, 1))
    _finish(axes)
    return figure


def _finish(axes: Any) -> None:
    """Set fonts and grid as in the figures of a run."""
    for axis in axes:
        axis.tick_params(which="both", labelsize=SMALL, width=0.6, length=2.5)
        axis.xaxis.label.set_size(LABEL)
        axis.yaxis.label.set_size(LABEL)
        axis.grid(visible=True, color="#e3e3e3", linewidth=0.5)
        axis.set_axisbelow(True)


def _dash(i: int) -> str:
    return ("-", "--", "-.", ":")[i % 4]
