"""A function applied to every stage of a horizon, in order, for one problem per lane.

What a stage writes, later ones may read, so that the same loop maps a function over stages and runs a recursion through
them, forward or backward.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from threading import local
from typing import Any

import casadi as ca
import numpy as np
from llvmlite import ir
from numpy.typing import NDArray

from flypend.compile.llvm import jit
from flypend.compile.llvm.emit import define_routine
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code, Lanes
from flypend.compile.routine import Routine, lower_calls

WIDTH = 8
ALIGNMENT = 64  # bytes


def lanes(*shape: int, width: int = WIDTH) -> NDArray[np.float64]:
    """Return zeros of this `shape` with a last axis of `width` lanes, for a `Stagewise` of that width."""
    length = math.prod(shape) * width
    raw = np.zeros(length + ALIGNMENT // 8)
    first = -raw.ctypes.data % ALIGNMENT // 8
    return raw[first : first + length].reshape((*shape, width))


@dataclass(frozen=True)
class Stagewise:
    """A compiled loop over stages.

    Called with the number of stages and one address per input and output, at the first stage. Arrays are of doubles,
    (stages, length, width), from `lanes`.

    Parameters
    ----------
    native : Native
        The machine code.
    strides : tuple of int
        From a stage to the next, in bytes; 0 for what is shared.
    """

    native: jit.Native
    strides: tuple[int, ...]

    def __call__(self, count: int, *arrays: Any) -> None:
        """Run all stages; `arrays` are NumPy arrays, C-contiguous from their first entry on."""
        self.native(count, *(array.ctypes.data for array in arrays))

    def on(self, *arrays: Any) -> Callable[[int, int], None]:
        """Return a function of number and count, which runs `count` stages from a `first` one of the same `arrays` on.

        It saves what it takes to find the address of an array.
        """
        native, strides, places = self.native, self.strides, tuple(array.ctypes.data for array in arrays)

        def run(first: int, count: int) -> None:
            native(count, *(place + first * stride for place, stride in zip(places, strides, strict=True)))

        run.arrays = arrays  # type: ignore[attr-defined]  # which must live as long as it does
        return run


def stagewise(
    function: ca.Function, shared: Sequence[int] = (), *, backward: bool = False, width: int = WIDTH
) -> Stagewise:
    """Compile a loop over stages that calls `function` with entry k of every array at stage k.

    Parameters
    ----------
    function : Function
        Of dense vectors; MX functions as in `compile.routine`.
    shared : sequence of int
        Inputs and outputs, by place (outputs after inputs), that are one vector for all stages.
    backward : bool
        Whether the last stage comes first.
    width : int
        Number of lanes.
    """
    routine = one_routine(function)
    lengths = [*routine.inputs, *(len(cells) for cells in routine.outputs)]
    strides = [0 if i in shared else length for i, length in enumerate(lengths)]

    def module() -> ir.Module:
        lanes = Lanes(ir.Module("flypend"), width)
        _write(lanes, routine, strides, backward)
        return lanes.module

    kinds = [ctypes.c_int64, *[ctypes.c_void_p] * len(lengths)]
    native = jit.build(f"stagewise {width} {strides} {backward} {routine!r}", module, "kernel", kinds)
    return Stagewise(native, tuple(8 * width * stride for stride in strides))


def alone(function: ca.Function) -> Callable[..., Any]:
    """Compile `function` of dense vectors as a callable on arrays, which returns a tuple of arrays.

    Its arithmetic is that of the kernels of many flights, bit for bit: one lane of as many. Every thread that calls it
    has memory of its own.
    """
    compiled, own = stagewise(function), local()
    sizes = [function.nnz_in(i) for i in range(function.n_in())], [function.nnz_out(i) for i in range(function.n_out())]

    def call(*values: Any) -> Any:
        if not hasattr(own, "memory"):
            inputs, outputs = ([lanes(size) for size in kind] for kind in sizes)
            own.memory = inputs, outputs, [array.ctypes.data for array in (*inputs, *outputs)]
        inputs, outputs, places = own.memory
        for array, value in zip(inputs, values, strict=True):
            array.T[:] = value
        compiled.native(1, *places)
        return tuple(array[:, 0].copy() for array in outputs)

    return call


def one_routine(function: ca.Function) -> Routine:
    """Return the routine of `function`; an SX function becomes one that calls it."""
    if not function.is_a("SXFunction"):
        return lower_calls(function)
    inputs = [ca.MX.sym(f"i{i}", function.nnz_in(i)) for i in range(function.n_in())]
    return lower_calls(ca.Function(f"{function.name()}_called", inputs, function.call(inputs)))


def _write(lanes: Lanes, routine: Routine, strides: Sequence[int], backward: bool) -> None:
    stage = define_routine(lanes, routine)
    code, count, arrays = begin_kernel(lanes, len(strides))
    with each_stage(code, count, backward) as k:
        code.call(stage, *(_at(code, array, k, stride) for array, stride in zip(arrays, strides, strict=True)))
    code.builder.ret_void()


def begin_kernel(lanes: Lanes, arrays: int) -> tuple[Code, ir.Value, list[ir.Value]]:
    """Begin the function "kernel" (number of stages, `arrays` addresses); return its code and its arguments."""
    kernel = ir.Function(lanes.module, ir.FunctionType(VOID, [I64, *[POINTER] * arrays]), "kernel")
    kernel.attributes.alignstack = 64
    count, *addresses = kernel.args
    return Code(lanes, ir.IRBuilder(kernel.append_basic_block())), count, addresses


@contextmanager
def each_stage(code: Code, count: ir.Value, backward: bool) -> Iterator[ir.Value]:
    """Emit a loop over `count` stages, the last one first if `backward`; yields the number of the stage."""
    with code.count(count) as i:
        yield code.builder.sub(code.builder.sub(count, ir.Constant(I64, 1)), i) if backward else i


def _at(code: Code, array: ir.Value, k: ir.Value, stride: int) -> ir.Value:
    return code.vector_at(array, code.builder.mul(k, ir.Constant(I64, stride))) if stride else array
