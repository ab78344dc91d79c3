"""The stages of one Runge-Kutta step in every lane, and its error estimate."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import Any

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.methods import Method
from flypend.compile.program import Program

STRANDS = 4  # divides the length of a state, with or without its tangent


class Stages:
    """Memory and code of a step from state S to state Y, with parameters P and stage rates K.

    `rates` is the program (t, s, p) → state rates, and if it has a second output, the wrench. Stage 0 must hold both at
    S before a step.
    """

    def __init__(self, code: Code, method: Method, rates: Program) -> None:
        self.code, self.method, self.size = code, method, rates.inputs[1]
        if self.size % STRANDS:
            raise ValueError(f"the state length must be a multiple of {STRANDS}, not {self.size}")
        self.rates = define(code.lanes, rates)
        self.S, self.Y, self.P = code.reserve(self.size), code.reserve(self.size), code.reserve(rates.inputs[2])
        self.K = code.reserve(self.size * (len(method.errors[0]) + len(method.C_extra)))
        self.wrenches = rates.outputs[1:]
        self._W = [code.reserve(len(vector) * (method.stages + 1 + len(method.C_extra))) for vector in self.wrenches]
        self._when = code.reserve(1)

    def rate(self, stage: int) -> ir.Value:
        """Address of the rates of `stage`."""
        return self.code.vector_at(self.K, stage * self.size)

    def wrench(self, stage: int) -> ir.Value:
        """Address of the wrench of `stage`."""
        return self.code.vector_at(self._W[0], stage * len(self.wrenches[0]))

    def evaluate(self, t: Value, stage: int) -> None:
        """Evaluate the rates at (`t`, Y) into `stage`."""
        self.code.store(t, self._when)
        self._call(self._when, self.Y, stage)

    def start(self, t: ir.Value, lanes: Value) -> None:
        """Evaluate the rates at S and the time stored at `t` into stage 0, in `lanes`; others keep every bit."""
        last = self.method.stages
        self._call(t, self.S, last)
        self.carry(lanes)

    def carry(self, lanes: Value) -> None:
        """Let the last stage, at the end of a step, be stage 0 of the next, in `lanes`."""
        code, last = self.code, self.method.stages
        for memory, length in ((self.K, self.size), *zip(self._W, map(len, self.wrenches), strict=True)):
            with code.count(length) as i:
                end = code.load(memory, code.builder.add(i, ir.Constant(I64, last * length)))
                code.store(code.select(lanes, end, code.load(memory, i)), memory, i)

    def _call(self, t: ir.Value, state: ir.Value, stage: int) -> None:
        wrench = [self.wrench(stage)] if self._W else []
        self.code.call(self.rates, t, state, self.P, self.rate(stage), *wrench)

    def combine(self, weights: Any, h: Value) -> None:
        """Set Y = S + h Σ_j w_j k_j, with w the `weights`."""
        code = self.code
        with code.count(self.size) as i:
            code.store(code.load(self.S, i) + h * self._weighted(weights, i), self.Y, i)

    def attempt(self, t: Value, h: Value, rtol: Value, atol: Value) -> tuple[Value, Value]:
        """Compute the stages of a step `h` from `t` and the new state Y.

        Returns the error relative to the tolerances (accept if <= 1) and the largest magnitude of an entry of Y.
        """
        method = self.method
        for s in range(1, method.stages):
            self.combine(method.A[s, :s], h)
            self.evaluate(t + float(method.C[s]) * h, s)
        self.combine(method.B, h)
        if method.errors[0][-1] != 0:  # the estimate uses f at the end of the step
            self.evaluate(t + h, method.stages)
        return self._judged(h, rtol, atol)

    def _judged(self, h: Value, rtol: Value, atol: Value) -> tuple[Value, Value]:
        """Error of the step relative to the tolerances, and the largest magnitude of an entry of Y."""
        code, method = self.code, self.method
        # Independent partial sums hide the latency of the additions.
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
        """Component i of Σ_j w_j k_j."""
        code = self.code
        total: Value | None = None
        for j, weight in enumerate(weights):
            if weight != 0:
                place = code.builder.add(i, ir.Constant(I64, j * self.size))
                term = float(weight) * code.load(self.K, place)
                total = term if total is None else total + term
        return total if total is not None else code.value(0.0)
