"""Scalar programs as LLVM functions on vectors of lanes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from llvmlite import ir

from flypend.compile.llvm.vector import Code, Lanes, Value
from flypend.compile.program import LIBRARY, LIBRARY_2, Program, interpret
from flypend.compile.routine import Cell, Routine, stretches


def emit(code: Code, program: Program, inputs: Sequence[Callable[[int], Value]]) -> list[list[Value]]:
    """Emit `program`, where entry i of input vector j is `inputs[j](i)`; return the values of each output vector."""
    operations = {name: partial(operation, code) for name, operation in _OPERATIONS.items()}
    return interpret(program, inputs, operations, code.value)


def _true(value: Value) -> Value:
    return value.compare("!=", 0.0)


def _compared(sign: str) -> Callable[[Code, Value, Value], Value]:
    return lambda code, a, b: code.select(a.compare(sign, b), 1.0, 0.0)


def _of_library(name: str) -> Callable[..., Value]:
    return lambda code, *values: code.library(name, *values)


_OPERATIONS: dict[str, Callable[..., Value]] = {
    "add": lambda _, a, b: a + b,
    "sub": lambda _, a, b: a - b,
    "mul": lambda _, a, b: a * b,
    "div": lambda _, a, b: a / b,
    "neg": lambda _, a: -a,
    "fmin": Code.least,
    "fmax": Code.most,
    "sqrt": Code.sqrt,
    "fabs": Code.fabs,
    "sign": lambda code, a: code.select(a > 0.0, 1.0, code.select(a < 0.0, -1.0, 0.0)),
    "select": lambda code, condition, a: code.select(_true(condition), a, 0.0),
    "not": lambda code, a: code.select(a.compare("==", 0.0), 1.0, 0.0),
    "and": lambda code, a, b: code.select(_true(a) & _true(b), 1.0, 0.0),
    "or": lambda code, a, b: code.select(_true(a) | _true(b), 1.0, 0.0),
    **{name: _compared(sign) for name, sign in (("lt", "<"), ("le", "<="), ("eq", "=="), ("ne", "!="))},
    **{name: _of_library(name) for name in (*LIBRARY, *LIBRARY_2)},
}


def define(lanes: Lanes, program: Program) -> ir.Function:
    """Define `program` as a function of the module, with one pointer to vectors per input, then one per output.

    All inputs are read before any output is written, so an output may alias an input.
    """
    function, code = lanes.function(program.name, len(program.inputs) + len(program.outputs))
    sources, targets = function.args[: len(program.inputs)], function.args[len(program.inputs) :]
    results = emit(code, program, [partial(code.load, source) for source in sources])
    for target, values in zip(targets, results, strict=True):
        for i, value in enumerate(values):
            code.store(value, target, i)
    code.builder.ret_void()
    return function


def define_routine(lanes: Lanes, routine: Routine) -> ir.Function:
    """Define `routine` and the programs it calls as functions of the module: one pointer per input, then per output.

    Inputs and outputs must not overlap.
    """
    called = [define(lanes, program) for program in routine.programs]
    function, code = lanes.function(routine.name, len(routine.inputs) + len(routine.outputs))
    targets = function.args[len(routine.inputs) :]
    memories = [code.reserve(length) for length in routine.memories]

    def load(cell: Cell) -> Value:
        if cell.memory == "constant":
            return code.value(cell.value)
        return code.load(function.args[cell.number] if cell.memory == "input" else memories[cell.number], cell.place)

    def vector(cells: Sequence[Cell]) -> ir.Value:
        """Address of the vector with these cells: in place if contiguous, otherwise a gathered copy."""
        found = stretches(cells)
        if len(found) == 1 and found[0][0].memory != "constant":
            first = found[0][0]
            base = function.args[first.number] if first.memory == "input" else memories[first.number]
            return code.vector_at(base, first.place)
        gathered = code.reserve(len(cells))
        for i, cell in enumerate(cells):
            code.store(load(cell), gathered, i)
        return gathered

    for call in routine.calls:
        arguments = [vector(cells) for cells in call.inputs]
        code.call(called[call.program], *arguments, *(memories[number] for number in call.outputs))
    for target, cells in zip(targets, routine.outputs, strict=True):
        for i, cell in enumerate(cells):
            code.store(load(cell), target, i)
    code.builder.ret_void()
    return function
