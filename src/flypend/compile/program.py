"""CasADi functions as scalar programs in static single assignment form, the source of all generated code."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import chain
from typing import Any, NamedTuple

import casadi as ca

from flypend import signals
from flypend.errors import InputError


class Operation(NamedTuple):
    """One operation: its `name`, the indices of its argument values and, for a constant, its `value`."""

    name: str
    arguments: tuple[int, ...] = ()
    value: float = 0.0


ONE = Operation("constant", (), 1.0)


@dataclass(frozen=True)
class Program:
    """Straight-line code on scalars.

    Parameters
    ----------
    name : str
        Name of the function.
    inputs : tuple of int
        Length of each input vector.
    operations : tuple of Operation
        Operation i computes value i from earlier values. The arguments of "input" are (vector, entry).
    outputs : tuple of tuple of int
        Indices of the values of each output vector.
    """

    name: str
    inputs: tuple[int, ...]
    operations: tuple[Operation, ...]
    outputs: tuple[tuple[int, ...], ...]

    def counts(self) -> dict[str, int]:
        """Count the operations of each kind, without inputs and constants, in descending order."""
        names = (operation.name for operation in self.operations)
        return dict(Counter(name for name in names if name not in ("input", "constant")).most_common())

    def uses(self) -> Counter[int]:
        """Count how often operations and outputs read each value."""
        read = (number for operation in self.operations if operation.name != "input" for number in operation.arguments)
        return Counter(chain(read, *self.outputs))


def interpret(
    program: Program,
    inputs: Sequence[Callable[[int], Any]],
    operations: Mapping[str, Callable[..., Any]],
    constant: Callable[[float], Any],
) -> list[list[Any]]:
    """Evaluate `program` on values of any type and return the values of each output vector.

    Entry i of input vector j is `inputs[j](i)`. `operations` maps each operation name to a function; `constant`
    converts a number to a value.
    """
    signals.poll()
    values: list[Any] = []
    for name, arguments, number in program.operations:
        if name == "input":
            values.append(inputs[arguments[0]](arguments[1]))
        elif name == "constant":
            values.append(constant(number))
        else:
            values.append(operations[name](*[values[place] for place in arguments]))
    return [[values[place] for place in vector] for vector in program.outputs]


# Unary functions (and binary ones below) that code generators call from the C library.
LIBRARY: dict[str, Callable[[float], float]] = {
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "asin": math.asin, "acos": math.acos, "atan": math.atan,
    "sinh": math.sinh, "cosh": math.cosh, "tanh": math.tanh, "asinh": math.asinh, "acosh": math.acosh,
    "atanh": math.atanh, "exp": math.exp, "log": math.log, "floor": math.floor, "ceil": math.ceil, "erf": math.erf,
}  # fmt: skip
LIBRARY_2: dict[str, Callable[[float, float], float]] = {
    "pow": math.pow, "atan2": math.atan2, "fmod": math.fmod, "hypot": math.hypot
}  # fmt: skip

FOLD: dict[str, Callable[..., float]] = {
    "add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b,
    "neg": lambda a: -a, "sqrt": math.sqrt, "fabs": math.fabs, "fmin": min, "fmax": max,
    "sign": lambda a: float((a > 0) - (a < 0)), "lt": lambda a, b: float(a < b), "le": lambda a, b: float(a <= b),
    "eq": lambda a, b: float(a == b), "ne": lambda a, b: float(a != b), "not": lambda a: float(a == 0),
    "and": lambda a, b: float(a != 0 and b != 0), "or": lambda a, b: float(a != 0 or b != 0),
    "select": lambda c, a: a if c != 0 else 0.0, **LIBRARY, **LIBRARY_2,
}  # fmt: skip
_COMMUTATIVE = {"add", "mul", "fmin", "fmax", "eq", "ne", "and", "or"}
_CASADI = {getattr(ca, f"OP_{name.upper()}"): name for name in FOLD if name != "select"}
_CASADI |= {ca.OP_IF_ELSE_ZERO: "select", ca.OP_CONSTPOW: "pow"}
# Operations that are nowhere negative, and those that are not if none of their arguments is.
_POSITIVE = {"sqrt", "fabs", "exp", "hypot", "acos", "lt", "le", "eq", "ne", "and", "or", "not"}
_KEEPS_SIGN = {"add", "mul", "div", "fmin"}


def lower(function: ca.Function) -> Program:
    """Lower a CasADi `function` with dense vector inputs and outputs to a scalar program.

    Eliminates common subexpressions and dead code, folds constants, and shares reciprocals between divisions by the
    same value. Raises InputError for an unsupported CasADi operation and ValueError for a sparse output.
    """
    signals.poll()
    expanded = function.expand() if not function.is_a("SXFunction") else function
    for i in range(expanded.n_out()):
        if expanded.nnz_out(i) != expanded.numel_out(i):
            raise ValueError(f"output {i} of {function.name()} is sparse; densify it")
    build = _Builder()
    outputs = _walk(expanded, build)
    inputs = tuple(expanded.nnz_in(i) for i in range(expanded.n_in()))
    return _restore_divisions(drop_dead(Program(function.name(), inputs, tuple(build.operations), outputs)))


def _walk(function: ca.Function, build: _Builder) -> tuple[tuple[int, ...], ...]:
    """Pass every instruction of `function` to `build`; return the value indices of each output."""
    work: dict[int, int] = {}
    outputs = [[0] * function.nnz_out(i) for i in range(function.n_out())]
    for i in range(function.n_instructions()):
        code = function.instruction_id(i)
        taken, given = function.instruction_input(i), function.instruction_output(i)
        if code == ca.OP_INPUT:
            work[given[0]] = build.input(taken[0], taken[1])
        elif code == ca.OP_OUTPUT:
            outputs[given[0]][given[1]] = work[taken[0]]
        elif code == ca.OP_CONST:
            work[given[0]] = build.constant(float(function.instruction_constant(i)))
        else:
            work[given[0]] = build.casadi(code, [work[slot] for slot in taken])
    return tuple(tuple(numbers) for numbers in outputs)


class _Builder:
    """Collects operations; an operation equal to an earlier one reuses its index."""

    def __init__(self) -> None:
        self.operations: list[Operation] = []
        self._known: dict[Any, int] = {}
        self._values: list[float | None] = []  # of constants
        self._positive: list[bool] = []  # whether each is 0 or above, whatever the inputs

    def input(self, vector: int, entry: int) -> int:
        return self._put(Operation("input", (vector, entry)))

    def constant(self, value: float) -> int:
        return self._put(Operation("constant", (), value))

    def casadi(self, code: int, arguments: list[int]) -> int:
        """Add the CasADi operation `code`, expressed in a smaller set of operations; return its index."""
        a = arguments[0]
        if code == ca.OP_ASSIGN:
            return a
        if code == ca.OP_TWICE:
            return self.do("add", a, a)
        if code == ca.OP_SQ:
            return self.do("mul", a, a)
        if code == ca.OP_INV:
            return self.do("div", self.constant(1.0), a)
        if code not in _CASADI:
            raise InputError("law", "operations that can be compiled", f"CasADi operation {code}")
        name = _CASADI[code]
        power = self._values[arguments[1]] if name == "pow" else None
        if power is not None and power.is_integer() and abs(power) <= 16:
            return self._integer_power(a, int(power))
        return self.do(name, *arguments)

    def _integer_power(self, base: int, power: int) -> int:
        if power < 0:
            return self.do("div", self.constant(1.0), self._integer_power(base, -power))
        if power == 0:
            return self.constant(1.0)
        if power == 1:
            return base
        half = self._integer_power(base, power // 2)
        squared = self.do("mul", half, half)
        return self.do("mul", squared, base) if power % 2 else squared

    def do(self, name: str, *arguments: int) -> int:
        """Add the operation `name`, simplified; return its index."""
        values = [self._values[number] for number in arguments]
        if None not in values:
            with suppress(ArithmeticError, ValueError):  # undefined, such as division by zero
                return self.constant(float(FOLD[name](*values)))
        if (simple := self._simplify(name, arguments, values)) is not None:
            return simple
        if name == "div":
            return self._quotient(*arguments)
        return self._put(Operation(name, tuple(sorted(arguments)) if name in _COMMUTATIVE else arguments))

    def _quotient(self, a: int, b: int) -> int:
        """a/b as a product with a reciprocal that can be shared (`_restore_divisions`), without dividing if possible.

        CasADi differentiates √u to u̇/(√u + √u), and min and max to shares (p ≤ q)/((p ≤ q) + (q ≤ p)).
        """
        first, divisor = self.operations[a], self.operations[b]
        if divisor.name == "add" and divisor.arguments[0] == divisor.arguments[1]:
            return self._quotient(self.do("mul", self.constant(0.5), a), divisor.arguments[0])
        if first.name == "le" and divisor.name == "add" and a in divisor.arguments:
            other = sum(divisor.arguments) - a
            if self.operations[other] == Operation("le", first.arguments[::-1]):
                share = self.do("add", self.constant(1.0), self.do("sub", a, other))
                return self.do("mul", self.constant(0.5), share)
        reciprocal = self._reciprocal(b)
        return reciprocal if self._values[a] == 1.0 else self.do("mul", a, reciprocal)

    def _reciprocal(self, number: int) -> int:
        """1/x; the square of 1/√x if √x is known, and x nowhere negative: else a branch without √x would lose 1/x."""
        root = self._known.get(("sqrt", (number,), (0.0).hex()))
        if root is not None and self._positive[number]:
            inverse = self._reciprocal(root)
            return self.do("mul", inverse, inverse)
        return self._put(Operation("div", (self.constant(1.0), number)))

    def _simplify(self, name: str, arguments: tuple[int, ...], values: list[float | None]) -> int | None:
        """Apply identities (x + 0, x · 0, x + (−y) = x − y, …); None if nothing simplifies."""
        a, b = arguments[0], arguments[-1]
        first, second = values[0], values[-1]
        if name == "add":
            return self._sum(a, b, first, second)
        if name == "sub":
            return self._difference(a, b, first, second)
        if name == "mul":
            return self._product(a, b, first, second)
        if name == "div" and second is not None and second != 0.0:
            return self.do("mul", a, self.constant(1.0 / second))
        return self._negate(a) if name == "neg" else None

    def _sum(self, a: int, b: int, first: float | None, second: float | None) -> int | None:
        """Return what is shorter than a + b, of values `first` and `second` if constant; None if nothing is."""
        if 0.0 in (first, second):
            return b if first == 0.0 else a
        for one, other in ((a, b), (b, a)):
            if (inner := self._negate(other)) is not None:
                return self.do("sub", one, inner)
        return None

    def _difference(self, a: int, b: int, first: float | None, second: float | None) -> int | None:
        """As `_sum`, for a − b."""
        if second == 0.0:
            return a
        if first == 0.0:
            return self.do("neg", b)
        return None if (inner := self._negate(b)) is None else self.do("add", a, inner)

    def _product(self, a: int, b: int, first: float | None, second: float | None) -> int | None:
        """As `_sum`, for a b."""
        for other, value in ((b, first), (a, second)):
            if value == 0.0:
                return self.constant(0.0)
            if value == 1.0:
                return other
            if value == -1.0:
                return self.do("neg", other)
            if value is not None and (folded := self._multiple(value, other)) is not None:
                return folded
        return None

    def _multiple(self, factor: float, number: int) -> int | None:
        """c₁ (c₂ x) as (c₁ c₂) x; None if the value at `number` is no multiple by a constant."""
        operation = self.operations[number]
        if operation.name == "mul":
            for inner, x in (operation.arguments, operation.arguments[::-1]):
                known = self._values[inner]
                if known is not None and math.isfinite(factor * known) and factor * known != 0.0:
                    return self.do("mul", self.constant(factor * known), x)
        return None

    def _negate(self, number: int) -> int | None:
        operation = self.operations[number]
        return operation.arguments[0] if operation.name == "neg" else None

    def _put(self, operation: Operation) -> int:
        known = (operation.name, operation.arguments, operation.value.hex())
        if known not in self._known:
            self._known[known] = len(self.operations)
            self.operations.append(operation)
            self._values.append(operation.value if operation.name == "constant" else None)
            self._positive.append(self._is_positive(*operation))
        return self._known[known]

    def _is_positive(self, name: str, arguments: tuple[int, ...], value: float) -> bool:
        if name in ("input", "constant"):
            return name == "constant" and value >= 0.0
        signs = [self._positive[number] for number in arguments]
        if name in ("fmax", "select"):
            return any(signs) if name == "fmax" else signs[1]
        squared = name == "mul" and arguments[0] == arguments[1]
        return name in _POSITIVE or squared or (name in _KEEPS_SIGN and all(signs))


def drop_dead(program: Program) -> Program:
    """Remove the operations of `program` that no output depends on (dead code)."""
    used = {number for vector in program.outputs for number in vector}
    for number in range(len(program.operations) - 1, -1, -1):
        name, arguments, _ = program.operations[number]
        if number in used and name != "input":
            used.update(arguments)
    kept = sorted(used)
    renamed = {number: place for place, number in enumerate(kept)}
    operations = tuple(
        # As lists and without _replace: this is a tenth of the time that a kernel takes to be written.
        Operation(name, arguments if name == "input" else tuple([renamed[number] for number in arguments]), value)
        for name, arguments, value in map(program.operations.__getitem__, kept)
    )
    outputs = tuple(tuple(renamed[number] for number in vector) for vector in program.outputs)
    return Program(program.name, program.inputs, operations, outputs)


def _restore_divisions(program: Program) -> Program:
    """Turn products with a reciprocal that has no other use back into divisions."""
    operations = list(program.operations)
    uses = program.uses()
    for place, operation in enumerate(operations):
        if operation.name == "mul":
            for numerator, reciprocal in (operation.arguments, operation.arguments[::-1]):
                inverse = operations[reciprocal]
                if inverse.name == "div" and uses[reciprocal] == 1 and operations[inverse.arguments[0]] == ONE:
                    operations[place] = Operation("div", (numerator, inverse.arguments[1]))
                    break
    return drop_dead(Program(program.name, program.inputs, tuple(operations), program.outputs))
