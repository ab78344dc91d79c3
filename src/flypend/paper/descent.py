"""Does V fall, and from where? The largest rise of V along many flights, and the basin on a plane of starts.

Of the theorems, and of laws that lack a part of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend.compile.llvm.stagewise import stagewise
from flypend.flight.criterion import Criterion
from flypend.flight.ensemble import simulate_ensemble
from flypend.laws import Law, almost_global, almost_global_lag, corrected, printed, repaired
from flypend.laws.closed_loop import symbolic_loop
from flypend.laws.repaired import control_repaired
from flypend.model import State, Vehicle, vehicle
from flypend.plants import Ideal

Array = NDArray[np.float64]

RISES = 1e-6  # V has risen if it exceeds an earlier value by this share of V(0)
SETTLE = 30.0  # s, of a flight for the basin
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
    least_ended : float
        Least V(0) of the flights that end early; inf if none does. The engine ends a flight at a rate, or a moment, of
        a million, which laws with a proof ask for very near an exceptional set.
    """

    law: str
    runs: int
    converged: int
    ended: int
    rising: int
    median_rise: float
    worst_rise: float
    least_ended: float = np.inf


class Case(NamedTuple):
    """A row of the table: law, vehicle, the seconds to fly, and whether its rotors lag."""

    law: Law
    vehicle: str
    duration: float
    lag: bool = False


PROVED = ("repaired", "almost_global", "almost_global_lag")


def laws() -> Mapping[str, Case]:
    """Return the rows of the table by name. Only those in `PROVED` have a proof."""
    uncancelled = replace(repaired(), control=partial(control_repaired, cancelled=0.0))
    return {
        "repaired": Case(repaired(), "nayak2018", 20.0),
        "almost_global": Case(almost_global(), "hehn2011", 30.0),
        "almost_global_lag": Case(almost_global_lag(), "hehn2011", 30.0, lag=True),
        "printed": Case(printed(), "nayak2018", 6.5),
        "printed without beta": Case(printed(beta="off"), "nayak2018", 6.5),
        "corrected": Case(corrected(), "nayak2018", 20.0),
        "corrected, beta regularized": Case(corrected(beta="regularized"), "nayak2018", 20.0),
        "repaired, cross term not cancelled": Case(uncancelled, "nayak2018", 20.0),
        "almost_global, its lag unknown": Case(almost_global(), "hehn2011", 30.0, lag=True),
    }


def wide_starts(runs: int, seed: int, law: Law) -> State:
    """Return `runs` random starts from the wide box, in the frame of `law`: see `FAST` and `FAR`."""
    rng = np.random.default_rng(seed)
    starts = State.random(rng, runs, **FAST)
    if law.reference is None:
        return starts.in_frame(law.e3)
    fields = {name: getattr(starts, name) for name in ("x_dot", "R", "omega", "y", "y_dot")}
    return State(x=rng.uniform(-FAR, FAR, (runs, 3)), **fields)


def descend(
    name: str,
    runs: int,
    seed: int,
    *,
    starts: State | None = None,
    machine: Vehicle | None = None,
    progress: Callable[[int, int], Any] = lambda *_: None,
) -> Descent:
    """Fly law `name` of `laws()` from `runs` wide starts of `seed`, or from `starts`, and measure the rises of V.

    `machine` is another vehicle than that of the row. Rotors that lag begin at forces of their own, see `any_rotors`.
    """
    law, usual, duration, lag = laws()[name]
    body = machine or vehicle(usual)
    chosen = wide_starts(runs, seed, law) if starts is None else starts
    target = Criterion(target="e3", position=np.inf) if law.reference is None else Criterion()
    times = np.arange(0.0, duration + PERIOD / 2, PERIOD)
    value, rotors = lyapunov(body, law, lag=lag), any_rotors(body, len(chosen), seed)
    rises, reached, ended, least = [], 0, 0, np.inf
    for first in range(0, len(chosen), BATCH):
        part = slice(first, first + BATCH)
        plant = Ideal(lag=True, rotors=rotors[part]) if lag else Ideal()
        flown = simulate_ensemble(
            body, law, chosen[part], duration, plant=plant, rtol=1e-10, times=times, criterion=target
        )
        assert flown.samples is not None
        packed = flown.samples.packed()
        if flown.wrenches is not None:
            packed = np.concatenate([packed, flown.wrenches], axis=-1)
        with np.errstate(all="ignore"):
            V = value(times, packed)
            rises.append(relative_rises(V))
        reached += int(flown.success.sum())
        early = flown.end < duration
        ended += int(np.sum(early))
        least = min(least, float(np.min(V[early, 0], initial=np.inf)))
        progress(first + len(flown), len(chosen))
    rise = np.concatenate(rises)
    return Descent(
        law=name, runs=len(chosen), converged=reached, ended=ended, rising=int(np.sum(rise > RISES)),
        median_rise=float(np.median(rise)), worst_rise=float(np.max(rise)), least_ended=least,
    )  # fmt: skip


def any_rotors(machine: Vehicle, runs: int, seed: int) -> Array:
    """Return forces (runs, n) of rotors, N, each between nothing and twice its share of the weight."""
    n = len(machine.rotor_spins)
    return np.random.default_rng((seed, 1)).uniform(0.0, 2 * machine.weight / n, (runs, n))


def lyapunov(machine: Vehicle, law: Law, *, lag: bool = False) -> Callable[[Array, Array], Array]:
    """Return V of `law` on `machine` as a function of times (k,) and packed states (n, k, 24), which answers (n, k).

    Through a `lag`, a packed state is followed by the wrench that acts. The program is compiled: V at every sample
    would otherwise take twice the time of the flights.
    """
    loop = symbolic_loop(machine, law, lag=lag)
    program = stagewise(ca.Function("V", [loop.t, loop.s], [ca.cse(ca.densify(loop.signals["V"]))]), abreast=True)

    def value(times: Array, packed: Array) -> Array:
        n, k, size = packed.shape
        found = np.empty((n * k, 1))
        program(n * k, np.tile(times, n)[:, None], np.ascontiguousarray(packed).reshape(n * k, size), found)
        return found.reshape(n, k)

    return value


def relative_rises(V: Array) -> Array:
    """Return the largest rise of each row of `V` (n, k) above its running minimum, over its first value.

    NaN marks the samples after the end of a flight. A value that overflows counts as an infinite rise.
    """
    known = np.where(np.isnan(V), -np.inf, V)
    lowest = np.fmin.accumulate(V, axis=1)
    found: Array = np.max(known - lowest, axis=1) / V[:, 0]
    return np.where(np.isnan(found), np.inf, found)


# The basin ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Basin:
    """Settling times on a grid of planar starts at rest.

    Parameters
    ----------
    law : str
        The law.
    angles : (n,)
        Angles of the grid, rad: of the rod from its goal along the columns, of the thrust axis along the rows.
    settling : (n, n)
        Settling time, s; NaN where the flight does not settle, or the law is not defined.
    domain : (n, n)
        The law's distance from its exceptional set: the least 1 + cosine of the angles to the targets.
    unresolved : (n, n) bool
        Which flights began in the domain and ended as singular: they came closer to the exceptional set than double
        precision resolves.
    """

    law: str
    angles: NDArray[np.float64]
    settling: NDArray[np.float64]
    domain: NDArray[np.float64]
    unresolved: NDArray[np.bool_]

    @property
    def edge(self) -> float:
        """1 + cosine one step of the grid away from an exceptional set."""
        return float(1 - np.cos(self.angles[1] - self.angles[0]))


def basin(law: Law, vehicle: Vehicle, points: int) -> Basin:
    """Fly `vehicle` under `law` from `points`² planar starts in the ideal plant, for `SETTLE` seconds each."""
    angles = np.linspace(-np.pi, np.pi, points)
    rod, axis = (grid.ravel() for grid in np.meshgrid(angles, angles))
    starts = planar(rod, axis)
    target = Criterion(target="e3", position=np.inf) if law.reference is None else Criterion()
    flown = simulate_ensemble(vehicle, law, starts, SETTLE, plant="ideal", rtol=1e-8, criterion=target)
    loop = symbolic_loop(vehicle, law)
    distance = ca.Function("domain", [loop.t, loop.s], [loop.signals["domain"]])(0.0, starts.packed().T)
    square = (points, points)
    return Basin(
        law.name,
        angles,
        np.where(flown.success, flown.settling, np.nan).reshape(square),
        np.array(distance).reshape(square),
        ((flown.cause == "singular") & (flown.end > 0)).reshape(square),
    )


def planar(rod: NDArray[np.float64], axis: NDArray[np.float64]) -> State:
    """Return states at rest (n,) with y and z turned by the angles `rod` and `axis` (n,), rad, from e₃ towards e₁."""
    zero, one = np.zeros_like(rod), np.ones_like(rod)
    s, c = np.sin(axis), np.cos(axis)
    R = np.stack([np.stack(row, -1) for row in ((c, zero, s), (zero, one, zero), (-s, zero, c))], -2)
    return State(y=np.stack([np.sin(rod), zero, np.cos(rod)], -1), R=R)
