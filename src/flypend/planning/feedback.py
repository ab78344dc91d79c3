"""Feedback along a plan: the time-varying linear-quadratic regulator on the tangent space, and what it commands.

It minimises Σ |δ|² + |υ|², deviations in units of the largest acceptable ones (Bryson's rule), along the linearised
plan and then for ever in hover, whose cost to go the recursion begins with. No limit enters: where the plan holds a
rotor at its limit, feedback acts one way only.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.building import built
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.geometry import E3, cross, unit
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.planning.dynamics import ATTITUDE, MOTION, ROD, SWING, Array, Units, between, plane, turn_by
from flypend.planning.inequalities import Structure
from flypend.planning.result import Plan
from flypend.planning.solver import Scratch, one_lane, programs
from flypend.plants import equations
from flypend.plants.lag import step_timing
from flypend.plants.plant import ROTORS

# Largest acceptable deviations, own units: position, velocity, attitude, spin, rod, its rate; heading; command.
ACCEPTABLE = (0.3, 0.5, 0.5, 2.0, 0.1, 0.3)
HEADING, COMMAND = 2.0, 0.5
MOST_HEADING = 0.3  # rad, to which feedback in hover takes the heading
TINY = 1e-12  # keeps a heading finite that does not exist, or is half a turn away
HOVER_STAGES = 300  # after so many the cost to go of hover has settled: 25 √(l/g)

STILL, AS_MODELLED = np.zeros(6), np.ones(2)


@dataclass(frozen=True)
class Feedback:
    """Nominal states, commands and gains, stage by stage; then those of hover.

    The command at a deviation is commands[k] − gains[k] · deviation, with the `deviation` from the nominal state in SI
    units: 18 + n numbers, rod and rate as vectors of the world, so that no basis is needed.
    """

    stage: float  # s
    states: Array  # (stages + 1, 24 + n): with rotor forces; the last is hover
    commands: Array  # (stages + 1, n), N
    gains: Array  # (stages + 1, n, 18 + n)


def regulator(plan: Plan) -> Feedback:
    """Return the feedback along `plan`. Raises InputError if it failed, or does not end in inverted hover."""
    if not plan:
        raise InputError("plan", "one that can be flown", plan.reason)
    plan.check_end()
    vehicle, units = plan.vehicle, Units.of(plan.vehicle)
    count = len(plan.commands)
    per_stage = (len(plan.t) - 1) // count
    hover = _hover(plan)
    planned = np.column_stack([plan.packed, plan.rotor_forces])[::per_stage]
    states = np.concatenate([planned[:-1], np.tile(hover, (HOVER_STAGES + 1, 1))])
    commands = np.concatenate([plan.commands, np.tile(hover[SIZE:], (HOVER_STAGES, 1))])
    found = _gains(vehicle, units, states, commands, plan.stage / units.time)[: count + 1]
    return Feedback(plan.stage, states[: count + 1], commands[: count + 1], found)


def _hover(plan: Plan) -> Array:
    """Return hover at the target with the heading at the end of the plan."""
    z, forward = E3, unit(np.append(plan.R[-1, :2, 0], 0.0))
    R = np.column_stack([forward, cross(z, forward), z])
    share = plan.vehicle.weight * plan.vehicle.unmixing()[:, 0]
    return np.append(State(x=plan.target, R=R, y=E3).packed(), share)


def _gains(vehicle: Vehicle, units: Units, states: Array, commands: Array, h: float) -> Array:
    """Return the gains (stages, n, 18 + n) of the regulator in SI units, by one recursion from zero cost to go."""
    n, count = commands.shape[1], len(commands)
    compiled = programs(n, Structure(), lanes=False)
    w, own, forces = Scratch(compiled, count, 1), one_lane(states / units.states(n)), one_lane(commands / units.force)
    timing = one_lane(units.timing(vehicle, h))
    compiled.linearised(count, own, own[1:], forces, timing, one_lane(units.numbers(vehicle)), w.d, w.slopes)
    w.cost[:] = _cost(n)[:, None]
    compiled.backward(count, w.to_go[1:], w.slopes, w.d, w.cost, one_lane(np.zeros(2)), w.to_go, w.gains)
    K = -w.gains[:, : n * (MOTION + n), 0].reshape(count, n, MOTION + n)
    b = np.array(_planes().map(count)(states[:-1, 18:21].T)).reshape(3, count, 2).transpose(1, 2, 0)
    whole = np.concatenate([K[:, :, :12], K[:, :, ROD] @ b, K[:, :, SWING] @ b, K[:, :, MOTION:]], axis=2)
    return whole * units.force / units.deviations(n)


@built(maxsize=1)
def _planes() -> ca.Function:
    y = ca.SX.sym("y", 3)
    return ca.Function("plane", [y], [plane(y)])


@lru_cache(maxsize=4)
def _cost(n: int) -> Array:
    """Return the cost of a stage as it lies in memory."""
    weights = np.concatenate([np.repeat(1 / np.square(ACCEPTABLE), (3, 3, 3, 3, 2, 2)), np.zeros(n)])
    weights[ATTITUDE.stop - 1] = 1 / HEADING**2
    Q = np.diag(weights)
    none = np.zeros(MOTION + n)
    R = np.full(n, 1 / COMMAND**2)
    # Nothing depends on the shared parameter; its curvature only must not vanish.
    layout = programs(n, Structure(), lanes=False).layout
    cost = layout.cost(*(ca.SX(ca.DM(part)) for part in (Q, R, none, none, np.zeros(n), 1.0, 0.0)))
    return np.array(ca.DM(ca.evalf(cost))).ravel()


def deviation(rotors: int) -> ca.Function:
    """Return (nominal, state) → deviation (18 + n,), SI units, of states with the forces of `rotors` n, (24 + n,).

    It is `dynamics.local` with rod and rate as vectors.
    """
    nominal, state = ca.SX.sym("nominal", SIZE + rotors), ca.SX.sym("state", SIZE + rotors)
    s, o = State.symbolic(nominal[:SIZE]), State.symbolic(state[:SIZE])
    M = ca.mtimes(s.R.T, o.R)
    skew = ca.vertcat(M[2, 1] - M[1, 2], M[0, 2] - M[2, 0], M[1, 0] - M[0, 1])
    attitude = 2 / ca.fmax(1 + ca.trace(M), 0.1) * skew
    turn = between(s.y, o.y)
    swing = turn_by(-turn, cross(o.y, o.y_dot)) - cross(s.y, s.y_dot)
    parts = [o.x - s.x, o.x_dot - s.x_dot, attitude, o.omega - s.omega, turn, swing, state[SIZE:] - nominal[SIZE:]]
    return ca.Function("deviation", [nominal, state], [ca.densify(ca.vertcat(*parts))])


def hover_deviation(rotors: int) -> ca.Function:
    """Return the `deviation` (nominal, state) → (18 + n,) from a nominal hover, which has any heading.

    The heading is turned away, with the world about the vertical of the pivot, so that gains know the directions that
    the body has: a vehicle that spins when its plan ends, since rotor drag could not stop it in time, hovers as it
    spins. Of the heading, the double tangent of half its angle, `MOST_HEADING` is a deviation.
    """
    nominal, state = ca.SX.sym("nominal", SIZE + rotors), ca.SX.sym("state", SIZE + rotors)
    s, o = State.symbolic(nominal[:SIZE]), State.symbolic(state[:SIZE])
    a, b = s.R[:, 0], o.R[:, 0]
    across, along = a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]
    size = ca.sqrt(across**2 + along**2 + TINY)
    c, d = along / size, across / size
    heading = 2 * d / (1 + c + TINY)
    turn = ca.blockcat([[c, d, 0], [-d, c, 0], [0, 0, 1]])
    x, x_dot, y, y_dot = (ca.mtimes(turn, v) for v in (o.x - s.x, o.x_dot, o.y, o.y_dot))
    home = State.symbolic(ca.vertcat(s.x + x, x_dot, ca.vec(ca.mtimes(turn, o.R).T), o.omega, y, y_dot)).packed()
    off = deviation(rotors)(nominal, ca.vertcat(home, state[SIZE:]))
    off[ATTITUDE.stop - 1] += ca.fmin(ca.fmax(heading, -MOST_HEADING), MOST_HEADING)
    return ca.Function("hovering", [nominal, state], [off])


class Follower:
    """The feedback of a `vehicle` along a nominal flight; its last stage is held for ever.

    `scales` (2,) are those of thrust and moment, true over those of the vehicle.
    """

    def __init__(self, feedback: Feedback, vehicle: Vehicle) -> None:
        self.feedback = feedback
        (self._deviation, self._hovering), self.stepped = _deviations(len(vehicle.rotor_spins)), step_program(vehicle)
        self._limits, self.scales = vehicle.rotor_limits, AS_MODELLED

    def command(self, t: float, state: Array, rotors: Array) -> tuple[Array, Array]:
        """Return the command (n,), N, at `t` (s) for a `state` (24,) and `rotors` (n,), and the deviation (18 + n,)."""
        wanted, nominal, k = self.nominal(t)
        deviation = self._hovering if k == len(self.feedback.commands) - 1 else self._deviation
        off = deviation(nominal, np.append(state, rotors))
        return np.clip(wanted - self.feedback.gains[k] @ off, *self._limits), off

    def nominal(self, t: float) -> tuple[Array, Array, int]:
        """Return the nominal command and state (24 + n,) at `t` (s), and the number of the stage."""
        f = self.feedback
        k = min(int(t / f.stage + 1e-9), len(f.commands) - 1)
        into = t - k * f.stage
        if k == len(f.commands) - 1 or into < 1e-9:
            return f.commands[k], f.states[k], k
        state, rotors = f.states[k, :SIZE], f.states[k, SIZE:]
        return f.commands[k], self.stepped(state, rotors, f.commands[k], into, scales=self.scales), k


@built(maxsize=16)
def step_program(vehicle: Vehicle) -> Any:
    """Return (state, rotors, command, duration, forces, scales) → state and rotors (24 + n,) after a step of the plant.

    A duration is in s; `forces` (6,), N, are those from outside, and `scales` (2,) those of thrust and moment.
    """
    scales = ca.SX.sym("scales", 2)
    scaled: Any = _Scaled(vehicle, scales)
    s, r, u, w, h = equations.rotor_step(vehicle).sx_in()
    outputs = equations.step_state(s, r, u, w, h, scaled, ROTORS)
    step, lag = as_numpy(ca.Function("step", [s, r, u, w, h, scales], outputs)), vehicle.rotor_lag

    def stepped(
        state: Array, rotors: Array, command: Array, duration: float, forces: Array = STILL, scales: Array = AS_MODELLED
    ) -> Array:
        """Return state and rotor forces in one array, after a `duration`, s, of the `command`, N."""
        return np.append(*step(state, rotors, command, forces, step_timing(lag, round(duration, 9)), scales))

    return stepped


class _Scaled:
    """A `vehicle` whose thrust and moment are `scales` (2, 1), symbols, times as large."""

    def __init__(self, vehicle: Vehicle, scales: ca.SX) -> None:
        self._vehicle, self._scales = vehicle, scales

    def __getattr__(self, name: str) -> Any:
        return getattr(self._vehicle, name)

    def mixing(self) -> ca.SX:
        """As `Vehicle.mixing`."""
        thrust, moment = ca.vertsplit(self._scales)
        return ca.mtimes(ca.diag(ca.vertcat(thrust, moment, moment, moment)), ca.DM(self._vehicle.mixing()))


@built(maxsize=4)
def _deviations(rotors: int) -> tuple[Any, Any]:
    """Return the deviations from a nominal state, and from hover with any heading."""
    return as_numpy(deviation(rotors)), as_numpy(hover_deviation(rotors))
