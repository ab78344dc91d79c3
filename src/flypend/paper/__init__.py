"""The paper's experiments as data, the verdicts on its claims, and its defects."""

from flypend.paper.table import Experiment, experiment, experiment_names

__all__ = ["Experiment", "experiment", "experiment_names"]
