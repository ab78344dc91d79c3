"""nmpc on random starts of hehn2011 in MuJoCo: how many stand, how far they go, how long a step takes.

python -m benchmarks.nmpc --runs 60 --seed 2211
python -m benchmarks.nmpc --runs 60 --seed 2211 --row hub
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

import flypend as fp
from benchmarks.plans import quantiles
from flypend.flight.metrics import wilson
from flypend.flight.tasks import task_starts
from flypend.planning.pilot import Pilot

VEHICLE = fp.vehicle("hehn2011")
DURATION = 10.0  # s
PATIENT = 600.0  # s: a busy machine must not decide
DELAY = 0.01  # s
BY_MUJOCO = fp.Plant(engine="mujoco")


def off(i: int) -> dict[str, float]:
    """Return masses of run `i`: ten per cent larger or smaller in turn."""
    factor = 1.1 if i % 2 == 0 else 0.9
    return {"mass": factor, "bob_mass": factor}


@dataclass(frozen=True)
class Row:
    """A row of the table: its plant by number of the run, the delay that is told, and the vehicle."""

    plant: Callable[[int], fp.Plant]
    latency: float = 0.0
    vehicle: fp.Vehicle = VEHICLE


ROWS = {
    "nominal": Row(lambda _: BY_MUJOCO),
    "mismatch": Row(lambda i: BY_MUJOCO.replace(mismatch=off(i), delay=DELAY), DELAY),
    "mocap": Row(lambda i: BY_MUJOCO.replace(sensors="mocap", seed=i), 0.0),
    "mocap-mismatch": Row(lambda i: BY_MUJOCO.replace(mismatch=off(i), delay=DELAY, sensors="mocap", seed=i), DELAY),
    "hub": Row(lambda _: BY_MUJOCO, 0.0, VEHICLE.replace(mount="hub")),
}


@dataclass
class Flown:
    """What came of a row."""

    stood: list[bool] = field(default_factory=list)
    excursion: list[float] = field(default_factory=list)
    ratio: list[float] = field(default_factory=list)
    clearance: list[float] = field(default_factory=list)
    spent: list[float] = field(default_factory=list)
    changes: list[int] = field(default_factory=list)

    def told(self) -> str:
        """Return the row of the table."""
        stood, runs = sum(self.stood), len(self.stood)
        low, high = wilson(stood, runs)
        flown = [f"{stood} of {runs} ({low:.1%} to {high:.1%})", f"excursion {quantiles(self.excursion, 0.5, 0.95)} m"]
        flown += [f"ratio to the plan {quantiles(self.ratio, 0.5, 0.95)}"] if self.ratio else []
        flown += [f"step p50, p99 {quantiles(1e3 * np.array(self.spent), 0.5, 0.99)} ms"]
        flown += [f"clearance p5 {quantiles(self.clearance, 0.05)} m"] if np.isfinite(self.clearance[0]) else []
        return ", ".join([*flown, f"handed over more than twice: {sum(n > 2 for n in self.changes)}"])


def fly(row: Row, start: fp.State, i: int) -> tuple[Any, Pilot]:
    """Return metrics and pilot of run `i` of a `row` from a `start`."""
    law, pilots = fp.nmpc(row.vehicle, latency=row.latency), []

    def make(loop: Any, rotors: Any) -> Pilot:
        assert law.flight_computer is not None
        pilots.append(law.flight_computer(loop, rotors))
        return pilots[-1]  # type: ignore[no-any-return]

    run = fp.simulate(row.vehicle, replace(law, flight_computer=make), start, DURATION, plant=row.plant(i))
    return fp.metrics(run), pilots[0]


def flown(row: Row, starts: fp.State, runs: int) -> Flown:
    """Fly `runs` of the `starts`."""
    found = Flown()
    for i in range(runs):
        result, pilot = fly(row, starts[i], i)
        best = fp.plan(row.vehicle, starts[i], time_limit=PATIENT)
        found.stood.append(result.success)
        found.excursion.append(result.excursion)
        found.ratio += [result.excursion / best.excursion] if best and result.success else []
        found.clearance.append(result.clearance)
        found.spent += pilot.spent
        found.changes.append(len(pilot.changes))
        if not result.success or len(pilot.changes) > 2:
            changes = "; ".join(f"{t:.2f} s {mode}, {why}" for t, mode, why in pilot.changes)
            print(f"  run {i}: {result.cause or 'stands'}, {changes}", flush=True)
    return found


def main() -> None:
    """Fly the rows, and print them."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=2211)
    parser.add_argument("--row", choices=ROWS, action="append")
    asked = parser.parse_args()
    for name in asked.row or ROWS:
        row = ROWS[name]
        if name == "hub":
            starts = task_starts(row.vehicle, asked.runs, asked.seed)["random"]
        else:
            starts = fp.random_starts(asked.runs, asked.seed)
        print(f"{name}: {flown(row, starts, asked.runs).told()}", flush=True)


if __name__ == "__main__":
    main()
