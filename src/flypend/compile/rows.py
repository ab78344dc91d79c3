"""Between lanes and rows: a kernel holds component i of all lanes side by side, a caller's array run by run."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.vector import I64, Code, Lanes

# Lanes and components that are turned at a time, in registers.
BLOCK = 8
DOUBLES = ir.VectorType(ir.DoubleType(), BLOCK)


def define_turn(lanes: Lanes, length: int) -> ir.Function:
    """A function (vectors, rows) of the module: `length` vectors become one row of `length` doubles per lane."""
    known = lanes.module.globals.get(f"turn_{length}")
    if known is not None:
        return known
    function, code = lanes.function(f"turn_{length}", 2)
    source, rows = function.args
    for lane in range(0, lanes.width, BLOCK):
        for first in range(0, length - length % BLOCK, BLOCK):
            block = [_eight_lanes(code, source, first + i, lane) for i in range(BLOCK)]
            for i, row in enumerate(_turned(code.builder, block)):
                place = ir.Constant(I64, (lane + i) * length + first)
                code.builder.store(row, code.scalar_at(rows, place, ir.DoubleType())).align = 8
    for i in range(length - length % BLOCK, length):
        with code.count(lanes.width) as lane:
            here = code.builder.add(ir.Constant(I64, i * lanes.width), lane)
            there = code.builder.add(code.builder.mul(lane, ir.Constant(I64, length)), ir.Constant(I64, i))
            code.put(as_double(code, code.scalar(source, here)), rows, there)
    code.builder.ret_void()
    return function


def _eight_lanes(code: Code, memory: ir.Value, index: int, lane: int) -> ir.Value:
    """Eight lanes of vector `index` from `lane` on, as doubles."""
    vector = code.load(memory, index).raw
    if code.lanes.width > BLOCK:
        vector = code.builder.shuffle_vector(vector, vector, _mask(range(lane, lane + BLOCK)))
    return vector if code.lanes.precision == "double" else code.builder.fpext(vector, DOUBLES)


def _turned(builder: ir.IRBuilder, block: list[ir.Value]) -> list[ir.Value]:
    """The transpose of eight vectors of eight: blocks of one, two and four change places."""
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
    """Copy row `here` of `length` doubles of `source` to row `there` of `target`."""
    builder = code.builder
    first, second = (builder.mul(row, ir.Constant(I64, length)) for row in (here, there))

    def move(offset: int, kind: ir.Type) -> None:
        step = ir.Constant(I64, offset)
        value = builder.load(code.scalar_at(source, builder.add(first, step), ir.DoubleType()), typ=kind)
        value.align = 8
        builder.store(value, code.scalar_at(target, builder.add(second, step), ir.DoubleType())).align = 8

    for offset in range(0, length - length % BLOCK, BLOCK):
        move(offset, DOUBLES)
    for offset in range(length - length % BLOCK, length):
        move(offset, ir.DoubleType())


def as_double(code: Code, value: ir.Value) -> ir.Value:
    """A scalar of the lanes as a double."""
    return value if code.lanes.precision == "double" else code.builder.fpext(value, ir.DoubleType())


def from_double(code: Code, value: ir.Value) -> ir.Value:
    """A double as a scalar of the lanes."""
    return value if code.lanes.precision == "double" else code.builder.fptrunc(value, code.lanes.scalar)


def copy_lane(
    code: Code, memory: ir.Value, lane: ir.Value, rows: ir.Value, row: ir.Value, length: int, *, out: bool
) -> None:
    """Copy lane `lane` of `length` vectors to (`out`) or from row `row` of an array of doubles."""
    builder = code.builder
    with code.count(length) as i:
        here = builder.add(builder.mul(i, ir.Constant(I64, code.lanes.width)), lane)
        there = builder.add(builder.mul(row, ir.Constant(I64, length)), i)
        if out:
            code.put(as_double(code, code.scalar(memory, here)), rows, there)
        else:
            code.put(from_double(code, code.scalar(rows, there, ir.DoubleType())), memory, here)
