"""Reductions over the samples of a run inside a kernel, so that the samples need not be stored."""

from __future__ import annotations

from collections.abc import Sequence

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.program import Program

# max, mean   maximum (NaN counts as +inf) or mean of the value over the samples
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
        self._sums = code.reserve(len(kinds))
        self._number = code.reserve(1)

    def reset(self, lane: ir.Value) -> None:
        """Start a new run in `lane`."""
        code = self.code
        begin = {"max": float("-inf"), "mean": 0.0, "last": -1.0, "since": float("inf")}
        scalar = code.lanes.scalar
        for i, kind in enumerate(self.kinds):
            place = code.builder.add(ir.Constant(I64, i * code.lanes.width), lane)
            code.put(ir.Constant(scalar, begin[kind]), self._sums, place)
        code.put(ir.Constant(scalar, 0.0), self._number, lane)

    def update(self, here: Value, time: ir.Value, state: ir.Value, parameters: ir.Value) -> None:
        """Add the samples `state` at `time`, in the lanes of `here`."""
        code = self.code
        code.call(self._observe, time, state, parameters, self._values)
        now = code.load(time)
        for i, kind in enumerate(self.kinds):
            value, before = code.load(self._values, i), code.load(self._sums, i)
            if kind == "max":
                after = code.select(value <= before, before, code.select(value >= before, value, float("inf")))
            elif kind == "mean":
                after = before + value
            elif kind == "last":
                after = code.select(~(value <= 0.0), now, before)
            else:
                after = code.select(~(value <= 0.0), float("inf"), code.least(now, before))
            code.store(code.select(here, after, before), self._sums, i)
        code.store(code.select(here, code.load(self._number) + 1.0, code.load(self._number)), self._number)

    def store(self, lane: ir.Value, run: ir.Value, rows: ir.Value) -> None:
        """Write the results of the run in `lane` into row `run` of an array of doubles."""
        code, builder = self.code, self.code.builder
        for i, kind in enumerate(self.kinds):
            place = builder.add(ir.Constant(I64, i * code.lanes.width), lane)
            value = code.scalar(self._sums, place)
            if kind == "mean":
                value = builder.fdiv(value, code.scalar(self._number, lane))
            if code.lanes.precision == "float":
                value = builder.fpext(value, ir.DoubleType())
            there = builder.add(builder.mul(run, ir.Constant(I64, len(self.kinds))), ir.Constant(I64, i))
            code.put(value, rows, there)
