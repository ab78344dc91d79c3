"""Feedback for a simple mechanical system on S²: ∇_φ̇ φ̇ = φ̈ + |φ̇|² φ = −φ̂² u (Lemmas 1 and 2, corrected).

Every term of u is tangent to S², where −φ̂² is the identity, so each function returns the force itself. Lemma 1 is
correct as printed. Lemma 2 has e₃ in place of φ_d and φ̈ in place of φ̈_d; each is corrected where it occurs.
"""

from __future__ import annotations

from flypend.geometry import Scalar, Vector, dot, hat_squared, scale, transport, transport_derivative

# Added to (1 + cos θ)/2 in the length of a direction error. The length stays near 2 sin(θ/2) up to 14° from the
# antipode, where the error has no direction, and drops to zero there.
ANTIPODE_FLOOR = 0.014


def acceleration(phi: Vector, phi_dot: Vector, u: Vector) -> Vector:
    """Return φ̈ = u − |φ̇|² φ of the system (SMSS2) at `phi` (..., 3), `phi_dot` under the tangent force `u`."""
    return u - scale(dot(phi_dot, phi_dot), phi)


def regulation(phi: Vector, phi_dot: Vector, target: Vector, k_p: Scalar, k_d: Scalar) -> Vector:
    """Lemma 1: tangent force −k_p φ̂² target − k_d φ̇, which makes the unit vector `target` asymptotically stable.

    `phi`, `phi_dot`, `target`: (..., 3); `k_p` (1/s²) and `k_d` (1/s) positive.
    """
    return -k_p * hat_squared(phi, target) - k_d * phi_dot


def velocity_error(phi: Vector, phi_dot: Vector, phi_d: Vector, phi_d_dot: Vector) -> Vector:
    """Return v_e = φ̇ − τ(φ, φ_d) φ̇_d, tangent to S² at `phi`. Arguments are φ, φ̇, φ_d and φ̇_d, each (..., 3)."""
    return phi_dot - transport(phi, phi_d, phi_d_dot)


def tracking(
    phi: Vector, phi_dot: Vector, phi_d: Vector, phi_d_dot: Vector, phi_d_ddot: Vector, k_p: Scalar, k_d: Scalar
) -> Vector:
    """Lemma 2: tangent force −k_p φ̂² φ_d − k_d v_e + ∇_φ̇(τ φ̇_d), under which φ(t) tracks φ_d(t).

    `phi`, `phi_dot`: (..., 3); `phi_d`, `phi_d_dot`, `phi_d_ddot`: the reference and its derivatives; `k_p` (1/s²) and
    `k_d` (1/s) positive.
    """
    v_e = velocity_error(phi, phi_dot, phi_d, phi_d_dot)
    feedforward = transport_derivative(phi, phi_dot, phi_d, phi_d_dot, phi_d_ddot)  # (ureqd1) with φ̈_d, not φ̈
    return -k_p * hat_squared(phi, phi_d) - k_d * v_e + feedforward  # (ureqd1) with φ_d, not e₃
