"""Lemma S: one backstepping step on S², with a Lyapunov function that falls along every solution.

A unit vector φ obeys φ̈ = −|φ̇|² φ + u; the tangent force u is the input. It is to point along d(t) ∈ S², which turns
at ω_d = d × ḋ. Behind it stands an outer system with V̇_X = −Q_X + N G·(ς φ − d): the share ς of a force N along φ acts
where N d was asked for. With c = φ·d, e = d − c φ and

    ς = c + χ (1 − c),   Ψ(c) = (1 − ε)(1 − c) − 2ε ln((1 + c)/2),   g = −Ψ' = (1 − ε) + 2ε/(1 + c)
    v_* = k_e e + N (χ (G·φ) e − (1 + c) P_φ G) / (k ((1 − ε)(1 + c) + 2ε))                                   (S1)
    ζ = φ̇ − ω_d × φ − v_*                                                                                      (S2)
    u = P_φ d/dt(ω_d × φ + v_*) + (k/ρ) g e − k_w ζ                                                            (S3)

the function V = V_X + k Ψ(c) + ½ρ|ζ|² obeys, wherever φ ≠ −d,

    V̇ = −Q_X − k k_e g |e|² − ρ k_w |ζ|²                                                                       (S4)

Ψ grows without bound as φ approaches −d, so no solution gets there. docs/laws/theorem-proof.md has the proof.
"""

from __future__ import annotations

from typing import NamedTuple

import casadi as ca

from flypend.geometry import Scalar, Vector, cross, dot, scale, tangent_part


class Step(NamedTuple):
    """Gains of one step; the lemma holds for all positive ones, ε ∈ (0, 1] and χ ∈ [½, 1].

    stiffness  k/ρ, spring towards the target, 1/s²
    alignment  k_e, direct damping of the direction error, 1/s
    damping    k_w, damping of the rate error ζ, 1/s
    weight     ρ, weight of the rate error in V; k = ρ stiffness
    barrier    ε, share of the potential that grows without bound at φ = −d
    fade       χ: ς is 1 for χ = 1, and fades to 0 at φ = −d for χ = ½
    """

    stiffness: Scalar
    alignment: Scalar
    damping: Scalar
    weight: Scalar
    barrier: Scalar
    fade: Scalar = 1.0


class Aim(NamedTuple):
    """Direction error e (3, 1), its cosine c, and the rate ω_d × φ + v_* (3, 1), 1/s, that φ should have."""

    error: Vector
    cosine: Scalar
    rate: Vector


class Push(NamedTuple):
    """The force u (3, 1), 1/s², ζ (3, 1), the two terms that the step adds to V, and what it adds to V̇."""

    force: Vector
    rate_error: Vector
    potential: Scalar
    kinetic: Scalar
    decay: Scalar


def share(c: Scalar, step: Step) -> Scalar:
    """Return ς(c) = c + χ (1 − c) ≥ 0, which is 1 at c = 1."""
    return c + step.fade * (1 - c)


def aim(phi: Vector, target: Vector, turn: Vector, force: Scalar, gradient: Vector, step: Step) -> Aim:
    """Return the rate that `phi` should have, (S1): its Lie derivative is the feedforward of `push`.

    Parameters
    ----------
    phi, target : SX (3, 1)
        φ and d.
    turn : SX (3, 1)
        ω_d = d × ḋ, 1/s.
    force, gradient : SX, SX (3, 1)
        N and G of the outer system.
    step : Step
        Gains.
    """
    c = dot(phi, target)
    e = target - scale(c, phi)
    return Aim(e, c, cross(turn, phi) + desired_velocity(phi, c, e, force, gradient, step))


def desired_velocity(phi: Vector, c: Scalar, e: Vector, force: Scalar, gradient: Vector, step: Step) -> Vector:
    """Return v_* (3, 1), 1/s, (S1), at the cosine c and the error e; the others as in `aim`."""
    across = tangent_part(phi, gradient)
    weak = step.weight * step.stiffness * ((1 - step.barrier) * (1 + c) + 2 * step.barrier)
    return step.alignment * e + scale(force / weak, scale(step.fade * dot(gradient, phi), e) - scale(1 + c, across))


def barrier_slope(c: Scalar, step: Step) -> Scalar:
    """Return g(c) = −Ψ'(c)."""
    return (1 - step.barrier) + 2 * step.barrier / (1 + c)


def steering(phi: Vector, feedforward: Vector, c: Scalar, e: Vector, zeta: Vector, step: Step) -> Vector:
    """Return u (3, 1), 1/s², (S3), at the cosine c, the error e and the rate error ζ; the others as in `push`."""
    return tangent_part(phi, feedforward) + scale(step.stiffness * barrier_slope(c, step), e) - step.damping * zeta


def push(phi: Vector, phi_dot: Vector, aimed: Aim, feedforward: Vector, step: Step) -> Push:
    """Return the force u, (S3), and the terms of V and V̇, (S4).

    `phi`, `phi_dot`: φ and φ̇; `feedforward`: d/dt of `aimed.rate` along the closed loop, (3, 1), 1/s². Not
    defined at φ = −d.
    """
    e, c = aimed.error, aimed.cosine
    k, spread = step.weight * step.stiffness, 1 - step.barrier
    zeta = phi_dot - aimed.rate
    return Push(
        force=steering(phi, feedforward, c, e, zeta, step),
        rate_error=zeta,
        potential=k * (spread * (1 - c) - 2 * step.barrier * ca.log((1 + c) / 2)),
        kinetic=step.weight * dot(zeta, zeta) / 2,
        decay=-k * step.alignment * barrier_slope(c, step) * dot(e, e) - step.weight * step.damping * dot(zeta, zeta),
    )
