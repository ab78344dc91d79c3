"""nmpc on random starts of hehn2011 in MuJoCo: how many stand, how far they go, how long a step takes.

python -m benchmarks.nmpc --runs 60 --seed 2211
python -m benchmarks.nmpc --runs 60 --seed 2211 --row hub
python -m benchmarks.nmpc --runs 500 --seed 6200 --row nominal --keep flights --piece 100   # five times
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

import flypend as fp
from benchmarks.plans import quantiles
from flypend.flight.metrics import wilson
from flypend.flight.tasks import task_starts
from flypend.planning.receding_horizon import Pilot

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
    "untold": Row(lambda i: BY_MUJOCO.replace(mismatch=off(i), delay=3 * DELAY)),
    "mocap": Row(lambda i: BY_MUJOCO.replace(sensors="mocap", seed=i), 0.0),
    "mocap-mismatch": Row(lambda i: BY_MUJOCO.replace(mismatch=off(i), delay=DELAY, sensors="mocap", seed=i), DELAY),
    "hub": Row(lambda _: BY_MUJOCO, 0.0, VEHICLE.replace(mount="hub")),
}


@dataclass(frozen=True)
class Flight:
    """What came of run `i`: its excursion and that of `fp.plan` (m), None without a plan; times in s."""

    i: int
    stood: bool
    excursion: float
    best: float | None
    clearance: float
    changes: int
    spent: list[float]


def told(flights: Sequence[Flight]) -> str:
    """Return the row of the table."""
    stood, runs = sum(flight.stood for flight in flights), len(flights)
    low, high = wilson(stood, runs)
    ratio = [flight.excursion / flight.best for flight in flights if flight.best and flight.stood]
    kept, spent = [f.clearance for f in flights], [took for f in flights for took in f.spent]
    parts = [f"{stood} of {runs} ({low:.1%} to {high:.1%})"]
    parts += [f"excursion {quantiles([flight.excursion for flight in flights], 0.5, 0.95)} m"]
    parts += [f"ratio to the plan {quantiles(ratio, 0.5, 0.95)}"] if ratio else []
    parts += [f"step p50, p99 {quantiles(1e3 * np.array(spent), 0.5, 0.99)} ms"]
    parts += [f"clearance p5 {quantiles(kept, 0.05)} m"] if np.isfinite(kept[0]) else []
    return ", ".join([*parts, f"handed over more than twice: {sum(flight.changes > 2 for flight in flights)}"])


def fly(row: Row, start: fp.State, i: int) -> tuple[Any, Pilot]:
    """Return metrics and pilot of run `i` of a `row` from a `start`."""
    law, pilots = fp.nmpc(row.vehicle, latency=row.latency), []

    def make(loop: Any, rotors: Any) -> Pilot:
        assert law.flight_computer is not None
        pilots.append(law.flight_computer(loop, rotors))
        return pilots[-1]  # type: ignore[no-any-return]

    run = fp.simulate(row.vehicle, replace(law, flight_computer=make), start, DURATION, plant=row.plant(i))
    return fp.metrics(run), pilots[0]


def flown(row: Row, start: fp.State, i: int) -> Flight:
    """Fly run `i` of a `row` from a `start`, and plan from it."""
    result, pilot = fly(row, start, i)
    best = fp.plan(row.vehicle, start, time_limit=PATIENT)
    if not result.success or len(pilot.changes) > 2:
        changes = "; ".join(f"{t:.2f} s {mode}, {why}" for t, mode, why in pilot.changes)
        print(f"  run {i}: {result.cause or 'stands'}, {changes}", flush=True)
    excursion, changed = best.excursion if best else None, len(pilot.changes)
    return Flight(i, result.success, result.excursion, excursion, result.clearance, changed, pilot.spent)


def flights_of(row: Row, starts: fp.State, kept: Path | None, piece: int) -> list[Flight]:
    """Return flights from `starts`: those `kept` in a file, a line each, and up to a `piece` that are flown now."""
    lines = kept.read_text().splitlines() if kept and kept.exists() else []
    flights = [Flight(**json.loads(line)) for line in lines]
    for i in sorted(set(range(len(starts))) - {flight.i for flight in flights})[:piece]:
        flights.append(flown(row, starts[i], i))
        if kept:
            with kept.open("a") as file:
                file.write(json.dumps(asdict(flights[-1])) + "\n")
    return flights


def main() -> None:
    """Fly the rows, and print them."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=2211)
    parser.add_argument("--row", choices=ROWS, action="append")
    parser.add_argument("--keep", type=Path, help="a folder for what came of flights, which are not flown again")
    parser.add_argument("--piece", type=int, default=10**9, help="most flights of a row now")
    asked = parser.parse_args()
    if asked.keep:
        asked.keep.mkdir(parents=True, exist_ok=True)
    for name in asked.row or ROWS:
        row = ROWS[name]
        if name == "hub":
            starts = task_starts(row.vehicle, asked.runs, asked.seed)["random"]
        else:
            starts = fp.random_starts(asked.runs, asked.seed)
        kept = asked.keep and asked.keep / f"{name}-{asked.seed}-{asked.runs}.jsonl"
        print(f"{name}: {told(flights_of(row, starts, kept, asked.piece))}", flush=True)


if __name__ == "__main__":
    main()
