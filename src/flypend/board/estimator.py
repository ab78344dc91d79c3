"""The estimator on board: an error-state Kalman filter on R³ × SO(3) × S² with modelled thrust.

Each control period it compares what the sensors read with what it expected then, corrects its estimate, and, once the
command is given, moves on by a period with the board's own model of vehicle and rotors. Angular velocity and the force
that an accelerometer adds to the modelled thrust are followed with fixed gains, the solution of their scalar Riccati
equations; attitude, rod and centre of mass with the covariance of `error_state`.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import casadi as ca
import numpy as np

from flypend.board import error_state
from flypend.board.believed import Believed
from flypend.board.error_state import COVARIANCE, Densities
from flypend.board.expected import Expected
from flypend.board.history import History
from flypend.board.twin import Twin
from flypend.geometry import E3, dot, norm, tangent_part
from flypend.model import State
from flypend.model.state import SIZE
from flypend.plants.loop import Loop
from flypend.plants.plant import Plant
from flypend.plants.schedule import Segment, within_period
from flypend.plants.sensing import mean_force, readings_size
from flypend.plants.sensors import Sensors

# Bandwidth, 1/s, at which the force that the accelerometer adds to the modelled thrust is followed. A faster one would
# only pass on its noise: what the model lacks changes slowly, or is noise itself.
FELT_BANDWIDTH = 0.5
# Bandwidth, 1/s, at which corrections of the velocities are taken for forces that last: at 0.5 the integral shakes the
# rod. It falls with the square of the departure of the specific force from that of hover, beyond HOVERING (m/s²): what
# is corrected in a manoeuvre is put down to the manoeuvre.
LASTING_BANDWIDTH, HOVERING = 0.15, 0.5


@dataclass(frozen=True)
class Parts:
    """The memory of a `Filter` in parts.

    State (24,), e₃ up; forces of the rotors (n,), N; first vector of the rod's frame (3,); forces beyond the modelled
    thrust: total and F_b/m − F_v/M that last (world frame, N and m/s²), and what an accelerometer felt (body frame, N);
    product of all corrections of the attitude, by rows (9,); covariance (91,); the past.
    """

    state: Any
    rotors: Any
    frame: Any
    force: Any
    turned: Any
    covariance: Any
    past: Any


class Filter:
    """The estimator of `loop`, whose plant has sensors, as `believed`."""

    def __init__(self, loop: Loop, believed: Believed) -> None:
        self.sensors: Sensors = loop.sampled.sensors
        self.period = 1 / loop.sampled.rate
        self.history = History.of(self.sensors, self.period)
        self._loop, self._believed = loop, believed
        lengths = (SIZE, believed.rotors, 3, 9 if self.feels else 6, 9 if self.history.depths["attitude"] else 0)
        self._lengths = (*lengths, COVARIANCE, self.history.size)

    @property
    def feels(self) -> bool:
        """Whether there is an accelerometer."""
        return self.sensors.accelerometer is not None

    @property
    def size(self) -> int:
        """Length of the memory."""
        return sum(self._lengths)

    def split(self, memory: Any) -> Parts:
        """Return the parts of a `memory`."""
        ends = np.cumsum([0, *self._lengths])
        return Parts(*(memory[int(a) : int(b)] for a, b in pairwise(ends)))

    def begun(self) -> ca.Function:
        """Return (rotors (n,), estimate (24,), params) → memory before the first step."""
        rotors, packed = ca.SX.sym("r", self._believed.rotors), ca.SX.sym("s", SIZE)
        vehicle, s = self._believed.vehicle, State.symbolic(packed)
        b = error_state.any_tangent(s.y)
        P = error_state.first_covariance(self.sensors.start, s, error_state.frame(b, s.y), vehicle)
        rows, weight = ca.vec(s.R.T), s.R.T @ (vehicle.g * E3)
        turned = ca.vec(ca.SX.eye(3)) if self.history.depths["attitude"] else ca.SX(0, 1)
        memory = ca.vertcat(
            packed, rotors, b, np.zeros(9 if self.feels else 6), turned, error_state.packed(P),
            self.history.begun(rows, weight),
        )  # fmt: skip
        return ca.Function("estimate_begun", [rotors, packed, self._believed.symbols], [ca.densify(memory)])

    def rotors(self, memory: Any) -> Any:
        """Return the modelled forces of the rotors (n,), N, in a `memory`."""
        return memory[SIZE : SIZE + self._believed.rotors]

    # Correction ---------------------------------------------------------------------------------------------------

    def correct(self) -> ca.Function:
        """Return (memory, readings, params) → memory, state (24,), external forces on vehicle and bob (6,), e₃ up."""
        memory, readings = ca.SX.sym("memory", self.size), ca.SX.sym("readings", readings_size(self.sensors))
        parts, vehicle = self.split(memory), self._believed.vehicle
        before, turned = State.symbolic(parts.state), parts.turned
        known = ca.reshape(turned, 3, 3).T if turned.numel() else ca.SX.eye(3)
        expected = Expected(self.sensors, self.history, readings, before, parts.frame, known, parts.past)
        error, P = error_state.updated(error_state.unpacked(parts.covariance), expected.readings(vehicle))
        s, b, turn = error_state.corrected(before, parts.frame, error, vehicle)
        omega = expected.omega(self._gyro_gain())
        s = State(x=s.x, x_dot=s.x_dot, R=s.R, omega=omega, y=s.y, y_dot=s.y_dot)
        limit = self._loop.law.computer.force_limit * vehicle.weight
        thrust = ca.sum1(parts.rotors) * before.z
        pace = LASTING_BANDWIDTH / (1 + _departure(thrust, vehicle) / HOVERING**2)
        force, outside = _lasting(parts.force[:6], error, b, s, vehicle, pace, limit)
        if self.feels:
            felt = expected.force(parts.force[6:], -np.expm1(-FELT_BANDWIDTH * self.period), vehicle)
            force, outside = ca.vertcat(force, felt), outside + ca.vertcat(s.R @ felt, np.zeros(3))
        if turned.numel():
            turned = ca.vec((turn @ known).T)
        after = ca.vertcat(s.packed(), parts.rotors, b, force, turned, error_state.packed(P), parts.past)
        outputs = ca.cse([ca.densify(v) for v in (after, s.packed(), outside)])
        return ca.Function("correct", [memory, readings, self._believed.symbols], outputs)

    # Propagation --------------------------------------------------------------------------------------------------

    def carry(self) -> ca.Function:
        """Return (memory, outside, commands by age, params) → memory a control period later."""
        segments = assumed_segments(self._loop.sampled)
        count = 1 + max(segment.age for segment in segments)
        width = 4 if self._loop.sampled.interface == "rates" else self._believed.rotors
        memory, outside = ca.MX.sym("memory", self.size), ca.MX.sym("outside", 6)
        acting = outside
        commands = ca.MX.sym("commands", width * count)
        params = ca.MX.sym("params", self._believed.symbols.numel())
        twin = Twin(self._loop, self._believed, params, forces=True, name="carried")
        state, rotors = memory[:SIZE], self.rotors(memory)
        given = ca.vertsplit(commands, width)
        state, rotors = twin.advance(state, rotors, given, segments, acting)
        rest = self._spread()(memory, acting, state, params)
        after = ca.vertcat(state, rotors, rest)
        return ca.Function("carry", [memory, outside, commands, params], [after])

    def _spread(self) -> ca.Function:
        """Return (memory, outside, state after, params) → the memory after state and rotors, a period later."""
        memory, outside, after = ca.SX.sym("memory", self.size), ca.SX.sym("outside", 6), ca.SX.sym("after", SIZE)
        parts, vehicle, h = self.split(memory), self._believed.vehicle, self.period
        s, s_after = State.symbolic(parts.state), State.symbolic(after)
        force = ca.sum1(parts.rotors) * s.z + outside[:3]
        P = error_state.unpacked(parts.covariance)
        P = error_state.spread(P, s, parts.frame, force, vehicle, h, self._densities(force))
        b = error_state.carried_frame(parts.frame, s.y, s_after.y)
        past = self._remembered(parts, s, s_after)
        rest = ca.vertcat(b, parts.force, parts.turned, error_state.packed(P), past)
        return ca.Function("spread", [memory, outside, after, self._believed.symbols], [ca.cse(ca.densify(rest))])

    def _remembered(self, parts: Parts, s: State, after: State) -> Any:
        """Return the past a period later; newest entries are those of the period that ends now."""
        history, past = self.history, self.history.split(parts.past)
        entries = {
            "x": history.moved(past["x"], s.x, s.x_dot, after.x, after.x_dot),
            "y": history.moved(past["y"], s.y, s.y_dot, after.y, after.y_dot),
            "turning": history.shifted(past["turning"], s.omega, after.omega),
            "swinging": history.shifted(past["swinging"], s.y_dot, after.y_dot),
            "force": [self._expected_force(s, after), *past["force"]],
        }
        if history.depths["attitude"]:
            turned = ca.reshape(parts.turned, 3, 3).T
            entries["attitude"] = [ca.vec((turned.T @ s.R).T), *past["attitude"]]
        return history.joined(entries)

    def _expected_force(self, s: State, after: State) -> Any:
        return mean_force(s.x_dot, after.x_dot, s.R, after.R, self._believed.vehicle.g, self.period)

    def _gyro_gain(self) -> float:
        gyro = self.sensors.gyro
        assert gyro is not None
        return steady_gain(self.sensors.moment_error**2 / min(gyro.rate, 1 / self.period), gyro.variance)

    def _densities(self, force: Any) -> Densities:
        """Return the densities at a `force` (3,) of the vehicle on its rotors' axes, world frame, N.

        The noise of the accelerometer is part of the force that it adds. It is slower than white noise; to count it in
        full claims too little of the height, not too much of anything.
        """
        sensors = self.sensors
        assert sensors.gyro is not None
        lacking = sensors.force_error**2 + sensors.manoeuvre_error**2 * _departure(force, self._believed.vehicle)
        felt = 0.0 if sensors.accelerometer is None else sensors.accelerometer.density(self.period)
        return Densities(lacking + felt, lacking, sensors.gyro.density(self.period))


def _departure(force: Any, vehicle: Any) -> Any:
    """Return the squared departure, (m/s²)², of the specific force from that of hover, for the vehicle's `force`, N."""
    departure = force / (vehicle.M + vehicle.m) - vehicle.g * E3
    return dot(departure, departure)


def _lasting(force: Any, error: Any, b: Any, s: State, vehicle: Any, pace: Any, limit: Any) -> tuple[Any, Any]:
    """Return total force and F_b/m − F_v/M across the rod (6,) after a correction, and on vehicle and bob (6,), N.

    A velocity that is corrected again and again in one direction is driven by a force: the integral of the corrections.
    Forces are limited to `limit`, N.
    """
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    total = force[:3] + pace * (M + m) * error[error_state.VELOCITY]
    B = error_state.frame(b, s.y)
    total = total / ca.fmax(1, norm(total) / limit)
    difference = tangent_part(s.y, force[3:]) + pace * l * B @ error[error_state.SWING]
    difference = difference / ca.fmax(1, norm(difference) * m / limit)
    on_bob = m * M / (M + m) * (difference + total / M)
    return ca.vertcat(total, difference), ca.vertcat(total - on_bob, on_bob)


def assumed_delay(plant: Plant) -> float:
    """Return the delay (s) from measurement to command that the estimator in a `plant` with sensors assumes."""
    given = plant.sensors.command_delay
    return float(plant.delay if given is None else given)


def assumed_segments(plant: Plant) -> tuple[Segment, ...]:
    """Return the intervals of a control period by the age of the command that acts, as the estimator assumes them."""
    return within_period(assumed_delay(plant), 1 / plant.rate)


def steady_gain(wander: float, noise: float) -> float:
    """Return the steady gain of a scalar Kalman filter with variances `wander` added per reading and `noise` of it."""
    expected = (wander + np.sqrt(wander**2 + 4 * wander * noise)) / 2
    return float(expected / (expected + noise))
