"""Plans at the physical limit: optimal flights to inverted hover, and their tracking."""

from flypend.planning.planner import plan
from flypend.planning.result import Plan

__all__ = ["Plan", "plan"]
