"""Single runs by kernel, with what a trajectory wants to know of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from flypend.compile.llvm import runge_kutta
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.flown import STATUS, Flown, inputs_of
from flypend.flight.kernels.ideal import MAX_STEPS, IdealKernel, integrate
from flypend.flight.kernels.sampled import SampledKernel, sampled_kernel
from flypend.flight.outcome import Outcome
from flypend.flight.sampled import LEFT, NOT_FINITE, Samples
from flypend.laws import BoundLaw
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, MAX_STATE, SIZE
from flypend.plants.loop import Loop
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
    The same steps are taken whichever times are asked for, so that every answer belongs to one solution. `parameters`
    (k,) are values of the gains that the kernel takes as inputs; default those of its law.
    """

    def __init__(
        self, kernel: IdealKernel, start: Any, duration: float, rtol: float, atol: float, parameters: Any = None
    ) -> None:
        self._function = kernel.function
        self._start = np.ascontiguousarray(start, dtype=float)
        self._setting = (duration, rtol, atol)
        self._values = inputs_of(
            kernel.law, kernel.parameters, None if parameters is None else np.asarray(parameters)[None], 1
        )
        room = np.empty(1 + 4 * MAX_STEPS)
        room[0] = 0
        flown = self._fly(np.zeros(0), room)
        steps = room[1 : 1 + 4 * int(room[0])].reshape(-1, 4)
        self.knots, self.drift = np.append(0.0, steps[:, 0]), steps[:, 1:].copy()
        self._final = flown.final[0]
        self.outcome = _judge(int(flown.code[0]), float(flown.end[0]), kernel)

    def _fly(self, times: Any, room: Any = None) -> Flown:
        return integrate(self._function, self._start, self._values, *self._setting, times, room)

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


def flown_by_kernel(
    vehicle: Vehicle, law: BoundLaw, start: State, duration: float, plant: Plant, ticks: Any
) -> Samples:
    """As `flypend.flight.sampled.fly`, at control `ticks` only."""
    kernel = sampled_kernel(Loop(vehicle, law, plant.replace(seed=0)), Criterion())
    return sampled_samples(kernel, start.packed(), duration, ticks, plant.seed)


def sampled_samples(
    kernel: SampledKernel,
    start: Any,
    duration: float,
    ticks: Any,
    seed: int,
    parameters: Any = None,
    rotors: Any = None,
) -> Samples:
    """The samples, at control `ticks`, of the flight from the packed state `start` (24,) with `seed`.

    `parameters` (k,) are gains that the kernel takes as inputs, `rotors` the forces (n,) that the rotors begin with.
    """
    values = None if parameters is None else np.asarray(parameters)[None]
    begin = None if rotors is None else np.asarray(rotors)[None]
    flown = kernel.fly(start[None], duration, ticks=ticks, first_seed=seed, parameters=values, rotors=begin, keep=True)
    law, plant = kernel.loop.law, kernel.loop.plant
    code, end = int(flown.code[0]), float(flown.end[0])
    outcome = Outcome("completed", end)
    if code != runge_kutta.COMPLETED:
        singular = code == runge_kutta.UNDEFINED
        outcome = Outcome("singular" if singular else "diverged", end, NOT_FINITE if singular else LEFT)
    t, samples = ticks / plant.rate, flown.samples[0]
    kept = t <= end + 1e-9
    packed = samples[kept, :SIZE] * (1.0 if law.e3 == "up" else FLIP_PACKED)
    return Samples(t[kept], packed, samples[kept, SIZE:], outcome)
