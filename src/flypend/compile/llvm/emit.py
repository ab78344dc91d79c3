"""Scalar programs as LLVM functions on vectors of lanes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from functools import partial

from llvmlite import ir

from flypend.compile.llvm.vector import Code, Lanes, Value
from flypend.compile.program import LIBRARY, LIBRARY_2, Operation, Program, drop_dead, interpret
from flypend.compile.routine import Cell, Routine, stretches

ELEMENTARY = ("logarithm", "sine", "cosine", "inverse_root")  # functions of compile/loops/elementary.cpp


def emit(code: Code, program: Program, inputs: Sequence[Callable[[int], Value]]) -> list[list[Value]]:
    """Emit `program`, where entry i of input vector j is `inputs[j](i)`; return the values of each output vector."""
    operations = {name: partial(operation, code) for name, operation in _OPERATIONS.items()}
    chosen = with_inverse_roots(program) if code.lanes.estimates_roots else program
    return interpret(chosen, inputs, operations, code.value)


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
            one = operations[taken[0]] == Operation("constant", (), 1.0)
            places.append(root if one else put(Operation("mul", (taken[0], root))))
    outputs = tuple(tuple(places[number] for number in vector) for vector in program.outputs)
    return drop_dead(Program(program.name, program.inputs, tuple(operations), outputs))


def _true(value: Value) -> Value:
    return value.compare("!=", 0.0)


def _compare(sign: str) -> Callable[[Code, Value, Value], Value]:
    return lambda code, a, b: code.select(a.compare(sign, b), 1.0, 0.0)


def _elementary(name: str) -> Callable[[Code, Value], Value]:
    return lambda code, value: code.elementary(name, value)


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
    "inverse root": _elementary("inverse_root"),
    "fabs": Code.fabs,
    "sign": lambda code, a: code.select(a > 0.0, 1.0, code.select(a < 0.0, -1.0, 0.0)),
    "select": lambda code, condition, a: code.select(_true(condition), a, 0.0),
    "not": lambda code, a: code.select(a.compare("==", 0.0), 1.0, 0.0),
    "and": lambda code, a, b: code.select(_true(a) & _true(b), 1.0, 0.0),
    "or": lambda code, a, b: code.select(_true(a) | _true(b), 1.0, 0.0),
    **{name: _compare(sign) for name, sign in (("lt", "<"), ("le", "<="), ("eq", "=="), ("ne", "!="))},
    **{name: _of_library(name) for name in (*LIBRARY, *LIBRARY_2)},
    "floor": Code.floor,
    "log": _elementary("logarithm"),
    "sin": _elementary("sine"),
    "cos": _elementary("cosine"),
}


def define(lanes: Lanes, program: Program, *, inline: bool = False, exact: bool = False) -> ir.Function:
    """Define `program` as a function of the module, with one pointer to vectors per input, then one per output.

    All inputs are read before any output is written, so an output may alias an input. `inline` as in `Lanes.function`.
    With `exact`, every operation is rounded by itself and in this order, as a caller's own arithmetic is.
    """
    function, code = lanes.function(program.name, len(program.inputs) + len(program.outputs), inline=inline)
    if exact:
        code.flags = ()
    sources, targets = function.args[: len(program.inputs)], function.args[len(program.inputs) :]
    results = emit(code, program, [partial(code.load, source) for source in sources])
    for target, values in zip(targets, results, strict=True):
        for i, value in enumerate(values):
            code.store(value, target, i)
    code.builder.ret_void()
    return function


def define_routine(lanes: Lanes, routine: Routine, slide: int = 0, *, inline: bool = False) -> ir.Function:
    """Define `routine` and the programs it calls as functions of the module: one pointer per input, then per output.

    Inputs and outputs must not overlap, but if `slide` > 0 the first output must begin that many vectors before the
    first input: its cells that only move by `slide` are there already, and are not copied. `inline` as in
    `Lanes.function`; programs that are called once are inlined.
    """
    calls = Counter(call.program for call in routine.calls)
    called = [define(lanes, program, inline=calls[i] == 1) for i, program in enumerate(routine.programs)]
    function, code = lanes.function(routine.name, len(routine.inputs) + len(routine.outputs), inline=inline)
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
    cells = [(number, i, cell) for number, output in enumerate(routine.outputs) for i, cell in enumerate(output)]
    if slide:
        cells = [entry for entry in cells if entry != (0, entry[1], Cell("input", 0, entry[1] - slide))]
    # Values from the first input are read before the first output is written over it.
    early = {(number, i): load(cell) for number, i, cell in cells if slide and cell[:2] == ("input", 0)}
    for number, i, cell in cells:
        code.store(early.get((number, i)) or load(cell), targets[number], i)
    code.builder.ret_void()
    return function
