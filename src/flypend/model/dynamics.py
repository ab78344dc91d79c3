"""State rates, Lie derivatives, energies, momentum and rod tension, for NumPy batches and CasADi expressions."""

from __future__ import annotations

from typing import NamedTuple

import casadi as ca
import numpy as np

from flypend import errors
from flypend.geometry import E3, Matrix, Numbers, Scalar, Vector, apply, cross, dot, is_symbolic
from flypend.model.rod import is_point
from flypend.model.state import E3Direction, State, Wrench
from flypend.model.vehicle import Vehicle


class Rates(NamedTuple):
    """Time derivative of a state: x_dot, x_ddot, R_dot, omega_dot, y_dot, y_ddot, ordered like `State.packed`."""

    x_dot: Vector
    x_ddot: Vector
    R_dot: Matrix
    omega_dot: Vector
    y_dot: Vector
    y_ddot: Vector

    def packed(self) -> Numbers:
        """Return the rates as one vector (..., 24)."""
        if is_symbolic(self.y_dot):
            parts = [ca.vec(part.T) if part.shape == (3, 3) else part for part in self]
            return ca.vertcat(*parts)
        batch = self.y_dot.shape[:-1]
        return np.concatenate([np.reshape(part, (*batch, -1)) for part in self], axis=-1)


def gravity_vector(vehicle: Vehicle, e3: E3Direction) -> Vector:
    """Gravity vector g⃗ in the world frame, m/s²: −g e₃ for `e3` = "up", +g e₃ for "down" (the paper's frame)."""
    return (-vehicle.g if errors.one_of("e3", e3, ("up", "down")) == "up" else vehicle.g) * E3


def gyroscopic_moment(I: Matrix, omega: Vector) -> Vector:
    """ω × I ω, N m, for inertia `I` (3, 3) and angular velocity `omega` (..., 3) in the body frame.

    Written as ω × (I − I₁₁) ω, in which terms vanish for a vehicle of rotational symmetry.
    """
    return cross(omega, apply(I - I[0, 0] * np.eye(3), omega))


def swing_around(arm: Vector, omega: Vector, omega_dot: Vector) -> Vector:
    """ω̇ × r + ω × (ω × r), m/s²: by how much a point at `arm` r (..., 3) of a body accelerates more than its origin.

    All in the body frame: `omega` (..., 3), rad/s, and its rate `omega_dot`.
    """
    return cross(omega_dot, arm) + cross(omega, cross(omega, arm))


def lie_derivative(h: Scalar, state: State, rates: Rates, t: Scalar = None) -> Numbers:
    """Lie derivative of the CasADi expression `h` along the flow: L(h) = ∂h/∂s · ṡ (+ ∂h/∂t).

    `state` holds the symbols in `h`, `rates` their time derivatives. Pass the time symbol `t` if `h` depends on it.
    """
    symbols, velocity = state.packed(), rates.packed()
    if t is not None:
        symbols, velocity = ca.vertcat(symbols, t), ca.vertcat(velocity, 1)
    return ca.jtimes(h, symbols, velocity)


def bob_position(state: State, vehicle: Vehicle) -> Vector:
    """Position of the bob, p = x + l y, world frame, m."""
    return state.x + vehicle.l * state.y


def kinetic_energy(state: State, vehicle: Vehicle) -> Scalar:
    """Kinetic energy of quadrotor and bob, (lq) + (lp), J; inertia and omega must share a body frame."""
    bob_velocity = state.x_dot + vehicle.l * state.y_dot
    rotation = dot(apply(vehicle.I, state.omega), state.omega)
    return (vehicle.M * dot(state.x_dot, state.x_dot) + rotation + vehicle.m * dot(bob_velocity, bob_velocity)) / 2


def potential_energy(state: State, vehicle: Vehicle, e3: E3Direction) -> Scalar:
    """Potential energy −M⟨g⃗, x⟩ − m⟨g⃗, x + l y⟩, J; for `e3` = "down" this is the paper's (pe)."""
    moment = vehicle.M * state.x + vehicle.m * bob_position(state, vehicle)
    gravity = gravity_vector(vehicle, e3)
    return -sum(gravity[i] * (moment[i] if is_symbolic(moment) else moment[..., i]) for i in range(3))


def total_energy(state: State, vehicle: Vehicle, e3: E3Direction) -> Scalar:
    """Kinetic plus potential energy, J; `e3` as in `potential_energy`."""
    return kinetic_energy(state, vehicle.in_frame(e3)) + potential_energy(state, vehicle, e3)


def linear_momentum(state: State, vehicle: Vehicle) -> Vector:
    """Linear momentum (M+m) ẋ + m l ẏ of quadrotor and bob, world frame, kg m/s."""
    return (vehicle.M + vehicle.m) * state.x_dot + vehicle.m * vehicle.l * state.y_dot


def bob_tension(state: State, wrench: Wrench, vehicle: Vehicle) -> Scalar:
    """Tension T of the rod in `equations_of_motion`, N, between the mass M at the pivot and the point bob m."""
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    return m / (M + m) * (M * l * dot(state.y_dot, state.y_dot) - wrench.thrust * dot(state.y, state.z))


def rod_tension(state: State, wrench: Wrench, vehicle: Vehicle) -> Scalar:
    """Force along the rod, N: positive in tension (a cable would suffice), negative in compression (needs a rod).

    The vehicle's own mass M₀ and a rod that is no point bob meet at the pivot: of f z + T y, which acts on M, the mass
    M − M₀ of the rod takes its share. It leaves T − (M − M₀)/M (f y·z + T).
    """
    T = bob_tension(state, wrench, vehicle)
    if is_point(vehicle):
        return T
    return T - (1 - vehicle.mass / vehicle.M) * (wrench.thrust * dot(state.y, state.z) + T)
