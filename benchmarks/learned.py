"""The learned law beside the tuned one, the regulator, and plans that are tracked: `python -m benchmarks.learned`.

The same random starts of hehn2011 for all, which no training and no tuning has seen, 10 s each. Options: --runs,
--seed, --plant (rotors, mujoco), --mount (gimbal, hub: its rod is free at first), --law (repeatable; default learned,
inverted, lqr), --plans (how many of the starts are also planned and tracked), --policy.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

import numpy as np

import flypend as fp
from benchmarks.mounts import free
from flypend.flight.metrics import wilson


def flights(vehicle: fp.Vehicle, starts: fp.State, asked: Any) -> Iterator[tuple[str, Any, Any, Any]]:
    """Yield names, success, excursion (m) and settling time (s) of all flights, law by law."""
    laws = {
        "learned": lambda: fp.laws.learned(**({"policy": asked.policy} if asked.policy else {})),
        "inverted": fp.laws.inverted,
        "lqr": fp.laws.lqr,
    }
    for name in asked.law or laws:
        law = laws[name]()
        runs = fp.simulate_ensemble(vehicle, law, starts, duration=asked.duration, plant=asked.plant)
        yield name, runs.success, runs.excursion, runs.settling
    if asked.plans:
        yield "plan and track", *tracked(vehicle, starts[: asked.plans], asked)


def tracked(vehicle: fp.Vehicle, starts: fp.State, asked: Any) -> tuple[Any, Any, Any]:
    """Return success, excursion and settling time of planned flights with feedback."""
    rows = []
    for i in range(len(starts)):
        plan = fp.plan(vehicle, starts[i])
        if not plan:
            rows.append((False, np.nan, np.nan))
            continue
        result = fp.metrics(fp.simulate(vehicle, fp.track(plan), starts[i], asked.duration, plant=asked.plant))
        rows.append((result.success, result.excursion, result.settling))
    return tuple(np.array(column) for column in zip(*rows, strict=True))  # type: ignore[return-value]


def main() -> None:
    """Fly, and print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=88001)
    parser.add_argument("--plant", default="rotors")
    parser.add_argument("--mount", default="gimbal")
    parser.add_argument("--plans", type=int, default=0)
    parser.add_argument("--law", action="append")
    parser.add_argument("--policy")
    parser.add_argument("--duration", type=float, default=10.0)
    asked = parser.parse_args()
    vehicle = fp.vehicle("hehn2011").replace(mount=asked.mount)
    starts = fp.random_starts(asked.runs, asked.seed)
    if asked.mount == "hub":
        starts = free(starts, vehicle)
    print(f"{asked.plant}, {asked.mount}, seed {asked.seed}\n")
    print("| law | stand | 95 % interval | excursion p50, p95 (m) | settling p50 (s) |")
    print("|---|---|---|---|---|")
    for name, success, excursion, settling in flights(vehicle, starts, asked):
        low, high = wilson(int(success.sum()), len(success))
        p50, p95 = np.quantile(excursion[np.isfinite(excursion)], (0.5, 0.95))
        print(
            f"| {name} | {success.sum()} of {len(success)} | {low:.2%} to {high:.2%} | {p50:.2f}, {p95:.2f} | "
            f"{np.median(settling[success]):.1f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
