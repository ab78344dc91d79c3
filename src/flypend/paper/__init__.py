"""The paper's experiments as data, and their reproduction with a verdict per claim."""

from flypend.paper.table import Experiment, experiment, experiment_names

__all__ = ["Experiment", "experiment", "experiment_names"]
