"""LLVM code generation on SIMD lanes: memory, operator-overloaded arithmetic and control flow."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from llvmlite import ir

from flypend.compile.llvm.target import Target, native

I1, I64, POINTER, VOID = ir.IntType(1), ir.IntType(64), ir.PointerType(), ir.VoidType()
LINE = 64  # bytes of a cache line
# Allow fused multiply-add, reassociation, ignoring the sign of zero, and shared reciprocals: 10 % faster, with the same
# result in every lane of a kernel. NaN and infinity keep their meaning.
FLAGS = ("contract", "reassoc", "nsz", "arcp")


class Lanes:
    """Vector type of a module: `width` lanes of `precision` "double" or "float", by default on this processor."""

    def __init__(self, module: ir.Module, width: int, precision: str = "double", target: Target | None = None) -> None:
        self.target = target or native()
        self.module = module
        self.width = width
        self.precision = precision
        self.scalar = ir.DoubleType() if precision == "double" else ir.FloatType()
        self.vector = ir.VectorType(self.scalar, width)
        self.mask = ir.VectorType(I1, width)
        self.size = (8 if precision == "double" else 4) * width
        self.estimates_roots = precision == "double" and width % 8 == 0 and self.target.estimates_roots

    def constant(self, value: float) -> ir.Value:
        """`value` in every lane."""
        return ir.Constant(self.vector, [ir.Constant(self.scalar, value)] * self.width)

    def array(self, length: int) -> ir.Type:
        """Array type of `length` vectors."""
        return ir.ArrayType(self.vector, max(1, length))

    def intrinsic(self, name: str, arguments: int = 1) -> ir.Function:
        """The LLVM intrinsic `name` on vectors."""
        bits = 64 if self.precision == "double" else 32
        return self.declared(
            f"llvm.{name}.v{self.width}f{bits}", ir.FunctionType(self.vector, [self.vector] * arguments)
        )

    def library(self, name: str, arguments: int) -> ir.Function:
        """The C library function `name` on scalars."""
        suffix = "" if self.precision == "double" else "f"
        return self.declared(name + suffix, ir.FunctionType(self.scalar, [self.scalar] * arguments))

    def declared(self, name: str, kind: ir.FunctionType) -> ir.Function:
        """Declare the external function `name`."""
        known = self.module.globals.get(name)
        return known if known is not None else ir.Function(self.module, kind, name)

    def function(self, name: str, pointers: int, *, inline: bool = False) -> tuple[ir.Function, Code]:
        """Add a function with this many `pointers` as arguments to the module; return it and its `Code`.

        `inline` is for a function with a single call: the processor then need not drain its pipeline between the parts.
        """
        function = ir.Function(self.module, ir.FunctionType(VOID, [POINTER] * pointers), name)
        function.linkage = "internal"
        function.attributes.add("alwaysinline" if inline else "noinline")
        # Without it LLVM discovers vector spills too late to align the stack, and half straddle two cache lines.
        function.attributes.alignstack = max(16, self.size)
        return function, Code(self, ir.IRBuilder(function.append_basic_block()))


class Code:
    """Code under construction in one function."""

    def __init__(self, lanes: Lanes, builder: ir.IRBuilder) -> None:
        self.lanes = lanes
        self.builder = builder
        self.flags: tuple[str, ...] = FLAGS

    # Memory -------------------------------------------------------------------------------------------------------

    def reserve(self, length: int, kind: ir.Type | None = None) -> ir.Value:
        """Allocate `length` vectors (of type `kind`) on the stack."""
        kind = kind or self.lanes.vector
        with self.builder.goto_entry_block():
            memory = self.builder.alloca(ir.ArrayType(kind, max(1, length)))
            memory.align = LINE
            memory.type = POINTER  # make it opaque; llvmlite would insist on the allocated type
        return memory

    def vector_at(self, memory: ir.Value, index: int | ir.Value, kind: ir.Type | None = None) -> ir.Value:
        """Address of vector `index` in `memory`."""
        index = ir.Constant(I64, index) if isinstance(index, int) else index
        return self.builder.gep(memory, [index], source_etype=kind or self.lanes.vector)

    def load(self, memory: ir.Value, index: int | ir.Value = 0) -> Value:
        """Load vector `index` of `memory`."""
        loaded = self.builder.load(self.vector_at(memory, index), typ=self.lanes.vector)
        loaded.align = self.lanes.size
        return Value(self, loaded)

    def store(self, value: Value | float, memory: ir.Value, index: int | ir.Value = 0) -> None:
        """Store `value` to vector `index` of `memory`."""
        self.builder.store(self.value(value).raw, self.vector_at(memory, index)).align = self.lanes.size

    def scalar_at(self, memory: ir.Value, index: ir.Value, kind: ir.Type | None = None) -> ir.Value:
        """Address of scalar `index` (an i64) in `memory`."""
        return self.builder.gep(memory, [index], source_etype=kind or self.lanes.scalar)

    def scalar(self, memory: ir.Value, index: ir.Value, kind: ir.Type | None = None) -> ir.Value:
        """Load scalar `index` of `memory`."""
        return self.builder.load(self.scalar_at(memory, index, kind), typ=kind or self.lanes.scalar)

    def put(self, value: ir.Value, memory: ir.Value, index: ir.Value) -> None:
        """Store the scalar `value` at `index` of `memory`."""
        self.builder.store(value, self.scalar_at(memory, index, value.type))

    # Values -------------------------------------------------------------------------------------------------------

    def value(self, value: Value | float | ir.Value) -> Value:
        """Convert `value` to a vector value; numbers and LLVM scalars are broadcast."""
        if isinstance(value, Value):
            return value
        if isinstance(value, (int, float)):
            return Value(self, self.lanes.constant(float(value)))
        return Value(self, self.repeated(value))

    def repeated(self, single: ir.Value) -> ir.Value:
        """Broadcast the scalar `single` to every lane."""
        width, i32 = self.lanes.width, ir.IntType(32)
        nothing = ir.Constant(ir.VectorType(single.type, width), ir.Undefined)
        first = self.builder.insert_element(nothing, single, ir.Constant(i32, 0))
        return self.builder.shuffle_vector(first, nothing, ir.Constant(ir.VectorType(i32, width), [0] * width))

    def select(self, mask: Value, yes: Value | float, no: Value | float) -> Value:
        """`yes` where `mask`, else `no`."""
        return Value(self, self.builder.select(mask.raw, self.value(yes).raw, self.value(no).raw))

    def least(self, a: Value | float, b: Value | float) -> Value:
        """Minimum per lane; `b` if either is NaN."""
        return self.select(self.value(a) < b, a, b)

    def most(self, a: Value | float, b: Value | float) -> Value:
        """Maximum per lane; `b` if either is NaN."""
        return self.select(self.value(a) > b, a, b)

    def any(self, mask: Value) -> ir.Value:
        """Whether `mask` is true in any lane, as an i1."""
        bits = ir.IntType(self.lanes.width)
        return self.builder.icmp_unsigned("!=", self.builder.bitcast(mask.raw, bits), ir.Constant(bits, 0))

    def sqrt(self, value: Value) -> Value:
        """Square root."""
        return Value(self, self.builder.call(self.lanes.intrinsic("sqrt"), [value.raw]))

    def power(self, value: Value, exponent: float) -> Value:
        """`value` > 0 to a power, accurate to a few per cent: the bit pattern of a float approximates its logarithm."""
        lanes, builder = self.lanes, self.builder
        bits = 64 if lanes.precision == "double" else 32
        kind = ir.VectorType(ir.IntType(bits), lanes.width)
        one = float(0x3FF << 52 if bits == 64 else 0x7F << 23)
        number = Value(self, builder.sitofp(builder.bitcast(value.raw, kind), lanes.vector))
        wanted = (number - one) * exponent + one
        return Value(self, builder.bitcast(builder.fptosi(wanted.raw, kind), lanes.vector))

    def floor(self, value: Value) -> Value:
        """Largest integer not above."""
        return Value(self, self.builder.call(self.lanes.intrinsic("floor"), [value.raw]))

    def fabs(self, value: Value) -> Value:
        """Absolute value."""
        return Value(self, self.builder.call(self.lanes.intrinsic("fabs"), [value.raw]))

    def library(self, name: str, *values: Value) -> Value:
        """Call the C library function `name` per lane."""
        function = self.lanes.library(name, len(values))
        result = ir.Constant(self.lanes.vector, ir.Undefined)
        for lane in range(self.lanes.width):
            place = ir.Constant(ir.IntType(32), lane)
            scalars = [self.builder.extract_element(value.raw, place) for value in values]
            result = self.builder.insert_element(result, self.builder.call(function, scalars), place)
        return Value(self, result)

    # Control flow -------------------------------------------------------------------------------------------------

    @contextmanager
    def when(self, bit: ir.Value) -> Iterator[None]:
        """Emit code that runs if `bit` is set."""
        with self.builder.if_then(bit):
            yield

    @contextmanager
    def count(self, number: int | ir.Value) -> Iterator[ir.Value]:
        """Emit a loop that runs `number` times; yields the i64 index, from 0."""
        limit = ir.Constant(I64, number) if isinstance(number, int) else number
        counter = self.reserve(1, I64)
        self.builder.store(ir.Constant(I64, 0), counter)
        with self.loop(lambda: self.builder.icmp_signed("<", self.builder.load(counter, typ=I64), limit)):
            index = self.builder.load(counter, typ=I64)
            yield index
            self.builder.store(self.builder.add(index, ir.Constant(I64, 1)), counter)

    @contextmanager
    def each(self, mask: Value) -> Iterator[ir.Value]:
        """Emit a loop over the lanes set in `mask`; yields the i64 lane index."""
        builder, left = self.builder, self.reserve(1, I64)
        bits = builder.bitcast(mask.raw, ir.IntType(self.lanes.width))
        builder.store(builder.zext(bits, I64), left)
        zero, one = ir.Constant(I64, 0), ir.Constant(I64, 1)
        with self.loop(lambda: builder.icmp_unsigned("!=", builder.load(left, typ=I64), zero)):
            rest = builder.load(left, typ=I64)
            yield builder.cttz(rest, ir.Constant(I1, 1))
            builder.store(builder.and_(rest, builder.sub(rest, one)), left)

    @contextmanager
    def loop(self, condition: Callable[[], ir.Value]) -> Iterator[None]:
        """Emit a loop that runs while the i1 emitted by `condition()` is true."""
        head, body, after = (self.builder.append_basic_block(name) for name in ("while", "do", "after"))
        self.builder.branch(head)
        self.builder.position_at_end(head)
        self.builder.cbranch(condition(), body, after)
        self.builder.position_at_end(body)
        yield
        self.builder.branch(head)
        self.builder.position_at_end(after)

    def call(self, function: ir.Function, *arguments: ir.Value) -> None:
        """Emit a call of `function`."""
        self.builder.call(function, arguments)


class Value:
    """A computed vector with one number per lane, or a mask; arithmetic on it emits instructions."""

    def __init__(self, code: Code, raw: ir.Value) -> None:
        self.code = code
        self.raw = raw

    def _float(self, name: str, other: Value | float, swapped: bool = False) -> Value:
        pair = [self.raw, self.code.value(other).raw]
        return Value(
            self.code, getattr(self.code.builder, name)(*(pair[::-1] if swapped else pair), flags=self.code.flags)
        )

    def __add__(self, other: Value | float) -> Value:
        return self._float("fadd", other)

    def __radd__(self, other: float) -> Value:
        return self._float("fadd", other, swapped=True)

    def __sub__(self, other: Value | float) -> Value:
        return self._float("fsub", other)

    def __rsub__(self, other: float) -> Value:
        return self._float("fsub", other, swapped=True)

    def __mul__(self, other: Value | float) -> Value:
        return self._float("fmul", other)

    def __rmul__(self, other: float) -> Value:
        return self._float("fmul", other, swapped=True)

    def __truediv__(self, other: Value | float) -> Value:
        return self._float("fdiv", other)

    def __rtruediv__(self, other: float) -> Value:
        return self._float("fdiv", other, swapped=True)

    def __neg__(self) -> Value:
        return Value(self.code, self.code.builder.fneg(self.raw))

    def compare(self, sign: str, other: Value | float) -> Value:
        """Compare to a mask: "<", "<=", ">", ">=" and "==" are false for NaN, "!=" is true."""
        method = self.code.builder.fcmp_unordered if sign == "!=" else self.code.builder.fcmp_ordered
        return Value(self.code, method(sign, self.raw, self.code.value(other).raw))

    def __lt__(self, other: Value | float) -> Value:
        return self.compare("<", other)

    def __le__(self, other: Value | float) -> Value:
        return self.compare("<=", other)

    def __gt__(self, other: Value | float) -> Value:
        return self.compare(">", other)

    def __ge__(self, other: Value | float) -> Value:
        return self.compare(">=", other)

    def __and__(self, other: Value) -> Value:
        return Value(self.code, self.code.builder.and_(self.raw, other.raw))

    def __or__(self, other: Value) -> Value:
        return Value(self.code, self.code.builder.or_(self.raw, other.raw))

    def __invert__(self) -> Value:
        return Value(self.code, self.code.builder.not_(self.raw))
