"""A learned law: a small network from what the body frame shows of a state to rotor forces, its policy.

Its wrench is one that the rotors can give, so that allocation changes nothing. Policies come from `flypend learn`.

The network sees Rᵀ(x − x_ref), Rᵀ(ẋ − ẋ_ref), Rᵀe₃, ω, Rᵀy and Rᵀẏ, which a turn about the vertical leaves alone.
Lengths are in rod lengths, times in √(l/g). With a(v) = v/√(1 + v²) applied to each entry, the network is

    N(φ) = D φ + W₃ a(W₂ a(W₁ φ + b₁) + b₂),

and rotor i is asked for the share ½ + ½ a(v_i) of its range, v = N(φ) − N(φ₀) + v₀, where φ₀ is what hover shows and v₀
asks for the hover forces: hover is an equilibrium whatever the weights.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from importlib import resources
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.errors import InputError
from flypend.files.arrays import read_arrays, save_arrays
from flypend.files.schema import Field
from flypend.geometry import E3, Numbers, Scalar, Vector, norm, smooth_norm
from flypend.laws.bound import Control, computer_of
from flypend.laws.gain import DELAY_REACH, NOT_NEGATIVE, Bounds, Gain, check_gravity, document_gains, table
from flypend.laws.law import Law
from flypend.laws.references import Reference, hover
from flypend.laws.throw import derivatives
from flypend.model import State, Vehicle, Wrench

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
        sizes: dict[str | int, int] = {FEATURES: FEATURES}
        for name, field in FIELDS.items():
            weights = _single(name, getattr(self, name), tuple(sizes.get(dim) for dim in field.dims))
            sizes |= zip(field.dims, weights.shape, strict=True)
            object.__setattr__(self, name, weights)
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

    def evaluate(self, phi: Numbers) -> Numbers:
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


# The law --------------------------------------------------------------------------------------------------------------

FOLDER = resources.files("flypend") / "policies"
USUAL, SHIPPED, ON_HUB = "usual", "hehn2011", "hehn2011-hub"
# In rod lengths: farther off, the network is shown a place at this distance, in the same direction, and flies home from
# there. On a gimbal it was trained nearer; on a hub flights to 19 rod lengths succeed, which are left as they are.
REACH, REACH_ON_HUB = 4.0, 20.0
LEAST_SHARE = 0.02  # of its range: what a rotor keeps to both limits in hover, whatever the estimated forces

GAINS = table(
    (
        Gain("policy", USUAL, doc="Name of a shipped policy, or a file of `flypend learn` (.npz); usual: by mount"),
        Gain(
            "lead", lambda v: 2.1 if v.rotor_lag > 0 else 1.0, "",
            "Rotors are commanded f̂ + lead (f − f̂), where f̂ is their modelled force", Bounds(low=1.0),
        ),
        Gain("observer", 1.5, "1/s", "Bandwidth of the external-force observer; 0 for none", NOT_NEGATIVE),
        Gain("latency", 0.0, "s", "Delay that the flight computer compensates by prediction", NOT_NEGATIVE),
        Gain("delay_reach", 0.06, "s", DELAY_REACH, NOT_NEGATIVE),
    )
)  # fmt: skip


@errors.named_arguments
@document_gains(GAINS, ", there is no such policy, or it is for another number of rotors")
def learned(reference: Reference | None = None, **gains: Any) -> Law:
    """Build the learned law."""
    followed = reference or hover()
    return Law(
        name="learned", e3="up", gains=GAINS, given=gains, control=learned_control, computer=computer_of,
        uses_forces=True, reference=followed, prepare=partial(_prepare, followed),
    )  # fmt: skip


def _prepare(reference: Reference, vehicle: Vehicle, gains: Mapping[str, Any]) -> dict[str, Any]:
    check_gravity(vehicle)
    usual = ON_HUB if vehicle.mount == "hub" else SHIPPED
    network = policy(usual if gains["policy"] == USUAL else gains["policy"])
    if len(network.D) != len(vehicle.rotor_spins):
        raise InputError("vehicle", f"one with {len(network.D)} rotors, like the policy", f"{len(vehicle.rotor_spins)}")
    reach = REACH_ON_HUB if vehicle.mount == "hub" else REACH
    # The network was trained behind the rotors' lag, as its flight computer has to know.
    return {"network": network, "reach": reach, "reference": reference, "models_lag": True}


def policy_names() -> list[str]:
    """Return the names of the policies shipped with the package."""
    return sorted(entry.name.removesuffix(".npz") for entry in FOLDER.iterdir() if entry.name.endswith(".npz"))


def policy(name: str) -> Policy:
    """Return the policy `name` shipped with the package, or that of the file `name` (.npz). Raises InputError."""
    if name.endswith(".npz"):
        return load(Path(name))
    return _read_shipped(errors.one_of("policy", name, policy_names()))


@lru_cache(maxsize=8)
def _read_shipped(name: str) -> Policy:
    with resources.as_file(FOLDER / f"{name}.npz") as path:
        return load(path)


def learned_control(
    t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, forces: tuple[Vector, Vector]
) -> Control:
    """Evaluate the network of `k` for symbols `t` (s) and `state` of `vehicle` about the reference of `k`.

    It is shown no place farther off than `k.reach`, in rod lengths.

    Of the external `forces` on vehicle and bob, each (3, 1), N, the vertical part is carried: hover then takes less or
    more than the weight.
    """
    x_ref = k.reference(t)
    x, x_dot = state.x - x_ref, state.x_dot - ca.densify(derivatives(x_ref, t, 1)[0])
    far = k.reach * vehicle.l
    x = x * far / ca.fmax(smooth_norm(x, 1e-6 * far), far)
    phi = features(state, x, x_dot, vehicle.l, ca.sqrt(vehicle.l / vehicle.g))
    low, high = vehicle.rotor_limits
    level = (vehicle.weight - forces[0][2] - forces[1][2]) / len(vehicle.rotor_spins)
    hover_share = ca.fmin(ca.fmax((level - low) / (high - low), LEAST_SHARE), 1 - LEAST_SHARE)
    rotors = low + (high - low) * shares(k.network.evaluate(phi), hover_share)
    wrench = ca.mtimes(vehicle.mixing(), rotors)
    return Control(wrench=Wrench(wrench[0], wrench[1:]), signals={"position_error": norm(x)})
