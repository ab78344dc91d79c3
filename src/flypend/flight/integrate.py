"""A closed-loop trajectory on the manifold by SciPy's embedded Runge-Kutta method of order 8 (DOP853)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853
from scipy.optimize import brentq

from flypend import signals
from flypend.flight.outcome import LEFT, NOT_ENOUGH, UNDEFINED, Outcome
from flypend.flight.request import Tolerances
from flypend.model.state import MAX_STATE, project

Rates = Callable[[float, Any], Any]
Margin = Callable[[float, Any], float]


@dataclass(frozen=True)
class Integration:
    """Accepted steps of one run: `knots` (n+1,), one interpolant per step, drift (n, 3) before projection."""

    knots: NDArray[np.float64]
    interpolants: tuple[Callable[[Any], Any], ...]
    start: NDArray[np.float64]
    drift: NDArray[np.float64]
    outcome: Outcome

    def __call__(self, t: Any) -> Any:
        """Return the states (len(t), 24) at times within the run, from the method's dense output, projected."""
        t = np.atleast_1d(np.asarray(t, dtype=float))
        if not self.interpolants:
            return np.repeat(self.start[None], len(t), axis=0)
        step = np.clip(np.searchsorted(self.knots, t, side="left") - 1, 0, len(self.interpolants) - 1)
        states = np.stack([self.interpolants[i](time) for i, time in zip(step, t, strict=True)])
        states[t <= self.knots[0]] = self.start
        return project(states)[0]


def integrate(
    rates: Rates,
    start: Any,
    duration: float,
    tolerances: Tolerances,
    *,
    margin: Margin | None = None,
    margin_reason: str = "",
    touch: Callable[[Any], tuple[float, str] | None] = lambda _: None,
) -> Integration:
    """Integrate `rates` from the packed state `start` over `duration` seconds; a run that fails does not raise.

    After each accepted step the state is projected onto the manifold, and the drift before projection is recorded. If
    `margin(t, state)` stops being positive, the run ends as singular, with `margin_reason`; if `touch`, given the
    interpolant of a step or, at the start, of none, returns a time and a reason, it ends then as collided.
    """

    def unflown(outcome: Outcome) -> Integration:
        return Integration(np.zeros(1), (), start, np.zeros((0, 3)), outcome)

    if margin is not None and margin(0.0, start) <= 0:
        return unflown(Outcome("singular", 0.0, margin_reason))
    if not np.all(np.isfinite(rates(0.0, start))):
        return unflown(Outcome("singular", 0.0, UNDEFINED))
    if (hit := touch(None)) is not None:
        return unflown(Outcome("collided", *hit))
    knots: list[float] = [0.0]
    interpolants: list[Any] = []
    drifts: list[Any] = []
    solver = DOP853(rates, 0.0, start, duration, rtol=tolerances.rtol, atol=tolerances.absolute)
    outcome: Outcome | None = None
    with np.errstate(all="ignore"):
        while outcome is None:
            signals.poll()
            message = solver.step()
            if (outcome := _lost(solver, message, len(interpolants), tolerances.steps)) is not None:
                break
            interpolants.append(solver.dense_output())
            knots.append(solver.t)
            solver.y, drift = project(solver.y)
            solver.f = rates(solver.t, solver.y)
            drifts.append(drift)
            if (hit := touch(interpolants[-1])) is not None:
                knots[-1] = hit[0]
                outcome = Outcome("collided", *hit)
            elif margin is not None and margin(solver.t, solver.y) <= 0:
                knots[-1] = _find_crossing(margin, interpolants[-1])
                outcome = Outcome("singular", knots[-1], margin_reason)
            elif solver.status == "finished":
                outcome = Outcome("completed", solver.t)
    drift = np.array(drifts).reshape(-1, 3)
    return Integration(np.array(knots), tuple(interpolants), start, drift, outcome)


def _lost(solver: DOP853, message: str | None, steps: int, max_steps: int) -> Outcome | None:
    """Return the outcome of a run whose last step failed or left all bounds; None if it continues."""
    if solver.status == "failed":
        return Outcome("diverged", solver.t, f"{message} Loosen rtol, or inspect the state before this time.")
    if not np.max(np.abs(solver.y)) < MAX_STATE:  # or NaN
        return Outcome("diverged", solver.t_old, LEFT)
    if steps >= max_steps:
        return Outcome("diverged", solver.t_old, f"{max_steps} {NOT_ENOUGH}")
    return None


def _find_crossing(margin: Margin, interpolant: Any) -> float:
    """Return the time within the step of `interpolant` at which `margin` reaches zero, to 1e-12 s."""
    before, after = (margin(t, interpolant(t)) for t in (interpolant.t_old, interpolant.t))
    if before <= 0 or after > 0:
        return float(interpolant.t)
    return float(brentq(lambda t: margin(t, interpolant(t)), interpolant.t_old, interpolant.t, xtol=1e-12))
