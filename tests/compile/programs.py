"""An interpreter of scalar programs on NumPy arrays, and programs that tests share."""

import casadi as ca
import numpy as np
from scipy.special import erf

from flypend.compile.program import interpret, lower

OPERATIONS = {
    "add": np.add, "sub": np.subtract, "mul": np.multiply, "div": np.divide, "neg": np.negative, "sqrt": np.sqrt,
    "fabs": np.abs, "fmin": np.fmin, "fmax": np.fmax, "sign": np.sign,
    "lt": lambda a, b: 1.0 * (a < b), "le": lambda a, b: 1.0 * (a <= b), "eq": lambda a, b: 1.0 * (a == b),
    "ne": lambda a, b: 1.0 * (a != b), "not": lambda a: 1.0 * (a == 0),
    "and": lambda a, b: 1.0 * ((a != 0) & (b != 0)), "or": lambda a, b: 1.0 * ((a != 0) | (b != 0)),
    "select": lambda c, a: np.where(c != 0, a, 0.0),
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan,
    "sinh": np.sinh, "cosh": np.cosh, "tanh": np.tanh, "asinh": np.arcsinh, "acosh": np.arccosh,
    "atanh": np.arctanh, "exp": np.exp, "log": np.log, "floor": np.floor, "ceil": np.ceil, "erf": erf,
    "pow": np.power, "atan2": np.arctan2, "fmod": np.fmod, "hypot": np.hypot,
}  # fmt: skip


def evaluate(program, *inputs):
    """The output vectors of `program` for input vectors, each a list of arrays."""
    with np.errstate(all="ignore"):
        return interpret(program, [vector.__getitem__ for vector in inputs], OPERATIONS, float)


def program_of(expressions, symbols, name="f"):
    """The program of one output vector of `expressions` in a list of scalar `symbols`, and its CasADi function."""
    function = ca.Function(name, [ca.vertcat(*symbols)], [ca.densify(ca.vertcat(*expressions))])
    return lower(function), function
