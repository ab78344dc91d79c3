"""The output of `flypend tune`: a run file with the tuned gains, and the history of the search."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from flypend import __version__
from flypend.files.staging import staging
from flypend.files.whole import save_figure
from flypend.palette import BLUE, GREEN, GREY, ORANGE, RED
from flypend.pictures.style import LABEL, PAGE, SMALL, new_figure, rule, symbol
from flypend.report.text import write_json
from flypend.settings.runfile import run_text
from flypend.studies.tune import Tuned

STYLES = ((BLUE, "-"), (RED, "--"), (GREEN, "-."), (ORANGE, ":"), (GREY, (0, (5, 1, 1, 1, 1, 1))))


def write_tuned(result: Tuned, out: str | Path) -> None:
    """Write tuned.toml (for `flypend run`), history.json and history.png of `result` into the folder `out`.

    Raises InputError if `out` is not writable.
    """
    with staging(out) as folder:
        words = f"# {summarise(result.before)} before,\n# {summarise(result.after)} with these gains.\n"
        (folder / "tuned.toml").write_text(words + run_text(result.settings(), out), encoding="utf-8")
        content = {
            "flypend": __version__,
            "study": result.study.text(Path(out)),
            "tune": result.study.tune,
            "before": result.before,
            "after": result.after,
            "history": result.history,
        }
        write_json(folder / "history.json", content)
        save_figure(history_figure(result), folder / "history.png")


def summarise(report: dict[str, Any]) -> str:
    """Return one line on `report` (`Tuned.before` or `Tuned.after`): success rate, settling time and cost."""
    settling = "-" if report["settling_p50"] is None else f"{report['settling_p50']:.3g} s"
    low, high = report["wilson_low"], report["wilson_high"]
    interval = "no interval" if low is None else f"{100 * low:.4g} to {100 * high:.4g} %"
    return (
        f"{100 * report['success']:.4g} % of {report['runs']} runs succeed ({interval}), median settling {settling}, "
        f"cost {report['cost']:.4g}"
    )


def history_figure(result: Tuned) -> Figure:
    """Draw cost against runs flown, with the cost before and after on the study's starts, and the central gains."""
    figure = new_figure(PAGE, 2.9)
    left, right = figure.subplots(1, 2)
    runs = np.array([entry["runs"] for entry in result.history])
    left.plot(runs, [entry["best"] for entry in result.history], color=BLUE, label="best so far, tuning starts")
    left.plot(runs, [entry["median"] for entry in result.history], color=GREY, ls="--", label="median of a generation")
    left.axhline(result.before["cost"], color=RED, ls=":", label="before, study starts")
    left.axhline(result.after["cost"], color=GREEN, ls="-.", label="after, study starts")
    left.set_ylabel("cost (–)", fontsize=LABEL)
    for i, name in enumerate(result.gains):
        colour, style = STYLES[i % len(STYLES)]
        values = np.array([entry["centre"][name] for entry in result.history]) / result.before["gains"][name]
        right.plot(runs, values, color=colour, ls=style, label=f"{symbol(name)} = {result.gains[name]:g}")
    right.axhline(1.0, color=GREY, lw=0.6)
    right.set_ylabel("gain over initial gain (–)", fontsize=LABEL)
    rule((left, right))
    for axis in (left, right):
        axis.set_yscale("log")
        axis.set_xlabel("runs flown", fontsize=LABEL)
        axis.legend(fontsize=SMALL, frameon=False)
    return figure
