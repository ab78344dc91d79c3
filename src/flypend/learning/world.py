"""Steps of many flights under a policy, and their derivatives, compiled for eight flights at a time.

All is in the units of the machine that flies (see `planning.dynamics`). What the policy asks of the rotors is held for
a period; what they are commanded has the flight computer's lead, f̂ + lead (f − f̂), within their limits, and reaches
them after a delay. Policy and rotor model f̂ believe in a vehicle, which the machine need not be.

A state is followed by three times n rotor forces: those of the rotors, the last command, and those of the rotor model.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.llvm.stagewise import Stagewise, stagewise
from flypend.identification.model import ERROR, correct
from flypend.laws.learned import features, shares
from flypend.model import State
from flypend.model.state import SIZE
from flypend.planning.dynamics import Scaled
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import TIMING_SIZE, hold, join_ramps

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


@dataclass(frozen=True)
class Kernels:
    """Compiled programs; arrays have one entry per group of flights, and a last axis of lanes.

    Parameters
    ----------
    forward : Stagewise
        (state (24 + 3 n), v (n), numbers, of the flight (`OF_FLIGHT` + 2 n), share of the range for hover, errors (18)
        of the estimate a period later) → (state, features (18), costs (3)) a period later.
    backward : Stagewise
        (the inputs of `forward`, gradients of its outputs) → gradients of state and v.
    see : Stagewise
        (state, of the flight, errors) → features.
    """

    forward: Stagewise
    backward: Stagewise
    see: Stagewise


@lru_cache(maxsize=4)
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
    moment = join_ramps(before, since, late[0], rest[0]).mixed(machine.mixing())
    moved = cascade_step(state[:SIZE], moment, machine.outside, late[0] + rest[0], machine.vehicle)
    after = ca.vertcat(moved, forces, command, hold(model, command, modelled)[1])
    outputs, inputs = [after, observe(after, flight, error), costs(after, machine)], [state, v, machine.numbers, flight]
    inputs += [share, error]
    gradients = [ca.SX.sym(f"g{i}", output.numel()) for i, output in enumerate(outputs)]
    total = sum(ca.dot(g, output) for g, output in zip(gradients, outputs, strict=True))
    to_state, to_v = ca.gradient(total, state), ca.gradient(total, v)
    to_state *= ca.fmin(1, STEEPEST / ca.sqrt(ca.sumsqr(to_state) + 1e-30))
    forward = ca.Function("forward", inputs, ca.cse([ca.densify(output) for output in outputs]))
    backward = ca.Function("backward", [*inputs, *gradients], ca.cse([ca.densify(to_state), ca.densify(to_v)]))
    return forward, backward, ca.Function("see", [state, flight, error], [observe(state, flight, error)])


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
