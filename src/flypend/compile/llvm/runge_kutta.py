"""The kernel of the ideal plant: embedded Runge-Kutta integration in SIMD lanes, one run per lane.

Every lane has its own time and step size. When its run ends (completed, diverged, singular), it takes the next start
from a queue: a counter that calls in other threads can share. No lane waits for another, and the result of a run does
not depend on its neighbours.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from llvmlite import ir

from flypend.compile.llvm.dense import Dense, Step
from flypend.compile.llvm.emit import define
from flypend.compile.llvm.grid import Grid
from flypend.compile.llvm.judging import Judge
from flypend.compile.llvm.rows import as_double, copy_lane
from flypend.compile.llvm.sampling import Sampler
from flypend.compile.llvm.stages import Stages
from flypend.compile.llvm.step_touching import StepTouching
from flypend.compile.llvm.stopping import not_stopped
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code, Lanes, Value
from flypend.compile.methods import Method
from flypend.compile.problem import Problem
from flypend.compile.program import Program, needed
from flypend.model.state import MAX_STATE

COMPLETED, DIVERGED, SINGULAR, UNDEFINED, TOO_SMALL, TOO_MANY, COLLIDED = range(7)
# Half as many rejected steps as with SciPy's 0.9 and 10, and 3 to 7 % fewer evaluations at the same error.
SAFETY, LEAST_FACTOR, MOST_FACTOR = 0.8, 0.2, 5.0
# Minimum step, s: below it, time no longer advances or a singularity has been located.
SHORTEST = 1e-13

ARGUMENTS = (
    "starts", "parameters", "queue", "runs", "begin", "until", "rtol", "atol", "max_steps",
    "times", "time_count", "judge_times", "bins", "bin_count", "bin_rate",
    "samples", "reductions", "final", "end", "status", "steps", "knots", "clearance", "part", "stop",
)  # fmt: skip
# The runs fly from `begin` until `until`, s; all times lie between.
INTEGERS = ("runs", "max_steps", "time_count")
REALS = ("begin", "until", "rtol", "atol", "bin_count", "bin_rate")


def write_kernel(lanes: Lanes, problem: Problem, method: Method) -> None:
    """Emit the function "kernel" for `problem` into the module of `lanes`; its arguments are `ARGUMENTS`."""
    kinds = [I64 if name in INTEGERS else ir.DoubleType() if name in REALS else POINTER for name in ARGUMENTS]
    function = ir.Function(lanes.module, ir.FunctionType(VOID, kinds), "kernel")
    function.attributes.add("nounwind")
    _Kernel(lanes, problem, method, function).write()


class _Kernel:
    """Emits the kernel; `self.at` maps the names of its arguments to values."""

    def __init__(self, lanes: Lanes, problem: Problem, method: Method, function: ir.Function) -> None:
        self.lanes, self.problem, self.method = lanes, problem, method
        self.code = code = Code(lanes, ir.IRBuilder(function.append_basic_block()))
        self.at = dict(zip(ARGUMENTS, function.args, strict=True))
        n = problem.size
        self.stages = stages = Stages(code, method, problem.rates)
        self.project = define(lanes, problem.project)
        self.margin = define(lanes, problem.margin) if problem.margin else None
        self.S, self.Y, self.P, self.K = stages.S, stages.Y, stages.P, stages.K
        self.t, self.h, self.count, self.limit = (code.reserve(1) for _ in range(4))
        self.active, self.when, self.drift = code.reserve(1), code.reserve(1), code.reserve(3)
        self.run, self.left = code.reserve(lanes.width, I64), code.reserve(1, I64)
        self.dense = Dense(code, method, n, define(lanes, without_drift(problem.project)))
        self.sampler = Sampler(code, self.dense, self.at, self.run)
        grid = Grid(code, self.at)
        self.judge = Judge(code, method, problem.judging, stages, self.dense, grid) if problem.judging else None
        self.touching = StepTouching(code, problem.touch, stages, self.dense, self.at) if problem.touch else None
        self.low, self.touched = code.reserve(1), code.reserve(1)

    def write(self) -> None:
        code, builder = self.code, self.code.builder
        builder.store(ir.Constant(I64, self.lanes.width), self.left)
        self.begin, self.until = (code.value(self._real(name)) for name in ("begin", "until"))
        self.rtol, self.atol = (code.value(self._real(name)) for name in ("rtol", "atol"))
        for memory, length in ((self.S, self.problem.size), (self.P, self.problem.parameters)):
            with code.count(length) as i:
                code.store(0.0, memory, i)
        for memory in (self.t, self.h, self.count):
            code.store(0.0, memory)
        for memory in (self.active, self.touched):
            code.store(0.0, memory)
        with code.count(self.lanes.width) as lane:
            code.put(ir.Constant(I64, -1), self.run, lane)
            self._load_next(lane)
        self._first_rates()
        with code.loop(lambda: builder.and_(self._more(), not_stopped(builder, self.at["stop"]))):
            self._iterate()
        builder.ret_void()

    def _more(self) -> ir.Value:
        """Whether a lane has a run."""
        builder = self.code.builder
        return builder.icmp_signed(">", builder.load(self.left, typ=I64), ir.Constant(I64, 0))

    def _real(self, name: str) -> ir.Value:
        value = self.at[name]
        return value if self.lanes.precision == "double" else self.code.builder.fptrunc(value, self.lanes.scalar)

    # One attempted step in every lane ---------------------------------------------------------------------------

    def _iterate(self) -> None:
        code = self.code
        t, active = code.load(self.t), code.load(self.active) > 0.0
        h = self._trial_step(t)
        last = t + 1.0001 * h >= self.until
        h = code.select(last, self.until - t, h)
        error, largest = self.stages.attempt(t, h, self.rtol, self.atol)
        t_new = code.select(last, self.until, t + h)
        accepted = (error <= 1.0) & active
        code.call(self.project, self.Y, self.Y, self.drift)
        guarded = None
        if self.margin is not None:
            code.store(t_new, self.when)
            margin = code.reserve(1)
            code.call(self.margin, self.when, self.Y, self.P, margin)
            guarded = accepted & ~(code.load(margin) > 0.0)
            accepted = accepted & ~guarded
        accepted = accepted & ~(code.load(self.low) > 0.0) & ~(code.load(self.touched) > 0.0)
        lost = accepted & ~(largest < MAX_STATE)
        self._finish_step(t, h, t_new, error, accepted & ~lost, guarded, lost, active)

    def _trial_step(self, t: Value) -> Value:
        """The step to try: from the step controller, or for a new run a conservative guess from the norms of s, ṡ."""
        code, n = self.code, self.problem.size
        size, rate = code.reserve(1), code.reserve(1)
        h = code.load(self.h)
        new = h <= 0.0
        code.store(0.0, self.low)
        with code.when(code.any(new)):
            if self.margin is not None:
                margin = code.reserve(1)
                code.call(self.margin, self.t, self.S, self.P, margin)
                code.store(code.select(new & (code.load(margin) <= 0.0), 1.0, 0.0), self.low)
            code.store(0.0, size)
            code.store(0.0, rate)
            with code.count(n) as i:
                value, slope = code.load(self.S, i), code.load(self.K, i)
                scale = self.atol + self.rtol * code.fabs(value)
                value, slope = value / scale, slope / scale
                code.store(code.load(size) + value * value, size)
                code.store(code.load(rate) + slope * slope, rate)
            first = 0.01 * code.sqrt(code.load(size) / code.most(code.load(rate), 1e-10))
            # At most 10 ms. A run with non-finite rates ends in `_end_runs`, whatever its step.
            code.store(code.select(new, code.most(code.least(first, 1e-2), 1e-6), h), self.h)
        return code.load(self.h)

    def _factor(self, error: Value) -> Value:
        """Ratio of the next step size to this one: `SAFETY` times the ratio that would just meet the tolerance."""
        code = self.code
        order = 8 if self.method.stages > 8 else 5
        factor = SAFETY * code.power(code.most(error, 1e-12), -1 / order)
        return code.least(code.most(factor, LEAST_FACTOR), MOST_FACTOR)

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
        if self.method.errors[0][-1] == 0:  # otherwise f at the end is known, up to projection
            self.stages.evaluate(t_new, self.method.stages)
        step = Step(self.stages, t, h, t_new)
        self.dense.begin()
        if self.touching is not None:
            touched, t_new = self.touching.take(step, accepted)
            code.store(code.select(touched, 1.0, code.load(self.touched)), self.touched)
        self.sampler.take(replace(step, t_new=t_new), accepted)
        self._if_judged(lambda judge: judge.take(step, accepted, self.rtol + self.atol))
        if self.touching is not None:
            with code.when(code.any(touched)):
                self.dense.evaluate(step, t_new)
                with code.count(n) as i:
                    state = code.select(touched, code.load(self.dense.state, i), code.load(self.Y, i))
                    code.store(state, self.Y, i)
        with code.count(n) as i:
            code.store(code.select(accepted, code.load(self.Y, i), code.load(self.S, i)), self.S, i)
        self.stages.carry(accepted)
        self._record_knot(t_new, accepted)

        count = code.load(self.count) + 1.0
        code.store(count, self.count)
        t_now = code.select(accepted, t_new, t)
        code.store(t_now, self.t)
        # `limit` keeps the step from growing right after a rejection. A NaN error shrinks it by LEAST_FACTOR.
        factor = self._factor(error)
        factor = code.select(accepted, code.select(code.load(self.limit) > 0.0, code.least(factor, 1.0), factor),
                             code.select(factor < 1.0, factor, LEAST_FACTOR))  # fmt: skip
        if guarded is not None:
            factor = code.select(guarded, 0.5, factor)
        code.store(code.select(accepted, 0.0, 1.0), self.limit)
        h_next = code.select(active, h * factor, h)
        code.store(h_next, self.h)
        self._end_runs(t_now, h_next, count, guarded, lost, accepted, active)

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
        value = code.select(lost, float(DIVERGED), value)
        value = code.select(accepted & (t >= self.until), float(COMPLETED), value)
        value = code.select(code.load(self.touched) > 0.0, float(COLLIDED), value)
        value = code.select(self._first_rate_undefined(), float(UNDEFINED), value)
        if guarded is not None:  # the guard says why, also where a rate is not finite
            value = code.select(code.load(self.low) > 0.0, float(SINGULAR), value)
        value = code.select(active, value, -1.0)
        code.store(value, status)
        with code.when(code.any(value >= 0.0)):
            with code.each(value >= 0.0) as lane:
                self._store_result(lane, builder.fptosi(code.scalar(status, lane), I64))
                self._load_next(lane)
            self._first_rates()

    def _first_rates(self) -> None:
        """Evaluate the rates of new runs and judge their starts. All other lanes stay bit-identical."""
        new = self.code.load(self.h) <= 0.0
        self.stages.start(self.t, new)
        self._if_judged(lambda judge: judge.begin(new, self.t))
        if self.touching is not None:
            code = self.code
            self.dense.begin()
            touched = code.select(self.touching.begin(new), 1.0, 0.0)
            code.store(code.select(new, touched, code.load(self.touched)), self.touched)

    def _max_steps(self) -> Value:
        code = self.code
        return code.value(code.builder.sitofp(self.at["max_steps"], self.lanes.scalar))

    def _first_rate_undefined(self) -> Value:
        """Whether a run is at its start and has a non-finite rate."""
        code = self.code
        total, at_start = code.reserve(1), code.load(self.t) <= self.begin
        code.store(0.0, total)
        with code.when(code.any(at_start)), code.count(self.problem.size) as i:
            code.store(code.load(total) + 0.0 * code.load(self.K, i), total)
        return at_start & ~(code.load(total).compare("==", 0.0))

    def _store_result(self, lane: ir.Value, status: ir.Value) -> None:
        code, builder = self.code, self.code.builder
        run, time = code.scalar(self.run, lane, I64), code.scalar(self.t, lane)
        copy_lane(code, self.S, lane, self.at["final"], run, self.problem.size, out=True)
        code.put(as_double(code, time), self.at["end"], run)
        code.put(status, self.at["status"], run)
        code.put(builder.fptosi(code.scalar(self.count, lane), I64), self.at["steps"], run)
        self.sampler.finish(lane)
        self._if_judged(lambda judge: judge.store(lane, run, builder.fsub(time, self._real("begin"))))
        if self.touching is not None:
            self.touching.touching.store(lane, run)

    def _if_judged(self, emit: Callable[[Judge], None]) -> None:
        """Emit code that runs if the caller wants reductions, of a problem that has any."""
        if self.judge is None:
            return
        builder = self.code.builder
        address = builder.ptrtoint(self.at["reductions"], I64)
        with self.code.when(builder.icmp_unsigned("!=", address, ir.Constant(I64, 0))):
            emit(self.judge)

    def _load_next(self, lane: ir.Value) -> None:
        """Load the next start into `lane`, or idle the lane if the queue is empty."""
        code, builder = self.code, self.code.builder
        run = builder.atomic_rmw("add", self.at["queue"], ir.Constant(I64, 1), "monotonic")
        zero, one = (ir.Constant(self.lanes.scalar, number) for number in (0.0, 1.0))
        with builder.if_else(builder.icmp_signed("<", run, self.at["runs"])) as (more, none):
            with more:
                code.put(run, self.run, lane)
                code.put(one, self.active, lane)
                copy_lane(code, self.S, lane, self.at["starts"], run, self.problem.size, out=False)
                copy_lane(code, self.P, lane, self.at["parameters"], run, self.problem.parameters, out=False)
                code.put(self._real("begin"), self.t, lane)
                for memory in (self.h, self.count, self.limit):
                    code.put(zero, memory, lane)
                self.sampler.reset(lane)
            with none:
                code.put(zero, self.active, lane)
                builder.store(builder.sub(builder.load(self.left, typ=I64), ir.Constant(I64, 1)), self.left)

    def _record_knot(self, t: Value, accepted: Value) -> None:
        """Store time and drift of an accepted step of lane 0, if the caller wants them (for a single run)."""
        code, builder = self.code, self.code.builder
        wanted = builder.icmp_unsigned("!=", builder.ptrtoint(self.at["knots"], I64), ir.Constant(I64, 0))
        first = builder.extract_element(accepted.raw, ir.Constant(ir.IntType(32), 0))
        with code.when(builder.and_(wanted, first)):
            zero = ir.Constant(I64, 0)
            row = builder.fptosi(code.scalar(self.at["knots"], zero, ir.DoubleType()), I64)
            base = builder.add(builder.mul(row, ir.Constant(I64, 4)), ir.Constant(I64, 1))
            code.put(
                as_double(code, builder.extract_element(t.raw, ir.Constant(ir.IntType(32), 0))), self.at["knots"], base
            )
            for k in range(3):
                value = builder.extract_element(code.load(self.drift, k).raw, ir.Constant(ir.IntType(32), 0))
                place = builder.add(base, ir.Constant(I64, k + 1))
                code.put(as_double(code, value), self.at["knots"], place)
            counted = builder.sitofp(builder.add(row, ir.Constant(I64, 1)), ir.DoubleType())
            code.put(counted, self.at["knots"], zero)


def without_drift(project: Program) -> Program:
    """The program s → s projected onto the manifold, without the drift output."""
    return needed(Program("onto", project.inputs, project.operations, project.outputs[:1]))
