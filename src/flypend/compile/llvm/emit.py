"""Scalar programs as LLVM functions on vectors of lanes, in LLVM's assembly language."""

from __future__ import annotations

import struct
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial

from flypend.compile.llvm.target import Target, native
from flypend.compile.numeric import LINE
from flypend.compile.program import LIBRARY, LIBRARY_2, ONE, Operation, Program, drop_dead, interpret
from flypend.compile.routine import Cell, Routine, stretches

ELEMENTARY = ("logarithm", "sine", "cosine", "inverse_root")  # functions of compile/loops/elementary.cpp
# Allow fused multiply-add, reassociation, ignoring the sign of zero, and shared reciprocals: 10 % faster, with the same
# result in every lane of a kernel. NaN and infinity keep their meaning.
FLAGS = "contract reassoc nsz arcp "


class Module:
    """An LLVM module: definitions in assembly language, and `declared`, the functions elsewhere that they call."""

    def __init__(self) -> None:
        self.definitions: list[str] = []
        self.declared: dict[str, str] = {}

    def __str__(self) -> str:
        return "\n".join([*self.declared.values(), *self.definitions])


@dataclass(frozen=True, eq=False)
class Lanes:
    """Vectors in a `module`: `width` lanes of `precision` "double" or "float", by default on this processor."""

    module: Module
    width: int
    precision: str = "double"
    target: Target = field(default_factory=native)

    @property
    def bits(self) -> int:
        """Size of a number."""
        return 64 if self.precision == "double" else 32

    @property
    def size(self) -> int:
        """Size of a vector, bytes."""
        return self.bits // 8 * self.width

    @cached_property
    def vector(self) -> str:
        """The type of a vector."""
        return f"<{self.width} x {self.precision}>"

    @cached_property
    def words(self) -> dict[str, str]:
        """What the forms of operations take beside values."""
        mask, zero, one = f"<{self.width} x i1>", self.constant(0.0), self.constant(1.0)
        return {"v": self.vector, "m": mask, "kind": f"v{self.width}f{self.bits}", "zero": zero, "one": one}

    @property
    def estimates_roots(self) -> bool:
        """Whether 1/√x begins with an estimate."""
        return self.precision == "double" and self.width % 8 == 0 and self.target.estimates_roots

    def constant(self, value: float) -> str:
        """`value` in every lane."""
        if self.precision == "float":
            (value,) = struct.unpack("f", struct.pack("f", value))
        # Lane by lane: LLVM before 19, which sanitisers may bring, knows no splat.
        return f"<{', '.join([f'{self.precision} {hexadecimal(value)}'] * self.width)}>"

    def function(self, name: str, pointers: int) -> Code:
        """Begin a function with this many `pointers` as arguments."""
        return Code(self, name, tuple(f"%a{i}" for i in range(pointers)))


def hexadecimal(value: float) -> str:
    """A number, in LLVM's notation to the bit."""
    return f"0x{struct.pack('>d', value).hex().upper()}"


class Code:
    """A function `name` under construction, whose arguments are pointers; values are written as LLVM has them."""

    def __init__(self, lanes: Lanes, name: str, arguments: tuple[str, ...]) -> None:
        self.lanes, self.name, self.arguments, self.flags = lanes, name, arguments, FLAGS
        self._stack: list[str] = []
        self._lines: list[str] = []

    def put(self, text: str) -> str:
        """Add an instruction, and return its value."""
        self._lines.append(f"%v{len(self._lines)} = {text}")
        return f"%v{len(self._lines) - 1}"

    def do(self, text: str) -> None:
        """Add an instruction without a value."""
        self._lines.append(text)

    def form(self, text: str, *values: str) -> str:
        """Add the instruction of a form, such as "fadd {f}{v} {0}, {1}", and return its value."""
        return self.put(text.format(*values, f=self.flags, **self.lanes.words))

    def reserve(self, length: int) -> str:
        """Allocate `length` vectors on the stack."""
        kind = f"[{max(1, length)} x {self.lanes.vector}]"
        self._stack.append(f"%s{len(self._stack)} = alloca {kind}, align {LINE}")
        return f"%s{len(self._stack) - 1}"

    def vector_at(self, memory: str, index: int) -> str:
        """Address of vector `index` in `memory`."""
        return self.put(f"getelementptr {self.lanes.vector}, ptr {memory}, i64 {index}")

    def load(self, memory: str, index: int = 0) -> str:
        """Load vector `index` of `memory`."""
        place = self.vector_at(memory, index)
        return self.put(f"load {self.lanes.vector}, ptr {place}, align {self.lanes.size}")

    def store(self, value: str, memory: str, index: int = 0) -> None:
        """Store `value` to vector `index` of `memory`."""
        place = self.vector_at(memory, index)
        self.do(f"store {self.lanes.vector} {value}, ptr {place}, align {self.lanes.size}")

    def outside(self, name: str, kind: str, *values: str) -> str:
        """Call a function of another module, whose arguments and result are of one `kind`."""
        kinds = ", ".join([kind] * len(values))
        self.lanes.module.declared[name] = f'declare {kind} @"{name}"({kinds})'
        return self.put(f'call {kind} @"{name}"({", ".join(f"{kind} {value}" for value in values)})')

    def elementary(self, name: str, value: str) -> str:
        """Call the function `name` of compile/loops/elementary.cpp on all lanes."""
        return self.outside(f"{name}.{self.lanes.width}x{self.lanes.bits}", self.lanes.vector, value)

    def library(self, name: str, *values: str) -> str:
        """Call the C library function `name` per lane."""
        kind, result = self.lanes.precision, "undef"
        for lane in range(self.lanes.width):
            scalars = [self.form(f"extractelement {{v}} {value}, i32 {lane}") for value in values]
            answer = self.outside(name if kind == "double" else f"{name}f", kind, *scalars)
            result = self.form(f"insertelement {{v}} {result}, {kind} {answer}, i32 {lane}")
        return result

    def intrinsic(self, name: str, value: str) -> str:
        """Call LLVM's function `name` on all lanes."""
        return self.outside(f"llvm.{name}.{self.lanes.words['kind']}", self.lanes.vector, value)

    def select(self, comparison: str, a: str, b: str, yes: str, no: str) -> str:
        """`yes` where the `comparison` of `a` and `b` holds, else `no`."""
        mask = self.form(f"fcmp {comparison} {{v}} {a}, {b}")
        return self.form(f"select {{m}} {mask}, {{v}} {yes}, {{v}} {no}")

    def call(self, function: str, *pointers: str) -> None:
        """Call a function of this module."""
        self.do(f'call void @"{function}"({", ".join(f"ptr {pointer}" for pointer in pointers)})')

    def end(self, *, inline: bool = False, visible: bool = False) -> str:
        """Add the function to the module, and return its name.

        `inline` is for a function with a single call: the processor then need not drain its pipeline between the parts.
        """
        linkage, kind = "" if visible else "internal ", "alwaysinline" if inline else "noinline"
        # Without it LLVM discovers vector spills too late to align the stack, and half straddle two cache lines.
        aligned = f"alignstack({max(16, self.lanes.size)})"
        head = f'define {linkage}void @"{self.name}"({", ".join(f"ptr {a}" for a in self.arguments)})'
        body = "\n".join([*self._stack, *self._lines, "ret void"])
        self.lanes.module.definitions.append(f"{head} {kind} {aligned} {{\n{body}\n}}")
        return self.name


# Comparisons with NaN are false but for "ne"; extremes are the second number if either is NaN.
_FORMS = {
    "add": "fadd {f}{v} {0}, {1}", "sub": "fsub {f}{v} {0}, {1}", "mul": "fmul {f}{v} {0}, {1}",
    "div": "fdiv {f}{v} {0}, {1}", "neg": "fneg {v} {0}",
}  # fmt: skip
_COMPARISONS = {"lt": "olt", "le": "ole", "eq": "oeq", "ne": "une"}
_ELEMENTARY = {"log": "logarithm", "sin": "sine", "cos": "cosine", "inverse root": "inverse_root"}


def operations_of(code: Code) -> dict[str, Callable[..., str]]:
    """Return what emits each operation of a program into `code`."""
    zero, one = code.lanes.words["zero"], code.lanes.words["one"]

    def both(kind: str, a: str, b: str) -> str:
        masks = [code.form(f"fcmp une {{v}} {value}, {{zero}}") for value in (a, b)]
        joined = code.form(f"{kind} {{m}} {masks[0]}, {masks[1]}")
        return code.form(f"select {{m}} {joined}, {{v}} {{one}}, {{v}} {{zero}}")

    return {
        **{name: partial(code.form, form) for name, form in _FORMS.items()},
        **{name: partial(code.library, name) for name in (*LIBRARY, *LIBRARY_2)},
        **{name: partial(code.intrinsic, name) for name in ("sqrt", "fabs", "floor")},
        **{name: partial(code.elementary, called) for name, called in _ELEMENTARY.items()},
        **{name: lambda a, b, sign=sign: code.select(sign, a, b, one, zero) for name, sign in _COMPARISONS.items()},
        "fmin": lambda a, b: code.select("olt", a, b, a, b),
        "fmax": lambda a, b: code.select("ogt", a, b, a, b),
        "sign": lambda a: code.select("ogt", a, zero, one, code.select("olt", a, zero, code.lanes.constant(-1), zero)),
        "select": lambda condition, a: code.select("une", condition, zero, a, zero),
        "not": lambda a: code.select("oeq", a, zero, one, zero),
        "and": partial(both, "and"),
        "or": partial(both, "or"),
    }


def emit(code: Code, program: Program, inputs: Sequence[Callable[[int], str]]) -> list[list[str]]:
    """Emit `program`, where entry i of input vector j is `inputs[j](i)`; return the values of each output vector."""
    chosen = with_inverse_roots(program) if code.lanes.estimates_roots else program
    return interpret(chosen, inputs, operations_of(code), code.lanes.constant)


def with_inverse_roots(program: Program) -> Program:
    """Replace a/√x by a times the operation "inverse root" of x, and √√x by the inverse root of the inverse root."""
    operations: list[Operation] = []
    places: list[int] = []  # of the operations of `program`
    roots: dict[int, int] = {}  # place of the inverse root of a value

    def put(operation: Operation) -> int:
        operations.append(operation)
        return len(operations) - 1

    def inverse_root(value: int) -> int:
        if value not in roots:
            roots[value] = put(Operation("inverse root", (value,)))
        return roots[value]

    for name, arguments, value in program.operations:
        taken = arguments if name == "input" else tuple(places[number] for number in arguments)
        if name not in ("div", "sqrt") or operations[taken[-1]].name != "sqrt":
            places.append(put(Operation(name, taken, value)))
            continue
        root = inverse_root(operations[taken[-1]].arguments[0])
        if name == "sqrt":
            places.append(inverse_root(root))
        else:
            one = operations[taken[0]] == ONE
            places.append(root if one else put(Operation("mul", (taken[0], root))))
    outputs = tuple(tuple(places[number] for number in vector) for vector in program.outputs)
    return drop_dead(Program(program.name, program.inputs, tuple(operations), outputs))


def define(lanes: Lanes, program: Program, *, inline: bool = False, exact: bool = False, visible: bool = False) -> str:
    """Define `program` as a function of the module, with one pointer to vectors per input, then one per output.

    All inputs are read before any output is written, so an output may alias an input. `inline` as in `Code.end`; a
    function that is `visible` can be linked. With `exact`, every operation is rounded by itself and in this order, as a
    caller's own arithmetic is.
    """
    code = lanes.function(program.name, len(program.inputs) + len(program.outputs))
    if exact:
        code.flags = ""
    sources, targets = code.arguments[: len(program.inputs)], code.arguments[len(program.inputs) :]
    results = emit(code, program, [partial(code.load, source) for source in sources])
    for target, values in zip(targets, results, strict=True):
        for i, value in enumerate(values):
            code.store(value, target, i)
    return code.end(inline=inline, visible=visible)


def define_routine(
    lanes: Lanes, routine: Routine, slide: int = 0, *, inline: bool = False, visible: bool = False
) -> str:
    """Define `routine` and the programs it calls as functions of the module: one pointer per input, then per output.

    Inputs and outputs must not overlap, but if `slide` > 0 the first output must begin that many vectors before the
    first input: its cells that only move by `slide` are there already, and are not copied. `inline` and
    `visible` as in `define`; programs that are called once are inlined.
    """
    calls = Counter(call.program for call in routine.calls)
    called = [define(lanes, program, inline=calls[i] == 1) for i, program in enumerate(routine.programs)]
    code = lanes.function(routine.name, len(routine.inputs) + len(routine.outputs))
    given, targets = code.arguments, code.arguments[len(routine.inputs) :]
    memories = [code.reserve(length) for length in routine.memories]

    def load(cell: Cell) -> str:
        if cell.memory == "constant":
            return lanes.constant(cell.value)
        return code.load(given[cell.number] if cell.memory == "input" else memories[cell.number], cell.place)

    def vector(cells: Sequence[Cell]) -> str:
        """Address of the vector with these cells: in place if contiguous, otherwise a gathered copy."""
        found = stretches(cells)
        if len(found) == 1 and found[0][0].memory != "constant":
            first = found[0][0]
            base = given[first.number] if first.memory == "input" else memories[first.number]
            return code.vector_at(base, first.place)
        gathered = code.reserve(len(cells))
        for i, cell in enumerate(cells):
            code.store(load(cell), gathered, i)
        return gathered

    for call in routine.calls:
        arguments = [vector(cells) for cells in call.inputs]
        code.call(called[call.program], *arguments, *(memories[number] for number in call.outputs))
    cells = [(number, i, cell) for number, output in enumerate(routine.outputs) for i, cell in enumerate(output)]
    if slide:
        cells = [entry for entry in cells if entry != (0, entry[1], Cell("input", 0, entry[1] - slide))]
    # Values from the first input are read before the first output is written over it.
    early = {(number, i): load(cell) for number, i, cell in cells if slide and cell[:2] == ("input", 0)}
    for number, i, cell in cells:
        code.store(early.get((number, i)) or load(cell), targets[number], i)
    return code.end(inline=inline, visible=visible)
