"""Theorem 1 repaired: the rod hangs and the thrust axis settles along gravity, from almost every start, with a proof.

The paper's frame: e₃ along gravity, f < 0. docs/laws/theorem-proof.md, Theorem A. Against the paper's law

- k_p is constant, and the damping of f_p stays below it: |σ| < D k_p, so f_p never vanishes (defects 4 and 10);
- Lemma S stands for Lemma 2 and beta: the direction error is damped itself, and the cross term is cancelled without a
  singularity (defects 3, 5 and 9).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace

import casadi as ca

from flypend import errors
from flypend.geometry import E3, Scalar, apply, cross, dot, norm, scale
from flypend.laws.axis import axis_moment, axis_rate
from flypend.laws.bound import BoundLaw, Control, Guard
from flypend.laws.closed_loop import outside, signals_at
from flypend.laws.gain import NOT_NEGATIVE, POSITIVE, POSITIVE_SHARE, Bounds, Gain, check_gravity, document_gains, table
from flypend.laws.guarantee import IDEAL, Guarantee, saturate
from flypend.laws.law import Law
from flypend.laws.step import Step, aim, push
from flypend.model import State, Vehicle, Wrench, equations_of_motion, lie_derivative

OUTSIDE = Guard(
    signal="domain",
    threshold=1e-12,
    reason="outside the domain of Theorem A: z = -z_d, the thrust axis points opposite to its target",
)


def stiffness(vehicle: Vehicle) -> Scalar:
    """Return k_p = (M+m)g/(Ml), 1/s²: the square of the frequency at which the rod swings under its own weight."""
    return (vehicle.M + vehicle.m) * vehicle.g / (vehicle.M * vehicle.l)


def _of_frequency(factor: float, power: int) -> Callable[[Vehicle], float]:
    def value(vehicle: Vehicle) -> float:
        check_gravity(vehicle, "hangs")
        return float(factor * stiffness(vehicle) ** (power / 2))

    return value


PART = Bounds(0.0, 0.99, open_low=True)
GAINS = table(
    (
        Gain("k_d", _of_frequency(0.2, 1), "1/s", "Damping of the rod at low speed", POSITIVE, label="k_d"),
        Gain("damping_share", 0.6, "", "D: the damping of the rod stays below this share of k_p", PART),
        Gain("k_1", _of_frequency(0.2, 2), "1/s²", "Stiffness of the thrust axis", POSITIVE, label="k_1"),
        Gain("k_2", _of_frequency(0.4, 1), "1/s", "Damping of the thrust axis's rate", POSITIVE, label="k_2"),
        Gain("k_e", _of_frequency(0.4, 1), "1/s", "Damping of the thrust axis's direction", POSITIVE, label="k_e"),
        Gain("axis_weight", 8.0, "", "ρ: weight of the axis in V; the smaller, the more it serves the rod", POSITIVE),
        Gain("axis_barrier", 0.25, "", "ε: share of the potential that bars z = -z_d", POSITIVE_SHARE),
        Gain("yaw_damping", _of_frequency(0.4, 1), "1/s", "Decay of the yaw rate, free in (setmu)", NOT_NEGATIVE),
    )
)  # fmt: skip


@errors.named_arguments
@document_gains(GAINS)
def repaired(**gains: float) -> Law:
    """Build Theorem 1 repaired, in the paper's frame, where y = e₃ hangs along gravity. V falls along every solution.

    The rod comes to hang from every start outside two sets of measure zero: z = -z_d, where the law is not defined, and
    the stable manifold of the saddle y = -e₃. Position is not controlled: the vehicle ends at constant velocity. The
    law assumes that the wrench acts as commanded, without limits.
    """
    return Law(
        name="repaired", e3="down", gains=GAINS, given=gains, control=control_repaired, guard=OUTSIDE, theorem=theorem_a
    )


def control_repaired(
    t: Scalar, state: State, vehicle: Vehicle, k: SimpleNamespace, *, cancelled: float = 1.0
) -> Control:
    """Evaluate the law for symbols `t` (s) and `state`, with the gains `k` of `repaired`.

    `cancelled` is the share of the cross term that v_* cancels: 1 in the theorem, less only to show what it is for.
    """
    y, y_dot, z = state.y, state.y_dot, state.z
    k_p = stiffness(vehicle)  # (A1)
    speed_squared = dot(y_dot, y_dot)
    sigma = scale(k.k_d / ca.sqrt(1 + (k.k_d / (k.damping_share * k_p)) ** 2 * speed_squared), y_dot)  # (A2)
    f_p = k_p * E3 - sigma  # (A3)
    N = norm(f_p)
    z_d = scale(1 / N, f_p)
    f = -vehicle.M * vehicle.l * N  # (A4), (setf)

    # The moment does not appear in these rates: if it did, building the closed loop would fail.
    rates = equations_of_motion(state, Wrench(f, ca.SX.sym("moment", 3)), vehicle, "down")
    turn = scale(1 / N**2, cross(f_p, lie_derivative(f_p, state, rates)))  # z_d × ż_d
    step = axis_step(k)
    aimed = aim(z, z_d, turn, N, cancelled * y_dot, step)
    u = push(z, axis_rate(state), aimed, lie_derivative(aimed.rate, state, rates), step)  # Lemma S

    return Control(
        wrench=Wrench(
            f, axis_moment(state, vehicle.in_frame("down"), apply(state.R.T, u.force), -k.yaw_damping * state.omega[2])
        ),
        lyapunov={"V_1": k_p * (1 - dot(y, E3)) + speed_squared / 2, "V_2": u.potential, "V_3": u.kinetic},
        signals={
            "V_rate_claimed": u.decay - dot(y_dot, sigma),  # (A5)
            "domain": 1 + aimed.cosine,
            "axis_cosine": aimed.cosine,
            "axis_error": norm(z - z_d),
        },
    )


def axis_step(k: SimpleNamespace) -> Step:
    """Return the gains of Lemma S for the thrust axis."""
    return Step(k.k_1, k.k_e, k.k_2, k.axis_weight, k.axis_barrier)


def theorem_a(law: BoundLaw, start: State) -> Guarantee:
    """Return what Theorem A says of `start`; every start with V(0) < 2 k_p hangs."""
    found = signals_at(law, start)
    excluded = outside(law, found, {"axis_cosine": "z = -z_d"})
    if excluded is not None:
        return excluded
    k_p, force_per_stiffness = float(stiffness(law.vehicle)), law.vehicle.M * law.vehicle.l
    rate = math.sqrt(2 * found["V"])
    sigma = saturate(law.gains["k_d"], law.gains["damping_share"] * k_p / law.gains["k_d"], rate)
    saddle = "the stable manifold of the saddle y = -e3, z = e3, at rest: a set of codimension 2"
    return Guarantee(
        covered=True,
        exceptions=saddle if found["V"] >= 2 * k_p else "",
        V=found["V"],
        thrust=(force_per_stiffness * (k_p - sigma), force_per_stiffness * (k_p + sigma)),
        rod_rate=rate,
        assumes=IDEAL,
    )
