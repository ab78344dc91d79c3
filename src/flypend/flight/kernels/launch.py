"""From a request to its kernel."""

from __future__ import annotations

from threading import RLock

from flypend.flight.criterion import Criterion
from flypend.flight.kernels.flown import Flown, Progress
from flypend.flight.kernels.ideal import IdealKernel, ideal_kernel
from flypend.flight.kernels.sampled import SampledKernel, sampled_kernel
from flypend.flight.request import Flight, Tolerances
from flypend.flight.sampled import nearest_ticks
from flypend.laws import BoundLaw
from flypend.plants import Sampled
from flypend.plants.loop import Loop

# Expressions of CasADi share nodes, and two threads that build at once have crashed there: one builds at a time.
building = RLock()


def has_kernel(flight: Flight) -> bool:
    """Whether `flight` can be compiled, that is, has a symbolic law."""
    return isinstance(flight.law, BoundLaw)


def kernel_of(flight: Flight) -> IdealKernel | SampledKernel:
    """Return the kernel of `flight`, compiled or from the cache. Raises InputError if it cannot be compiled."""
    return kernel_for(flight.loop, flight.criterion, flight.tolerances)


def kernel_for(loop: Loop, criterion: Criterion, exact: Tolerances) -> IdealKernel | SampledKernel:
    """Return the kernel of `loop` for `criterion`; in the ideal plant, with the method and precision of `exact`."""
    with building:
        if isinstance(loop.plant, Sampled):
            return sampled_kernel(loop, criterion)
        return ideal_kernel(loop, criterion, method=exact.method_for(loop.symbolic), precision=exact.precision)


def fly_all(flight: Flight, *, workers: int | None = None, progress: Progress = lambda *_: None) -> Flown:
    """Fly every start of `flight`, with the criterion evaluated on its grid and states kept at its times, if any.

    Parameters
    ----------
    flight : Flight
        The request.
    workers : int, optional
        Threads; default one per core.
    progress : callable
        Called with `(started, runs)`; `(done, runs)` in a sampled plant.
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
