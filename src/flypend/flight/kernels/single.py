"""Single runs by kernel, with the details that a trajectory needs."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend.compile.llvm import runge_kutta
from flypend.flight.kernels.flown import STATUS, Flown, inputs_of
from flypend.flight.kernels.ideal import MAX_STEPS, IdealKernel, Limits, integrate
from flypend.flight.kernels.sampled import SampledKernel
from flypend.flight.moments import distinct
from flypend.flight.outcome import Outcome
from flypend.flight.request import Flight
from flypend.flight.sampled import LEFT, NOT_FINITE, Samples, nearest_ticks
from flypend.flight.touch import reason_of
from flypend.model import Vehicle
from flypend.model.state import MAX_STATE, SIZE, convert_packed

REASONS = {
    runge_kutta.DIVERGED: f"the state left |s| < {MAX_STATE:g}",
    runge_kutta.UNDEFINED: "the law is not defined at the start (0/0 in a rate); move the start or add a floor",
    runge_kutta.TOO_SMALL: "The step became too small. Loosen rtol, or inspect the state before this time.",
    runge_kutta.TOO_MANY: f"{MAX_STEPS} steps were not enough",
}


class Solution:
    """A run of the ideal plant by `kernel` from the single start of `flight`: its `outcome` and its states at any time.

    `knots` (k+1,) are the start time and the ends of the k accepted steps, `drift` (k, 3) is the drift before
    projection. The steps do not depend on the requested times, so all states belong to one solution. `parameters` are
    the values of the kernel's input gains; default those of its law.
    """

    def __init__(self, kernel: IdealKernel, flight: Flight, parameters: NDArray[np.float64] | None = None) -> None:
        self._function = kernel.function
        self._start = np.ascontiguousarray(flight.packed[0], dtype=float)
        self._limits = Limits.of(flight.duration, flight.tolerances)
        self._values = inputs_of(kernel.loop, None if parameters is None else np.asarray(parameters)[None], 1)
        room = np.empty(1 + 4 * self._limits.max_steps)
        room[0] = 0
        self._touching = flight.loop.touches
        flown = self._fly(np.zeros(0), room)
        steps = room[1 : 1 + 4 * int(room[0])].reshape(-1, 4)
        self.knots, self.drift = np.append(0.0, steps[:, 0]), steps[:, 1:].copy()
        self._final = flown.final[0]
        part = int(flown.part[0]) if self._touching else -1
        self.outcome = _judge(int(flown.code[0]), float(flown.end[0]), part, kernel)

    def _fly(self, times: NDArray[np.float64], room: NDArray[np.float64] | None = None) -> Flown:
        return integrate(self._function, self._start, self._values, self._limits, times, room, touching=self._touching)

    def __call__(self, t: ArrayLike) -> NDArray[np.float64]:
        """Return the states (len(t), 24 or 28) at times within the run, from the method's dense output, projected."""
        wanted = np.atleast_1d(np.asarray(t, dtype=float))
        times = distinct(wanted)
        samples: NDArray[np.float64] = self._fly(times).samples[0]
        samples[times <= 0] = self._start
        samples[times >= self.outcome.time] = self._final
        return samples[np.searchsorted(times, wanted)]


def _judge(code: int, end: float, part: int, kernel: IdealKernel) -> Outcome:
    """Return the outcome of a run that ended at `end` (s) with the status `code`, having touched `part`."""
    if code == runge_kutta.COLLIDED:
        return Outcome("collided", end, reason_of(kernel.loop.vehicle, part))
    guard = kernel.loop.symbolic.guard
    reason = guard.reason if code == runge_kutta.SINGULAR and guard is not None else REASONS.get(code, "")
    return Outcome(str(STATUS[code]), end, reason)  # type: ignore[arg-type]


def sampled_samples(
    kernel: SampledKernel,
    flight: Flight,
    parameters: NDArray[np.float64] | None = None,
    rotors: NDArray[np.float64] | None = None,
) -> Samples:
    """Fly a `flight` with a single start by `kernel`, and return samples at the control ticks nearest to its times.

    `parameters` (k,) are the kernel's input gains, `rotors` (n,) the initial rotor forces, N.
    """
    law, plant = kernel.loop.law, kernel.loop.sampled
    start = flight.packed if rotors is None else np.append(flight.packed, [rotors], axis=1)
    fly = partial(
        kernel.fly, start, flight.duration, judge_at=(), first_seed=flight.seed or 0,
        parameters=None if parameters is None else np.asarray(parameters)[None],
    )  # fmt: skip
    ticks = nearest_ticks(flight.moments, plant, flight.duration)
    flown = fly(keep_at=ticks)
    code, end = int(flown.code[0]), float(flown.end[0])
    if code != runge_kutta.COMPLETED:  # the end of a run is known once it has been flown
        last = int(np.floor(end * plant.rate + 1e-6))  # a rod touches between two ticks
        ticks = np.append(ticks[ticks < last], last)
        flown = fly(keep_at=ticks)
    outcome = sampled_outcome(code, end, int(flown.part[0]) if code == runge_kutta.COLLIDED else -1, flight.vehicle)
    t, samples = ticks / plant.rate, flown.samples[0]
    kept = t <= end + 1e-9
    packed = convert_packed(samples[kept, :SIZE], law.e3)
    return Samples(t[kept], packed, samples[kept, SIZE:], outcome)


def sampled_outcome(code: int, end: float, part: int, vehicle: Vehicle) -> Outcome:
    """Return how a sampled flight has ended: `code` of the kernel, time `end` (s), `part` that the rod touched."""
    reason = {runge_kutta.UNDEFINED: NOT_FINITE, runge_kutta.DIVERGED: LEFT}
    if code == runge_kutta.COLLIDED:
        reason[code] = reason_of(vehicle, part)
    return Outcome(str(STATUS[code]), end, reason.get(code, ""))  # type: ignore[arg-type]
