"""Which lanes of a kernel of sampled flights are in flight, and how the flights of the others have ended."""

from __future__ import annotations

from functools import reduce
from operator import add

from llvmlite import ir

from flypend.compile.llvm.runge_kutta import COMPLETED
from flypend.compile.llvm.stopping import not_stopped
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.model.state import MAX_STATE

STRANDS = 4  # partial sums, which hide the latency of additions


class Flying:
    """Status and end of the flight in each lane; `at` are the arguments of the kernel."""

    def __init__(self, code: Code, at: dict[str, ir.Value]) -> None:
        self._code, self._at = code, at
        self._alive, self._status, self._end = (code.keep(1) for _ in range(3))

    def begin(self, last: Value) -> None:
        """Begin in all lanes; flights that complete end at the time `last`, s."""
        for value, memory in ((1.0, self._alive), (float(COMPLETED), self._status), (last, self._end)):
            self._code.store(value, memory)

    def go_on(self, last: Value) -> None:
        """Let the flights that have not ended end at the time `last`, s."""
        self._code.store(self._code.select(self.lanes, last, self._code.load(self._end)), self._end)

    @property
    def lanes(self) -> Value:
        """The lanes in flight."""
        return self._code.load(self._alive) > 0.0

    @property
    def any(self) -> ir.Value:
        """Whether a lane is in flight."""
        return self._code.any(self.lanes)

    @property
    def wanted(self) -> ir.Value:
        """Whether a lane is in flight, and the call not stopped."""
        alive = self.any
        return self._code.builder.and_(alive, not_stopped(self._code.builder, self._at["stop"]))

    def end(self, where: Value, status: int, time: Value) -> None:
        """End the flights of the lanes `where` at `time`, s."""
        code = self._code
        ending = where & self.lanes
        for value, memory in ((float(status), self._status), (time, self._end), (0.0, self._alive)):
            code.store(code.select(ending, value, code.load(memory)), memory)

    def keep_ended(self, state: ir.Value, after: ir.Value, length: int) -> None:
        """Where the flight has ended, let `after` be the `state` before, of `length` vectors."""
        code = self._code
        with code.when(code.any(code.load(self._alive) <= 0.0)):
            alive = self.lanes
            with code.count(length) as i:
                code.store(code.select(alive, code.load(after, i), code.load(state, i)), after, i)

    def store(self, lane: ir.Value, run: ir.Value) -> None:
        """Write end and status of the flight in `lane` to entry `run` of the results."""
        code = self._code
        code.put(code.scalar(self._end, lane), self._at["end"], run)
        code.put(code.builder.fptosi(code.scalar(self._status, lane), I64), self._at["status"], run)


def undefined(code: Code, memory: ir.Value, length: int) -> Value:
    """Whether one of `length` entries is infinite or NaN."""
    total = code.value(0.0)
    for i in range(length):
        total = total + 0.0 * code.load(memory, i)
    return ~total.compare("==", 0.0)


def far(code: Code, state: ir.Value, length: int) -> Value:
    """Whether |s| may exceed the limit in an entry, from the length of the whole vector."""
    sums = [code.value(0.0)] * STRANDS
    for i in range(length):
        entry = code.load(state, i)
        sums[i % STRANDS] = sums[i % STRANDS] + entry * entry
    return ~(reduce(add, sums) < MAX_STATE**2)  # NaN is far


def lost(code: Code, state: ir.Value, length: int) -> Value:
    """Whether an entry exceeds the limit or is NaN."""
    out = ~(code.fabs(code.load(state)) < MAX_STATE)
    for i in range(1, length):
        out = out | ~(code.fabs(code.load(state, i)) < MAX_STATE)
    return out
