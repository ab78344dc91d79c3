"""The kernel of sampled flights: measure, command, hold, in SIMD lanes, one flight per lane.

All flights of a kernel share the control ticks, so the lanes run in lockstep. The result of a flight does not depend on
its neighbours. `flypend.flight.sampled` does the same in Python, one flight at a time.
"""

from __future__ import annotations

from functools import reduce
from operator import add

from llvmlite import ir

from flypend.compile.llvm.emit import define, define_routine
from flypend.compile.llvm.random import PER_TICK, define_normals, whole_blocks
from flypend.compile.llvm.reductions import Reductions
from flypend.compile.llvm.runge_kutta import COLLIDED, COMPLETED, DIVERGED, UNDEFINED
from flypend.compile.llvm.sensors import Sensors
from flypend.compile.llvm.stopping import not_stopped
from flypend.compile.llvm.touching import Touching
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code, Context, Lanes, Value
from flypend.compile.llvm.worlds import MUJOCO_ARGUMENTS, Equations, Mujoco, Way, World
from flypend.compile.sampled_problem import GUSTS, EquationsProblem, SampledProblem
from flypend.model.state import MAX_STATE

INTEGERS = ("runs", "ticks", "sample_count", "row_count", "begun")
ARGUMENTS = (
    "starts", "parameters", "plant", "seeds", "runs", "ticks",
    "sample_ticks", "sample_count", "judged", "rows", "row_count",
    "samples", "reductions", "final", "end", "status", "clearance", "part", "stop",
)  # fmt: skip
# Arguments for a flight in pieces: what one call leaves to the next, the ticks that are flown already, and impulses
# (runs, 6) on vehicle and bob, N s, in effect at once. A call flies on to `ticks`; `sample_ticks` are of the piece.
RESUMED_ARGUMENTS = ("context", "begun", "impulses")
STRANDS = 4  # partial sums, which hide the latency of additions


def arguments(problem: SampledProblem) -> tuple[str, ...]:
    """Names of the kernel's arguments for `problem`: `ARGUMENTS`, and those for MuJoCo or for flights in pieces."""
    if problem.resuming is not None:
        return ARGUMENTS + RESUMED_ARGUMENTS
    return ARGUMENTS if isinstance(problem.world, EquationsProblem) else ARGUMENTS + MUJOCO_ARGUMENTS


def write_kernel(lanes: Lanes, problem: SampledProblem) -> None:
    """Emit the function "kernel" for `problem` into the module of `lanes`; for its arguments see `arguments`.

    For flights in pieces, which fly one group of `lanes.width` runs, there is another function: "context_size" stores
    the length of the context in bytes.
    """
    kinds = [I64 if name in INTEGERS else POINTER for name in arguments(problem)]
    function = ir.Function(lanes.module, ir.FunctionType(VOID, kinds), "kernel")
    kernel = _Kernel(lanes, problem, function)
    kernel.write()
    if kernel.code.context is not None:
        told = ir.Function(lanes.module, ir.FunctionType(VOID, [POINTER]), "context_size")
        builder = ir.IRBuilder(told.append_basic_block())
        builder.store(ir.Constant(I64, kernel.code.context.size), told.args[0])
        builder.ret_void()


class _Kernel:
    """Emits the kernel; `self.at` maps the names of its arguments to values."""

    def __init__(self, lanes: Lanes, problem: SampledProblem, function: ir.Function) -> None:
        self.lanes, self.problem = lanes, problem
        self.at = dict(zip(arguments(problem), function.args, strict=True))
        context = Context(self.at["context"]) if problem.resuming else None
        self.code = code = Code(lanes, ir.IRBuilder(function.append_basic_block()), context)
        # The board's memory slides through a longer one, so that the commands in transit, a queue, stay where they are.
        slide = problem.board.slide()
        self.board = define_routine(lanes, problem.board, slide, inline=True)
        self.stride = slide or problem.memory
        self.strides = -(-problem.memory // self.stride)  # then it is moved back to where it does not overlap itself
        programs = {name: getattr(problem, name) for name in ("begin", "measure", "gusts")}
        programs["strike"] = problem.resuming.strike if problem.resuming else None
        self.call = {name: define(lanes, p, inline=True) for name, p in programs.items() if p is not None}
        self.normals = define_normals(lanes, problem.drawn) if problem.random else None
        self.sensors = Sensors(code, problem.sensing) if problem.sensing is not None else None
        n, k = problem.size, problem.rotors
        self.states = code.keep(2 * (1 + n + k))  # before and after a tick, in turn; each preceded by the time
        self.measured, self.none = code.reserve(1 + problem.measured), code.reserve(1)
        self.memory = code.keep(self.strides * self.stride + problem.memory)
        self.P, self.wind, self.t = code.reserve(problem.gains), code.reserve(6), code.reserve(1)
        self.gust = code.keep(problem.gust)
        self.ring = code.keep(problem.depth * problem.command)
        self.draws = code.reserve(max(PER_TICK, whole_blocks(problem.drawn.stop)))
        self.alive, self.status, self.end = (code.keep(1) for _ in range(3))
        self.given = [code.reserve(length) for length in problem.inputs]
        self.schedule, self.timings, self.noise, self.blowing, self.params = self.given
        self.seeds, self.tick_of_lane = code.reserve(lanes.width, I64), code.reserve(lanes.width, I64)
        self.cursor = code.reserve(1, I64)
        self.results = Reductions(code, problem.judge, problem.reductions)
        self.touching = Touching(code, problem.touch, self.at) if problem.touch is not None else None
        self.world = self._world()

    def _world(self) -> World:
        world = self.problem.world
        if isinstance(world, EquationsProblem):
            return Equations(self.code, self.problem, world)
        return Mujoco(self.code, self.problem, world, self.at)

    def write(self) -> None:
        code, builder, width = self.code, self.code.builder, self.lanes.width
        groups = builder.sdiv(builder.add(self.at["runs"], ir.Constant(I64, width - 1)), ir.Constant(I64, width))
        self._load_inputs()
        with code.count(PER_TICK) as i:  # without random numbers, all draws are 0
            code.store(0.0, self.draws, i)
        with code.count(groups if self.problem.resuming is None else 1) as group:
            self.first = builder.mul(group, ir.Constant(I64, width))
            self._load_runs()
            begun = self._begin() if self.problem.resuming is None else self._resume()
            with code.count(builder.sub(self.at["ticks"], begun)) as flown, code.when(self._flying()):
                tick = builder.add(begun, flown)
                self._tick(tick)
                self._sample(builder.add(tick, ir.Constant(I64, 1)))
            self._store_results()
        builder.ret_void()

    def _flying(self) -> ir.Value:
        """Whether a lane is in flight, and the call not stopped."""
        code = self.code
        alive = code.any(code.load(self.alive) > 0.0)
        return code.builder.and_(alive, not_stopped(code.builder, self.at["stop"]))

    def _load_inputs(self) -> None:
        """Broadcast the plant parameters to all lanes."""
        code, place = self.code, 0
        for memory, length in zip(self.given, self.problem.inputs, strict=True):
            for i in range(length):
                number = code.scalar(self.at["plant"], ir.Constant(I64, place + i), ir.DoubleType())
                code.store(code.value(number), memory, i)
            place += length

    # Begin and end --------------------------------------------------------------------------------------------

    def _run(self, lane: ir.Value) -> ir.Value:
        """The run in `lane`; surplus lanes repeat the last run."""
        builder = self.code.builder
        run, last = builder.add(self.first, lane), builder.sub(self.at["runs"], ir.Constant(I64, 1))
        return builder.select(builder.icmp_signed("<", run, last), run, last)

    def _state(self, tick: ir.Value) -> ir.Value:
        """Address of the state at `tick`; the vector before it is for the time."""
        builder, length = self.code.builder, 1 + self.problem.size + self.problem.rotors
        odd = builder.mul(builder.and_(tick, ir.Constant(I64, 1)), ir.Constant(I64, length))
        return self.code.vector_at(self.states, builder.add(odd, ir.Constant(I64, 1)))

    def _load_runs(self) -> None:
        """Load gains and seeds, and put the cursor to the first sample."""
        code = self.code
        with code.count(self.lanes.width) as lane:
            run = self._run(lane)
            self._copy(self.at["parameters"], run, self.P, lane, self.problem.gains)
            code.put(code.scalar(self.at["seeds"], run, I64), self.seeds, lane)
        code.builder.store(ir.Constant(I64, 0), self.cursor)

    def _resume(self) -> ir.Value:
        """Begin, or go on from the context; then strike. Returns the ticks that are flown already."""
        code, begun = self.code, self.at["begun"]
        with code.when(code.builder.icmp_signed("==", begun, ir.Constant(I64, 0))):
            self._begin()
        code.store(code.select(code.load(self.alive) > 0.0, self._last(), code.load(self.end)), self.end)
        state, impulses = self._state(begun), code.reserve(6)
        with code.count(self.lanes.width) as lane:
            self._copy(self.at["impulses"], self._run(lane), impulses, lane, 6)
        with code.when(code.any(code.load(self.alive) > 0.0)):
            code.call(self.call["strike"], state, impulses, state)
        return begun

    def _last(self) -> Value:
        """The time of the last tick, s."""
        return self.code.value(self.code.builder.sitofp(self.at["ticks"], self.lanes.scalar)) * self.problem.period

    def _begin(self) -> ir.Value:
        """Begin at the starts; return the tick, 0."""
        code, problem = self.code, self.problem
        state = self._state(ir.Constant(I64, 0))
        with code.count(self.lanes.width) as lane:
            self._copy(self.at["starts"], self._run(lane), state, lane, problem.size + problem.rotors)
            self.results.reset(lane)
        command = code.reserve(problem.command)
        memory, _ = self._memories(ir.Constant(I64, 0))
        given = [code.vector_at(state, problem.size)]
        if self.sensors is not None:
            given.append(self.sensors.begin(state, self.seeds))
        code.call(self.call["begin"], *given, memory, command)
        for slot in range(problem.depth):
            self._move(command, code.vector_at(self.ring, slot * problem.command), problem.command)
        for memory, length in ((self.gust, problem.gust), (self.wind, 6)):
            for i in range(length):
                code.store(0.0, memory, i)
        self.world.begin(self.first, state)
        code.store(1.0, self.alive)
        code.store(float(COMPLETED), self.status)
        code.store(self._last(), self.end)
        if self.touching is not None:
            self._end_runs(self.touching.begin(state, code.load(self.alive) > 0.0), COLLIDED, code.value(0.0))
        self._sample(ir.Constant(I64, 0))
        return ir.Constant(I64, 0)

    def _copy(self, rows: ir.Value, row: ir.Value, memory: ir.Value, lane: ir.Value, length: int) -> None:
        code, builder = self.code, self.code.builder
        with code.count(length) as i:
            there = builder.add(builder.mul(row, ir.Constant(I64, length)), i)
            here = builder.add(builder.mul(i, ir.Constant(I64, self.lanes.width)), lane)
            code.put(code.scalar(rows, there), memory, here)

    def _store_results(self) -> None:
        code, builder, width = self.code, self.code.builder, ir.Constant(I64, self.lanes.width)
        state = self._state(self.at["ticks"])
        with code.count(self.lanes.width) as lane:
            run = builder.add(self.first, lane)
            with code.when(builder.icmp_signed("<", run, self.at["runs"])):
                with code.count(self.problem.size) as i:
                    here = builder.add(builder.mul(i, width), lane)
                    there = builder.add(builder.mul(run, ir.Constant(I64, self.problem.size)), i)
                    code.put(code.scalar(state, here), self.at["final"], there)
                code.put(code.scalar(self.end, lane), self.at["end"], run)
                code.put(builder.fptosi(code.scalar(self.status, lane), I64), self.at["status"], run)
                self.results.store(lane, run, self.at["reductions"])
                if self.touching is not None:
                    self.touching.store(lane, run)

    # One control tick -----------------------------------------------------------------------------------------

    def _tick(self, tick: ir.Value) -> None:
        code, problem = self.code, self.problem
        state, after = self._state(tick), self._state(code.builder.add(tick, ir.Constant(I64, 1)))
        time = code.value(code.builder.sitofp(tick, self.lanes.scalar)) * problem.period
        self._draw(tick)
        command = code.vector_at(self.ring, self._slot(tick, 0))
        self._command(tick, time, state, command)
        self._end_runs(self._undefined(command), UNDEFINED, time)
        if problem.gusts is not None:
            drawn = code.vector_at(self.draws, GUSTS)
            code.call(self.call["gusts"], self.gust, drawn, self.blowing, self.gust, self.wind)
        if problem.resuming is None:
            self._advance(tick, state, after)
        else:
            self._advance_by_schedule(tick, state, after, problem.resuming.stretches)
        self.world.show(after)
        with code.when(code.any(self._far(after))):
            self._end_runs(self._lost(after), DIVERGED, time)
        if self.touching is not None:
            touched, share = self.touching.between(state, after, problem.period, code.load(self.alive) > 0.0)
            self._end_runs(touched, COLLIDED, time + share * problem.period)
        with code.when(code.any(code.load(self.alive) <= 0.0)):
            self._keep_ended(state, after)

    def _advance(self, tick: ir.Value, state: ir.Value, after: ir.Value) -> None:
        """Fly the intervals of the tick."""
        code, source = self.code, state
        for place, stretch in enumerate(self.problem.flown):
            timing = code.vector_at(self.timings, place * self.problem.timing)
            held = code.vector_at(self.ring, self._slot(tick, stretch.age))
            self.world.advance(place, stretch, held, self.wind, timing, Way(source, after))
            source = after

    def _advance_by_schedule(self, tick: ir.Value, state: ir.Value, after: ir.Value, stretches: int) -> None:
        """Fly the intervals that the schedule tells, some of which may be empty."""
        code = self.code
        assert isinstance(self.world, Equations)
        self._move(state, after, self.problem.size + self.problem.rotors)
        for place in range(stretches):
            age, steps = (code.scalar(self.schedule, self._entry(2 * place + i)) for i in range(2))
            held = code.vector_at(self.ring, self._slot(tick, code.builder.fptosi(age, I64)))
            timing = code.vector_at(self.timings, place * self.problem.timing)
            self.world.repeat(code.builder.fptosi(steps, I64), held, self.wind, timing, after)

    def _entry(self, vector: int) -> ir.Value:
        """Index of the first lane of a vector."""
        return ir.Constant(I64, vector * self.lanes.width)

    def _command(self, tick: ir.Value, time: Value, state: ir.Value, command: ir.Value) -> None:
        """Run the flight computer on what it measures of `state`, and store its `command`."""
        code, one = self.code, ir.Constant(I64, -1)
        measured = code.vector_at(state, one)
        if self.problem.measure is not None:
            measured = self.measured
            code.call(self.call["measure"], state, self.draws, self.noise, code.vector_at(measured, 1))
        if self.sensors is not None:
            measured = self.measured
            self.sensors.read(time, state, self.draws, code.vector_at(measured, 1))
        code.store(time, measured)
        before, after = self._memories(tick)
        code.call(self.board, before, measured, self.none, self.P, self.params, after, command)
        with code.when(code.builder.icmp_signed("==", self._left(tick), one)):
            self._move(after, self._memories(ir.Constant(I64, 0))[0], self.problem.memory)

    def _left(self, tick: ir.Value) -> ir.Value:
        """Strides that the board's memory has left after `tick`, less one."""
        builder, strides = self.code.builder, ir.Constant(I64, self.strides)
        return builder.sub(ir.Constant(I64, self.strides - 2), builder.srem(tick, strides))

    def _memories(self, tick: ir.Value) -> tuple[ir.Value, ir.Value]:
        """Addresses of the board's memory before and after `tick`: the second is one stride before the first."""
        builder, stride = self.code.builder, ir.Constant(I64, self.stride)
        left = builder.add(self._left(tick), ir.Constant(I64, 1))
        place = builder.mul(left, stride)
        return self.code.vector_at(self.memory, builder.add(place, stride)), self.code.vector_at(self.memory, place)

    def _keep_ended(self, state: ir.Value, after: ir.Value) -> None:
        """Keep the last state of the lanes that have ended."""
        code, alive = self.code, self.code.load(self.alive) > 0.0
        with code.count(self.problem.size + self.problem.rotors) as i:
            code.store(code.select(alive, code.load(after, i), code.load(state, i)), after, i)

    def _draw(self, tick: ir.Value) -> None:
        code = self.code
        if self.normals is None:
            return
        for lane in range(self.lanes.width):
            code.put(tick, self.tick_of_lane, ir.Constant(I64, lane))
        code.call(self.normals, self.seeds, self.tick_of_lane, self.draws)

    def _slot(self, tick: ir.Value, age: int | ir.Value) -> ir.Value:
        """Index of the first vector of the command computed `age` ticks before `tick`."""
        builder, depth = self.code.builder, ir.Constant(I64, self.problem.depth)
        back = ir.Constant(I64, age) if isinstance(age, int) else age
        slot = builder.srem(builder.add(builder.sub(tick, back), depth), depth)
        return builder.mul(slot, ir.Constant(I64, self.problem.command))

    def _move(self, source: ir.Value, target: ir.Value, length: int) -> None:
        with self.code.count(length) as i:
            self.code.store(self.code.load(source, i), target, i)

    # Ends of runs ---------------------------------------------------------------------------------------------

    def _undefined(self, commanded: ir.Value) -> Value:
        code = self.code
        total = code.value(0.0)
        for i in range(self.problem.command):
            total = total + 0.0 * code.load(commanded, i)
        return ~total.compare("==", 0.0)

    def _far(self, state: ir.Value) -> Value:
        """Whether |s| may exceed the limit in an entry, from the length of the whole vector."""
        code = self.code
        sums = [code.value(0.0)] * STRANDS
        for i in range(self.problem.size):
            entry = code.load(state, i)
            sums[i % STRANDS] = sums[i % STRANDS] + entry * entry
        return ~(reduce(add, sums) < MAX_STATE**2)  # NaN is far

    def _lost(self, state: ir.Value) -> Value:
        """Whether an entry exceeds the limit or is NaN."""
        code = self.code
        lost = ~(code.fabs(code.load(state)) < MAX_STATE)
        for i in range(1, self.problem.size):
            lost = lost | ~(code.fabs(code.load(state, i)) < MAX_STATE)
        return lost

    def _end_runs(self, where: Value, status: int, time: Value) -> None:
        code = self.code
        ending = where & (code.load(self.alive) > 0.0)
        code.store(code.select(ending, float(status), code.load(self.status)), self.status)
        code.store(code.select(ending, time, code.load(self.end)), self.end)
        code.store(code.select(ending, 0.0, code.load(self.alive)), self.alive)

    # Samples --------------------------------------------------------------------------------------------------

    def _sample(self, tick: ir.Value) -> None:
        """Store and reduce the state at `tick` if it is a sample tick."""
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
                self.results.update(alive, self.t, self._state(tick), self.P)
            following = builder.add(cursor, ir.Constant(I64, 1))
            row, after = (code.scalar(self.at["rows"], place, I64) for place in (cursor, following))
            with code.when(builder.icmp_signed(">", after, row)):  # never true if the caller stores no samples
                self._store_samples(self._state(tick), row)
            builder.store(following, self.cursor)

    def _store_samples(self, state: ir.Value, kept: ir.Value) -> None:
        code, builder = self.code, self.code.builder
        length = self.problem.size + self.problem.rotors
        with code.count(self.lanes.width) as lane:
            run = builder.add(self.first, lane)
            with code.when(builder.icmp_signed("<", run, self.at["runs"])):
                row = builder.add(builder.mul(run, self.at["row_count"]), kept)
                with code.count(length) as i:
                    here = builder.add(builder.mul(i, ir.Constant(I64, self.lanes.width)), lane)
                    there = builder.add(builder.mul(row, ir.Constant(I64, length)), i)
                    code.put(code.scalar(state, here), self.at["samples"], there)
