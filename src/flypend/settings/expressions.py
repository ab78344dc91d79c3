"""Expressions in which run files and commands write constraints and costs of one's own: `norm(x) < 1, y[2] > 0`.

Nothing but arithmetic is evaluated, so that a file from elsewhere cannot do anything else.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import casadi as ca

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import cross, dot
from flypend.planning.constraints import Motion, try_rotors

EXPECTED = "an expression such as 0.6 - x[2], file.py:function or module:function"
SYNTAX = "numbers, x, x_dot, R, omega, y, y_dot, rotor_forces, their entries, [vectors], + - * / **, < > and functions"
TINY = 1e-12  # with which a norm has a derivative at 0, where hover is
OPERATORS: Mapping[type, Callable[..., Any]] = MappingProxyType(
    {
        ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
        ast.Pow: operator.pow, ast.USub: operator.neg, ast.UAdd: operator.pos,
    }
)  # fmt: skip
FUNCTIONS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {
        "sqrt": ca.sqrt, "exp": ca.exp, "log": ca.log, "sin": ca.sin, "cos": ca.cos, "tan": ca.tan, "atan2": ca.atan2,
        "abs": ca.fabs, "min": ca.fmin, "max": ca.fmax, "dot": dot, "cross": cross,
        "norm": lambda a: ca.sqrt(ca.sumsqr(a) + TINY),
    }
)  # fmt: skip


@dataclass(frozen=True)
class Expression:
    """The expression `text` as a function of a `Motion`, the fields of which are its names.

    Several, with commas between them, are as many values. A comparison is what has to be ≥ 0 for it to hold. Indices
    count from 0. Messages begin with `key`; if not `compares`, there are no comparisons. Raises InputError if it is no
    expression, or one that cannot be evaluated.
    """

    text: str
    key: str
    compares: bool

    def __post_init__(self) -> None:
        x, y, omega = (ca.SX.sym(name, 3) for name in ("x", "y", "omega"))
        try_rotors(lambda rotors: self(Motion(x, x, ca.SX.sym("R", 3, 3), omega, y, y, ca.SX.sym("f", rotors))))

    def __call__(self, motion: Motion) -> list[Any]:
        """Return the values for a `motion`."""
        try:
            tree = ast.parse(self.text.strip(), mode="eval").body
            several = tree.elts if isinstance(tree, ast.Tuple) else [tree]
            return [value for each in several for value in self._comparisons(each, motion._asdict())]
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(self.key, EXPECTED, repr(self.text[:60])) from None

    def _comparisons(self, node: Any, names: Mapping[str, Any]) -> list[Any]:
        """Return the values of an expression, or for each comparison of a chain what must be ≥ 0."""
        if not isinstance(node, ast.Compare):
            return [self._value(node, names)]
        values, found = [self._value(each, names) for each in (node.left, *node.comparators)], []
        for less, sign, more in zip(values, node.ops, values[1:], strict=False):
            if not self.compares or not isinstance(sign, ast.Lt | ast.LtE | ast.Gt | ast.GtE):
                break
            found.append(more - less if isinstance(sign, ast.Lt | ast.LtE) else less - more)
        if len(found) < len(node.ops):
            raise InputError(self.key, "< and >" if self.compares else "values, which are squared", ast.unparse(node))
        return found

    def _value(self, node: Any, names: Mapping[str, Any]) -> Any:
        try:
            return self._compute(node, names)
        except (RuntimeError, NotImplementedError, ArithmeticError, TypeError, IndexError):  # shapes; 1/0
            raise InputError(self.key, "operations on shapes that fit, indices from 0", ast.unparse(node)) from None

    def _compute(self, node: Any, names: Mapping[str, Any]) -> Any:
        match node:
            case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
                return float(number)
            case ast.Name(id="pi"):
                return ca.pi
            case ast.Name(id=name):
                return names[errors.one_of(self.key, name, names)]
            case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
                return OPERATORS[type(op)](self._value(left, names), self._value(right, names))
            case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATORS:
                return OPERATORS[type(op)](self._value(operand, names))
            case ast.Call(func=ast.Name(id=name), args=given, keywords=[]):
                return FUNCTIONS[errors.one_of(self.key, name, FUNCTIONS)](
                    *(self._value(each, names) for each in given)
                )
            case ast.List(elts=entries):
                return ca.vertcat(*(self._value(each, names) for each in entries))
            case ast.Subscript(value=ast.Name() as whole, slice=ast.Constant(value=int() as i)):
                return self._value(whole, names)[i]
            case ast.Subscript(
                value=ast.Name() as whole,
                slice=ast.Tuple(elts=[ast.Constant(value=int() as i), ast.Constant(value=int() as j)]),
            ):
                return self._value(whole, names)[i, j]
        raise InputError(self.key, SYNTAX, ast.unparse(node))
