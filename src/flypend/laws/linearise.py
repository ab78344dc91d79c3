"""Linearisation about an equilibrium on the tangent space of R³ × SO(3) × S², from the symbolic closed loop.

Coordinates ξ ∈ R¹⁶ of a state about (x₀, ẋ₀, R₀, ω₀ = 0, y₀, ẏ₀ = 0), with b₁, b₂, y₀ orthonormal and right-handed:

    x = x₀ + ξ_x,  ẋ = ẋ₀ + ξ_ẋ,  R = R₀ exp(ξ̂_θ),  ω = ξ_ω,  bᵀy = ξ_y,  bᵀẏ = ξ_ẏ

(for y₀ = ±e₃: b₁ = e₁, b₂ = ±e₂). With E = ∂s/∂ξ, and ṡ = F(s) the dynamics of the packed state, which stay on the
manifold, A = E⁺ (∂F/∂s) E. The curvature of the charts does not enter: R, ω, y and ẏ are at rest at the equilibrium,
and the other coordinates are linear.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.building import builds
from flypend.errors import InputError
from flypend.geometry import E3, Numbers, Vector, cross, hat, project_tangent, rotation_from_vector, unit
from flypend.laws.bound import BoundLaw
from flypend.laws.law import Law
from flypend.model import State, Vehicle, Wrench, equations_of_motion
from flypend.model.state import SIZE, E3Direction

COORDINATES = (
    "x_1", "x_2", "x_3", "x_dot_1", "x_dot_2", "x_dot_3", "theta_1", "theta_2", "theta_3",
    "omega_1", "omega_2", "omega_3", "y_1", "y_2", "y_dot_1", "y_dot_2",
)  # fmt: skip

# For a law that depends on the heading only through its rate, rotation about the thrust axis is a symmetry.
SYMMETRIES = ("theta_3",)

# Rates below this fraction of the largest entry of A count as zero: roundoff in double precision.
_ROUNDOFF = 1e-11
_NEWTON_STEPS = 20


@dataclass(frozen=True, kw_only=True, eq=False)
class Linearisation:
    """ξ̇ = A ξ about an equilibrium.

    Parameters
    ----------
    at : State
        The equilibrium, in the law's frame.
    A : (n, n)
        System matrix; n = 16 unless coordinates were left out.
    coordinates : tuple of str
        Names of the coordinates ξ, in the order of the rows.
    acceleration : (3,)
        Acceleration of the pivot at `at`, m/s²: 0 if the law controls position, else possibly a drift.
    """

    at: State
    A: Any
    coordinates: tuple[str, ...] = COORDINATES
    acceleration: Any

    @property
    def eigenvalues(self) -> Numbers:
        """Eigenvalues of A, 1/s, in descending order of real part."""
        values = np.linalg.eigvals(self.A).astype(complex)
        return values[np.lexsort((values.imag, -values.real))]

    @property
    def symmetries(self) -> tuple[str, ...]:
        """Coordinates among `SYMMETRIES` that no rate depends on; each contributes an eigenvalue 0 by construction."""
        return tuple(name for name in SYMMETRIES if name in self.coordinates and self._is_free((name,)))

    @property
    def spectral_abscissa(self) -> float:
        """Largest real part of the eigenvalues, 1/s, without those of `symmetries`."""
        return float(self.without(*self.symmetries).eigenvalues[0].real)

    @property
    def stable(self) -> bool:
        """Whether all eigenvalues except those of `symmetries` have negative real parts."""
        return self.spectral_abscissa < 0

    def without(self, *names: str) -> Linearisation:
        """Return the linearisation without the coordinates `names`.

        A name may stand for a vector: "x" for x_1, x_2, x_3. The remaining eigenvalues are eigenvalues of the full A.

        Raises
        ------
        InputError
            If a name is unknown, or the remaining coordinates depend on those left out.
        """
        left_out = tuple(one for name in names for one in self._members(name))
        if not self._is_free(left_out):
            raise InputError("coordinates", "some that the others do not depend on", ", ".join(names))
        keep = [i for i, name in enumerate(self.coordinates) if name not in left_out]
        return replace(self, A=self.A[np.ix_(keep, keep)], coordinates=tuple(self.coordinates[i] for i in keep))

    def _members(self, name: str) -> tuple[str, ...]:
        found = tuple(one for one in self.coordinates if name in (one, one[:-2]))
        if not found:
            raise InputError("coordinates", "one of " + ", ".join(self.coordinates), repr(name))
        return found

    def _is_free(self, names: tuple[str, ...]) -> bool:
        inside = np.array([name in names for name in self.coordinates])
        largest = np.max(np.abs(self.A[np.ix_(~inside, inside)]), initial=0.0)
        return bool(largest <= _ROUNDOFF * np.max(np.abs(self.A)))


@errors.named_arguments
@builds
def linearise(law: Law | BoundLaw, vehicle: Vehicle, at: State | None = None) -> Linearisation:
    """Linearise the closed loop of `vehicle` under `law` about the equilibrium near `at`, at time 0.

    Parameters
    ----------
    law, vehicle
        Law and vehicle. There are no rotor dynamics: the wrench acts as commanded.
    at : State, optional
        An equilibrium in the law's frame, or an initial guess, refined by Newton's method in the coordinates ξ.
        Default y = z = e₃, at rest at the law's reference. If the law does not control the pivot, only attitude and
        rod need be at rest; see `Linearisation.acceleration`.

    Raises
    ------
    InputError
        If there is no equilibrium near `at`, the law is not defined there, or its reference moves.
    """
    if not isinstance(law, Law | BoundLaw):
        raise InputError("law", "a Law, which is written in symbols", type(law).__name__)
    bound = law.bind(vehicle)
    vehicle = bound.vehicle  # whose wrench is the commanded one
    t, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
    wrench = bound.evaluate(t, State.symbolic(packed), vehicle).wrench
    now = ca.substitute(_motion(packed, wrench, vehicle, bound.e3, t), [t], [ca.SX(0)])
    motion = ca.Function("closed_loop", [packed], ca.cse(now))
    state = _upright(bound) if at is None else _single(at)
    for _ in range(_NEWTON_STEPS):
        velocity, A = _standing(motion, state)
        step = np.linalg.lstsq(A, -velocity, rcond=1e-10)[0]
        if not 1e-12 < np.linalg.norm(step) < 1:
            break  # converged, or diverging
        state = retract(state, step)
    velocity, A = _standing(motion, state)
    _check_rest(velocity, A)
    return Linearisation(at=state, A=A, acceleration=velocity[3:6])


@builds
def open_loop(vehicle: Vehicle, e3: E3Direction, at: State, wrench: Wrench) -> tuple[Numbers, Numbers]:
    """Return A (16, 16) and B (16, 4) of ξ̇ = A ξ + B (δf, δτ) about the equilibrium `at` of `vehicle` under `wrench`.

    Parameters
    ----------
    vehicle, wrench
        Vehicle parameters, and the wrench that holds the equilibrium.
    e3 : "up" or "down"
        Direction of the world's third axis.
    at : State
        The equilibrium.

    Raises
    ------
    InputError
        If attitude and rod are not at rest at `at` under `wrench`.
    """
    packed, u = ca.SX.sym("s", SIZE), ca.SX.sym("u", 4)
    motion = ca.Function("open_loop", [packed, u], _motion(packed, Wrench(u[0], u[1:]), vehicle, e3, u))
    velocity, A, B = _on_tangent_space(motion, _single(at), np.append(wrench.thrust, wrench.moment))
    _check_rest(velocity, A)
    return A, B


def tangent_basis(at: State) -> Numbers:
    """Return E = ∂s/∂ξ (24, 16), whose columns span the tangent space at the single state `at`.

    If the rod moves, ẏ changes with y: b moves y, and −(b·ẏ) y keeps ẏ tangent.
    """
    b = _plane(at.y)
    E = np.zeros((SIZE, len(COORDINATES)))
    E[0:6, 0:6] = np.eye(6)
    E[6:15, 6:9] = (at.R @ hat(np.eye(3))).reshape(3, 9).T
    E[15:18, 9:12] = np.eye(3)
    E[18:21, 12:14] = E[21:24, 14:16] = b.T
    E[21:24, 12:14] = -np.outer(at.y, b @ at.y_dot)
    return E


def retract(at: State, xi: Numbers) -> State:
    """Return the state with coordinates `xi` (16,), |ξ_y| < 1, about a single state `at` with ω = 0 and ẏ = 0."""
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


def _plane(y: Vector) -> Numbers:
    """Return b₁ and b₂ (2, 3). b₁ is the axis least aligned with `y` (up to roundoff), projected normal to `y`."""
    b_1 = unit(project_tangent(y, np.eye(3)[np.argmin(np.abs(y).round(9))]))
    return np.stack([b_1, cross(y, b_1)])


def _motion(packed: Numbers, wrench: Wrench, vehicle: Vehicle, e3: E3Direction, other: Numbers) -> list[Numbers]:
    """Return the rates (24, 1) of the `packed` state, and their derivatives by it and by the `other` symbols."""
    rates = equations_of_motion(State.symbolic(packed), wrench, vehicle, e3).packed()
    return [ca.densify(value) for value in (rates, ca.jacobian(rates, packed), ca.jacobian(rates, other))]


def _on_tangent_space(motion: ca.Function, state: State, *others: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Return velocity ξ̇ (16,), A, and ∂ξ̇ by the `others`, at `state`, with R, ω, y and ẏ assumed at rest."""
    F, F_s, F_other = (np.array(value) for value in motion(state.packed(), *others))
    if not all(np.all(np.isfinite(value)) for value in (F, F_s, F_other)):
        raise InputError("law", "one that is differentiable at its equilibrium", "NaN or infinity")
    E = tangent_basis(state)
    P = np.linalg.pinv(E)
    return P @ F[:, 0], P @ F_s @ E, P @ F_other


def _standing(motion: ca.Function, state: State) -> tuple[Numbers, Numbers]:
    """Return velocity and A of a closed loop, whose derivative by time has to vanish."""
    velocity, A, drift = _on_tangent_space(motion, state)
    if np.any(drift):
        raise InputError("law", "one whose reference stands still", "one that depends on time")
    return velocity, A


def _check_rest(velocity: Any, A: Any) -> None:
    """Check that attitude and rod are at rest; without position control, the pivot may still move."""
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
        raise InputError("at", "a state at rest: omega = 0 and y_dot = 0", "nonzero omega or y_dot")
    return at
