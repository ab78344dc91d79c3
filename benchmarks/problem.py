"""What is flown: the corrected law of the paper's vehicle from random starts, and how far off a result is."""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

import flypend as fp
from flypend.compile.program import Program, interpret
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.ideal import ideal_problem
from flypend.plants import Ideal
from flypend.plants.loop import Loop

TARGET = 1e-6
# Tolerances that are tried, loose to tight, until the median error meets the target.
LADDER = tuple(float(f"{mantissa}e-{decade}") for decade in range(3, 12) for mantissa in (5, 2, 1))


@dataclass(frozen=True)
class Problem:
    """The corrected law over `duration` seconds."""

    duration: float = 6.5

    @cached_property
    def vehicle(self) -> fp.Vehicle:
        """The paper's vehicle."""
        return fp.vehicle("nayak2018")

    @cached_property
    def law(self) -> Any:
        """The corrected law with the paper's gains."""
        return fp.laws.corrected(k_d=1, k_1=9, k_2=4).bind(self.vehicle)

    @cached_property
    def loop(self) -> Loop:
        """The closed loop."""
        return Loop(self.vehicle, self.law, Ideal())

    @cached_property
    def programs(self) -> Any:
        """The closed loop as scalar programs."""
        return ideal_problem(self.loop, Criterion())

    def starts(self, runs: int, seed: int = 0) -> Any:
        """Random packed states (runs, 24): y on S², R on SO(3), |omega|, |ẏ| ≤ 3 rad/s, |ẋ| ≤ 2 m/s, x = 0."""
        return fp.State.random(np.random.default_rng(seed), runs).packed()


def in_heyoka(program: Program) -> tuple[Sequence[Any], list[tuple[Any, Any]]]:
    """The program (t, s, p) → rates as a system of heyoka."""
    import heyoka as hy

    names = hy.make_vars(*(f"s{i}" for i in range(program.inputs[1])))
    operations = {
        "add": operator.add,
        "sub": operator.sub,
        "mul": operator.mul,
        "div": operator.truediv,
        "neg": operator.neg,
        "sqrt": hy.sqrt,
    }
    rates = interpret(program, [lambda _: hy.time, names.__getitem__], operations, hy.expression)[0]
    return names, list(zip(names, rates, strict=True))


def reference(problem: Problem, starts: Any) -> Any:
    """Final states by heyoka's Taylor series at 1e-15."""
    import heyoka as hy

    _, system = in_heyoka(problem.programs.rates)
    integrator = hy.taylor_adaptive(system, [0.0] * 24, tol=1e-15, compact_mode=True)
    out = np.empty_like(starts)
    for i, start in enumerate(starts):
        integrator.time = 0.0
        integrator.state[:] = start
        integrator.propagate_until(problem.duration)
        out[i] = integrator.state
    return out


def errors(final: Any, exact: Any) -> Any:
    """Largest error of each run, relative to 1 + |entry|: positions are up to 130 m."""
    return np.max(np.abs(final - exact) / (1 + np.abs(exact)), axis=1)


def matched(fly: Callable[[Any, float], Any], starts: Any, exact: Any) -> tuple[float, float, float]:
    """The loosest tolerance of the ladder with a median error of `TARGET` or less; that error, and that of 95 %."""
    for tolerance in LADDER:
        found = errors(fly(starts, tolerance), exact)
        if np.median(found) <= TARGET:
            return tolerance, float(np.median(found)), float(np.percentile(found, 95))
    raise RuntimeError("no tolerance met the target")
