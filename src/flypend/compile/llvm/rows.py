"""Conversion between memory layouts: kernels store component by component across lanes, callers run by run."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.vector import I64, POINTER, VOID, Code, Lanes, Value

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
            code.put(as_double(code, code.scalar(source, here)), rows, there)
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


def copy_row(code: Code, source: ir.Value, here: ir.Value, target: ir.Value, there: ir.Value, length: int) -> None:
    """Copy row `here` of `source`, `length` doubles, to row `there` of `target`, and prefetch the row after that."""
    builder = code.builder
    first, second = (builder.mul(row, ir.Constant(I64, length)) for row in (here, there))

    def move(offset: int, kind: ir.Type) -> None:
        step = ir.Constant(I64, offset)
        value = builder.load(code.scalar_at(source, builder.add(first, step), ir.DoubleType()), typ=kind)
        value.align = 8
        place = builder.add(second, step)
        builder.store(value, code.scalar_at(target, place, ir.DoubleType())).align = 8
        _fetch(code, code.scalar_at(target, builder.add(place, ir.Constant(I64, length)), ir.DoubleType()))

    for offset in range(0, length - length % BLOCK, BLOCK):
        move(offset, DOUBLES)
    for offset in range(length - length % BLOCK, length):
        move(offset, ir.DoubleType())


def _fetch(code: Code, place: ir.Value) -> None:
    """Prefetch the cache line at `place` for writing; `place` may lie outside the array."""
    kind = ir.FunctionType(VOID, [POINTER, _I32, _I32, _I32])
    write, keep, data = (ir.Constant(_I32, value) for value in (1, 3, 1))
    code.builder.call(code.lanes.declared("llvm.prefetch.p0", kind), [place, write, keep, data])


def gathered(code: Code, memory: ir.Value, places: ir.Value, mask: Value) -> Value:
    """Gather the doubles of `memory` at the indices `places` (a vector of i64) in the lanes of `mask`; 0 elsewhere."""
    builder, lanes = code.builder, code.lanes
    integers, pointers = ir.VectorType(I64, lanes.width), ir.VectorType(POINTER, lanes.width)
    doubles = ir.VectorType(ir.DoubleType(), lanes.width)
    base = code.repeated(builder.ptrtoint(memory, I64))
    offsets = builder.shl(places, ir.Constant(integers, [3] * lanes.width))  # times 8 bytes
    addresses = builder.inttoptr(builder.add(base, offsets), pointers)
    kind = ir.FunctionType(doubles, [pointers, _I32, lanes.mask, doubles])
    gather = lanes.declared(f"llvm.masked.gather.v{lanes.width}f64.v{lanes.width}p0", kind)
    align, zeros = ir.Constant(_I32, 8), ir.Constant(doubles, [0.0] * lanes.width)
    found = builder.call(gather, [addresses, align, mask.raw, zeros])
    return Value(code, found if lanes.precision == "double" else builder.fptrunc(found, lanes.vector))


def as_double(code: Code, value: ir.Value) -> ir.Value:
    """Convert a scalar of the lanes to double."""
    return value if code.lanes.precision == "double" else code.builder.fpext(value, ir.DoubleType())


def from_double(code: Code, value: ir.Value) -> ir.Value:
    """Convert a double to the scalar type of the lanes."""
    return value if code.lanes.precision == "double" else code.builder.fptrunc(value, code.lanes.scalar)


def copy_lane(
    code: Code, memory: ir.Value, lane: ir.Value, rows: ir.Value, row: ir.Value, length: int, *, out: bool
) -> None:
    """Copy lane `lane` of `length` vectors to row `row` of an array of doubles, or from it unless `out`."""
    builder = code.builder
    with code.count(length) as i:
        here = builder.add(builder.mul(i, ir.Constant(I64, code.lanes.width)), lane)
        there = builder.add(builder.mul(row, ir.Constant(I64, length)), i)
        if out:
            code.put(as_double(code, code.scalar(memory, here)), rows, there)
        else:
            code.put(from_double(code, code.scalar(rows, there, ir.DoubleType())), memory, here)
