"""The inverted pendulum from almost every start, with position and a proof: Theorem B, docs/laws/theorem-proof.md.

The world has e₃ up. The bob p = x + l y is a thrust vehicle whose thrust axis is the rod:

    p̈ = −g e₃ + a y,   (M+m) a = f z·y − M l |ẏ|²,        ÿ + |ẏ|² y = −P_y (f z)/(M l)

A cascade of three: position → demand A on the bob → rod along A (Lemma S) → force F → thrust axis along F (Lemma S).
V of all three falls along every solution; the closed loop has one equilibrium. The wrench is assumed to act as
commanded, without limits: for rotors, see `inverted`.

Theorem D is the same law through rotors with a known lag, by Lemma L (`laws.lag`): one more derivative, and a V' that
falls along every solution.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, NamedTuple

import casadi as ca

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import E3, Scalar, Vector, apply, cross, dot, norm, scale
from flypend.laws.almost_global_bounds import theorem_b, theorem_d
from flypend.laws.almost_global_gains import GAINS, axis_step, damper, demand_stays_upward, rod_step, spring
from flypend.laws.axis import axis_moment, axis_rate
from flypend.laws.bound import COMPUTER, Control, Guard, computer_of
from flypend.laws.certified import certified_set
from flypend.laws.gain import POSITIVE, document_gains, table
from flypend.laws.lag import GAINS as LAG_GAINS
from flypend.laws.lag import through_lag
from flypend.laws.law import Law
from flypend.laws.references import Path, Reference, hover
from flypend.laws.step import Push, aim, push, share
from flypend.laws.throw import bob_path, derivatives
from flypend.model import Rates, State, Vehicle, Wrench, equations_of_motion, lie_derivative
from flypend.model.momenta import carrying_force

OUTSIDE = Guard(
    signal="domain",
    threshold=1e-12,
    reason="outside the domain of Theorem B: y = -d or z = -z_d, rod or thrust axis point opposite to their target",
)


@errors.named_arguments
@document_gains(
    GAINS, "; and from `bind`, if the demand on the bob could point downward", ", with ten bounded derivatives"
)
def almost_global(reference: Reference | None = None, **gains: float) -> Law:
    """Build the law of Theorem B about a `reference` for the pivot. V falls along every solution.

    Every start reaches the reference, except those with y = -d or z = -z_d, a set of measure zero on which the law is
    not defined. The law assumes that the wrench acts as commanded, without limits.
    """
    return _about(
        reference, name="almost_global", gains=GAINS, given=gains, control=almost_global_control, computer=computer_of,
        prepare=demand_stays_upward, theorem=theorem_b,
    )  # fmt: skip


_KEPT = [
    replace(gain, bounds=POSITIVE) if gain.name == "yaw_damping" else gain  # D says that the yaw rate decays
    for gain in GAINS.values()
    if gain.name not in COMPUTER
]
LAGGED_GAINS = table([*_KEPT, *LAG_GAINS])


@errors.named_arguments
@document_gains(
    LAGGED_GAINS,
    "; from `bind`, if the demand on the bob could point downward, or the vehicle has no lag; and in another plant",
    ", with eleven bounded derivatives",
)
def almost_global_lag(reference: Reference | None = None, **gains: float) -> Law:
    """Build the law of Theorem D about a `reference` for the pivot: `almost_global` through rotors that lag.

    Every start reaches the reference, whatever the initial rotor forces, except those with y = -d or z = -z_d, as
    without lag. The law assumes that all rotors have the lag of the vehicle, `rotor_lag`, and no limits, and that their
    forces are known. So it flies in `flypend.Ideal(lag=True)`.
    """
    return _about(
        reference, name="almost_global_lag", gains=LAGGED_GAINS, given=gains, control=_lagged_control,
        uses_wrench=True, prepare=_prepare_lagged, theorem=theorem_d,
    )  # fmt: skip


def _about(reference: Reference | None, **own: Any) -> Law:
    """Return a law about a `reference`; `own` are the fields in which the two differ."""
    followed = reference or hover()
    return Law(e3="up", guard=OUTSIDE, reference=followed, path=bob_path(followed), certify=certified_set, **own)


def _prepare_lagged(vehicle: Vehicle, gains: Mapping[str, Any]) -> Mapping[str, Any]:
    if vehicle.rotor_lag <= 0:
        raise InputError("vehicle.rotor_lag", "a lag > 0 s; without one, almost_global", f"{vehicle.rotor_lag:g} s")
    return demand_stays_upward(vehicle, gains)


class Outer(NamedTuple):
    """The outer loops: the force F (3, 1), N, the terms of their V, ζ_y, c_y, and their claimed part of V̇."""

    force: Vector
    terms: tuple[Scalar, Scalar, Scalar]
    rate_error: Vector
    cosine: Scalar
    decay: Scalar


def almost_global_control(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, *, path: Path) -> Control:
    """Evaluate the law for symbols `t` (s) and `state`, with the gains `k` of `almost_global`."""
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    y, z, step = state.y, state.z, axis_step(k)
    outer = _outer(t, state, vehicle, k, path)
    N = norm(outer.force)
    z_d = scale(1 / N, outer.force)
    c = dot(z, z_d)
    f = N * share(c, step)  # (B7)

    # Δ = f z − F enters v̇ and ÿ, and so V₃, by G·Δ. At fixed y and ẏ, ∂/∂v = ∂/∂ẋ.
    V_3 = sum(outer.terms)
    along_v = ca.gradient(V_3, state.x_dot)
    G = scale(dot(y, along_v) / (M + m), y) - outer.rate_error * (rod_step(k).weight / (M * l))  # (B8)

    # The moment does not appear in these rates: if it did, building the closed loop would fail.
    rates = equations_of_motion(state, Wrench(f, ca.SX.sym("moment", 3)), vehicle, "up")
    turn = scale(1 / N**2, cross(outer.force, lie_derivative(outer.force, state, rates, t)))  # z_d × ż_d
    aimed = aim(z, z_d, turn, N, G, step)
    u: Push = push(z, axis_rate(state), aimed, lie_derivative(aimed.rate, state, rates, t), step)  # Lemma S

    terms, apart = (*outer.terms, u.potential, u.kinetic), 1 + outer.cosine
    return Control(
        wrench=Wrench(f, axis_moment(state, vehicle, apply(state.R.T, u.force), -k.yaw_damping * state.omega[2])),
        lyapunov={f"V_{i}": term for i, term in enumerate(terms, 1)},
        signals={
            "V_rate_claimed": outer.decay + u.decay,  # (B9)
            # Where 1 + c_y is 0, c is not a number.
            "domain": ca.if_else(apart < OUTSIDE.threshold, apart, ca.fmin(apart, 1 + c)),
            "rod_cosine": outer.cosine,
            "axis_cosine": c,
            "axis_error": norm(z - z_d),
        },
    )


def _lagged_control(
    t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, *, path: Path, acting: Wrench
) -> Control:
    """Evaluate the law for symbols `t` (s), `state` and `acting`, with the gains `k` of `almost_global_lag`."""
    wanted = almost_global_control(t, state, vehicle, k, path=path)
    return through_lag(wanted, t, state, acting, vehicle, k)


def _outer(t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, path: Path) -> Outer:
    """Return position and rod: the force F that turns the rod towards A and carries the bob."""
    M, l, g = vehicle.M, vehicle.l, vehicle.g
    y, y_dot, step = state.y, state.y_dot, rod_step(k)
    _, p_ref, _ = path(t, vehicle, ca.SX.zeros(3))
    v_ref, a_ref = derivatives(p_ref, t, 2)
    v = state.x_dot + l * y_dot - v_ref
    U, sigma_p = spring(state.x + l * y - p_ref, k)
    sigma_v = damper(v, k)
    A = g * E3 + a_ref - sigma_p - sigma_v  # (B3)
    size = norm(A)
    d = scale(1 / size, A)
    a_d = size * share(dot(y, d), step)  # (B4)

    # The ideal bob: p̈ = −g e₃ + a_d y, ẏ given. What is differentiated depends on p, v, y and t only.
    none = ca.SX.zeros(3)
    ideal = Rates(state.x_dot, a_d * y - g * E3, ca.SX.zeros(3, 3), none, y_dot, none)
    turn = scale(1 / size**2, cross(A, lie_derivative(A, state, ideal, t)))  # ω_d = d × ḋ
    aimed = aim(y, d, turn, size, v, step)
    u = push(y, y_dot, aimed, lie_derivative(aimed.rate, state, ideal, t), step)  # Lemma S

    F = carrying_force(a_d, y_dot, vehicle) * y - M * l * u.force  # (B6)
    terms = (U + dot(v, v) / 2, u.potential, u.kinetic)
    return Outer(F, terms, u.rate_error, aimed.cosine, u.decay - dot(v, sigma_v))
