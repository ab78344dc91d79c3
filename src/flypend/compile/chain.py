"""A sequence of calls of scalar functions, and its vector-Jacobian product.

CasADi differentiates a function of calls by expressions between them, which `compile.routine` does not take. Here each
called function is differentiated by itself, and gradients are added by calls, too, so that code stays as short as that
of one step however often the step is called.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca


class Chain:
    """Records calls on MX vectors, for `pullback`."""

    def __init__(self) -> None:
        self._calls: list[tuple[ca.Function, list[Any], list[Any]]] = []
        self._reversed: dict[str, ca.Function] = {}

    def call(self, function: ca.Function, *inputs: Any) -> Any:
        """Return what the SX `function` of dense vectors returns: a vector (MX), or a list of several.

        Functions of the same name must be the same.
        """
        outputs = function.call([ca.MX(value) for value in inputs])
        self._calls.append((function, list(inputs), outputs))
        return outputs[0] if len(outputs) == 1 else outputs

    def pullback(self, seeds: Sequence[tuple[Any, Any]], wanted: Sequence[Any]) -> list[Any]:
        """Return the gradients with respect to each vector in `wanted`, from those (vector, gradient) in `seeds`."""
        found: dict[int, Any] = {}

        def add(vector: Any, gradient: Any) -> None:
            key = hash(vector)
            known = found.get(key)
            found[key] = gradient if known is None else _plus(vector.numel()).call([known, gradient])[0]

        for vector, gradient in seeds:
            add(vector, gradient)
        for function, inputs, outputs in reversed(self._calls):
            given = [found.get(hash(output)) for output in outputs]
            if all(gradient is None for gradient in given):
                continue
            filled = [
                ca.MX.zeros(output.numel()) if gradient is None else gradient
                for output, gradient in zip(outputs, given, strict=True)
            ]
            if (back := self._reversed.get(function.name())) is None:
                back = self._reversed[function.name()] = _reverse(function)
            for value, gradient in zip(inputs, back.call([*map(ca.MX, inputs), *filled]), strict=True):
                if isinstance(value, ca.MX):
                    add(value, gradient)
        return [found.get(hash(vector), ca.MX.zeros(vector.numel())) for vector in wanted]


def _plus(length: int) -> ca.Function:
    a, b = ca.SX.sym("a", length), ca.SX.sym("b", length)
    return ca.Function(f"plus_{length}", [a, b], [a + b])


def _reverse(function: ca.Function) -> ca.Function:
    """Return (inputs, gradients of the outputs) → gradients of the inputs."""
    inputs = function.sx_in()
    outputs = function.call(inputs)
    gradients = [ca.SX.sym(f"g{i}", output.numel()) for i, output in enumerate(outputs)]
    total = sum(ca.dot(g, output) for g, output in zip(gradients, outputs, strict=True))
    found = ca.cse([ca.densify(ca.gradient(total, value)) for value in inputs])
    return ca.Function(f"{function.name()}_back", [*inputs, *gradients], found)
