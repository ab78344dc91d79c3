"""From a request to its kernel, and single runs by kernels, with the details that a trajectory needs."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend.building import builds
from flypend.compile.llvm import runge_kutta
from flypend.compile.numeric import distinct
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.ideal import IdealKernel, Moments, call, ideal_kernel
from flypend.flight.kernels.results import STATUS, Flown, Kernel, Progress, inputs_of
from flypend.flight.kernels.sampled import SampledKernel, sampled_kernel
from flypend.flight.kernels.stopping import heard
from flypend.flight.outcome import LEFT, NOT_ENOUGH, UNDEFINED, Outcome
from flypend.flight.request import MAX_STEPS, Flight, Tolerances
from flypend.flight.sampled import NOT_FINITE, Samples, nearest_ticks
from flypend.flight.touch import reason_of
from flypend.geometry import Numbers
from flypend.laws import BoundLaw
from flypend.model.state import SIZE, convert_packed
from flypend.plants import Sampled
from flypend.plants.loop import Loop


def has_kernel(flight: Flight) -> bool:
    """Whether `flight` can be compiled, that is, has a symbolic law."""
    return isinstance(flight.law, BoundLaw)


def kernel_of(flight: Flight) -> IdealKernel | SampledKernel:
    """Return the kernel of `flight`, compiled or from the cache. Raises InputError if it cannot be compiled."""
    return kernel_for(flight.loop, flight.criterion, flight.tolerances)


@builds
def kernel_for(loop: Loop, criterion: Criterion, exact: Tolerances) -> IdealKernel | SampledKernel:
    """Return the kernel of `loop` for `criterion`; in the ideal plant, with the method and precision of `exact`."""
    if isinstance(loop.plant, Sampled):
        return sampled_kernel(loop, criterion)
    return ideal_kernel(loop, criterion, method=exact.method_for(loop.symbolic), precision=exact.precision)


def fly_all(flight: Flight, *, workers: int | None = None, progress: Progress = lambda *_: None) -> Flown:
    """Fly every start of `flight`, with the criterion evaluated on its grid and states kept at its times, if any.

    `workers` is the number of threads, default one per core; `progress` is called with `(started, runs)`, in a sampled
    plant with `(done, runs)`.
    """
    kernel, exact, times = kernel_of(flight), flight.tolerances, flight.times
    if isinstance(kernel, IdealKernel):
        return kernel.fly(
            flight.packed, flight.duration, exact, parameters=flight.values, judge_at=flight.grid, keep_at=times,
            workers=workers, progress=progress,
        )  # fmt: skip
    plant, duration = kernel.loop.sampled, flight.duration
    return kernel.fly(
        flight.packed, duration, judge_at=nearest_ticks(flight.grid, plant, duration),
        keep_at=None if times is None else nearest_ticks(times, plant, duration), first_seed=flight.seed or 0,
        parameters=flight.values, workers=workers, progress=progress,
    )  # fmt: skip


class Solution:
    """A run of the ideal plant by `kernel` from the single start of `flight`: its `outcome` and its states at any time.

    `knots` (k+1,) are the start time and the ends of the k accepted steps, `drift` (k, 3) is the drift before
    projection. The steps do not depend on the requested times, so all states belong to one solution. `parameters` are
    the values of the kernel's input gains; default those of its law. The run begins at the time `begin`, s.
    """

    def __init__(
        self, kernel: Kernel, flight: Flight, parameters: NDArray[np.float64] | None = None, begin: float = 0.0
    ) -> None:
        self._function, self._touching = kernel.function, flight.loop.touches
        self._start, self._limits = np.ascontiguousarray(flight.packed[0]), (begin + flight.duration, flight.tolerances)
        self._begin = begin
        self._values = inputs_of(kernel.loop, None if parameters is None else np.asarray(parameters)[None], 1)
        room = np.empty(1 + 4 * flight.tolerances.steps)
        room[0] = 0
        flown = self._fly(np.zeros(0), room)
        steps = room[1 : 1 + 4 * int(room[0])].reshape(-1, 4)
        self.knots, self.drift = np.append(begin, steps[:, 0]), steps[:, 1:].copy()
        self._final = flown.final[0]
        self.outcome = outcome_of(kernel.loop, flown.code, flown.end, flown.part, flight.tolerances.steps)

    def _fly(self, times: NDArray[np.float64], room: NDArray[np.float64] | None = None) -> Flown:
        moments, start = Moments.of(keep_at=times), self._start[None]
        out = Flown.of_size(1, start.size, samples=(len(times), start.size), touching=self._touching)
        given = self._function, start, self._values, *self._limits, moments, out
        heard([lambda stop: call(*given, stop, knots=room, begin=self._begin)])
        return out

    def __call__(self, t: ArrayLike) -> NDArray[np.float64]:
        """Return the states (len(t), 24 or 28) at times within the run, from the method's dense output, projected."""
        wanted = np.atleast_1d(np.asarray(t, dtype=float))
        times = distinct(wanted)
        samples: NDArray[np.float64] = self._fly(times).samples[0]
        samples[times <= self._begin] = self._start
        samples[times >= self.outcome.time] = self._final
        return samples[np.searchsorted(times, wanted)]


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
    outcome = outcome_of(kernel.loop, flown.code, flown.end, flown.part)
    if outcome.status != "completed":  # the end of a run is known once it has been flown
        last = last_tick(outcome, plant)
        ticks = np.append(ticks[ticks < last], last)
        flown = fly(keep_at=ticks)
    t, samples = ticks / plant.rate, flown.samples[0]
    return Samples(t, convert_packed(samples[:, :SIZE], law.e3), samples[:, SIZE:], outcome)


def last_tick(outcome: Outcome, plant: Sampled) -> int:
    """Return the last control tick of a flight through `plant` with this `outcome`.

    A rod touches after a tick, and at the latest at the next one, which the flight does not reach.
    """
    return max(0, int(np.ceil(outcome.time * plant.rate - 1e-6)) - (outcome.status == "collided"))


def reasons(loop: Loop, steps: int = MAX_STEPS) -> dict[int, str]:
    """Return why flights of `loop`, which are allowed `steps`, end early, by status but for what `reason_of` tells."""
    if isinstance(loop.plant, Sampled):
        return {runge_kutta.UNDEFINED: NOT_FINITE, runge_kutta.DIVERGED: LEFT}
    guard = loop.symbolic.guard
    return {
        runge_kutta.DIVERGED: LEFT,
        runge_kutta.SINGULAR: "" if guard is None else guard.reason,
        runge_kutta.UNDEFINED: UNDEFINED,
        runge_kutta.TOO_SMALL: "The step became too small. Loosen rtol, or inspect the state before this time.",
        runge_kutta.TOO_MANY: f"{steps} {NOT_ENOUGH}",
    }


def outcome_of(loop: Loop, code: Numbers, end: Numbers, part: Numbers, steps: int = MAX_STEPS) -> Outcome:
    """Return how the first flight through `loop` ended, which was allowed `steps`; `code` to `part` as in `Flown`."""
    touched = code[0] == runge_kutta.COLLIDED
    reason = reason_of(loop.vehicle, int(part[0])) if touched else reasons(loop, steps).get(int(code[0]), "")
    return Outcome(str(STATUS[code[0]]), float(end[0]), reason)  # type: ignore[arg-type]
