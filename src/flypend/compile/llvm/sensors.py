"""Sensors inside a kernel of sampled flights: what they remember, and the estimate with which a flight begins."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.random import define_normals, whole_blocks
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.compile.sampled_problem import Sensing


class Sensors:
    """The sensors of `sensing`, in the function that `code` is in."""

    def __init__(self, code: Code, sensing: Sensing) -> None:
        self._code, self._sensing = code, sensing
        used = range(sensing.estimate.inputs[1])
        self._normals = define_normals(code.lanes, used, "normals_of_start")
        self._estimate = define(code.lanes, sensing.estimate)
        self._begin = define(code.lanes, sensing.begin)
        self._sense = define(code.lanes, sensing.sense, inline=True)
        self._memory = code.keep(sensing.sense.inputs[0])
        self._draws, self._estimated = code.reserve(whole_blocks(used.stop)), code.reserve(sensing.estimate.inputs[0])
        self._ticks, self._t = code.reserve(code.lanes.width, I64), code.reserve(1)

    def begin(self, state: ir.Value, seeds: ir.Value) -> ir.Value:
        """Begin at `state` with the runs' `seeds`; return the address of the estimate of the state."""
        code = self._code
        for lane in range(code.lanes.width):
            code.put(ir.Constant(I64, self._sensing.tick), self._ticks, ir.Constant(I64, lane))
        code.call(self._normals, seeds, self._ticks, self._draws)
        code.call(self._estimate, state, self._draws, self._estimated)
        code.call(self._begin, state, self._memory)
        return self._estimated

    def read(self, time: Value, state: ir.Value, draws: ir.Value, readings: ir.Value) -> None:
        """Store the `readings` that arrive at `time`, with the true `state` and the tick's random numbers `draws`."""
        self._code.store(time, self._t)
        self._code.call(self._sense, self._memory, self._t, state, draws, self._memory, readings)
