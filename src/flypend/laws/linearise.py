"""Linearisation on the tangent space of R³ × SO(3) × S² at an equilibrium, from the symbols of the closed loop.

Coordinates ξ ∈ R¹⁶ of a state about (x₀, ẋ₀, R₀, ω₀ = 0, y₀, ẏ₀ = 0), with b₁, b₂, y₀ orthonormal and right-handed:

    x = x₀ + ξ_x,  ẋ = ẋ₀ + ξ_ẋ,  R = R₀ exp(ξ̂_θ),  ω = ξ_ω,  bᵀy = ξ_y,  bᵀẏ = ξ_ẏ

(for y₀ = ±e₃, b₁ = e₁ and b₂ = ±e₂). With E = ∂s/∂ξ and the rates ṡ = F(s) of the packed state, which keep it on the
manifold, the matrix is A = E⁺ (∂F/∂s) E. No curvature of the charts enters: R, ω, y and ẏ rest at the equilibrium, and
the other coordinates are linear.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from flypend.errors import InputError
from flypend.geometry import E3, cross, hat, project_tangent, rotation_from_vector, unit
from flypend.laws.bound import BoundLaw
from flypend.laws.law import Law
from flypend.model import State, Vehicle, Wrench, equations_of_motion
from flypend.model.state import SIZE, E3Direction

COORDINATES = (
    "x_1", "x_2", "x_3", "x_dot_1", "x_dot_2", "x_dot_3", "theta_1", "theta_2", "theta_3",
    "omega_1", "omega_2", "omega_3", "y_1", "y_2", "y_dot_1", "y_dot_2",
)  # fmt: skip

# Turning the vehicle about its thrust axis changes nothing for a law that knows the heading by its rate alone.
SYMMETRIES = ("theta_3",)

# Rates below this share of the largest entry of A are those of an equilibrium in double precision.
_ROUNDOFF = 1e-11
_NEWTON_STEPS = 20


@dataclass(frozen=True, kw_only=True, eq=False)
class Linearisation:
    """ξ̇ = A ξ about an equilibrium.

    Parameters
    ----------
    at : State
        The equilibrium, in the frame of the law.
    A : (n, n)
        Matrix, n = 16 unless coordinates were left out.
    coordinates : tuple of str
        Names of the coordinates ξ, in the order of the rows.
    acceleration : (3,)
        Acceleration of the pivot at `at`, m/s²: 0 for a law that holds a position; one that does not may drift.
    """

    at: State
    A: Any
    coordinates: tuple[str, ...] = COORDINATES
    acceleration: Any

    @property
    def eigenvalues(self) -> Any:
        """All eigenvalues of A, 1/s, by falling real part."""
        values = np.linalg.eigvals(self.A).astype(complex)
        return values[np.lexsort((values.imag, -values.real))]

    @property
    def symmetries(self) -> tuple[str, ...]:
        """Coordinates among `SYMMETRIES` that no rate depends on: each brings one eigenvalue 0, as it should."""
        return tuple(name for name in SYMMETRIES if name in self.coordinates and self._is_free((name,)))

    @property
    def spectral_abscissa(self) -> float:
        """Largest real part of an eigenvalue, 1/s, those of `symmetries` left out."""
        return float(self.without(*self.symmetries).eigenvalues[0].real)

    @property
    def stable(self) -> bool:
        """Whether all eigenvalues but those of `symmetries` have a negative real part."""
        return self.spectral_abscissa < 0

    def without(self, *names: str) -> Linearisation:
        """The rest of the coordinates on their own, once those called `names` are left out.

        A name may stand for a vector: "x" for x_1, x_2, x_3. The eigenvalues of the rest are eigenvalues of the whole.

        Raises
        ------
        InputError
            For an unknown name, and if the rest depends on what is left out.
        """
        left_out = tuple(one for name in names for one in self._members(name))
        if not self._is_free(left_out):
            raise InputError("coordinates", "some that the others do not depend on", ", ".join(names))
        keep = [i for i, name in enumerate(self.coordinates) if name not in left_out]
        return Linearisation(
            at=self.at,
            A=self.A[np.ix_(keep, keep)],
            coordinates=tuple(self.coordinates[i] for i in keep),
            acceleration=self.acceleration,
        )

    def _members(self, name: str) -> tuple[str, ...]:
        found = tuple(one for one in self.coordinates if name in (one, one[:-2]))
        if not found:
            raise InputError("coordinates", "one of " + ", ".join(self.coordinates), repr(name))
        return found

    def _is_free(self, names: tuple[str, ...]) -> bool:
        inside = np.array([name in names for name in self.coordinates])
        largest = np.max(np.abs(self.A[np.ix_(~inside, inside)]), initial=0.0)
        return bool(largest <= _ROUNDOFF * np.max(np.abs(self.A)))


def linearise(law: Law | BoundLaw, vehicle: Vehicle, at: State | None = None) -> Linearisation:
    """Linearise the closed loop of `vehicle` under `law` about the equilibrium next to `at`, at time 0.

    Parameters
    ----------
    law, vehicle
        What steers and what flies, without rotors in between: the wrench acts as commanded.
    at : State, optional
        An equilibrium in the frame of the law, or a guess of one, from which Newton's method in the coordinates leads
        to it. Default y = z = e₃, at rest at the law's reference. A law that does not govern the pivot is linearised
        about a state in which attitude and rod rest; see `Linearisation.acceleration`.

    Raises
    ------
    InputError
        If there is no equilibrium near `at`, the law is not defined there, or its reference moves.
    """
    if not isinstance(law, Law | BoundLaw):
        raise InputError("law", "a Law, which is written in symbols", type(law).__name__)
    bound = law.bind(vehicle)
    rates = _closed_loop(bound, vehicle)
    state = _upright(bound) if at is None else _single(at)
    for _ in range(_NEWTON_STEPS):
        velocity, A = _on_tangent_space(rates, state)
        step = np.linalg.lstsq(A, -velocity, rcond=1e-10)[0]
        if not 1e-12 < np.linalg.norm(step) < 1:
            break  # arrived, or led away
        state = retract(state, step)
    velocity, A = _on_tangent_space(rates, state)
    _check_rest(velocity, A)
    return Linearisation(at=state, A=A, acceleration=velocity[3:6])


def open_loop(vehicle: Vehicle, e3: E3Direction, at: State, wrench: Wrench) -> tuple[Any, Any]:
    """A (16, 16) and B (16, 4) of ξ̇ = A ξ + B (δf, δτ) about the equilibrium `at` of `vehicle` under `wrench`.

    Parameters
    ----------
    vehicle, wrench
        What flies, and the wrench that holds it.
    e3 : "up" or "down"
        Direction of the world's third axis.
    at : State
        The equilibrium.

    Raises
    ------
    InputError
        If `at` does not rest under `wrench`.
    """
    packed, input_ = ca.SX.sym("s", SIZE), ca.SX.sym("u", 4)
    motion = equations_of_motion(State.symbolic(packed), Wrench(input_[0], input_[1:]), vehicle, e3).packed()
    outputs = [motion, ca.jacobian(motion, packed), ca.jacobian(motion, input_)]
    function = ca.Function("open_loop", [packed, input_], [ca.densify(value) for value in outputs])
    held = np.concatenate([[wrench.thrust], wrench.moment])
    F, F_s, F_u = (np.array(value) for value in function(_single(at).packed(), held))
    E = tangent_basis(at)
    P = np.linalg.pinv(E)
    A = P @ F_s @ E
    _check_rest(P @ F[:, 0], A)
    return A, P @ F_u


def tangent_basis(at: State) -> Any:
    """E = ∂s/∂ξ (24, 16): the columns span the tangent space at `at`, a single state.

    Where the rod moves, its ẏ turns with y: b moves y, and −(b·ẏ) y keeps ẏ tangent.
    """
    b = _plane(at.y)
    E = np.zeros((SIZE, len(COORDINATES)))
    E[0:6, 0:6] = np.eye(6)
    E[6:15, 6:9] = (at.R @ hat(np.eye(3))).reshape(3, 9).T
    E[15:18, 9:12] = np.eye(3)
    E[18:21, 12:14] = E[21:24, 14:16] = b.T
    E[21:24, 12:14] = -np.outer(at.y, b @ at.y_dot)
    return E


def retract(at: State, xi: Any) -> State:
    """The state with coordinates `xi` (16,) about `at`, a single state with ω = 0 and ẏ = 0; |ξ_y| < 1."""
    b, xi = _plane(at.y), np.asarray(xi, dtype=float)
    height = np.sqrt(1 - xi[12:14] @ xi[12:14])
    return State(
        x=at.x + xi[0:3],
        x_dot=at.x_dot + xi[3:6],
        R=at.R @ rotation_from_vector(xi[6:9]),
        omega=xi[9:12],
        y=xi[12:14] @ b + height * at.y,
        y_dot=xi[14:16] @ b - xi[12:14] @ xi[14:16] / height * at.y,
    )


def _plane(y: Any) -> Any:
    """b₁ and b₂ (2, 3): b₁ along the part across `y` of the axis that is least along it, roundings left aside."""
    b_1 = unit(project_tangent(y, np.eye(3)[np.argmin(np.abs(y).round(9))]))
    return np.stack([b_1, cross(y, b_1)])


def _closed_loop(law: BoundLaw, vehicle: Vehicle) -> ca.Function:
    """Packed state (24,) → rates, their derivatives by the state and by time, at time 0."""
    t, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
    state = State.symbolic(packed)
    motion = equations_of_motion(state, law.evaluate(t, state, vehicle).wrench, vehicle, law.e3).packed()
    outputs = [motion, ca.jacobian(motion, packed), ca.jacobian(motion, t)]
    now = ca.substitute([ca.densify(value) for value in outputs], [t], [ca.SX(0)])
    return ca.Function("closed_loop", [packed], ca.cse(now))


def _on_tangent_space(rates: ca.Function, state: State) -> tuple[Any, Any]:
    """Velocity ξ̇ (16,) and A at `state`, whose R, ω, y and ẏ are taken to rest."""
    F, F_s, F_t = (np.array(value) for value in rates(state.packed()))
    if not all(np.all(np.isfinite(value)) for value in (F, F_s, F_t)):
        raise InputError("law", "one that is differentiable at its equilibrium", "NaN or infinity")
    if np.any(F_t):
        raise InputError("law", "one whose reference stands still", "one that depends on time")
    E = tangent_basis(state)
    P = np.linalg.pinv(E)
    return P @ F[:, 0], P @ F_s @ E


def _check_rest(velocity: Any, A: Any) -> None:
    """Attitude and rod must rest; the pivot may move on as a law without position control lets it."""
    moving = np.max(np.abs(velocity[6:]))
    if moving > _ROUNDOFF * np.max(np.abs(A)):
        raise InputError("at", "a state next to an equilibrium", f"rates of attitude or rod of {moving:.3g} rad/s, /s²")


def _upright(law: BoundLaw) -> State:
    x = np.zeros(3) if law.reference is None else np.array(ca.DM(ca.evalf(law.reference(ca.SX(0))))).ravel()
    return State(x=x, y=E3)


def _single(at: State) -> State:
    if at.batch_shape:
        raise InputError("at", "a single state", f"a batch of shape {at.batch_shape}")
    if np.any(at.omega) or np.any(at.y_dot):
        raise InputError("at", "a state at rest: omega = 0 and y_dot = 0", "one that turns")
    return at
