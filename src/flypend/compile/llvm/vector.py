"""LLVM code generation on SIMD lanes: memory and operator-overloaded arithmetic."""

from __future__ import annotations

from llvmlite import ir

from flypend.compile.llvm.target import Target, native

I64, POINTER, VOID = ir.IntType(64), ir.PointerType(), ir.VoidType()
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
        self.size = (8 if precision == "double" else 4) * width
        self.kind = f"{width}x{8 * self.size // width}"
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

    def reserve(self, length: int) -> ir.Value:
        """Allocate `length` vectors on the stack."""
        with self.builder.goto_entry_block():
            memory = self.builder.alloca(self.lanes.array(length))
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

    # Values -------------------------------------------------------------------------------------------------------

    def value(self, value: Value | float) -> Value:
        """Convert `value` to a vector value; numbers are broadcast."""
        if isinstance(value, Value):
            return value
        return Value(self, self.lanes.constant(float(value)))

    def select(self, mask: Value, yes: Value | float, no: Value | float) -> Value:
        """`yes` where `mask`, else `no`."""
        return Value(self, self.builder.select(mask.raw, self.value(yes).raw, self.value(no).raw))

    def least(self, a: Value | float, b: Value | float) -> Value:
        """Minimum per lane; `b` if either is NaN."""
        return self.select(self.value(a) < b, a, b)

    def most(self, a: Value | float, b: Value | float) -> Value:
        """Maximum per lane; `b` if either is NaN."""
        return self.select(self.value(a) > b, a, b)

    def sqrt(self, value: Value) -> Value:
        """Square root."""
        return Value(self, self.builder.call(self.lanes.intrinsic("sqrt"), [value.raw]))

    def floor(self, value: Value) -> Value:
        """Largest integer not above."""
        return Value(self, self.builder.call(self.lanes.intrinsic("floor"), [value.raw]))

    def fabs(self, value: Value) -> Value:
        """Absolute value."""
        return Value(self, self.builder.call(self.lanes.intrinsic("fabs"), [value.raw]))

    def elementary(self, name: str, value: Value) -> Value:
        """Call the function `name` of compile/loops/elementary.cpp on all lanes."""
        lanes = self.lanes
        function = lanes.declared(f"{name}.{lanes.kind}", ir.FunctionType(lanes.vector, [lanes.vector]))
        return Value(self, self.builder.call(function, [value.raw]))

    def library(self, name: str, *values: Value) -> Value:
        """Call the C library function `name` per lane."""
        function = self.lanes.library(name, len(values))
        result = ir.Constant(self.lanes.vector, ir.Undefined)
        for lane in range(self.lanes.width):
            place = ir.Constant(ir.IntType(32), lane)
            scalars = [self.builder.extract_element(value.raw, place) for value in values]
            result = self.builder.insert_element(result, self.builder.call(function, scalars), place)
        return Value(self, result)

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
