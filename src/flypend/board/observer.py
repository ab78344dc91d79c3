"""Observer of constant external forces on vehicle and bob, and of what scales the thrust, from momenta.

Equal errors of the masses, weak rotors and a sagging battery scale the thrust: they act along it, and turn with it. As
a force that stays where it is, what they do would be known only as late as the observer is slow.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import casadi as ca
import numpy as np

from flypend.board.nominal import Nominal
from flypend.compile.record import Field, Record
from flypend.geometry import E3, Numbers, Scalar, Vector, clip, cross, shorten
from flypend.laws import Computer
from flypend.model import State, linear_momentum
from flypend.model.momenta import pull_on_rod, split_force
from flypend.model.state import SIZE

SCALE_SUMS = Record(
    "scale_sums",
    "What the flight tells of the scale of the thrust.",
    (
        Field("risen", 0, "a constant 1 behind the filter of the observer, from its first step on"),
        Field("weight", 0, "of the means, control periods"),
        Field("thrust", 3, "mean of the thrust, world, e3 up, N"),
        Field("unknown", 3, "mean of the unknown forces, N"),
        Field("square", 0, "of the thrust about its mean, summed, N^2"),
        Field("product", 0, "of both about their means, summed, N^2"),
    ),
)
RECORD = Record(
    "observer",
    "Observer of external forces.",
    (
        Field("begun", 0, "1 once it has a measurement, else 0"),
        Field("momenta", 6, "estimates of (M + m) x_dot + m l y_dot, N s, and y x y_dot, 1/s"),
        Field("known", 6, "the part of their rates that is known, N and 1/s^2"),
        Field("unknown", 6, "estimate of the rest, due to external forces, N and 1/s^2"),
        Field("thrust", 6, "what the thrust does to both, as late as that estimate, N and 1/s^2"),
        Field("scale_sums", SCALE_SUMS.length, "of the scale of the thrust"),
    ),
)
# Time over which means are taken, s, each value counting by how far a constant has risen behind the filter. A constant
# force is part of the mean; a swing-up turns the thrust several times.
MEAN = 1.0
# Thrust that departs from its mean by a share of the weight tells the scale, and counts half at VARIES; in hover it
# tells nothing, and the scale stays. While it varies, what was told is forgotten over FORGETTING (s): batteries sag.
VARIES, FORGETTING = 0.1, 2.0
# A tenth of the weight for a second weighs as much as what is assumed before the flight, which is no scale.
DOUBT = 0.005
# Largest scale that is believed, either way: masses 20 % lighter under rotors 15 % stronger make 0.44.
MOST = 0.6


def observer(nominal: Nominal, computer: Computer, period: float, thrusts: int) -> ca.Function:
    """Build two momentum observers with one bandwidth L, e₃ up, which tell external forces and a scale of the thrust.

    Linear momentum P = (M+m) ẋ + m l ẏ obeys Ṗ = −(M+m) g e₃ + f z + F_v + F_b, and H = y × ẏ obeys
    Ḣ = −(f/Ml) y × z + y × D/l with D = F_b/m − F_v/M. Each unknown term N enters as Ḣ = known + N and is estimated by
    N̂ = L (H − Ĥ), dĤ/dt = known + N̂, so that dN̂/dt = L (N − N̂): first order, exponentially stable, and free of
    differentiated measurements. For constant forces the unknown term of P is constant; with a correct model its
    estimation error decays like e^{−Lt} under any law. The unknown term of H, N = y × D/l, rotates with the rod:
    Ṅ = ẏ × D/l. Its estimate lags while the rod moves, so law and observer are coupled if D ≠ 0. With the rod at rest
    the lag vanishes, and hover stays locally stable for small enough D. The component of D along the rod does not act
    on the rod and is set to zero. Estimates are limited in length. `known` is integrated by the trapezoidal rule: with
    a lower-order rule, every change of thrust would look like a force. The first measurement, and the first after a
    gap, only initialises the momenta and leaves the estimates unchanged.

    A scale s of the thrust adds s f z to the unknown term of P, and −s (f/Ml) y × z to that of H. Filtered like N̂,
    these are s T, and N̂ = s T + F (1 − e^{−Lt}): s follows by least squares from how N̂ and T vary together about their
    means, and N̂ − s T is what forces explain.

    Parameters
    ----------
    nominal : Nominal
        The nominal vehicle.
    computer : Computer
        Source of `observer`, the bandwidth L, and of `force_limit`.
    period : float
        Time between measurements, s.
    thrusts : int
        Number of thrusts that it is given: one in total, or one of each rotor.

    Returns
    -------
    Function
        Inputs: state (24,), thrusts (k,), N, memory (35,) and params. Outputs: memory, the forces (6,) on vehicle and
        bob, N, and the scale, true over modelled thrust, less 1.
    """
    vehicle, L = nominal.vehicle, computer.observer
    packed, given = ca.SX.sym("s", SIZE), ca.SX.sym("f", thrusts)
    memory = ca.SX.sym("memory", RECORD.length)
    begun, momenta, before, estimate, thrust, scale_sums = RECORD.split(memory).values()
    s = State.symbolic(packed)
    measured = ca.vertcat(linear_momentum(s, vehicle), cross(s.y, s.y_dot))
    f = ca.sum1(given)
    by_thrust = ca.vertcat(f * s.z, cross(s.y, pull_on_rod(f, s.z, vehicle)))
    known = by_thrust - vehicle.weight * ca.vertcat(E3, np.zeros(3))
    following = momenta + period * ((before + known) / 2 + estimate)
    following = ca.if_else(begun, following, measured - estimate / L)  # keeps the estimate unchanged
    unknown = L * (measured - following)
    thrust = thrust + L * period * (by_thrust - thrust)
    scale_sums, scale = _learn(SCALE_SUMS.split(scale_sums), thrust[:3], unknown[:3], period, L, vehicle.weight)
    rest = unknown - scale * thrust
    # F_v + F_b, and D without its component along the rod.
    limit = computer.force_limit * vehicle.weight
    split = split_force(rest[:3], vehicle.l * cross(rest[3:], s.y), vehicle)
    forces = [shorten(force, limit) for force in split]
    kept = {
        "begun": 1, "momenta": following, "known": known, "unknown": unknown, "thrust": thrust,
        "scale_sums": scale_sums,
    }  # fmt: skip
    outputs = ca.cse([ca.densify(RECORD.join(kept)), ca.densify(ca.vertcat(*forces)), scale])
    return ca.Function("observe", [packed, given, memory, nominal.symbols], outputs)


def _learn(
    sums: Mapping[str, Any], thrust: Vector, unknown: Vector, period: float, L: float, weight: Scalar
) -> tuple[Numbers, Scalar]:
    """Return the sums after a `period` (s) with `thrust` and `unknown` force (3,), N, and the scale; see `observer`."""
    risen = sums["risen"] + L * period * (1 - sums["risen"])
    weighed = (1 - period / MEAN) * sums["weight"] + risen**2
    follow = risen / weighed
    off, beside = thrust - risen * sums["thrust"], unknown - risen * sums["unknown"]
    square = ca.sumsqr(off)
    share = square / (square + (VARIES * weight) ** 2)
    kept = 1 - period / FORGETTING * share
    after = {
        "risen": risen, "weight": weighed,
        "thrust": sums["thrust"] + follow * off, "unknown": sums["unknown"] + follow * beside,
        "square": kept * sums["square"] + share * square,
        "product": kept * sums["product"] + share * ca.dot(off, beside),
    }  # fmt: skip
    scale = after["product"] / (after["square"] + DOUBT / period * weight**2)
    return SCALE_SUMS.join(after), clip(scale, -MOST, MOST)
