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
    "fabs": "({0} < {zero}) ? -{0} : {0}", "fmin": "({0} < {1}) ? {0} : {1}", "fmax": "({0} > {1}) ? {0} : {1}",
    "lt": "({0} < {1}) ? {one} : {zero}", "le": "({0} <= {1}) ? {one} : {zero}",
    "eq": "({0} == {1}) ? {one} : {zero}", "ne": "({0} != {1}) ? {one} : {zero}",
    "not": "({0} == {zero}) ? {one} : {zero}", "select": "({0} != {zero}) ? {1} : {zero}",
    "and": "(({0} != {zero}) && ({1} != {zero})) ? {one} : {zero}",
    "or": "(({0} != {zero}) || ({1} != {zero})) ? {one} : {zero}",
    "sign": "({0} > {zero}) ? {one} : (({0} < {zero}) ? -{one} : {zero})",
}  # fmt: skip


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
    root = "sqrt" if precision == "double" else "sqrtf"
    names: dict[int, str] = {}
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
            names[number] = f"v{len(lines)}"
            form = f"{root}({{0}})" if operation.name == "sqrt" else _form(operation)
            value = form.format(*(names[a] for a in operation.arguments), **words)
            lines.append(f"const {REAL} {names[number]} = {value};")
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
    if operation.name not in _FORMS:
        raise InputError("law", "no function of the C library but the square root", operation.name)
    return _FORMS[operation.name]


def _constant(value: float, precision: Precision) -> str:
    """The C text of a constant of a program: a literal, or the name that <math.h> has for one without."""
    if np.isnan(value):
        return "NAN"
    if np.isinf(value):
        return "INFINITY" if value > 0 else "-INFINITY"
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
