"""What a study of 10⁸ flights costs, from one that is flown here: `python -m benchmarks.scale --runs 20000`.

The inverted law on hehn2011 through rotors, noise, gusts and its observer at 500 Hz, judged every 10 ms, from random
starts, into a Zarr store. Prints what was measured, and from it the plan of docs/studies/studies.md. `--runs 10000000
--out ten.zarr` flies ten million, a matter of hours; after an interruption, the same command goes on, and what it
prints then counts the rest only.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from pathlib import Path
from typing import Any, NamedTuple

import flypend as fp
from benchmarks.results import machine

MANY = 10**8
CORES = (2, 64, 1024)
LONG = 10.0  # s: the flights that are planned
CHUNK = 32_768  # runs of a task of the plan, a file in each column: minutes of flight, and thousands of files


def study(runs: int, duration: float) -> dict[str, Any]:
    """The study as its TOML file would have it."""
    return {
        "vehicle": "hehn2011", "law": {"name": "inverted"}, "duration": duration, "runs": runs, "judge_period": 0.01,
        "plant": {
            "base": "rotors", "wind": {"gust_on_vehicle": 0.1, "gust_on_bob": 0.01},
            "noise": {"x": 1e-3, "x_dot": 1e-2, "attitude": 2e-3, "omega": 1e-2, "y": 2e-3, "y_dot": 2e-2},
        },
        "vary": {"start": {
            "y": "uniform", "R": "uniform", "omega": {"ball": 3.0}, "y_dot": {"disc": 3.0}, "x_dot": {"ball": 2.0}
        }},
    }  # fmt: skip


class Cost(NamedTuple):
    """What a study took: runs, seconds of processor and of wall, bytes and columns of its store."""

    runs: int
    processor: float
    wall: float
    size: int
    columns: int


def flown(path: Path, runs: int, duration: float, workers: int) -> Cost:
    """Fly the study into a new store at `path`."""
    fp.sweep(study(1, duration), path.with_name("first.zarr"), workers=1)  # compiles
    before, begin = time.process_time(), time.perf_counter()
    data = fp.sweep(study(runs, duration), path, workers=workers)
    spent = time.process_time() - before, time.perf_counter() - begin
    size = sum(file.stat().st_size for file in path.rglob("*") if file.is_file())
    return Cost(runs, *spent, size, len(data.data_vars))


def plan(cost: Cost, duration: float, runs: int = MANY) -> list[str]:
    """Rows of a table: what `runs` flights of `LONG` seconds need, in proportion to `cost`."""
    flight, size = cost.processor / cost.runs * LONG / duration, cost.size / cost.runs
    tasks = -(-runs // CHUNK)
    hours = runs * flight / 3600
    return [
        f"| processor time of a flight of {LONG:g} s, storing included | {1e3 * flight:.2f} ms |",
        f"| core-hours | {hours:,.0f} |",
        *(f"| on {cores:,} such cores | {hours / cores:,.1f} h |" for cores in CORES),
        f"| store | {runs * size / 1e9:.1f} GB, {size:.0f} bytes a run, {tasks * cost.columns:,} files |",
        f"| tasks, with `chunk = {CHUNK}` | {tasks:,}, {CHUNK * flight:.0f} s and {CHUNK * size / 1e6:.1f} MB each |",
        f"| into the one process that writes, from {CORES[-1]:,} cores | {CORES[-1] * size / flight / 1e6:.2f} MB/s |",
    ]


def main() -> None:
    """Fly, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=20_000)
    parser.add_argument("--duration", type=float, default=LONG, help="seconds per flight")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--out", type=Path, help="store to keep (.zarr); default a temporary one")
    given, where = parser.parse_args(), machine()
    with tempfile.TemporaryDirectory() as folder:
        path = given.out or Path(folder) / "scale.zarr"
        cost = flown(path, given.runs, given.duration, given.workers)
    print(
        f"{where['processor']}, {where['cores']} cores (load {where['load']:.1f}), {where['date']}. Measured: "
        f"{cost.runs:,} flights of {given.duration:g} s, {cost.processor:.0f} s of processor, {cost.wall:.0f} s on the "
        f"wall with {given.workers} threads, a store of {cost.size / 1e6:.1f} MB.\n"
    )
    print(f"| {MANY:,} flights of {LONG:g} s | |\n|---|---|", *plan(cost, given.duration), sep="\n")


if __name__ == "__main__":
    main()
