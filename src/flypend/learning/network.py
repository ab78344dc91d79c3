"""The network of `laws.learned` on batches, there and back, and the method by which its weights move."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.laws.learned import FEATURES, HOVER

Weights = dict[str, NDArray[np.float32]]


def first_weights(direct: Any, hidden: tuple[int, int], rng: np.random.Generator) -> Weights:
    """Return random weights with layers of `hidden` sizes, and the `direct` part (n, 18)."""
    n, (k, m) = len(direct), hidden

    def drawn(rows: int, columns: int) -> Any:
        return rng.standard_normal((rows, columns)) / np.sqrt(columns)

    weights = {
        "D": direct, "W_1": drawn(k, FEATURES), "b_1": 0.5 * rng.standard_normal(k), "W_2": drawn(m, k),
        "b_2": 0.2 * rng.standard_normal(m), "W_3": 0.1 * drawn(n, m),
    }  # fmt: skip
    return {name: np.asarray(array, dtype=np.float32) for name, array in weights.items()}


def with_hover(phi: Any) -> Any:
    """Return features (18, count) with those of hover as one more column, for `forward`."""
    return np.column_stack([phi, HOVER]).astype(phi.dtype)


def activate(z: Any) -> tuple[Any, Any]:
    """Return a(z) = z/√(1 + z²) and its derivative."""
    root = 1 / np.sqrt(1 + z * z)
    return z * root, root * root * root


def forward(w: Weights, phi: Any) -> tuple[Any, Any]:
    """Return N(φ) − N(φ₀) (n, count) for `phi` (18, count + 1), whose last column is φ₀, and what `backward` needs."""
    a, a_slope = activate(w["W_1"] @ phi + w["b_1"][:, None])
    b, b_slope = activate(w["W_2"] @ a + w["b_2"][:, None])
    v = w["D"] @ phi + w["W_3"] @ b
    return v[:, :-1] - v[:, -1:], (a, a_slope, b, b_slope)


def backward(w: Weights, phi: Any, kept: Any, gradient: Any, total: Weights) -> Any:
    """Return the gradient (18, count) of φ from the `gradient` (n, count) of `forward`; add that of weights to `total`.

    `phi` is the argument of `forward`, and `kept` its second result.
    """
    a, a_slope, b, b_slope = kept
    d = np.column_stack([gradient, -gradient.sum(axis=1)]).astype(phi.dtype)
    total["D"] += d @ phi.T
    total["W_3"] += d @ b.T
    d_b = (w["W_3"].T @ d) * b_slope
    total["W_2"] += d_b @ a.T
    total["b_2"] += d_b.sum(axis=1)
    d_a = (w["W_2"].T @ d_b) * a_slope
    total["W_1"] += d_a @ phi.T
    total["b_1"] += d_a.sum(axis=1)
    return (w["W_1"].T @ d_a + w["D"].T @ d)[:, :-1]


LONGEST = 5.0  # of a gradient; a longer one is shortened to it


class Adam:
    """The method of Kingma and Ba (2015), for a gradient no longer than `LONGEST`; `moments` are its memory."""

    def __init__(self, weights: Weights) -> None:
        self.count = 0
        self.moments = {f"{kind}{name}": np.zeros_like(array) for name, array in weights.items() for kind in "mv"}

    def move(self, weights: Weights, gradient: Weights, rate: float) -> float:
        """Move the `weights`, in place; return the length of the `gradient`. One that is not finite moves nothing."""
        length = float(np.sqrt(sum(np.sum(array.astype(float) ** 2) for array in gradient.values())))
        if not np.isfinite(length):
            return length
        self.count += 1
        share = np.float32(min(1.0, LONGEST / length) if length > 0 else 1.0)
        for name, array in weights.items():
            m, v, g = self.moments["m" + name], self.moments["v" + name], share * gradient[name]
            m += np.float32(0.1) * (g - m)
            v += np.float32(0.01) * (g * g - v)
            step = m / (1 - 0.9**self.count) / (np.sqrt(v / (1 - 0.99**self.count)) + 1e-8)
            array -= (rate * step).astype(array.dtype)
        return length
