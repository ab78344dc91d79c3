"""Single runs by kernel, with what a trajectory wants to know of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.compile import runge_kutta
from flypend.integrate import MAX_STATE, MAX_STEPS, Outcome
from flypend.kernels.ideal import IdealKernel
from flypend.kernels.sampled import sampled_kernel
from flypend.laws.law import Law
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, SIZE
from flypend.plants.flight import LEFT, NOT_FINITE, Samples
from flypend.plants.plant import Plant

REASONS = {
    runge_kutta.DIVERGED: f"the state left |s| < {MAX_STATE:g}",
    runge_kutta.UNDEFINED: "the law is not defined at the start (0/0 in a rate); move the start or add a floor",
    runge_kutta.TOO_SMALL: "The step became too small. Loosen rtol, or see what the state does before this time.",
    runge_kutta.TOO_MANY: f"{MAX_STEPS} steps were not enough",
}


class Solution:
    """A run of the ideal plant: its `outcome`, its `drift`, and its states at any times.

    The same steps are taken whichever times are asked for, so that every answer belongs to one solution.
    """

    def __init__(self, kernel: IdealKernel, start: Any, duration: float, rtol: float, atol: float) -> None:
        self._kernel, self._start, self._setting = kernel, start, (duration, rtol, atol)
        flown, self.drift = kernel.fly_one(start, *self._setting, np.zeros(0))
        self._final = flown.final[0]
        self.outcome = self._judge(int(flown.code[0]), float(flown.end[0]))

    def _judge(self, code: int, end: float) -> Outcome:
        guard = self._kernel.law.guard
        reason = guard.reason if code == runge_kutta.SINGULAR and guard is not None else REASONS.get(code, "")
        words = {
            runge_kutta.COMPLETED: "completed",
            runge_kutta.SINGULAR: "singular",
            runge_kutta.UNDEFINED: "singular",
        }
        return Outcome(words.get(code, "diverged"), end, reason)  # type: ignore[arg-type]

    def __call__(self, t: Any) -> Any:
        """States (len(t), 24) at times inside the run, from the dense output of the method, projected."""
        times, place = np.unique(np.atleast_1d(np.asarray(t, dtype=float)), return_inverse=True)
        samples = self._kernel.fly_one(self._start, *self._setting, times)[0].samples[0]
        samples[times <= 0] = self._start
        samples[times >= self.outcome.time] = self._final
        return samples[place]


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
