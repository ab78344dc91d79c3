"""Figures of studies: distributions per law, and the ladder."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from flypend.palette import SERIES
from flypend.pictures.canvas import SMALL, new_figure, rule
from flypend.pictures.style import PAGE
from flypend.studies.compare import Comparison
from flypend.studies.ladder import Ladder

MARKERS = "osD^vPX"


def comparison_figure(comparison: Comparison) -> Figure:
    """Cumulative distributions of settling time and excursion over all runs, one curve per law of `comparison`."""
    figure = new_figure(PAGE, 2.9)
    axes = figure.subplots(1, 2, sharey=True)
    for i, (name, ensemble) in enumerate(comparison.ensembles.items()):
        label = f"{name}: {100 * ensemble.rate:.1f} % of {len(ensemble)}"
        for axis, field in zip(axes, ("settling", "excursion"), strict=True):
            values = np.sort(getattr(ensemble, field)[ensemble.success])
            share = 100 * np.arange(len(values) + 1) / len(ensemble)
            steps = axis.step(np.append(0.0, values), share, where="post", color=SERIES[i % len(SERIES)], ls=_dash(i))
            steps[0].set_label(label)
    axes[0].set(xlabel="time (s)", ylabel="runs settled by then (%)", ylim=(0, 102))
    axes[1].set(xlabel="largest distance from the reference (m)", ylabel="runs settled within (%)")
    figure.legend(
        *axes[0].get_legend_handles_labels(), fontsize=SMALL, loc="outside upper left", ncols=2, frameon=False
    )
    for axis in axes:
        _extend(axis)
    rule(axes)
    return figure


def _extend(axis: Any) -> None:
    """Begin `axis` at 0, and go on with every curve to its right edge: what has not settled by then does not."""
    lines = axis.get_lines()
    right = 1.04 * max(line.get_xdata()[-1] for line in lines) or 1.0
    for line in lines:
        x, y = line.get_data()
        line.set_data(np.append(x, right), np.append(y, y[-1]))
    axis.set_xlim(0, right)


def ladder_figure(ladder: Ladder) -> Figure:
    """Success rate with its Wilson interval (95 %), and 95th percentile of the excursion, per rung of `ladder`."""
    rungs = list(ladder.rungs)
    figure = new_figure(PAGE, 4.6 + 0.05 * max(0, max(map(len, rungs)) - 18))  # names of several rungs are long
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
    rule(axes)
    return figure


def _dash(i: int) -> str:
    return ("-", "--", "-.", ":")[i % 4]
