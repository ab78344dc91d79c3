"""Scalar programs as LLVM functions on vectors of lanes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from llvmlite import ir

from flypend.compile.llvm.vector import Code, Lanes, Value
from flypend.compile.program import LIBRARY, LIBRARY_2, Program, interpret


def emit(code: Code, program: Program, inputs: Sequence[Callable[[int], Value]]) -> list[list[Value]]:
    """Emit `program`, entry i of input vector j being `inputs[j](i)`; the values of each output vector."""
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
    """`program` as a function of the module: one pointer to vectors per input, then one per output.

    All inputs are read before any output is written, so that an output may take the place of an input.
    """
    function, code = lanes.function(program.name, len(program.inputs) + len(program.outputs))
    sources, targets = function.args[: len(program.inputs)], function.args[len(program.inputs) :]
    results = emit(code, program, [partial(code.load, source) for source in sources])
    for target, values in zip(targets, results, strict=True):
        for i, value in enumerate(values):
            code.store(value, target, i)
    code.builder.ret_void()
    return function
