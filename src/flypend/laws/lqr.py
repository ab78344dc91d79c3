"""The linear-quadratic regulator about inverted hover: a baseline after Hehn and D'Andrea (2011), on the full model.

Hehn and D'Andrea regulate position, rod and body rates of a linear model about hover. Here the wrench is the input,
and the model is the linearisation on the tangent space of R³ × SO(3) × S² (`flypend.laws.linearise`),

    ξ̇ = A ξ + B (δf, δτ),    wrench = wrench_ref − K ξ,    K = R⁻¹ Bᵀ P,    Aᵀ P + P A − P B R⁻¹ Bᵀ P + Q = 0,

with Q and R the inverse squares of the largest acceptable deviations (Bryson's rule). Nothing makes it
work far from hover; it serves to show that.
"""

from __future__ import annotations

from functools import lru_cache
from types import SimpleNamespace
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.geometry import E3, Numbers, Scalar, Vector, apply, cross, dot, is_symbolic, norm, scale, unit
from flypend.laws.bound import Control
from flypend.laws.gain import POSITIVE, Gain, check_gravity, document_gains, table
from flypend.laws.law import Law
from flypend.laws.linearise import COORDINATES, SYMMETRIES, open_loop
from flypend.laws.references import Path, Reference, hover
from flypend.laws.sphere import ANTIPODE_FLOOR
from flypend.laws.throw import bob_path, derivatives
from flypend.model import State, Vehicle, Wrench

Matrix = NDArray[np.float64]

ENTRIES = [
    (f"K_{i}_{j}", i, j) for i in range(4) for j, coordinate in enumerate(COORDINATES) if coordinate not in SYMMETRIES
]


def _deviation(name: str, default: float, unit: str, doc: str, label: str) -> Gain:
    """Return the gain that is the largest acceptable deviation of this name, in `unit`."""
    return Gain(name, default, unit, f"Largest acceptable {doc}", POSITIVE, label=label)


GAINS = table(
    (
        _deviation("position_error", 0.8, "m", "error of the pivot along each axis", "position error"),
        _deviation("velocity_error", 5.0, "m/s", "velocity of the pivot along each axis", "velocity error"),
        _deviation("attitude_error", 0.8, "rad", "angle of the thrust axis; the heading is free", "attitude error"),
        _deviation("rate_error", 0.6, "rad/s", "angular velocity", "rate error"),
        _deviation("rod_error", 0.06, "rad", "angle of the rod", "rod error"),
        _deviation("rod_rate_error", 0.5, "rad/s", "rate of the rod", "rod rate error"),
        _deviation("thrust_deviation", 0.15, "weights", "deviation of the thrust from the weight", "thrust"),
        _deviation(
            "moment_deviation", 0.15, "weights × arm",
            "moment: of roll and pitch in weights times the distance of the rotors, of yaw times the drag ratio",
            "moment",
        ),
    )
)  # fmt: skip


@errors.named_arguments
@document_gains(GAINS)
def lqr(reference: Reference | None = None, **gains: float) -> Law:
    """Build the linear-quadratic regulator; its weights are the inverse squares of the largest acceptable deviations.

    Only their ratios matter. For the errors ξ of a state far from hover, see `errors_of`.
    """
    followed = reference or hover()
    return Law(
        name="lqr", e3="up", gains=GAINS, given=gains, control=lqr_control, reference=followed, path=bob_path(followed),
        prepare=lambda vehicle, given: {"K": gain_matrix(vehicle, given)},
    )  # fmt: skip


def by_matrix(K: Numbers) -> Law:
    """Build the regulator about hover at the origin with gain matrix `K` (4, 16); its gains are the entries K_i_j.

    They may vary from run to run. The column of the heading is zero and not among the gains.
    """
    followed = hover()

    def control(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, *, path: Path) -> Control:
        """The regulator with the matrix that the gains K_i_j make."""
        matrix = ca.SX.zeros(4, len(COORDINATES))
        for name, i, j in ENTRIES:
            matrix[i, j] = getattr(k, name)
        return lqr_control(t, state, vehicle, SimpleNamespace(K=matrix), path=path)

    gains = [Gain(name, value, doc="Entry of the gain matrix, SI units") for name, value in entries(K).items()]
    return Law(name="lqr", e3="up", gains=gains, control=control, reference=followed, path=bob_path(followed))


def entries(K: Numbers) -> dict[str, float]:
    """Return the entries of `K` (4, 16) by name, without the column of the heading."""
    return {name: float(K[i, j]) for name, i, j in ENTRIES}


def gain_matrix(vehicle: Vehicle, deviations: Any) -> Numbers:
    """Return K (4, 16) of `vehicle` about inverted hover for the `deviations` of `lqr`; its heading column is zero."""
    check_gravity(vehicle)
    A, B = _about_hover(vehicle)
    Q, R = weights(vehicle, deviations)
    keep = [i for i, name in enumerate(COORDINATES) if name not in SYMMETRIES]
    A, B = A[np.ix_(keep, keep)], B[keep]
    P = solve_riccati(A, B, Q[np.ix_(keep, keep)], R)
    K = np.zeros((4, len(COORDINATES)))
    K[:, keep] = np.linalg.solve(R, B.T @ P)
    return _round(K)


def _round(K: Matrix) -> Matrix:
    """Round each row of `K` to 2⁻³⁰ of its largest entry: roundoff differs with BLAS and with its number of threads.

    Otherwise the workers of a sweep, and the cache of kernels, would know as many laws.
    """
    unit = np.exp2(np.ceil(np.log2(np.max(np.abs(K), axis=1, keepdims=True))) - 30)
    rounded: Matrix = np.round(K / unit) * unit + 0.0  # no zero is negative
    return rounded


def solve_riccati(A: Matrix, B: Matrix, Q: Matrix, R: Matrix) -> Matrix:
    """Return the stabilising P (n, n) of AᵀP + P A − P B R⁻¹Bᵀ P + Q = 0, for A (n, n), B (n, k), Q (n, n), R (k, k).

    P comes from the stable invariant subspace of the Hamiltonian matrix. Two Kleinman iterations, each a Lyapunov
    equation, refine it from the accuracy of the eigenvectors to roundoff.
    """
    n, G = len(A), B @ np.linalg.solve(R, B.T)
    values, vectors = np.linalg.eig(np.block([[A, -G], [-Q, -A.T]]))
    stable = vectors[:, np.argsort(values.real)[:n]]
    P = np.linalg.solve(stable[:n].T, stable[n:].T).T.real
    for _ in range(2):
        closed, one = A - G @ P, np.eye(n)  # closedᵀ P + P closed = −(Q + P G P)
        P = np.linalg.solve(np.kron(one, closed.T) + np.kron(closed.T, one), -(Q + P @ G @ P).ravel()).reshape(n, n)
        P = (P + P.T) / 2
    return P


@lru_cache(maxsize=16)
def _about_hover(vehicle: Vehicle) -> tuple[Numbers, Numbers]:
    return open_loop(vehicle, "up", State(y=E3), Wrench(vehicle.weight, np.zeros(3)))


def weights(vehicle: Vehicle, deviations: Any) -> tuple[Numbers, Numbers]:
    """Return Q (16, 16) and R (4, 4) of `vehicle` for the `deviations` of `lqr`, by Bryson's rule."""
    d = deviations
    state = [
        *[d["position_error"]] * 3, *[d["velocity_error"]] * 3, *[d["attitude_error"]] * 3, *[d["rate_error"]] * 3,
        *[d["rod_error"]] * 2, *[d["rod_rate_error"]] * 2,
    ]  # fmt: skip
    arm = np.sqrt(np.mean(np.sum(vehicle.rotor_positions[:, :2] ** 2, axis=1)))
    levers = np.array([arm, arm, vehicle.drag_ratio])
    wrench = vehicle.weight * np.array([d["thrust_deviation"], *d["moment_deviation"] * levers])
    return np.diag(1 / np.array(state) ** 2), np.diag(1 / wrench**2)


def lqr_control(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, *, path: Path) -> Control:
    """Evaluate the law with gain matrix `k.K` (4, 16) for symbols `t` (s) and `state` of `vehicle`, along `path`.

    The reference wrench is the one that moves rod and vehicle along the path; in hover it is the weight.
    """
    x_ref, v_ref, y_ref, z_ref, f_ref = flat_reference(t, path, vehicle)
    y_ref_dot = ca.jacobian(y_ref, t)
    turn = cross(z_ref, ca.jacobian(z_ref, t))  # angular velocity of z_ref, world frame
    omega_ref, alpha_ref = apply(state.R.T, turn), apply(state.R.T, ca.jacobian(turn, t))

    xi = errors_of(state, x_ref, v_ref, z_ref, omega_ref, y_ref, y_ref_dot)
    change = ca.mtimes(k.K if is_symbolic(k.K) else ca.DM(k.K), xi)
    thrust = ca.fmax(f_ref - change[0], 0)
    moment = apply(vehicle.I, alpha_ref) - change[1:]
    return Control(
        wrench=Wrench(thrust, moment),
        signals={"rod_error": norm(state.y - y_ref), "axis_error": norm(state.z - z_ref)},
    )


def errors_of(
    state: State, x_ref: Vector, v_ref: Vector, z_ref: Vector, omega_ref: Vector, y_ref: Vector, y_ref_dot: Vector
) -> Numbers:
    """Return ξ (16, 1) of any `state` about a reference near inverted hover; smooth, and independent of the heading.

    With h(e) the first two components of Rᵀ(e₁, e₂, 0), the horizontal part of e in the body frame,

        ξ_x = (h(e), e₃) of e = x − x_ref,     ξ_y = √((1 + ε)/((1 + y·y_ref)/2 + ε)) h(y − y_ref),
        ξ_ẋ = (h(e), e₃) of e = ẋ − ẋ_ref,     ξ_ẏ = h(ẏ − ẏ_ref),
        ξ_θ = Rᵀz_ref × e₃,                    ξ_ω = ω − ω_ref,

    which at heading 0 agree to first order with the coordinates of `flypend.laws.linearise`. For an error angle θ,
    |ξ_y| = 2 sin(θ/2) almost up to the antipode, where the error has no direction and drops to zero; |ξ_θ| = sin θ.
    Of the four ways to assign these two forms to rod and thrust axis, this one recovers from the most random starts.

    The references are (3, 1) each: `x_ref`, `v_ref` of the pivot, `z_ref` of the thrust axis, its angular velocity
    `omega_ref` in the body frame, `y_ref` of the rod and its rate `y_ref_dot`.
    """
    down = state.R.T

    def seen(e: Any) -> Any:
        return apply(down, ca.vertcat(e[0], e[1], 0))[:2]

    e, v = state.x - x_ref, state.x_dot - v_ref
    tilt = cross(apply(down, z_ref), E3)
    size = ca.sqrt((1 + ANTIPODE_FLOOR) / ((1 + dot(state.y, y_ref)) / 2 + ANTIPODE_FLOOR))
    rod = size * seen(state.y - y_ref)
    rates = ca.vertcat(state.omega - omega_ref, rod, seen(state.y_dot - y_ref_dot))
    return ca.vertcat(seen(e), e[2], seen(v), v[2], tilt, rates)


def flat_reference(t: Scalar, path: Path, vehicle: Vehicle) -> tuple[Vector, Vector, Vector, Vector, Scalar]:
    """Return pivot position and velocity, rod, thrust axis and thrust with which `vehicle` follows `path` at `t`.

    The thrust vector is F = M (ẍ + g e₃) + m (p̈ + g e₃), with p the bob. The rod points along p̈ + g e₃: the path's own
    rod is less exact by a factor (rate of the reference)² l/g, and its error moves the pivot far more than the bob.
    """
    x_ref, p_ref, _ = path(t, vehicle, ca.SX.zeros(3))
    v_ref, a_ref = derivatives(x_ref, t, 2)
    support = derivatives(p_ref, t, 2)[-1] + vehicle.g * E3
    F = vehicle.M * (a_ref + vehicle.g * E3) + vehicle.m * support
    f_ref = norm(F)
    return x_ref, v_ref, unit(support), scale(1 / f_ref, F), f_ref
