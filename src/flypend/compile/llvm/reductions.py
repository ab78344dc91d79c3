"""Reductions over the samples of a run inside a kernel of sampled flights, so that samples need not be stored."""

from __future__ import annotations

from collections.abc import Sequence

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.program import Program

# max         maximum of the value over the samples; NaN counts as +inf
# mean        mean of the value over time, by the trapezoidal rule between samples
# last        time of the last sample with value > 0 or NaN, −1 if none
# since       time from which all samples have value <= 0 (a settling time), inf if the last sample does not
KINDS = ("max", "mean", "last", "since")


class Reductions:
    """Emits reductions of the values of `observe` (t, s, p) → values, with one of `KINDS` per value."""

    def __init__(self, code: Code, observe: Program, kinds: Sequence[str]) -> None:
        if len(observe.outputs) != 1 or len(observe.outputs[0]) != len(kinds) or not set(kinds) <= set(KINDS):
            raise ValueError(f"expected one of {KINDS} per value of {observe.name}")
        self.code = code
        self.kinds = tuple(kinds)
        self._observe = define(code.lanes, observe)
        self._values = code.reserve(len(kinds))
        self._sums = code.keep(len(kinds))
        # Of the last sample: its time, and the values. The time of the first one; whether there is one.
        self._before, self._when, self._first, self._any = (code.keep(n) for n in (len(kinds), 1, 1, 1))

    def reset(self, lane: ir.Value) -> None:
        """Start a new run in `lane`."""
        code = self.code
        begin = {"max": float("-inf"), "mean": 0.0, "last": -1.0, "since": float("inf")}
        scalar = code.lanes.scalar
        for i, kind in enumerate(self.kinds):
            place = code.builder.add(ir.Constant(I64, i * code.lanes.width), lane)
            code.put(ir.Constant(scalar, begin[kind]), self._sums, place)
        code.put(ir.Constant(scalar, 0.0), self._any, lane)

    def update(self, here: Value, time: ir.Value, state: ir.Value, parameters: ir.Value) -> None:
        """Add the samples `state` at `time`, in the lanes of `here`."""
        code = self.code
        code.call(self._observe, time, state, parameters, self._values)
        now, begun = code.load(time), code.load(self._any) > 0.0
        half = 0.5 * (now - code.load(self._when))
        for i, kind in enumerate(self.kinds):
            value, before = code.load(self._values, i), code.load(self._sums, i)
            if kind == "max":
                after = code.select(value <= before, before, code.select(value >= before, value, float("inf")))
            elif kind == "mean":
                after = code.select(begun, before + half * (code.load(self._before, i) + value), 0.0)
                code.store(code.select(here, value, code.load(self._before, i)), self._before, i)
            elif kind == "last":
                after = code.select(~(value <= 0.0), now, before)
            else:
                after = code.select(~(value <= 0.0), float("inf"), code.least(now, before))
            code.store(code.select(here, after, before), self._sums, i)
        code.store(code.select(here & ~begun, now, code.load(self._first)), self._first)
        code.store(code.select(here, now, code.load(self._when)), self._when)
        code.store(code.select(here, 1.0, code.load(self._any)), self._any)

    def store(self, lane: ir.Value, run: ir.Value, rows: ir.Value) -> None:
        """Write the results of the run in `lane` into row `run` of an array of doubles."""
        code, builder = self.code, self.code.builder
        for i, kind in enumerate(self.kinds):
            place = builder.add(ir.Constant(I64, i * code.lanes.width), lane)
            value = code.scalar(self._sums, place)
            if kind == "mean":
                value = self._mean(value, place, lane)
            if code.lanes.precision == "float":
                value = builder.fpext(value, ir.DoubleType())
            there = builder.add(builder.mul(run, ir.Constant(I64, len(self.kinds))), ir.Constant(I64, i))
            code.put(value, rows, there)

    def _mean(self, total: ir.Value, place: ir.Value, lane: ir.Value) -> ir.Value:
        """Mean over time of the value whose integral is `total`; of a single sample, its value."""
        code, builder = self.code, self.code.builder
        elapsed = builder.fsub(code.scalar(self._when, lane), code.scalar(self._first, lane))
        spread = builder.fcmp_ordered(">", elapsed, ir.Constant(code.lanes.scalar, 0.0))
        return builder.select(spread, builder.fdiv(total, elapsed), code.scalar(self._before, place))
