"""Estimates of constant external forces on vehicle and bob, from momenta and the modelled thrust."""

from __future__ import annotations

import casadi as ca

from flypend.board.believed import Believed
from flypend.geometry import E3, cross
from flypend.laws import Computer
from flypend.model import State, linear_momentum
from flypend.model.state import SIZE

# What the observer keeps: whether it has begun, the momenta it believes in, the known rates, and the estimates.
MEMORY = 1 + 3 * 6


def observer(believed: Believed, computer: Computer, period: float) -> ca.Function:
    """Two momentum observers with one bandwidth L, e₃ up: (state, rotors, memory, params) → (memory, forces).

    Linear momentum P = (M+m) ẋ + m l ẏ obeys Ṗ = −(M+m) g e₃ + f z + F_v + F_b, and H = y × ẏ obeys
    Ḣ = −(f/Ml) y × z + y × D/l with D = F_b/m − F_v/M. Each unknown term N enters as Ḣ = known + N and is estimated by
    N̂ = L (H − Ĥ), dĤ/dt = known + N̂, so that dN̂/dt = L (N − N̂): first order, exponentially stable, and no derivative
    of a measurement is taken. For constant forces the unknown of P is constant, and with the right model the error of
    its estimate decays like e^{−Lt} whatever the law does. The unknown of H, N = y × D/l, turns with the rod:
    Ṅ = ẏ × D/l. Its estimate lags while the rod moves, so law and observer are coupled if D ≠ 0; with the rod at rest
    the lag dies out, and a small enough D leaves hover locally stable. D along the rod does not act on the rod and is
    taken zero. Estimates are limited in length. `known` is integrated by the trapezoidal rule: with less, every change
    of thrust would look like a force. The first measurement, and the first after a gap, only sets the momenta; the
    estimates stay.

    Parameters
    ----------
    believed : Believed
        The vehicle that the law believes in.
    computer : Computer
        Gives `observer`, the bandwidth L, and `force_limit`.
    period : float
        Time between two measurements, s.

    Returns
    -------
    Function
        Of state (24,), rotor forces (n,), N, memory (19,) and params; the forces (6,) are those on vehicle and bob, N.
    """
    vehicle, L = believed.vehicle, computer.observer
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    packed, rotors = ca.SX.sym("s", SIZE), ca.SX.sym("r", believed.rotors)
    memory = ca.SX.sym("memory", MEMORY)
    begun, momenta, before, estimate = ca.vertsplit(memory, [0, 1, 7, 13, 19])
    s = State.symbolic(packed)
    measured = ca.vertcat(linear_momentum(s, vehicle), cross(s.y, s.y_dot))
    f = ca.sum1(rotors)
    known = ca.vertcat(f * s.z - vehicle.weight * E3, -f / (M * l) * cross(s.y, s.z))
    following = momenta + period * ((before + known) / 2 + estimate)
    following = ca.if_else(begun, following, measured - estimate / L)  # where the estimate is what it was
    unknown = L * (measured - following)
    total, difference = unknown[:3], l * cross(unknown[3:], s.y)  # F_v + F_b, and D without its part along the rod
    on_bob = m * M / (M + m) * (difference + total / M)
    limit = computer.force_limit * vehicle.weight
    forces = [force / ca.fmax(1, ca.norm_2(force) / limit) for force in (total - on_bob, on_bob)]
    kept = ca.vertcat(1, following, known, unknown)
    outputs = ca.cse([ca.densify(kept), ca.densify(ca.vertcat(*forces))])
    return ca.Function("observe", [packed, rotors, memory, believed.symbols], outputs)
