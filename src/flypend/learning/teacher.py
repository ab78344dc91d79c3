"""What the network imitates at first: the tuned law, and about hover the linear-quadratic regulator."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import signals
from flypend.compile.llvm.stagewise import lanes, stagewise
from flypend.laws import inverted
from flypend.laws.learned import FEATURES, activation
from flypend.laws.lqr import GAINS, gain_matrix
from flypend.learning.flights import Flights, flat
from flypend.learning.network import Adam, Weights, activate, backward, forward, with_hover
from flypend.model import Vehicle
from flypend.model.state import SIZE
from flypend.planning.dynamics import Scaled, Units, step_once
from flypend.plants.actuation import rotor_forces
from flypend.plants.lag import step_timing

AHEAD = 0.75  # periods by which the teacher predicts the state: its command is held for one
STRONGEST = 0.99  # of |a(v)|, which 1 would ask an infinite v for
BATCH, RECENT = 2048, 20  # states of a step; rounds whose states are kept
FARTHEST = 30.0  # own units: states beyond are not imitated
RATE = 5e-3


class Teacher:
    """The tuned law in the flights of a training: it labels states with v, whose shares of the range it asks for."""

    def __init__(self, flights: Flights) -> None:
        self._flights = flights
        self._ask = stagewise(_ask_law(flights.course.vehicle, AHEAD * flights.course.period))
        self._labels = lanes(flights.groups, flights.rotors)

    def fly(self, starts: Any) -> None:
        """Fly from `starts` under the law."""
        flights = self._flights
        flights.fly_by(lambda t: self._ask(flights.groups, flights.states[t], flights.asked[t]), starts)

    def label(self) -> tuple[Any, Any]:
        """Return features (18, k) of the states just flown, and what the law would have asked for there (n, k)."""
        flights, labels = self._flights, []
        for state in flights.states[:-1]:
            self._ask(flights.groups, state, self._labels)
            labels.append(flat(self._labels).astype(np.float32))
        phi, v = np.concatenate(list(flights.phi[:-1, :, :-1]), axis=1), np.concatenate(labels, axis=1)
        usual = np.all(np.isfinite(v), axis=0) & (np.abs(phi).max(axis=0) < FARTHEST)
        return phi[:, usual], v[:, usual]


class Imitation:
    """Rounds of DAgger (Ross, Gordon and Bagnell 2011): the network flies, the teacher says what it would have done."""

    def __init__(self, flights: Flights, weights: Weights, steps: int) -> None:
        self._flights, self._teacher, self._steps = flights, Teacher(flights), steps
        self._adam = Adam(weights)
        self._known: list[tuple[Any, Any]] = []
        self._hover = _hover(flights.course.vehicle)

    def round(self, weights: Weights, starts: Any, rng: np.random.Generator, rate: float) -> float:
        """Fly from `starts`, the first time under the teacher, move the `weights`; return the error of the shares."""
        if self._known:
            self._flights.fly(weights, starts)
        else:
            self._teacher.fly(starts)
        self._known = [*self._known[1 - RECENT :], self._teacher.label()]
        total = 0.0
        for _ in range(self._steps):
            signals.poll()
            phi, wanted = self._known[rng.integers(len(self._known))]
            chosen = rng.integers(phi.shape[1], size=BATCH)
            total += self._step(weights, with_hover(phi[:, chosen]), wanted[:, chosen], rate)
        return float(np.sqrt(total / max(self._steps, 1)))

    def _step(self, weights: Weights, phi: Any, wanted: Any, rate: float) -> float:
        """Move `weights` by `rate` towards the commands `wanted` (n, k) for features `phi`; return the mean error²."""
        v, kept = forward(weights, phi)
        error = (activate(v + self._hover)[0] - activate(wanted + self._hover)[0]) / 2
        gradient = {name: np.zeros_like(array) for name, array in weights.items()}
        backward(weights, phi, kept, error / error.shape[1], gradient)  # as for a logistic output: none is stuck
        self._adam.move(weights, gradient, rate)
        return float(np.mean(error**2))


def _hover(vehicle: Vehicle) -> Any:
    low, high = vehicle.rotor_limits
    level = 2 * (vehicle.weight / len(vehicle.rotor_spins) - low) / (high - low) - 1
    return np.float32(level / np.sqrt(1 - level**2))


def _ask_law(vehicle: Vehicle, ahead: float) -> ca.Function:
    """Return (state (24 + n), own units) → v (n) of the tuned law, for the state `ahead` seconds later."""
    units, n = Units.of(vehicle), len(vehicle.rotor_spins)
    state, packed = ca.SX.sym("state", SIZE + 3 * n), ca.SX.sym("packed", SIZE)
    wrench = inverted().bind(vehicle).upright(ca.SX(0), packed)
    forces = rotor_forces(wrench[0], wrench[1:], vehicle, True)
    low, high = vehicle.rotor_limits
    level = ca.fmin(ca.fmax(2 * (forces - low) / (high - low) - 1, -STRONGEST), STRONGEST)
    asked = ca.Function("asked", [packed], [level / ca.sqrt(1 - level**2) - float(_hover(vehicle))])
    timing = ca.DM(step_timing(vehicle.rotor_lag / units.time, ahead / units.time))
    machine = Scaled(ca.SX(ca.DM(units.numbers(vehicle))), n)
    coming = step_once(state[: SIZE + n], state[SIZE : SIZE + n], timing, machine)[:SIZE] * ca.DM(units.of_state)
    return ca.Function("teacher", [state], ca.cse([ca.densify(asked(coming))]))


def direct(vehicle: Vehicle) -> NDArray[np.float64]:
    """Return the direct part (n, 18) of a policy that, about hover, is the linear-quadratic regulator of `vehicle`.

    To first order its errors ξ (see `laws.lqr.errors_of`) are linear in the features: with d = Rᵀe₃, the attitude is
    d × e₃, and the rod's horizontal part (Rᵀy − d).
    """
    units = Units.of(vehicle)
    xi, rate = np.zeros((16, FEATURES)), 1 / units.time
    for i in range(3):
        xi[i, i], xi[3 + i, 3 + i], xi[9 + i, 9 + i] = units.length, units.length * rate, rate
    for i in range(2):
        xi[12 + i, 12 + i], xi[12 + i, 6 + i], xi[14 + i, 15 + i] = 1, -1, rate
    xi[6, 7], xi[7, 6] = 1, -1
    K = gain_matrix(vehicle, {name: gain.default for name, gain in GAINS.items()})
    (low, high), v = vehicle.rotor_limits, ca.SX.sym("v")
    slope = float(ca.evalf(ca.substitute(ca.jacobian(activation(v), v), v, ca.SX(float(_hover(vehicle))))))
    forces = -vehicle.unmixing() @ K @ xi
    found: NDArray[np.float64] = forces / ((high - low) / 2 * slope)
    return found
