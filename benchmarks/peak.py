"""The processor's peak: fused multiply-adds on doubles in registers, as many as one core can do."""

from __future__ import annotations

import ctypes
from functools import partial

import numpy as np
from llvmlite import ir

from benchmarks import clock
from flypend.compile.llvm import jit
from flypend.compile.llvm.vector import I64, POINTER, VOID, Code, Lanes

# Independent chains hide the latency of a multiply-add (4 cycles, up to 4 at a time) and fit into 16 or 32 registers.
WIDTHS, CHAINS, ROUNDS = (2, 4, 8), 12, 1_000_000


def flops_per_second() -> float:
    """Floating-point operations per second of one core, a multiply-add counting two: the best of all vector widths."""
    return max(_measured(width) for width in WIDTHS)


def _measured(width: int) -> float:
    lanes = Lanes(ir.Module("peak"), width)
    kinds = [ctypes.c_int64, ctypes.c_void_p]
    function = jit.build(f"peak, {width} lanes, {CHAINS} chains", partial(_module, lanes), "peak", kinds)
    memory = np.zeros(8 * (CHAINS + 1) * width)
    start = -memory.ctypes.data % 64 // 8  # vectors are aligned
    (seconds,) = clock.processor(partial(function, ROUNDS, memory.ctypes.data + 8 * start))
    return 2 * CHAINS * width * ROUNDS / seconds


def _module(lanes: Lanes) -> ir.Module:
    """Module with a function (rounds, memory): x ← a x + a in every chain x, with a and the chains in `memory`."""
    function = ir.Function(lanes.module, ir.FunctionType(VOID, [I64, POINTER]), "peak")
    rounds, memory = function.args
    entry, body, after = (function.append_basic_block(name) for name in ("entry", "body", "after"))
    code = Code(lanes, ir.IRBuilder(entry))
    builder = code.builder
    a = code.load(memory).raw
    starts = [code.load(memory, 1 + i).raw for i in range(CHAINS)]
    builder.branch(body)
    builder.position_at_end(body)
    count = builder.phi(I64)
    chains = [builder.phi(lanes.vector) for _ in starts]
    fma = lanes.intrinsic("fma", 3)
    results = [builder.call(fma, [x, a, a]) for x in chains]
    following = builder.add(count, ir.Constant(I64, 1))
    for phi, first, later in [(count, ir.Constant(I64, 0), following), *zip(chains, starts, results, strict=True)]:
        phi.add_incoming(first, entry)
        phi.add_incoming(later, body)
    builder.cbranch(builder.icmp_signed("<", following, rounds), body, after)
    builder.position_at_end(after)
    for i, result in enumerate(results):
        builder.store(result, code.vector_at(memory, 1 + i)).align = lanes.size
    builder.ret_void()
    return lanes.module


if __name__ == "__main__":
    print(f"{flops_per_second() / 1e9:.1f} GFlop/s")
