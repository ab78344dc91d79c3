"""The samples of a kernel of sampled flights: kept, reduced by a criterion, or both."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.lane_rows import from_lane
from flypend.compile.llvm.reductions import Reductions
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.sampled_problem import SampledProblem


class Recording:
    """A cursor over the ticks of samples, in the arguments `at` of the kernel."""

    def __init__(self, code: Code, problem: SampledProblem, at: dict[str, ir.Value]) -> None:
        self._code, self._problem, self._at = code, problem, at
        self._cursor, self._t = code.reserve(1, I64), code.reserve(1)
        self._results = Reductions(code, problem.judge, problem.reductions)

    def rewind(self) -> None:
        """Put the cursor to the first sample."""
        self._code.builder.store(ir.Constant(I64, 0), self._cursor)

    def reset(self, lane: ir.Value) -> None:
        """Start a new run in `lane`."""
        self._results.reset(lane)

    def sample(self, tick: ir.Value, state: ir.Value, gains: ir.Value, first: ir.Value, flying: Value) -> None:
        """Store and reduce the `state` at `tick` if it is one of a sample, of run `first` and those after it."""
        code, builder, at = self._code, self._code.builder, self._at
        cursor = builder.load(self._cursor, typ=I64)
        with (
            code.when(builder.icmp_signed("<", cursor, at["sample_count"])),
            code.when(builder.icmp_signed("==", code.scalar(at["sample_ticks"], cursor, I64), tick)),
        ):
            time = code.value(builder.sitofp(tick, code.lanes.scalar)) * self._problem.period
            code.store(time, self._t)
            with code.when(builder.icmp_signed("!=", code.scalar(at["judged"], cursor, I64), ir.Constant(I64, 0))):
                self._results.update(flying, self._t, state, gains)
            following = builder.add(cursor, ir.Constant(I64, 1))
            row, after = (code.scalar(at["rows"], place, I64) for place in (cursor, following))
            with code.when(builder.icmp_signed(">", after, row)):  # never true if the caller stores no samples
                self._keep(state, row, first)
            builder.store(following, self._cursor)

    def _keep(self, state: ir.Value, kept: ir.Value, first: ir.Value) -> None:
        code, builder, at = self._code, self._code.builder, self._at
        length = self._problem.size + self._problem.rotors
        with code.count(code.lanes.width) as lane:
            run = builder.add(first, lane)
            with code.when(builder.icmp_signed("<", run, at["runs"])):
                row = builder.add(builder.mul(run, at["row_count"]), kept)
                from_lane(code, state, lane, at["samples"], row, length)

    def store(self, lane: ir.Value, run: ir.Value) -> None:
        """Write what the criterion says of the flight in `lane` to row `run` of the results."""
        self._results.store(lane, run, self._at["reductions"])
