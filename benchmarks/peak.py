"""The processor's peak: fused multiply-adds on doubles in registers, as many as one core can do."""

from __future__ import annotations

import ctypes
from functools import partial

import numpy as np

from benchmarks import clock
from flypend.compile.llvm import jit

# Independent chains hide the latency of a multiply-add (4 cycles, up to 4 at a time) and fit into 16 or 32 registers.
WIDTHS, CHAINS, ROUNDS = (2, 4, 8), 12, 1_000_000


def flops_per_second() -> float:
    """Floating-point operations per second of one core, a multiply-add counting two: the best of all vector widths."""
    return max(_measured(width) for width in WIDTHS)


def _measured(width: int) -> float:
    kinds = [ctypes.c_int64, ctypes.c_void_p]
    function = jit.build(f"peak, {width} lanes, {CHAINS} chains", partial(_module, width), "peak", kinds)
    memory = np.zeros(8 * (CHAINS + 1) * width)
    start = -memory.ctypes.data % 64 // 8  # vectors are aligned
    (seconds,) = clock.processor(partial(function, ROUNDS, memory.ctypes.data + 8 * start))
    return 2 * CHAINS * width * ROUNDS / seconds


def _module(width: int) -> str:
    """Module with a function (rounds, memory): x ← a x + a in every chain x, with a and the chains in `memory`."""
    v, fma, chains = f"<{width} x double>", f"@llvm.fma.v{width}f64", range(CHAINS)
    places = [f"%p{i} = getelementptr {v}, ptr %memory, i64 {i + 1}" for i in chains]
    starts = [f"%x{i} = load {v}, ptr %p{i}, align {8 * width}" for i in chains]
    joins = [f"%y{i} = phi {v} [ %x{i}, %entry ], [ %z{i}, %body ]" for i in chains]
    rounds = [f"%z{i} = call {v} {fma}({v} %y{i}, {v} %a, {v} %a)" for i in chains]
    ends = [f"store {v} %z{i}, ptr %p{i}, align {8 * width}" for i in chains]
    lines = [
        f"declare {v} {fma}({v}, {v}, {v})", "define void @peak(i64 %rounds, ptr %memory) {", "entry:",
        f"%a = load {v}, ptr %memory, align {8 * width}", *places, *starts, "br label %body", "body:",
        "%count = phi i64 [ 0, %entry ], [ %next, %body ]", *joins, *rounds, "%next = add i64 %count, 1",
        "%more = icmp slt i64 %next, %rounds", "br i1 %more, label %body, label %after", "after:", *ends,
        "ret void", "}",
    ]  # fmt: skip
    return "\n".join(lines)


if __name__ == "__main__":
    print(f"{flops_per_second() / 1e9:.1f} GFlop/s")
