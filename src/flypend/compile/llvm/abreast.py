"""A function applied to every stage of one problem, as many stages at a time as there are lanes.

It is for what no stage takes from another. The loop of `stagewise`, which has a problem per lane, would leave all lanes
but one idle.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import casadi as ca
from llvmlite import ir

from flypend.compile.llvm import jit
from flypend.compile.llvm.emit import define_routine
from flypend.compile.llvm.rows import define_spread, define_turn
from flypend.compile.llvm.stagewise import WIDTH, Stagewise, begin_kernel, one_routine
from flypend.compile.llvm.vector import I64, Code, Lanes
from flypend.compile.routine import Routine


def abreast(function: ca.Function, shared: Sequence[int] = ()) -> Stagewise:
    """Compile a loop over stages that calls `function` with row k of every array at stage k.

    Arrays are of doubles, (stages, length), C-contiguous. There must be at least `WIDTH` stages, and what is written
    must not be what another stage reads: the last stages may be computed twice.

    Parameters
    ----------
    function : Function
        As in `stagewise`.
    shared : sequence of int
        Inputs, by place, that are one vector for all stages.
    """
    routine = one_routine(function)
    lengths = [*routine.inputs, *(len(cells) for cells in routine.outputs)]
    strides = [0 if i in shared else length for i, length in enumerate(lengths)]

    def module() -> ir.Module:
        lanes = Lanes(ir.Module("flypend"), WIDTH)
        _write(lanes, routine, lengths, strides)
        return lanes.module

    kinds = [ctypes.c_int64, *[ctypes.c_void_p] * len(lengths)]
    native = jit.build(f"abreast {WIDTH} {strides} {routine!r}", module, "kernel", kinds)
    return Stagewise(native, tuple(8 * stride for stride in strides))


def _write(lanes: Lanes, routine: Routine, lengths: Sequence[int], strides: Sequence[int]) -> None:
    inputs, stage = len(routine.inputs), define_routine(lanes, routine)
    into = [define_spread(lanes, length) if stride else None for length, stride in zip(lengths, strides, strict=True)]
    out = [define_turn(lanes, length) for length in lengths[inputs:]]
    code, count, arrays = begin_kernel(lanes, len(lengths))
    memories = [code.reserve(length) for length in lengths]
    for array, memory, length, turn in zip(arrays, memories, lengths, into, strict=True):
        if turn is None:
            with code.count(length) as i:
                code.store(code.value(code.scalar(array, i)), memory, i)
    with _groups(code, count) as first:
        places = [
            code.scalar_at(array, code.builder.mul(first, ir.Constant(I64, stride)))
            for array, stride in zip(arrays, strides, strict=True)
        ]
        for turn, place, memory in zip(into[:inputs], places, memories, strict=False):
            if turn is not None:
                code.call(turn, place, memory)
        code.call(stage, *memories)
        for turn, memory, place in zip(out, memories[inputs:], places[inputs:], strict=True):
            code.call(turn, memory, place)
    code.builder.ret_void()


@contextmanager
def _groups(code: Code, count: ir.Value) -> Iterator[ir.Value]:
    """Emit a loop over groups of stages; yields the first of each. The last group ends with the last stage."""
    builder, width = code.builder, ir.Constant(I64, WIDTH)
    last = builder.sub(count, width)
    with code.count(builder.sdiv(builder.add(count, ir.Constant(I64, WIDTH - 1)), width)) as group:
        wanted = builder.mul(group, width)
        yield builder.select(builder.icmp_signed("<", wanted, last), wanted, last)
