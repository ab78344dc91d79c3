"""A batch of flights under a policy: what they cost, and its gradient with respect to the weights.

The gradient goes back through every step of the flights (backpropagation through time).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from flypend import signals
from flypend.compile.llvm.stagewise import WIDTH, lanes
from flypend.identification.model import ERROR
from flypend.laws.policy import FEATURES, HOVER
from flypend.learning.course import Course, Flown, Machines
from flypend.learning.network import Weights, backward, forward
from flypend.learning.world import COSTS, OF_FLIGHT, kernels
from flypend.model.state import SIZE
from flypend.planning.dynamics import Units
from flypend.planning.dynamics import size as numbers_of

# The excursion is the mean of squared distances to this power, its root taken: almost the largest, but smooth.
POWER = 4
FLOOR = 1e-4  # added to what the power is taken of
NEAR = 0.3  # distance from hover, as in `world.costs`, of a flight that stands


class Costs(NamedTuple):
    """Cost of each flight (count,); its largest distance (count,), m; whether it ends near hover (count,)."""

    cost: Any
    distance: Any
    stands: Any


class Flights:
    """Memory of `count` flights, a multiple of eight, and what is done with it."""

    def __init__(self, course: Course, count: int) -> None:
        self.course, self.count, self.groups = course, count, count // WIDTH
        vehicle, units, steps = course.vehicle, Units.of(course.vehicle), course.steps
        self.rotors, self.length = len(vehicle.rotor_spins), units.length
        self.kernels, self.weights = kernels(self.rotors), course.weights[:, None, None]
        self.states = lanes(steps + 1, self.groups, SIZE + 3 * self.rotors)
        self.asked = lanes(steps, self.groups, self.rotors)
        self.costs, self._seen = lanes(steps, self.groups, COSTS), lanes(self.groups, FEATURES)
        self.phi = np.zeros((steps + 1, FEATURES, count + 1), dtype=np.float32)
        self.phi[:, :, -1] = HOVER
        self._numbers = lanes(self.groups, numbers_of(self.rotors))
        self._of_flight = lanes(self.groups, OF_FLIGHT + 2 * self.rotors)
        self._shares, self._errors = lanes(steps, self.groups, 1), lanes(steps + 1, self.groups, ERROR)
        self._kept: list[Any] = [None] * steps
        as_written = Machines.of(replace(course, bands=False, sensors=None), 0)
        self.enter(as_written.choose(np.random.default_rng(), count), as_written)

    def enter(self, flown: Flown, machines: Machines, errors: Any = None) -> None:
        """Let the machines `flown`, of `machines`, fly from now on, seen with `errors` (steps + 1, 18, count)."""
        self._numbers[:], self._of_flight[:] = self.laned(flown.numbers.T), self.laned(flown.of_flight.T)
        for t, share in enumerate(machines.shares(flown.hover)):
            self._shares[t] = self.laned(share[None])
        for t in range(len(self._errors)):
            self._errors[t] = 0.0 if errors is None else self.laned(errors[t])

    def fly(self, weights: Weights, starts: Any) -> None:
        """Fly from `starts` (count, 24 + n), own units, under the network with these `weights`."""

        def ask(t: int) -> None:
            v, self._kept[t] = forward(weights, self.phi[t])
            self.asked[t] = self.laned(v)

        self.fly_by(ask, starts)

    def fly_by(self, ask: Callable[[int], None], starts: Any) -> None:
        """Fly from `starts`; `ask(t)` fills `asked[t]` from `states[t]` or `phi[t]`."""
        rotors = starts[:, SIZE:]
        self.states[0] = self.laned(np.hstack([starts, rotors, rotors]).T)
        self.kernels.see(self.groups, self.states[0], self._of_flight, self._errors[0], self._seen)
        self.phi[0, :, :-1] = flat(self._seen)
        for t in range(self.course.steps):
            signals.poll()
            ask(t)
            self.kernels.forward(
                self.groups, self.states[t], self.asked[t], self._numbers, self._of_flight, self._shares[t],
                self._errors[t + 1], self.states[t + 1], self._seen, self.costs[t],
            )  # fmt: skip
            self.phi[t + 1, :, :-1] = flat(self._seen)

    def laned(self, rows: Any) -> Any:
        """Return `rows` (k, count) as (groups, k, lanes)."""
        return rows.reshape(-1, self.groups, WIDTH).transpose(1, 0, 2)

    def judged(self) -> tuple[Costs, Any]:
        """Return the costs of what has been flown, and the gradient of their sum (steps, groups, 3, lanes)."""
        squared, far = self.costs[:, :, 0] + FLOOR, self.costs[:, :, 1]
        excursion, to_squared = largest(squared, 0.5)
        gradient = lanes(*self.costs.shape[:-1])
        gradient[:, :, 0], gradient[:, :, 1] = self.course.excursion * to_squared, self.weights
        cost = self.course.excursion * excursion + np.sum(self.weights * far, axis=0)
        if self.course.vehicle.mount == "hub":
            nearest, to_near = largest(self.costs[:, :, 2] + FLOOR, 1.0)
            gradient[:, :, 2] = self.course.arms * to_near
            cost += self.course.arms * nearest
        distance = self.length * np.sqrt(np.max(self.costs[:, :, 0], axis=0))
        return Costs(cost.ravel(), distance.ravel(), np.all(far[-10:] < NEAR, axis=0).ravel()), gradient

    def gradient(self, weights: Weights, to_costs: Any) -> Weights:
        """Return the gradient with respect to the `weights` flown, from that with respect to the costs."""
        total = {name: np.zeros_like(array) for name, array in weights.items()}
        to_state, before = (lanes(self.groups, SIZE + 3 * self.rotors) for _ in range(2))
        to_phi, to_v = lanes(self.groups, FEATURES), lanes(self.groups, self.rotors)
        for t in reversed(range(self.course.steps)):
            signals.poll()
            self.kernels.backward(
                self.groups, self.states[t], self.asked[t], self._numbers, self._of_flight, self._shares[t],
                self._errors[t + 1], to_state, to_phi, to_costs[t], before, to_v,
            )  # fmt: skip
            to_state, before = before, to_state
            to_phi[:] = self.laned(backward(weights, self.phi[t], self._kept[t], flat(to_v), total))
        return total


def largest(values: Any, root: float) -> tuple[Any, Any]:
    """Return almost the largest of the positive `values` (steps, …), to the power `root`, and its derivatives.

    The largest value stands out by `POWER`.
    """
    mean = np.mean(values**POWER, axis=0)
    found = mean ** (root / POWER)
    return found, root * found / mean * values ** (POWER - 1) / len(values)


def flat(groups: Any) -> Any:
    """Return (groups, k, lanes) as rows (k, count)."""
    return groups.transpose(1, 0, 2).reshape(groups.shape[1], -1)
