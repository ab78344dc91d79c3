"""The flight computer in a kernel of sampled flights: its program, its memory, and its commands in transit."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.emit import define, define_routine
from flypend.compile.llvm.lane_rows import move
from flypend.compile.llvm.vector import I64, Code
from flypend.compile.sampled_problem import SampledProblem


class OnBoard:
    """The board of `problem`. Its memory slides through a longer one, so that queues in it stay where they are."""

    def __init__(self, code: Code, problem: SampledProblem) -> None:
        self._code, self._problem = code, problem
        slide = problem.board.slide()
        self._program = define_routine(code.lanes, problem.board, slide, inline=True)
        self._begin = define(code.lanes, problem.begin, inline=True)
        self._stride = slide or problem.memory
        self._strides = -(-problem.memory // self._stride)  # then it is moved back to where it does not overlap itself
        self._memory = code.keep(self._strides * self._stride + problem.memory)
        self._none = code.reserve(1)
        self._ring = code.keep(problem.depth * problem.command)

    def begin(self, *given: ir.Value) -> None:
        """Begin from what the program "begin" is `given`, with its command in transit."""
        code, problem = self._code, self._problem
        command = code.reserve(problem.command)
        memory, _ = self._memories(ir.Constant(I64, 0))
        code.call(self._begin, *given, memory, command)
        for slot in range(problem.depth):
            move(code, command, code.vector_at(self._ring, slot * problem.command), problem.command)

    def command(self, tick: ir.Value, measured: ir.Value, gains: ir.Value, params: ir.Value) -> ir.Value:
        """Compute the command of `tick` from what is `measured`, time first; return its address."""
        code, before_first = self._code, ir.Constant(I64, -1)
        command = self.held(tick, 0)
        before, after = self._memories(tick)
        code.call(self._program, before, measured, self._none, gains, params, after, command)
        with code.when(code.builder.icmp_signed("==", self._left(tick), before_first)):
            move(code, after, self._memories(ir.Constant(I64, 0))[0], self._problem.memory)
        return command

    def held(self, tick: ir.Value, age: int | ir.Value) -> ir.Value:
        """Address of the command computed `age` ticks before `tick`."""
        builder, depth = self._code.builder, ir.Constant(I64, self._problem.depth)
        back = ir.Constant(I64, age) if isinstance(age, int) else age
        slot = builder.srem(builder.add(builder.sub(tick, back), depth), depth)
        return self._code.vector_at(self._ring, builder.mul(slot, ir.Constant(I64, self._problem.command)))

    def _left(self, tick: ir.Value) -> ir.Value:
        """Strides that the memory has left after `tick`, less one."""
        builder, strides = self._code.builder, ir.Constant(I64, self._strides)
        return builder.sub(ir.Constant(I64, self._strides - 2), builder.srem(tick, strides))

    def _memories(self, tick: ir.Value) -> tuple[ir.Value, ir.Value]:
        """Addresses of the memory before and after `tick`: the second is one stride before the first."""
        code, builder, stride = self._code, self._code.builder, ir.Constant(I64, self._stride)
        left = builder.add(self._left(tick), ir.Constant(I64, 1))
        place = builder.mul(left, stride)
        return code.vector_at(self._memory, builder.add(place, stride)), code.vector_at(self._memory, place)
