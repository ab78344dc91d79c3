"""How a run ended."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from flypend import errors
from flypend.model.state import MAX_STATE

Status = Literal["completed", "diverged", "singular", "collided"]
STATUSES: tuple[Status, ...] = get_args(Status)
# Reasons that compiled code and the references in Python give alike.
LEFT = f"the state left |s| < {MAX_STATE:g}"
UNDEFINED = "the law is not defined at the start (0/0 in a rate); move the start or add a floor"
NOT_ENOUGH = "steps were not enough"  # after their number


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
        Cause and remedy; empty for a completed run, except for an episode that its task has ended.
    """

    status: Status
    time: float
    reason: str = ""

    def __str__(self) -> str:
        return f"{self.status} at {self.time:.4g} s" + (f": {self.reason}" if self.reason else "")
