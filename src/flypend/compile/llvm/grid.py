"""The times at which runs are judged, and how far each lane has come."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.rows import gathered
from flypend.compile.llvm.vector import I64, Code, Value


class Grid:
    """Increasing times, ending with infinity, and a table that finds the place of a time among them.

    The kernel's argument `judge_times` holds the times. Entry b of `bins`, of which there are `bin_count`, is at most
    the number of times up to b / `bin_rate` s.
    """

    def __init__(self, code: Code, at: dict[str, ir.Value]) -> None:
        self.code, self.at = code, at
        self.places = ir.VectorType(I64, code.lanes.width)
        self._cursor, self._before = code.reserve(1, self.places), code.reserve(1, self.places)
        self._behind = code.reserve(1)

    def constant(self, number: int) -> ir.Constant:
        """`number` as a place in every lane."""
        return ir.Constant(self.places, [number] * self.code.lanes.width)

    def begin(self, new: Value) -> Value:
        """Move the lanes that are `new` to the start, at `begin`; return those whose first time is the start."""
        builder = self.code.builder
        first = new & (self.time(self.constant(0), new) <= self.code.value(self._number("begin")))
        places = builder.select(first.raw, self.constant(1), self.constant(0))
        builder.store(builder.select(new.raw, places, builder.load(self._cursor, typ=self.places)), self._cursor)
        return first

    def advance(self, t: Value, lanes: Value) -> Value:
        """Pass all times up to `t` in `lanes`; return the lanes that have passed any."""
        code, builder = self.code, self.code.builder
        before = builder.load(self._cursor, typ=self.places)
        builder.store(before, self._before)
        rate, most = (code.value(self._number(name)) for name in ("bin_rate", "bin_count"))
        place = self._integer(code.select(lanes, code.least(t * rate, most - 1.0), 0.0))
        place = self._integer(gathered(code, self.at["bins"], place, lanes))
        # The table of a uniform grid is at most one place behind.
        place = self._later(place, self._is_passed(place, t, lanes))
        builder.store(builder.select(lanes.raw, place, before), self._cursor)
        self._note(t, lanes)
        with code.loop(lambda: code.any(code.load(self._behind) > 0.0)):
            now = builder.load(self._cursor, typ=self.places)
            builder.store(self._later(now, code.load(self._behind) > 0.0), self._cursor)
            self._note(t, lanes)
        after = builder.load(self._cursor, typ=self.places)
        return lanes & Value(code, builder.icmp_signed(">", after, before))

    def _note(self, t: Value, lanes: Value) -> None:
        """Note which `lanes` have a next time up to `t`."""
        place = self.code.builder.load(self._cursor, typ=self.places)
        self.code.store(self.code.select(self._is_passed(place, t, lanes), 1.0, 0.0), self._behind)

    def _is_passed(self, place: ir.Value, t: Value, lanes: Value) -> Value:
        return lanes & (self.time(place, lanes) <= t)

    def _later(self, place: ir.Value, lanes: Value) -> ir.Value:
        return self.code.builder.select(lanes.raw, self.code.builder.add(place, self.constant(1)), place)

    def _number(self, name: str) -> ir.Value:
        value = self.at[name]
        return (
            value if self.code.lanes.precision == "double" else self.code.builder.fptrunc(value, self.code.lanes.scalar)
        )

    def _integer(self, value: Value) -> ir.Value:
        return self.code.builder.fptosi(value.raw, self.places)

    def latest(self) -> ir.Value:
        """The last place that each lane has passed."""
        return self.code.builder.sub(self.code.builder.load(self._cursor, typ=self.places), self.constant(1))

    def reached(self, place: ir.Value) -> Value:
        """Whether `place` was passed in the current step."""
        before = self.code.builder.load(self._before, typ=self.places)
        return Value(self.code, self.code.builder.icmp_signed(">=", place, before))

    def time(self, place: ir.Value, lanes: Value) -> Value:
        """Time at `place`, in `lanes`."""
        return gathered(self.code, self.at["judge_times"], place, lanes)

    def scalar(self, place: ir.Value) -> ir.Value:
        """Time at the scalar `place`, as a double."""
        return self.code.scalar(self.at["judge_times"], place, ir.DoubleType())

    def passed(self, lane: ir.Value) -> ir.Value:
        """Number of times that `lane` has passed."""
        return self.code.scalar(self._cursor, lane, I64)
