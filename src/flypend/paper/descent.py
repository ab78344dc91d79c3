"""Does V fall? The largest rise of V along many flights, for both theorems and for laws that lack a part of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend.flight.criterion import Criterion
from flypend.flight.ensemble import simulate_ensemble
from flypend.laws import Law, almost_global, corrected, printed, repaired
from flypend.laws.closed_loop import symbolic_loop
from flypend.laws.repaired import repaired_control
from flypend.model import State, Vehicle, vehicle

RISES = 1e-6  # V has risen if it exceeds an earlier value by this share of V(0)
PERIOD, BATCH = 0.05, 1000  # s between samples; flights held in memory at once
# Radii of the wide box: |ω| and |ẏ| in rad/s, |ẋ| in m/s, and, where position is controlled, |x_i| in m.
FAST: Mapping[str, float] = {"max_omega": 12.0, "max_y_dot": 12.0, "max_x_dot": 5.0}
FAR = 10.0


@dataclass(frozen=True, kw_only=True)
class Descent:
    """What V did along the flights of one law.

    Parameters
    ----------
    law : str
        The law.
    runs, converged, ended, rising : int
        Flights; those that reach the goal; that end early; and along which V rises by more than `RISES` of V(0).
    median_rise, worst_rise : float
        Largest rise of V over V(0) along a flight: median and maximum over the flights.
    """

    law: str
    runs: int
    converged: int
    ended: int
    rising: int
    median_rise: float
    worst_rise: float


def laws() -> Mapping[str, tuple[Law, str, float]]:
    """Return the laws of the table by name: law, vehicle, and the seconds to fly. Only the first two have a proof."""
    uncancelled = replace(repaired(), control=partial(repaired_control, cancelled=0.0))
    return {
        "repaired": (repaired(), "nayak2018", 20.0),
        "almost_global": (almost_global(), "hehn2011", 30.0),
        "printed": (printed(), "nayak2018", 6.5),
        "printed without beta": (printed(beta="off"), "nayak2018", 6.5),
        "corrected": (corrected(), "nayak2018", 20.0),
        "corrected, beta regularized": (corrected(beta="regularized"), "nayak2018", 20.0),
        "repaired, cross term not cancelled": (uncancelled, "nayak2018", 20.0),
    }


def wide_starts(runs: int, seed: int, law: Law) -> State:
    """Return `runs` random starts from the wide box, in the frame of `law`: see `FAST` and `FAR`."""
    rng = np.random.default_rng(seed)
    starts = State.random(rng, runs, **FAST)
    if law.reference is None:
        return starts.seen(law.e3)
    fields = {name: getattr(starts, name) for name in ("x_dot", "R", "omega", "y", "y_dot")}
    return State(x=rng.uniform(-FAR, FAR, (runs, 3)), **fields)


def descend(
    name: str,
    runs: int,
    seed: int,
    *,
    starts: State | None = None,
    progress: Callable[[int, int], Any] = lambda *_: None,
) -> Descent:
    """Fly law `name` of `laws()` from `runs` wide starts of `seed`, or from `starts`, and measure the rises of V."""
    law, machine, duration = laws()[name]
    body = vehicle(machine)
    chosen = wide_starts(runs, seed, law) if starts is None else starts
    target = Criterion(target="e3", position=np.inf) if law.reference is None else Criterion()
    times = np.arange(0.0, duration + PERIOD / 2, PERIOD)
    value = lyapunov(body, law)
    rises, reached, ended = [], 0, 0
    for first in range(0, len(chosen), BATCH):
        flown = simulate_ensemble(
            body, law, chosen[first : first + BATCH], duration, plant="ideal", rtol=1e-10, times=times, criterion=target
        )
        assert flown.samples is not None
        packed = flown.samples.packed()
        with np.errstate(all="ignore"):
            V = np.array(value(np.tile(times, len(flown))[None], packed.reshape(-1, packed.shape[-1]).T))
            rises.append(relative_rises(V.reshape(len(flown), -1)))
        reached += int(flown.success.sum())
        ended += int(np.sum(flown.end < duration))
        progress(first + len(flown), len(chosen))
    rise = np.concatenate(rises)
    return Descent(
        law=name, runs=len(chosen), converged=reached, ended=ended, rising=int(np.sum(rise > RISES)),
        median_rise=float(np.median(rise)), worst_rise=float(np.max(rise)),
    )  # fmt: skip


def lyapunov(machine: Vehicle, law: Law) -> ca.Function:
    """Return V of `law` on `machine` as a function of time and packed state, for many columns at once."""
    loop = symbolic_loop(machine, law)
    return ca.Function("V", [loop.t, loop.s], ca.cse([loop.signals["V"]]))


def relative_rises(V: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the largest rise of each row of `V` (n, k) above its running minimum, over its first value.

    NaN marks the samples after the end of a flight. A value that overflows counts as an infinite rise.
    """
    known = np.where(np.isnan(V), -np.inf, V)
    lowest = np.fmin.accumulate(V, axis=1)
    found: NDArray[np.float64] = np.max(known - lowest, axis=1) / V[:, 0]
    return np.where(np.isnan(found), np.inf, found)
