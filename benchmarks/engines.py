"""The engines of `simulate_ensemble` beside each other: python -m benchmarks.engines.

Runs per second of processor time, judged every 50 ms, the corrected law for 6.5 s at 1e-6 in the ideal plant.
"""

from __future__ import annotations

from functools import partial

import numpy as np

import flypend as fp
from benchmarks import clock
from benchmarks.problem import Problem

RUNS = 4096


def main() -> None:
    """Print a line for each engine."""
    problem = Problem()
    starts = fp.State.trusted(problem.starts(RUNS))
    fly = partial(
        fp.simulate_ensemble, problem.vehicle, problem.law, starts, problem.duration, plant="ideal", rtol=1e-6,
        judge_period=0.05, criterion=fp.Criterion(target="e3", position=np.inf), workers=1,
    )  # fmt: skip
    for engine in ("kernel", "jax"):
        (seconds,) = clock.processor(partial(fly, engine=engine), repeats=3)
        print(f"{engine}: {RUNS / seconds:,.0f} runs/s, {fly(engine=engine).rate:.2%} succeed", flush=True)


if __name__ == "__main__":
    main()
