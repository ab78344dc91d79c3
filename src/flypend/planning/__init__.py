"""Plans at the physical limit: optimal flights to inverted hover, and their tracking."""

from flypend.planning.autopilot import plan_and_track
from flypend.planning.constraints import Constraints
from flypend.planning.ensemble import PlanEnsemble, plan_ensemble
from flypend.planning.planner import plan
from flypend.planning.receding import nmpc
from flypend.planning.result import Plan, load_plan
from flypend.planning.tracking import track
from flypend.planning.window import Window

__all__ = [
    "Constraints",
    "Plan",
    "PlanEnsemble",
    "Window",
    "load_plan",
    "nmpc",
    "plan",
    "plan_and_track",
    "plan_ensemble",
    "track",
]
