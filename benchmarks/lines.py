"""What the kernels cost in other settings, each as a ratio with its goal."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np

import flypend as fp
from benchmarks import clock
from benchmarks.peak import flops_per_second
from benchmarks.problem import Problem
from flypend.compile.problem import EquationsProblem
from flypend.flight.criterion import Criterion
from flypend.flight.kernels import ideal_kernel, sampled_kernel
from flypend.flight.kernels.ideal import Moments, call
from flypend.flight.kernels.sampled import sampled_problem
from flypend.flight.request import Tolerances
from flypend.plants import MOTION_CAPTURE, ROTORS, Ideal, Wind
from flypend.plants.loop import Loop

DECADES = range(3, 8)


class Line(NamedTuple):
    """A figure: its `value`, what it is, the goal with its sense ("" for none), and the `old` figure of version 0.1."""

    name: str
    value: float
    unit: str
    goal: str = ""
    old: float | None = None

    @property
    def met(self) -> bool | None:
        """Whether the goal is reached."""
        if not self.goal:
            return None
        sense, number = self.goal.split()
        return bool(self.value >= float(number) if sense == "≥" else self.value <= float(number))


def scaled(runs: int, share: float) -> int:
    """Return a `share` of so many runs, but at least two vectors full."""
    return max(16, round(share * runs))


def threads(problem: Problem, share: float) -> Iterator[Line]:
    """All threads over one."""
    kernel = ideal_kernel(problem.loop, method="dp5")
    starts, count = problem.starts(scaled(16384, share)), os.cpu_count() or 1
    one, all_ = (partial(kernel.fly, starts, problem.duration, Tolerances(rtol=1e-6), workers=n) for n in (1, count))
    alone, together = clock.wall(one, all_)
    yield Line(f"{count} threads over one, on the wall", alone / together, "×", "≥ 1.85")
    # On a machine that others use, too, the wall says little: what do the threads cost each other in processor time?
    alone, together = clock.processor(one, all_)
    yield Line(f"{count} threads over one, if both had a core to themselves", count * alone / together, "×", "≥ 1.85")


def sampling(problem: Problem, share: float) -> Iterator[Line]:
    """What it costs to keep, or to judge, 100 states of a run."""
    kernel = ideal_kernel(problem.loop, method="dp5")
    starts, times = problem.starts(scaled(4096, share)), np.linspace(0, problem.duration, 100)
    fly = partial(kernel.fly, starts, problem.duration, Tolerances(rtol=1e-6), workers=1)
    # The memory of the states comes from the operating system, which fills it with zeros first: that is told apart.
    there = fly(keep_at=times)
    nothing, limits = np.zeros((len(starts), 0)), (problem.duration, Tolerances(rtol=1e-6))
    never = np.zeros(1, dtype=np.int64)
    tasks = [
        fly,
        partial(call, kernel.function, starts, nothing, *limits, Moments.of(keep_at=times), there, never),
        partial(fly, keep_at=times),
        partial(fly, judge_at=times),
    ]
    none, kept, new, judged = clock.processor(*tasks, repeats=8)
    yield Line("keeping 100 states, above none", 100 * (kept / none - 1), "%", "≤ 25")
    yield Line("keeping 100 states in new memory, above none", 100 * (new / none - 1), "%")
    yield Line("judging at 100 times, above none", 100 * (judged / none - 1), "%")


def floats(problem: Problem, share: float) -> Iterator[Line]:
    """Floats over doubles at 1e-3."""
    starts, tasks = problem.starts(scaled(8192, share)), []
    for precision in ("double", "float"):
        kernel = ideal_kernel(problem.loop, method="dp5", precision=precision)
        tasks.append(partial(kernel.fly, starts, problem.duration, Tolerances(rtol=1e-3), workers=1))
    double, single = clock.processor(*tasks)
    yield Line("corrected law, rtol 1e-3, doubles", len(starts) / double, "runs/s")
    yield Line("corrected law, rtol 1e-3, floats", len(starts) / single, "runs/s")
    yield Line("floats over doubles", double / single, "×", "≥ 1.8")


def inverted(problem: Problem, share: float) -> Iterator[Line]:
    """Ten seconds of the inverted law on the ideal plant."""
    vehicle = fp.vehicle("hehn2011")
    law = fp.laws.inverted().bind(vehicle)
    starts = fp.State.random(np.random.default_rng(0), scaled(2048, share)).packed()
    kernel = ideal_kernel(Loop(vehicle, law, Ideal()), method="dp5")
    for rtol, goal in ((1e-6, "≥ 25000"), (1e-3, "")):
        (seconds,) = clock.processor(partial(kernel.fly, starts, 10.0, Tolerances(rtol=rtol), workers=1))
        yield Line(f"inverted law, 10 s, ideal plant, rtol {rtol:.0e}", len(starts) / seconds, "runs/s", goal)


def judging(problem: Problem, share: float) -> Iterator[Line]:
    """What the default judging, every 10 ms, leaves of the speed on the ideal plant."""
    vehicle, starts = fp.vehicle("hehn2011"), fp.State.random(np.random.default_rng(0), scaled(2048, share))
    law = fp.laws.inverted().bind(vehicle)
    for method in ("dp5", "dop853"):
        kernel = ideal_kernel(Loop(vehicle, law, Ideal()), method=method)
        unjudged = partial(kernel.fly, starts.packed(), 10.0, Tolerances(rtol=1e-6), workers=1)
        judged = partial(
            fp.simulate_ensemble, vehicle, law, starts, 10.0, plant="ideal", rtol=1e-6, method=method, workers=1
        )
        plain, full = clock.processor(unjudged, judged)
        yield Line(f"inverted law, {method}, judged every 10 ms over unjudged", plain / full, "×", "≥ 0.75")


def rotors(problem: Problem, share: float) -> Iterator[Line]:
    """Ten seconds of the inverted law with rotors at 500 Hz, judged every 10 ms, without and with noise and gusts."""
    vehicle = fp.vehicle("hehn2011")
    law = fp.laws.inverted().bind(vehicle)
    starts = fp.State.random(np.random.default_rng(0), scaled(128, share)).packed()
    windy = Wind(gust_on_vehicle=0.3, gust_on_bob=0.03)
    loops = [Loop(vehicle, law, p) for p in (ROTORS, ROTORS.replace(noise=MOTION_CAPTURE, wind=windy))]
    ticks = np.arange(0, 5001, 5)
    tasks = [partial(sampled_kernel(loop, Criterion()).fly, starts, 10.0, judge_at=ticks, workers=1) for loop in loops]
    clean, noisy = (len(starts) / seconds for seconds in clock.processor(*tasks))
    yield Line("inverted law, 10 s, rotors at 500 Hz", clean, "flights/s")
    yield Line("the same with noise, gusts and observer", noisy / clean, "×", "≥ 0.6")
    total = 0.0
    for part, operations in operations_per_tick(loops[0], ticks).items():
        yield Line(f"operations per control tick: {part}", operations, "")
        total += operations
    share = 100 * clean * 10.0 * loops[0].sampled.rate * total / flops_per_second()
    yield Line("operations per second over the peak of multiply-adds", share, "%", "≥ 45")


def operations_per_tick(loop: Loop, judged: Any) -> dict[str, float]:
    """Operations of a flight per control tick, by part; `judged` are the ticks at which it is judged."""
    problem = sampled_problem(loop, Criterion())
    assert isinstance(problem.world, EquationsProblem)
    names = {"command": "law and allocation", "twin": "prediction", "observe": "observer", "rotor": "rotor model",
             "find": "search for the delay"}  # fmt: skip
    parts: dict[str, float] = {}
    for called in problem.board.calls:
        program = problem.board.programs[called.program]
        part = names.get(program.name.split("_")[0], program.name)  # a program that is new here has its own name
        parts[part] = parts.get(part, 0.0) + sum(program.counts().values())
    steps = sum(stretch.steps for stretch in problem.flown)
    parts["plant"] = steps * sum(problem.world.step.counts().values())
    parts["judging"] = sum(problem.judge.counts().values()) * (len(judged) - 1) / judged[-1]
    return parts


def sizes(problem: Problem, share: float) -> Iterator[Line]:
    """Cost of a run in ensembles of a thousand to a million, all threads, judged every 50 ms."""
    kernel = ideal_kernel(problem.loop, method="dp5")
    times, cores = np.linspace(0, problem.duration, 131), os.cpu_count() or 1
    costs = {}
    for decade in DECADES:
        starts = problem.starts(scaled(10**decade, share))
        fly = partial(kernel.fly, starts, problem.duration, Tolerances(rtol=1e-6), judge_at=times)
        begin = time.perf_counter()
        (seconds,) = clock.processor(fly, repeats=1 if decade >= 6 else 3)
        costs[decade] = 1e6 * seconds / len(starts)
        yield Line(f"cost of a run among 10^{decade}, judged every 50 ms, on a core", costs[decade], "µs")
        if decade == 6:
            yield Line(f"a million runs on {cores} cores of their own", seconds / cores, "s", "≤ 20")
            yield Line("a million runs on the wall", time.perf_counter() - begin, "s")
    yield Line("dearest over cheapest run, 10^3 to 10^7", max(costs.values()) / min(costs.values()), "×", "≤ 1.25")


# What each line is printed by: (problem, share of the runs that count) → lines.
LINES = (threads, sampling, floats, inverted, judging, rotors, sizes)
