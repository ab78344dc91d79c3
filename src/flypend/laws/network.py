"""A feedforward network of one's own, as expressions in symbols."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import casadi as ca

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import Numbers

MOST_WEIGHTS = 30_000  # exported C holds them in flash: 120 kB of single precision


class Layer(NamedTuple):
    """W v + b (n, 1) of a vector v (k, 1), each entry then passed to an activation function.

    Parameters
    ----------
    W : (n, k)
        Weights, as those of `torch.nn.Linear`; the transpose of a kernel of JAX's libraries.
    b : (n,)
        Biases.
    activation : str
        One of `ACTIVATIONS`.
    number : float
        The number that "elu" and "leaky_relu" take.
    """

    W: Any
    b: Any
    activation: str = "identity"
    number: float = 1.0


def tanh(v: Any) -> Any:
    """Return tanh v by basic arithmetic, which any processor has and exported C may use; 3e-13 off at most.

    The seventh convergent of Lambert's continued fraction u/(1 + u²/(3 + u²/(5 + …))) for u = v/4, and twice
    tanh 2u = 2 tanh u/(1 + tanh² u). From |v| = 20 on tanh is 1 in double precision.
    """
    u = ca.fmin(ca.fmax(v, -20), 20) / 4
    s = u * u
    t = u * (135135 + s * (17325 + s * (378 + s))) / (135135 + s * (62370 + s * (3150 + 28 * s)))
    for _ in range(2):
        t = 2 * t / (1 + t * t)
    return t


def expm1_negative(v: Any) -> Any:
    """Return exp(v) − 1 for v ≤ 0, by `tanh`."""
    t = tanh(v / 2)
    return 2 * t / (1 - t)


ACTIVATIONS: Mapping[str, Callable[[Any, float], Any]] = {
    "identity": lambda v, number: v,
    "tanh": lambda v, number: tanh(v),
    "relu": lambda v, number: ca.fmax(v, 0),
    "sigmoid": lambda v, number: (1 + tanh(v / 2)) / 2,
    "softplus": lambda v, number: ca.fmax(v, 0) + ca.log(1 + ca.exp(-ca.fabs(v))),
    "softsign": lambda v, number: v / (1 + ca.fabs(v)),
    "elu": lambda v, number: ca.fmax(v, 0) + number * expm1_negative(ca.fmin(v, 0)),
    "leaky_relu": lambda v, number: ca.fmax(v, 0) + number * ca.fmin(v, 0),
}


@dataclass(frozen=True, eq=False)
class Network:
    """Layers, one after the other.

    Parameters
    ----------
    layers : sequence of Layer, or of (W, b)
        The layers.

    Raises
    ------
    InputError
        If a layer does not fit the one before, an activation is unknown, a weight is not finite, or there are more than
        `MOST_WEIGHTS`.
    """

    layers: Sequence[Layer]

    def __post_init__(self) -> None:
        if not isinstance(self.layers, Sequence) or isinstance(self.layers, str) or not len(self.layers):
            raise InputError("network", "layers (W, b), one after the other", repr(self.layers)[:80])
        checked: list[Layer] = []
        for i, given in enumerate(self.layers):
            checked.append(_check_layer(f"network.layers[{i}]", given, len(checked[-1].b) if checked else None))
        object.__setattr__(self, "layers", tuple(checked))
        if (size := sum(layer.W.size + layer.b.size for layer in checked)) > MOST_WEIGHTS:
            raise InputError("network", f"at most {MOST_WEIGHTS} weights", f"{size}")

    @property
    def inputs(self) -> int:
        """Length of what it takes."""
        return int(self.layers[0].W.shape[1])

    @property
    def outputs(self) -> int:
        """Length of what it returns."""
        return len(self.layers[-1].b)

    def __call__(self, v: Numbers) -> Numbers:
        """Return the output (outputs, 1) for `v` (inputs, 1), in CasADi."""
        for layer in self.layers:
            v = ACTIVATIONS[layer.activation](ca.mtimes(ca.DM(layer.W), v) + ca.DM(layer.b), layer.number)
        return v


def _check_layer(field: str, given: Any, before: int | None) -> Layer:
    """Return the layer `given`, which takes what the one before returns; messages begin with `field`."""
    if not isinstance(given, tuple | list) or not 2 <= len(given) <= 4:
        raise InputError(field, "(W, b) or (W, b, activation)", repr(given)[:80])
    layer = Layer(*given)
    W = errors.array(f"{field}.W", layer.W, (None, before))
    b = errors.array(f"{field}.b", layer.b, (len(W),))
    errors.one_of(f"{field}.activation", layer.activation, ACTIVATIONS)
    return Layer(W, b, layer.activation, errors.number(f"{field}.number", layer.number))
