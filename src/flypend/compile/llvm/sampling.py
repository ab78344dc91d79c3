"""Samples of runs at given times, from dense output, stored inside the kernel."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.dense import Dense, Step
from flypend.compile.llvm.rows import copy_row, define_turn, from_double, gathered
from flypend.compile.llvm.vector import I64, Code, Value


class Sampler:
    """Stores the state of every lane at the caller's times, which must end with infinity, if the caller wants any."""

    def __init__(self, code: Code, dense: Dense, at: dict[str, ir.Value], run: ir.Value) -> None:
        self.code, self.dense, self.size, self.at, self.run = code, dense, dense.size, at, run
        width = code.lanes.width
        self.places = ir.VectorType(I64, width)
        self.cursor, self.wanted = code.reserve(1, self.places), code.reserve(1)
        self.rows = code.reserve(width * self.size, ir.DoubleType())
        self.turn = define_turn(code.lanes, self.size)
        for lane in range(width):  # also for lanes that never receive a run
            code.put(ir.Constant(code.lanes.scalar, float("inf")), self.wanted, ir.Constant(I64, lane))

    def reset(self, lane: ir.Value) -> None:
        """Start a new run in `lane`."""
        code, first = self.code, ir.Constant(I64, 0)
        code.put(first, self.cursor, lane)
        code.put(from_double(code, code.scalar(self.at["times"], first, ir.DoubleType())), self.wanted, lane)

    def take(self, step: Step, accepted: Value) -> None:
        """Store all samples that fall within the accepted steps."""
        code = self.code

        def due() -> Value:
            return accepted & (code.load(self.wanted) <= step.t_new)

        with code.loop(lambda: code.any(due())):
            here = due()
            self.dense.evaluate(step, code.load(self.wanted))
            code.call(self.turn, self.dense.state, self.rows)
            with code.each(here) as lane:
                row = self._row(lane, code.scalar(self.cursor, lane, I64))
                copy_row(code, self.rows, lane, self.at["samples"], row, self.size)
            self._advance(here)

    def _advance(self, due: Value) -> None:
        """Advance the lanes `due` to their next sample times."""
        code, builder = self.code, self.code.builder
        now = builder.load(self.cursor, typ=self.places)
        later = builder.add(now, ir.Constant(self.places, [1] * code.lanes.width))
        cursor = builder.select(due.raw, later, now)
        builder.store(cursor, self.cursor)
        times = gathered(code, self.at["times"], cursor, due)
        code.store(code.select(due, times, code.load(self.wanted)), self.wanted)

    def _row(self, lane: ir.Value, kept: ir.Value) -> ir.Value:
        run = self.code.scalar(self.run, lane, I64)
        return self.code.builder.add(self.code.builder.mul(run, self.at["time_count"]), kept)

    def finish(self, lane: ir.Value) -> None:
        """Fill the samples that the run in `lane` did not reach with NaN."""
        code, builder = self.code, self.code.builder
        kept = code.scalar(self.cursor, lane, I64)
        first = builder.mul(self._row(lane, kept), ir.Constant(I64, self.size))
        left = builder.mul(builder.sub(self.at["time_count"], kept), ir.Constant(I64, self.size))
        with code.count(left) as i:
            code.put(ir.Constant(ir.DoubleType(), float("nan")), self.at["samples"], builder.add(first, i))
