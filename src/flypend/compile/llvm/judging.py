"""Judging runs inside the kernel of the ideal plant, at the cost of a few states per step.

What counts at the judged times is when each gauge was last out of bounds, and the largest value of the last gauge.
Within a step a gauge is the quintic that matches its value and its first two derivatives at both ends. The coefficients
of that quintic in Bernstein's basis enclose it, so most steps are decided without a look at any judged time. The others
are searched backwards from the end of the step. Where the quintic is closer to its bound than its error may be, the
state comes from dense output, so verdicts are those of judging dense output at every judged time.

Mean square and maximum of the forces come from the wrenches of the stages, the mean by the method's own quadrature.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial, reduce
from itertools import pairwise

from llvmlite import ir

from flypend.compile.llvm.dense import Dense, Step
from flypend.compile.llvm.emit import define, emit
from flypend.compile.llvm.grid import Grid
from flypend.compile.llvm.rows import as_double
from flypend.compile.llvm.stages import Stages
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.methods import Method
from flypend.compile.problem import Judging

# Error of a quintic, as a share of what its second derivatives add to the cubic that matches value and slope. A kink
# anywhere in a step makes an error of at most 3/64 of it; smooth motion much less.
SHARE = 0.05
# Error of a state from dense output, in tolerances.
NOISE = 50.0


class Judge:
    """Emits the judging of every lane: `begin` at a start, `take` after each step, `store` at the end."""

    def __init__(self, code: Code, method: Method, judging: Judging, stages: Stages, dense: Dense, grid: Grid) -> None:
        self.code, self.method, self.judging, self.stages = code, method, judging, stages
        self.dense, self.grid, self.k = dense, grid, len(judging.bounds)
        self._gauges, self._values = define(code.lanes, judging.gauges), define(code.lanes, judging.values)
        self._rates = stages.rate(method.stages)  # at the end of the step
        k = self.k
        # Gauges, first and second derivatives at the beginning and at the end of the step, and tolerances.
        self._before, self._after, self._tolerances = code.reserve(3 * k), code.reserve(3 * k), code.reserve(k)
        self._curves, self._margins, self._open = code.reserve(6 * k), code.reserve(k), code.reserve(k)
        self._exact, self._found = code.reserve(k), code.reserve(k)
        self._here, self._grown, self._at = (code.reserve(1) for _ in range(3))
        self._last, self._place = code.reserve(k, grid.places), code.reserve(1, grid.places)
        self._largest, self._sum, self._start, self._peak = (code.reserve(1) for _ in range(4))

    # Start of runs --------------------------------------------------------------------------------------------------

    def begin(self, new: Value, t: ir.Value) -> None:
        """Judge the start of the lanes that are `new`, at the time stored at `t`, in state S with stage 0."""
        code, builder = self.code, self.code.builder
        code.call(
            self._gauges, t, self.stages.S, self.stages.rate(0), *self._derivatives(self._after), self._tolerances
        )
        self._carry(new)
        first = self.grid.begin(new)
        for i, bound in enumerate(self.judging.bounds):
            out = first & ~(code.load(self._after, i) <= bound)
            place = builder.select(out.raw, self.grid.constant(0), self.grid.constant(-1))
            last = builder.load(self._slot(i), typ=self.grid.places)
            builder.store(builder.select(new.raw, place, last), self._slot(i))
        largest = code.select(first, code.load(self._after, self.k - 1), float("-inf"))
        square, peak = self._force(0)
        begun = {self._largest: largest, self._sum: code.value(0.0), self._start: square, self._peak: peak}
        for memory, value in begun.items():
            code.store(code.select(new, value, code.load(memory)), memory)

    def _derivatives(self, memory: ir.Value) -> Sequence[ir.Value]:
        return [self.code.vector_at(memory, order * self.k) for order in range(3)]

    def _slot(self, i: int) -> ir.Value:
        """Address of the index of the last judged time at which gauge i was out of bounds; -1 for none."""
        return self.code.vector_at(self._last, i, self.grid.places)

    def _carry(self, lanes: Value) -> None:
        """Let the end of the step be the beginning of the next, in `lanes`."""
        code = self.code
        for j in range(3 * self.k):
            code.store(code.select(lanes, code.load(self._after, j), code.load(self._before, j)), self._before, j)

    # Steps ----------------------------------------------------------------------------------------------------------

    def take(self, step: Step, accepted: Value, scale: Value) -> None:
        """Judge the `accepted` steps; `scale` is the tolerance of an entry of order one."""
        code = self.code
        code.store(step.t_new, self._at)
        end = self._derivatives(self._after)
        code.call(self._gauges, self._at, step.stages.Y, self._rates, *end, self._tolerances)
        due = self.grid.advance(step.t_new, accepted)
        pending = self._coarsely(step, due, NOISE * scale)
        with code.when(code.any(pending)):
            self._search(step, pending)
        self._integrate(step, accepted)
        self._carry(accepted)

    def _coarsely(self, step: Step, due: Value, noise: Value) -> Value:
        """Decide what the enclosures of the quintics decide; return the lanes to be searched."""
        code, builder = self.code, self.code.builder
        latest = self.grid.latest()
        pending = due
        for i, bound in enumerate(self.judging.bounds):
            curve, margin = self._curve(i, step.h)
            tolerance = code.load(self._tolerances, i)
            margin = SHARE * margin + noise * (2.0 * tolerance + noise)
            if not self.judging.smooth:
                margin = code.value(float("inf"))
            code.store(margin, self._margins, i)
            low, high = reduce(code.least, curve), reduce(code.most, curve)
            within, outside = high + margin <= bound, low - margin > bound
            last = builder.load(self._slot(i), typ=self.grid.places)
            builder.store(builder.select((due & outside).raw, latest, last), self._slot(i))
            undecided = due & ~within & ~outside
            code.store(code.select(undecided, 1.0, 0.0), self._open, i)
            pending = undecided if i == 0 else pending | undecided
        grown = self._risen(step, due, curve, high) if self.judging.smooth else due
        code.store(code.select(grown, 1.0, 0.0), self._grown)
        return pending | grown

    def _risen(self, step: Step, due: Value, curve: Sequence[Value], high: Value) -> Value:
        """Update the largest value where the last gauge only rises; return the other lanes where it may be larger."""
        code = self.code
        grown = due & ~(high <= code.load(self._largest))
        rising = grown & reduce(Value.__and__, [a <= b for a, b in pairwise(curve)])
        with code.when(code.any(rising)):
            time = self.grid.time(self.grid.latest(), rising)
            self._enlarge(rising, self._quintic(self.k - 1, (time - step.t) / step.h))
        return grown & ~rising

    def _enlarge(self, lanes: Value, value: Value) -> None:
        """Raise the largest value to `value` in `lanes`."""
        largest = self.code.load(self._largest)
        self.code.store(self.code.select(lanes & ~(value <= largest), value, largest), self._largest)

    def _curve(self, i: int, h: Value) -> tuple[list[Value], Value]:
        """Bernstein coefficients of the quintic of gauge i, also stored, and how far its ends bend from the cubic."""
        code, k = self.code, self.k
        a, da, dda = (code.load(self._before, order * k + i) for order in range(3))
        b, db, ddb = (code.load(self._after, order * k + i) for order in range(3))
        da, db, dda, ddb = h * da, h * db, h * h * dda, h * h * ddb
        curve = [a, a + 0.2 * da, a + 0.4 * da + 0.05 * dda, b - 0.4 * db + 0.05 * ddb, b - 0.2 * db, b]
        for j, coefficient in enumerate(curve):
            code.store(coefficient, self._curves, 6 * i + j)
        rise = 6.0 * (b - a)
        bend = code.fabs(dda - rise + 4.0 * da + 2.0 * db) + code.fabs(ddb + rise - 2.0 * da - 4.0 * db)
        return curve, bend

    def _search(self, step: Step, pending: Value) -> None:
        """Look at the judged times of the step, the latest first, in the lanes `pending`."""
        code, builder, grid = self.code, self.code.builder, self.grid
        builder.store(grid.latest(), self._place)
        code.store(code.select(pending, 1.0, 0.0), self._here)
        with code.loop(lambda: code.any(code.load(self._here) > 0.0)):
            here = code.load(self._here) > 0.0
            place = builder.load(self._place, typ=grid.places)
            self._look(step, here, place)
            left = reduce(Value.__or__, [code.load(self._open, i) > 0.0 for i in range(self.k)])
            left = left | (code.load(self._grown) > 0.0)
            place = builder.sub(place, grid.constant(1))
            builder.store(place, self._place)
            code.store(code.select(here & left & grid.reached(place), 1.0, 0.0), self._here)

    def _look(self, step: Step, here: Value, place: ir.Value) -> None:
        """Evaluate the gauges at the judged times `place`, from dense output where a quintic is in doubt."""
        code, builder = self.code, self.code.builder
        time = self.grid.time(place, here)
        theta = (time - step.t) / step.h
        opened = [here & (code.load(self._open, i) > 0.0) for i in range(self.k)]
        grown = here & (code.load(self._grown) > 0.0)
        doubts = []
        for i, bound in enumerate(self.judging.bounds):
            value = self._quintic(i, theta)
            code.store(value, self._exact, i)
            sure = code.fabs(value - bound) > code.load(self._margins, i)
            doubts.append(opened[i] & ~sure)
        undefined = grown & ~value.compare("==", value) if self.judging.smooth else grown
        doubts.append(undefined)
        with code.when(code.any(reduce(Value.__or__, doubts))):
            self._evaluate(step, time, doubts)
        for i, bound in enumerate(self.judging.bounds):
            out = opened[i] & ~(code.load(self._exact, i) <= bound)
            last = builder.load(self._slot(i), typ=self.grid.places)
            builder.store(builder.select(out.raw, place, last), self._slot(i))
            code.store(code.select(out, 0.0, code.load(self._open, i)), self._open, i)
        self._enlarge(grown, code.load(self._exact, self.k - 1))

    def _quintic(self, i: int, theta: Value) -> Value:
        """Σ_j (5 over j) b_j θ^j (1 − θ)^(5−j)."""
        code, rest = self.code, 1.0 - theta
        total, power = code.load(self._curves, 6 * i), code.value(1.0)
        for j, binomial in enumerate((5.0, 10.0, 10.0, 5.0, 1.0), start=1):
            power = power * theta
            total = total * rest + binomial * power * code.load(self._curves, 6 * i + j)
        return total

    def _evaluate(self, step: Step, time: Value, doubts: Sequence[Value]) -> None:
        """Replace the values in doubt by those of dense output; the last of `doubts` is about the largest value."""
        code = self.code
        code.store(time, self._at)
        self.dense.evaluate(step, time)
        code.call(self._values, self._at, self.dense.state, self._rates, self._found)
        for i in range(self.k):
            doubt = doubts[i] if i < self.k - 1 else doubts[i] | doubts[-1]
            code.store(code.select(doubt, code.load(self._found, i), code.load(self._exact, i)), self._exact, i)

    # Forces ---------------------------------------------------------------------------------------------------------

    def _force(self, stage: int) -> list[Value]:
        """Mean square and maximum of the forces of `stage`."""
        return emit(self.code, self.judging.forces, [partial(self.code.load, self.stages.wrench(stage))])[0]

    def _integrate(self, step: Step, accepted: Value) -> None:
        """Add the forces of the `accepted` steps."""
        code, method = self.code, self.method
        total, peak = code.value(0.0), code.load(self._peak)
        for stage in range(method.stages + 1):
            square, largest = self._force(stage)
            if stage < method.stages and method.B[stage] != 0:
                total = total + float(method.B[stage]) * square
            peak = code.most(largest, peak)
        before = code.load(self._sum)
        code.store(code.select(accepted, before + step.h * total, before), self._sum)
        code.store(code.select(accepted, peak, code.load(self._peak)), self._peak)

    # End of runs ----------------------------------------------------------------------------------------------------

    def store(self, lane: ir.Value, run: ir.Value, time: ir.Value) -> None:
        """Write the reductions of the run in `lane`, which lasted for the scalar `time`, into row `run`."""
        code, builder = self.code, self.code.builder
        one, none = ir.Constant(I64, 1), ir.Constant(self.code.lanes.scalar, 0.0)
        places = [code.scalar(self._last, self._entry(i, lane), I64) for i in range(self.k)]
        latest = reduce(lambda a, b: builder.select(builder.icmp_signed(">", a, b), a, b), places)
        values = [self._since(builder.add(latest, one), lane), *(self._time_of(place) for place in places)]
        largest, total, start, peak = (
            code.scalar(memory, lane) for memory in (self._largest, self._sum, self._start, self._peak)
        )
        mean = builder.select(builder.fcmp_ordered(">", time, none), builder.fdiv(total, time), start)
        root = builder.call(code.lanes.library("sqrt", 1), [largest])
        values += [as_double(code, value) for value in (root, mean, peak)]
        for i, value in enumerate(values):
            there = builder.add(builder.mul(run, ir.Constant(I64, self.judging.size)), ir.Constant(I64, i))
            code.put(value, self.grid.at["reductions"], there)

    def _entry(self, i: int, lane: ir.Value) -> ir.Value:
        return self.code.builder.add(ir.Constant(I64, i * self.code.lanes.width), lane)

    def _time_of(self, place: ir.Value) -> ir.Value:
        """The judged time at `place`; -1 if there is none."""
        builder = self.code.builder
        there = builder.icmp_signed(">=", place, ir.Constant(I64, 0))
        time = self.grid.scalar(builder.select(there, place, ir.Constant(I64, 0)))
        return builder.select(there, time, ir.Constant(ir.DoubleType(), -1.0))

    def _since(self, place: ir.Value, lane: ir.Value) -> ir.Value:
        """The judged time at `place`; infinity if the run in `lane` did not come so far."""
        passed = self.code.builder.icmp_signed("<", place, self.grid.passed(lane))
        return self.code.builder.select(passed, self.grid.scalar(place), ir.Constant(ir.DoubleType(), float("inf")))
