"""Sensors and estimator inside a kernel of worlds."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.emit import define
from flypend.compile.llvm.random import define_normals, whole_blocks
from flypend.compile.llvm.vector import I64, Code
from flypend.compile.worlds_problem import Estimating

# Neither the numbers of starts, which are those of the seeds themselves, nor those of another episode are drawn again.
SEEDS_APART, EPISODES_APART = 2**62, 2**41


class WorldSensors:
    """The programs of `estimating`, in the function that `code` is in; `seeds` is the address of the worlds' seeds."""

    def __init__(self, code: Code, estimating: Estimating) -> None:
        lanes, self._code, self._first_tick = code.lanes, code, estimating.tick
        self._first, self._carry = define(lanes, estimating.first), define(lanes, estimating.carry)
        self._sense = define(lanes, estimating.sense)
        lengths = (estimating.first.inputs[1], estimating.sense.inputs[3])
        self._of_start, self._of_tick = (
            define_normals(lanes, range(length), f"normals_{name}")
            for name, length in zip(("of_start", "of_tick"), lengths, strict=True)
        )
        self._draws = code.reserve(whole_blocks(max(lengths)))
        self._seeds, self._ticks = code.reserve(lanes.width, I64), code.reserve(lanes.width, I64)

    def begin(self, seeds: ir.Value, episodes: ir.Value, time: ir.Value, state: ir.Value, memory: ir.Value) -> None:
        """Fill the `memory` at the beginning of `episodes`, at the `time` 0, with the first readings of the `state`."""
        code = self._code
        self._chance(seeds, episodes, self._first_tick)
        code.call(self._of_start, self._seeds, self._ticks, self._draws)
        code.call(self._first, state, self._draws, memory)
        self.read(seeds, episodes, 0, time, state, memory)

    def read(
        self,
        seeds: ir.Value,
        episodes: ir.Value,
        steps: ir.Value | int,
        time: ir.Value,
        state: ir.Value,
        memory: ir.Value,
    ) -> None:
        """Take the readings of the `state` after so many `steps` into the `memory`."""
        self._chance(seeds, episodes, steps)
        self._code.call(self._of_tick, self._seeds, self._ticks, self._draws)
        self._code.call(self._sense, memory, time, state, self._draws, memory)

    def carry(self, memory: ir.Value, action: ir.Value) -> None:
        """Move the estimate in the `memory` on by a period under the `action`."""
        self._code.call(self._carry, memory, action, memory)

    def _chance(self, seeds: ir.Value, episodes: ir.Value, tick: ir.Value | int) -> None:
        """Choose the seeds and ticks of random numbers."""
        code, builder = self._code, self._code.builder
        own = builder.add(self._whole(seeds), _all(code, SEEDS_APART))
        begin = builder.mul(self._whole(episodes), _all(code, EPISODES_APART))
        ticks = builder.add(begin, _all(code, tick) if isinstance(tick, int) else tick)
        for value, place in ((own, self._seeds), (ticks, self._ticks)):
            builder.store(value, place).align = 8

    def _whole(self, place: ir.Value) -> ir.Value:
        """Load a whole number for every lane."""
        loaded = self._code.builder.load(place, typ=ir.VectorType(I64, self._code.lanes.width))
        loaded.align = 8
        return loaded


def _all(code: Code, number: int) -> ir.Constant:
    """The same whole `number` in every lane."""
    return ir.Constant(ir.VectorType(I64, code.lanes.width), [number] * code.lanes.width)
