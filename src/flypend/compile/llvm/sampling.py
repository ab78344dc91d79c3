"""Samples of runs at given times from dense output, stored and reduced inside the kernel."""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Any

import numpy as np
from llvmlite import ir

from flypend.compile.llvm.reductions import Reductions
from flypend.compile.llvm.rows import copy_row, define_turn, from_double, gathered
from flypend.compile.llvm.stages import Stages
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.methods import Method


@dataclass(frozen=True)
class Step:
    """A step `h` from `t` to `t_new`: its stages, and the address of the rates at its end, `after`."""

    stages: Stages
    after: ir.Value
    t: Value
    h: Value
    t_new: Value


class Sampler:
    """Samples every lane at the caller's times, which must end with infinity.

    A sample is reduced if `judged` is positive at its time. `rows` holds the number of stored samples before each
    time, and in total.
    """

    def __init__(
        self,
        code: Code,
        method: Method,
        size: int,
        at: dict[str, ir.Value],
        project: ir.Function,
        reductions: Reductions,
    ) -> None:
        self.code, self.method, self.size, self.at = code, method, size, at
        self.project, self.reductions = project, reductions
        width = code.lanes.width
        self.places = ir.VectorType(I64, width)
        self.cursor, self.wanted = code.reserve(1, self.places), code.reserve(1)
        self.state, self.moved = code.reserve(size), code.reserve(size)
        self.rows = code.reserve(width * size, ir.DoubleType())
        self.turn = define_turn(code.lanes, size)
        for lane in range(width):  # also for lanes that never receive a run
            code.put(ir.Constant(code.lanes.scalar, float("inf")), self.wanted, ir.Constant(I64, lane))

    def reset(self, lane: ir.Value) -> None:
        """Start a new run in `lane`."""
        code, first = self.code, ir.Constant(I64, 0)
        code.put(first, self.cursor, lane)
        code.put(from_double(code, code.scalar(self.at["times"], first, ir.DoubleType())), self.wanted, lane)
        self.reductions.reset(lane)

    def _advance(self, due: Value) -> None:
        """Advance the lanes `due` to their next sample times."""
        code, builder = self.code, self.code.builder
        now = builder.load(self.cursor, typ=self.places)
        later = builder.add(now, ir.Constant(self.places, [1] * code.lanes.width))
        cursor = builder.select(due.raw, later, now)
        builder.store(cursor, self.cursor)
        times = gathered(code, self.at["times"], cursor, due)
        code.store(code.select(due, times, code.load(self.wanted)), self.wanted)

    def take(self, step: Step, accepted: Value) -> None:
        """Take all samples that fall within the accepted steps."""
        code = self.code

        def here() -> Value:
            return accepted & (code.load(self.wanted) <= step.t_new)

        with code.when(code.any(here())):
            self._prepare(step)
            with code.loop(lambda: code.any(here())):
                due = here()
                self._interpolate(step, (code.load(self.wanted) - step.t) / step.h)
                code.call(self.project, self.state, self.state)
                with self._if_reduced():
                    judged = gathered(code, self.at["judged"], code.builder.load(self.cursor, typ=self.places), due)
                    self.reductions.update(due & (judged > 0.0), self.wanted, self.state, step.stages.P)
                self._store(due)

    # The interpolant of a step is a sum of its stages, weighted by polynomials in θ = (t − t₀)/h -------------------

    def _prepare(self, step: Step) -> None:
        """Compute the additional stages of DOP853 for dense output. They overwrite Y, so save Y − S and restore Y."""
        if self.method.name == "dp5":
            return
        code, n, s, stages = self.code, self.size, self.method.stages, step.stages
        end = code.reserve(n)
        with code.count(n) as i:
            code.store(code.load(step.after, i), stages.K, code.builder.add(i, ir.Constant(I64, s * n)))
            code.store(code.load(stages.Y, i), end, i)
            code.store(code.load(stages.Y, i) - code.load(stages.S, i), self.moved, i)
        for extra, c in enumerate(self.method.C_extra):
            stages.combine(self.method.A_extra[extra, : s + 1 + extra], step.h)
            stages.evaluate(step.t + float(c) * step.h, s + 1 + extra)
        with code.count(n) as i:
            code.store(code.load(end, i), stages.Y, i)

    def _interpolate(self, step: Step, theta: Value) -> None:
        code, n = self.code, self.size
        whole, weights = self._dp5(theta) if self.method.name == "dp5" else self._dop853(theta)
        scaled = {j: step.h * weight for j, weight in weights.items()}
        with code.count(n) as i:
            value = code.load(step.stages.S, i)
            if whole is not None:
                value = value + whole * code.load(self.moved, i)
            for j, weight in scaled.items():
                value = value + weight * code.load(step.stages.K, code.builder.add(i, ir.Constant(I64, j * n)))
            code.store(value, self.state, i)

    def _dp5(self, theta: Value) -> tuple[None, dict[int, Value]]:
        """s(θ) = S + h Σ_j (Σ_p P_jp θ^(p+1)) k_j."""
        weights = {}
        for j, row in enumerate(self.method.dense):
            if np.any(row != 0):
                weights[j] = theta * _horner(row, theta)
        return None, weights

    def _dop853(self, theta: Value) -> tuple[Value, dict[int, Value]]:
        """s(θ) = S + θ(F₀ + (1−θ)(F₁ + θ(F₂ + (1−θ)(F₃ + …)))), F₀ = Y − S, F₁ = h k₀ − F₀, F₂ = 2 F₀ − h (k₀ + k_s).

        F₃ and above are weighted sums of the stages: the rows of `Method.dense`.
        """
        s, rest = self.method.stages, 1.0 - theta
        factors = [theta]
        for row in range(1, 7):
            factors.append(factors[-1] * (rest if row % 2 else theta))
        weights: dict[int, Value] = {0: factors[1] - factors[2], s: -factors[2]}
        for j in range(self.method.dense.shape[1]):
            for row in range(4):
                if (entry := self.method.dense[row, j]) != 0:
                    term = float(entry) * factors[3 + row]
                    weights[j] = term if j not in weights else weights[j] + term
        return factors[0] - factors[1] + 2.0 * factors[2], weights

    # Results -------------------------------------------------------------------------------------------------------

    def _store(self, due: Value) -> None:
        """Store the samples of the lanes `due` if the caller wants them, and advance to the next times."""
        code = self.code
        with self._if_kept():
            code.call(self.turn, self.state, self.rows)
            with code.each(due) as lane:
                place = code.scalar(self.cursor, lane, I64)
                before, after = self._kept(place), self._kept(code.builder.add(place, ir.Constant(I64, 1)))
                with code.when(code.builder.icmp_signed(">", after, before)):
                    copy_row(code, self.rows, lane, self.at["samples"], self._row(lane, before), self.size)
        self._advance(due)

    def _if_kept(self) -> AbstractContextManager[None]:
        return self.code.when(self._given("samples"))

    def _if_reduced(self) -> AbstractContextManager[None]:
        return self.code.when(self._given("reductions"))

    def _given(self, name: str) -> ir.Value:
        builder = self.code.builder
        return builder.icmp_unsigned("!=", builder.ptrtoint(self.at[name], I64), ir.Constant(I64, 0))

    def _kept(self, place: ir.Value) -> ir.Value:
        """Number of samples stored before the time at `place`."""
        return self.code.scalar(self.at["rows"], place, I64)

    def _row(self, lane: ir.Value, kept: ir.Value) -> ir.Value:
        run = self.code.scalar(self.run, lane, I64)
        return self.code.builder.add(self.code.builder.mul(run, self.at["row_count"]), kept)

    run: ir.Value  # index of the run in each lane

    def finish(self, lane: ir.Value, run: ir.Value) -> None:
        """Store the reductions of the run in `lane`, and fill the samples it did not reach with NaN."""
        code, builder = self.code, self.code.builder
        with self._if_reduced():
            self.reductions.store(lane, run, self.at["reductions"])
        with self._if_kept():
            kept = self._kept(code.scalar(self.cursor, lane, I64))
            first = builder.mul(self._row(lane, kept), ir.Constant(I64, self.size))
            left = builder.mul(builder.sub(self.at["row_count"], kept), ir.Constant(I64, self.size))
            with code.count(left) as i:
                code.put(ir.Constant(ir.DoubleType(), float("nan")), self.at["samples"], builder.add(first, i))


def _horner(row: Any, theta: Value) -> Any:
    """Σ_p row_p θ^p."""
    value: Any = float(row[-1])
    for coefficient in row[-2::-1]:
        value = value * theta + float(coefficient)
    return value
