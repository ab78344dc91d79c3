"""Geometry of S² and SO(3), written once for NumPy arrays and CasADi expressions.

Conventions
-----------
A *vector* is a NumPy array of shape (..., 3) or a CasADi expression of shape (3, 1); a batch of B vectors is
(B, 3) in both (leading batch axis). A *matrix* is a NumPy array of shape (..., 3, 3) or a single CasADi
expression of shape (3, 3): CasADi has no third axis, so batches of matrices exist in NumPy only.

`Numbers` are an array or an expression of any other shape, which is told where they are used: packed states (..., 24),
rotor forces (n,), covariances.

S² has no identity element and no composition; only its embedding in R³ is used.
"""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

Vector = Any
Matrix = Any
Scalar = Any
Numbers = Any

E1 = np.array([1.0, 0.0, 0.0])
E2 = np.array([0.0, 1.0, 0.0])
E3 = np.array([0.0, 0.0, 1.0])
LEAST_SQUARE = 1e-30  # its root is roundoff beside 1


def is_symbolic(value: Any) -> bool:
    """True if `value` is a CasADi expression (SX, MX or DM) and not a NumPy array."""
    return isinstance(value, ca.SX | ca.MX | ca.DM)


def _components(v: Vector) -> tuple[Scalar, Scalar, Scalar]:
    """Return the three components of a vector, each with the batch shape."""
    if not is_symbolic(v):
        array = np.asarray(v, dtype=float)
        if array.shape[-1:] != (3,):
            raise ValueError(f"expected a vector of shape (..., 3), got {array.shape}")
        return array[..., 0], array[..., 1], array[..., 2]
    if v.shape == (3, 1):
        return v[0], v[1], v[2]
    if v.shape[1] == 3:
        return v[:, 0], v[:, 1], v[:, 2]
    raise ValueError(f"expected a CasADi vector of shape (3, 1) or (B, 3), got {v.shape}")


def _vector(a: Scalar, b: Scalar, c: Scalar, batched: bool) -> Vector:
    """Stack three components. For CasADi expressions, `batched` selects (B, 3) instead of (3, 1)."""
    if any(is_symbolic(component) for component in (a, b, c)):
        return ca.horzcat(a, b, c) if batched else ca.vertcat(a, b, c)
    return np.stack(np.broadcast_arrays(a, b, c), axis=-1)


def _is_batch(*vectors: Vector) -> bool:
    """Whether the CasADi vectors are a batch. A NumPy operand beside CasADi must be a single vector of shape (3,)."""
    symbolic = [v for v in vectors if is_symbolic(v)]
    if symbolic and any(np.ndim(v) > 1 for v in vectors if not is_symbolic(v)):
        raise ValueError("cannot mix a NumPy batch with a CasADi expression; pass it as a CasADi batch (B, 3)")
    return any(v.shape[1] == 3 for v in symbolic)


def _sqrt(value: Scalar) -> Scalar:
    return ca.sqrt(value) if is_symbolic(value) else np.sqrt(value)


def clip(value: Numbers, low: Numbers, high: Numbers) -> Numbers:
    """`value` within `low` and `high`, entry by entry."""
    if any(map(is_symbolic, (value, low, high))):
        return ca.fmin(ca.fmax(value, low), high)
    return np.minimum(np.maximum(value, low), high)


def dot(a: Vector, b: Vector) -> Scalar:
    """Inner product ⟨a, b⟩ over the last axis, with the batch shape (in CasADi a scalar or a (B, 1) column)."""
    (a1, a2, a3), (b1, b2, b3) = _components(a), _components(b)
    return a1 * b1 + a2 * b2 + a3 * b3


def norm(a: Vector) -> Scalar:
    """Euclidean length of `a`; not differentiable at 0 (see `smooth_norm`)."""
    return _sqrt(dot(a, a))


def smooth_norm(a: Vector, floor: float) -> Scalar:
    """√(|a|² + floor²): the length of `a`, differentiable everywhere for floor > 0 and never below `floor`."""
    return _sqrt(dot(a, a) + floor**2)


def differentiable_root(square: Scalar) -> Scalar:
    """√`square` for a number ≥ 0, in CasADi, with a derivative also at 0: it is flat below `LEAST_SQUARE`."""
    return ca.sqrt(ca.fmax(square, LEAST_SQUARE))


def scale(s: Scalar, v: Vector) -> Vector:
    """Scalar times vector with leading batch axes: `s` has the batch shape, `v` has one more axis."""
    v1, v2, v3 = _components(v)
    return _vector(s * v1, s * v2, s * v3, _is_batch(v))


def cross(a: Vector, b: Vector) -> Vector:
    """Vector product a × b."""
    (a1, a2, a3), (b1, b2, b3) = _components(a), _components(b)
    return _vector(a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1, _is_batch(a, b))


def unit(a: Vector) -> Vector:
    """a / |a|, the projection of R³ without the origin onto S²; NaN at 0."""
    return scale(1 / norm(a), a)


def shorten(v: Vector, most: Scalar) -> Vector:
    """`v`, or where it is longer than `most`, the vector of that length along it."""
    excess = norm(v) / most
    return scale(1 / (ca.fmax(1, excess) if is_symbolic(excess) else np.fmax(1, excess)), v)


def hat(v: Vector) -> Matrix:
    """Skew-symmetric matrix v̂ with v̂ w = v × w, shape (..., 3, 3)."""
    v1, v2, v3 = _components(v)
    if is_symbolic(v):
        if _is_batch(v):
            raise ValueError("hat of a CasADi expression takes one vector of shape (3, 1), not a batch")
        return ca.vertcat(ca.horzcat(0, -v3, v2), ca.horzcat(v3, 0, -v1), ca.horzcat(-v2, v1, 0))
    zero = np.zeros_like(v1)
    rows = [[zero, -v3, v2], [v3, zero, -v1], [-v2, v1, zero]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def vee(m: Matrix) -> Vector:
    """Inverse of `hat`; uses the skew-symmetric part of `m`."""
    if is_symbolic(m):
        return ca.vertcat(m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]) / 2
    m = np.asarray(m, dtype=float)
    entries = (m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0], m[..., 1, 0] - m[..., 0, 1])
    return np.stack(entries, axis=-1) / 2


def hat_squared(y: Vector, v: Vector) -> Vector:
    """ŷ² v = y × (y × v): for unit y, minus the part of v tangent to S² at y.

    Not written as y(y·v) − v: off the sphere, that form makes |y| unstable near the inverted pose.
    """
    return cross(y, cross(y, v))


def tangent_part(y: Vector, v: Vector) -> Vector:
    """P_y v = v − (y·v) y, the part of v tangent to S² at the unit vector y. Dynamics use `hat_squared` instead."""
    return v - scale(dot(y, v), y)


def apply(m: Matrix, v: Vector) -> Vector:
    """Matrix times vector with leading batch axes."""
    if is_symbolic(m) or is_symbolic(v):
        return ca.mtimes(m, v.T).T if is_symbolic(v) and v.shape[1] == 3 else ca.mtimes(m, v)
    return np.einsum("...ij,...j->...i", np.asarray(m, dtype=float), np.asarray(v, dtype=float))


def transpose(m: Matrix) -> Matrix:
    """mᵀ, with leading batch axes."""
    return m.T if is_symbolic(m) else np.swapaxes(m, -1, -2)


def transport(phi: Vector, phi_d: Vector, phi_d_dot: Vector) -> Vector:
    """Transport map τ(φ, φ_d) φ̇_d = (φ_d × φ̇_d) × φ from T_{φ_d}S² to T_φS² (Lemma 2)."""
    return cross(cross(phi_d, phi_d_dot), phi)


def transport_derivative(phi: Vector, phi_dot: Vector, phi_d: Vector, phi_d_dot: Vector, phi_d_ddot: Vector) -> Vector:
    """Covariant derivative ∇_φ̇ (τ(φ, φ_d) φ̇_d) along φ(t), φ_d(t): the feedforward of Lemma 2.

    Equal to ⟨φ, φ_d × φ̇_d⟩ (φ × φ̇) + (φ_d × φ̈_d) × φ. The paper misprints φ̈_d as φ̈.
    """
    omega_d = cross(phi_d, phi_d_dot)
    return scale(dot(phi, omega_d), cross(phi, phi_dot)) + cross(cross(phi_d, phi_d_ddot), phi)


def parallel_transport(b: Vector, y: Vector, y_after: Vector) -> Vector:
    """The tangent vector `b` at the unit vector `y` carried to `y_after` by the shortest rotation between the two."""
    return b - scale(dot(b, y_after) / (1 + dot(y, y_after)), y + y_after)


def any_tangent(y: Vector) -> Vector:
    """Some unit vector tangent to S² at the unit vector y: closest to the first axis, near that to the second."""
    y_1, *_ = _components(y)
    first = 1.0 * (y_1**2 < 0.5)
    return unit(tangent_part(y, _vector(first, 1 - first, 0 * first, _is_batch(y))))


def project_tangent(y: Vector, v: Vector) -> Vector:
    """Orthogonal projection of v onto the plane normal to y, which need not be a unit vector."""
    return v - scale(dot(y, v) / dot(y, y), y)


def project_rotation(m: Matrix) -> Matrix:
    """Nearest rotation to each matrix of shape (..., 3, 3) in the Frobenius norm (NumPy only).

    Raises `numpy.linalg.LinAlgError` if a matrix contains NaN or infinity.
    """
    u, _, vt = np.linalg.svd(np.asarray(m, dtype=float))
    sign = np.linalg.det(u @ vt)
    u = np.concatenate([u[..., :2], u[..., 2:] * np.asarray(sign)[..., None, None]], axis=-1)
    return u @ vt


def polar_step(m: Matrix) -> Matrix:
    """Matrices (..., 3, 3) after one Newton step m(3 − mᵀm)/2 towards their nearest rotations, close by.

    It squares the error: 1e-8 becomes 1e-16.
    """
    eye = ca.DM.eye(3) if is_symbolic(m) else np.eye(3)
    return m @ (3 * eye - transpose(m) @ m) / 2


def rotation_defect(m: Matrix) -> Scalar:
    """Distance of matrices (..., 3, 3) from SO(3): Frobenius norm of mᵀm − 1, and at least 2 unless det m > 0.

    Infinite where numbers are too large for a square, or none.
    """
    m = np.asarray(m, dtype=float)
    with np.errstate(over="ignore", invalid="ignore"):
        defect = np.linalg.norm(transpose(m) @ m - np.eye(3), axis=(-2, -1))
    defect = np.where(np.isnan(defect), np.inf, defect)
    near = np.where((defect < 2)[..., None, None], m, np.eye(3))  # whose products cannot overflow
    # Not LAPACK's determinant, which divides by pivots, and warns where these are denormal.
    turned = np.sum(np.cross(near[..., 0, :], near[..., 1, :]) * near[..., 2, :], axis=-1) > 0
    return np.where(turned, defect, np.maximum(defect, 2.0))


def rotation_from_quat_xyzw(quat_xyzw: Numbers) -> Matrix:
    """Rotation matrices (..., 3, 3) of quaternions `quat_xyzw` (..., 4), order x, y, z, w, normalised on input.

    In CasADi that of one quaternion (4, 1).
    """
    if is_symbolic(quat_xyzw):
        q = quat_xyzw / ca.norm_2(quat_xyzw)
        v, w = q[:3], q[3]
    else:
        q = np.asarray(quat_xyzw, dtype=float)
        q = q / np.linalg.norm(q, axis=-1, keepdims=True)
        v, w = q[..., :3], q[..., 3, None, None]
    skew = hat(v)
    return np.eye(3) + 2 * w * skew + 2 * skew @ skew


def rotation_from_vector(vector: Vector) -> Matrix:
    """Rotation matrix (3, 3) of the rotation vector `vector` (3,), rad: exp(v̂)."""
    v = np.asarray(vector, dtype=float)
    half = np.linalg.norm(v) / 2
    return rotation_from_quat_xyzw(np.append(np.sinc(half / np.pi) / 2 * v, np.cos(half)))


def quat_xyzw_from_rotation(m: Matrix) -> Numbers:
    """Unit quaternions (..., 4), order x, y, z, w, of rotation matrices `m` (..., 3, 3); the largest entry is > 0."""
    m = np.asarray(m, dtype=float)
    i = range(3)
    four_q_q = np.empty((*m.shape[:-2], 4, 4))  # 4 q qᵀ: every column is parallel to q; take the largest
    four_q_q[..., :3, :3] = m + transpose(m)
    trace = np.trace(m, axis1=-2, axis2=-1)
    four_q_q[..., i, i] += (1 - trace)[..., None]
    four_q_q[..., 3, :3] = four_q_q[..., :3, 3] = vee(m - transpose(m))
    four_q_q[..., 3, 3] = 1 + trace
    largest = np.argmax(np.diagonal(four_q_q, axis1=-2, axis2=-1), axis=-1)
    column = np.take_along_axis(four_q_q, largest[..., None, None], axis=-1)[..., 0]
    return column / np.linalg.norm(column, axis=-1, keepdims=True)


def random_sphere(rng: np.random.Generator, size: tuple[int, ...] = ()) -> Vector:
    """Unit vectors uniform on S², shape (*size, 3), drawn from `rng`."""
    return unit(rng.standard_normal((*size, 3)))


def random_rotation(rng: np.random.Generator, size: tuple[int, ...] = ()) -> Matrix:
    """Rotations uniform on SO(3) (Haar measure), shape (*size, 3, 3), drawn from `rng`."""
    return rotation_from_quat_xyzw(rng.standard_normal((*size, 4)))


def random_tangent(rng: np.random.Generator, y: Vector, max_length: float) -> Vector:
    """Tangent vectors at the unit vectors y (..., 3), uniform in a disc of radius `max_length`, drawn from `rng`."""
    y = np.asarray(y, dtype=float)
    direction = unit(project_tangent(y, rng.standard_normal(y.shape)))
    return scale(max_length * np.sqrt(rng.random(y.shape[:-1])), direction)
