"""Plans at the physical limit: optimal flights to inverted hover, and their tracking."""

from flypend.planning.planner import plan
from flypend.planning.result import Plan
from flypend.planning.tracking import track

__all__ = ["Plan", "plan", "track"]
