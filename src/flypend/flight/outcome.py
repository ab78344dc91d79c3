"""How a run ended."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from flypend import errors

Status = Literal["completed", "diverged", "singular", "collided"]
STATUSES: tuple[Status, ...] = get_args(Status)


@errors.named_arguments
@dataclass(frozen=True)
class Outcome:
    """How a run ended.

    Parameters
    ----------
    status : "completed", "diverged", "singular" or "collided"
        The run reached its duration, the state left all bounds, the law stopped being defined, the rod touched the
        vehicle or left its cup, or the machine touched the floor.
    time : float
        End time, s.
    reason : str
        Cause and remedy; empty for a completed run.
    """

    status: Status
    time: float
    reason: str = ""

    def __str__(self) -> str:
        return f"{self.status} at {self.time:.4g} s" + (f": {self.reason}" if self.reason else "")
