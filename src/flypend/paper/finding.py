"""The record of a defect: the formula, the numbers that show it, and the runs that they come from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from flypend.flight.trajectory import Trajectory


@dataclass(frozen=True)
class Finding:
    """One defect of the paper.

    Parameters
    ----------
    title : str
        The defect in a few words.
    printed, corrected : str
        The formula as printed, and as it should read.
    evidence : dict
        The computed values, by name.
    shown : bool
        Whether these values show the defect.
    """

    title: str
    printed: str
    corrected: str
    evidence: Mapping[str, float]
    shown: bool


@dataclass(frozen=True)
class Runs:
    """Runs of the experiments by name: as printed, printed without beta, corrected, corrected with printed beta."""

    printed: Mapping[str, Trajectory]
    without_beta: Mapping[str, Trajectory]
    corrected: Mapping[str, Trajectory]
    corrected_singular: Mapping[str, Trajectory]
