"""The peers side by side, each at the tolerance at which its median error is that asked for."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any
from unittest.mock import patch

from benchmarks import clock
from benchmarks.peers import Peer, peers
from benchmarks.problem import Problem, matched, reference

ACCURACY_RUNS = 48
ROUNDS = 3
LOOSE = 1e-4


@dataclass
class Ready:
    """A peer that is compiled and has its tolerance: `alone` and `together` fly its runs on one core and on all."""

    peer: Peer
    row: dict[str, Any]
    alone: Callable[[], Any]
    together: Callable[[], Any] | None


def compare(say: Callable[[str], None], share: float = 1.0) -> tuple[list[dict[str, Any]], dict[str, str]]:
    """One row per peer that flies, and why the others do not, by name; nobody finds anything compiled.

    A `share` of the runs that count are flown.
    """
    with tempfile.TemporaryDirectory() as folder, patch.dict(os.environ, FLYPEND_CACHE=folder):
        return _compared(say, share)


def _compared(say: Callable[[str], None], share: float) -> tuple[list[dict[str, Any]], dict[str, str]]:
    problem, ready, missing = Problem(), [], {}
    starts = problem.starts(max(4, round(share * ACCURACY_RUNS)), seed=7)
    try:
        exact = reference(problem, starts)
    except ModuleNotFoundError as error:
        return [], {"peers": f"no reference, {error}"}
    for module, peer in peers():
        try:
            one = prepared(module, replace(peer, runs=max(2, round(share * peer.runs))), problem, starts, exact)
        except Exception as error:  # whatever it is: the others fly, and the table says who does not
            missing[peer.name] = f"{type(error).__name__}: {error}"
            say(f"{peer.name}: left out, {missing[peer.name]}")
        else:
            ready.append(one)
            say(f"{peer.name}: rtol {one.row['tolerance']:.0e}, first run after {one.row['cold']:.1f} s")
    # The peers take turns, so that all see the machine in the same moods.
    seconds = clock.processor(*(one.alone for one in ready), repeats=ROUNDS)
    threaded = [one for one in ready if one.together]
    together = clock.wall(*(one.together for one in threaded if one.together), repeats=ROUNDS)
    for one, spent in zip(ready, seconds, strict=True):
        one.row["per_core"] = one.peer.runs / spent
    for one, spent in zip(threaded, together, strict=True):
        one.row["all_cores"] = one.peer.runs / spent
        say(f"{one.peer.name}: {one.row['per_core']:.3g} runs/s and core")
    return [one.row for one in ready], missing


def prepared(module: str, peer: Peer, problem: Problem, starts: Any, exact: Any) -> Ready:
    """`peer`, compiled, at the tolerance that gives the error asked for."""
    begin = time.perf_counter()
    fly = peer.make(problem, 1)
    fly(starts[:1], LOOSE)
    first = time.perf_counter() - begin
    tolerance, median, most = matched(fly, starts, exact) if peer.accurate else (LOOSE, float("nan"), float("nan"))
    many = problem.starts(peer.runs)
    wide = peer.make(problem, os.cpu_count() or 1) if peer.threaded else None
    row = {
        "module": module, "name": peer.name, "note": peer.note, "tolerance": tolerance, "median_error": median,
        "error_95": most, "accurate": peer.accurate, "all_cores": None, "compile_and_first": first,
    }  # fmt: skip
    ready = Ready(
        peer,
        row,
        partial(fly, many, tolerance),
        None if wide is None else partial(wide, many, tolerance),
    )
    ready.alone()  # compiles for this number of runs, where that matters
    row["cold"], row["cold_again"] = cold(module, tolerance)
    return ready


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
