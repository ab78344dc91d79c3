"""Theorem 1: backstepping from the pendulum on S² to the thrust axis on S², in the paper's frame (e₃ along gravity).

One function serves the printed and the corrected law. They differ only in arguments, set in `printed.py` and
`corrected.py`. Labels are the paper's equation labels.
"""

from __future__ import annotations

from typing import Any

import casadi as ca

from flypend.geometry import E3, apply, cross, dot, hat_squared, norm, scale, smooth_norm, transport_derivative
from flypend.laws.bound import Control, Guard
from flypend.laws.gain import POSITIVE, Gain
from flypend.laws.sphere import velocity_error
from flypend.model import State, Vehicle, Wrench, equations_of_motion, lie_derivative

BETA_GUARD = Guard(
    signal="velocity_error",
    threshold=1e-5,
    reason="|v_e| reaches zero, where beta (weqn) = -|f_p| Aᵀ(z - z_d), A = ẏ v_eᵀ/|v_e|², is not defined",
)

# The paper's gains K, with the values of its fifth experiment as defaults.
PAPER_GAINS = (
    Gain("k_d", 1.0, "1/s", "Damping of the rod", POSITIVE, label="k_d"),
    Gain("k_1", 9.0, "1/s²", "Stiffness of the thrust axis", POSITIVE, label="k_1"),
    Gain("k_2", 4.0, "1/s", "Damping of the thrust axis", POSITIVE, label="k_2"),
)


def theorem_1(
    t: Any,
    state: State,
    vehicle: Vehicle,
    *,
    k_d: Any,
    k_1: Any,
    k_2: Any,
    damping_sign: int,
    speed_floor: float,
    beta_floor: float | None,
    yaw_damping: float = 0.0,
) -> Control:
    """Evaluate the law of Theorem 1 for symbols `t` (s) and `state`, and a `vehicle`.

    Parameters
    ----------
    t, state, vehicle
        As in `Law`.
    k_d, k_1, k_2
        Gains: damping of the rod (1/s), stiffness (1/s²) and damping (1/s) of the thrust axis.
    damping_sign
        Sign of k_d ẏ in (fpeqn): +1 as printed, −1 corrected.
    speed_floor
        s in √(|ẏ|² + s²), rad/s, which replaces |ẏ| in (kpeqn).
    beta_floor
        ε in beta = −|f_p| ⟨ẏ, z − z_d⟩ v_e / (|v_e|² + ε²), 1/s; 0 gives the minimum-norm solution, None drops beta.
    yaw_damping
        Third component of I⁻¹mu, which is free, over ω₃, 1/s.
    """
    M, m, l, g = vehicle.M, vehicle.m, vehicle.l, vehicle.g
    y, y_dot, omega, z = state.y, state.y_dot, state.omega, state.z
    z_dot = apply(state.R, cross(omega, E3))

    k_p = (M + m) * g / (M * l * (1 + smooth_norm(y_dot, speed_floor)))  # (kpeqn)
    f_p = k_p * E3 + damping_sign * k_d * y_dot  # (fpeqn)
    f = -M * l * norm(f_p)  # (setf)
    z_d = scale(1 / norm(f_p), f_p)  # (zdes)

    # Derivatives of z_d along the closed loop. They depend on ÿ and ż, never on the moment, so a symbol stands in for
    # it: if one did depend on it, building the closed loop would fail.
    rates = equations_of_motion(state, Wrench(f, ca.SX.sym("moment", 3)), vehicle, "down")
    z_d_dot = lie_derivative(z_d, state, rates)
    z_d_ddot = lie_derivative(z_d_dot, state, rates)

    v_e = velocity_error(z, z_dot, z_d, z_d_dot)
    u_fb = (
        -k_1 * hat_squared(z, z_d) - k_2 * v_e + transport_derivative(z, z_dot, z_d, z_d_dot, z_d_ddot)
    )  # (ufb) without its last term
    if beta_floor is not None:
        beta = scale(-norm(f_p) * dot(y_dot, z - z_d) / (dot(v_e, v_e) + beta_floor**2), v_e)  # (weqn)
        u_fb = u_fb - hat_squared(z, beta)  # (ufb)

    # (setmu): {I⁻¹mu}^ e₃ = (ω̂² + {I⁻¹(Iω × ω)}^) e₃ + Rᵀ(|ż|² z − u_fb) =: b, i.e. a × e₃ = b for a = I⁻¹mu.
    body = vehicle.seen("down")
    free = apply(body.I_inv, cross(apply(body.I, omega), omega))
    b = hat_squared(omega, E3) + cross(free, E3) + apply(state.R.T, scale(dot(z_dot, z_dot), z) - u_fb)
    a = ca.vertcat(-b[1], b[0], yaw_damping * omega[2])  # e₃ × b, plus the component that (setmu) leaves free
    mu = apply(body.I, a)

    v_1 = k_p * (1 - dot(y, E3)) + dot(y_dot, y_dot) / 2
    v_2 = k_1 * (1 - dot(z, z_d)) + dot(v_e, v_e) / 2
    return Control(
        wrench=Wrench(f, -mu),  # (Rfin): the applied moment is −mu
        lyapunov={"V_1": v_1, "V_2": v_2},
        signals={
            "velocity_error": norm(v_e),
            "V_rate_claimed": -k_d * dot(y_dot, y_dot) - k_2 * dot(v_e, v_e),
            "k_p": k_p,
        },
    )
