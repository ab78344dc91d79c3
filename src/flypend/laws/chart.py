"""Theorem B's law in coordinates in which its V is a sum of squares and of functions of norms: the chart lemma.

ξ = (e' (3), v (3), a (2), b (2), α (2), β (2)) stands for the state with

    p_ref = l e₃,   y = R(d) (a, √(1 − |a|²)),   ζ_y = R(y) (b, 0),   z = R(z_d) (α, √(1 − |α|²)),   ζ = R(z) (β, 0)

R(n) being the shortest rotation from e₃ to n. Cosines and errors are then known without cancellation,
c_y = √(1 − |a|²) and e_y = R(d) (−c_y a, |a|²), so they are symbols of their own wherever the law is differentiated:

    ċ = e·(φ̇ − ω_d × φ),   ė = ḋ − ċ φ − c φ̇

Through a lag ξ goes on with the errors of what acts: η_f, and h (2) with η_u = R(z) (h, 0).

This is another reading of `almost_global` and `almost_global_lag`, equal to them: `certified.differs` compares them.
Labels are those of docs/laws/theorem-proof.md.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, NamedTuple

import casadi as ca

from flypend.geometry import E3, Scalar, Vector, cross, dot, scale, tangent_part
from flypend.laws.almost_global_gains import axis_step, damper, rod_step, spring
from flypend.laws.step import barrier_slope, desired_velocity, share, steering
from flypend.model.momenta import carrying_force

SIZE, LAGGED = 14, 17  # coordinates without and through a lag


class Chart(NamedTuple):
    """What the law does at ξ: thrust f, N; u and ż (3, 1); and the state p − p_ref, v, y, ẏ, z.

    `wrenches` are (f, u), each (4, 1): the one commanded, and through a lag the one that acts.
    """

    wrenches: tuple[Vector, ...]
    axis_rate: Vector
    bob: Vector
    bob_rate: Vector
    rod: Vector
    rod_rate: Vector
    axis: Vector


class _Known:
    """Symbols with their rates: what is differentiated."""

    def __init__(self, *pairs: tuple[Vector, Vector]) -> None:
        self.pairs = pairs

    def rate(self, expression: Vector) -> Vector:
        """Return the rate of `expression`."""
        symbols, rates = (ca.vertcat(*column) for column in zip(*self.pairs, strict=True))
        return ca.jtimes(expression, symbols, rates)

    def and_(self, *pairs: tuple[Vector, Vector]) -> _Known:
        """Return these and more."""
        return _Known(*self.pairs, *pairs)


def law_at(
    xi: Vector, k: SimpleNamespace, M: Scalar, m: Scalar, l: Scalar, g: Scalar, lag: Scalar | None = None
) -> Chart:
    """Return the law with the gains `k` about hover at `xi`, for masses (kg), rod (m), gravity (m/s²) and a lag (s).

    `xi` is (14, 1), or through a `lag` (17, 1).
    """
    p, v, y, y_dot, z, z_dot = (ca.SX.sym(name, 3) for name in ("p", "v", "y", "y_dot", "z", "z_dot"))
    c_y, e_y, zeta_y = ca.SX.sym("c_y"), ca.SX.sym("e_y", 3), ca.SX.sym("zeta_y", 3)
    c, e, zeta = ca.SX.sym("c"), ca.SX.sym("e", 3), ca.SX.sym("zeta", 3)
    rod, axis = rod_step(k), axis_step(k)

    # Position and rod. A₃ > 0: dividing by it, and not by |A|, loses less.
    A = g * E3 - spring(p, k)[1] - damper(v, k)  # (B3)
    slope = A[:2] / A[2]
    steep = ca.sqrt(1 + ca.sumsqr(slope))
    size, d = A[2] * steep, ca.vertcat(slope, 1) / steep
    a_d = size * share(c_y, rod)  # (B4)
    fall = a_d * y - g * E3
    falling = _Known((p, v), (v, fall))
    ideal = falling.and_((y, y_dot), *_pointing(d, y, y_dot, c_y, e_y, falling))
    r_y = cross(cross(d, falling.rate(d)), y) + desired_velocity(y, c_y, e_y, size, v, rod)  # (S1)
    u_d = steering(y, ideal.rate(r_y), c_y, e_y, zeta_y, rod)  # (S3)

    # ∂V_3/∂v at fixed p, y and ẏ, by c_y = y·d(v) and e_y = d − c_y y.
    d_v = ca.jacobian(d, v)
    c_v = ca.mtimes(d_v.T, y)
    r_v = ca.jacobian(r_y, v) + ca.mtimes(ca.jacobian(r_y, c_y), c_v.T)
    r_v += ca.mtimes(ca.jacobian(r_y, e_y), d_v - ca.mtimes(y, c_v.T))
    along_v = v - rod.weight * rod.stiffness * barrier_slope(c_y, rod) * c_v - rod.weight * ca.mtimes(r_v.T, zeta_y)

    # Force. F·y > 0: divided by it likewise.
    body: Any = SimpleNamespace(M=M, m=m, l=l)
    carried = carrying_force(a_d, y_dot, body)  # (B6)
    aside = -M * l / carried * u_d
    longer = ca.sqrt(1 + dot(aside, aside))
    N, z_d = carried * longer, (y + aside) / longer
    G = scale(dot(y, along_v) / (M + m), y) - rod.weight / (M * l) * zeta_y  # (B8)
    f = N * share(c, axis)  # (B7)

    def moving(v_rate: Vector, y_ddot: Vector, places: float = 1.0) -> tuple[_Known, _Known]:
        """Return what moves, before and after z_d is known; 0 for `places` holds p, y and z."""
        bob, y_rate, z_rate = _Known((p, places * v), (v, v_rate)), places * y_dot, places * z_dot
        turning = bob.and_((y, y_rate), *_pointing(d, y, y_rate, c_y, e_y, bob))
        true = turning.and_((y_dot, y_ddot), (zeta_y, y_ddot - turning.rate(r_y)))
        return true, true.and_((z, z_rate), *_pointing(z_d, z, z_rate, c, e, true))

    def pushed(thrust: Scalar) -> tuple[Vector, Vector]:
        """Return v̇ + g e₃ and ÿ that `thrust` alone gives: (B0) and (1)."""
        return thrust * dot(z, y) / (M + m) * y, -tangent_part(y, thrust / (M * l) * z)

    def flown(thrust: Scalar) -> tuple[_Known, _Known]:
        """Return what moves along the true motion under the `thrust` that acts."""
        forth, round_ = pushed(thrust)
        spin = dot(y_dot, y_dot)
        return moving(forth - M * l * spin / (M + m) * y - g * E3, round_ - spin * y)

    true, whole = flown(f)
    r = cross(cross(z_d, true.rate(z_d)), z) + desired_velocity(z, c, e, N, G, axis)
    u = steering(z, whole.rate(r), c, e, zeta, axis)
    wrenches, off_f, off_u = [ca.vertcat(f, u)], ca.SX.sym("eta_f"), ca.SX.sym("eta_u", 3)
    if lag is not None:
        f_a, u_a = ca.SX.sym("f_a"), ca.SX.sym("u_a", 3)
        z_ddot, (_, before) = u_a - dot(z_dot, z_dot) * z, flown(f_a)
        acted = before.and_((z_dot, z_ddot), (zeta, z_ddot - before.rate(r)))
        # Γ_f, (D4), is the rate of V while v and ẏ alone move, as one newton moves them.
        kick = pushed(1.0)
        _, kicked = moving(*kick, places=0.0)
        gamma_f = dot(v, kick[0]) + rod.weight * dot(zeta_y, kicked.rate(zeta_y))
        gamma_f -= axis.weight * dot(zeta, kicked.rate(r))
        for cosine, step in ((c_y, rod), (c, axis)):
            gamma_f -= step.weight * step.stiffness * barrier_slope(cosine, step) * kicked.rate(cosine)
        f_next = acted.rate(f) - k.wrench_damping * off_f - gamma_f / k.thrust_weight
        u_next = tangent_part(z, acted.rate(u)) - k.wrench_damping * off_u - axis.weight / k.moment_weight * zeta
        wrenches = [ca.vertcat(f_a + lag * f_next, u_a + lag * u_next), ca.vertcat(f_a, u_a)]  # (D1)

    # The chart, from the position inwards.
    own_p = ca.vertcat(xi[0] - k.shear * xi[2], xi[1], xi[2])
    known = [(p, own_p), (v, xi[3:6])]

    def at(expression: Vector) -> Vector:
        symbols, values = zip(*known, strict=True)
        return ca.substitute(expression, ca.vertcat(*symbols), ca.vertcat(*values))

    for phi, phi_dot, target, rate, cosine, error, off, first in (
        (y, y_dot, d, r_y, c_y, e_y, zeta_y, 6),
        (z, z_dot, z_d, r, c, e, zeta, 10),
    ):
        aim, tilt = at(target), xi[first : first + 2]
        near = ca.sqrt(1 - ca.sumsqr(tilt))
        own = _turn(aim, ca.vertcat(tilt, near))
        slack = _turn(own, ca.vertcat(xi[first + 2 : first + 4], 0))
        known += [(phi, own), (cosine, near), (error, _turn(aim, ca.vertcat(-near * tilt, ca.sumsqr(tilt))))]
        known += [(off, slack), (phi_dot, at(rate) + slack)]
    if lag is not None:
        own = ca.vertcat(xi[SIZE], _turn(at(z), ca.vertcat(xi[SIZE + 1 :], 0)))
        known += [(ca.vertcat(off_f, off_u), own), (ca.vertcat(f_a, u_a), at(ca.vertcat(f, u)) + own)]
    return Chart(tuple(map(at, wrenches)), at(z_dot), at(p), at(v), at(y), at(y_dot), at(z))


def _pointing(
    target: Vector, phi: Vector, phi_dot: Vector, c: Scalar, e: Vector, known: _Known
) -> tuple[tuple[Vector, Vector], tuple[Vector, Vector]]:
    """Return c and e with their rates while the target moves as `known`."""
    moving = known.rate(target)
    c_dot = dot(e, phi_dot - cross(cross(target, moving), phi))
    return (c, c_dot), (e, moving - c_dot * phi - c * phi_dot)


def _turn(n: Vector, w: Vector) -> Vector:
    """Return R(n) `w`, R(n) being the shortest rotation from e₃ to the unit vector `n`."""
    across = cross(E3, n)
    return w + cross(across, w) + cross(across, cross(across, w)) / (1 + n[2])
