"""Scalar programs as JAX code: entry i of a vector is row i of an array (length, runs).

JAX is imported on first use. The operations are those of `flypend.compile.program`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from flypend.compile.program import Program, interpret

Function = Callable[..., tuple[Any, ...]]


def as_jax(program: Program) -> Function:
    """Convert `program` to a function from one array (length, runs) per input vector to one per output vector."""
    import jax.numpy as jnp

    operations = _operations()

    def call(*inputs: Any) -> tuple[Any, ...]:
        like = next(rows for rows in inputs if rows.shape[0])[0]
        rows = [vector.__getitem__ for vector in inputs]
        vectors = interpret(program, rows, operations, partial(jnp.full_like, like))
        return tuple(jnp.stack(vector) for vector in vectors)

    return call


def _operations() -> dict[str, Callable[..., Any]]:
    import jax.numpy as jnp
    from jax.scipy.special import erf

    def number(mask: Any, like: Any) -> Any:
        return mask.astype(like.dtype)

    named = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2", "asinh": "arcsinh",
             "acosh": "arccosh", "atanh": "arctanh", "pow": "power"}  # fmt: skip
    same = ("sqrt", "fabs", "sign", "sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "floor", "ceil",
            "fmin", "fmax", "fmod", "hypot")  # fmt: skip
    return {
        **{name: getattr(jnp, own) for name, own in named.items()},
        **{name: getattr(jnp, name) for name in same},
        "erf": erf,
        "add": lambda a, b: a + b,
        "sub": lambda a, b: a - b,
        "mul": lambda a, b: a * b,
        "div": lambda a, b: a / b,
        "neg": lambda a: -a,
        "lt": lambda a, b: number(a < b, a),
        "le": lambda a, b: number(a <= b, a),
        "eq": lambda a, b: number(a == b, a),
        "ne": lambda a, b: number(a != b, a),
        "not": lambda a: number(a == 0, a),
        "and": lambda a, b: number((a != 0) & (b != 0), a),
        "or": lambda a, b: number((a != 0) | (b != 0), a),
        "select": lambda condition, a: jnp.where(condition != 0, a, 0.0),
    }
