"""What a vehicle can do, whatever its law: plans from some of the starts of a task in which a law fails."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from flypend.errors import InputError
from flypend.model import State, Vehicle
from flypend.planning.planner import plan_ensemble
from flypend.planning.result import PlanEnsemble

STARTS = 8  # of the random ones
MOST, HARDLY_ANY = 0.9, 0.1


def possible(
    vehicle: Vehicle, starts: State, workers: int | None, progress: Callable[[str, int, int], Any]
) -> PlanEnsemble | None:
    """Return plans from the first of `starts`; None for a vehicle that the planner refuses."""
    try:
        return plan_ensemble(
            vehicle, starts[:STARTS], workers=workers, progress=lambda done, total: progress("planning", done, total)
        )
    except InputError:
        return None


def describe(plans: PlanEnsemble, law: str) -> str:
    """Return in a sentence what the `plans` say about a vehicle on which the `law` fails."""
    count, share = int(plans.success.sum()), float(plans.success.mean())
    found = f"plans reach inverted hover from {count} of {len(plans)} random starts"
    if share >= MOST:
        return f"{found}: the limit is the {law} law's, not the vehicle's"
    if share <= HARDLY_ANY:
        return f"{found}: the limit may be the vehicle's, not the {law} law's"
    return f"{found}: this vehicle can be inverted from some"
