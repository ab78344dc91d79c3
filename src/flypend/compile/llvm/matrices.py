"""Matrices of one problem, row by row in vector registers, for recursions through its stages.

Straight-line code with a problem per lane is right for many problems. For one, it is fetched from memory faster than it
is computed, and lanes are idle; rows of matrices fill them.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from llvmlite import ir

from flypend.compile.llvm import jit
from flypend.compile.llvm.stagewise import Stagewise, begin_kernel, each_stage
from flypend.compile.llvm.vector import I64, Code, Lanes, Value

BLOCK = 8  # numbers in a vector
_I32 = ir.IntType(32)


def padded(length: int) -> int:
    """Return the length of a row of `length` numbers in memory."""
    return -(-length // BLOCK) * BLOCK


class Row:
    """A row of numbers, vector by vector: `vector(i)` emits vector i, None if that is zero.

    With numbers on its right and other rows it does arithmetic. Nothing is emitted before it is kept or written.
    """

    def __init__(self, code: Code, count: int, vector: Callable[[int], Value | None]) -> None:
        self.code, self.count = code, count
        self.vector: Callable[[int], Value | None] = lru_cache(maxsize=None)(vector)

    def __add__(self, other: Row) -> Row:
        def vector(i: int) -> Value | None:
            a, b = self.vector(i), other.vector(i)
            return b if a is None else a if b is None else a + b

        return Row(self.code, self.count, vector)

    def __sub__(self, other: Row) -> Row:
        return self + -other

    def __mul__(self, number: Value) -> Row:
        def vector(i: int) -> Value | None:
            mine = self.vector(i)
            return None if mine is None else mine * number

        return Row(self.code, self.count, vector)

    def __neg__(self) -> Row:
        def vector(i: int) -> Value | None:
            mine = self.vector(i)
            return None if mine is None else -mine

        return Row(self.code, self.count, vector)


class Kept(Row):
    """A row at `memory`, of which single numbers can be taken; vectors that are not `filled` are zero."""

    def __init__(self, code: Code, memory: ir.Value, filled: Sequence[bool]) -> None:
        self.code, self.count, self._memory, self._filled = code, len(filled), memory, filled
        self.vector = self._loaded

    def __getitem__(self, i: int) -> Value:
        """Number `i`, in all lanes."""
        return Entry(self.code, self._memory, i)

    def _loaded(self, i: int) -> Value | None:
        if not self._filled[i]:
            return None
        place = self.code.scalar_at(self._memory, ir.Constant(I64, i * BLOCK))
        loaded = self.code.builder.load(place, typ=self.code.lanes.vector)
        loaded.align = 8
        return Value(self.code, loaded)


class Entry(Value):
    """Number `i` of `memory`, in all lanes, loaded wherever it is used: so it needs no register until then."""

    def __init__(self, code: Code, memory: ir.Value, i: int) -> None:
        self.code, self._memory, self._i = code, memory, i

    @property
    def raw(self) -> ir.Value:
        """Emit the load."""
        return self.code.repeated(self.code.scalar(self._memory, ir.Constant(I64, self._i)))


@dataclass(frozen=True)
class Lazy(Sequence[Any]):
    """A sequence whose entry `i` is made when it is asked for: `entry(i)`."""

    length: int
    entry: Callable[[int], Any]

    def __len__(self) -> int:
        """Number of entries."""
        return self.length

    def __getitem__(self, i: Any) -> Any:
        """Make entry `i`."""
        return self.entry(i)


def row_of(code: Code, entries: Mapping[int, Value], length: int) -> Row:
    """Return the row of `length` numbers with these `entries`, else zeros."""

    def vector(i: int) -> Value | None:
        some = {place - i * BLOCK: value for place, value in entries.items() if place // BLOCK == i}
        made = code.value(0.0).raw
        for lane, value in some.items():
            made = code.builder.insert_element(made, _single(code, value), ir.Constant(_I32, lane))
        return Value(code, made) if some else None

    return Row(code, padded(length) // BLOCK, vector)


def kept(rows: Iterable[Row]) -> list[Row]:
    """Compute `rows`, and keep them in memory of their own."""
    some = list(rows)
    places = [row.code.reserve(row.count) for row in some]
    write(some, places)
    return [Kept(row.code, place, [True] * row.count) for row, place in zip(some, places, strict=True)]


def write(rows: Sequence[Row], places: Sequence[ir.Value], length: int | None = None) -> None:
    """Compute `rows`, and write them, or their first `length` numbers, to `places`, all vectors 0 first.

    What a vector of all rows needs, is in registers then; LLVM must not begin with the next before.
    """
    code, count = rows[0].code, rows[0].count
    length = BLOCK * count if length is None else length
    for i in range(count):
        code.builder.fence("seq_cst", "singlethread")
        for row, place in zip(rows, places, strict=True):
            value, first = code.value(row.vector(i) or 0.0), i * BLOCK
            if length >= first + BLOCK:
                code.builder.store(value.raw, code.scalar_at(place, ir.Constant(I64, first))).align = 8
            else:
                put([Value(code, value.raw)], place, first, range(length - first))
    code.builder.fence("seq_cst", "singlethread")


def put(values: Iterable[Value], memory: ir.Value, first: int, lanes: Iterable[int] = (0,)) -> None:
    """Write lane 0 of `values`, or their `lanes`, to `memory`, one after the other from its number `first` on."""
    place = first
    for value in values:
        for lane in lanes:
            value.code.put(_single(value.code, value, lane), memory, ir.Constant(I64, place))
            place += 1


def _single(code: Code, value: Value, lane: int = 0) -> ir.Value:
    return code.builder.extract_element(value.raw, ir.Constant(_I32, lane))


def recursion(
    name: str, emit: Callable[..., None], lengths: Sequence[int], shared: Sequence[int] = (), *, backward: bool = False
) -> Stagewise:
    """Compile a loop over stages whose body is what `emit(code, *places)` emits.

    Parameters
    ----------
    name : str
        Of the recursion.
    emit : callable
        Gets the code, and the address of each array at the stage.
    lengths : sequence of int
        Numbers of a stage in each array.
    shared, backward
        As in `stagewise`.
    """
    strides = [0 if i in shared else length for i, length in enumerate(lengths)]
    lanes = Lanes(ir.Module("flypend"), BLOCK)
    code, count, arrays = begin_kernel(lanes, len(lengths))
    with each_stage(code, count, backward) as k:
        emit(
            code,
            *(
                code.scalar_at(array, code.builder.mul(k, ir.Constant(I64, stride)))
                for array, stride in zip(arrays, strides, strict=True)
            ),
        )
    code.builder.ret_void()
    kinds: list[Any] = [ctypes.c_int64, *[ctypes.c_void_p] * len(lengths)]
    native = jit.build(f"recursion {name} {lanes.module}", lambda: lanes.module, "kernel", kinds)
    return Stagewise(native, tuple(8 * stride for stride in strides))
