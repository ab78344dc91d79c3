"""The kernel of the ideal plant: embedded Runge-Kutta steps in vectors of lanes, one run per lane.

Every lane has its own time and step. When its run ends (completed, diverged, singular) the next start is loaded into
it, so that no lane waits for another, and what a run gives does not depend on its neighbours.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from llvmlite import ir

from flypend.compile.methods import Method
from flypend.compile.program import Program
from flypend.compile.reductions import Reductions
from flypend.compile.vector import I64, POINTER, VOID, Code, Lanes, Value, define
from flypend.outcome import MAX_STATE

COMPLETED, DIVERGED, SINGULAR, UNDEFINED, TOO_SMALL, TOO_MANY = range(6)
SAFETY, LEAST_FACTOR, MOST_FACTOR = 0.9, 0.2, 10.0
# Shortest step, s: below it the time no longer moves, or a singularity has been located.
SHORTEST = 1e-13

ARGUMENTS = (
    "starts", "parameters", "runs", "duration", "rtol", "atol", "max_steps", "times", "time_count",
    "samples", "reductions", "final", "end", "status", "steps", "knots",
)  # fmt: skip
INTEGERS, REALS = ("runs", "max_steps", "time_count"), ("duration", "rtol", "atol")


@dataclass(frozen=True)
class Problem:
    """What a kernel integrates, as programs of time t, state s and parameters p.

    Parameters
    ----------
    rates : Program
        (t, s, p) → rates of the state.
    project : Program
        s → s drawn back onto the manifold, and the drift (3,) before.
    margin : Program, optional
        (t, s, p) → a number that stays positive where the law is defined.
    observe : Program, optional
        (t, s, p) → the values that `reductions` reduce at the sample times.
    reductions : tuple of str
        One kind per value: see `Reductions`.
    """

    rates: Program
    project: Program
    margin: Program | None = None
    observe: Program | None = None
    reductions: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """Length of the state."""
        return self.rates.inputs[1]

    @property
    def parameters(self) -> int:
        """Number of parameters."""
        return self.rates.inputs[2]


def write_kernel(lanes: Lanes, problem: Problem, method: Method) -> None:
    """Write the function "kernel" for `problem` into the module of `lanes`; its arguments are `ARGUMENTS`."""
    kinds = [I64 if name in INTEGERS else ir.DoubleType() if name in REALS else POINTER for name in ARGUMENTS]
    function = ir.Function(lanes.module, ir.FunctionType(VOID, kinds), "kernel")
    function.attributes.add("nounwind")
    _Kernel(lanes, problem, method, function).write()


class _Kernel:
    """Writes the kernel, part by part; `self.at` are its arguments by name."""

    def __init__(self, lanes: Lanes, problem: Problem, method: Method, function: ir.Function) -> None:
        self.lanes, self.problem, self.method = lanes, problem, method
        self.code = code = Code(lanes, ir.IRBuilder(function.append_basic_block()))
        self.at = dict(zip(ARGUMENTS, function.args, strict=True))
        n = problem.size
        self.rates = define(lanes, problem.rates)
        self.project = define(lanes, problem.project)
        self.margin = define(lanes, problem.margin) if problem.margin else None
        self.S, self.Y, self.P = code.reserve(n), code.reserve(n), code.reserve(problem.parameters)
        self.stages = len(method.errors[0]) + len(method.C_extra)
        self.K = code.reserve(n * self.stages)
        self.t, self.h, self.count, self.limit = (code.reserve(1) for _ in range(4))
        self.active, self.when, self.drift = code.reserve(1), code.reserve(1), code.reserve(3)
        self.run, self.ended = code.reserve(lanes.width, I64), code.reserve(lanes.width, I64)
        self.next, self.left = code.reserve(1, I64), code.reserve(1, I64)
        self.dense = code.reserve(7 * n)
        self.low = code.reserve(1)
        self.samples = Reductions(code, problem.observe, problem.reductions) if problem.observe else None
        self.cursor = code.reserve(lanes.width, I64)

    def write(self) -> None:
        code, builder = self.code, self.code.builder
        zero = ir.Constant(I64, 0)
        builder.store(zero, self.next)
        builder.store(ir.Constant(I64, self.lanes.width), self.left)
        self.duration, self.rtol, self.atol = (code.value(self._real(name)) for name in REALS)
        for memory, length in ((self.S, self.problem.size), (self.P, self.problem.parameters)):
            with code.count(length) as i:
                code.store(0.0, memory, i)
        for memory in (self.t, self.h, self.count):
            code.store(0.0, memory)
        code.store(0.0, self.active)
        with code.count(self.lanes.width) as lane:
            code.put(ir.Constant(I64, -1), self.run, lane)
            code.put(zero, self.cursor, lane)
            self._load_next(lane)
        self._evaluate(self.t, self.S, 0)
        with code.loop(lambda: builder.icmp_signed(">", builder.load(self.left, typ=I64), zero)):
            self._iterate()
        builder.ret_void()

    def _real(self, name: str) -> ir.Value:
        value = self.at[name]
        return value if self.lanes.precision == "double" else self.code.builder.fptrunc(value, self.lanes.scalar)

    def _stage(self, j: int) -> ir.Value:
        return self.code.vector_at(self.K, j * self.problem.size)

    def _evaluate(self, t: ir.Value, state: ir.Value, stage: int) -> None:
        self.code.call(self.rates, t, state, self.P, self._stage(stage))

    # One attempted step in every lane ---------------------------------------------------------------------------

    def _iterate(self) -> None:
        code = self.code
        t, active = code.load(self.t), code.load(self.active) > 0.0
        h = self._trial_step(t)
        last = t + 1.0001 * h >= self.duration
        h = code.select(last, self.duration - t, h)
        error = self._attempt(t, h)
        t_new = code.select(last, self.duration, t + h)
        accepted = (error <= 1.0) & active
        code.call(self.project, self.Y, self.Y, self.drift)
        guarded = None
        if self.margin is not None:
            code.store(t_new, self.when)
            margin = code.reserve(1)
            code.call(self.margin, self.when, self.Y, self.P, margin)
            guarded = accepted & ~(code.load(margin) > 0.0)
            accepted = accepted & ~guarded
        accepted = accepted & ~(code.load(self.low) > 0.0)
        lost = accepted & ~(self._largest(self.Y) < MAX_STATE)
        self._finish_step(t, h, t_new, error, accepted & ~lost, guarded, lost, active)

    def _trial_step(self, t: Value) -> Value:
        """The step to try: that of the controller, or for a new run a cautious one from the sizes of s and its rate."""
        code, n = self.code, self.problem.size
        size, rate = code.reserve(1), code.reserve(1)
        h = code.load(self.h)
        new = h <= 0.0
        code.store(0.0, self.low)
        with code.when(code.any(new)):
            if self.margin is not None:
                margin = code.reserve(1)
                code.call(self.margin, self.t, self.S, self.P, margin)
                code.store(code.select(new & ~(code.load(margin) > 0.0), 1.0, 0.0), self.low)
            code.store(0.0, size)
            code.store(0.0, rate)
            with code.count(n) as i:
                value, slope = code.load(self.S, i), code.load(self.K, i)
                scale = self.atol + self.rtol * code.fabs(value)
                value, slope = value / scale, slope / scale
                code.store(code.load(size) + value * value, size)
                code.store(code.load(rate) + slope * slope, rate)
            first = 0.01 * code.sqrt(code.load(size) / code.most(code.load(rate), 1e-10))
            # NaN rates give a step that is not finite: the run ends below. No first step is longer than 10 ms.
            code.store(code.select(new, code.most(code.least(first, 1e-2), 1e-6), h), self.h)
        return code.load(self.h)

    def _attempt(self, t: Value, h: Value) -> Value:
        """Stages, the new state in Y, and the error relative to the tolerance: accept at most 1."""
        code, n, method = self.code, self.problem.size, self.method
        for s in range(1, method.stages):
            self._combine(method.A[s, :s], h)
            code.store(t + float(method.C[s]) * h, self.when)
            self._evaluate(self.when, self.Y, s)
        self._combine(method.B, h)
        if method.errors[0][-1] != 0:  # the estimate weighs f at the end of the step
            code.store(t + h, self.when)
            self._evaluate(self.when, self.Y, method.stages)
        sums = [code.reserve(1) for _ in method.errors]
        for memory in sums:
            code.store(0.0, memory)
        with code.count(n) as i:
            before, after = code.fabs(code.load(self.S, i)), code.fabs(code.load(self.Y, i))
            scale = 1.0 / (self.atol + self.rtol * code.most(before, after))
            for weights, memory in zip(method.errors, sums, strict=True):
                part = self._weighted(weights, i) * scale
                code.store(code.load(memory) + part * part, memory)
        return self._norm([code.load(memory) for memory in sums], h)

    def _norm(self, sums: list[Value], h: Value) -> Value:
        code, n = self.code, self.problem.size
        if len(sums) == 1:
            return h * code.sqrt(sums[0] / n)
        joined = sums[0] + 0.01 * sums[1]  # Hairer, Nørsett, Wanner: Solving ODEs I, II.10
        return code.select(joined > 0.0, h * sums[0] / code.sqrt(joined * n), joined)

    def _weighted(self, weights: Any, i: ir.Value) -> Value:
        """Σ w_j k_j in component i."""
        code, n = self.code, self.problem.size
        total: Value | None = None
        for j, weight in enumerate(weights):
            if weight != 0:
                place = code.builder.add(i, ir.Constant(I64, j * n))
                term = float(weight) * code.load(self.K, place)
                total = term if total is None else total + term
        return total if total is not None else code.value(0.0)

    def _combine(self, weights: Any, h: Value) -> None:
        """Y = S + h Σ w_j k_j."""
        code = self.code
        with code.count(self.problem.size) as i:
            code.store(code.load(self.S, i) + h * self._weighted(weights, i), self.Y, i)

    def _factor(self, error: Value) -> Value:
        """Ratio of the next step to this one: 0.9 error^(−1/8), for order 5 error^(−3/16) in place of −1/5."""
        code = self.code
        eighth = code.sqrt(code.sqrt(code.sqrt(code.most(error, 1e-12))))
        root = eighth if self.method.stages > 8 else eighth * code.sqrt(eighth)
        return code.least(code.most(SAFETY / root, LEAST_FACTOR), MOST_FACTOR)

    def _finish_step(
        self,
        t: Value,
        h: Value,
        t_new: Value,
        error: Value,
        accepted: Value,
        guarded: Value | None,
        lost: Value,
        active: Value,
    ) -> None:
        code, n = self.code, self.problem.size
        if self.method.errors[0][-1] != 0:  # f at the end is known, up to the projection
            after = self._stage(self.method.stages)
        else:
            after = code.reserve(n)
            code.store(t_new, self.when)
            code.call(self.rates, self.when, self.Y, self.P, after)
        self._sample(t, h, t_new, accepted, after)
        with code.count(n) as i:
            code.store(code.select(accepted, code.load(self.Y, i), code.load(self.S, i)), self.S, i)
            code.store(code.select(accepted, code.load(after, i), code.load(self.K, i)), self.K, i)
        self._record_knot(t_new, accepted)

        count = code.load(self.count) + 1.0
        code.store(count, self.count)
        t_now = code.select(accepted, t_new, t)
        code.store(t_now, self.t)
        # After a rejection the next step does not grow; there is no way to know that one was but its factor below 1.
        factor = self._factor(error)
        factor = code.select(accepted, code.select(code.load(self.limit) > 0.0, code.least(factor, 1.0), factor),
                             code.select(factor < 1.0, factor, LEAST_FACTOR))  # fmt: skip
        if guarded is not None:
            factor = code.select(guarded, 0.5, factor)
        code.store(code.select(accepted, 0.0, 1.0), self.limit)
        h_next = code.select(active, h * factor, h)
        code.store(h_next, self.h)
        self._end_runs(t_now, h_next, count, guarded, lost, accepted, active)

    def _largest(self, state: ir.Value) -> Value:
        """Largest size of an entry of `state`."""
        code = self.code
        peak = code.reserve(1)
        code.store(0.0, peak)
        with code.count(self.problem.size) as i:
            code.store(code.most(code.fabs(code.load(state, i)), code.load(peak)), peak)
        return code.load(peak)

    # Ends of runs ---------------------------------------------------------------------------------------------

    def _end_runs(
        self,
        t: Value,
        h: Value,
        count: Value,
        guarded: Value | None,
        lost: Value,
        accepted: Value,
        active: Value,
    ) -> None:
        code, builder = self.code, self.code.builder
        status, steps_left = code.reserve(1), self._max_steps()
        stuck = ~accepted & ~(h > code.most(SHORTEST, 1e-15 * t))
        value = code.value(-1.0)
        value = code.select(count >= steps_left, float(TOO_MANY), value)
        value = code.select(stuck, float(TOO_SMALL), value)
        if guarded is not None:
            value = code.select(stuck & guarded, float(SINGULAR), value)
            value = code.select(code.load(self.low) > 0.0, float(SINGULAR), value)
        value = code.select(lost, float(DIVERGED), value)
        value = code.select(accepted & (t >= self.duration), float(COMPLETED), value)
        value = code.select(self._first_rate_undefined(), float(UNDEFINED), value)
        value = code.select(active, value, -1.0)
        code.store(value, status)
        with code.when(code.any(value >= 0.0)):
            with code.count(self.lanes.width) as lane:
                code_number = code.builder.fptosi(code.scalar(status, lane), I64)
                with code.when(builder.icmp_signed(">=", code_number, ir.Constant(I64, 0))):
                    self._store_result(lane, code_number)
                    self._load_next(lane)
            self._begin_runs(value >= 0.0)

    def _begin_runs(self, new: Value) -> None:
        """The first rates of the runs in the lanes `new`; the others keep theirs, to the last bit."""
        code = self.code
        self._evaluate(self.t, self.S, 1)
        with code.count(self.problem.size) as i:
            place = code.builder.add(i, ir.Constant(I64, self.problem.size))
            code.store(code.select(new, code.load(self.K, place), code.load(self.K, i)), self.K, i)

    def _max_steps(self) -> Value:
        code = self.code
        return code.value(code.builder.sitofp(self.at["max_steps"], self.lanes.scalar))

    def _first_rate_undefined(self) -> Value:
        """Whether the run stands at its start and has a rate that is not finite."""
        code = self.code
        total = code.reserve(1)
        code.store(0.0, total)
        with code.count(self.problem.size) as i:
            code.store(code.load(total) + 0.0 * code.load(self.K, i), total)
        return (code.load(self.t) <= 0.0) & ~(code.load(total).compare("==", 0.0))

    def _store_result(self, lane: ir.Value, status: ir.Value) -> None:
        code, builder = self.code, self.code.builder
        run = code.scalar(self.run, lane, I64)
        self._copy(self.S, lane, self.at["final"], run, self.problem.size, out=True)
        code.put(self._double(code.scalar(self.t, lane)), self.at["end"], run)
        code.put(status, self.at["status"], run)
        code.put(builder.fptosi(code.scalar(self.count, lane), I64), self.at["steps"], run)
        if self.samples is not None:
            self.samples.store(lane, run, self.at["reductions"])

    def _double(self, value: ir.Value) -> ir.Value:
        return value if self.lanes.precision == "double" else self.code.builder.fpext(value, ir.DoubleType())

    def _single(self, value: ir.Value) -> ir.Value:
        return value if self.lanes.precision == "double" else self.code.builder.fptrunc(value, self.lanes.scalar)

    def _copy(self, memory: ir.Value, lane: ir.Value, rows: ir.Value, row: ir.Value, length: int, *, out: bool) -> None:
        """Copy lane `lane` of `length` vectors to or from row `row` of an array of doubles."""
        code, builder = self.code, self.code.builder
        with code.count(length) as i:
            here = builder.add(builder.mul(i, ir.Constant(I64, self.lanes.width)), lane)
            there = builder.add(builder.mul(row, ir.Constant(I64, length)), i)
            if out:
                code.put(self._double(code.scalar(memory, here)), rows, there)
            else:
                code.put(self._single(code.scalar(rows, there, ir.DoubleType())), memory, here)

    def _load_next(self, lane: ir.Value) -> None:
        """Put the next start into `lane`, or let it rest when there is none."""
        code, builder = self.code, self.code.builder
        run = builder.load(self.next, typ=I64)
        zero, one = (ir.Constant(self.lanes.scalar, number) for number in (0.0, 1.0))
        with builder.if_else(builder.icmp_signed("<", run, self.at["runs"])) as (more, none):
            with more:
                builder.store(builder.add(run, ir.Constant(I64, 1)), self.next)
                code.put(run, self.run, lane)
                code.put(one, self.active, lane)
                self._copy(self.S, lane, self.at["starts"], run, self.problem.size, out=False)
                self._copy(self.P, lane, self.at["parameters"], run, self.problem.parameters, out=False)
                for memory in (self.t, self.h, self.count, self.limit):
                    code.put(zero, memory, lane)
                code.put(ir.Constant(I64, 0), self.cursor, lane)
                if self.samples is not None:
                    self.samples.reset(lane)
            with none:
                code.put(zero, self.active, lane)
                builder.store(builder.sub(builder.load(self.left, typ=I64), ir.Constant(I64, 1)), self.left)

    def _record_knot(self, t: Value, accepted: Value) -> None:
        """Time and drift of an accepted step of lane 0, if the caller wants them (then there is one run)."""
        code, builder = self.code, self.code.builder
        wanted = builder.icmp_unsigned("!=", builder.ptrtoint(self.at["knots"], I64), ir.Constant(I64, 0))
        first = builder.extract_element(accepted.raw, ir.Constant(ir.IntType(32), 0))
        with code.when(builder.and_(wanted, first)):
            zero = ir.Constant(I64, 0)
            row = builder.fptosi(code.scalar(self.at["knots"], zero, ir.DoubleType()), I64)
            base = builder.add(builder.mul(row, ir.Constant(I64, 4)), ir.Constant(I64, 1))
            code.put(
                self._double(builder.extract_element(t.raw, ir.Constant(ir.IntType(32), 0))), self.at["knots"], base
            )
            for k in range(3):
                value = builder.extract_element(code.load(self.drift, k).raw, ir.Constant(ir.IntType(32), 0))
                place = builder.add(base, ir.Constant(I64, k + 1))
                code.put(self._double(value), self.at["knots"], place)
            counted = builder.sitofp(builder.add(row, ir.Constant(I64, 1)), ir.DoubleType())
            code.put(counted, self.at["knots"], zero)

    # Samples inside a step ------------------------------------------------------------------------------------

    def _sample(self, t: Value, h: Value, t_new: Value, accepted: Value, after: ir.Value) -> None:
        """At every wanted time in the accepted steps: the state of the dense output, stored and reduced."""
        code = self.code
        wanted = code.reserve(1)
        self._next_times(wanted)
        with code.when(code.any(accepted & (code.load(wanted) <= t_new))):
            self._dense_output(t, h, after)
            state = code.reserve(self.problem.size)

            def due() -> ir.Value:
                return code.any(accepted & (code.load(wanted) <= t_new))

            with code.loop(due):
                theta = (code.load(wanted) - t) / h
                self._interpolate(theta, state)
                unused = code.reserve(3)
                code.call(self.project, state, state, unused)
                here = accepted & (code.load(wanted) <= t_new)
                if self.samples is not None:
                    self.samples.update(here, wanted, state, self.P)
                self._store_samples(here, state)
                self._next_times(wanted)

    def _next_times(self, wanted: ir.Value) -> None:
        """The next sample time of each lane; infinity past the last."""
        code, builder = self.code, self.code.builder
        code.store(float("inf"), wanted)
        with code.count(self.lanes.width) as lane:
            place = code.scalar(self.cursor, lane, I64)
            with code.when(builder.icmp_signed("<", place, self.at["time_count"])):
                time = code.scalar(self.at["times"], place, ir.DoubleType())
                code.put(self._single(time), wanted, lane)

    def _store_samples(self, here: Value, state: ir.Value) -> None:
        code, builder = self.code, self.code.builder
        marks = code.reserve(1)
        code.store(code.select(here, 1.0, 0.0), marks)
        kept = builder.icmp_unsigned("!=", builder.ptrtoint(self.at["samples"], I64), ir.Constant(I64, 0))
        with code.count(self.lanes.width) as lane:
            one = ir.Constant(self.lanes.scalar, 1.0)
            with code.when(builder.fcmp_ordered("==", code.scalar(marks, lane), one)):
                place = code.scalar(self.cursor, lane, I64)
                with code.when(kept):
                    run = code.scalar(self.run, lane, I64)
                    row = builder.add(builder.mul(run, self.at["time_count"]), place)
                    self._copy(state, lane, self.at["samples"], row, self.problem.size, out=True)
                code.put(builder.add(place, ir.Constant(I64, 1)), self.cursor, lane)

    def _dense_output(self, t: Value, h: Value, after: ir.Value) -> None:
        """The coefficients of the polynomial over the step, from the stages, f at its end, and further stages."""
        code, n, method = self.code, self.problem.size, self.method
        s = method.stages
        if method.name == "dp5":
            for power in range(4):
                self._rows(power, method.dense[:, power], h)
            return
        with code.count(n) as i:
            code.store(code.load(after, i), self.K, code.builder.add(i, ir.Constant(I64, s * n)))
        moved = code.reserve(n)
        with code.count(n) as i:
            code.store(code.load(self.Y, i) - code.load(self.S, i), moved, i)
        end = code.reserve(n)
        with code.count(n) as i:
            code.store(code.load(self.Y, i), end, i)
        for extra, c in enumerate(method.C_extra):
            self._combine(method.A_extra[extra, : s + 1 + extra], h)
            code.store(t + float(c) * h, self.when)
            self._evaluate(self.when, self.Y, s + 1 + extra)
        with code.count(n) as i:
            code.store(code.load(end, i), self.Y, i)
            difference, first = code.load(moved, i), code.load(self.K, i)
            code.store(difference, self.dense, i)
            code.store(h * first - difference, self.dense, code.builder.add(i, ir.Constant(I64, n)))
            third = 2.0 * difference - h * (code.load(after, i) + first)
            code.store(third, self.dense, code.builder.add(i, ir.Constant(I64, 2 * n)))
        for row in range(4):
            self._rows(3 + row, method.dense[row], h)

    def _rows(self, row: int, weights: Any, h: Value) -> None:
        code = self.code
        with code.count(self.problem.size) as i:
            place = code.builder.add(i, ir.Constant(I64, row * self.problem.size))
            code.store(h * self._weighted(weights, i), self.dense, place)

    def _interpolate(self, theta: Value, state: ir.Value) -> None:
        code, n = self.code, self.problem.size
        rows = 4 if self.method.name == "dp5" else 7
        with code.count(n) as i:
            value = code.value(0.0)
            for row in range(rows - 1, -1, -1):
                value = value + code.load(self.dense, code.builder.add(i, ir.Constant(I64, row * n)))
                swapped = self.method.name == "dop853" and (rows - 1 - row) % 2
                value = value * ((1.0 - theta) if swapped else theta)
            code.store(code.load(self.S, i) + value, state, i)
