"""Whether the rod touches within an adaptive step: the step's dense output, looked at every two milliseconds."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.dense import Dense, Step
from flypend.compile.llvm.stages import Stages
from flypend.compile.llvm.touching import Touching
from flypend.compile.llvm.vector import Code, Value
from flypend.compile.touch import Touch

# Longest interval in which the rod moves along a cubic, s; that of the rotors plant.
LONGEST = 2e-3


class StepTouching:
    """Touches within the steps of the ideal kernel, in states followed by the thrust."""

    def __init__(self, code: Code, touch: Touch, stages: Stages, dense: Dense, at: dict[str, ir.Value]) -> None:
        self._code, self._stages, self._dense = code, stages, dense
        self.touching = Touching(code, touch, at)
        size = stages.size + 1
        self._before, self._after = code.reserve(size), code.reserve(size)
        self._place, self._when, self._open = (code.reserve(1) for _ in range(3))

    def begin(self, new: Value) -> Value:
        """Start the flights of the lanes `new` in state S with stage 0; return which of them touch there."""
        self._put(self._before, self._stages.S, self._code.load(self._stages.wrench(0)))
        return self.touching.begin(self._before, new)

    def take(self, step: Step, accepted: Value) -> tuple[Value, Value]:
        """Look at the `accepted` steps; return which lanes touch in them, and when."""
        code = self._code
        count = code.most(code.floor(step.h / LONGEST) + 1.0, 1.0)
        self._put(self._before, self._stages.S, self._thrust(code.value(0.0)))
        code.store(1.0, self._place)
        code.store(step.t_new, self._when)
        code.store(code.select(accepted, 1.0, 0.0), self._open)
        with code.loop(lambda: code.any(self._going(count))):
            self._look(step, count)
        return accepted & ~(code.load(self._open) > 0.0), code.load(self._when)

    def _going(self, count: Value) -> Value:
        return (self._code.load(self._open) > 0.0) & (self._code.load(self._place) <= count)

    def _look(self, step: Step, count: Value) -> None:
        """Look at the next interval of every lane that still goes."""
        code, going = self._code, self._going(count)
        place = code.load(self._place)
        share = code.least(place / count, 1.0)
        self._dense.evaluate(step, step.t + share * step.h)
        self._put(self._after, self._dense.state, self._thrust(share))
        interval = step.h / count
        touched, part = self.touching.between(self._before, self._after, interval, going)
        time = step.t + (place - 1.0 + part) * interval
        code.store(code.select(touched, time, code.load(self._when)), self._when)
        code.store(code.select(touched, 0.0, code.load(self._open)), self._open)
        with code.count(self._stages.size + 1) as i:
            code.store(code.load(self._after, i), self._before, i)
        code.store(place + 1.0, self._place)

    def _thrust(self, share: Value) -> Value:
        """Thrust at a `share` of the step, on the line between its ends."""
        load, stages = self._code.load, self._stages
        first, last = load(stages.wrench(0)), load(stages.wrench(stages.method.stages))
        return first + share * (last - first)

    def _put(self, memory: ir.Value, state: ir.Value, thrust: Value) -> None:
        code, size = self._code, self._stages.size
        with code.count(size) as i:
            code.store(code.load(state, i), memory, i)
        code.store(thrust, memory, size)
