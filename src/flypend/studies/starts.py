"""Batches of starts in the e₃-up frame."""

from __future__ import annotations

import numpy as np

from flypend import errors
from flypend.files.reading import check_fits
from flypend.model import State
from flypend.model.state import SHAPES
from flypend.paper import experiment, experiment_names
from flypend.plants.plant import check_seed

MOST_RUNS = 10**8  # 20 GB of states


@errors.named_arguments
def random_starts(runs: int, seed: int) -> State:
    """Return `runs` random states from `seed`: y, R uniform, |omega|, |y_dot| ≤ 3 rad/s, |x_dot| ≤ 2 m/s, x = 0.

    Raises InputError for an invalid number of runs or seed.
    """
    check_starts(runs, seed)
    return State.random(np.random.default_rng(seed), runs)


def check_starts(runs: int, seed: int) -> None:
    """Raise InputError unless `random_starts` can draw so many `runs` from the `seed`."""
    errors.integer("runs", runs, 1, MOST_RUNS)
    check_seed("seed", seed)
    check_fits("runs", 1000.0 * runs, f"{runs} starts")


def paper_starts() -> State:
    """Return the paper's five starts, their numbers read in the e₃-up frame, moved to x = 0."""
    states = [experiment(name).start for name in experiment_names() if "-" not in name]
    fields = {name: np.stack([getattr(state, name) for state in states]) for name in SHAPES}
    return State(**(fields | {"x": np.zeros((len(states), 3))}))
