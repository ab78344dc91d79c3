"""Counter-based normal random numbers: the draws of a tick depend on seed and tick only, not on their order."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from llvmlite import ir

from flypend.compile.llvm import jit
from flypend.compile.llvm.elementary import log_of_normal, nearest, turned
from flypend.compile.llvm.vector import I64, VOID, Code, Lanes, Value

# Philox4x32-10 (Salmon and others 2011, "Parallel random numbers: as easy as 1, 2, 3").
MULTIPLIERS, WEYL, ROUNDS = (0xD2511F53, 0xCD9E8D57), (0x9E3779B9, 0xBB67AE85), 10
PER_TICK = 24
WIDTH = 8


def philox(builder: ir.IRBuilder, counter: list[ir.Value], key: list[ir.Value]) -> list[ir.Value]:
    """Four random words from four of `counter` and two of `key`: 32 bits each, in 64-bit integers or vectors."""
    kind = counter[0].type

    def fixed(number: int) -> ir.Value:
        count = getattr(kind, "count", None)
        return ir.Constant(kind, number if count is None else [number] * count)

    low = fixed(0xFFFFFFFF)
    for turn in range(ROUNDS):
        products = [builder.mul(counter[2 * i], fixed(MULTIPLIERS[i])) for i in range(2)]
        high = [builder.lshr(product, fixed(32)) for product in products]
        words = [builder.and_(product, low) for product in products]
        keys = [builder.and_(builder.add(key[i], fixed(turn * WEYL[i] & 0xFFFFFFFF)), low) for i in range(2)]
        counter = [
            builder.xor(builder.xor(high[1], counter[1]), keys[0]), words[1],
            builder.xor(builder.xor(high[0], counter[3]), keys[1]), words[0],
        ]  # fmt: skip
    return counter


def define_normals(lanes: Lanes, used: range = range(PER_TICK), name: str = "normals") -> ir.Function:
    """Define a function (seeds, ticks, out) called `name`: normal numbers of each lane's seed and tick.

    Only the numbers `used` are drawn, in whole blocks of four.
    """
    function, code = lanes.function(name, 3)
    for block, uniform in _uniforms(code, function.args, range(used.start // 4, -(-used.stop // 4))):
        for pair in range(2):
            _box_muller(code, uniform[2 * pair], uniform[2 * pair + 1], function.args[2], 4 * block + 2 * pair)
    code.builder.ret_void()
    return function


def define_uniforms(lanes: Lanes, length: int) -> ir.Function:
    """Define a function (seeds, ticks, out): `length` numbers per lane, uniform in (0, 1), in whole blocks of four."""
    function, code = lanes.function("uniforms", 3)
    for block, uniform in _uniforms(code, function.args, range(-(-length // 4))):
        for i, value in enumerate(uniform):
            code.store(value, function.args[2], 4 * block + i)
    code.builder.ret_void()
    return function


def _uniforms(code: Code, memories: Sequence[ir.Value], blocks: range) -> Iterator[tuple[int, list[Value]]]:
    """The `blocks` of four uniform numbers for the seeds and ticks at the first two of `memories`, by number."""
    builder, kind = code.builder, ir.VectorType(I64, code.lanes.width)
    seed, tick = (_integers(code, memory, kind) for memory in memories[:2])
    shift = ir.Constant(kind, [32] * code.lanes.width)
    low = ir.Constant(kind, [0xFFFFFFFF] * code.lanes.width)
    key = [builder.and_(seed, low), builder.lshr(seed, shift)]
    for block in blocks:
        counter = [ir.Constant(kind, [block] * code.lanes.width), builder.and_(tick, low), builder.lshr(tick, shift)]
        words = philox(builder, [*counter, ir.Constant(kind, [0] * code.lanes.width)], key)
        yield block, [(Value(code, builder.uitofp(word, code.lanes.vector)) + 0.5) * 2.0**-32 for word in words]


def _integers(code: Code, memory: ir.Value, kind: ir.VectorType) -> ir.Value:
    loaded = code.builder.load(memory, typ=kind)
    loaded.align = 8
    return loaded


def _box_muller(code: Code, u: Value, v: Value, out: ir.Value, place: int) -> None:
    """Two normal numbers from `u` and `v`, uniform in (0, 1): √(−2 log u) cos 2πv and … sin 2πv."""
    radius = code.sqrt(-2.0 * log_of_normal(code, u))
    quarters = nearest(code, 4.0 * v)
    sine, cosine = turned(code, 2 * np.pi * (v - 0.25 * quarters), quarters)  # the difference is exact
    code.store(radius * cosine, out, place)
    code.store(radius * sine, out, place + 1)


def normals(seed: int, ticks: int, count: int = PER_TICK, *, first: int = 0) -> Any:
    """Normal numbers (ticks, count) of the flight with `seed`; row k holds the draws of control tick `first` + k."""
    rows, drawn = -(-ticks // WIDTH), whole_blocks(count)
    out: Any = np.zeros((rows, drawn, WIDTH))
    _compiled(drawn)(seed & 0xFFFFFFFFFFFFFFFF, first, rows, out.ctypes.data)
    return np.ascontiguousarray(out.transpose(0, 2, 1).reshape(rows * WIDTH, drawn)[:ticks, :count])


def whole_blocks(count: int) -> int:
    """Return the length of the blocks of four that hold `count` numbers."""
    return -(-count // 4) * 4


@lru_cache(maxsize=8)
def _compiled(count: int) -> Any:
    kinds = [ctypes.c_uint64, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p]
    return jit.build(f"normals of {count}", lambda: _module(count), "normals_of_ticks", kinds)


def _module(count: int) -> ir.Module:
    """Module with a function (seed, first, rows, out).

    Row i holds `count` numbers of the ticks first + i·WIDTH …, one tick per lane.
    """
    lanes = Lanes(ir.Module("normals"), WIDTH)
    draw = define_normals(lanes, range(count))
    kinds = [I64, I64, I64, ir.PointerType()]
    function = ir.Function(lanes.module, ir.FunctionType(VOID, kinds), "normals_of_ticks")
    code = Code(lanes, ir.IRBuilder(function.append_basic_block()))
    seed, begin, rows, out = function.args
    seeds, ticks, drawn = code.reserve(WIDTH, I64), code.reserve(WIDTH, I64), code.reserve(count)
    with code.count(rows) as row:
        for lane in range(WIDTH):
            place = ir.Constant(I64, lane)
            code.put(seed, seeds, place)
            first = code.builder.add(begin, code.builder.mul(row, ir.Constant(I64, WIDTH)))
            code.put(code.builder.add(first, place), ticks, place)
        code.call(draw, seeds, ticks, drawn)
        with code.count(count * WIDTH) as i:
            base = code.builder.mul(row, ir.Constant(I64, count * WIDTH))
            code.put(code.scalar(drawn, i), out, code.builder.add(base, i))
    code.builder.ret_void()
    return lanes.module
