"""The word by which another thread ends a kernel."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.vector import I64


def not_stopped(builder: ir.IRBuilder, word: ir.Value) -> ir.Value:
    """Whether the word at the address `word` is still zero, read anew each time."""
    now = builder.load_atomic(word, "monotonic", 8, typ=I64)
    return builder.icmp_signed("==", now, ir.Constant(I64, 0))
