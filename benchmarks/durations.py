"""How good the search over durations is, on random starts of hehn2011.

python -m benchmarks.durations shortest --runs 20 --seed 4711
python -m benchmarks.durations longer --runs 40 --seed 4712

The least time is compared with the least of a slow search: from hanging and from random starts, `ROUNDS` times as many
guesses, drawn about those of the planner, from longer flights, in more stages, with more iterations and finer steps.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any
from unittest.mock import patch

import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.planning import durations, guess

HEHN = fp.vehicle("hehn2011")
HANGING = fp.State(y=(0, 0, -1))
LONGER = (1.5, 2.0, 2.5, 3.0, 4.0, 6.0)  # s
ROUNDS = 2
WORSE = 0.02  # share of the time by which a plan may miss the reference


@contextmanager
def slow(rng: np.random.Generator, loose: float) -> Iterator[None]:
    """Let the search be slow, with guesses that are drawn."""
    pumps = guess.PUMPS.copy()
    pumps[:, [0, 1, 2, 4]] *= np.exp(rng.normal(scale=0.5, size=(len(pumps), 4)))
    steps = {0.04: 1.0, 0.02: 0.1, 0.01: 0.05, 0.005: 0.02, 0.0025: 0.01, 0.00125: 0.01}
    with (
        patch.multiple(guess, PUMPS=pumps, AZIMUTHS=rng.uniform(0, 2 * np.pi, 8), BUMPS_ASIDE=rng.uniform(0.1, 1.5, 2)),
        patch.multiple(durations, LOOSE=loose, TRIES=100, STEPS=MappingProxyType(steps), MOST=24, FEWEST=96),
    ):
        yield


def shortest(starts: list[fp.State], rng: np.random.Generator) -> None:
    """Compare the least times with those of the slow search."""
    ratio, spent = [], []
    for i, start in enumerate(starts):
        begin = time.thread_time()
        plan = fp.plan(HEHN, start, "time")
        spent.append(time.thread_time() - begin)
        times = [plan.duration]
        for loose in np.linspace(1.15, 1.4, ROUNDS):
            with slow(rng, loose):
                times.append(fp.plan(HEHN, start, "time").duration)
        ratio.append(plan.duration / min(times))
        print(f"{i:2d}: {plan.duration:.3f} s, reference {min(times):.3f} s, ratio {ratio[-1]:.3f}", flush=True)
    good = sum(each <= 1 + WORSE for each in ratio)
    low, high = wilson(good, len(ratio))
    print(f"within {WORSE:.0%} of the reference: {good} of {len(ratio)} ({low:.1%} to {high:.1%})")
    print(f"ratio p50, worst: {np.median(ratio):.3f}, {max(ratio):.3f}")
    print(f"processor time p50, worst: {np.median(spent):.2f}, {max(spent):.2f} s")


def longer(starts: list[fp.State], _: Any) -> None:
    """Plan with more and more time, and tell by how much the excursion ever grows."""
    grown, kept = [], 0
    for start in starts:
        plans = [fp.plan(HEHN, start, duration=duration) for duration in LONGER]
        best = np.inf
        for plan in plans:
            if np.isfinite(best):
                grown.append(plan.excursion / best if plan else np.inf)
            best = min(best, plan.excursion if plan else np.inf)
        kept += sum(bool(plan) and plan.duration < allowed - 1e-6 for plan, allowed in zip(plans, LONGER, strict=True))
    print(f"more time, {len(grown)} pairs: excursion worse by 1 % in {sum(each > 1.01 for each in grown)},")
    print(f"at most by a factor of {max(grown):.3f}; in {kept} plans a shorter flight was better")


def main() -> None:
    """Run one of the benchmarks."""
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=("shortest", "longer"))
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--seed", type=int, default=4711)
    asked = parser.parse_args()
    drawn = fp.random_starts(asked.runs - 1, asked.seed)
    starts = [HANGING, *(drawn[i] for i in range(asked.runs - 1))]
    {"shortest": shortest, "longer": longer}[asked.what](starts, np.random.default_rng(asked.seed))


if __name__ == "__main__":
    main()
