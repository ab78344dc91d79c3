"""Embedded Runge-Kutta integration in JAX of many runs at once, each with its own time and step size.

Step control and queue are those of `flypend.compile.llvm.runge_kutta`: a lane whose run has ended takes the next one.
So a few runs with many steps do not stall the others, and the result of a run does not depend on its neighbours.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from flypend.compile.jax.arrays import Function, as_jax
from flypend.compile.jax.judging import Judge, Judged, Taken
from flypend.compile.llvm.runge_kutta import (
    COMPLETED,
    DIVERGED,
    LEAST_FACTOR,
    MOST_FACTOR,
    SAFETY,
    SHORTEST,
    SINGULAR,
    TOO_MANY,
    TOO_SMALL,
    UNDEFINED,
)
from flypend.compile.methods import Method
from flypend.compile.problem import Problem
from flypend.model.state import MAX_STATE

FLYING, IDLE = -1, -2


class Lanes(NamedTuple):
    """L runs in progress: run index, time, next step (L,), state and rate (24, L), code, steps tried, last rejected.

    `wrench` (w, L) is that at s; `judged` holds the reductions so far, see `flypend.compile.jax.judging`.
    """

    run: Any
    t: Any
    h: Any
    s: Any
    rate: Any
    wrench: Any
    code: Any
    steps: Any
    rejected: Any
    judged: Judged


class Results(NamedTuple):
    """Final states (24, n+1), end times, codes, steps (n+1,), reductions (k, n+1); entry n is for idle lanes."""

    s: Any
    t: Any
    code: Any
    steps: Any
    reductions: Any


class Setting(NamedTuple):
    """Number of runs, duration, tolerances, maximum number of steps, and the sample times, ending with infinity."""

    count: Any

    duration: Any
    rtol: Any
    atol: Any
    max_steps: Any
    times: Any


class Progress(NamedTuple):
    """A flight of n runs between two pieces: its lanes, the next run to start, and the results so far."""

    lanes: Lanes
    following: Any
    results: Results


class Integrator(NamedTuple):
    """JAX functions that fly the first `setting.count` of n runs piece by piece.

    `begin`: starts (24, n), parameters (k, n), setting → progress, with no run started. `advance`: progress, starts,
    parameters, setting, largest number of steps → progress, and whether any run is still to be flown; it is recompiled
    for each n.
    """

    begin: Callable[..., Progress]
    advance: Callable[..., tuple[Progress, Any]]


def write_integrator(problem: Problem, method: Method, lanes: int) -> Integrator:
    """Return the integrator of `problem`, which flies up to `lanes` runs at a time."""
    import jax
    import jax.numpy as jnp

    step = _Step(problem, method)

    def started(run: Any, starts: Any, parameters: Any, setting: Setting) -> Lanes:
        place = jnp.minimum(run, starts.shape[1] - 1)
        begun = step.begin(run, starts[:, place], parameters[:, place], setting)
        return begun._replace(code=jnp.where(run < setting.count, begun.code, IDLE))

    def begin(starts: Any, parameters: Any, setting: Setting) -> Progress:
        rows, n = starts.shape
        numbers, codes = jnp.zeros(n + 1), jnp.zeros(n + 1, int)
        none = Results(jnp.zeros((rows, n + 1)), numbers, codes, codes, jnp.zeros((step.reductions, n + 1)))
        runs = jnp.arange(min(lanes, n))
        shapes = jax.eval_shape(started, runs, starts, parameters, setting)
        ended: Lanes = jax.tree.map(lambda some: jnp.zeros(some.shape, some.dtype), shapes)
        # Every lane has ended run n, which is none: the first step gives it its first run.
        ended = ended._replace(run=jnp.full(runs.shape, n), code=jnp.full(runs.shape, COMPLETED))
        return Progress(ended, jnp.asarray(0), none)

    def advance(progress: Progress, starts: Any, parameters: Any, setting: Setting, most: Any) -> tuple[Progress, Any]:
        n = starts.shape[1]

        def body(carry: tuple[Progress, Any]) -> tuple[Progress, Any]:
            (now, following, results), taken = carry
            now = step(now, parameters[:, jnp.minimum(now.run, n - 1)], setting)
            ended = (now.code != FLYING) & (now.code != IDLE)
            same = Progress(now, following, results)
            return jax.lax.cond(ended.any(), refilled, lambda same, _: same, same, ended), taken + 1

        def refilled(progress: Progress, ended: Any) -> Progress:
            now, following, results = progress
            place = jnp.where(ended, now.run, n)
            results = Results(
                results.s.at[:, place].set(now.s), results.t.at[place].set(now.t),
                results.code.at[place].set(now.code), results.steps.at[place].set(now.steps),
                results.reductions.at[:, place].set(
                    step.judge.reductions(now.judged, now.t, setting.times)
                ),
            )  # fmt: skip
            run = jnp.where(ended, following + jnp.cumsum(ended) - 1, now.run)
            fresh = started(run, starts, parameters, setting)
            merged: Lanes = jax.tree.map(lambda new, old: jnp.where(ended, new, old), fresh, now)
            return Progress(merged, following + jnp.sum(ended), results)

        def flying(progress: Progress) -> Any:
            return (progress.lanes.code != IDLE).any()

        progress, _ = jax.lax.while_loop(lambda carry: flying(carry[0]) & (carry[1] < most), body, (progress, 0))
        return progress, flying(progress)

    return Integrator(begin, jax.jit(advance))


class _Step:
    """One attempted step of every run."""

    def __init__(self, problem: Problem, method: Method) -> None:
        self.method = method
        self._rates = as_jax(problem.rates)
        self._project = as_jax(problem.project)
        self._margin: Function | None = as_jax(problem.margin) if problem.margin is not None else None
        assert problem.judging is not None
        self.reductions = problem.judging.size
        self.judge = Judge(problem, problem.judging, method, self._rate)
        s = method.stages
        # Row i holds the weights of the state at which stage i is evaluated; stage s is the end of the step.
        self._A: Any = np.zeros((s + 1, s + 1))
        self._A[:s, : method.A.shape[1]], self._A[s, :s] = method.A[:s], method.B
        self._C = np.append(method.C[:s], 1.0)

    def begin(self, run: Any, starts: Any, parameters: Any, setting: Setting) -> Lanes:
        """Initialise the runs with a conservative first step. Those that are singular or undefined at the start end."""
        import jax.numpy as jnp

        n = starts.shape[1]
        t = jnp.zeros(n)
        rate, wrench = self._rate(t, starts, parameters)
        scale = setting.atol + setting.rtol * jnp.abs(starts)
        size, slope = (jnp.sum((rows / scale) ** 2, axis=0) for rows in (starts, rate))
        h = jnp.clip(0.01 * jnp.sqrt(size / jnp.maximum(slope, 1e-10)), 1e-6, 1e-2)
        defined = jnp.isfinite(rate).all(axis=0)
        code = jnp.where(defined, FLYING, UNDEFINED)
        if self._margin is not None:  # the guard says why, also where a rate is not finite
            code = jnp.where(self._margin(t[None], starts, parameters)[0][0] <= 0, SINGULAR, code)
        none = jnp.zeros(n, dtype=bool)
        steps, judged = jnp.zeros(n, dtype=int), self.judge.begin(starts, wrench, setting.times)
        return Lanes(run, t, jnp.where(defined, h, 1e-2), starts, rate, wrench, code, steps, none, judged)

    def __call__(self, runs: Lanes, parameters: Any, setting: Setting) -> Lanes:
        import jax.numpy as jnp

        flying = runs.code == FLYING
        last = runs.t + 1.0001 * runs.h >= setting.duration
        h = jnp.where(last, setting.duration - runs.t, runs.h)
        t_new = jnp.where(last, setting.duration, runs.t + h)
        raw, K, W, error = self._attempt(runs, h, parameters, setting)
        end = self.method.stages
        new = self._project(raw)[0]
        good = flying & (error <= 1)
        allowed = self._allowed(t_new, new, parameters)
        inside = jnp.max(jnp.abs(new), axis=0) < MAX_STATE
        accepted, lost = good & allowed & inside, good & allowed & ~inside
        if self.method.errors[0][-1] == 0:  # otherwise f at the end is known, up to projection
            rate, wrench = self._rate(t_new, new, parameters)
            K, W = K.at[end].set(rate), W.at[end].set(wrench)
        taken = Taken(runs.t, t_new, h, runs.s, new, K, W)
        judged = self.judge(runs.judged, taken, accepted, parameters, setting.times)

        factor = self._factor(error, runs.rejected, accepted, good & ~allowed)
        h_next, steps = jnp.where(flying, h * factor, runs.h), runs.steps + flying
        stuck = flying & ~accepted & ~(h_next > jnp.maximum(SHORTEST, 1e-15 * runs.t))
        code = jnp.where(flying & (steps >= setting.max_steps), TOO_MANY, runs.code)
        code = jnp.where(stuck, jnp.where(good & ~allowed, SINGULAR, TOO_SMALL), code)
        code = jnp.where(lost, DIVERGED, code)
        code = jnp.where(accepted & (t_new >= setting.duration), COMPLETED, code)
        return Lanes(
            run=runs.run,
            t=jnp.where(accepted, t_new, runs.t),
            h=h_next,
            s=jnp.where(accepted, new, runs.s),
            rate=jnp.where(accepted, K[end], runs.rate),
            wrench=jnp.where(accepted, W[end], runs.wrench),
            code=code,
            steps=steps,
            rejected=flying & ~accepted,
            judged=judged,
        )

    def _attempt(self, runs: Lanes, h: Any, parameters: Any, setting: Setting) -> tuple[Any, Any, Any, Any]:
        """The new state before projection, rates and wrenches of all stages, and the error (accept if <= 1).

        The last stage, f at the new state, is computed only if the error estimate uses it.
        """
        import jax
        import jax.numpy as jnp

        method = self.method
        A, C = jnp.asarray(self._A), jnp.asarray(self._C)
        last = method.stages + (method.errors[0][-1] != 0)

        def stage(i: Any, known: tuple[Any, Any]) -> tuple[Any, Any]:
            # One copy of the program serves all stages, which keeps compilation fast.
            K, W = known
            y = runs.s + h * jnp.tensordot(A[i], K, axes=1)
            rate, wrench = self._rate(runs.t + C[i] * h, y, parameters)
            return K.at[i].set(rate), W.at[i].set(wrench)

        K, W = (jnp.zeros((method.stages + 1, *x.shape)).at[0].set(x) for x in (runs.rate, runs.wrench))
        K, W = jax.lax.fori_loop(1, last, stage, (K, W))
        new = runs.s + h * jnp.tensordot(A[method.stages], K, axes=1)
        scale = setting.atol + setting.rtol * jnp.maximum(jnp.abs(runs.s), jnp.abs(new))
        sums = [
            jnp.sum((jnp.tensordot(jnp.asarray(weights), K, axes=1) / scale) ** 2, axis=0) for weights in method.errors
        ]
        return new, K, W, self._norm(sums, h, len(new))

    def _norm(self, sums: list[Any], h: Any, n: int) -> Any:
        import jax.numpy as jnp

        if len(sums) == 1:
            return h * jnp.sqrt(sums[0] / n)
        joined = sums[0] + 0.01 * sums[1]
        return jnp.where(joined > 0, h * sums[0] / jnp.sqrt(jnp.where(joined > 0, joined, 1.0) * n), joined)

    def _factor(self, error: Any, rejected: Any, accepted: Any, guarded: Any) -> Any:
        import jax.numpy as jnp

        order = 8 if self.method.stages > 8 else 5
        factor = SAFETY * jnp.where(error > 1e-12, error, 1e-12) ** (-1 / order)
        factor = jnp.clip(factor, LEAST_FACTOR, MOST_FACTOR)
        grown = jnp.where(rejected, jnp.minimum(factor, 1.0), factor)
        shrunk = jnp.where(factor < 1.0, factor, LEAST_FACTOR)
        return jnp.where(guarded, 0.5, jnp.where(accepted, grown, shrunk))

    def _rate(self, t: Any, s: Any, parameters: Any) -> tuple[Any, Any]:
        """Rates (24, L) and wrench (w, L)."""
        rate, wrench = self._rates(t[None], s, parameters)
        return rate, wrench

    def _allowed(self, t: Any, s: Any, parameters: Any) -> Any:
        import jax.numpy as jnp

        if self._margin is None:
            return jnp.ones(s.shape[1], dtype=bool)
        return self._margin(t[None], s, parameters)[0][0] > 0
