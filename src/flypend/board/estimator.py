"""The estimator on board: an error-state Kalman filter on R³ × SO(3) × S² with modelled thrust.

Each control period it compares what the sensors read with what it expected then, corrects its estimate, and, once the
command is given, moves on by a period with the board's own model of vehicle and rotors. Attitude, rod and centre of
mass have the covariance of `error_state`; the thrust's scale and force that an accelerometer adds have one of their own
(`felt`); the angular velocity is followed with a fixed gain, the solution of its scalar Riccati equation. What corrects
attitude and velocities again and again is put down to biases of gyroscope and accelerometer, and to forces that last.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from flypend.board import accelerometer, error_state
from flypend.board.command import OUTSIDE, total_forces
from flypend.board.error_state import Densities
from flypend.board.history import REACH, History, finds_latency
from flypend.board.innovation import GATED, Expected
from flypend.board.nominal import Nominal
from flypend.board.twin import Twin
from flypend.compile.record import Field, Record
from flypend.geometry import (
    E3,
    Matrix,
    Numbers,
    Scalar,
    Vector,
    any_tangent,
    clip,
    dot,
    parallel_transport,
    shorten,
    tangent_part,
)
from flypend.model import State, Vehicle
from flypend.model.momenta import split_force
from flypend.model.state import SIZE
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import hold, step_timing
from flypend.plants.loop import Loop
from flypend.plants.plant import Plant
from flypend.plants.schedule import Segment, segments_within
from flypend.plants.sensing import mean_force, readings_record
from flypend.plants.sensors import Sensors

# Bandwidth, 1/s, at which corrections of the velocities are taken for forces that last and for a bias of the
# accelerometer. Where the attitude is measured, it is FIRST in the beginning, when nothing is known of them, and falls
# to LASTING as the Riccati equation of a constant in white noise has it. Where it is not, a tilt is confused with a
# force, and only a slow integral leaves the claimed errors true. In a manoeuvre all fall with the square of the
# departure of the specific force from that of hover, beyond HOVERING (m/s²): what is corrected there is put down to the
# manoeuvre.
FIRST_BANDWIDTH, LASTING_BANDWIDTH, UNSEEN_BANDWIDTH, HOVERING = 1.3, 0.2, 0.1, 0.5
# The same, 1/s, of corrections of a measured attitude for a bias of the gyroscope.
BIAS_BANDWIDTH = 0.5
# Prior standard deviation of how much older poses are than told, s, and how it walks, s/√s: cameras do not change. A
# swing-up tells 20 ms within a tenth of a second all the same; a wider prior takes noise of slow turns for a latency.
LATE, LATE_WALK = 0.002, 1e-4

# Thrust, in weights, at which half of a force along it is taken for a scale of it.
LEAST_THRUST = 0.3


class Filter:
    """The estimator of `loop`, whose plant has sensors, as `nominal`.

    `finds` says whether the board finds the delay of its loop, and with it the forces that act.
    """

    def __init__(self, loop: Loop, nominal: Nominal, *, finds: bool = False) -> None:
        self.sensors: Sensors = loop.sampled.sensors
        self.period = 1 / loop.sampled.rate
        self.history = History.of(self.sensors, self.period)
        self._loop, self._nominal, self._finds = loop, nominal, finds

    @property
    def feels(self) -> bool:
        """Whether there is an accelerometer."""
        return self.sensors.accelerometer is not None

    @property
    def gated_streams(self) -> tuple[str, ...]:
        """The streams whose readings are compared with what is expected before they are believed."""
        return tuple(name for name in self.sensors.streams if name in GATED)

    @cached_property
    def record(self) -> Record:
        """Table of the memory."""
        late = [Field("late", 0, "how much older poses are than told, s")]
        late += [Field("late_doubt", 0, "variance of that, s^2")]
        turned = [Field("turned", 9, "product of all corrections of the attitude, world, by rows")]
        past, errors = self.history.record, error_state.PULL.stop
        what = "centre of mass, velocity, attitude, rod and rate, pull on the rod"
        if self.sensors.attitude is None:
            errors = error_state.FELT_BIAS.stop if self.feels else error_state.BIAS.stop
            what = f"{what}, and the biases of the IMU"
        fields = (
            Field("state", SIZE, "the estimate, e3 up"),
            Field("rotors", self._nominal.rotors, "modelled forces of the rotors, N"),
            Field("frame", 3, "first vector of the frame across the rod, world"),
            Field("force", 3, "force on the whole that lasts, beyond the modelled thrust, world, N"),
            Field("bandwidth", 0, "at which corrections are taken for forces, 1/s"),
            Field("bias", 3, "of the gyroscope, rad/s"),
            Field("pull", 0, "nominal over true length of the rod, less 1"),
            Field("rejections", len(self.gated_streams), "of late by each stream of poses and angles, readings"),
            Field("difference", 3, "of the forces that last, F_b/m - F_v/M, across the rod, world, m/s^2"),
            *[Field.of(accelerometer.RECORD)] * self.feels,
            *late * finds_latency(self.sensors),
            *turned * bool(self.history.depths["attitude"]),
            Field("covariance", errors * (errors + 1) // 2, f"of the {errors} errors: {what}, lower triangle by rows"),
            *[Field.of(past)] * bool(past.fields),
        )
        return Record("estimate", "Error-state Kalman filter.", fields)

    def begin(self) -> ca.Function:
        """Return (rotors (n,), estimate (24,), params) → memory before the first step."""
        rotors, packed = ca.SX.sym("r", self._nominal.rotors), ca.SX.sym("s", SIZE)
        vehicle, s = self._nominal.vehicle, State.symbolic(packed)
        b = any_tangent(s.y)
        P = error_state.first_covariance(self.sensors.start, s, error_state.frame(b, s.y), vehicle)
        P = ca.diagcat(P, error_state.PULL_PRIOR**2)
        if self.sensors.attitude is None:
            P = ca.diagcat(P, error_state.BIAS_PRIOR**2 * ca.SX.eye(3))
            if self.feels:
                P = ca.diagcat(P, error_state.FELT_BIAS_PRIOR**2 * ca.SX.eye(3))
        rows, weight = ca.vec(s.R.T), s.R.T @ (vehicle.g * E3)
        memory = self.record.join({
            "state": packed, "rotors": rotors, "frame": b, "force": np.zeros(3), "difference": np.zeros(3),
            "bandwidth": UNSEEN_BANDWIDTH if self.sensors.attitude is None else FIRST_BANDWIDTH,
            "bias": np.zeros(3), "pull": 0, "rejections": np.zeros(len(self.gated_streams)),
            "felt": accelerometer.begin(vehicle), "late": 0, "late_doubt": LATE**2,
            "turned": ca.vec(ca.SX.eye(3)), "covariance": error_state.pack(P),
            "past": self.history.begin(rows, weight),
        })  # fmt: skip
        return ca.Function("estimate_begun", [rotors, packed, self._nominal.symbols], [ca.densify(memory)])

    # Correction ---------------------------------------------------------------------------------------------------

    def correct(self) -> ca.Function:
        """Return (memory, readings, params) → memory, state (24,), e₃ up, and what is found, `command.OUTSIDE`."""
        memory = ca.SX.sym("memory", self.record.length)
        readings = ca.SX.sym("readings", readings_record(self.sensors).length)
        parts, vehicle = self.record.split(memory), self._nominal.vehicle
        before, frame = State.symbolic(parts["state"]), parts["frame"]
        known = ca.reshape(parts["turned"], 3, 3).T if "turned" in parts else ca.SX.eye(3)
        settled = self._settle(parts["covariance"])
        past, late = parts.get("past"), parts.get("late", 0.0)
        expected = Expected(self.sensors, self.history, readings, before, frame, known, past, late)
        if finds_latency(self.sensors):
            self._find_latency(parts, expected, settled)
        thrust = ca.sum1(parts["rotors"])
        departure = _departure(thrust * before.z + parts["force"] + self._accelerometer_force(parts, before.R), vehicle)
        calm = 1 / (1 + departure / HOVERING**2)
        error, P, rejections = error_state.update(
            error_state.unpack(parts["covariance"]), expected.readings(vehicle), parts["rejections"], calm
        )
        s, b, turn = error_state.correct(before, frame, error, vehicle)
        limit = self._loop.law.computer.force_limit * vehicle.weight
        bias = parts["bias"]
        if self.sensors.attitude is None:
            bias = bias + error[error_state.BIAS]
        else:
            bias = bias - BIAS_BANDWIDTH * settled * s.R.T @ error[error_state.TURN]
        omega = expected.omega(bias, self._gyro_gain())
        s = State(x=s.x, x_dot=s.x_dot, R=s.R, omega=omega, y=s.y, y_dot=s.y_dot)
        pace = calm * parts["bandwidth"]
        if self.sensors.attitude is not None:
            parts["bandwidth"] -= self.period * calm * (parts["bandwidth"] ** 2 - LASTING_BANDWIDTH**2)
        force, difference, outside = _correct(parts["force"], parts["difference"], error, b, s, vehicle, pace, limit)
        if self.feels:
            if self.sensors.attitude is None:
                correction = error[error_state.FELT_BIAS]
                taken = accelerometer.force_of(correction, s.R.T @ s.y, vehicle)
                parts["felt"] = accelerometer.correct_bias(parts["felt"], correction, taken)
            else:
                parts["felt"] = accelerometer.correct_bias(parts["felt"], -pace * s.R.T @ error[error_state.VELOCITY])
            fresh, reading = expected.felt(accelerometer.RECORD.split(parts["felt"])["bias"], vehicle)
            given = (fresh, reading, thrust, departure, vehicle, self.sensors, self.period)
            parts["felt"] = accelerometer.correct(parts["felt"], *given)
            outside = outside + ca.vertcat(self._accelerometer_force(parts, s.R), np.zeros(3))
            scale = _scale(outside[:3], thrust, s.z, vehicle)
            outside = outside - ca.vertcat(scale * thrust * s.z, np.zeros(3))
        most = error_state.MOST_PULL
        pull = clip(parts["pull"] + error[error_state.PULL], -most, most)
        parts |= {
            "state": s.packed(), "frame": b, "force": force, "difference": difference, "bias": bias, "pull": pull,
            "rejections": rejections, "turned": ca.vec((turn @ known).T), "covariance": error_state.pack(P),
        }  # fmt: skip
        found = {"forces": outside, "scale": scale if self.feels else 0, "pull": pull}
        outputs = ca.cse([ca.densify(v) for v in (self.record.join(parts), s.packed(), OUTSIDE.join(found))])
        return ca.Function("correct", [memory, readings, self._nominal.symbols], outputs)

    def _settle(self, covariance: Numbers) -> Scalar:
        """Return the steady variance of the attitude over the present one, at most 1; 1 where it is not measured.

        What is still known badly is corrected much, and that says nothing of a bias or a latency: in a Kalman filter of
        both, the share that is put down to a bias is in this proportion.
        """
        attitude, gyro = self.sensors.attitude, self.sensors.gyro
        if attitude is None:
            return ca.SX(1)
        assert gyro is not None
        P = error_state.unpack(covariance)[error_state.TURN, error_state.TURN]
        steady = np.sqrt(gyro.density(self.period) * attitude.density(self.period))
        return ca.fmin(3 * steady / ca.trace(P), 1)

    def _find_latency(self, parts: dict[str, Any], expected: Expected, settled: Scalar) -> None:
        """Correct in `parts` how much older poses are than told, by how far the attitude read lags behind its rate."""
        assert self.sensors.attitude is not None
        turn, rate = expected.lateness()
        P = error_state.unpack(parts["covariance"])[error_state.TURN, error_state.TURN]
        doubt = parts["late_doubt"] + self.period * LATE_WALK**2
        variance = doubt * dot(rate, rate) + self.sensors.attitude.variance + ca.trace(P) / 3
        near = dot(turn, turn) < error_state.GATE**2 * variance  # another body tells nothing
        gain = settled * expected.fresh("attitude") * near * doubt / variance
        parts["late"] = clip(parts["late"] - gain * dot(rate, turn), 0, REACH)
        parts["late_doubt"] = doubt * (1 - gain * dot(rate, rate))

    def _accelerometer_force(self, parts: dict[str, Any], R: Matrix) -> Vector:
        """Return the force (3,) that the accelerometer adds to the modelled thrust, world, N; 0 without one."""
        return R @ accelerometer.beyond(parts["felt"], ca.sum1(parts["rotors"])) if self.feels else ca.SX.zeros(3)

    # Propagation --------------------------------------------------------------------------------------------------

    def carry(self) -> ca.Function:
        """Return (memory, outside, given, params) → memory a control period later.

        What is given are the commands by age, or, where the board finds its delay, the forces (n,) of the rotors that
        act at the end of the period, N.
        """
        segments = segments_of(self._loop.sampled)
        width = 4 if self._loop.sampled.interface == "rates" else self._nominal.rotors
        size = self._nominal.rotors if self._finds else width * (1 + max(segment.age for segment in segments))
        memory, outside = ca.MX.sym("memory", self.record.length), ca.MX.sym("outside", OUTSIDE.length)
        given = ca.MX.sym("given", size)
        params = ca.MX.sym("params", self._nominal.symbols.numel())
        state, rotors = (memory[self.record.place(name)] for name in ("state", "rotors"))
        forces = total_forces(self._nominal)(state, rotors, outside)
        pulled = self._pull()(memory, forces, params)
        if self._finds:
            state, rotors = self._advance()(state, rotors, given, pulled, params), given
        else:
            twin = Twin(self._loop, self._nominal, params, forces=True, name="carried")
            state, rotors = twin.advance(state, rotors, ca.vertsplit(given, width), segments, pulled)
        rest = self._spread()(memory, forces, state, params)
        after = ca.vertcat(state, rotors, rest)
        return ca.Function("carry", [memory, outside, given, params], [after])

    def _pull(self) -> ca.Function:
        """Return (memory, outside (6,), params) → forces (6,), N, under which a nominal rod moves as the true one.

        Of the pull on a rod of another length, they add what the model lacks, as a pair that leaves the whole alone.
        """
        memory, outside = ca.SX.sym("memory", self.record.length), ca.SX.sym("outside", 6)
        parts, vehicle = self.record.split(memory), self._nominal.vehicle
        M, m, s = vehicle.M, vehicle.m, State.symbolic(parts["state"])
        on_vehicle = ca.sum1(parts["rotors"]) * s.z + outside[:3]
        more = parts["pull"] * tangent_part(s.y, outside[3:] / m - on_vehicle / M)
        pulled = outside + ca.vertcat(*split_force(ca.SX(3, 1), more, vehicle))
        return ca.Function("pulled", [memory, outside, self._nominal.symbols], [ca.cse(ca.densify(pulled))])

    def _advance(self) -> ca.Function:
        """Return (state, rotors (n,) at the beginning and at the end, outside, params) → state a period later.

        In between the forces change as under a held command.
        """
        nominal, h = self._nominal, self.period
        state, outside = ca.SX.sym("s", SIZE), ca.SX.sym("F", 6)
        begin, end = (ca.SX.sym(name, nominal.rotors) for name in "be")
        timing = step_timing(nominal.lag, h)
        command = end - timing[1] / (1 - timing[1]) * (begin - end)
        ramp, _ = hold(begin, command, timing)
        moved = cascade_step(state, ramp.mix(nominal.vehicle.mixing()), outside, h, nominal.vehicle)
        return ca.Function("moved", [state, begin, end, outside, nominal.symbols], [ca.cse(ca.densify(moved))])

    def _spread(self) -> ca.Function:
        """Return (memory, outside, state after, params) → the memory after state and rotors, a period later."""
        memory = ca.SX.sym("memory", self.record.length)
        outside, after = ca.SX.sym("outside", 6), ca.SX.sym("after", SIZE)
        parts, vehicle, h = self.record.split(memory), self._nominal.vehicle, self.period
        s, s_after = State.symbolic(parts["state"]), State.symbolic(after)
        force = ca.sum1(parts["rotors"]) * s.z + outside[:3]
        P = error_state.unpack(parts["covariance"])
        P = error_state.propagate(P, s, parts["frame"], force, vehicle, h, self._densities(force + outside[3:]))
        parts |= {
            "frame": parallel_transport(parts["frame"], s.y, s_after.y),
            "covariance": error_state.pack(P),
            "past": self._remember(parts, s, s_after),
        }
        rest = self.record.join(parts)[self.record.place("frame").start :]
        return ca.Function("spread", [memory, outside, after, self._nominal.symbols], [ca.cse(ca.densify(rest))])

    def _remember(self, parts: dict[str, Any], s: State, after: State) -> Numbers:
        """Return the past a period later; newest entries are those of the period that ends now."""
        history, past = self.history, self.history.split(parts.get("past"))
        entries = {
            "x": history.move(past["x"], s.x, s.x_dot, after.x, after.x_dot),
            "y": history.move(past["y"], s.y, s.y_dot, after.y, after.y_dot),
            "turning": history.shift(past["turning"], s.omega, after.omega),
            "swinging": history.shift(past["swinging"], s.y_dot, after.y_dot),
            "force": [
                mean_force(s.x_dot, after.x_dot, s.R, after.R, self._nominal.vehicle.g, self.period),
                *past["force"],
            ],
        }
        if history.depths["attitude"]:
            turned = ca.reshape(parts["turned"], 3, 3).T
            entries["attitude"] = [ca.vec((turned.T @ s.R).T), *past["attitude"]]
        return history.join(entries)

    def _gyro_gain(self) -> float:
        gyro = self.sensors.gyro
        assert gyro is not None
        return steady_gain(self.sensors.moment_error**2 / min(gyro.rate, 1 / self.period), gyro.variance)

    def _densities(self, force: Vector) -> Densities:
        """Return the densities where `force` (3,) acts on the whole beside its weight, world frame, N."""
        assert self.sensors.gyro is not None
        departure = _departure(force, self._nominal.vehicle)
        return Densities(*self.sensors.process_noise(self.period, departure), self.sensors.gyro.density(self.period))


def _departure(force: Vector, vehicle: Vehicle) -> Scalar:
    """Return the squared departure, (m/s²)², of the specific force from that of hover, for the vehicle's `force`, N."""
    departure = force / (vehicle.M + vehicle.m) - vehicle.g * E3
    return dot(departure, departure)


def _scale(force: Vector, thrust: Scalar, z: Vector, vehicle: Vehicle) -> Scalar:
    """Return the scale of the `thrust` (N) along `z` that an external `force` (3,), N, on the vehicle amounts to.

    Hardly any where the thrust is below LEAST_THRUST, where a force is not told from a scale.
    """
    scale = dot(force, z) * thrust / (thrust**2 + (LEAST_THRUST * vehicle.weight) ** 2)
    return clip(scale, -accelerometer.MOST_SCALE, accelerometer.MOST_SCALE)


def _correct(
    total: Vector, difference: Vector, error: Numbers, b: Vector, s: State, vehicle: Vehicle, pace: Scalar,
    limit: Scalar,
) -> tuple[Vector, Vector, Numbers]:  # fmt: skip
    """Return `total` force and `difference` across the rod, each (3,), corrected, and on vehicle and bob (6,), N.

    A velocity that is corrected again and again in one direction is driven by a force: the integral of the corrections.
    Forces are limited to `limit`, N.
    """
    M, m, l = vehicle.M, vehicle.m, vehicle.l
    total = total + pace * (M + m) * error[error_state.VELOCITY]
    B = error_state.frame(b, s.y)
    difference = tangent_part(s.y, difference) + pace * l * B @ error[error_state.SWING]
    total, difference = shorten(total, limit), shorten(difference, limit / m)
    return total, difference, ca.vertcat(*split_force(total, difference, vehicle))


def segments_of(plant: Plant) -> tuple[Segment, ...]:
    """Return the intervals of a control period by the age of the command that acts, as the estimator assumes them."""
    return segments_within(plant.assumed_delay, 1 / plant.rate)


def steady_gain(wander: float, noise: float) -> float:
    """Return the steady gain of a scalar Kalman filter with variances `wander` added per reading and `noise` of it."""
    expected = (wander + np.sqrt(wander**2 + 4 * wander * noise)) / 2
    return float(expected / (expected + noise))
