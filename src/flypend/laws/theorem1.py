"""Theorem 1: backstepping from the pendulum on S² to the thrust axis on S², in the paper's frame (e₃ along gravity).

One function serves two laws, which differ only in arguments: `printed`, exactly as the paper has it, which does not do
what it claims (docs/paper/errata.md); and `corrected`, with three defects fixed: damping sign, speed floor, and beta
(dropped or regularised), which has no proof. Labels are the paper's equation labels.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any, NamedTuple

import casadi as ca

from flypend import errors
from flypend.geometry import E3, Scalar, apply, cross, dot, hat_squared, norm, scale, smooth_norm, transport_derivative
from flypend.laws.bound import Control, Guard
from flypend.laws.gain import NOT_NEGATIVE, POSITIVE, Gain, document_gains, table
from flypend.laws.law import Law
from flypend.laws.sphere import velocity_error
from flypend.model import State, Vehicle, Wrench, equations_of_motion, lie_derivative

BETA_GUARD = Guard(
    signal="velocity_error",
    threshold=1e-5,
    reason="the law divides by the velocity error of the thrust axis, which reaches zero",  # beta in (weqn)
)

# The paper's gains K, with the values of its fifth experiment as defaults.
PAPER_GAINS = (
    Gain("k_d", 1.0, "1/s", "Damping of the rod", POSITIVE, label="k_d"),
    Gain("k_1", 9.0, "1/s²", "Stiffness of the thrust axis", POSITIVE, label="k_1"),
    Gain("k_2", 4.0, "1/s", "Damping of the thrust axis", POSITIVE, label="k_2"),
)


class Version(NamedTuple):
    """What distinguishes the law as printed from the corrected one.

    damping_sign : int
        Sign of k_d ẏ in (fpeqn): +1 as printed, −1 corrected.
    beta_floor : float, optional
        ε in beta = −|f_p| ⟨ẏ, z − z_d⟩ v_e / (|v_e|² + ε²), 1/s; 0 gives the minimum-norm solution, None drops beta.
    yaw_damping : float
        Third component of I⁻¹mu, which is free, over ω₃, 1/s.
    """

    damping_sign: int
    beta_floor: Scalar | None
    yaw_damping: Scalar = 0.0


def theorem_1(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, version: Version) -> Control:
    """Evaluate a `version` of the law for symbols `t` (s) and `state`, and a `vehicle`.

    Of the gains `k` it takes those of PAPER_GAINS and `speed_floor`, s in √(|ẏ|² + s²), rad/s, which replaces |ẏ| in
    (kpeqn).
    """
    M, m, l, g = vehicle.M, vehicle.m, vehicle.l, vehicle.g
    y, y_dot, omega, z = state.y, state.y_dot, state.omega, state.z
    z_dot = apply(state.R, cross(omega, E3))

    k_p = (M + m) * g / (M * l * (1 + smooth_norm(y_dot, k.speed_floor)))  # (kpeqn)
    f_p = k_p * E3 + version.damping_sign * k.k_d * y_dot  # (fpeqn)
    f = -M * l * norm(f_p)  # (setf)
    z_d = scale(1 / norm(f_p), f_p)  # (zdes)

    # Derivatives of z_d along the closed loop. They depend on ÿ and ż, never on the moment, so a symbol stands in for
    # it: if one did depend on it, building the closed loop would fail.
    rates = equations_of_motion(state, Wrench(f, ca.SX.sym("moment", 3)), vehicle, "down")
    z_d_dot = lie_derivative(z_d, state, rates)
    z_d_ddot = lie_derivative(z_d_dot, state, rates)

    v_e = velocity_error(z, z_dot, z_d, z_d_dot)
    u_fb = (
        -k.k_1 * hat_squared(z, z_d) - k.k_2 * v_e + transport_derivative(z, z_dot, z_d, z_d_dot, z_d_ddot)
    )  # (ufb) without its last term
    if version.beta_floor is not None:
        beta = scale(-norm(f_p) * dot(y_dot, z - z_d) / (dot(v_e, v_e) + version.beta_floor**2), v_e)  # (weqn)
        u_fb = u_fb - hat_squared(z, beta)  # (ufb)

    # (setmu): {I⁻¹mu}^ e₃ = (ω̂² + {I⁻¹(Iω × ω)}^) e₃ + Rᵀ(|ż|² z − u_fb) =: b, i.e. a × e₃ = b for a = I⁻¹mu.
    body = vehicle.in_frame("down")
    free = apply(body.I_inv, cross(apply(body.I, omega), omega))
    b = hat_squared(omega, E3) + cross(free, E3) + apply(state.R.T, scale(dot(z_dot, z_dot), z) - u_fb)
    a = ca.vertcat(-b[1], b[0], version.yaw_damping * omega[2])  # e₃ × b, plus the component that (setmu) leaves free
    mu = apply(body.I, a)

    v_1 = k_p * (1 - dot(y, E3)) + dot(y_dot, y_dot) / 2
    v_2 = k.k_1 * (1 - dot(z, z_d)) + dot(v_e, v_e) / 2
    return Control(
        wrench=Wrench(f, -mu),  # (Rfin): the applied moment is −mu
        lyapunov={"V_1": v_1, "V_2": v_2},
        signals={
            "velocity_error": norm(v_e),
            "V_rate_claimed": -k.k_d * dot(y_dot, y_dot) - k.k_2 * dot(v_e, v_e),
            "k_p": k_p,
        },
    )


PRINTED = table(
    (
        *PAPER_GAINS,
        # As printed it is 0, and the law is undefined at ẏ = 0, where experiment 4 starts. The default lets that run
        # start; no result depends on its value.
        Gain("speed_floor", 1e-6, "rad/s", "s in √(|ẏ|² + s²), which replaces |ẏ| in (kpeqn)", NOT_NEGATIVE),
        Gain(
            "beta", "minimum-norm", doc="minimum-norm A, as printed; off isolates the effect of the damping sign",
            choices=("minimum-norm", "off"),
        ),
    )
)  # fmt: skip


@errors.named_arguments
@document_gains(PRINTED)
def printed(**gains: float | str) -> Law:
    """Build Theorem 1 as printed, with its damping sign and its minimum-norm beta; e₃ points along gravity."""
    return _law("printed", PRINTED, gains, _as_printed)


def _as_printed(k: SimpleNamespace) -> Version:
    return Version(+1, 0.0 if k.beta == "minimum-norm" else None)


CORRECTED = table(
    (
        *PAPER_GAINS,
        Gain(
            "speed_floor", 1e-2, "rad/s", "s in √(|ẏ|² + s²), which replaces |ẏ| in (kpeqn) and keeps it smooth",
            POSITIVE,
        ),
        Gain(
            "beta", "off", doc="off leaves a cascade; regularized divides by |v_e|² + beta_floor², and is worse",
            choices=("off", "regularized"),
        ),
        Gain("beta_floor", 0.1, "1/s", "Floor of |v_e| in beta; at 0 beta is minimum-norm, and singular", NOT_NEGATIVE),
        Gain(
            "yaw_damping", 0.0, "1/s", "Third component of I⁻¹mu over ω₃; (setmu) leaves it free", NOT_NEGATIVE,
        ),
    )
)  # fmt: skip


@errors.named_arguments
@document_gains(CORRECTED)
def corrected(**gains: float | str) -> Law:
    """Build Theorem 1 with f_p = k_p e₃ − k_d ẏ, in the paper's frame, where y = e₃ hangs along gravity.

    The paper's five experiments converge, and so do most random starts. Some run away: the rod spins ever faster
    (docs/paper/errata.md, defect 9).
    """
    return _law("corrected", CORRECTED, gains, _as_corrected)


def _as_corrected(k: SimpleNamespace) -> Version:
    return Version(-1, k.beta_floor if k.beta == "regularized" else None, k.yaw_damping)


def _law(name: str, table: Mapping[str, Gain], given: Mapping[str, Any], version: Callable[[Any], Version]) -> Law:
    """Return the law whose gains decide on its `version`; it is guarded where that divides by |v_e| alone."""

    def control(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace) -> Control:
        """Theorem 1 in the version of its gains."""
        return theorem_1(t, state, vehicle, k, version(k))

    def guard(values: Mapping[str, Any]) -> Guard | None:
        return BETA_GUARD if version(SimpleNamespace(**values)).beta_floor == 0 else None

    return Law(name=name, e3="down", gains=table, given=given, control=control, guard=guard)
