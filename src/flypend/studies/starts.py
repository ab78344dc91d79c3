"""Batches of starts in the e₃-up frame."""

from __future__ import annotations

import numpy as np

from flypend.model import State
from flypend.model.state import SHAPES
from flypend.paper import experiment, experiment_names


def random_starts(runs: int, seed: int) -> State:
    """Return `runs` random states from `seed`: y, R uniform, |omega|, |y_dot| ≤ 3 rad/s, |x_dot| ≤ 2 m/s, x = 0."""
    return State.random(np.random.default_rng(seed), runs)


def paper_starts() -> State:
    """Return the paper's five starts, their numbers read in the e₃-up frame, moved to x = 0."""
    states = [experiment(name).start for name in experiment_names() if "-" not in name]
    fields = {name: np.stack([getattr(state, name) for state in states]) for name in SHAPES}
    return State(**(fields | {"x": np.zeros((len(states), 3))}))
