"""A function applied to every stage of a horizon, in order, for one problem per lane or for a single one.

What a stage writes, later ones may read, so that the same loop maps a function over stages and runs a recursion through
them, forward or backward. The loop is `compile/loops/horizon.cpp`.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from threading import local
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend.compile.llvm import jit
from flypend.compile.llvm.emit import Lanes, define_routine
from flypend.compile.llvm.loops import Constants, LoopModule
from flypend.compile.numeric import allocate_aligned
from flypend.compile.routine import Routine, lower_calls

WIDTH = 8


def lanes(*shape: int, width: int = WIDTH) -> NDArray[np.float64]:
    """Return zeros of this `shape` with a last axis of `width` lanes, for a `Stagewise` of that width."""
    made: NDArray[np.float64] = allocate_aligned((*shape, width))
    made[...] = 0.0
    return made


@dataclass(frozen=True)
class Stagewise:
    """A compiled loop over stages.

    Called with the number of stages, and an array per input and output that begins at the first stage: of doubles,
    (stages, length, width), from `lanes`, C-contiguous from its first entry on.
    """

    native: jit.Native

    def __call__(self, count: int, *arrays: NDArray[np.float64]) -> None:
        """Run all stages."""
        self.on(*arrays)(0, count)

    def on(self, *arrays: NDArray[np.float64]) -> Callable[[int, int], None]:
        """Return a function of number and count, which runs `count` stages from a `first` one of the same `arrays` on.

        It saves what it takes to find the address of an array.
        """
        native, places = self.native, (ctypes.c_void_p * len(arrays))(*(array.ctypes.data for array in arrays))

        def run(first: int, count: int) -> None:
            native(first, count, places)

        run.arrays = arrays  # type: ignore[attr-defined]  # which must live as long as it does
        return run


def stagewise(
    function: ca.Function, shared: Sequence[int] = (), *, backward: bool = False, width: int = WIDTH,
    abreast: bool = False,
) -> Stagewise:  # fmt: skip
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
        Number of lanes: 8, or 1 for a single problem.
    abreast : bool
        Whether the lanes take stages of a single problem, and arrays are (stages, length). There must be at least
        `WIDTH` stages, and what is written must not be what another stage reads: the last may be computed twice.
    """
    if function.is_a("SXFunction"):  # a routine is what calls it
        inputs = [ca.MX.sym(f"i{i}", function.nnz_in(i)) for i in range(function.n_in())]
        function = ca.Function(f"{function.name()}_called", inputs, function.call(inputs))
    routine = lower_calls(function)
    lengths = [*routine.inputs, *(len(cells) for cells in routine.outputs)]
    own: Constants = {
        "INPUTS": len(routine.inputs), "ABREAST": int(abreast), "LENGTHS": lengths, "TOTAL": sum(lengths)
    }  # fmt: skip
    strides = [0 if i in shared else length * (1 if abreast else width) for i, length in enumerate(lengths)]
    stage = partial(_define_stage, routine)
    return horizon("horizon", width, strides, backward, lambda: ({"stage": stage}, own), f"{own} {routine!r}")


def horizon(
    loop: str, width: int, strides: Sequence[int], backward: bool, inner: Callable[[], Any], key: str
) -> Stagewise:
    """Compile a C++ `loop` around `horizon.hpp` on `width` lanes.

    Parameters
    ----------
    loop : str
        Its name in `compile/loops`.
    width : int
        Number of lanes.
    strides : sequence of int
        From a stage of an array to the next, in doubles; 0 for what is shared.
    backward : bool
        Whether the last stage comes first.
    inner : callable
        Returns the programs and constants that the loop leaves open beside those of `horizon.hpp`.
    key : str
        It must determine what `inner` returns.
    """
    own: Constants = {"ARRAYS": len(strides), "BACKWARD": int(backward), "STRIDES": strides}

    def module() -> LoopModule:
        programs, constants = inner()
        return LoopModule(loop, (width, "double", None), programs, own | constants)

    kinds = (ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p)
    return Stagewise(jit.build(f"{loop} {width} {own} {key}", module, "kernel", kinds))


def single(function: ca.Function) -> Callable[..., Any]:
    """Compile `function` of dense vectors as a callable on arrays, which returns a tuple of arrays.

    Its arithmetic is that of the kernels of many flights, bit for bit: one lane of as many. Every thread that calls it
    has memory of its own.
    """
    compiled, own = stagewise(function), local()
    sizes = [function.nnz_in(i) for i in range(function.n_in())], [function.nnz_out(i) for i in range(function.n_out())]

    def call(*values: Any) -> Any:
        if not hasattr(own, "memory"):
            inputs, outputs = ([lanes(size) for size in kind] for kind in sizes)
            own.memory = inputs, outputs, compiled.on(*inputs, *outputs)
        inputs, outputs, run = own.memory
        for array, value in zip(inputs, values, strict=True):
            array.T[:] = value
        run(0, 1)
        return tuple(array[:, 0].copy() for array in outputs)

    return call


def _define_stage(routine: Routine, lanes: Lanes, name: str) -> str:
    """Define `routine` as a function of the addresses of its arrays."""
    inner, code = define_routine(lanes, routine), lanes.function(name, 1)
    count = len(routine.inputs) + len(routine.outputs)
    places = [code.put(f"getelementptr ptr, ptr {code.arguments[0]}, i64 {i}") for i in range(count)]
    code.call(inner, *[code.put(f"load ptr, ptr {place}") for place in places])
    return code.end(inline=True, visible=True)
