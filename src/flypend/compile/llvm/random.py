"""Counter-based normal random numbers, those of `compile/loops/random.hpp`."""

from __future__ import annotations

import ctypes
from functools import lru_cache
from typing import Any

import numpy as np

from flypend.compile.llvm import jit
from flypend.compile.llvm.loops import LoopModule

PER_TICK = 24
WIDTH = 8


def whole_blocks(count: int) -> int:
    """Return the length of the blocks of four that hold `count` numbers."""
    return -(-count // 4) * 4


def normals(seed: int, ticks: int, count: int = PER_TICK, *, first: int = 0) -> Any:
    """Normal numbers (ticks, count) of the flight with `seed`; row k holds the draws of control tick `first` + k."""
    rows, drawn = -(-ticks // WIDTH), whole_blocks(count)
    out: Any = np.zeros((rows, drawn, WIDTH))
    _compile(drawn)(seed & 0xFFFFFFFFFFFFFFFF, first, rows, out.ctypes.data)
    return np.ascontiguousarray(out.transpose(0, 2, 1).reshape(rows * WIDTH, drawn)[:ticks, :count])


@lru_cache(maxsize=8)
def _compile(count: int) -> Any:
    def module() -> LoopModule:
        return LoopModule("normals", (WIDTH, "double", None), {}, {"COUNT": count})

    kinds = [ctypes.c_uint64, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p]
    return jit.build(f"normals of {count}", module, "kernel", kinds)
