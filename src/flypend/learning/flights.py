"""A batch of flights under a policy: what they cost, and its gradient with respect to the weights.

The gradient goes back through every step of the flights (backpropagation through time). Steps and their derivatives are
compiled for eight flights at a time.

All is in the units of the machine that flies (see `planning.dynamics`). What the policy asks of the rotors is held for
a period; what they are commanded has the flight computer's lead, f̂ + lead (f − f̂), within their limits, and reaches
them after a delay. Policy and rotor model f̂ believe in a vehicle, which the machine need not be.

A state is followed by three times n rotor forces: those of the rotors, the last command, and those of the rotor model.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend import signals
from flypend.building import built
from flypend.compile.llvm.stagewise import WIDTH, Stagewise, lanes, stagewise
from flypend.identification.model import ERROR, correct
from flypend.laws.learned import FEATURES, HOVER, features, shares
from flypend.learning.course import Course, Flown, Machines
from flypend.learning.network import Weights, backward, forward
from flypend.model import State
from flypend.model.state import SIZE
from flypend.planning.dynamics import Scaled, Units
from flypend.planning.dynamics import size as numbers_of
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import TIMING_SIZE, hold, join_ramps

# The excursion is the mean of squared distances to this power, its root taken: almost the largest, but smooth.
POWER = 4
FLOOR = 1e-4  # added to what the power is taken of
NEAR = 0.3  # distance from hover, as in `costs`, of a flight that stands
COSTS = 3
# Numbers of a flight: timings of the delay, of the rest of a period, and of the rotor model, the lead, and the units of
# length and time of the believed vehicle; then the least and the largest force of each rotor.
OF_FLIGHT = 3 * TIMING_SIZE + 3
# The rod of a hub should keep this far from every arm, rad, where it is lower than `HIGH` over the plane of the rotors
# (sine of its elevation); on hehn2011 it touches a disc at 24°, in that plane.
APART, HIGH = 0.58, 0.3
# Largest gradient with respect to a state that is carried back through a step: a flight that falls has no larger say.
STEEPEST = 10.0
FLAT = 1e-9  # keeps the bearing of a rod along the thrust axis differentiable


class Kernels(NamedTuple):
    """Compiled programs; arrays have one entry per group of flights, and a last axis of lanes."""

    # (state (24 + 3 n), v (n), numbers, of the flight (`OF_FLIGHT` + 2 n), share of the range for hover, errors (18) of
    # the estimate a period later) → (state, features (18), costs (3)) a period later
    forward: Stagewise
    backward: Stagewise  # (the inputs of `forward`, gradients of its outputs) → gradients of state and v
    see: Stagewise  # (state, of the flight, errors) → features


@built(maxsize=4)
def kernels(rotors: int) -> Kernels:
    """Return the compiled steps of vehicles with so many `rotors`."""
    return Kernels(*map(stagewise, programs(rotors)))


def programs(rotors: int) -> tuple[ca.Function, ca.Function, ca.Function]:
    """Return the functions of `Kernels`, which describes them."""
    machine = Scaled.symbols(rotors)
    state, v, share = ca.SX.sym("state", SIZE + 3 * rotors), ca.SX.sym("v", rotors), ca.SX.sym("share")
    flight, error = ca.SX.sym("flight", OF_FLIGHT + 2 * rotors), ca.SX.sym("error", ERROR)
    late, rest, modelled, lead, _, low, high = ca.vertsplit(
        flight, [0, 4, 8, 12, 13, OF_FLIGHT, OF_FLIGHT + rotors, OF_FLIGHT + 2 * rotors]
    )
    forces, last, model = ca.vertsplit(state[SIZE:], rotors)
    asked = low + (high - low) * shares(v, share)
    command = ca.fmin(ca.fmax(model + lead * (asked - model), low), high)
    before, forces = hold(forces, last, late)
    since, forces = hold(forces, command, rest)
    moment = join_ramps(before, since, late[0], rest[0]).mix(machine.mixing())
    moved = cascade_step(state[:SIZE], moment, machine.outside, late[0] + rest[0], machine.vehicle)
    after = ca.vertcat(moved, forces, command, hold(model, command, modelled)[1])
    outputs, inputs = [after, observe(after, flight, error), costs(after, machine)], [state, v, machine.numbers, flight]
    inputs += [share, error]
    gradients = [ca.SX.sym(f"g{i}", output.numel()) for i, output in enumerate(outputs)]
    total = sum(ca.dot(g, output) for g, output in zip(gradients, outputs, strict=True))
    to_state, to_v = ca.gradient(total, state), ca.gradient(total, v)
    to_state *= ca.fmin(1, STEEPEST / ca.sqrt(ca.sumsqr(to_state) + 1e-30))
    there = ca.Function("forward", inputs, ca.cse([ca.densify(output) for output in outputs]))
    back = ca.Function("backward", [*inputs, *gradients], ca.cse([ca.densify(to_state), ca.densify(to_v)]))
    return there, back, ca.Function("see", [state, flight, error], [observe(state, flight, error)])


def observe(state: Any, flight: Any, error: Any) -> Any:
    """Return what the policy sees of a `state` about hover at the origin, estimated with the local `error` (18, 1)."""
    s = State.symbolic(correct(state[:SIZE], error))
    length, time = ca.vertsplit(flight[OF_FLIGHT - 2 : OF_FLIGHT])
    return features(s, s.x, s.x_dot, length, time)


def costs(state: Any, machine: Scaled) -> Any:
    """Return squared distance of the pivot, how far the whole `state` is from hover, and nearness to arms (3, 1).

    Own units. The second is √(1 + 8 (1 − y₃) + (1 − z₃) + 0.3 |ẏ|² + 0.1 |ω|² + 0.3 |ẋ|² + 0.3 |x|²) − 1. The third is
    0 while the rod keeps `APART` of all arms of the `machine` or `HIGH` over the rotors, and 1 along an arm.
    """
    s = State.symbolic(state[:SIZE])
    far = 8 * (1 - s.y[2]) + 1 - s.R[2, 2]
    moving = 0.3 * ca.sumsqr(s.y_dot) + 0.1 * ca.sumsqr(s.omega) + 0.3 * ca.sumsqr(s.x_dot) + 0.3 * ca.sumsqr(s.x)
    rod, moments = ca.mtimes(s.R.T, s.y), machine.mixing()[1:3, :]
    level, near = ca.sqrt(ca.sumsqr(rod[:2]) + FLAT), ca.SX(0)
    for i in range(machine.rotors):
        arm = ca.vertcat(-moments[1, i], moments[0, i]) / ca.norm_2(moments[:, i])
        near += ca.fmax(0, (ca.dot(rod[:2], arm) / level - np.cos(APART)) / (1 - np.cos(APART)))
    near *= ca.fmax(0, 1 - (rod[2] / HIGH) ** 2) ** 2
    return ca.vertcat(ca.sumsqr(s.x), ca.sqrt(1 + far + moving) - 1, near)


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
        self._numbers[:], self._of_flight[:] = self.to_lanes(flown.numbers.T), self.to_lanes(flown.of_flight.T)
        for t, share in enumerate(machines.shares(flown.hover)):
            self._shares[t] = self.to_lanes(share[None])
        for t in range(len(self._errors)):
            self._errors[t] = 0.0 if errors is None else self.to_lanes(errors[t])

    def fly(self, weights: Weights, starts: Any) -> None:
        """Fly from `starts` (count, 24 + n), own units, under the network with these `weights`."""

        def ask(t: int) -> None:
            v, self._kept[t] = forward(weights, self.phi[t])
            self.asked[t] = self.to_lanes(v)

        self.fly_by(ask, starts)

    def fly_by(self, ask: Callable[[int], None], starts: Any) -> None:
        """Fly from `starts`; `ask(t)` fills `asked[t]` from `states[t]` or `phi[t]`."""
        rotors = starts[:, SIZE:]
        self.states[0] = self.to_lanes(np.hstack([starts, rotors, rotors]).T)
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

    def to_lanes(self, rows: Any) -> Any:
        """Return `rows` (k, count) as (groups, k, lanes)."""
        return rows.reshape(-1, self.groups, WIDTH).transpose(1, 0, 2)

    def judge(self) -> tuple[Costs, Any]:
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
            to_phi[:] = self.to_lanes(backward(weights, self.phi[t], self._kept[t], flat(to_v), total))
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
