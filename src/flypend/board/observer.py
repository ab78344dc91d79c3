"""Observer of constant external forces on vehicle and bob, from momenta and the modelled thrust."""

from __future__ import annotations

import casadi as ca

from flypend.board.believed import Believed
from flypend.compile.record import Field, Record
from flypend.geometry import E3, cross
from flypend.laws import Computer
from flypend.model import State, linear_momentum
from flypend.model.momenta import pull_on_rod
from flypend.model.state import SIZE

RECORD = Record(
    "observer",
    "Observer of external forces.",
    (
        Field("begun", 0, "1 once it has a measurement, else 0"),
        Field("momenta", 6, "estimates of (M + m) x_dot + m l y_dot, N s, and y x y_dot, 1/s"),
        Field("known", 6, "the part of their rates that is known, N and 1/s^2"),
        Field("unknown", 6, "estimate of the rest, due to external forces, N and 1/s^2"),
    ),
)


def observer(believed: Believed, computer: Computer, period: float, thrusts: int) -> ca.Function:
    """Build two momentum observers with one bandwidth L, e₃ up: (state, thrusts, memory, params) → (memory, forces).

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

    Parameters
    ----------
    believed : Believed
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
        Inputs: state (24,), thrusts (k,), N, memory (19,) and params. Outputs: memory, and the forces (6,) on
        vehicle and bob, N.
    """
    vehicle, L = believed.vehicle, computer.observer
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    packed, given = ca.SX.sym("s", SIZE), ca.SX.sym("f", thrusts)
    memory = ca.SX.sym("memory", RECORD.length)
    begun, momenta, before, estimate = RECORD.split(memory).values()
    s = State.symbolic(packed)
    measured = ca.vertcat(linear_momentum(s, vehicle), cross(s.y, s.y_dot))
    f = ca.sum1(given)
    known = ca.vertcat(f * s.z - vehicle.weight * E3, cross(s.y, pull_on_rod(f, s.z, vehicle)))
    following = momenta + period * ((before + known) / 2 + estimate)
    following = ca.if_else(begun, following, measured - estimate / L)  # keeps the estimate unchanged
    unknown = L * (measured - following)
    total, difference = unknown[:3], l * cross(unknown[3:], s.y)  # F_v + F_b, and D without its component along the rod
    on_bob = m * M / (M + m) * (difference + total / M)
    limit = computer.force_limit * vehicle.weight
    forces = [force / ca.fmax(1, ca.norm_2(force) / limit) for force in (total - on_bob, on_bob)]
    kept = RECORD.join({"begun": 1, "momenta": following, "known": known, "unknown": unknown})
    outputs = ca.cse([ca.densify(kept), ca.densify(ca.vertcat(*forces))])
    return ca.Function("observe", [packed, given, memory, believed.symbols], outputs)
