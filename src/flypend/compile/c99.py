"""A scalar program as C99: one constant per value, square roots from the C library and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from flypend.compile.program import Operation, Program
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
    What is selected is computed in any case: no branch decides how long a call takes.

    Raises InputError for an operation that needs more of the C library than the square root.
    """
    words = {"zero": literal(0.0, precision), "one": literal(1.0, precision)}
    root = "sqrt" if precision == "double" else "sqrtf"
    names: dict[int, str] = {}
    lines: list[str] = []
    for number, operation in enumerate(program.operations):
        if operation.name == "input":
            names[number] = inputs[operation.arguments[0]][operation.arguments[1]]
        elif operation.name == "constant":
            text = literal(operation.value, precision)
            names[number] = f"({text})" if text.startswith("-") else text
        else:
            names[number] = f"v{len(lines)}"
            form = f"{root}({{0}})" if operation.name == "sqrt" else _form(operation)
            value = form.format(*(names[a] for a in operation.arguments), **words)
            lines.append(f"const {REAL} {names[number]} = {value};")
    for wanted, numbers in zip(outputs, program.outputs, strict=True):
        lines += [f"{place} = {names[number]};" for place, number in zip(wanted, numbers, strict=True)]
    return lines


def _form(operation: Operation) -> str:
    if operation.name not in _FORMS:
        raise InputError("law", "no function of the C library but the square root", operation.name)
    return _FORMS[operation.name]
