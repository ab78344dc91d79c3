"""Theorem B's law in coordinates in which its V is a sum of squares and of functions of norms: the chart lemma.

ξ = (e' (3), v (3), a (2), b (2), α (2), β (2)) stands for the state with

    p_ref = l e₃,   y = R(d) (a, √(1 − |a|²)),   ζ_y = R(y) (b, 0),   z = R(z_d) (α, √(1 − |α|²)),   ζ = R(z) (β, 0)

R(n) being the shortest rotation from e₃ to n. Cosines and errors are then known without cancellation,
c_y = √(1 − |a|²) and e_y = R(d) (−c_y a, |a|²), so they are symbols of their own wherever the law is differentiated:

    ċ = e·(φ̇ − ω_d × φ),   ė = ḋ − ċ φ − c φ̇

This is another reading of the law than `almost_global`, equal to it: `certified.differs` compares them. Labels are
those of docs/laws/theorem-proof.md.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import NamedTuple

import casadi as ca

from flypend.geometry import E3, Scalar, Vector, cross, dot, scale, tangent_part
from flypend.laws.almost_global_gains import axis_step, rod_step
from flypend.laws.almost_global_position import damper, spring
from flypend.laws.step import Step, share

SIZE = 14


class Chart(NamedTuple):
    """What the law does at ξ: thrust f, N; u and ż (3, 1); and the state p − p_ref, v, y, ẏ, z."""

    thrust: Scalar
    push: Vector
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
        symbols, rates = (ca.vertcat(*column) for column in zip(*self.pairs, strict=True))
        return ca.jtimes(expression, symbols, rates)

    def and_(self, *pairs: tuple[Vector, Vector]) -> _Known:
        return _Known(*self.pairs, *pairs)


def law_at(xi: Vector, k: SimpleNamespace, M: Scalar, m: Scalar, l: Scalar, g: Scalar) -> Chart:
    """Return the law with the gains `k` about hover at `xi` (14, 1), for masses (kg), rod (m) and gravity (m/s²)."""
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
    ideal = _Known((p, v), (v, fall), (y, y_dot), *_pointing(d, y, y_dot, c_y, e_y, _Known((p, v), (v, fall))))
    d_dot = _Known((p, v), (v, fall)).rate(d)
    r_y = cross(cross(d, d_dot), y) + _wanted(y, c_y, e_y, size, v, rod)  # (S1)
    u_d = _force(y, ideal.rate(r_y), c_y, e_y, zeta_y, rod)  # (S3)

    # ∂V_3/∂v at fixed p, y and ẏ, by c_y = y·d(v) and e_y = d − c_y y.
    d_v = ca.jacobian(d, v)
    c_v = ca.mtimes(d_v.T, y)
    r_v = ca.jacobian(r_y, v) + ca.mtimes(ca.jacobian(r_y, c_y), c_v.T)
    r_v += ca.mtimes(ca.jacobian(r_y, e_y), d_v - ca.mtimes(y, c_v.T))
    along_v = v - rod.weight * rod.stiffness * _slope(c_y, rod) * c_v - rod.weight * ca.mtimes(r_v.T, zeta_y)

    # Force. F·y > 0: divided by it likewise.
    carried = (M + m) * a_d + M * l * dot(y_dot, y_dot)  # (B6)
    aside = -M * l / carried * u_d
    longer = ca.sqrt(1 + dot(aside, aside))
    N, z_d = carried * longer, (y + aside) / longer
    G = scale(dot(y, along_v) / (M + m), y) - rod.weight / (M * l) * zeta_y  # (B8)
    f = N * share(c, axis)  # (B7)

    # The true rates, with f and z in them.
    v_dot = (f * dot(z, y) - M * l * dot(y_dot, y_dot)) / (M + m) * y - g * E3  # (B0)
    y_ddot = -dot(y_dot, y_dot) * y - tangent_part(y, f / (M * l) * z)  # (1)
    bob = _Known((p, v), (v, v_dot))
    pointing = _pointing(d, y, y_dot, c_y, e_y, bob)
    turning = bob.and_((y, y_dot), *pointing)
    true = turning.and_((y_dot, y_ddot), (zeta_y, y_ddot - turning.rate(r_y)))
    z_d_dot = true.rate(z_d)
    r = cross(cross(z_d, z_d_dot), z) + _wanted(z, c, e, N, G, axis)
    whole = true.and_((z, z_dot), *_pointing(z_d, z, z_dot, c, e, true))
    u = _force(z, whole.rate(r), c, e, zeta, axis)

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
        own = _turned(aim, ca.vertcat(tilt, near))
        slack = _turned(own, ca.vertcat(xi[first + 2 : first + 4], 0))
        known += [(phi, own), (cosine, near), (error, _turned(aim, ca.vertcat(-near * tilt, ca.sumsqr(tilt))))]
        known += [(off, slack), (phi_dot, at(rate) + slack)]
    return Chart(at(f), at(u), at(z_dot), at(p), at(v), at(y), at(y_dot), at(z))


def _pointing(
    target: Vector, phi: Vector, phi_dot: Vector, c: Scalar, e: Vector, known: _Known
) -> tuple[tuple[Vector, Vector], tuple[Vector, Vector]]:
    """Return c and e with their rates while the target moves as `known`."""
    moving = known.rate(target)
    c_dot = dot(e, phi_dot - cross(cross(target, moving), phi))
    return (c, c_dot), (e, moving - c_dot * phi - c * phi_dot)


def _wanted(phi: Vector, c: Scalar, e: Vector, force: Scalar, gradient: Vector, step: Step) -> Vector:
    """Return v_*, (S1)."""
    weak = step.weight * step.stiffness * ((1 - step.barrier) * (1 + c) + 2 * step.barrier)
    return step.alignment * e + force / weak * (
        step.fade * dot(gradient, phi) * e - (1 + c) * tangent_part(phi, gradient)
    )


def _slope(c: Scalar, step: Step) -> Scalar:
    """Return g(c) = −Ψ'(c)."""
    return (1 - step.barrier) + 2 * step.barrier / (1 + c)


def _force(phi: Vector, feedforward: Vector, c: Scalar, e: Vector, zeta: Vector, step: Step) -> Vector:
    """Return u, (S3)."""
    return tangent_part(phi, feedforward) + step.stiffness * _slope(c, step) * e - step.damping * zeta


def _turned(n: Vector, w: Vector) -> Vector:
    """Return R(n) `w`, R(n) being the shortest rotation from e₃ to the unit vector `n`."""
    across = cross(E3, n)
    return w + cross(across, w) + cross(across, cross(across, w)) / (1 + n[2])
