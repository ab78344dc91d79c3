"""The outer loop of Theorem B: what pulls the bob to its reference, (B1), and what brakes it, (B2)."""

from __future__ import annotations

from types import SimpleNamespace

import casadi as ca

from flypend.geometry import Scalar, Vector


def spring(e: Vector, k: SimpleNamespace) -> tuple[Scalar, Vector]:
    """Return U, m²/s², and σ_p = ∇U (3, 1), m/s², at position error `e` of the bob, m: (B1)."""
    sheared = ca.vertcat(e[0] + k.shear * e[2], e[1], e[2])
    L, L_z = k.position_reach, k.height_reach
    level = ca.sqrt(1 + (sheared[0] ** 2 + sheared[1] ** 2) / L**2)
    upright = ca.sqrt(1 + sheared[2] ** 2 / L_z**2)
    U = k.position_stiffness * L**2 * (level - 1) + k.height_stiffness * L_z**2 * (upright - 1)
    pull = k.position_stiffness / level * sheared[:2]
    lift = k.height_stiffness / upright * sheared[2]
    return U, ca.vertcat(pull, lift + k.shear * pull[0])


def damper(v: Vector, k: SimpleNamespace) -> Vector:
    """Return σ_v (3, 1), m/s², at velocity error `v` of the bob, m/s: σ_v·v > 0 for v ≠ 0. (B2)."""
    level = k.position_damping / ca.sqrt(1 + (v[0] ** 2 + v[1] ** 2) / k.position_speed**2) * v[:2]
    upright = k.height_damping / ca.sqrt(1 + v[2] ** 2 / k.height_speed**2) * v[2]
    b = k.fall_speed
    return ca.vertcat(level, upright + k.fall_damping * (v[2] + b - ca.sqrt(v[2] ** 2 + b**2)))
