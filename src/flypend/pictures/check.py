"""The figure of a check: success against each number of the world, and how far random flights stray."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from flypend.palette import GREY, SERIES
from flypend.pictures.canvas import SMALL, new_figure, rule
from flypend.pictures.style import PAGE
from flypend.studies.check import Check
from flypend.studies.margins import LEAST_RATE, Margin

MARKERS = "osD^vPX"


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
        values = np.sort(flown.excursion[flown.success])
        share = 100 * np.arange(1, len(values) + 1) / len(flown)
        label = f"{law} on {check.vehicle.name}: {100 * flown.rate:.1f} % of {len(flown)}"
        axes.step(values, share, where="post", color=SERIES[i % len(SERIES)], lw=1, label=label)
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set(xlabel="excursion from random starts (m)", ylabel="stand within (%)", ylim=(-4, 104))
