"""Worlds of sampled flights inside a kernel: the built-in equations in SIMD lanes, or MuJoCo, one flight at a time.

A world starts a run and steps under a command, from the packed state and rotor forces at one address to another.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code
from flypend.compile.sampled_problem import EquationsProblem, MujocoProblem, SampledProblem, Stretch

OMEGA = 15  # offset of the angular velocity in a packed state
QVEL_OMEGA = 3  # and in MuJoCo's qvel
# Addresses passed for MuJoCo: data and its arrays, three functions, the initial coordinates of the runs, the models,
# and the parameters of their filters.
MUJOCO_ARGUMENTS = (
    "data", "qpos", "qvel", "qacc", "act", "ctrl", "xfrc", "qfrc", "mj_step", "mj_forward", "mj_reset", "begins",
    "models", "filters",
)  # fmt: skip
# Numbers per rotor among the parameters of MuJoCo's filters; the first is the time constant.
FILTER_STRIDE = 10
# Offsets in xfrc_applied: six numbers each, force first, for the world, the vehicle and the rod.
ON_VEHICLE, ON_BOB = 6, 12
IN_JOINT = 6  # offset of the joint's torque in qfrc_applied


class Way(NamedTuple):
    """Addresses of the state at the beginning and at the end of a stretch; they may be the same."""

    source: ir.Value
    target: ir.Value


class World(Protocol):
    """Simulates vehicle and pendulum between control ticks."""

    def begin(self, run: ir.Value, state: ir.Value) -> None:
        """Start `run` from `state`."""

    def advance(
        self, place: int, stretch: Stretch, command: ir.Value, wind: ir.Value, timing: ir.Value, way: Way
    ) -> None:
        """Advance through `stretch`, number `place` of the tick, under `command` and `wind`, with inputs `timing`."""

    def show(self, state: ir.Value) -> None:
        """Make sure that `state`, at which the last stretch ended, is up to date."""


class Equations:
    """The built-in equations of motion, on all lanes of the kernel."""

    def __init__(self, code: Code, problem: SampledProblem, world: EquationsProblem) -> None:
        self._code, self._size = code, problem.size
        single = [stretch.steps for stretch in problem.flown] == [1]
        self._step = define(code.lanes, world.step, inline=single)
        self._loop = define(code.lanes, problem.loop) if problem.loop is not None else None
        self._forces, self._none = code.reserve(problem.rotors), code.reserve(1)

    def begin(self, run: ir.Value, state: ir.Value) -> None:
        """Do nothing: the steps operate on the state itself."""

    def advance(
        self, place: int, stretch: Stretch, command: ir.Value, wind: ir.Value, timing: ir.Value, way: Way
    ) -> None:
        """Implement `World.advance`."""
        self._advance(command, wind, timing, way)
        if stretch.steps > 1:
            with self._code.count(stretch.steps - 1):
                self._advance(command, wind, timing, Way(way.target, way.target))

    def repeat(self, steps: ir.Value, command: ir.Value, wind: ir.Value, timing: ir.Value, state: ir.Value) -> None:
        """Advance `state` in place by a number of `steps` that is known when the kernel runs, else as `advance`."""
        with self._code.count(steps):
            self._advance(command, wind, timing, Way(state, state))

    def _advance(self, command: ir.Value, wind: ir.Value, timing: ir.Value, way: Way) -> None:
        """Take one step."""
        code, size = self._code, self._size
        wanted = command
        if self._loop is not None:
            code.call(self._loop, command, code.vector_at(way.source, OMEGA), self._none, self._forces)
            wanted = self._forces
        before, after = (code.vector_at(state, size) for state in way)  # rotors
        code.call(self._step, way.source, before, wanted, wind, timing, way.target, after)

    def show(self, state: ir.Value) -> None:
        """Do nothing: the state is always up to date."""


class _At:
    """The function (model, data) at `address`, with the function type that an opaque pointer lacks."""

    def __init__(self, address: ir.Value) -> None:
        self.type = address.type
        self.function_type = ir.FunctionType(VOID, [POINTER] * 2)
        self.get_reference = address.get_reference


class Mujoco:
    """MuJoCo, called by address. The kernel must have one lane, so its memory layout matches MuJoCo's arrays.

    `at` maps names to the kernel's arguments, including `MUJOCO_ARGUMENTS`. The `timing` of a stretch begins with the
    number of MuJoCo steps per evaluation of the rate loop, followed by the inputs of `motors` and `surroundings`;
    `models` holds one model per stretch, with the matching timestep.
    """

    def __init__(self, code: Code, problem: SampledProblem, world: MujocoProblem, at: dict[str, ir.Value]) -> None:
        if code.lanes.width != 1:
            raise ValueError("MuJoCo requires a kernel with one lane")
        self._code, self._problem, self._world, self._at = code, problem, world, at
        self._seen = define(code.lanes, world.seen)
        self._loop = define(code.lanes, problem.loop) if problem.loop is not None else None
        effects = (world.motors, world.surroundings)
        self._motors, self._surroundings = (define(code.lanes, p) if p is not None else None for p in effects)
        self._none, self._lost, self._forces = code.reserve(1), code.reserve(1), code.reserve(problem.rotors)
        self._wanted, self._lags = code.reserve(problem.rotors), code.reserve(problem.rotors)
        self._rotors = at["act"] if world.filtered else at["ctrl"]

    def begin(self, run: ir.Value, state: ir.Value) -> None:
        """Implement `World.begin`; row `run` of `begins` holds the MuJoCo coordinates of the start."""
        code, builder, at = self._code, self._code.builder, self._at
        builder.call(self._function("mj_reset"), [self._model(0), at["data"]])
        positions, velocities = self._world.seen.inputs[:2]
        row = builder.mul(run, ir.Constant(I64, positions + velocities))
        self._copy(builder.gep(at["begins"], [row], source_etype=code.lanes.scalar), at["qpos"], positions)
        row = builder.add(row, ir.Constant(I64, positions))
        self._copy(builder.gep(at["begins"], [row], source_etype=code.lanes.scalar), at["qvel"], velocities)
        self._copy(code.vector_at(state, self._problem.size), self._rotors, self._problem.rotors)
        code.store(0.0, self._lost)

    def advance(
        self, place: int, stretch: Stretch, command: ir.Value, wind: ir.Value, timing: ir.Value, way: Way
    ) -> None:
        """Implement `World.advance`; MuJoCo keeps the state itself."""
        code, builder, at = self._code, self._code.builder, self._at
        if self._surroundings is None:
            self._copy(wind, code.vector_at(at["xfrc"], ON_VEHICLE), 3)
            self._copy(code.vector_at(wind, 3), code.vector_at(at["xfrc"], ON_BOB), 3)
        inner = builder.fptosi(code.scalar(timing, ir.Constant(I64, 0)), I64)
        with code.count(stretch.steps):
            wanted = command
            if self._loop is not None:
                code.call(self._loop, command, code.vector_at(at["qvel"], QVEL_OMEGA), self._none, self._wanted)
                wanted = self._wanted
            self._copy(wanted, at["ctrl"], self._problem.rotors)
            self._check_forces()
            with code.count(inner), code.when(code.any(code.load(self._lost) < 1.0)):
                self._prepare(place, wanted, wind, code.vector_at(timing, 1))
                builder.call(self._function("mj_step"), [self._model(place), at["data"]])

    def _prepare(self, place: int, wanted: ir.Value, wind: ir.Value, numbers: ir.Value) -> None:
        """Set what changes within a stretch: controls and time constants, external forces and torques."""
        code, at = self._code, self._at
        if self._motors is not None:
            code.call(self._motors, wanted, self._rotors, numbers, self._forces, self._lags)
            self._copy(self._forces, at["ctrl"], self._problem.rotors)
            if self._world.filtered:
                filters = code.scalar(at["filters"], ir.Constant(I64, place), POINTER)
                for i in range(self._problem.rotors):
                    code.store(code.load(self._lags, i), filters, FILTER_STRIDE * i)
        if self._surroundings is not None:
            code.builder.call(self._function("mj_forward"), [self._model(place), at["data"]])
            coordinates = (at["qpos"], at["qvel"], at["qacc"])
            places = (("xfrc", ON_VEHICLE), ("xfrc", ON_BOB), ("qfrc", IN_JOINT))
            outside = [code.vector_at(at[name], offset) for name, offset in places]
            code.call(self._surroundings, *coordinates, self._rotors, at["ctrl"], wind, numbers, *outside)

    def show(self, state: ir.Value) -> None:
        """Implement `World.show`; NaN once a force has been invalid."""
        code, at = self._code, self._at
        rotors = code.vector_at(state, self._problem.size)
        code.call(self._seen, at["qpos"], at["qvel"], self._rotors, state, rotors)
        with code.when(code.any(code.load(self._lost) > 0.0)):
            code.store(float("nan"), state)

    def _check_forces(self) -> None:
        """Mark the run as lost if a force is NaN or too large; MuJoCo itself would replace the force by zero."""
        code = self._code
        size = code.value(0.0)
        for i in range(self._problem.rotors):
            force = code.load(self._at["ctrl"], i)
            size = size + force * force
        code.store(code.select(size < self._world.largest**2, code.load(self._lost), 1.0), self._lost)

    def _model(self, place: int) -> ir.Value:
        return self._code.scalar(self._at["models"], ir.Constant(I64, place), POINTER)

    def _function(self, name: str) -> _At:
        return _At(self._at[name])

    def _copy(self, source: ir.Value, target: ir.Value, length: int) -> None:
        for i in range(length):
            self._code.store(self._code.load(source, i), target, i)
