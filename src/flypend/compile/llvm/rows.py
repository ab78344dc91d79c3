"""Conversion between memory layouts: kernels store component by component across lanes, callers run by run."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.vector import I64, Code, Lanes, Value

# Size of the square blocks of lanes × components that are transposed in registers.
BLOCK = 8
DOUBLES = ir.VectorType(ir.DoubleType(), BLOCK)
_I32 = ir.IntType(32)


def define_turn(lanes: Lanes, length: int) -> ir.Function:
    """Define a function (vectors, rows) that transposes `length` vectors to one row of `length` doubles per lane."""
    known = lanes.module.globals.get(f"turn_{length}")
    if known is not None:
        return known
    function, code = lanes.function(f"turn_{length}", 2)
    source, rows = function.args
    blocks = length - length % BLOCK if lanes.width % BLOCK == 0 else 0
    for lane in range(0, lanes.width, BLOCK):
        for first in range(0, blocks, BLOCK):
            block = [_eight_lanes(code, source, first + i, lane) for i in range(BLOCK)]
            for i, row in enumerate(_transposed(code.builder, block)):
                place = ir.Constant(I64, (lane + i) * length + first)
                code.builder.store(row, code.scalar_at(rows, place, ir.DoubleType())).align = 8
    for i in range(blocks, length):
        with code.count(lanes.width) as lane:
            here = code.builder.add(ir.Constant(I64, i * lanes.width), lane)
            there = code.builder.add(code.builder.mul(lane, ir.Constant(I64, length)), ir.Constant(I64, i))
            code.put(_as_double(code, code.scalar(source, here)), rows, there)
    code.builder.ret_void()
    return function


def define_spread(lanes: Lanes, length: int) -> ir.Function:
    """Define a function (rows, vectors), the inverse of `define_turn` for doubles in `BLOCK` lanes."""
    known = lanes.module.globals.get(f"spread_{length}")
    if known is not None:
        return known
    function, code = lanes.function(f"spread_{length}", 2)
    rows, target = function.args
    for first in range(0, length - length % BLOCK, BLOCK):
        block = []
        for lane in range(BLOCK):
            place = code.scalar_at(rows, ir.Constant(I64, lane * length + first))
            block.append(code.builder.load(place, typ=DOUBLES))
            block[-1].align = 8
        for i, vector in enumerate(_transposed(code.builder, block)):
            code.store(Value(code, vector), target, first + i)
    for i in range(length - length % BLOCK, length):
        with code.count(BLOCK) as lane:
            here = code.builder.add(code.builder.mul(lane, ir.Constant(I64, length)), ir.Constant(I64, i))
            there = code.builder.add(ir.Constant(I64, i * BLOCK), lane)
            code.put(code.scalar(rows, here), target, there)
    code.builder.ret_void()
    return function


def _eight_lanes(code: Code, memory: ir.Value, index: int, lane: int) -> ir.Value:
    """Eight lanes of vector `index`, starting at `lane`, as doubles."""
    vector = code.load(memory, index).raw
    if code.lanes.width > BLOCK:
        vector = code.builder.shuffle_vector(vector, vector, _mask(range(lane, lane + BLOCK)))
    return vector if code.lanes.precision == "double" else code.builder.fpext(vector, DOUBLES)


def _transposed(builder: ir.IRBuilder, block: list[ir.Value]) -> list[ir.Value]:
    """Transpose eight vectors of eight by swapping off-diagonal blocks of size one, two and four."""
    for size in (1, 2, 4):
        low = _mask(k if not k & size else BLOCK + k - size for k in range(BLOCK))
        high = _mask(k + size if not k & size else BLOCK + k for k in range(BLOCK))
        turned = list(block)
        for i in range(BLOCK):
            if not i & size:
                turned[i] = builder.shuffle_vector(block[i], block[i + size], low)
                turned[i + size] = builder.shuffle_vector(block[i], block[i + size], high)
        block = turned
    return block


def _mask(places: object) -> ir.Constant:
    chosen = list(places)  # type: ignore[call-overload]
    return ir.Constant(ir.VectorType(ir.IntType(32), len(chosen)), chosen)


def _as_double(code: Code, value: ir.Value) -> ir.Value:
    """Convert a scalar of the lanes to double."""
    return value if code.lanes.precision == "double" else code.builder.fpext(value, ir.DoubleType())
