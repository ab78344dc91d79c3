"""Figures of the two theorems: V and its terms over time, and the basin with its exceptional sets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from flypend.flight.trajectory import Trajectory
from flypend.laws.by_name import THEOREM_1
from flypend.palette import BLUE, GREEN, GREY, INK, ORANGE, PINK, RED
from flypend.paper.descent import Basin
from flypend.pictures.style import LABEL, SMALL, new_figure, rule, style_named

STYLES = ((INK, "-"), (RED, "--"), (GREEN, "-."), (BLUE, ":"), (ORANGE, (0, (5, 1))), (PINK, (0, (1, 1))))
LYAPUNOV_UNITS = {**dict.fromkeys(THEOREM_1, "1/s²"), "almost_global": "m²/s²"}
MOST_SPELT = 4  # more terms do not fit into a legend
LEAST = 1e-8  # of the largest V: below it, roundoff


def lyapunov_label(run: Trajectory, words: str) -> str:
    """Return `words` with the unit of the Lyapunov function of `run`, where that of its law is known."""
    unit = LYAPUNOV_UNITS.get(run.law, "")
    return f"{words} ({unit})" if unit else words


def lyapunov_curves(ax: Any, run: Trajectory) -> list[str]:
    """Plot V and its terms V_1, V_2, … along `run` on a logarithmic axis; return the names of the terms."""
    terms = [name for name in run.signals if name.startswith("V_") and name[2:].isdigit()]
    for name, (color, style) in zip(["V", *terms], STYLES, strict=False):
        label = "$V = " + " + ".join(terms) + "$" if name == "V" and 0 < len(terms) < MOST_SPELT else f"${name}$"
        values = np.where(run.signals[name] > 0, run.signals[name], np.nan)
        marker = "." if len(run.t) < 3 else None
        ax.plot(run.t, values, color=color, linestyle=style, label=label, linewidth=1.2, marker=marker)
    ax.set_yscale("log")
    ax.set_ylim(bottom=max(ax.get_ylim()[0], LEAST * np.nanmax(run.signals["V"], initial=LEAST)))
    return terms


def descent_figure(groups: Mapping[str, Mapping[str, Trajectory]], until: float, *, style: str = "paper") -> Figure:
    """Draw V and its terms: one row per start, one column per law.

    `groups` maps laws to runs by name of the start; the axes end at `until`, s. `style` is "paper" or "slides"; raises
    InputError for any other.
    """
    form = style_named(style)
    names = list(next(iter(groups.values())))
    figure = new_figure(form.full[0], 1.3 * len(names) + 0.8, form.dpi)
    rows = figure.subplots(len(names), len(groups), sharex=True, squeeze=False)
    for (law, runs), column in zip(groups.items(), rows.T, strict=True):
        for (name, run), ax in zip(runs.items(), column, strict=True):
            lyapunov_curves(ax, run)
            rule([ax])
            ax.set_title(f"{law}, {name}", fontsize=SMALL)
            ax.set_ylabel(lyapunov_label(run, "$V$"), fontsize=SMALL)
            ax.set_xlim(0, until)
            if run.outcome.status != "completed":
                ax.axvline(run.outcome.time, color=RED, linewidth=1.0, linestyle=":")
    entries = max((ax.get_legend_handles_labels() for ax in rows.flat), key=lambda found: len(found[0]))
    figure.legend(*entries, loc="outside lower center", ncols=6, fontsize=SMALL, frameon=False)
    for ax in rows[-1]:
        ax.set_xlabel("time (s)", fontsize=LABEL)
    return figure


def basin_figure(panels: Sequence[Basin], *, style: str = "paper") -> Figure:
    """Draw settling time over the planar starts at rest, one panel per law, the exceptional set and lost flights in it.

    `style` is "paper" or "slides"; raises InputError for any other.
    """
    form = style_named(style)
    figure = new_figure(form.full[0], 0.52 * form.full[0], form.dpi)
    for ax, basin in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
        degrees = np.degrees(basin.angles)
        most = np.nanpercentile(basin.settling, 99)
        shown = ax.pcolormesh(
            degrees, degrees, basin.settling, cmap="viridis", shading="nearest", rasterized=True, vmin=0, vmax=most
        )
        bar = figure.colorbar(shown, ax=ax, location="bottom", shrink=0.9, extend="max")
        bar.set_label("settling time (s)", fontsize=SMALL)
        bar.ax.tick_params(labelsize=SMALL)
        lost = np.where(basin.unresolved, 1.0, np.nan)
        ax.pcolormesh(degrees, degrees, lost, cmap=ListedColormap([GREY]), shading="nearest", rasterized=True)
        ax.contourf(degrees, degrees, basin.domain, levels=[-1.0, basin.edge], colors=[RED])
        ax.set_title(f"{basin.law} law", fontsize=SMALL)
        ax.set_xlabel(r"rod from its goal ($^\circ$)", fontsize=LABEL)
        ax.set_ylabel(r"thrust axis from its goal ($^\circ$)", fontsize=LABEL)
        ax.tick_params(labelsize=SMALL)
        ax.set_aspect("equal")
    keys = [(RED, "the exceptional set")]
    if any(basin.unresolved.any() for basin in panels):
        keys.append((GREY, "passed it closer than double precision resolves"))
    handles = [Patch(color=color, label=words) for color, words in keys]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, fontsize=SMALL, frameon=False)
    return figure
