"""The stages of one Runge-Kutta step in every lane, and the error of the step."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import Any

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.methods import Method
from flypend.compile.program import Program

STRANDS = 4  # divides the sizes of a state and of a state with its tangent


class Stages:
    """Memory and code of a step: from the state S to Y, with parameters P and the rates K of the stages.

    `rates` is the function (t, s, p) → rates of the state; stage 0 must hold the rates at S.
    """

    def __init__(self, code: Code, method: Method, rates: Program) -> None:
        self.code, self.method, self.size = code, method, rates.inputs[1]
        if self.size % STRANDS:
            raise ValueError(f"a state of a multiple of {STRANDS} entries, not {self.size}")
        self.rates = define(code.lanes, rates)
        self.S, self.Y, self.P = code.reserve(self.size), code.reserve(self.size), code.reserve(rates.inputs[2])
        self.K = code.reserve(self.size * (len(method.errors[0]) + len(method.C_extra)))
        self._when = code.reserve(1)

    def rate(self, stage: int) -> ir.Value:
        """Where the rates of `stage` are."""
        return self.code.vector_at(self.K, stage * self.size)

    def evaluate(self, t: Value, stage: int) -> None:
        """The rates at `t` and Y, as those of `stage`."""
        self.code.store(t, self._when)
        self.code.call(self.rates, self._when, self.Y, self.P, self.rate(stage))

    def combine(self, weights: Any, h: Value) -> None:
        """Y = S + h Σ w_j k_j."""
        code = self.code
        with code.count(self.size) as i:
            code.store(code.load(self.S, i) + h * self._weighted(weights, i), self.Y, i)

    def attempt(self, t: Value, h: Value, rtol: Value, atol: Value) -> tuple[Value, Value]:
        """Stages from `t` over `h`, the new state in Y; its error relative to the tolerance and its largest entry.

        Accept an error of at most 1.
        """
        method = self.method
        for s in range(1, method.stages):
            self.combine(method.A[s, :s], h)
            self.evaluate(t + float(method.C[s]) * h, s)
        self.combine(method.B, h)
        if method.errors[0][-1] != 0:  # the estimate weighs f at the end of the step
            self.evaluate(t + h, method.stages)
        return self._judged(h, rtol, atol)

    def _judged(self, h: Value, rtol: Value, atol: Value) -> tuple[Value, Value]:
        """Error of the step relative to the tolerance, and the largest size of an entry of Y."""
        code, method = self.code, self.method
        # Sums are taken in strands: one alone would wait for each addition.
        strands = [([code.reserve(1) for _ in method.errors], code.reserve(1)) for _ in range(STRANDS)]
        for sums, largest in strands:
            for memory in (*sums, largest):
                code.store(0.0, memory)
        with code.count(self.size // STRANDS) as group:
            first = code.builder.mul(group, ir.Constant(I64, STRANDS))
            for strand, (sums, largest) in enumerate(strands):
                i = code.builder.add(first, ir.Constant(I64, strand))
                before, after = code.fabs(code.load(self.S, i)), code.fabs(code.load(self.Y, i))
                scale = 1.0 / (atol + rtol * code.most(before, after))
                code.store(code.most(after, code.load(largest)), largest)
                for weights, memory in zip(method.errors, sums, strict=True):
                    part = self._weighted(weights, i) * scale
                    code.store(code.load(memory) + part * part, memory)
        totals = [reduce(add, (code.load(sums[k]) for sums, _ in strands)) for k in range(len(method.errors))]
        peak = reduce(code.most, (code.load(largest) for _, largest in strands))
        return self._norm(totals, h), peak

    def _norm(self, sums: list[Value], h: Value) -> Value:
        code, n = self.code, self.size
        if len(sums) == 1:
            return h * code.sqrt(sums[0] / n)
        joined = sums[0] + 0.01 * sums[1]  # Hairer, Nørsett, Wanner: Solving ODEs I, II.10
        return code.select(joined > 0.0, h * sums[0] / code.sqrt(joined * n), joined)

    def _weighted(self, weights: Any, i: ir.Value) -> Value:
        """Σ w_j k_j in component i."""
        code = self.code
        total: Value | None = None
        for j, weight in enumerate(weights):
            if weight != 0:
                place = code.builder.add(i, ir.Constant(I64, j * self.size))
                term = float(weight) * code.load(self.K, place)
                total = term if total is None else total + term
        return total if total is not None else code.value(0.0)
