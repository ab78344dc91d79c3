"""How a machine in flight departs from its model: scales of thrust and moment, and constant forces, told apart.

Equal errors of the masses, weak rotors and a sagging battery scale the thrust. They act along it and in proportion to
it, so that an observer of forces takes them for a force that wanders through the world with the thrust axis, and a
plan that believes in this force goes wrong. In momenta (see `model.momenta`) and weights, the departure

    d/dt momenta − (their rates by the model) = a f z + F_v + F_b               of the centre of mass
                                                y × (−a f z − F_v + (M/m) F_b)  of the rod, times M l
                                                b τ + c                         of the rotation

is linear in the scales a and b, the forces F and the moment c. A Kalman filter follows all of them jointly. Where
the thrust hardly changes, only a f z + F is told, and what was learned before shares it out.
"""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from flypend.building import built
from flypend.compile.numeric import as_numpy
from flypend.geometry import cross, hat
from flypend.model import State, Vehicle
from flypend.model.dynamics import gyroscopic_moment
from flypend.model.state import SIZE
from flypend.planning.dynamics import Array, Units

# Standard deviations of the scales and, weights, of the forces on vehicle and bob and of the moment (over l) before
# the flight, and of their random walks in a unit of time, √(l/g).
PRIOR = np.repeat([0.15, 0.15, 0.1, 0.02, 0.02], (1, 1, 3, 3, 3))
WALK = np.repeat([0.01, 0.01, 0.03, 0.005, 0.005], (1, 1, 3, 3, 3))
# Unknown rates, weights, of each momentum: white noise of this density in a unit of time.
NOISE = np.repeat([0.05, 0.05, 0.05], 3)
LEAST, MOST = 0.6, 1.6  # scales that are believed
BLOW = 0.1  # momentum that a period changes unexplained, own units, above which it is a blow, and tells nothing


class ModelError:
    """The departures of a `vehicle` in flight, from its states and rotor forces every `period` (s).

    `scales` (2,) are true thrust and moment over those of the model, `forces` (6,) constant ones on vehicle and bob, N.
    """

    def __init__(self, vehicle: Vehicle, period: float) -> None:
        units, n = Units.of(vehicle), len(vehicle.rotor_spins)
        self._vehicle = vehicle
        self._own, self._weight, self._h = units.states(n), vehicle.weight, period / units.time
        self._told = _momenta_program(vehicle)
        self._x, self._P = np.zeros(len(PRIOR)), np.diag(PRIOR**2)
        self._Q, self._R = np.diag(WALK**2) * self._h, np.diag(NOISE**2) * self._h
        self._before: tuple[Array, Array] | None = None
        self.scales, self.forces = np.ones(2), np.zeros(6)

    @property
    def machine(self) -> Vehicle:
        """The vehicle whose model moves under rotor forces as the true machine does."""
        thrust, moment = self.scales
        found = self._vehicle.replace(thrust_scale=thrust).commanded()
        return found.replace(inertia=self._vehicle.inertia / moment)

    def update(self, state: Array, rotors: Array) -> None:
        """Take the `state` (24,) and `rotors` (n,), N, a period after the last ones."""
        momenta, rates = self._told(np.append(state, rotors) / self._own)
        now = momenta, rates.reshape(-1, len(momenta)).T
        if self._before is not None:
            by_model, *of = (self._h / 2 * (self._before[1] + now[1])).T
            H, unknown = np.array(of).T, momenta - self._before[0] - by_model
            if np.max(np.abs(unknown)) < BLOW:
                self._learn(unknown, H)
        self._before = now

    def _learn(self, unknown: Array, H: Array) -> None:
        P = self._P + self._Q
        gain = np.linalg.solve(H @ P @ H.T + self._R, H @ P).T
        self._x = self._x + gain @ (unknown - H @ self._x)
        self._P = P - gain @ H @ P
        self.scales = np.clip(1 + self._x[:2], LEAST, MOST)
        self.forces = self._x[2:8] * self._weight


@built(maxsize=16)
def _momenta_program(vehicle: Vehicle) -> Any:
    """Return (state and rotor forces (24 + n,), own units) → momenta (9,), and rates (9 · 12,).

    The rates are columns: those by the model, and their derivatives with respect to what is estimated.
    """
    units, n = Units.of(vehicle), len(vehicle.rotor_spins)
    state, m = ca.SX.sym("state", SIZE + n), vehicle.m / (vehicle.M + vehicle.m)
    M, s, numbers = 1 - m, State.symbolic(state[:SIZE]), units.numbers(vehicle)
    inertia = ca.DM(vehicle.I / ((vehicle.M + vehicle.m) * units.length**2))
    thrust = ca.sum1(state[SIZE:]) / n * s.z
    moment = ca.mtimes(ca.DM(numbers[13 : 13 + 3 * n].reshape(3, n)), state[SIZE:])
    momenta = ca.vertcat(s.x_dot + m * s.y_dot, M * cross(s.y, s.y_dot), ca.mtimes(inertia, s.omega))
    none, one, turn = ca.SX(3, 1), ca.SX.eye(3), hat(s.y)
    of_thrust, of_moment = ca.vertcat(thrust, -cross(s.y, thrust), none), ca.vertcat(none, none, moment)
    weight = ca.vertcat(none, none, -gyroscopic_moment(inertia, s.omega))
    weight[2] = -1
    on_vehicle, on_bob = ca.vertcat(one, -turn, ca.SX(3, 3)), ca.vertcat(one, M / m * turn, ca.SX(3, 3))
    rates = ca.horzcat(
        of_thrust + of_moment + weight, of_thrust, of_moment, on_vehicle, on_bob, ca.vertcat(ca.SX(6, 3), one)
    )
    return as_numpy(ca.Function("momenta", [state], [ca.densify(momenta), ca.densify(ca.vec(rates))]))
