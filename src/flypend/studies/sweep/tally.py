"""The success rate of a study's runs, with its interval."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.flight.metrics import interval_over_clusters, wilson
from flypend.studies.sweep.study import Study


class Tally:
    """Counts runs and successes of `study`, by start if it has a grid, whose cells all fly the same starts."""

    def __init__(self, study: Study) -> None:
        self.study = study
        starts = study.samples if study.cells > 1 else 1
        self._good, self._flown = (np.zeros(starts, dtype=np.int32) for _ in range(2))

    def add(self, rows: range, success: Any) -> None:
        """Count the runs `rows`, of which `success` (n,) says which succeeded."""
        start = np.arange(rows.start, rows.stop) % len(self._flown)
        np.add.at(self._good, start, success)
        np.add.at(self._flown, start, 1)

    @property
    def runs(self) -> int:
        """Number of runs."""
        return int(self._flown.sum())

    @property
    def successes(self) -> int:
        """Number of runs that succeeded."""
        return int(self._good.sum())

    @property
    def rate(self) -> float:
        """Success rate."""
        return self.successes / self.runs

    def describe_interval(self) -> str:
        """Return the interval of the success rate, 95 %, in a few words; or why there is none."""
        if self.study.sampling != "uniform":
            return f"no interval: {self.study.sampling} draws are not independent"
        if self.study.cells == 1:
            low, high = wilson(self.successes, self.runs)
            return f"95 % interval {100 * low:.4g} to {100 * high:.4g} %"
        if self.study.samples == 1:
            return "no interval from one start"
        low, high = interval_over_clusters(self._good, self._flown)
        return f"95 % interval over {self.study.samples} starts {100 * low:.4g} to {100 * high:.4g} %"
