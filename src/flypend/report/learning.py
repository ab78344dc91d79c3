"""The output of `flypend learn`: the policy, and the curve of its training."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from flypend import __version__
from flypend.files.staging import staging
from flypend.files.whole import save_figure
from flypend.laws.learned import save
from flypend.learning.training import Entry, Learner
from flypend.palette import BLUE, GREEN, GREY, RED
from flypend.pictures.style import LABEL, PAGE, SMALL, new_figure, rule
from flypend.report.text import write_json


def write_learned(learner: Learner, out: str | Path) -> Path:
    """Write policy.npz, curve.json and curve.png of `learner` into the folder `out`; return the path of the policy.

    Raises InputError if `out` is not writable.
    """
    with staging(out) as folder:
        save(learner.policy, folder / "policy.npz")
        curve = [entry._asdict() for entry in learner.curve]
        write_json(folder / "curve.json", {"flypend": __version__, "training": learner.training.data, "curve": curve})
        save_figure(curve_figure(learner.curve), folder / "curve.png")
    return Path(out) / "policy.npz"


def curve_figure(curve: list[Entry]) -> Figure:
    """Draw excursion and share of flights that stand over the course of a training: imitation first, then descent."""
    figure = new_figure(PAGE, 2.9)
    left, right = figure.subplots(1, 2)
    rows = np.array(curve).reshape(-1, len(Entry._fields))
    phase, update = rows[:, 0], rows[:, 1]
    imitated = np.max(update[phase == 0], initial=0.0)
    place = update + np.where(phase == 0, 0.0, imitated)
    left.plot(place, rows[:, 4], color=BLUE, label="median")
    left.plot(place, rows[:, 5], color=RED, ls="--", label="95 %")
    left.set_ylabel("largest distance within the flight (m)", fontsize=LABEL)
    left.set_yscale("log")
    left.legend(fontsize=SMALL, frameon=False)
    right.plot(place, 100 * rows[:, 3], color=GREEN)
    right.set_ylabel("flights that end near hover (%)", fontsize=LABEL)
    rule((left, right))
    for axis in (left, right):
        axis.axvline(imitated, color=GREY, lw=0.6)
        axis.set_xlabel("rounds of imitation | updates by descent", fontsize=LABEL)
    return figure
