"""Plans on random starts of hehn2011: how good, how long it takes, how they are flown.

python -m benchmarks.plans --runs 60 --seed 2211 --plant mujoco
python -m benchmarks.plans --runs 24 --seed 2211 --guesses 10
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

import flypend as fp
from flypend.flight.metrics import wilson
from flypend.planning import guess

VEHICLE = fp.vehicle("hehn2011")
REPEATS = 3  # of each plan, of which the least processor time counts
PATIENT = 600.0  # s: a busy machine must not decide


def best_of(start: fp.State, plan: fp.Plan, times: int, rng: np.random.Generator) -> fp.Plan:
    """Return the plan of least excursion from `times` as many guesses: the styles, and others drawn about them."""
    kept = guess.PUMPS.copy()
    for _ in range(times - 1):
        guess.PUMPS[:, [0, 1, 2, 4]] = kept[:, [0, 1, 2, 4]] * np.exp(rng.normal(scale=0.5, size=(len(kept), 4)))
        other = fp.plan(VEHICLE, start, time_limit=PATIENT)
        plan = other if other and other.excursion < plan.excursion else plan
    guess.PUMPS[:] = kept
    return plan


def quantiles(values: Any, *shares: float) -> str:
    """Format quantiles of `values`."""
    return ", ".join(f"{value:.3g}" for value in np.quantile(values, shares))


def main() -> None:
    """Plan, and print what came of it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=2211)
    parser.add_argument("--plant")
    parser.add_argument("--guesses", type=int, default=1)
    asked = parser.parse_args()
    starts, rng = fp.random_starts(asked.runs, asked.seed), np.random.default_rng(asked.seed)
    runs = [starts[i] for i in range(asked.runs)]
    plans = [[fp.plan(VEHICLE, start, time_limit=PATIENT) for _ in range(REPEATS)] for start in runs]
    first, good = [tried[0] for tried in plans], [bool(tried[0]) for tried in plans]
    spent = [1e3 * min(plan.solve_time for plan in tried) for tried in plans]
    excursions = quantiles([plan.excursion for plan in first], 0.5, 0.95)
    low, high = wilson(sum(good), len(good))
    print(f"planned: {sum(good)} of {len(good)} ({low:.1%} to {high:.1%})")
    print(f"excursion p50, p95: {excursions} m")
    print(f"guesses p50: {np.median([plan.guesses for plan in first]):.0f}")
    print(f"processor time p50, p99: {quantiles(spent, 0.5, 0.99)} ms", flush=True)
    if asked.guesses > 1:
        best = [best_of(start, plan, asked.guesses, rng) for start, plan in zip(runs, first, strict=True)]
        ratio = np.array([plan.excursion / other.excursion for plan, other in zip(first, best, strict=True)])
        told = f"{np.sum(ratio > 1.02)} improve by 2 %, {np.sum(ratio > 1.1)} by 10 %"
        print(f"{asked.guesses} times the guesses: {told}; ratio p50, p95: {quantiles(ratio, 0.5, 0.95)}")
    if asked.plant:
        pairs = [(s, p) for s, p in zip(runs, first, strict=True) if p]
        flown = [fp.metrics(fp.simulate(VEHICLE, fp.track(p), s, p.duration + 3, plant=asked.plant)) for s, p in pairs]
        stood = sum(result.success for result in flown)
        low, high = wilson(stood, len(runs))
        print(f"flown on {asked.plant}: {stood} of {len(runs)} stand ({low:.1%} to {high:.1%}),")
        ratio = [result.excursion / p.excursion for result, (_, p) in zip(flown, pairs, strict=True)]
        print(f"excursion p50, p95: {quantiles([r.excursion for r in flown], 0.5, 0.95)} m,", end=" ")
        print(f"ratio to the plan p50, p95: {quantiles(ratio, 0.5, 0.95)}")


if __name__ == "__main__":
    main()
