"""The peers side by side, each at the tolerance at which its median error is that asked for."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks import clock
from benchmarks.peers import Peer, peers
from benchmarks.problem import Problem, matched, reference

ACCURACY_RUNS = 48
LOOSE = 1e-4


def compare(say: Any) -> list[dict[str, Any]]:
    """One row per peer that can be imported."""
    problem = Problem()
    starts = problem.starts(ACCURACY_RUNS, seed=7)
    exact = reference(problem, starts)
    rows = []
    for module, peer in peers():
        try:
            row = measure(module, peer, problem, starts, exact)
        except ModuleNotFoundError as missing:
            say(f"{peer.name}: left out, {missing}")
            continue
        say(f"{peer.name}: {row['per_core']:.3g} runs/s and core, rtol {row['tolerance']:.0e}")
        rows.append(row)
    return rows


def measure(module: str, peer: Peer, problem: Problem, starts: Any, exact: Any) -> dict[str, Any]:
    """Tolerance, errors, rates and times of one peer."""
    begin = time.perf_counter()
    fly = peer.make(problem, 1)
    fly(starts[:1], LOOSE)
    first = time.perf_counter() - begin
    few = starts[: min(len(starts), 4 * peer.runs)]
    tolerance, median, most = (
        matched(fly, few, exact[: len(few)]) if peer.accurate else (LOOSE, float("nan"), float("nan"))
    )
    many = problem.starts(peer.runs)
    fly(many, tolerance)  # compiles for this number of runs, where that matters
    (seconds,) = clock.processor(lambda: fly(many, tolerance), repeats=3)
    row = {
        "module": module, "name": peer.name, "note": peer.note, "tolerance": tolerance, "median_error": median,
        "error_95": most, "per_core": peer.runs / seconds, "accurate": peer.accurate, "all_cores": None,
        "compile_and_first": first,
    }  # fmt: skip
    if peer.threaded:
        wide = peer.make(problem, os.cpu_count() or 1)
        wide(many, tolerance)
        row["all_cores"] = peer.runs / clock.wall(lambda: wide(many, tolerance), repeats=3)[0]
    row["cold"], row["cold_again"] = cold(module, tolerance)
    return row


def cold(module: str, tolerance: float) -> tuple[float, float]:
    """Seconds from process start to the end of one run: with an empty cache, and with that of the first."""
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {"FLYPEND_CACHE": folder}
        command = [sys.executable, "-m", "benchmarks.cold", module, repr(tolerance)]
        found = []
        for _ in range(2):
            begin = time.perf_counter()
            root = Path(__file__).parents[1]
            subprocess.run(command, check=True, capture_output=True, env=environment, cwd=root)
            found.append(time.perf_counter() - begin)
    return found[0], found[1]
