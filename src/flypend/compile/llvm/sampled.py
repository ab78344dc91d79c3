"""The kernel of sampled flights: measure, command, hold, in SIMD lanes, one flight per lane.

All flights of a kernel share the control ticks, so the lanes run in lockstep. The result of a flight does not depend on
its neighbours. `flypend.flight.sampled` does the same in Python, one flight at a time.
"""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.flying import Flying, far, lost, undefined
from flypend.compile.llvm.lane_rows import from_lane, into_lane, move
from flypend.compile.llvm.on_board import OnBoard
from flypend.compile.llvm.random import PER_TICK, define_normals, whole_blocks
from flypend.compile.llvm.recording import Recording
from flypend.compile.llvm.runge_kutta import COLLIDED, DIVERGED, UNDEFINED
from flypend.compile.llvm.sensors import Sensors
from flypend.compile.llvm.touching import Touching
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code, Context, Lanes, Value
from flypend.compile.llvm.worlds import MUJOCO_ARGUMENTS, Equations, Mujoco, Way, World
from flypend.compile.sampled_problem import GUSTS, EquationsProblem, SampledProblem

INTEGERS = ("runs", "ticks", "sample_count", "row_count", "begun")
ARGUMENTS = (
    "starts", "parameters", "plant", "seeds", "runs", "ticks",
    "sample_ticks", "sample_count", "judged", "rows", "row_count",
    "samples", "reductions", "final", "end", "status", "clearance", "part", "stop",
)  # fmt: skip
# Arguments for a flight in pieces: what one call leaves to the next, the ticks that are flown already, and impulses
# (runs, 6) on vehicle and bob, N s, in effect at once. A call flies on to `ticks`; `sample_ticks` are of the piece.
RESUMED_ARGUMENTS = ("context", "begun", "impulses")


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
        programs = {name: getattr(problem, name) for name in ("measure", "gusts")}
        programs["strike"] = problem.resuming.strike if problem.resuming else None
        self.call = {name: define(lanes, p, inline=True) for name, p in programs.items() if p is not None}
        self.normals = define_normals(lanes, problem.drawn) if problem.random else None
        self.length = problem.size + problem.rotors
        self.states = code.keep(2 * (1 + self.length))  # before and after a tick, in turn; each preceded by the time
        self.measured, self.P, self.wind = (code.reserve(n) for n in (1 + problem.measured, problem.gains, 6))
        self.gust = code.keep(problem.gust)
        self.draws = code.reserve(max(PER_TICK, whole_blocks(problem.drawn.stop)))
        self.given = [code.reserve(length) for length in problem.inputs]
        self.schedule, self.timings, self.noise, self.blowing, self.params = self.given
        self.seeds, self.tick_of_lane = code.reserve(lanes.width, I64), code.reserve(lanes.width, I64)
        self.board, self.flying = OnBoard(code, problem), Flying(code, self.at)
        self.recording = Recording(code, problem, self.at)
        self.sensors = Sensors(code, problem.sensing) if problem.sensing is not None else None
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
            with code.count(builder.sub(self.at["ticks"], begun)) as flown, code.when(self.flying.wanted):
                tick = builder.add(begun, flown)
                self._tick(tick)
                self._sample(builder.add(tick, ir.Constant(I64, 1)))
            self._store_results()
        builder.ret_void()

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
        builder = self.code.builder
        odd = builder.mul(builder.and_(tick, ir.Constant(I64, 1)), ir.Constant(I64, 1 + self.length))
        return self.code.vector_at(self.states, builder.add(odd, ir.Constant(I64, 1)))

    def _load_runs(self) -> None:
        """Load gains and seeds, and put the cursor to the first sample."""
        code = self.code
        with code.count(self.lanes.width) as lane:
            run = self._run(lane)
            into_lane(code, self.at["parameters"], run, self.P, lane, self.problem.gains)
            code.put(code.scalar(self.at["seeds"], run, I64), self.seeds, lane)
        self.recording.rewind()

    def _resume(self) -> ir.Value:
        """Begin, or go on from the context; then strike. Returns the ticks that are flown already."""
        code, begun = self.code, self.at["begun"]
        with code.when(code.builder.icmp_signed("==", begun, ir.Constant(I64, 0))):
            self._begin()
        self.flying.go_on(self._last())
        state, impulses = self._state(begun), code.reserve(6)
        with code.count(self.lanes.width) as lane:
            into_lane(code, self.at["impulses"], self._run(lane), impulses, lane, 6)
        with code.when(self.flying.any):
            code.call(self.call["strike"], state, impulses, state)
        return begun

    def _time(self, tick: ir.Value) -> Value:
        """The time of `tick`, s."""
        return self.code.value(self.code.builder.sitofp(tick, self.lanes.scalar)) * self.problem.period

    def _last(self) -> Value:
        return self._time(self.at["ticks"])

    def _begin(self) -> ir.Value:
        """Begin at the starts; return the tick, 0."""
        code = self.code
        state = self._state(ir.Constant(I64, 0))
        with code.count(self.lanes.width) as lane:
            into_lane(code, self.at["starts"], self._run(lane), state, lane, self.length)
            self.recording.reset(lane)
        given = [code.vector_at(state, self.problem.size)]
        if self.sensors is not None:
            given.append(self.sensors.begin(state, self.seeds))
        self.board.begin(*given)
        for memory, length in ((self.gust, self.problem.gust), (self.wind, 6)):
            for i in range(length):
                code.store(0.0, memory, i)
        self.world.begin(self.first, state)
        self.flying.begin(self._last())
        if self.touching is not None:
            self.flying.end(self.touching.begin(state, self.flying.lanes), COLLIDED, code.value(0.0))
        self._sample(ir.Constant(I64, 0))
        return ir.Constant(I64, 0)

    def _sample(self, tick: ir.Value) -> None:
        self.recording.sample(tick, self._state(tick), self.P, self.first, self.flying.lanes)

    def _store_results(self) -> None:
        code, builder = self.code, self.code.builder
        state = self._state(self.at["ticks"])
        with code.count(self.lanes.width) as lane:
            run = builder.add(self.first, lane)
            with code.when(builder.icmp_signed("<", run, self.at["runs"])):
                from_lane(code, state, lane, self.at["final"], run, self.problem.size)
                self.flying.store(lane, run)
                self.recording.store(lane, run)
                if self.touching is not None:
                    self.touching.store(lane, run)

    # One control tick -----------------------------------------------------------------------------------------

    def _tick(self, tick: ir.Value) -> None:
        code, problem, flying = self.code, self.problem, self.flying
        state, after = self._state(tick), self._state(code.builder.add(tick, ir.Constant(I64, 1)))
        time = self._time(tick)
        self._draw(tick)
        command = self.board.command(tick, self._measured(time, state), self.P, self.params)
        flying.end(undefined(code, command, problem.command), UNDEFINED, time)
        if problem.gusts is not None:
            drawn = code.vector_at(self.draws, GUSTS)
            code.call(self.call["gusts"], self.gust, drawn, self.blowing, self.gust, self.wind)
        if problem.resuming is None:
            self._advance(tick, state, after)
        else:
            self._advance_by_schedule(tick, state, after, problem.resuming.stretches)
        self.world.show(after)
        with code.when(code.any(far(code, after, problem.size))):
            flying.end(lost(code, after, problem.size), DIVERGED, time)
        if self.touching is not None:
            touched, share = self.touching.between(state, after, problem.period, flying.lanes)
            flying.end(touched, COLLIDED, time + share * problem.period)
        flying.keep_ended(state, after, self.length)

    def _draw(self, tick: ir.Value) -> None:
        code = self.code
        if self.normals is None:
            return
        for lane in range(self.lanes.width):
            code.put(tick, self.tick_of_lane, ir.Constant(I64, lane))
        code.call(self.normals, self.seeds, self.tick_of_lane, self.draws)

    def _measured(self, time: Value, state: ir.Value) -> ir.Value:
        """Address of what the flight computer is told of `state`: the time, and measurements or readings."""
        code = self.code
        measured = code.vector_at(state, ir.Constant(I64, -1))
        if self.problem.measure is not None:
            measured = self.measured
            code.call(self.call["measure"], state, self.draws, self.noise, code.vector_at(measured, 1))
        if self.sensors is not None:
            measured = self.measured
            self.sensors.read(time, state, self.draws, code.vector_at(measured, 1))
        code.store(time, measured)
        return measured

    def _advance(self, tick: ir.Value, state: ir.Value, after: ir.Value) -> None:
        """Fly the intervals of the tick."""
        code, source = self.code, state
        for place, stretch in enumerate(self.problem.flown):
            timing = code.vector_at(self.timings, place * self.problem.timing)
            held = self.board.held(tick, stretch.age)
            self.world.advance(place, stretch, held, self.wind, timing, Way(source, after))
            source = after

    def _advance_by_schedule(self, tick: ir.Value, state: ir.Value, after: ir.Value, stretches: int) -> None:
        """Fly the intervals that the schedule tells, some of which may be empty."""
        code = self.code
        assert isinstance(self.world, Equations)
        move(code, state, after, self.length)
        for place in range(stretches):
            age, steps = (code.scalar(self.schedule, self._entry(2 * place + i)) for i in range(2))
            held = self.board.held(tick, code.builder.fptosi(age, I64))
            timing = code.vector_at(self.timings, place * self.problem.timing)
            self.world.repeat(code.builder.fptosi(steps, I64), held, self.wind, timing, after)

    def _entry(self, vector: int) -> ir.Value:
        """Index of the first lane of a vector."""
        return ir.Constant(I64, vector * self.lanes.width)
