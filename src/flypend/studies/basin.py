"""The basin of inverted hover within rotor limits, as a number: how many random starts end in the certified set.

A flight of any law that enters the set of Theorem C converges if the almost global law takes over there
(`laws.supervised`). So the share of starts whose flights enter is the measure of the composite's basin under the
distribution of the starts, and k of n independent ones bound it from below (Clopper and Pearson, 1934).
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from flypend import errors
from flypend.files import whole
from flypend.flight.criterion import Criterion
from flypend.flight.ensemble import simulate_ensemble
from flypend.flight.tasks import free_starts, random_hanging
from flypend.geometry import Numbers
from flypend.laws import BoundLaw, almost_global, almost_global_lag, inverted
from flypend.laws.certified import CertifiedSet
from flypend.laws.lag import lead_law
from flypend.model import State, Vehicle
from flypend.plants import Ideal
from flypend.studies.starts import check_starts

CONFIDENCE = 0.95
CHUNK = 20_000  # flights at a time: 70 MB of states
DRAWS: dict[str, Callable[[np.random.Generator, int], State]] = {"random": State.random, "hanging": random_hanging}
TICK = 0.5  # s, how often a flight is asked whether it is in the set
# A flight counts as inside if it still is after SAFETY times what a looser tolerance changes. Those that are not are
# flown again, longer and at tighter ones: until (s), tolerance, tighter tolerance.
SAFETY = 10.0
PASSES = ((10.0, 1e-6, 1e-8), (40.0, 1e-9, 1e-11))


@dataclass(frozen=True)
class MeasuredBasin:
    """How many of `runs` random starts end in the certified set."""

    vehicle: str  # its name
    law: str  # name of the law that flies until the set is entered
    mount: str  # the vehicle's
    lag: bool  # whether rotors lag
    starts: str  # "random" or "hanging"
    c: float  # of the certified set, m²/s²
    yaw_rate: float  # of the certified set, rad/s
    runs: int
    seed: int  # of the starts
    entered: int  # flights that enter
    touched: int  # flights that do not enter and end where the rod touches a rotor disc or an arm
    again: int  # flights that were flown again, at tighter tolerances
    slowest: float | None  # longest time until a flight is inside, s; None if none is
    least: float  # largest share p of which they say, at 95 %, that starts outside the basin are fewer than 1 − p

    def save(self, path: str | Path) -> None:
        """Write the numbers to the file `path`, as JSON."""
        with whole.whole_file(path, (".json",)) as file:
            file.write_text(json.dumps(asdict(self), indent=2) + "\n", encoding="utf-8")


def measure_basin(
    vehicle: Vehicle,
    runs: int,
    seed: int,
    *,
    lag: bool = False,
    starts: str = "random",
    progress: Callable[[str, int, int], Any] = lambda *_: None,
) -> MeasuredBasin:
    """Fly `runs` random starts of `seed` within the rotor limits of `vehicle` until they are in the certified set.

    Theorem B must model the vehicle, on a gimbal or a hub. With `lag` rotors lag, by its `rotor_lag`, and begin at
    their minimum. Random `starts` are drawn like `random_starts`; hanging ones are level at rest at any heading, with
    the rod within 10° of straight down, uniform on that cap of the sphere. On a hub, they are those of them whose rod
    touches nothing. `progress` is called with (task, done, total).

    Raises InputError if runs, seed or starts are invalid, the theorem does not cover the vehicle, or the extra
    "studies" is missing.
    """
    errors.require("scipy", extra="studies", for_="basin")
    from scipy.stats import beta  # slow to import

    check_starts(runs, seed)
    errors.check_kind("lag", lag, bool)
    draw = DRAWS[errors.one_of("starts", starts, DRAWS)]
    law = (lead_law(inverted()) if lag else inverted()).bind(vehicle)
    progress("proving the certified set", 0, 1)
    certified = (almost_global_lag() if lag else almost_global()).bind(vehicle).certified_set()
    times, touched, again = [], 0, 0
    for begin in range(0, runs, CHUNK):
        progress("flying", begin, runs)
        rng = np.random.default_rng((seed, begin // CHUNK))
        batch = free_starts(vehicle, draw, rng, CHUNK)[: runs - begin]
        found, _ = _find_entry(law, certified, batch, *PASSES[0])
        left = np.flatnonzero(np.isnan(found))
        if len(left):
            again += len(left)
            found[left], touching = _find_entry(law, certified, batch[left], *PASSES[1])
            touched += int(np.sum(touching & np.isnan(found[left])))
        times.append(found)
    progress("flying", runs, runs)
    entering = np.concatenate(times)
    entered = int(np.sum(np.isfinite(entering)))
    least = float(beta.ppf(1 - CONFIDENCE, entered, runs - entered + 1)) if entered else 0.0
    slowest = float(np.nanmax(entering)) if entered else None
    return MeasuredBasin(
        vehicle.name, law.name, vehicle.mount, lag, starts, certified.c, certified.yaw_rate, runs, seed, entered,
        touched, again, slowest, least,
    )  # fmt: skip


def _find_entry(
    law: BoundLaw, certified: CertifiedSet, starts: State, until: float, loose: float, tight: float
) -> tuple[Numbers, Numbers]:
    """Return when flights from `starts` (n,) are inside for sure (n,), s, and which of them end at a touch (n,).

    The first is NaN for a flight that is not inside up to `until`.
    """
    times, lag = np.arange(TICK, until + TICK / 2, TICK), law.uses_wrench
    measures = []
    for rtol in (loose, tight):
        flown = simulate_ensemble(
            law.vehicle, law, starts, until, plant=Ideal(limits=True, lag=lag), rtol=rtol, times=times,
            judge_period=until, criterion=Criterion(position=np.inf),
        )  # fmt: skip
        assert flown.samples is not None
        measures.append(certified.ratios(flown.samples, flown.wrenches))
    rough, fine = measures
    inside = np.all(fine + SAFETY * np.abs(fine - rough) <= 1, axis=-1)  # false after a flight's end, which is NaN
    return np.where(np.any(inside, axis=1), times[np.argmax(inside, axis=1)], np.nan), flown.cause == "collided"
