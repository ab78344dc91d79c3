"""Worlds of sampled flights inside a kernel: the built-in equations in SIMD lanes, or MuJoCo, one flight at a time.

A world starts a run, steps under a command, and keeps the packed state and rotor forces at the address `state`.
"""

from __future__ import annotations

from typing import Protocol

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code
from flypend.compile.sampled_problem import EquationsProblem, MujocoProblem, SampledProblem, Stretch

OMEGA = 15  # offset of the angular velocity in a packed state
QVEL_OMEGA = 3  # and in MuJoCo's qvel
# Addresses passed for MuJoCo: data and its arrays, two functions, the initial coordinates of the runs, the models.
MUJOCO_ARGUMENTS = ("data", "qpos", "qvel", "act", "ctrl", "xfrc", "mj_step", "mj_reset", "begins", "models")
# Offsets in xfrc_applied: six numbers each, force first, for the world, the vehicle and the bob.
ON_VEHICLE, ON_BOB = 6, 12


class World(Protocol):
    """Simulates vehicle and pendulum between control ticks."""

    def begin(self, run: ir.Value) -> None:
        """Start `run` from the state in `state`."""

    def advance(self, place: int, stretch: Stretch, command: ir.Value, wind: ir.Value, timing: ir.Value) -> None:
        """Advance through `stretch`, number `place` of the tick, under `command` and `wind`, with inputs `timing`."""

    def show(self) -> None:
        """Update `state`."""


class Equations:
    """The built-in equations of motion, on all lanes of the kernel."""

    def __init__(self, code: Code, problem: SampledProblem, world: EquationsProblem, state: ir.Value) -> None:
        self._code, self._state = code, state
        self._rotors = code.vector_at(state, problem.size)
        self._step = define(code.lanes, world.step)
        self._loop = define(code.lanes, problem.loop) if problem.loop is not None else None
        self._forces, self._none = code.reserve(problem.rotors), code.reserve(1)

    def begin(self, run: ir.Value) -> None:
        """Do nothing: the steps operate on `state` in place."""

    def advance(self, place: int, stretch: Stretch, command: ir.Value, wind: ir.Value, timing: ir.Value) -> None:
        """Implement `World.advance`."""
        code, state, rotors = self._code, self._state, self._rotors
        with code.count(stretch.steps):
            wanted = command
            if self._loop is not None:
                code.call(self._loop, command, code.vector_at(state, OMEGA), self._none, self._forces)
                wanted = self._forces
            code.call(self._step, state, rotors, wanted, wind, timing, self._none, state, rotors)

    def show(self) -> None:
        """Do nothing: `state` is always up to date."""


class _At:
    """The function (model, data) at `address`, with the function type that an opaque pointer lacks."""

    def __init__(self, address: ir.Value) -> None:
        self.type = address.type
        self.function_type = ir.FunctionType(VOID, [POINTER] * 2)
        self.get_reference = address.get_reference


class Mujoco:
    """MuJoCo, called by address. The kernel must have one lane, so its memory layout matches MuJoCo's arrays.

    `at` maps names to the kernel's arguments, including `MUJOCO_ARGUMENTS`. The `timing` of a stretch is the number of
    MuJoCo steps per evaluation of the rate loop; `models` holds one model per stretch, with the matching timestep.
    """

    def __init__(
        self, code: Code, problem: SampledProblem, world: MujocoProblem, state: ir.Value, at: dict[str, ir.Value]
    ) -> None:
        if code.lanes.width != 1:
            raise ValueError("MuJoCo requires a kernel with one lane")
        self._code, self._problem, self._world, self._state, self._at = code, problem, world, state, at
        self._seen = define(code.lanes, world.seen)
        self._loop = define(code.lanes, problem.loop) if problem.loop is not None else None
        self._none, self._lost = code.reserve(1), code.reserve(1)
        self._rotors = at["act"] if world.filtered else at["ctrl"]

    def begin(self, run: ir.Value) -> None:
        """Implement `World.begin`; row `run` of `begins` holds the MuJoCo coordinates of the start."""
        code, builder, at = self._code, self._code.builder, self._at
        builder.call(self._function("mj_reset"), [self._model(0), at["data"]])
        positions, velocities = self._world.seen.inputs[:2]
        row = builder.mul(run, ir.Constant(I64, positions + velocities))
        self._copy(builder.gep(at["begins"], [row], source_etype=code.lanes.scalar), at["qpos"], positions)
        row = builder.add(row, ir.Constant(I64, positions))
        self._copy(builder.gep(at["begins"], [row], source_etype=code.lanes.scalar), at["qvel"], velocities)
        self._copy(code.vector_at(self._state, self._problem.size), self._rotors, self._problem.rotors)
        code.store(0.0, self._lost)

    def advance(self, place: int, stretch: Stretch, command: ir.Value, wind: ir.Value, timing: ir.Value) -> None:
        """Implement `World.advance`."""
        code, builder, at = self._code, self._code.builder, self._at
        self._copy(wind, code.vector_at(at["xfrc"], ON_VEHICLE), 3)
        self._copy(code.vector_at(wind, 3), code.vector_at(at["xfrc"], ON_BOB), 3)
        inner = builder.fptosi(code.scalar(timing, ir.Constant(I64, 0)), I64)
        with code.count(stretch.steps):
            if self._loop is not None:
                omega = code.vector_at(at["qvel"], QVEL_OMEGA)
                code.call(self._loop, command, omega, self._none, at["ctrl"])
            else:
                self._copy(command, at["ctrl"], self._problem.rotors)
            self._check_forces()
            with code.count(inner), code.when(code.any(code.load(self._lost) < 1.0)):
                builder.call(self._function("mj_step"), [self._model(place), at["data"]])

    def show(self) -> None:
        """Implement `World.show`; NaN once a force has been invalid."""
        code, at = self._code, self._at
        rotors = code.vector_at(self._state, self._problem.size)
        code.call(self._seen, at["qpos"], at["qvel"], self._rotors, self._state, rotors)
        with code.when(code.any(code.load(self._lost) > 0.0)):
            code.store(float("nan"), self._state)

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
