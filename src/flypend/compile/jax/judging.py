"""Reductions in JAX of runs: gauges from dense output at the caller's times, forces from the stages.

The counterpart of `flypend.compile.llvm.judging`, which looks at fewer times and finds the same.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from flypend.compile.jax.arrays import as_jax
from flypend.compile.methods import Method
from flypend.compile.problem import Judging, Problem


class Judged(NamedTuple):
    """Reductions of L runs in progress.

    Index of the next time (L,); index of the last time at which each gauge was out of bounds (k, L), -1 for none;
    largest last gauge, integral of the mean square of the forces, that at the start, and largest force (L,).
    """

    place: Any
    last: Any
    largest: Any
    total: Any
    start: Any
    peak: Any


class Taken(NamedTuple):
    """A step of L runs: t to t_new = t + h (L,), s to s_new (24, L), and its stages including the end of the step.

    K are their rates (s+1, 24, L), W their wrenches (s+1, w, L).
    """

    t: Any
    t_new: Any
    h: Any
    s: Any
    s_new: Any
    K: Any
    W: Any


class Judge:
    """Applies the reductions of `problem` to accepted steps."""

    def __init__(
        self, problem: Problem, judging: Judging, method: Method, rate: Callable[[Any, Any, Any], tuple[Any, Any]]
    ) -> None:
        self._judging, self._method, self._rate = judging, method, rate
        self._values, self._forces = as_jax(judging.values), as_jax(judging.forces)
        self._project = as_jax(problem.project)

    def begin(self, starts: Any, wrench: Any, times: Any) -> Judged:
        """Judge runs at their `starts` (24, L), where they have a `wrench` (w, L)."""
        import jax.numpy as jnp

        runs = starts.shape[1]
        square, peak = self._forces(wrench)[0]
        nothing = jnp.zeros(runs, int)
        begun = Judged(
            nothing, jnp.full((len(self._judging.bounds), runs), -1), jnp.full(runs, -jnp.inf), jnp.zeros(runs),
            square, peak,
        )  # fmt: skip
        return self._updated(begun, jnp.full(runs, times[0] <= 0), jnp.zeros(runs), starts)

    def reductions(self, judged: Judged, t: Any, times: Any) -> Any:
        """Final reductions (k + 4, L) of runs that have ended at `t` (L,)."""
        import jax.numpy as jnp

        after = jnp.max(judged.last, axis=0) + 1
        since = jnp.where(after < judged.place, times[after], jnp.inf)
        last = jnp.where(judged.last >= 0, times[judged.last], -1.0)
        mean = jnp.where(t > 0, judged.total / jnp.where(t > 0, t, 1.0), judged.start)
        return jnp.stack([since, *last, jnp.sqrt(judged.largest), mean, judged.peak])

    def __call__(self, judged: Judged, step: Taken, accepted: Any, parameters: Any, times: Any) -> Judged:
        """Return `judged` updated with `step`, for the runs where it was `accepted`."""
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
            return self._updated(now, here, time, state)

        after: Judged = jax.lax.cond(due(judged).any(), judge, lambda now: now, judged)
        return self._with_forces(after, step, accepted)

    def _updated(self, now: Judged, here: Any, time: Any, state: Any) -> Judged:
        """Return `now` with a judged `time` (L,) at `state` (24, L), in the runs `here`."""
        import jax.numpy as jnp

        gauges = self._values(time[None], state, jnp.zeros_like(state))[0]
        out = here & ~(gauges <= jnp.array(self._judging.bounds)[:, None])
        larger = here & ~(gauges[-1] <= now.largest)
        return now._replace(
            place=now.place + here,
            last=jnp.where(out, now.place, now.last),
            largest=jnp.where(larger, gauges[-1], now.largest),
        )

    def _with_forces(self, now: Judged, step: Taken, accepted: Any) -> Judged:
        import jax.numpy as jnp

        stages = self._method.stages
        square, largest = jnp.stack([self._forces(wrench)[0] for wrench in step.W]).swapaxes(0, 1)
        total = step.h * jnp.tensordot(jnp.asarray(self._method.B), square[:stages], axes=1)
        return now._replace(
            total=now.total + jnp.where(accepted, total, 0.0),
            peak=jnp.where(accepted, jnp.maximum(now.peak, jnp.max(largest, axis=0)), now.peak),
        )

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
            K = jnp.concatenate([K, self._rate(step.t + c * step.h, y, parameters)[0][None]])
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
