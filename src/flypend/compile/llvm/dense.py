"""Dense output: the state at any time within a step, from the stages of the step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from llvmlite import ir

from flypend.compile.llvm.stages import Stages
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.methods import Method


@dataclass(frozen=True)
class Step:
    """A step `h` from `t` to `t_new`: its stages, the last of which is at its end."""

    stages: Stages
    t: Value
    h: Value
    t_new: Value


class Dense:
    """The interpolant of a step: a sum of its stages, weighted by polynomials in θ = (t − t₀)/h, then projected.

    The three additional stages of DOP853 are computed once per step, when `evaluate` first needs them.
    """

    def __init__(self, code: Code, method: Method, size: int, project: ir.Function) -> None:
        self.code, self.method, self.size, self.project = code, method, size, project
        self.state, self._moved, self._end = code.reserve(size), code.reserve(size), code.reserve(size)
        self._ready = code.reserve(1, I64)

    def begin(self) -> None:
        """Forget the additional stages of the last step."""
        self.code.builder.store(ir.Constant(I64, 0), self._ready)

    def evaluate(self, step: Step, time: Value) -> None:
        """Set `state` to the state at `time` within `step`."""
        if self.method.name != "dp5":
            self._prepare(step)
        self._interpolate(step, (time - step.t) / step.h)
        self.code.call(self.project, self.state, self.state)

    def _prepare(self, step: Step) -> None:
        """Compute the additional stages of DOP853. They overwrite Y, so save Y − S and restore Y."""
        code, n, s, stages = self.code, self.size, self.method.stages, step.stages
        none = ir.Constant(I64, 0)
        with code.when(code.builder.icmp_signed("==", code.builder.load(self._ready, typ=I64), none)):
            with code.count(n) as i:
                code.store(code.load(stages.Y, i), self._end, i)
                code.store(code.load(stages.Y, i) - code.load(stages.S, i), self._moved, i)
            for extra, c in enumerate(self.method.C_extra):
                stages.combine(self.method.A_extra[extra, : s + 1 + extra], step.h)
                stages.evaluate(step.t + float(c) * step.h, s + 1 + extra)
            with code.count(n) as i:
                code.store(code.load(self._end, i), stages.Y, i)
            code.builder.store(ir.Constant(I64, 1), self._ready)

    def _interpolate(self, step: Step, theta: Value) -> None:
        code, n = self.code, self.size
        whole, weights = self._dp5(theta) if self.method.name == "dp5" else self._dop853(theta)
        scaled = {j: step.h * weight for j, weight in weights.items()}
        with code.count(n) as i:
            value = code.load(step.stages.S, i)
            if whole is not None:
                value = value + whole * code.load(self._moved, i)
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


def _horner(row: Any, theta: Value) -> Any:
    """Σ_p row_p θ^p."""
    value: Any = float(row[-1])
    for coefficient in row[-2::-1]:
        value = value * theta + float(coefficient)
    return value
