"""Lemma L: a law through a known lag of the wrench, with a Lyapunov function that falls along every solution.

A wrench acts affinely on the state s: ṡ = X(s) + Y(s) w. A law w_0(t, s) has V̇ = −Q(t, s) if it acts. What acts is w,
which follows the command w_c through a lag T: T ẇ = w_c − w. With η = w − w_0 and Γ = Yᵀ ∂V/∂s,

    V̇ = −Q + Γ·η
    w_c = w + T (ẇ_0 − κ η − W⁻¹ Γ)                                                                            (D1)
    V' = V + ½ η·Wη                                                                                            (D2)

the function V', W symmetric and positive definite, obeys, wherever the law is defined,

    V̇' = −Q − κ η·Wη                                                                                           (D3)

ẇ_0 is the derivative of the law along the true rates, with w in them. docs/laws/theorem-proof.md has the proof.
"""

from __future__ import annotations

from types import SimpleNamespace

import casadi as ca

from flypend.geometry import Scalar, Vector, apply, dot, scale
from flypend.laws.bound import Control
from flypend.laws.gain import POSITIVE, Bounds, Gain
from flypend.laws.law import Law
from flypend.model import State, Vehicle, Wrench, equations_of_motion, lie_derivative

# V is an energy over the mass: l g is its unit, √(l/g) that of time.
GAINS = (
    Gain(
        "wrench_damping", lambda vehicle: float(4.8 * (vehicle.g / vehicle.l) ** 0.5), "1/s",
        "κ: decay of the wrench's error", POSITIVE,
    ),
    Gain(
        "thrust_weight", lambda vehicle: float(11.0 * vehicle.l * vehicle.g / vehicle.weight**2), "m²/(s² N²)",
        "Weight of the thrust's error in V'", POSITIVE,
    ),
    Gain(
        "moment_weight", lambda vehicle: float(0.54 * vehicle.l**3 / vehicle.g), "m² s²",
        "Weight of the error of I⁻¹ times the moment in V'", POSITIVE,
    ),
)  # fmt: skip


def through_lag(
    wanted: Control, t: Scalar, state: State, acting: Wrench, vehicle: Vehicle, k: SimpleNamespace
) -> Control:
    """Return the law (D1) around `wanted`, e₃ up, whose V falls at its signal `V_rate_claimed` if its wrench acts.

    W weighs the error of the thrust by `k.thrust_weight` and that of I⁻¹ times the moment by `k.moment_weight`. So
    W⁻¹ Γ is, in thrust and I⁻¹ moment, Γ over each of them.

    Parameters
    ----------
    wanted : Control
        The law w_0 without lag, for the symbols `t` and `state`.
    acting : Wrench
        Symbols of the wrench w that acts.
    vehicle : Vehicle
        Source of the inertia and of the lag T.
    k : SimpleNamespace
        Gains of `GAINS`.
    """
    rates = equations_of_motion(state, acting, vehicle, "up")
    f, tau = acting.thrust, acting.moment
    f_error = f - wanted.wrench.thrust
    alpha_error = apply(vehicle.I_inv, tau - wanted.wrench.moment)

    # Γ for thrust and moment, then for thrust and α = I⁻¹ τ: Γ_α = I Γ_τ.
    gradient = ca.gradient(sum(wanted.lyapunov.values()), state.packed())
    push = ca.jtimes(rates.packed(), ca.vertcat(f, tau), gradient, True)
    push_f, push_alpha = push[0], apply(vehicle.I, push[1:])

    f_rate = lie_derivative(wanted.wrench.thrust, state, rates, t)
    tau_rate = lie_derivative(wanted.wrench.moment, state, rates, t)
    f_next = f_rate - k.wrench_damping * f_error - push_f / k.thrust_weight
    alpha_next = -k.wrench_damping * alpha_error - scale(1 / k.moment_weight, push_alpha)

    T = vehicle.rotor_lag
    thrust_term, moment_term = k.thrust_weight * f_error**2 / 2, k.moment_weight * dot(alpha_error, alpha_error) / 2
    known = len(wanted.lyapunov)
    return Control(
        wrench=Wrench(f + T * f_next, tau + scale(T, tau_rate + apply(vehicle.I, alpha_next))),  # (D1)
        lyapunov={**wanted.lyapunov, f"V_{known + 1}": thrust_term, f"V_{known + 2}": moment_term},
        signals={
            **wanted.signals,
            "V_rate_claimed": wanted.signals["V_rate_claimed"]
            - 2 * k.wrench_damping * (thrust_term + moment_term),  # (D3)
            "thrust_error": f_error,
            "moment_error": ca.sqrt(dot(tau - wanted.wrench.moment, tau - wanted.wrench.moment)),
        },
    )


def _lead(vehicle: Vehicle) -> float:
    """Return the lead that leaves 0.03 √(l/g) of the lag: 7 ms on hehn2011, what its computer leaves under sampling."""
    return float(max(1.0, vehicle.rotor_lag / (0.03 * (vehicle.l / vehicle.g) ** 0.5)))


LEAD = Gain("lead", _lead, "", "A law that does not know the lag commands w + lead (w_0 − w)", Bounds(low=1.0))


def lead_law(law: Law) -> Law:
    """Return `law`, which does not know the lag, with a lead in continuous time (`lead_wrench`), its only gain."""
    return Law(
        name=law.name, e3=law.e3, control=_led_control, gains=(LEAD,), uses_forces=law.uses_forces, uses_wrench=True,
        reference=law.reference, prepare=lambda vehicle, _: {"law": law.bind(vehicle)},
    )  # fmt: skip


def lead_wrench(wanted: Wrench, acting: Wrench, lead: Scalar) -> Wrench:
    """Return the command w + `lead` (w_0 − w) for the wrench w_0 `wanted` and w `acting`: a lag T acts like T/lead."""
    return Wrench(
        acting.thrust + lead * (wanted.thrust - acting.thrust), acting.moment + lead * (wanted.moment - acting.moment)
    )


def _led_control(
    t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, *forces: tuple[Vector, Vector], acting: Wrench
) -> Wrench:
    """The command of the law `k.law`, led past the wrench that is `acting`."""
    return lead_wrench(k.law.evaluate(t, state, vehicle, *forces).wrench, acting, k.lead)
