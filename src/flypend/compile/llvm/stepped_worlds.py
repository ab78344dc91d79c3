"""The kernel of environments: worlds in SIMD lanes, advanced by actions, observed, judged and begun again."""

from __future__ import annotations

from functools import reduce
from operator import add

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.random import define_uniforms
from flypend.compile.llvm.touching import Touching
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code, Lanes, Value
from flypend.compile.llvm.world_sensors import WorldSensors
from flypend.compile.worlds_problem import WorldsProblem
from flypend.model.state import SIZE

ARGUMENTS = (
    "memories", "seeds", "actions", "observations", "rewards", "terminated", "truncated", "last", "first",
    "count", "limit", "fresh",
)  # fmt: skip
INTEGERS = ("first", "count", "limit", "fresh")
# A state is beyond all bounds once its length is; no observation is larger.
BOUND = 1000.0
FLOAT, BYTE = ir.FloatType(), ir.IntType(8)


def write_worlds(lanes: Lanes, problem: WorldsProblem) -> None:
    """Emit the function "kernel" for `problem` into the module of `lanes`.

    It advances the groups of `lanes.width` worlds from number `first`, `count` of them, each by an action; with `fresh`
    it begins all of them instead. Arrays are float32 but for:

    memories
        (groups, 2 + memory, width) of float64: steps since the beginning, number of the episode, memory.
    seeds
        (groups, width) of int64.
    terminated, truncated
        (worlds,) of bytes, 0 or 1.
    last
        (worlds, observation): the last observation of those that have ended; other rows are left alone.
    """
    kinds = [I64 if name in INTEGERS else POINTER for name in ARGUMENTS]
    function = ir.Function(lanes.module, ir.FunctionType(VOID, kinds), "kernel")
    _Worlds(lanes, problem, function).write()


class _Worlds:
    """Emits the kernel; `self.at` maps the names of its arguments to values."""

    def __init__(self, lanes: Lanes, problem: WorldsProblem, function: ir.Function) -> None:
        self.lanes, self.problem, self.places = lanes, problem, problem.places
        self.code = code = Code(lanes, ir.IRBuilder(function.append_basic_block()))
        self.at = dict(zip(ARGUMENTS, function.args, strict=True))
        programs = {name: getattr(problem, name) for name in ("begin", "command", "step", "observe", "judge")}
        plain = "" if problem.inner else "command"  # the forces that an action asks for, to the bit
        self.call = {name: define(lanes, program, exact=name == plain) for name, program in programs.items()}
        self.uniforms = define_uniforms(lanes, problem.begin.inputs[0])
        self.actions = problem.command.inputs[1]
        self.seen = len(problem.observe.outputs[0])
        self.rotors = len(problem.command.outputs[0])
        self.action, self.observed = code.reserve(self.actions), code.reserve(self.seen)
        self.given, self.held = code.reserve(self.rotors), code.reserve(self.rotors)
        self.reward, self.ended, self.lost, self.time = (code.reserve(1) for _ in range(4))
        self.draws, self.begun = code.reserve(problem.begin.inputs[0] + 3), code.reserve(self.places["end"])
        self.episodes = code.reserve(lanes.width, I64)
        self.before = code.reserve(SIZE + self.rotors)
        self.touching = Touching(code, problem.touch, self.at) if problem.touch is not None else None
        self.sensors = WorldSensors(code, problem.estimating) if problem.estimating is not None else None

    def write(self) -> None:
        """Emit the kernel."""
        code, builder = self.code, self.code.builder
        length = ir.Constant(I64, 2 + self.places["end"])
        with code.count(self.at["count"]) as counted:
            group = builder.add(self.at["first"], counted)
            self.group, self.world = group, builder.mul(group, ir.Constant(I64, self.lanes.width))
            self.clock = code.vector_at(self.at["memories"], builder.mul(group, length))
            self.episode, self.memory = code.vector_at(self.clock, 1), code.vector_at(self.clock, 2)
            fresh = builder.icmp_signed("!=", self.at["fresh"], ir.Constant(I64, 0))
            with builder.if_else(fresh) as (then, otherwise):
                with then:
                    self._begin_all()
                with otherwise:
                    self._advance_all()
        builder.ret_void()

    def _begin_all(self) -> None:
        code = self.code
        code.store(code.value(0.0), self.episode)
        self._begin(code.value(1.0) > 0.0)
        self._observe()
        self._rows("observations", self.observed, self.seen)

    def _observe(self) -> None:
        code, problem = self.code, self.problem
        code.store(code.load(self.clock) * (problem.steps * problem.length), self.time)
        code.call(self.call["observe"], self.time, self.memory, self.observed)
        with code.count(self.seen) as i:  # of worlds that are lost, whatever they hold
            code.store(code.most(code.least(code.load(self.observed, i), BOUND), -BOUND), self.observed, i)

    def _advance_all(self) -> None:
        code = self.code
        self._taken("actions", self.action, self.actions)
        code.store(code.select(self._finite(self.action, self.actions), 0.0, 1.0), self.lost)
        for i in range(self.actions):
            code.store(code.most(code.least(code.load(self.action, i), 1.0), -1.0), self.action, i)
        self._move()
        steps = code.load(self.clock) + 1.0
        code.store(steps, self.clock)
        code.store(steps * (self.problem.steps * self.problem.length), self.time)
        code.call(self.call["judge"], self.time, self.memory, self.action, self.reward, self.ended)
        lost = (code.load(self.lost) > 0.0) | self._far()
        ended = (code.load(self.ended) > 0.0) | lost
        reward = code.select(lost & ~(code.fabs(code.load(self.reward)) < float("inf")), 0.0, code.load(self.reward))
        code.store(reward, self.reward)
        self._copied(self.action, self._part("action"), self.actions)
        if self.sensors is not None:
            self._sense(self.sensors, steps)
        limit = code.value(code.builder.sitofp(self.at["limit"], self.lanes.scalar))
        late = (steps >= limit) & ~ended
        self._rows("rewards", self.reward, 1)
        self._flags("terminated", ended)
        self._flags("truncated", late)
        self._observe()
        over = ended | late
        with code.when(code.any(over)):
            self._rows("last", self.observed, self.seen, over)
            self._begin(over)
            self._observe()
        self._rows("observations", self.observed, self.seen)

    def _sense(self, sensors: WorldSensors, steps: Value) -> None:
        """Move the estimate on by the action, and take the readings after so many `steps`."""
        code, seeds = self.code, self.code.vector_at(self.at["seeds"], self.group)
        self._integers(code.load(self.episode) - 1.0, self.episodes)
        sensors.carry(self._part("estimate"), self.action)
        ticks = code.builder.fptosi(steps.raw, ir.VectorType(I64, self.lanes.width))
        sensors.read(seeds, self.episodes, ticks, self.time, self._part("state"), self._part("estimate"))

    # Motion -----------------------------------------------------------------------------------------------------------

    def _part(self, name: str) -> ir.Value:
        return self.code.vector_at(self.memory, self.places[name])

    def _move(self) -> None:
        """Take the steps of one action."""
        code, problem = self.code, self.problem
        if not problem.inner:
            code.call(self.call["command"], self._part("state"), self.action, self._part("numbers"), self.given)
        with code.count(problem.steps) as step:
            if problem.inner:
                code.call(self.call["command"], self._part("state"), self.action, self._part("numbers"), self.given)
            self._hold(step)
            if self.touching is not None:
                self._copied(self._part("state"), self.before, SIZE + self.rotors)
            state, rotors = self._part("state"), self._part("rotors")
            code.call(
                self.call["step"], state, rotors, self.held, self._part("wind"), self._part("timing"),
                self._part("numbers"), state, rotors,
            )  # fmt: skip
            if self.touching is not None:
                self.touching.look_for_contact()
                touched, _ = self.touching.between(self.before, state, problem.length, code.load(self.lost) <= 0.0)
                code.store(code.select(touched, 1.0, code.load(self.lost)), self.lost)
        self._queue()

    def _hold(self, step: ir.Value) -> None:
        """Choose the command that acts in this step of the action: the present one, or one of those in the queue."""
        code, problem = self.code, self.problem
        passed = code.value(code.builder.sitofp(step, self.lanes.scalar))
        left = code.load(self._part("delay")) - passed
        for i in range(self.rotors):
            acting = code.load(self.given, i)
            for age in range(problem.queued):
                earlier = code.load(self._part("queue"), age * self.rotors + i)
                acting = code.select(left > float(age * problem.steps), earlier, acting)
            code.store(acting, self.held, i)

    def _queue(self) -> None:
        """Put the present command at the head of the queue, which has the latest first."""
        queue = self._part("queue")
        for age in range(self.problem.queued - 1, 0, -1):
            source = self.code.vector_at(queue, (age - 1) * self.rotors)
            self._copied(source, self.code.vector_at(queue, age * self.rotors), self.rotors)
        if self.problem.queued:
            self._copied(self.given, queue, self.rotors)

    def _far(self) -> Value:
        """Whether the state is beyond all bounds, or NaN."""
        code, sums = self.code, [self.code.value(0.0)] * 4
        for i in range(SIZE + self.rotors):
            entry = code.load(self._part("state"), i)
            sums[i % 4] = sums[i % 4] + entry * entry
        return ~(reduce(add, sums) < BOUND**2)

    def _finite(self, memory: ir.Value, length: int) -> Value:
        total = self.code.value(0.0)
        for i in range(length):
            total = total + 0.0 * self.code.load(memory, i)
        return total.compare("==", 0.0)

    def _begin(self, over: Value) -> None:
        """Begin anew in the lanes `over`."""
        code = self.code
        self._integers(code.load(self.episode), self.episodes)
        seeds = code.vector_at(self.at["seeds"], self.group)
        code.call(self.uniforms, seeds, self.episodes, self.draws)
        code.call(self.call["begin"], self.draws, self.begun)
        if self.sensors is not None:
            code.store(code.value(0.0), self.time)
            estimate = code.vector_at(self.begun, self.places["estimate"])
            self.sensors.begin(seeds, self.episodes, self.time, self.begun, estimate)
        with code.count(self.places["end"]) as i:
            code.store(code.select(over, code.load(self.begun, i), code.load(self.memory, i)), self.memory, i)
        code.store(code.select(over, 0.0, code.load(self.clock)), self.clock)
        code.store(code.select(over, code.load(self.episode) + 1.0, code.load(self.episode)), self.episode)

    def _integers(self, values: Value, target: ir.Value) -> None:
        """Store whole numbers as int64."""
        kind = ir.VectorType(I64, self.lanes.width)
        self.code.builder.store(self.code.builder.fptosi(values.raw, kind), target).align = 8

    # Arrays of the caller ---------------------------------------------------------------------------------------------

    def _copied(self, source: ir.Value, target: ir.Value, length: int) -> None:
        for i in range(length):
            self.code.store(self.code.load(source, i), target, i)

    def _place(self, lane: ir.Value, length: int, i: ir.Value) -> ir.Value:
        """Index of entry `i` of the row, of this `length`, of the world in `lane`."""
        builder = self.code.builder
        row = builder.add(self.world, lane)
        return builder.add(builder.mul(row, ir.Constant(I64, length)), i)

    def _here(self, lane: ir.Value, i: ir.Value) -> ir.Value:
        builder = self.code.builder
        return builder.add(builder.mul(i, ir.Constant(I64, self.lanes.width)), lane)

    def _taken(self, name: str, target: ir.Value, length: int) -> None:
        """Load the rows of the worlds from a float32 array."""
        code, builder = self.code, self.code.builder
        with code.count(self.lanes.width) as lane, code.count(length) as i:
            value = code.scalar(self.at[name], self._place(lane, length, i), FLOAT)
            code.put(builder.fpext(value, self.lanes.scalar), target, self._here(lane, i))

    def _rows(self, name: str, source: ir.Value, length: int, which: Value | None = None) -> None:
        """Store the rows of the worlds, or of those in the lanes `which`, to a float32 array."""
        code, builder = self.code, self.code.builder

        def store(lane: ir.Value) -> None:
            with code.count(length) as i:
                value = builder.fptrunc(code.scalar(source, self._here(lane, i)), FLOAT)
                code.put(value, self.at[name], self._place(lane, length, i))

        if which is None:
            with code.count(self.lanes.width) as lane:
                store(lane)
        else:
            with code.each(which) as lane:
                store(lane)

    def _flags(self, name: str, mask: Value) -> None:
        """Store a mask as bytes."""
        builder = self.code.builder
        bytes_ = builder.zext(mask.raw, ir.VectorType(BYTE, self.lanes.width))
        place = builder.gep(self.at[name], [self.world], source_etype=BYTE)
        builder.store(bytes_, place).align = 1
