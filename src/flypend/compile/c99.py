"""Scalar programs and routines as C99: one constant per value, square roots from the C library and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from flypend.compile.matrices import Matrix, matrices
from flypend.compile.program import Operation, Program
from flypend.compile.routine import Call, Cell, Routine, stretches
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


def literal(value: float, precision: Precision) -> str:
    """The shortest C literal that is `value` in `precision`. Raises InputError for one that precision cannot hold."""
    if one_of("precision", precision, PRECISIONS) == "double" and np.isfinite(value):
        return repr(float(value))
    with np.errstate(over="ignore", under="ignore"):
        single = np.float32(value)
    if not np.isfinite(single) or (single == 0) != (value == 0):
        raise InputError("precision", "finite numbers that it can hold", f"{value:g}")
    return f"{single!s}f"


def statements(
    program: Program, inputs: Sequence[Sequence[str]], outputs: Sequence[Sequence[str]], precision: Precision
) -> list[str]:
    """C statements that compute `program`: `inputs[i][j]` is the C expression of entry j of input vector i.

    `outputs[i][j]` receives entry j of output i, after everything has been computed: it may be an input as well.
    Products with constant matrices are calls of the functions of `layers`. What is selected is computed in any case: no
    branch decides how long a call takes.

    Raises InputError for an operation that needs more of the C library than the square root.
    """
    words = {"zero": literal(0.0, precision), "one": literal(1.0, precision)}
    words["root"] = "sqrt" if precision == "double" else "sqrtf"
    names: dict[int, str] = {}  # C expressions of numbers
    truths: dict[int, str] = {}  # and of truths

    def truth(number: int) -> str:
        """Whether a value is not 0, in C."""
        return truths.get(number) or f"({_TRUTHS['ne'].format(names[number], words['zero'])})"

    lines: list[str] = []
    tables = matrices(program)
    first = {matrix.rows[0]: place for place, matrix in enumerate(tables)}
    looped = {number for matrix in tables for number in (*matrix.rows, *matrix.inner)}
    for number, operation in enumerate(program.operations):
        if number in first:
            place = first[number]
            matrix, own = tables[place], f"{program.name}_{place}"
            given = ", ".join(names[column] for column in matrix.columns)
            lines += [f"const {REAL} x{place}[{len(matrix.columns)}] = {{{given}}};"]
            lines += [f"{REAL} y{place}[{len(matrix.rows)}];", f"{own}(x{place}, y{place});"]
            names |= {row: f"y{place}[{i}]" for i, row in enumerate(matrix.rows)}
        elif number in looped:
            continue
        elif operation.name == "input":
            names[number] = inputs[operation.arguments[0]][operation.arguments[1]]
        elif operation.name == "constant":
            text = _constant(operation.value, precision)
            names[number] = f"({text})" if text.startswith("-") else text
        else:
            result, form = f"v{len(lines)}", _form(operation)
            kind, taken = REAL, [names[a] for a in operation.arguments]
            names[number] = result
            if operation.name in _TRUTHS:
                kind, truths[number], names[number] = "int", result, f"({result} ? {words['one']} : {words['zero']})"
            for i in _ASKS.get(operation.name, ()):
                taken[i] = truth(operation.arguments[i])
            lines.append(f"const {kind} {result} = {form.format(*taken, **words)};")
    for wanted, numbers in zip(outputs, program.outputs, strict=True):
        lines += [f"{place} = {names[number]};" for place, number in zip(wanted, numbers, strict=True)]
    return lines


def layers(program: Program, precision: Precision) -> list[str]:
    """C functions of the products with constant matrices in `program`, each with its table, in order."""
    return [_layer(matrix, f"{program.name}_{place}", precision) for place, matrix in enumerate(matrices(program))]


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
    return _defined(name, [f"const {REAL} *in", f"{REAL} *out"], body)


def _form(operation: Operation) -> str:
    form = _FORMS.get(operation.name) or _TRUTHS.get(operation.name)
    if form is None:
        raise InputError("law", "no function of the C library but the square root", operation.name)
    return form


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
    """`program` as a static C function, after its `layers`, of pointers: the inputs that it reads, then its outputs.

    All inputs are read before any output is written, so that an output may take the place of an input.
    """
    taken = [vector for vector in range(len(program.inputs)) if reads(program, vector)]
    inputs = [[f"in{i}[{k}]" for k in range(length)] for i, length in enumerate(program.inputs)]
    outputs = [[f"out{i}[{k}]" for k in range(len(numbers))] for i, numbers in enumerate(program.outputs)]
    given = [f"const {REAL} *in{i}" for i in taken]
    wanted = [f"{REAL} *out{i}" for i, numbers in enumerate(program.outputs) if numbers]
    whole = _defined(program.name, [*given, *wanted], statements(program, inputs, outputs, precision))
    return "\n\n".join([*layers(program, precision), whole])


def call(program: Program, inputs: Sequence[str], outputs: Sequence[str]) -> str:
    """The call of what `function` writes, with C expressions of pointers for all input and output vectors."""
    taken = [text for vector, text in enumerate(inputs) if reads(program, vector)]
    given = [text for text, numbers in zip(outputs, program.outputs, strict=True) if numbers]
    return f"{program.name}({', '.join([*taken, *given])});"


def used_inputs(routine: Routine) -> list[int]:
    """The input vectors of `routine` that it reads."""
    cells = [cell for vector in routine.outputs for cell in vector]
    for step in routine.calls:
        program = routine.programs[step.program]
        cells += [cell for vector, taken in enumerate(step.inputs) if reads(program, vector) for cell in taken]
    return sorted({cell.number for cell in cells if cell.memory == "input"})


def routine_function(routine: Routine, precision: Precision) -> str:
    """`routine` as a static C function of pointers: first the input vectors that it reads, then its outputs.

    The functions of its programs must stand before it. Inputs and outputs must not overlap.
    """
    given = [f"const {REAL} *in{i}" for i in used_inputs(routine)]
    wanted = [f"{REAL} *out{i}" for i, cells in enumerate(routine.outputs) if cells]
    written = sorted({number for step in routine.calls for number in step.outputs if routine.memories[number]})
    lines = [f"{REAL} m{number}[{routine.memories[number]}];" for number in written]
    for step in routine.calls:
        lines += _called(routine, step, precision)
    for i, cells in enumerate(routine.outputs):
        lines += [f"out{i}[{k}] = {_cell(cell, precision)};" for k, cell in enumerate(cells)]
    return _defined(routine.name, [*given, *wanted], lines)


def _called(routine: Routine, step: Call, precision: Precision) -> list[str]:
    """The lines of one call. A vector that does not lie in one piece is put together in a block of its own."""
    program = routine.programs[step.program]
    gathered, inputs = [], []
    for vector, cells in enumerate(step.inputs):
        found = stretches(cells)
        if not reads(program, vector):
            inputs.append("")
        elif len(found) == 1 and found[0][0].memory != "constant":
            inputs.append(_place(found[0][0]))
        else:
            values = ", ".join(_cell(cell, precision) for cell in cells)
            gathered.append(f"const {REAL} g{vector}[{len(cells)}] = {{{values}}};")
            inputs.append(f"g{vector}")
    line = call(program, inputs, [f"m{number}" for number in step.outputs])
    return ["{", *(f"    {text}" for text in (*gathered, line)), "}"] if gathered else [line]


def _place(cell: Cell) -> str:
    base = f"{'in' if cell.memory == 'input' else 'm'}{cell.number}"
    return f"{base} + {cell.place}" if cell.place else base


def _cell(cell: Cell, precision: Precision) -> str:
    if cell.memory == "constant":
        return literal(cell.value, precision)
    return f"{'in' if cell.memory == 'input' else 'm'}{cell.number}[{cell.place}]"


def _defined(name: str, parameters: Sequence[str], body: Sequence[str]) -> str:
    return "\n".join([f"static void {name}({', '.join(parameters)})", "{", *(f"    {line}" for line in body), "}"])
