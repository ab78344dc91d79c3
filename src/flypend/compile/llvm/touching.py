"""Whether the rod touches what its mount lets it touch, in the lanes of a kernel."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.touch import Touch

INFINITY = float("inf")


class Touching:
    """Least distance of the rod in each lane's flight, and the part that is touched.

    Distances within a tick are evaluated where their lower bound falls below the least so far: branch and bound.
    """

    def __init__(self, code: Code, touch: Touch, at: dict[str, ir.Value]) -> None:
        self._code, self._at = code, at
        self._room, self._touching = define(code.lanes, touch.room), define(code.lanes, touch.touching)
        self._bound, self._found = code.reserve(1), code.reserve(3)  # distance, share of the tick, part
        self._least, self._part, self._interval = code.keep(1), code.keep(1), code.reserve(1)
        if code.context is None:  # also for lanes that never receive a run
            for memory in (self._least, self._part):
                code.store(INFINITY, memory)

    def begin(self, state: ir.Value, new: Value) -> Value:
        """Start the flights of the lanes `new` at `state`; return which of them touch there."""
        code = self._code
        code.store(code.select(new, INFINITY, code.load(self._least)), self._least)
        code.store(code.select(new, -1.0, code.load(self._part)), self._part)
        code.store(0.0, self._interval)
        code.call(self._touching, state, state, self._interval, self._found)
        return self._recorded(new)

    def look_for_contact(self) -> None:
        """Let the next `between` find contacts alone: distances above 0 are not looked for."""
        self._code.store(0.0, self._least)

    def between(self, before: ir.Value, after: ir.Value, interval: Value | float, alive: Value) -> tuple[Value, Value]:
        """Record the distances between two states, `interval` (s) apart, in the lanes `alive`.

        Returns which of them touch, and at which share of the interval; the share is valid for them alone.
        """
        code = self._code
        code.store(interval, self._interval)
        code.call(self._room, before, after, self._interval, self._bound)
        near = alive & (code.load(self._bound) < code.load(self._least))
        code.store(INFINITY, self._found)
        with code.when(code.any(near)):
            code.call(self._touching, before, after, self._interval, self._found)
        return self._recorded(near), code.load(self._found, 1)

    def _recorded(self, here: Value) -> Value:
        """Record what has been found in the lanes `here`; return which of them touch."""
        code = self._code
        found, least = code.load(self._found), code.load(self._least)
        touched = here & (code.load(self._found, 1) <= 1.0)
        code.store(code.select(here, code.least(found, least), least), self._least)
        code.store(code.select(touched, code.load(self._found, 2), code.load(self._part)), self._part)
        return touched

    def store(self, lane: ir.Value, run: ir.Value) -> None:
        """Write least distance and part of the flight in `lane` to entry `run` of the results."""
        code = self._code
        code.put(code.scalar(self._least, lane), self._at["clearance"], run)
        code.put(code.builder.fptosi(code.scalar(self._part, lane), I64), self._at["part"], run)
