"""Local coordinates of states and rotor forces, δ ∈ R^(16+n), by which plans are changed and linearised.

About a state (x, ẋ, R, ω, y, H) with H = y × ẏ, rotor forces r, and b an orthonormal basis of the plane normal to y,

    x + δ_x,  ẋ + δ_ẋ,  R c(δ_θ),  ω + δ_ω,  c(v) y with v = b δ_y,  c(v) (H + b δ_H),  r + δ_r,

where c is the Cayley transform: c(v) turns by 2 atan(|v|/2) about v. It is rational, and so is its inverse, it agrees
with the exponential up to third order, and it stays on the manifold. Only antipodal rods and attitudes half a turn
apart are no neighbours. The basis jumps where y₃ changes sign, but it belongs to one state, and nothing depends on it.
"""

from __future__ import annotations

import casadi as ca

from flypend.geometry import cross, dot, scale, vee
from flypend.model import State
from flypend.model.state import SIZE

MOTION = 16  # coordinates of a state without its rotors
POSITION, VELOCITY, ATTITUDE, SPIN, ROD, SWING = (
    slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12), slice(12, 14), slice(14, 16)
)  # fmt: skip


def retract(state: ca.SX, delta: ca.SX) -> ca.SX:
    """Return the state (24 + n, 1) with coordinates `delta` (16 + n, 1) about `state` (24 + n, 1), in CasADi."""
    s = State.symbolic(state[:SIZE])
    b = plane(s.y)
    turn = ca.mtimes(b, delta[ROD])
    y = turn_by(turn, s.y)
    H = turn_by(turn, cross(s.y, s.y_dot) + ca.mtimes(b, delta[SWING]))
    moved = State.symbolic(
        ca.vertcat(
            s.x + delta[POSITION],
            s.x_dot + delta[VELOCITY],
            ca.vec(ca.mtimes(s.R, cayley(delta[ATTITUDE])).T),
            s.omega + delta[SPIN],
            y,
            cross(H, y),
        )
    )
    return ca.vertcat(moved.packed(), state[SIZE:] + delta[MOTION:])


def local(state: ca.SX, other: ca.SX) -> ca.SX:
    """Return the coordinates (16 + n, 1) of the state `other` about `state`, both (24 + n, 1): `retract` inverted."""
    s, o = State.symbolic(state[:SIZE]), State.symbolic(other[:SIZE])
    b = plane(s.y)
    M = ca.mtimes(s.R.T, o.R)
    attitude = scale(4 / (1 + M[0, 0] + M[1, 1] + M[2, 2]), vee(M))
    turn = between(s.y, o.y)
    swing = turn_by(-turn, cross(o.y, o.y_dot)) - cross(s.y, s.y_dot)
    along = ca.mtimes(b.T, ca.horzcat(turn, swing))
    return ca.vertcat(
        o.x - s.x, o.x_dot - s.x_dot, attitude, o.omega - s.omega, along[:, 0], along[:, 1], other[SIZE:] - state[SIZE:]
    )


def between(a: ca.SX, b: ca.SX) -> ca.SX:
    """Return the vector v normal to the unit vectors `a` and `b` (3, 1) with c(v) a = b; infinite for antipodes."""
    return scale(2 / (1 + dot(a, b)), cross(a, b))


def turn_by(v: ca.SX, w: ca.SX) -> ca.SX:
    """Return c(v) w: `w` (3, 1) turned by 2 atan(|v|/2) about `v` (3, 1)."""
    across = cross(v, w)
    return w + scale(1 / (1 + dot(v, v) / 4), across + cross(v, across) / 2)


def cayley(v: ca.SX) -> ca.SX:
    """Return the rotation matrix c(v) (3, 3)."""
    return ca.horzcat(*(turn_by(v, ca.SX(column)) for column in ca.horzsplit(ca.DM.eye(3))))


def plane(y: ca.SX) -> ca.SX:
    """Return an orthonormal basis (3, 2) of the plane normal to the unit vector `y` (3, 1); right-handed with it.

    After Duff et al., Building an orthonormal basis, revisited (2017).
    """
    sign = ca.if_else(y[2] >= 0, 1, -1)
    a = -1 / (sign + y[2])
    across = y[0] * y[1] * a
    first = ca.vertcat(1 + sign * y[0] ** 2 * a, sign * across, -sign * y[0])
    return ca.horzcat(first, ca.vertcat(across, sign + y[1] ** 2 * a, -y[1]))
