"""nmpc on random starts of hehn2011 in MuJoCo, and the inverted law beside it: how many succeed, how far they go.

python -m benchmarks.nmpc --runs 60 --seed 2211
python -m benchmarks.nmpc --runs 60 --seed 2211 --row hub
python -m benchmarks.nmpc --runs 500 --seed 6200 --row nominal --keep flights --piece 100   # five times
python -m benchmarks.nmpc --runs 30 --seed 7401 --row floor --row walls

Rows with a constraint fly from those of the random starts that have a plan, made at leisure, which keeps it.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cache
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
BLOW, BLOWN = 4.0, (0.3, 2.0)  # m/s, and when, s
GUSTS = fp.Wind(on_vehicle=(0.4, 0.0, 0.0), gust_on_vehicle=0.1)  # N
EXACT, NEARLY = 1e-3, 1e-2  # m, by which a constraint that is kept, or nearly kept, may be broken in flight
STANDS = (0.1, 0.2)  # rad and m, from upright and from the origin in the last second: in wind hover leans


def off(i: int) -> dict[str, float]:
    """Return masses of run `i`: ten per cent larger or smaller in turn."""
    factor = 1.1 if i % 2 == 0 else 0.9
    return {"mass": factor, "bob_mass": factor}


def masses(i: int, *, equal: bool) -> dict[str, float]:
    """Return masses of run `i`: a fifth larger and smaller in turn, vehicle and bob alike or the other way round."""
    factors = (1.2, 0.8) if i % 2 == 0 else (0.8, 1.2)
    return {"mass": factors[0], "bob_mass": factors[0 if equal else 1]}


@cache
def blow(i: int) -> fp.Plant:
    """Return a plant that strikes the vehicle of run `i` once in its throw, which changes its speed by `BLOW`."""
    upright, law = fp.State(y=(0, 0, 1)), fp.laws.inverted()
    for seed in range(1000 * i, 1000 * (i + 1)):
        wind = fp.Wind(knock_on_vehicle=BLOW * VEHICLE.M, knock_period=DURATION)
        run = fp.simulate(VEHICLE, law, upright, BLOWN[1], plant=fp.Plant(wind=wind, seed=seed))
        jumps = np.linalg.norm(np.diff(run.x_dot, axis=0), axis=1)
        if np.max(jumps) > BLOW / 2 and run.t[np.argmax(jumps)] > BLOWN[0]:
            break
    return BY_MUJOCO.replace(wind=wind, seed=seed)


@dataclass(frozen=True)
class Row:
    """A row of the table: its title, its plant by number of the run, the delay that is told, and the vehicle."""

    title: str
    plant: Callable[[int], fp.Plant]
    latency: float = 0.0
    vehicle: fp.Vehicle = VEHICLE
    kept: fp.Constraints = field(default_factory=fp.Constraints)


KEPT = {
    "floor": fp.Constraints(floor=-0.7),
    "ceiling": fp.Constraints(ceiling=0.6),
    "walls": fp.Constraints(box=((-0.6, -0.6, -np.inf), (0.6, 0.6, np.inf))),
}
WALLED = {"floor": "floor at −0.7 m", "ceiling": "ceiling at 0.6 m", "walls": "walls at ±0.6 m"}
ROWS = {
    "nominal": Row("nominal", lambda _: BY_MUJOCO),
    "mismatch": Row(
        "masses ±10 %, 10 ms of known delay", lambda i: BY_MUJOCO.replace(mismatch=off(i), delay=DELAY), DELAY
    ),
    "untold": Row("masses ±10 %, 30 ms untold", lambda i: BY_MUJOCO.replace(mismatch=off(i), delay=3 * DELAY)),
    "mocap": Row("motion capture", lambda i: BY_MUJOCO.replace(sensors="mocap", seed=i)),
    "mocap-mismatch": Row(
        "masses ±10 %, 10 ms known, motion capture",
        lambda i: BY_MUJOCO.replace(mismatch=off(i), delay=DELAY, sensors="mocap", seed=i), DELAY,
    ),
    "masses": Row("masses ±20 %", lambda i: BY_MUJOCO.replace(mismatch=masses(i, equal=True))),
    "unequal": Row(
        "one mass +20 %, the other −20 %", lambda i: BY_MUJOCO.replace(mismatch=masses(i, equal=False))
    ),
    "weak": Row("thrust −15 %", lambda _: BY_MUJOCO.replace(strength=0.85)),
    "late": Row("20 ms untold", lambda _: BY_MUJOCO.replace(delay=2 * DELAY)),
    "gusts": Row("wind and gusts", lambda i: BY_MUJOCO.replace(wind=GUSTS, seed=i)),
    "mocap-masses": Row(
        "masses ±20 %, motion capture",
        lambda i: BY_MUJOCO.replace(mismatch=masses(i, equal=True), sensors="mocap", seed=i),
    ),
    "blow": Row("a blow of 4 m/s in mid-throw", blow),
    "hub": Row("hub", lambda _: BY_MUJOCO, vehicle=VEHICLE.replace(mount="hub")),
    **{name: Row(WALLED[name], lambda _: BY_MUJOCO, kept=kept) for name, kept in KEPT.items()},
    **{
        f"{name}-masses": Row(
            f"{WALLED[name]}, masses ±10 %", lambda i: BY_MUJOCO.replace(mismatch=off(i)), kept=kept
        )
        for name, kept in KEPT.items()
    },
}  # fmt: skip


@dataclass(frozen=True)
class Flight:
    """What came of run `i`: its excursion, that of `fp.plan` (None without one) and that of the law, m; times in s.

    `beyond` is by how much a constraint was broken, m: by nmpc, by nmpc that did not know of it, and by the law.
    """

    i: int
    stood: bool
    excursion: float
    best: float | None
    law_stood: bool
    law: float
    spent: list[float]
    beyond: list[float]


def beyond(run: Any, row: Row) -> float:
    """Return by how much pivot or rod of a `run` are beyond the walls of a `row`, m; negative if they keep them."""
    assert row.kept.walls is not None
    points = np.stack([run.x, run.x + row.vehicle.reach * run.y])
    return float(np.max(np.maximum(row.kept.walls[0] - points, points - row.kept.walls[1])))


FREE = "succeed | the law | excursion p50, p95, m | the law, m | less than the law | ratio p50, p95 | step p50, p99, ms"
WITHIN = "succeed | keep it | within 1 cm | most beyond, m | unaware | law"


def told(flights: Sequence[Flight]) -> list[str]:
    """Return the cells of the table's row: those of `WITHIN` if the flights had a constraint, else of `FREE`."""
    stood, runs = counted([flight.stood for flight in flights]), len(flights)
    if flights[0].beyond:
        by_nmpc, unaware, by_law = np.array([flight.beyond for flight in flights]).T
        most = np.max(by_nmpc)
        counts = [
            str(np.sum(found <= bound)) for found, bound in ((by_nmpc, NEARLY), (unaware, EXACT), (by_law, EXACT))
        ]
        return [stood, counted(by_nmpc <= EXACT), counts[0], f"{most:.3g}" if most > EXACT else "none", *counts[1:]]
    ratio = [flight.excursion / flight.best for flight in flights if flight.best and flight.stood]
    spent = 1e3 * np.array([took for flight in flights for took in flight.spent])
    return [
        stood,
        counted([flight.law_stood for flight in flights]),
        quantiles([flight.excursion for flight in flights], 0.5, 0.95),
        quantiles([flight.law for flight in flights], 0.5, 0.95),
        f"{sum(flight.excursion < flight.law for flight in flights)} of {runs}",
        quantiles(ratio, 0.5, 0.95) if ratio else "—",
        quantiles(spent, 0.5, 0.99),
    ]


def counted(good: Any) -> str:
    """Format how many are good, with the Wilson interval of 95 %."""
    low, high = wilson(int(np.sum(good)), len(good))
    return f"{np.sum(good)} of {len(good)} ({low:.1%} to {high:.1%})".replace("%", " %")


def stands(run: Any) -> bool:
    """Return whether rod and pivot stayed near hover in the last second of a `run`."""
    last = run.t > DURATION - 1
    lean, off = np.arccos(run.y[last, 2]), np.linalg.norm(run.x[last], axis=1)
    return bool(run.t[-1] > DURATION - 1e-6 and np.max(lean) < STANDS[0] and np.max(off) < STANDS[1])


def fly(row: Row, start: fp.State, i: int) -> tuple[Any, Pilot]:
    """Return the flight and the pilot of run `i` of a `row` from a `start`."""
    law, pilots = fp.nmpc(row.vehicle, latency=row.latency, constraints=row.kept), []

    def make(loop: Any, rotors: Any) -> Pilot:
        assert law.flight_computer is not None
        pilots.append(law.flight_computer(loop, rotors))
        return pilots[-1]  # type: ignore[no-any-return]

    run = fp.simulate(row.vehicle, replace(law, flight_computer=make), start, DURATION, plant=row.plant(i))
    return run, pilots[0]


def flown(row: Row, start: fp.State, i: int) -> Flight | None:
    """Fly run `i` of a `row` from a `start`, and plan from it; None if no plan keeps the constraint of the row."""
    try:
        best = fp.plan(row.vehicle, start, time_limit=PATIENT, constraints=row.kept)
    except fp.InputError:  # the start breaks it
        return None
    if row.kept.given and not best:
        return None
    run, pilot = fly(row, start, i)
    result = fp.metrics(run)
    by_law = fp.simulate(row.vehicle, fp.laws.inverted(), start, DURATION, plant=row.plant(i))
    law, stood = fp.metrics(by_law), [fp.metrics(flight).success for flight in (run, by_law)]
    if row.plant(i).wind is not None:
        stood = [stands(flight) for flight in (run, by_law)]
    if not stood[0] or len(pilot.changes) > 2:
        changes = "; ".join(f"{t:.2f} s {mode}, {why}" for t, mode, why in pilot.changes)
        print(f"  run {i}: {result.cause or 'stands'}, {changes}", file=sys.stderr, flush=True)
    excursion = best.excursion if best else None
    runs = [run, fly(replace(row, kept=fp.Constraints()), start, i)[0], by_law] if row.kept.given else []
    off = [beyond(flight, row) for flight in runs]
    return Flight(i, stood[0], result.excursion, excursion, stood[1], law.excursion, pilot.spent, off)


def flights_of(row: Row, starts: fp.State, kept: Path | None, piece: int) -> list[Flight]:
    """Return flights from `starts`: those `kept` in a file, a line each, and up to a `piece` that are flown now."""
    lines = kept.read_text().splitlines() if kept and kept.exists() else []
    flights = [Flight(**json.loads(line)) for line in lines]
    for i in sorted(set(range(len(starts))) - {flight.i for flight in flights})[:piece]:
        if (flight := flown(row, starts[i], i)) is None:
            continue
        flights.append(flight)
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
    names, columns = asked.row or list(ROWS), ""
    for name in names:
        row = ROWS[name]
        if columns != (columns := WITHIN if row.kept.given else FREE):
            print(f"\n| | {columns} |\n|{'---|' * (columns.count('|') + 2)}")
        if name == "hub":
            starts = task_starts(row.vehicle, asked.runs, asked.seed)["random"]
        else:
            starts = fp.random_starts(asked.runs, asked.seed)
        kept = asked.keep and asked.keep / f"{name}-{asked.seed}-{asked.runs}.jsonl"
        print(f"| {row.title} | {' | '.join(told(flights_of(row, starts, kept, asked.piece)))} |", flush=True)


if __name__ == "__main__":
    main()
