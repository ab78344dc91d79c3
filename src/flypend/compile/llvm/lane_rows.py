"""Rows of the caller's arrays, one number after the other, to and from one lane of vectors."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.vector import I64, Code


def into_lane(code: Code, rows: ir.Value, row: ir.Value, memory: ir.Value, lane: ir.Value, length: int) -> None:
    """Copy `row` of `rows`, `length` doubles, to `lane` of as many vectors at `memory`."""
    with code.count(length) as i:
        there, here = _places(code, row, lane, length, i)
        code.put(code.scalar(rows, there), memory, here)


def from_lane(code: Code, memory: ir.Value, lane: ir.Value, rows: ir.Value, row: ir.Value, length: int) -> None:
    """Copy `lane` of `length` vectors at `memory` to `row` of `rows`."""
    with code.count(length) as i:
        there, here = _places(code, row, lane, length, i)
        code.put(code.scalar(memory, here), rows, there)


def _places(code: Code, row: ir.Value, lane: ir.Value, length: int, i: ir.Value) -> tuple[ir.Value, ir.Value]:
    """Indices of number `i` of a row, in its array and among the lanes."""
    builder = code.builder
    there = builder.add(builder.mul(row, ir.Constant(I64, length)), i)
    return there, builder.add(builder.mul(i, ir.Constant(I64, code.lanes.width)), lane)


def move(code: Code, source: ir.Value, target: ir.Value, length: int) -> None:
    """Copy `length` vectors."""
    with code.count(length) as i:
        code.store(code.load(source, i), target, i)
