"""A sixty-second trial with fifteen knocks, and every number of the model swept by ±25 %.

The protocol follows the one by which RealAIGym scores its pendula: uptime under random disturbances, and success
against errors of the model, one number at a time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend import errors, plants, signals
from flypend.flight.ensemble import Ensemble, fly_many
from flypend.flight.kernels import has_kernel
from flypend.flight.metrics import Count
from flypend.flight.request import Flight, bound_to
from flypend.flight.tasks import LEAST_RATE, task_starts
from flypend.laws import AnyLaw, inverted
from flypend.model import Vehicle
from flypend.plants import AnyPlant, Sampled, Wind
from flypend.studies.margins import count_of, for_each, mismatch

DURATION, KNOCKS = 60.0, 15  # s
UP = 0.95  # the rod counts as up while its bob is higher than this share of its length
SAMPLE = 0.05  # s, at which that is looked at
FACTORS = (0.75, 0.875, 1.125, 1.25)
RUNS, STEPPED_RUNS = 100, 8


@errors.named_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Trial:
    """The result of `trial`.

    Parameters
    ----------
    vehicle, law
        What flew, and the name of the law.
    knocked : Ensemble
        The flights with knocks.
    uptime : (n,)
        Share of each of these flights with the rod up: the bob above 0.95 of its length.
    standing : (n,)
        Whether the rod is up for more than half of the last 4 s.
    knock : float
        Speed that one impulse gives to the bob or the vehicle if it were free, m/s.
    sweeps : dict
        By number of the model: factor → successes and runs.
    """

    vehicle: Vehicle
    law: str
    knocked: Ensemble
    uptime: NDArray[np.float64]
    standing: NDArray[np.bool_]
    knock: float
    sweeps: Mapping[str, Mapping[float, Count]]

    def __repr__(self) -> str:
        """Return uptime and sweeps, a line each."""
        lines = [f"<Trial of {self.law} on {self.vehicle.name}: {len(self.uptime)} of 60 s with 15 knocks"]
        low, median = np.percentile(self.uptime, (5, 50))
        lines.append(f"  up {100 * median:.1f} % of the time (median; 5 % of flights less than {100 * low:.1f} %)")
        lines.append(f"  upright at the end: {int(self.standing.sum())} of {len(self.uptime)}")
        for name, row in self.sweeps.items():
            cells = ", ".join(f"×{factor:g} {100 * count.rate:.0f} %" for factor, count in row.items())
            lines.append(f"  {name}: {cells}")
        return "\n".join(lines) + ">"

    @property
    def robustness(self) -> float:
        """The mean success rate over all sweeps."""
        return float(np.mean([count.rate for row in self.sweeps.values() for count in row.values()]))

    def to_dict(self) -> dict[str, Any]:
        """Return uptimes and sweeps as plain numbers, lists and dicts, with Wilson intervals."""
        stands = Count(int(self.standing.sum()), len(self.uptime))
        low, high = stands.interval
        return {
            "vehicle": self.vehicle.to_dict(),
            "law": self.law,
            "knock": self.knock,
            "uptime": self.uptime.tolist(),
            "standing": {**stands.to_dict(), "wilson_low": low, "wilson_high": high},
            "robustness": self.robustness,
            "sweeps": {
                name: [{"factor": factor, **count.to_dict()} for factor, count in row.items()]
                for name, row in self.sweeps.items()
            },
        }


@errors.named_arguments
@signals.defer()
def trial(
    vehicle: Vehicle,
    law: AnyLaw | None = None,
    *,
    plant: str | AnyPlant = "rotors",
    runs: int | None = None,
    seed: int = 1,
    knock: float | None = None,
    workers: int | None = None,
    progress: Callable[[str, int, int], Any] = lambda *_: None,
) -> Trial:
    """Fly `vehicle` under `law` for a minute with fifteen random knocks, and sweep the numbers of the model.

    A flight with knocks starts with the rod hanging at rest, in a cup with the rod inside. In each interval of 4 s the
    vehicle and the bob are hit once, at a random moment, each in a random direction. The sweeps fly from random starts
    for 10 s, or for 30 s if 10 s are not enough with the true model. The law assumes `vehicle`, and one number of the
    world is 0.75, 0.875, 1.125 or 1.25 times as large.

    Parameters
    ----------
    vehicle, law, plant, seed, workers, progress
        As in `check`.
    runs : int, optional
        Flights with knocks, and flights at each value; default 100, or 8 for a law that is stepped in Python.
    knock : float, optional
        Speed that one impulse gives to the bob or the vehicle if it were free, m/s; default 0.3 √(g l).

    Raises
    ------
    InputError
        For the ideal plant, a vehicle that the law refuses or that cannot be lifted, and numbers out of range.
    """
    world, bound = plants.as_sampled(plant), bound_to(vehicle, law if law is not None else inverted())
    speed = 0.3 * float(np.sqrt(vehicle.g * vehicle.l)) if knock is None else errors.number("knock", knock, at_least=0)
    starts = task_starts(vehicle, RUNS if runs is None else errors.integer("runs", runs, 1), seed)
    random = starts["random"]
    flight = Flight(vehicle=vehicle, law=bound, starts=random.in_frame(bound.e3), duration=10.0, plant=world)
    if not has_kernel(flight) and runs is None:
        flight = flight.replace(starts=flight.starts[:STEPPED_RUNS])
    worlds = {
        name: {factor: world_with(factor) for factor in FACTORS} for name, world_with in swept(vehicle, world).items()
    }  # before anything flies: one may be out of range
    if fly_many(flight, workers=workers).rate < LEAST_RATE:
        flight = flight.replace(duration=30.0)
    again = np.resize(np.arange(len(starts.get("hanging", random))), flight.runs)
    from_rest = starts.get("hanging", random)[again].in_frame(bound.e3)
    hit = flight.through(knock_on(flight.vehicle, world, speed, DURATION / KNOCKS))
    sampled = hit.replace(starts=from_rest, duration=DURATION, times=np.arange(0.0, DURATION, SAMPLE))
    knocked = fly_many(sampled, workers=workers)
    progress("knocks", 1, 1)
    high = is_up(knocked)
    cells = [(name, factor) for name in worlds for factor in FACTORS]
    counts = for_each(
        flight, lambda cell: count_of(flight.through(worlds[cell[0]][cell[1]])), cells,
        lambda done, total: progress(f"sweep of {cells[done - 1][0]}", done, total),
    )  # fmt: skip
    sweeps: dict[str, dict[float, Count]] = {name: {} for name in worlds}
    for (name, factor), count in zip(cells, counts, strict=True):
        sweeps[name][factor] = count
    return Trial(
        vehicle=vehicle, law=bound.name, knocked=knocked, uptime=high.mean(axis=1),
        standing=high[:, -round(DURATION / KNOCKS / SAMPLE) :].mean(axis=1) > 0.5, knock=speed,
        sweeps=sweeps,
    )  # fmt: skip


def swept(vehicle: Vehicle, plant: Sampled) -> dict[str, Callable[[float], Sampled]]:
    """Return factor → plant, for each number of the model that is not zero."""
    heavy = ("rod_inertia",) if vehicle.rod_inertia > 0 else ()
    names = ("mass", "bob_mass", "rod_length", *heavy, "inertia", "arm", "drag_ratio")
    found = {name: mismatch(plant, {"arm": "rotor_positions"}.get(name, name)) for name in names}
    found["thrust"] = lambda factor: plant.replace(strength=factor * np.asarray(plant.strength))
    if plant.true_vehicle(vehicle).rotor_lag > 0:
        found["rotor_lag"] = mismatch(plant, "rotor_lag")
    if plant.delay > 0:
        found["delay"] = lambda factor: plant.replace(delay=plant.delay * factor)
    return found


def knock_on(vehicle: Vehicle, plant: Sampled, speed: float, period: float) -> Sampled:
    """Return `plant` with a knock of `speed`, m/s, of vehicle and bob in each `period`, s, on top of its wind."""
    knocks = {"knock_on_vehicle": speed * vehicle.mass, "knock_on_bob": speed * vehicle.bob_mass}
    return plant.replace(wind=Wind(**{**vars(plant.wind or Wind()), **knocks, "knock_period": period}))


def is_up(knocked: Ensemble) -> NDArray[np.bool_]:
    """Return for each sample (n, t) whether the rod is up: from the end of a flight on it is down."""
    assert knocked.samples is not None
    up = 1.0 if knocked.e3 == "up" else -1.0
    return np.asarray(up * np.nan_to_num(knocked.samples.y[..., 2], nan=-up) > UP)
