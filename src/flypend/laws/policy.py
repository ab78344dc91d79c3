"""A policy: a small network from what the body frame shows of a state to rotor forces.

It sees Rᵀ(x − x_ref), Rᵀ(ẋ − ẋ_ref), Rᵀe₃, ω, Rᵀy and Rᵀẏ, which a turn about the vertical leaves alone. Lengths are in
rod lengths, times in √(l/g). With a(v) = v/√(1 + v²) applied to each entry, the network is

    N(φ) = D φ + W₃ a(W₂ a(W₁ φ + b₁) + b₂),

and rotor i is asked for the share ½ + ½ a(v_i) of its range, v = N(φ) − N(φ₀) + v₀, where φ₀ is what hover shows and v₀
asks for the hover forces: hover is an equilibrium whatever the weights.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.errors import InputError
from flypend.files.arrays import read_arrays, save_arrays
from flypend.files.schema import Field
from flypend.geometry import E3, Numbers, Scalar, Vector
from flypend.model import State

FEATURES = 18
# What is seen in hover.
HOVER = np.concatenate([np.zeros(6), E3, np.zeros(3), E3, np.zeros(3)])
MOST_WEIGHTS = 30_000
LARGEST = float(np.finfo(np.float32).max)

# The weights as in a file, for n rotors and hidden layers of k and m.
FIELDS: Mapping[str, Field] = {
    name: Field(dims, "<f4")
    for name, dims in {
        "D": ("n", FEATURES), "W_1": ("k", FEATURES), "b_1": ("k",), "W_2": ("m", "k"), "b_2": ("m",),
        "W_3": ("n", "m"),
    }.items()
}  # fmt: skip

Matrix = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Policy:
    """Weights of the network, for n rotors and hidden layers of k and m.

    Parameters
    ----------
    D : (n, 18)
        Direct, linear part.
    W_1, b_1 : (k, 18), (k,)
        First layer.
    W_2, b_2 : (m, k), (m,)
        Second layer.
    W_3 : (n, m)
        Last layer.
    """

    D: Matrix
    W_1: Matrix
    b_1: Matrix
    W_2: Matrix
    b_2: Matrix
    W_3: Matrix

    def __post_init__(self) -> None:
        n = len(_single("D", self.D, (None, FEATURES)))
        k, m = (len(_single(name, getattr(self, name), (None,))) for name in ("b_1", "b_2"))
        shapes = {"D": (n, FEATURES), "W_1": (k, FEATURES), "b_1": (k,), "W_2": (m, k), "b_2": (m,), "W_3": (n, m)}
        for name, shape in shapes.items():
            object.__setattr__(self, name, _single(name, getattr(self, name), shape))
        if self.size > MOST_WEIGHTS:
            raise InputError("policy", f"at most {MOST_WEIGHTS} weights", f"{self.size}")

    @property
    def arrays(self) -> dict[str, Matrix]:
        """The weights by name."""
        return {name: getattr(self, name) for name in FIELDS}

    @property
    def size(self) -> int:
        """Number of weights."""
        return sum(array.size for array in self.arrays.values())

    def network(self, phi: Numbers) -> Numbers:
        """Return N(φ) (n, 1) for `phi` (18, 1), in CasADi."""
        hidden = activation(_layer(self.W_1, self.b_1, phi))
        hidden = activation(_layer(self.W_2, self.b_2, hidden))
        return ca.mtimes(_constant(self.D), phi) + ca.mtimes(_constant(self.W_3), hidden)

    def asked(self, phi: Numbers) -> Numbers:
        """Return N(φ) − N(φ₀) (n, 1) for `phi` (18, 1), in CasADi."""
        at_hover = ca.DM(ca.evalf(ca.densify(self.network(ca.SX(ca.DM(HOVER))))))
        return self.network(phi) - at_hover


def _single(name: str, weights: Any, shape: tuple[int | None, ...]) -> Matrix:
    """Return the `weights` of that name, single precision. Raises InputError unless they are finite and of `shape`."""
    given = errors.array(f"policy.{name}", weights, shape)
    if np.max(np.abs(given), initial=0.0) > LARGEST:
        raise InputError(f"policy.{name}", f"weights up to {LARGEST:.2g}", f"{np.max(np.abs(given)):g}")
    return given.astype(np.float32)  # type: ignore[no-any-return]


def _constant(values: Any) -> Any:
    return ca.DM(np.asarray(values, dtype=float))


def _layer(W: Matrix, b: Matrix, v: Numbers) -> Any:
    return ca.mtimes(_constant(W), v) + _constant(b)


def activation(v: Numbers) -> Numbers:
    """Return a(v) = v/√(1 + v²), entry by entry: no library function, and smooth."""
    return v / ca.sqrt(1 + v**2)


def features(state: State, x: Vector, x_dot: Vector, length: Scalar, time: Scalar) -> Numbers:
    """Return φ (18, 1) of a `state` with e₃ up, in CasADi.

    `x`, `x_dot` are relative to the reference; `length` is that of the rod, m, and `time` √(l/g), s.
    """
    down = state.R.T
    columns = ca.horzcat(x / length, x_dot * (time / length), E3, state.y, state.y_dot * time)
    seen = ca.mtimes(down, columns)
    return ca.densify(ca.vertcat(seen[:, 0], seen[:, 1], seen[:, 2], state.omega * time, seen[:, 3], seen[:, 4]))


def shares(v: Numbers, hover: Scalar) -> Numbers:
    """Return the shares (n, 1) of their range, 0 to 1, that the rotors are asked for: `hover` where `v` is 0."""
    level = 2 * hover - 1
    return (1 + activation(v + level / ca.sqrt(1 - level**2))) / 2


def save(policy: Policy, path: Path) -> None:
    """Write `policy` to the file `path`, .npz; the same weights give the same bytes. Raises InputError if it cannot."""
    save_arrays(path, FIELDS, policy.arrays)


def load(path: Path) -> Policy:
    """Read a policy from the file `path`. Raises InputError if it holds none."""
    expected = "a file written by `flypend learn`"
    stored = read_arrays("policy", path, expected, FIELDS)
    try:
        return Policy(**stored)
    except InputError as error:
        raise InputError("policy", expected, f"{path}: {error}") from None
