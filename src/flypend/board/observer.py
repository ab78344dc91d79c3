"""Estimates of constant external forces on vehicle and bob, from momenta and the modelled thrust."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.numeric import as_numpy
from flypend.geometry import E3, cross
from flypend.laws.law import Computer
from flypend.model import State, Vehicle, linear_momentum
from flypend.model.state import SIZE


class ForceObserver:
    """Two momentum observers with one bandwidth L, in the frame with e₃ up.

    Linear momentum P = (M+m) ẋ + m l ẏ obeys Ṗ = −(M+m) g e₃ + f z + F_v + F_b, and H = y × ẏ obeys
    Ḣ = −(f/Ml) y × z + y × D/l with D = F_b/m − F_v/M. Each unknown term N enters as Ḣ = known + N and is estimated by
    N̂ = L (H − Ĥ), dĤ/dt = known + N̂, so that dN̂/dt = L (N − N̂): first order, exponentially stable, and no derivative
    of a measurement is taken. For constant forces the unknown of P is constant, and with the right model the error of
    its estimate decays like e^{−Lt} whatever the law does. The unknown of H, N = y × D/l, turns with the rod:
    Ṅ = ẏ × D/l. Its estimate lags while the rod moves, so law and observer are coupled if D ≠ 0; with the rod at rest
    the lag dies out, and a small enough D leaves hover locally stable. D along the rod does not act on the rod and is
    taken zero. Estimates are limited in length. Sampled, `known` is integrated by the trapezoidal rule: with less,
    every change of thrust would look like a force.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle that the law believes in.
    computer : Computer
        Gives `observer`, the bandwidth L, and `force_limit`.
    """

    def __init__(self, vehicle: Vehicle, computer: Computer) -> None:
        self._on = computer.observer > 0
        self._momenta: Any = None
        self._known: Any = None
        self._estimate: Any = np.zeros(6)
        if self._on:
            self._measure, self._update = _compiled(vehicle, computer)

    def update(self, measured: Any, rotors: Any, period: float) -> Any:
        """Forces on vehicle and bob (6,), N, after a measurement (24,) and `period` seconds under `rotors` (n,)."""
        if not self._on:
            return self._estimate
        if self._momenta is None:
            self._momenta, self._known = self._measure(measured, rotors)
            return self._estimate
        self._momenta, self._known, self._estimate, forces = self._update(
            measured, rotors, self._momenta, self._known, self._estimate, period
        )
        return forces


@lru_cache(maxsize=32)
def _compiled(vehicle: Vehicle, computer: Computer) -> tuple[Any, ...]:
    return tuple(as_numpy(function) for function in observer_functions(vehicle, computer))


def observer_functions(vehicle: Vehicle, computer: Computer) -> tuple[ca.Function, ca.Function]:
    """The beginning (state, rotors) → (momenta, known), and the update of `ForceObserver` as CasADi functions.

    The update takes (state, rotors, momenta believed, known before, estimate, period) and gives the first three of
    these anew, and the forces on vehicle and bob (6,), N.
    """
    M, m, l, L = vehicle.M, vehicle.m, vehicle.l, computer.observer
    packed, rotors = ca.SX.sym("s", SIZE), ca.SX.sym("r", len(vehicle.rotor_spins))
    believed, before, estimate, period = (*(ca.SX.sym(name, 6) for name in "PKN"), ca.SX.sym("T"))
    s = State.symbolic(packed)
    momenta = ca.vertcat(linear_momentum(s, vehicle), cross(s.y, s.y_dot))
    f = ca.sum1(rotors)
    known = ca.vertcat(f * s.z - vehicle.weight * E3, -f / (M * l) * cross(s.y, s.z))
    following = believed + period * ((before + known) / 2 + estimate)
    unknown = L * (momenta - following)
    total, difference = unknown[:3], l * cross(unknown[3:], s.y)  # F_v + F_b, and D without its part along the rod
    on_bob = m * M / (M + m) * (difference + total / M)
    limit = computer.force_limit * vehicle.weight
    forces = [force / ca.fmax(1, ca.norm_2(force) / limit) for force in (total - on_bob, on_bob)]
    outputs = ca.cse([ca.densify(value) for value in (following, known, unknown, ca.vertcat(*forces))])
    update = ca.Function("observe", [packed, rotors, believed, before, estimate, period], outputs)
    measure = ca.Function("momenta", [packed, rotors], [ca.densify(momenta), ca.densify(known)])
    return measure, update
