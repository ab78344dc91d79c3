"""Scalar programs and routines as C99: one constant per value, square roots from the C library and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from flypend.compile.program import Operation, Program
from flypend.compile.routine import Call, Cell, Routine, stretches
from flypend.compile.scratch import SPAN, Matrix, scratch
from flypend.errors import InputError, one_of

Precision = Literal["double", "float"]
PRECISIONS: tuple[Precision, ...] = ("double", "float")
REAL = "flypend_real"

_FORMS = {
    "add": "{0} + {1}", "sub": "{0} - {1}", "mul": "{0} * {1}", "div": "{0} / {1}", "neg": "-{0}",
    "sqrt": "{root}({0})",
    "fabs": "({0} < {zero}) ? -{0} : {0}", "fmin": "({0} < {1}) ? {0} : {1}", "fmax": "({0} > {1}) ? {0} : {1}",
    "select": "{0} ? {1} : {zero}", "sign": "({0} > {zero}) ? {one} : (({0} < {zero}) ? -{one} : {zero})",
}  # fmt: skip
# Those whose value is true or false: an int in C. Equality is a pair of inequalities, which is the same for every pair
# of numbers, NaN included, and shows a reader, and -Wfloat-equal, that no rounded number is compared by accident.
_TRUTHS = {
    "lt": "{0} < {1}", "le": "{0} <= {1}", "eq": "({0} <= {1}) && ({0} >= {1})",
    "ne": "!(({0} <= {1}) && ({0} >= {1}))", "not": "!{0}", "and": "{0} && {1}", "or": "{0} || {1}",
}  # fmt: skip
# The arguments of which an operation asks whether they are true: a number is, unless it is 0.
_ASKS = {"not": (0,), "and": (0, 1), "or": (0, 1), "select": (0,)}


def define_real(precision: Precision) -> str:
    """Return the C text that defines `REAL`, once for several headers, which must be of one precision."""
    size = 8 if precision == "double" else 4
    return f"""#ifndef FLYPEND_REAL
#define FLYPEND_REAL {size}
typedef {precision} {REAL};
#elif FLYPEND_REAL != {size}
#error "these headers of flypend were exported in different precisions"
#endif"""


def literal(value: float, precision: Precision) -> str:
    """The shortest C literal that is `value` in `precision`. Raises InputError for one that precision cannot hold."""
    if one_of("precision", precision, PRECISIONS) == "double" and np.isfinite(value):
        return repr(float(value))
    with np.errstate(over="ignore", under="ignore"):
        single = np.float32(value)
    if not np.isfinite(single) or (single == 0) != (value == 0):
        raise InputError("precision", "finite numbers that it can hold", f"{value:g}")
    return f"{single!s}f"


# Inlined into one function, programs would each have their part of its stack.
_APART = "#ifdef __GNUC__\n__attribute__((noinline))\n#endif\n"
SCRATCH = "w"  # the C array of values that are read again later


class _Statements:
    """The C statements of a program, in `lines`, in the order of its operations."""

    def __init__(self, program: Program, inputs: Sequence[Sequence[str]], precision: Precision) -> None:
        self.program, self.inputs, self.precision = program, inputs, precision
        self.scratch, self.lines = scratch(program), list[str]()
        self._known: dict[int, tuple[str, int]] = {}  # C expressions of numbers, and where they were read or computed
        self._truths: dict[int, str] = {}  # and of truths
        root = "sqrt" if precision == "double" else "sqrtf"
        self._words = {"zero": literal(0.0, precision), "one": literal(1.0, precision), "root": root}

    def write(self) -> None:
        first = {matrix.rows[0]: place for place, matrix in enumerate(self.scratch.matrices)}
        for number, operation in enumerate(self.program.operations):
            if number in first:
                self._multiply(number, first[number])
            elif number not in self.scratch.inner and operation.name not in ("input", "constant"):
                self._compute(number, operation)

    def result(self, number: int) -> str:
        """The C expression of a number after all statements.

        No new constant: of inputs that are results as they came, hundreds would be on the stack at once.
        """
        operation, at = self.program.operations[number], len(self.program.operations)
        if operation.name == "constant" or self._is_near(number, at):
            return self._number(number, at)
        if operation.name == "input":
            return self.inputs[operation.arguments[0]][operation.arguments[1]]
        return f"{SCRATCH}[{self.scratch.places[number]}]"

    def _is_near(self, number: int, at: int) -> bool:
        return number in self._known and (number in self._truths or at - self._known[number][1] <= SPAN)

    def _number(self, number: int, at: int) -> str:
        """The C expression of a number in statement `at`."""
        operation = self.program.operations[number]
        if operation.name == "constant":
            text = _constant(operation.value, self.precision)
            return f"({text})" if text.startswith("-") else text
        if not self._is_near(number, at):
            if operation.name == "input":
                name = self._define_constant(REAL, self.inputs[operation.arguments[0]][operation.arguments[1]])
            else:
                name = self._define_constant(REAL, f"{SCRATCH}[{self.scratch.places[number]}]")
            self._known[number] = (name, at)
        return self._known[number][0]

    def _truth(self, number: int, at: int) -> str:
        """The C expression of whether a number is not 0."""
        known = self._truths.get(number)
        return known or f"({_TRUTHS['ne'].format(self._number(number, at), self._words['zero'])})"

    def _define_constant(self, kind: str, text: str) -> str:
        """The name of a new constant."""
        self.lines.append(f"const {kind} v{len(self.lines)} = {text};")
        return f"v{len(self.lines) - 1}"

    def _compute(self, number: int, operation: Operation) -> None:
        asked = _ASKS.get(operation.name, ())
        taken = [(self._truth if i in asked else self._number)(a, number) for i, a in enumerate(operation.arguments)]
        form = _FORMS.get(operation.name) or _TRUTHS.get(operation.name)
        if form is None:
            raise InputError("law", "no function of the C library but the square root", operation.name)
        text = form.format(*taken, **self._words)
        if operation.name in _TRUTHS:
            truth = self._truths[number] = self._define_constant("int", text)
            name = f"({truth} ? {self._words['one']} : {self._words['zero']})"
        else:
            name = self._define_constant(REAL, text)
        self._known[number] = (name, number)
        if number in self.scratch.places:
            self.lines.append(f"{SCRATCH}[{self.scratch.places[number]}] = {name};")

    def _multiply(self, number: int, place: int) -> None:
        """Call the function of the layer at `place`."""
        begin, columns = self.scratch.vectors[place], self.scratch.matrices[place].columns
        for i, column in enumerate(columns):
            text = self._number(column, number)
            self.lines.append(f"{SCRATCH}[{begin + i}] = {text};")
        own = f"{self.program.name}_{place}"
        self.lines.append(f"{own}({SCRATCH} + {begin}, {SCRATCH} + {begin + len(columns)});")


def statements(
    program: Program, inputs: Sequence[Sequence[str]], outputs: Sequence[Sequence[str]], precision: Precision
) -> list[str]:
    """C statements that compute `program`: `inputs[i][j]` is the C expression of entry j of input vector i.

    `outputs[i][j]` receives entry j of output i, after everything has been computed; results that are inputs as they
    came are copied first, in order (`copies`). What is needed later is kept in the array `SCRATCH` of
    `scratch(program).size` numbers. That and the inputs should be volatile, or a compiler keeps copies on the stack.
    Products with constant matrices are calls of the functions of `layers`. What is selected is computed in any case: no
    branch decides how long a call takes.

    Raises InputError for an operation that needs more of the C library than the square root.
    """
    writer = _Statements(program, inputs, precision)
    writer.write()
    first = {to for to, _ in copies(program)}
    places = [(i, j) for i, numbers in enumerate(program.outputs) for j in range(len(numbers))]
    places.sort(key=lambda place: place not in first)  # stable
    return writer.lines + [f"{outputs[i][j]} = {writer.result(program.outputs[i][j])};" for i, j in places]


def copies(program: Program) -> list[tuple[tuple[int, int], tuple[int, ...]]]:
    """Places (output, entry) that receive what stands at places (input, entry), in order."""
    return [
        ((i, j), program.operations[number].arguments)
        for i, numbers in enumerate(program.outputs)
        for j, number in enumerate(numbers)
        if program.operations[number].name == "input"
    ]


def layers(program: Program, precision: Precision) -> list[str]:
    """C functions of the products with constant matrices in `program`, each with its table, in order."""
    found = enumerate(scratch(program).matrices)
    return [_layer(matrix, f"{program.name}_{place}", precision) for place, matrix in found]


def _layer(matrix: Matrix, name: str, precision: Precision) -> str:
    """The C function (in, out) of a `matrix`, which sums in the order of its columns."""
    rows, columns = len(matrix.rows), len(matrix.columns)
    weights = [f"    {{{', '.join(literal(w, precision) for w in row)}}}," for row in matrix.weights]
    body = [
        f"static const {REAL} table[{rows}][{columns}] = {{", *weights, "};",
        f"for (int i = 0; i < {rows}; i++) {{",
        f"    {REAL} sum = table[i][0] * in[0];",
        f"    for (int j = 1; j < {columns}; j++) {{",
        "        sum += table[i][j] * in[j];",
        "    }",
        "    out[i] = sum;",
        "}",
    ]  # fmt: skip
    return _define(name, [f"const volatile {REAL} *in", f"volatile {REAL} *out"], body)


def _constant(value: float, precision: Precision) -> str:
    """The C text of a constant of a program: a literal, or the name that <math.h> has for one without."""
    if np.isnan(value):
        return f"({REAL})NAN"  # a float in <math.h>
    if np.isinf(value):
        return f"({REAL})INFINITY" if value > 0 else f"-({REAL})INFINITY"
    return literal(value, precision)


def reads(program: Program, vector: int) -> set[int]:
    """The entries of input `vector` that `program` reads."""
    return {op.arguments[1] for op in program.operations if op.name == "input" and op.arguments[0] == vector}


def function(program: Program, precision: Precision) -> str:
    """`program` as a static C function, after its `layers`, of pointers: scratch memory, inputs that it reads, outputs.

    Inputs that are computed with are read before any output is written, so that an output may take the place of an
    input; `call` refuses the rest. A program that needs no scratch memory takes none.
    """
    taken = [vector for vector in range(len(program.inputs)) if reads(program, vector)]
    inputs = [[f"in{i}[{k}]" for k in range(length)] for i, length in enumerate(program.inputs)]
    outputs = [[f"out{i}[{k}]" for k in range(len(numbers))] for i, numbers in enumerate(program.outputs)]
    given = [f"volatile {REAL} *{SCRATCH}"] * bool(scratch(program).size)
    given += [f"const volatile {REAL} *in{i}" for i in taken]
    wanted = [f"volatile {REAL} *out{i}" for i, numbers in enumerate(program.outputs) if numbers]
    whole = _define(program.name, [*given, *wanted], statements(program, inputs, outputs, precision))
    return "\n\n".join([*layers(program, precision), f"{_APART}{whole}"])


def call(program: Program, inputs: Sequence[str], outputs: Sequence[str], memory: str = SCRATCH) -> str:
    """The call of what `function` writes, with C expressions of pointers for all vectors and for scratch `memory`.

    Raises ValueError where an output takes the place of an input of which an entry is copied after it was overwritten.
    """
    written = set[tuple[str, int]]()
    for (i, j), (vector, entry) in copies(program):
        if (inputs[vector], entry) in written:
            raise ValueError(f"{program.name} copies {inputs[vector]}[{entry}], which it has overwritten")
        written.add((outputs[i], j))
    taken = [text for vector, text in enumerate(inputs) if reads(program, vector)]
    given = [text for text, numbers in zip(outputs, program.outputs, strict=True) if numbers]
    return f"{program.name}({', '.join([*[memory] * bool(scratch(program).size), *taken, *given])});"


def inputs_used_by(routine: Routine) -> list[int]:
    """The input vectors of `routine` that it reads."""
    cells = [cell for vector in routine.outputs for cell in vector]
    for step in routine.calls:
        program = routine.programs[step.program]
        cells += [cell for vector, taken in enumerate(step.inputs) if reads(program, vector) for cell in taken]
    return sorted({cell.number for cell in cells if cell.memory == "input"})


def routine_scratch(routine: Routine) -> int:
    """How many numbers of scratch memory the function of `routine` takes."""
    gathered = [sum(len(cells) for cells in _inputs_to_gather(routine, step).values()) for step in routine.calls]
    return (
        sum(routine.memories)
        + max(gathered, default=0)
        + max((scratch(program).size for program in routine.programs), default=0)
    )


def routine_function(routine: Routine, precision: Precision) -> str:
    """`routine` as a static C function of pointers: scratch memory, the input vectors that it reads, its outputs.

    The functions of its programs must stand before it. Inputs, outputs and scratch memory must not overlap.
    """
    given = [f"volatile {REAL} *{SCRATCH}", *(f"const volatile {REAL} *in{i}" for i in inputs_used_by(routine))]
    wanted = [f"volatile {REAL} *out{i}" for i, cells in enumerate(routine.outputs) if cells]
    lines = [line for step in routine.calls for line in _call_lines(routine, step, precision)]
    for i, cells in enumerate(routine.outputs):
        lines += [f"out{i}[{k}] = {_cell(routine, cell, precision)};" for k, cell in enumerate(cells)]
    return _define(routine.name, [*given, *wanted], lines)


def _inputs_to_gather(routine: Routine, step: Call) -> dict[int, Sequence[Cell]]:
    """The input vectors of one call that do not lie in one piece: they are put together in scratch memory."""
    program = routine.programs[step.program]
    pieces = {vector: stretches(cells) for vector, cells in enumerate(step.inputs) if reads(program, vector)}
    return {
        vector: step.inputs[vector]
        for vector, found in pieces.items()
        if len(found) != 1 or found[0][0].memory == "constant"
    }


def _call_lines(routine: Routine, step: Call, precision: Precision) -> list[str]:
    """The lines of one call. Scratch memory: buffers, what is put together for the call, and the program's own."""
    program, place, lines = routine.programs[step.program], sum(routine.memories), []
    inputs = ["" if not cells else _place(routine, cells[0]) for cells in step.inputs]
    for vector, cells in _inputs_to_gather(routine, step).items():
        lines += [f"{SCRATCH}[{place + k}] = {_cell(routine, cell, precision)};" for k, cell in enumerate(cells)]
        inputs[vector] = f"{SCRATCH} + {place}"
        place += len(cells)
    outputs = [f"{SCRATCH} + {_start(routine, number)}" for number in step.outputs]
    return [*lines, call(program, inputs, outputs, f"{SCRATCH} + {place}")]


def _start(routine: Routine, number: int) -> int:
    """Where a buffer of `routine` begins in scratch memory."""
    return sum(routine.memories[:number])


def _place(routine: Routine, cell: Cell) -> str:
    if cell.memory == "call":
        return f"{SCRATCH} + {_start(routine, cell.number) + cell.place}"
    return f"in{cell.number} + {cell.place}" if cell.place else f"in{cell.number}"


def _cell(routine: Routine, cell: Cell, precision: Precision) -> str:
    if cell.memory == "constant":
        return literal(cell.value, precision)
    if cell.memory == "call":
        return f"{SCRATCH}[{_start(routine, cell.number) + cell.place}]"
    return f"in{cell.number}[{cell.place}]"


def _define(name: str, parameters: Sequence[str], body: Sequence[str]) -> str:
    return "\n".join([f"static void {name}({', '.join(parameters)})", "{", *(f"    {line}" for line in body), "}"])
