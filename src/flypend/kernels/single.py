"""Single runs by kernel, with what a trajectory wants to know of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.compile import runge_kutta
from flypend.kernels.flown import STATUS, Flown
from flypend.kernels.ideal import MAX_STEPS, IdealKernel, integrate
from flypend.kernels.sampled import sampled_kernel
from flypend.laws.law import Law
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, SIZE
from flypend.outcome import MAX_STATE, Outcome
from flypend.plants.flight import LEFT, NOT_FINITE, Samples
from flypend.plants.plant import Plant

REASONS = {
    runge_kutta.DIVERGED: f"the state left |s| < {MAX_STATE:g}",
    runge_kutta.UNDEFINED: "the law is not defined at the start (0/0 in a rate); move the start or add a floor",
    runge_kutta.TOO_SMALL: "The step became too small. Loosen rtol, or see what the state does before this time.",
    runge_kutta.TOO_MANY: f"{MAX_STEPS} steps were not enough",
}


class Solution:
    """A run of the ideal plant: its `outcome`, and its states at any times.

    `knots` (k+1,) are the times of its k accepted steps, `drift` (k, 3) says how far off the manifold each step ended.
    The same steps are taken whichever times are asked for, so that every answer belongs to one solution.
    """

    def __init__(self, kernel: IdealKernel, start: Any, duration: float, rtol: float, atol: float) -> None:
        self._function = kernel.function
        self._start = np.ascontiguousarray(start, dtype=float)
        self._setting = (duration, rtol, atol)
        room = np.empty(1 + 4 * MAX_STEPS)
        room[0] = 0
        flown = self._fly(np.zeros(0), room)
        steps = room[1 : 1 + 4 * int(room[0])].reshape(-1, 4)
        self.knots, self.drift = np.append(0.0, steps[:, 0]), steps[:, 1:].copy()
        self._final = flown.final[0]
        self.outcome = _judge(int(flown.code[0]), float(flown.end[0]), kernel)

    def _fly(self, times: Any, room: Any = None) -> Flown:
        none = np.zeros((1, 0))
        return integrate(self._function, self._start[None], none, *self._setting, times, keep=True, knots=room)

    def __call__(self, t: Any) -> Any:
        """States (len(t), 24) at times inside the run, from the dense output of the method, projected."""
        times, place = np.unique(np.atleast_1d(np.asarray(t, dtype=float)), return_inverse=True)
        samples = self._fly(times).samples[0]
        samples[times <= 0] = self._start
        samples[times >= self.outcome.time] = self._final
        return samples[place]


def _judge(code: int, end: float, kernel: IdealKernel) -> Outcome:
    guard = kernel.law.guard
    reason = guard.reason if code == runge_kutta.SINGULAR and guard is not None else REASONS.get(code, "")
    return Outcome(str(STATUS[code]), end, reason)  # type: ignore[arg-type]


def flown_by_kernel(vehicle: Vehicle, law: Law, start: State, duration: float, plant: Plant, ticks: Any) -> Samples:
    """As `flypend.plants.flight.fly`, at control `ticks` only."""
    flown = sampled_kernel(vehicle, law, plant.replace(seed=0)).fly(
        start.packed()[None], duration, ticks=ticks, first_seed=plant.seed, keep=True
    )
    code, end = int(flown.code[0]), float(flown.end[0])
    outcome = Outcome("completed", end)
    if code != runge_kutta.COMPLETED:
        singular = code == runge_kutta.UNDEFINED
        outcome = Outcome("singular" if singular else "diverged", end, NOT_FINITE if singular else LEFT)
    t, samples = ticks / plant.rate, flown.samples[0]
    kept = t <= end + 1e-9
    packed = samples[kept, :SIZE] * (1.0 if law.e3 == "up" else FLIP_PACKED)
    return Samples(t[kept], packed, samples[kept, SIZE:], outcome)
