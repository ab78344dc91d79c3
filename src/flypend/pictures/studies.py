"""Figures of studies: distributions per law, the ladder, and a check with its margins."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from flypend.flight.tasks import LEAST_RATE
from flypend.palette import GREY, SERIES
from flypend.pictures.style import PAGE, SMALL, distribution, new_figure, plain, rule
from flypend.studies.compare import Comparison
from flypend.studies.ladder import Ladder
from flypend.studies.margins import Margin

if TYPE_CHECKING:
    from flypend.studies.check import Check

MARKERS, DASHES = "osD^vPX", ("-", "--", "-.", ":")


def comparison_figure(comparison: Comparison) -> Figure:
    """Cumulative distributions of settling time and excursion over all runs, one curve per law of `comparison`."""
    figure = new_figure(PAGE, 2.9)
    axes = figure.subplots(1, 2, sharey=True)
    for i, (name, ensemble) in enumerate(comparison.ensembles.items()):
        label = f"{name}: {100 * ensemble.rate:.1f} % of {len(ensemble)}"
        for axis, field in zip(axes, ("settling", "excursion"), strict=True):
            values = np.sort(getattr(ensemble, field)[ensemble.success])
            share = 100 * np.arange(len(values) + 1) / len(ensemble)
            style = {"color": SERIES[i % len(SERIES)], "ls": DASHES[i % 4]}
            axis.step(np.append(0.0, values), share, where="post", label=label, **style)
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


def check_figure(checks: Mapping[str, Check]) -> Figure:
    """Draw success rates with Wilson intervals (95 %) against every margin, and the excursions of random flights.

    One colour per law of `checks`. Dashed: the value that the law believes, and the rate at which a margin ends.
    """
    names = list(dict.fromkeys(name for check in checks.values() for name in check.margins))
    rows = -(-(len(names) + 1) // 3)
    figure = new_figure(PAGE, 0.4 + 2.1 * rows)
    panels = list(np.atleast_1d(figure.subplots(rows, min(3, len(names) + 1))).ravel())
    for axes, name in zip(panels, names, strict=False):
        for i, check in enumerate(checks.values()):
            if name in check.margins:
                _curve(axes, check.margins[name], i)
        axes.axhline(100 * LEAST_RATE, color=GREY, lw=0.7, ls="--")
        axes.set(ylabel="success (%)", ylim=(-4, 104))
    _strays(panels[len(names)], checks)
    for axes in panels[len(names) + 1 :]:
        axes.set_axis_off()
    handles, labels = panels[len(names)].get_legend_handles_labels()
    figure.legend(handles, labels, fontsize=SMALL, loc="outside upper left", ncols=2, frameon=False)
    rule(panels[: len(names) + 1])
    return figure


def _curve(axes: Any, margin: Margin, place: int) -> None:
    rates, bounds = margin.rate()
    axes.errorbar(
        margin.values, 100 * rates, 100 * np.abs(bounds - rates), color=SERIES[place % len(SERIES)], lw=1,
        marker=MARKERS[place % len(MARKERS)], ms=3, capsize=1.5, elinewidth=0.7,
    )  # fmt: skip
    axes.axvline(margin.nominal, color=GREY, lw=0.7, ls="--")
    axes.set_xlabel(f"{margin.name} ({margin.unit})")


def _strays(axes: Any, checks: Mapping[str, Check]) -> None:
    for i, (law, check) in enumerate(checks.items()):
        if "random" not in check.tasks:
            continue
        flown = check.tasks["random"]
        label = f"{law} on {check.vehicle.name}: {100 * flown.rate:.1f} % of {len(flown)}"
        style = {"color": SERIES[i % len(SERIES)], "lw": 1, "label": label}
        distribution(axes, flown.excursion[flown.success], len(flown), **style)
    axes.set(xlabel="excursion from random starts (m)", xscale="log", ylabel="stand within (%)", ylim=(-4, 104))
    plain(axes.xaxis, 1.0, 2.0, 5.0)
