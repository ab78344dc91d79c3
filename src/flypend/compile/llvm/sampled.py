"""The kernel of sampled flights: measure, command, hold, in vectors of lanes, one flight per lane.

All flights of one kernel have the same control ticks, so lanes go in step; what a flight gives does not depend on its
neighbours. `flypend.flight.sampled` is the same, one flight at a time, in Python.
"""

from __future__ import annotations

from collections.abc import Sequence

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.random import PER_TICK, define_normals
from flypend.compile.llvm.reductions import Reductions
from flypend.compile.llvm.runge_kutta import COMPLETED, DIVERGED, UNDEFINED
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code, Lanes, Value
from flypend.compile.sampled_problem import SampledProblem, Stretch
from flypend.model.state import MAX_STATE

ARGUMENTS = (
    "starts", "parameters", "plant", "seeds", "runs", "ticks",
    "sample_ticks", "sample_count", "judged", "rows", "row_count",
    "samples", "reductions", "final", "end", "status",
)  # fmt: skip
INTEGERS = ("runs", "ticks", "sample_count", "row_count")


def write_kernel(lanes: Lanes, problem: SampledProblem) -> None:
    """Write the function "kernel" for `problem` into the module of `lanes`; its arguments are `ARGUMENTS`."""
    kinds = [I64 if name in INTEGERS else POINTER for name in ARGUMENTS]
    function = ir.Function(lanes.module, ir.FunctionType(VOID, kinds), "kernel")
    _Kernel(lanes, problem, function).write()


class _Kernel:
    """Writes the kernel, part by part; `self.at` are its arguments by name."""

    def __init__(self, lanes: Lanes, problem: SampledProblem, function: ir.Function) -> None:
        self.lanes, self.problem = lanes, problem
        self.code = code = Code(lanes, ir.IRBuilder(function.append_basic_block()))
        self.at = dict(zip(ARGUMENTS, function.args, strict=True))
        names = ("command", "world", "twin", "lag", "loop", "measure", "gusts", "observe_first", "observe")
        programs = {name: getattr(problem, name) for name in names}
        self.call = {name: define(lanes, program) for name, program in programs.items() if program is not None}
        self.normals = define_normals(lanes) if problem.random else None
        n, k = problem.size, problem.rotors
        self.state, self.next, self.measured, self.imagined = (code.reserve(n + k) for _ in range(4))
        self.model, self.planned = code.reserve(k), code.reserve(k)  # forces of the rotors that the law believes in
        self.P, self.wind, self.gust = code.reserve(problem.parameters), code.reserve(6), code.reserve(6)
        self.ring = code.reserve(problem.depth * len(problem.idle))
        self.forces, self.draws = code.reserve(6), code.reserve(PER_TICK)
        self.believed, self.known, self.estimate = (code.reserve(6) for _ in range(3))
        self.t, self.alive, self.status, self.end, self.timing = (
            code.reserve(i) for i in (1, 1, 1, 1, problem.world.inputs[4])
        )
        self.timings, self.noise, self.blowing = (code.reserve(length) for length in problem.inputs)
        self.seeds, self.tick_of_lane = code.reserve(lanes.width, I64), code.reserve(lanes.width, I64)
        self.cursor = code.reserve(1, I64)
        self.results = Reductions(code, problem.judge, problem.reductions)

    def write(self) -> None:
        code, builder, width = self.code, self.code.builder, self.lanes.width
        groups = builder.sdiv(builder.add(self.at["runs"], ir.Constant(I64, width - 1)), ir.Constant(I64, width))
        self._take_inputs()
        with code.count(PER_TICK) as i:  # what is not drawn is 0
            code.store(0.0, self.draws, i)
        with code.count(groups) as group:
            self.first = builder.mul(group, ir.Constant(I64, width))
            self._begin()
            self._sample(ir.Constant(I64, 0))
            with code.count(self.at["ticks"]) as tick, code.when(code.any(code.load(self.alive) > 0.0)):
                self._tick(tick)
                self._sample(builder.add(tick, ir.Constant(I64, 1)))
            self._store_results()
        builder.ret_void()

    def _take_inputs(self) -> None:
        """Spread the numbers of the plant over all lanes."""
        code, place = self.code, 0
        for memory, length in zip((self.timings, self.noise, self.blowing), self.problem.inputs, strict=True):
            for i in range(length):
                number = code.scalar(self.at["plant"], ir.Constant(I64, place + i), ir.DoubleType())
                code.store(code.value(number), memory, i)
            place += length

    # Begin and end --------------------------------------------------------------------------------------------

    def _run(self, lane: ir.Value) -> ir.Value:
        """The run in `lane`; lanes past the last run fly the last run again."""
        builder = self.code.builder
        run, last = builder.add(self.first, lane), builder.sub(self.at["runs"], ir.Constant(I64, 1))
        return builder.select(builder.icmp_signed("<", run, last), run, last)

    def _begin(self) -> None:
        code, problem = self.code, self.problem
        with code.count(self.lanes.width) as lane:
            run = self._run(lane)
            self._copy(self.at["starts"], run, self.state, lane, problem.size + problem.rotors)
            self._copy(self.at["parameters"], run, self.P, lane, problem.parameters)
            code.put(code.scalar(self.at["seeds"], run, I64), self.seeds, lane)
            self.results.reset(lane)
        for i in range(problem.rotors):
            code.store(code.load(self.state, problem.size + i), self.model, i)
        for slot in range(problem.depth):
            for i, value in enumerate(problem.idle):
                # Commands that are rotor forces: the rotors are at what they were told.
                before = value if problem.loop is not None else code.load(self.state, problem.size + i)
                code.store(before, self.ring, slot * len(problem.idle) + i)
        for memory in (self.gust, self.wind, self.forces, self.believed, self.known, self.estimate):
            for i in range(6):
                code.store(0.0, memory, i)
        code.store(1.0, self.alive)
        code.store(float(COMPLETED), self.status)
        ticks = code.value(code.builder.sitofp(self.at["ticks"], self.lanes.scalar))
        code.store(ticks * self.problem.period, self.end)
        code.builder.store(ir.Constant(I64, 0), self.cursor)

    def _copy(self, rows: ir.Value, row: ir.Value, memory: ir.Value, lane: ir.Value, length: int) -> None:
        code, builder = self.code, self.code.builder
        with code.count(length) as i:
            there = builder.add(builder.mul(row, ir.Constant(I64, length)), i)
            here = builder.add(builder.mul(i, ir.Constant(I64, self.lanes.width)), lane)
            code.put(code.scalar(rows, there), memory, here)

    def _store_results(self) -> None:
        code, builder, width = self.code, self.code.builder, ir.Constant(I64, self.lanes.width)
        with code.count(self.lanes.width) as lane:
            run = builder.add(self.first, lane)
            with code.when(builder.icmp_signed("<", run, self.at["runs"])):
                with code.count(self.problem.size) as i:
                    here = builder.add(builder.mul(i, width), lane)
                    there = builder.add(builder.mul(run, ir.Constant(I64, self.problem.size)), i)
                    code.put(code.scalar(self.state, here), self.at["final"], there)
                code.put(code.scalar(self.end, lane), self.at["end"], run)
                code.put(builder.fptosi(code.scalar(self.status, lane), I64), self.at["status"], run)
                self.results.store(lane, run, self.at["reductions"])

    # One control tick -----------------------------------------------------------------------------------------

    def _tick(self, tick: ir.Value) -> None:
        code, problem = self.code, self.problem
        time = code.value(code.builder.sitofp(tick, self.lanes.scalar)) * problem.period
        self._draw(tick)
        if problem.measure is not None:
            code.call(self.call["measure"], self.state, self.draws, self.noise, self.measured)
        else:
            self._move(self.state, self.measured, problem.size)
        self._observe(tick)
        self._imagine(problem.ahead, tick)
        code.store(time + problem.latency, self.t)
        commanded = code.vector_at(self.ring, self._slot(tick, 0))
        code.call(self.call["command"], self.t, self.imagined, self.planned, self.forces, self.P, commanded)
        self._end_runs(self._undefined(commanded), UNDEFINED, time)
        self._move_model(tick)
        if problem.gusts is not None:
            drawn = code.vector_at(self.draws, 18)
            code.call(self.call["gusts"], self.gust, drawn, self.blowing, self.gust, self.wind)
        self._move(self.state, self.next, problem.size + problem.rotors)
        rotors = code.vector_at(self.next, problem.size)
        for k, stretch in enumerate(problem.flown):
            timing = code.vector_at(self.timings, k * problem.world.inputs[4])
            command = code.vector_at(self.ring, self._slot(tick, stretch.age))
            with code.count(stretch.steps):
                self._step("world", self.next, rotors, command, self.wind, timing)
        self._end_runs(self._lost(), DIVERGED, time)
        alive = code.load(self.alive) > 0.0
        with code.count(problem.size + problem.rotors) as i:
            code.store(code.select(alive, code.load(self.next, i), code.load(self.state, i)), self.state, i)

    def _draw(self, tick: ir.Value) -> None:
        code = self.code
        if self.normals is None:
            return
        for lane in range(self.lanes.width):
            code.put(tick, self.tick_of_lane, ir.Constant(I64, lane))
        code.call(self.normals, self.seeds, self.tick_of_lane, self.draws)

    def _observe(self, tick: ir.Value) -> None:
        code, builder = self.code, self.code.builder
        if self.problem.observe is None:
            return
        with builder.if_else(builder.icmp_signed("==", tick, ir.Constant(I64, 0))) as (first, later):
            with first:
                code.call(self.call["observe_first"], self.measured, self.model, self.believed, self.known)
            with later:
                code.store(self.problem.period, self.t)
                momenta = (self.believed, self.known, self.estimate)
                code.call(self.call["observe"], self.measured, self.model, *momenta, self.t, *momenta, self.forces)

    def _imagine(self, stretches: Sequence[Stretch], tick: ir.Value) -> None:
        """State and rotors of the twin after `stretches` from the measurement."""
        self._move(self.measured, self.imagined, self.problem.size)
        self._move(self.model, self.planned, self.problem.rotors)
        self._advance(stretches, tick)

    def _move_model(self, tick: ir.Value) -> None:
        """Move the rotors that the law believes in over the period: with the twin, if their command depends on it."""
        code = self.code
        if self.problem.lag is None:
            self._imagine(self.problem.within, tick)
            self._move(self.planned, self.model, self.problem.rotors)
            return
        for stretch in self.problem.within:
            for i, value in enumerate(stretch.timing):
                code.store(value, self.timing, i)
            command = code.vector_at(self.ring, self._slot(tick, stretch.age))
            with code.count(stretch.steps):
                code.call(self.call["lag"], self.model, command, self.timing, self.model)

    def _advance(self, stretches: Sequence[Stretch], tick: ir.Value) -> None:
        """Move the twin through `stretches`; equal ones that follow each other become a loop."""
        code, builder = self.code, self.code.builder
        place = 0
        while place < len(stretches):
            first = stretches[place]
            alike = 1
            while place + alike < len(stretches) and stretches[place + alike] == Stretch(
                first.age - alike, first.steps, first.timing
            ):
                alike += 1
            for i, value in enumerate(first.timing):
                code.store(value, self.timing, i)
            with code.count(alike) as younger:
                age = builder.sub(ir.Constant(I64, first.age), younger)
                command = code.vector_at(self.ring, self._slot(tick, age))
                with code.count(first.steps):
                    self._step("twin", self.imagined, self.planned, command, self.forces, self.timing)
            place += alike

    def _step(
        self, which: str, state: ir.Value, rotors: ir.Value, command: ir.Value, wind: ir.Value, timing: ir.Value
    ) -> None:
        code = self.code
        if self.problem.loop is not None:
            forces = code.reserve(self.problem.rotors)
            code.call(self.call["loop"], command, code.vector_at(state, 15), forces)
            command = forces
        code.call(self.call[which], state, rotors, command, wind, timing, state, rotors)

    def _slot(self, tick: ir.Value, age: int | ir.Value) -> ir.Value:
        """Index of the first vector of the command computed `age` ticks before `tick`."""
        builder, depth = self.code.builder, ir.Constant(I64, self.problem.depth)
        age = ir.Constant(I64, age) if isinstance(age, int) else age
        slot = builder.srem(builder.add(builder.sub(tick, age), depth), depth)
        return builder.mul(slot, ir.Constant(I64, len(self.problem.idle)))

    def _move(self, source: ir.Value, target: ir.Value, length: int) -> None:
        with self.code.count(length) as i:
            self.code.store(self.code.load(source, i), target, i)

    # Ends of runs ---------------------------------------------------------------------------------------------

    def _undefined(self, commanded: ir.Value) -> Value:
        code = self.code
        total = code.value(0.0)
        for i in range(len(self.problem.idle)):
            total = total + 0.0 * code.load(commanded, i)
        return ~total.compare("==", 0.0)

    def _lost(self) -> Value:
        code = self.code
        largest = code.reserve(1)
        code.store(0.0, largest)
        with code.count(self.problem.size) as i:
            size = code.fabs(code.load(self.next, i))
            before = code.load(largest)
            code.store(code.select(size <= before, before, size), largest)  # NaN stays
        return ~(code.load(largest) < MAX_STATE)

    def _end_runs(self, where: Value, status: int, time: Value) -> None:
        code = self.code
        ending = where & (code.load(self.alive) > 0.0)
        code.store(code.select(ending, float(status), code.load(self.status)), self.status)
        code.store(code.select(ending, time, code.load(self.end)), self.end)
        code.store(code.select(ending, 0.0, code.load(self.alive)), self.alive)

    # Samples --------------------------------------------------------------------------------------------------

    def _sample(self, tick: ir.Value) -> None:
        """Store and reduce the state at `tick`, if it is one of the sample ticks."""
        code, builder = self.code, self.code.builder
        cursor = builder.load(self.cursor, typ=I64)
        with (
            code.when(builder.icmp_signed("<", cursor, self.at["sample_count"])),
            code.when(builder.icmp_signed("==", code.scalar(self.at["sample_ticks"], cursor, I64), tick)),
        ):
            time = code.value(builder.sitofp(tick, self.lanes.scalar)) * self.problem.period
            code.store(time, self.t)
            alive = code.load(self.alive) > 0.0
            with code.when(builder.icmp_signed("!=", code.scalar(self.at["judged"], cursor, I64), ir.Constant(I64, 0))):
                self.results.update(alive, self.t, self.state, self.P)
            following = builder.add(cursor, ir.Constant(I64, 1))
            row, after = (code.scalar(self.at["rows"], place, I64) for place in (cursor, following))
            with code.when(builder.icmp_signed(">", after, row)):  # none is, where the caller keeps none
                self._store_samples(row)
            builder.store(following, self.cursor)

    def _store_samples(self, kept: ir.Value) -> None:
        code, builder = self.code, self.code.builder
        length = self.problem.size + self.problem.rotors
        with code.count(self.lanes.width) as lane:
            run = builder.add(self.first, lane)
            with code.when(builder.icmp_signed("<", run, self.at["runs"])):
                row = builder.add(builder.mul(run, self.at["row_count"]), kept)
                with code.count(length) as i:
                    here = builder.add(builder.mul(i, ir.Constant(I64, self.lanes.width)), lane)
                    there = builder.add(builder.mul(row, ir.Constant(I64, length)), i)
                    code.put(code.scalar(self.state, here), self.at["samples"], there)
