"""Reductions in JAX of the dense output of runs at the caller's sample times.

The counterpart of `flypend.compile.llvm.sampling` and `flypend.compile.llvm.reductions`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from flypend.compile.jax.arrays import as_jax
from flypend.compile.llvm.reductions import KINDS
from flypend.compile.methods import Method
from flypend.compile.problem import Problem

_BEGIN = {"max": float("-inf"), "mean": 0.0, "last": -1.0, "since": float("inf")}


class Judged(NamedTuple):
    """Reductions of L runs in progress: index of the next time (L,), values (k, L), number of samples (L,)."""

    place: Any
    values: Any
    number: Any


class Taken(NamedTuple):
    """A step of L runs: t to t_new = t + h (L,), s to s_new (24, L), stages K (s+1, 24, L) including f at the end."""

    t: Any
    t_new: Any
    h: Any
    s: Any
    s_new: Any
    K: Any


class Judge:
    """Applies the reductions of `problem` to the samples inside accepted steps."""

    def __init__(self, problem: Problem, method: Method, rate: Callable[[Any, Any, Any], Any]) -> None:
        assert set(problem.reductions) <= set(KINDS)
        self._kinds, self._method, self._rate = problem.reductions, method, rate
        self._observe, self._project = as_jax(problem.observe), as_jax(problem.project)

    def begin(self, runs: int) -> Judged:
        """Initial reductions of `runs` runs, before their first step."""
        import jax.numpy as jnp

        values = jnp.array([_BEGIN[kind] for kind in self._kinds])
        return Judged(jnp.zeros(runs, int), jnp.tile(values[:, None], (1, runs)), jnp.zeros(runs))

    def reductions(self, judged: Judged) -> Any:
        """Final reductions (k, L) of runs that have ended."""
        import jax.numpy as jnp

        rows = [judged.values[i] / judged.number if kind == "mean" else judged.values[i]
                for i, kind in enumerate(self._kinds)]  # fmt: skip
        return jnp.stack(rows) if rows else judged.values

    def __call__(self, judged: Judged, step: Taken, accepted: Any, parameters: Any, times: Any) -> Judged:
        """Return `judged` updated with the samples inside `step`, for the runs where it was `accepted`."""
        import jax

        def due(now: Judged) -> Any:
            return accepted & (times[now.place] <= step.t_new)

        def judge(now: Judged) -> Judged:
            dense = self._dense(step, parameters)
            result: Judged = jax.lax.while_loop(lambda now: due(now).any(), lambda now: take(now, dense), now)
            return result

        def take(now: Judged, dense: Callable[[Any], Any]) -> Judged:
            here, time = due(now), times[now.place]
            state = self._project(dense((time - step.t) / step.h))[0]
            return self._updated(now, here, time, self._observe(time[None], state, parameters)[0])

        after: Judged = jax.lax.cond(due(judged).any(), judge, lambda now: now, judged)
        return after

    def _updated(self, now: Judged, here: Any, time: Any, values: Any) -> Judged:
        import jax.numpy as jnp

        rows = []
        for kind, value, before in zip(self._kinds, values, now.values, strict=True):
            bad = ~(value <= 0.0)
            if kind == "max":
                after = jnp.where(value <= before, before, jnp.where(value >= before, value, jnp.inf))
            elif kind == "mean":
                after = before + value
            elif kind == "last":
                after = jnp.where(bad, time, before)
            else:
                after = jnp.where(bad, jnp.inf, jnp.minimum(time, before))
            rows.append(jnp.where(here, after, before))
        return Judged(now.place + here, jnp.stack(rows), now.number + here)

    def _dense(self, step: Taken, parameters: Any) -> Callable[[Any], Any]:
        """Return a function from positions θ (L,) in the step to states (24, L)."""
        return self._dp5(step) if self._method.name == "dp5" else self._dop853(step, parameters)

    def _dp5(self, step: Taken) -> Callable[[Any], Any]:
        import jax.numpy as jnp

        weights = jnp.asarray(self._method.dense)

        def dense(theta: Any) -> Any:
            powers = jnp.stack([theta ** (p + 1) for p in range(weights.shape[1])])
            return step.s + step.h * jnp.einsum("jl,jnl->nl", weights @ powers, step.K)

        return dense

    def _dop853(self, step: Taken, parameters: Any) -> Callable[[Any], Any]:
        """SciPy's formula with additional stages: s(θ) = s + θ(F₀ + (1−θ)(F₁ + θ(F₂ + …)))."""
        import jax.numpy as jnp

        method, K = self._method, step.K
        for row, c in zip(method.A_extra, method.C_extra, strict=True):
            y = step.s + step.h * jnp.tensordot(jnp.asarray(row[: len(K)]), K, axes=1)
            K = jnp.concatenate([K, self._rate(step.t + c * step.h, y, parameters)[None]])
        moved = step.s_new - step.s
        ends = step.h * K[0], step.h * K[method.stages]
        upper = step.h * jnp.tensordot(jnp.asarray(method.dense), K, axes=1)
        factors = [moved, ends[0] - moved, 2 * moved - ends[0] - ends[1], *upper]

        def dense(theta: Any) -> Any:
            value: Any = 0.0
            for i, factor in enumerate(reversed(factors)):
                value = (value + factor) * (theta if i % 2 == 0 else 1 - theta)
            return step.s + value

        return dense
