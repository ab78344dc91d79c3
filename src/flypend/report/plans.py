"""The pictures of `flypend plan`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from flypend.files.whole import save_figure
from flypend.flight.simulate import simulate
from flypend.flight.trajectory import Trajectory
from flypend.laws import inverted
from flypend.laws.references import hover
from flypend.model import State
from flypend.pictures.plans import front_figure, plan_figure, strays_figure
from flypend.planning.constraints import Constraints
from flypend.planning.receding_horizon import nmpc
from flypend.planning.result import Plan
from flypend.planning.window import Window
from flypend.studies.limit import DURATION, front, strays

CELLS = 10
Tell = Callable[[str, int, int], Any]


def draw_plan(path: Path, plan: Plan, flown: Trajectory | None, windows: Sequence[Window]) -> None:
    """Draw to `path` a `plan` through `windows`, beside the run `flown`."""
    save_figure(plan_figure(plan, flown, windows), path)


def draw_front(path: Path, plan: Plan, start: State, kept: Constraints, tell: Tell) -> None:
    """Draw to `path` excursion against allowed time of plans like `plan` from `start`, beside the inverted law.

    The plans keep the constraints `kept`, of which the law knows nothing.
    """
    progress = lambda done, total: tell("planning", done, total)  # noqa: E731
    found = front(plan.vehicle, start, progress=progress, target=plan.target, constraints=kept)
    law = simulate(plan.vehicle, inverted(hover(plan.target)), start, DURATION)
    save_figure(front_figure(found, law), path)


def draw_strays(path: Path, plan: Plan, tell: Tell) -> None:
    """Draw to `path` how far plans of the vehicle of `plan`, nmpc and the inverted law stray from rest."""
    found = strays(plan.vehicle, (inverted(), nmpc()), CELLS, tell=tell)
    save_figure(strays_figure(found), path)
