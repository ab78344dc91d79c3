"""What is wrong with sensors beyond noise: errors that last, poses of another body, losses, vibration.

Each defect changes what is read, or when it arrives, and is no part of what the estimator is told. Sizes are numbers at
run time (`sizes`). A defect of size 0 adds nothing to the program, unless it is adjustable. In the frame of the
cameras, with Q = exp(frame_turned^), markers at R o and M = exp(markers_turned^),

    position = (1 + frame_scale) Q (x + R o) + frame_off,    attitude = Q R M,    rod = Q unit(y + d₁ b + d₂ y × b),

where b ⊥ y moves with the rod and does not turn about it. With N = exp(imu_turned^), the IMU reads

    gyro = (1 + gyro_scale) Nᵀ ω + gyro_bias + walk,

plus vibration, and the accelerometer reads alike.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from statistics import NormalDist
from types import MappingProxyType
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.record import Field, Record
from flypend.geometry import (
    Matrix,
    Numbers,
    Scalar,
    Vector,
    any_tangent,
    cross,
    hat,
    is_symbolic,
    parallel_transport,
    rotation_from_vector,
    tangent_part,
    unit,
)
from flypend.plants.cascade import rotation_by
from flypend.plants.defects import CONSTANT, NAMES, POSES, names_drawn, present, shifts
from flypend.plants.measurement import NEVER, direction, normal_quantile, uniform
from flypend.plants.sensors import Sensors

ONE_FRAME = 1e-9  # keeps the probability of a burst per tick below 1, whatever the rate of control


def record(sensors: Sensors) -> Record:
    """Return the memory of the defects."""
    of_flight = sum(CONSTANT[name][0] for name in names_drawn(sensors))
    return Record(
        "defects",
        "What is wrong with the sensors in this flight.",
        (
            *[Field("errors", of_flight, "draws of those of each flight, in the order of their declaration")]
            * (of_flight > 0),
            *[Field("gyro_walk", 3, "rad/s")] * present(sensors, "gyro_bias_walk"),
            *[Field("accelerometer_walk", 3, "m/s^2")] * present(sensors, "accelerometer_bias_walk"),
            *[Field("rod_frame", 3, "unit vector across the rod that moves with it, world")]
            * present(sensors, "rod_markers_off"),
            *[Field("burst", 1, "how long frames are lost yet, s")] * present(sensors, "bursts"),
        ),
    )


def first(sensors: Sensors, y: Vector, draws: Numbers) -> Numbers:
    """Return the memory of the defects at the start, for a rod `y` (3,) and standard normal `draws`."""
    values = {
        "errors": draws,
        "gyro_walk": np.zeros(3),
        "accelerometer_walk": np.zeros(3),
        "rod_frame": any_tangent(y),
        "burst": 0.0,
    }
    return record(sensors).join(values)


def sizes(sensors: Sensors, period: float, given: Mapping[str, Any] = MappingProxyType({})) -> dict[str, list[Any]]:
    """Return the numbers of each defect that `Defects` takes at run time, for a control `period`, s.

    `given` are sizes in place of those of `sensors`, in CasADi, of defects that are not vectors.
    """
    values = {name: getattr(sensors, name) for name in NAMES} | dict(given)
    found: dict[str, list[Any]] = {}
    for name in CONSTANT:
        if np.ndim(getattr(sensors, name)):
            turned = name.endswith("_turned")
            found[name] = np.ravel(rotation_from_vector(values[name]) if turned else values[name]).tolist()
        else:
            found[name] = [values[name]]
    angle = 2 * np.pi * values["vibration_rate"]
    # The mean of the wave over the period: that of its middle, less by sin(a/2)/(a/2).
    averaged = values["vibration"] * float(np.sinc(angle * period / (2 * np.pi)))
    turned = values["outlier_turned"]
    found |= {
        "gyro_bias_walk": [values["gyro_bias_walk"] * np.sqrt(period)],
        "accelerometer_bias_walk": [values["accelerometer_bias_walk"] * np.sqrt(period)],
        "vibration": [averaged, angle],
        "gyro_vibration": [values["gyro_vibration"], angle],
        "outliers": [_quantile(values["outliers"]), values["outlier_off"], np.sin(turned), np.cos(turned)],
        "bursts": [_quantile(values["bursts"] * period), values["burst_time"]],
        "latency_jitter": [values["latency_jitter"]],
        "untold_latency": [values["untold_latency"]],
    }
    late = shifts(sensors)
    return {
        name: some for name, some in found.items() if (late if name == "untold_latency" else present(sensors, name))
    }


def size_numbers(sensors: Sensors, period: float) -> Numbers:
    """Return the `sizes` (n,) of `sensors`, one after the other."""
    return np.concatenate([*sizes(sensors, period).values(), np.zeros(0)])


def _quantile(probability: Any) -> Any:
    """Return below what a standard normal number is with this probability."""
    if is_symbolic(probability):
        return normal_quantile(probability)
    return NormalDist().inv_cdf(min(probability, 1 - ONE_FRAME)) if probability > 0 else NEVER


def _carry(b: Vector, y: Vector, y_after: Vector) -> Vector:
    """Return the unit vector `b` ⊥ `y` carried to `y_after`, without what roundoff adds up over many periods."""
    return unit(tangent_part(y_after, parallel_transport(b, y, y_after)))


def _turn_about(axis: Vector, sine: Scalar, cosine: Scalar) -> Matrix:
    """Return the rotation about the unit vector `axis` by the angle with this `sine` and `cosine`."""
    k = hat(axis)
    return ca.SX.eye(3) + sine * k + (1 - cosine) * k @ k


class Defects:
    """The defects of `sensors` at one control tick, in CasADi.

    The tick is at the time `t`, s, in control periods of `period`, s; `y_before` and `y` (3,) are the rod at the tick
    before and at this one, world. `memory` is as `record` has it, `draws` holds the standard normal numbers of this
    tick, as many as `random_numbers` says, and `numbers` (n,) the `sizes`, one after the other.
    """

    def __init__(
        self, sensors: Sensors, period: float, t: Scalar, y_before: Vector, y: Vector, memory: Numbers,
        draws: Mapping[str, Any], numbers: Numbers,
    ) -> None:  # fmt: skip
        self._sensors, self._period, self._t, self._y, self._draws = sensors, period, t, y, draws
        self.memory = record(sensors).split(memory)
        lengths = [len(some) for some in sizes(sensors, period).values()]
        parts = ca.vertsplit(numbers, np.cumsum([0, *lengths]).tolist()) if lengths else []
        self._sizes = dict(zip(sizes(sensors, period), parts, strict=True))
        self._errors = dict(self._lasting_errors())
        for name in ("gyro", "accelerometer"):
            if (size := self._sizes.get(f"{name}_bias_walk")) is not None:
                self.memory[f"{name}_walk"] += size * draws[f"{name}_bias_walk"]
        if "rod_markers_off" in self._sizes:
            self.memory["rod_frame"] = _carry(self.memory["rod_frame"], y_before, y)
        if "bursts" in self._sizes:
            begins = self._happens("bursts", 0)
            burst, lasts = self.memory["burst"], self._sizes["bursts"][1]
            self.memory["burst"] = ca.if_else(begins, lasts, ca.fmax(burst - period, 0))

    def _lasting_errors(self) -> Iterator[tuple[str, Any]]:
        """Yield name and value of every error that lasts; a rotation that is given as its matrix, by rows."""
        place, of_flight = 0, names_drawn(self._sensors)
        for name, (length, *_) in CONSTANT.items():
            if name in of_flight:
                yield name, self._sizes[name] * self.memory["errors"][place : place + length]
                place += length
            elif name in self._sizes:
                yield name, self._sizes[name]

    def _happens(self, name: str, i: int) -> Scalar:
        return self._draws[name][i] < self._sizes[name][0]

    @property
    def after(self) -> Numbers:
        """The memory after this tick."""
        return record(self._sensors).join(self.memory)

    def _turn(self, name: str) -> Matrix | None:
        if name not in self._errors:
            return None
        if name in names_drawn(self._sensors):
            return rotation_by(self._errors[name])
        return ca.reshape(self._errors[name], 3, 3).T

    # Cameras ----------------------------------------------------------------------------------------------------------

    def position(self, x: Vector, R: Matrix) -> Vector:
        """Return where cameras see a vehicle that is at `x` in attitude `R`."""
        found = self._errors
        if "markers_off" in found:
            x = x + R @ found["markers_off"]
        if (Q := self._turn("frame_turned")) is not None:
            x = Q @ x
        if "frame_scale" in found:
            x = x + found["frame_scale"] * x
        return x + found["frame_off"] if "frame_off" in found else x

    def attitude(self, R: Matrix) -> Matrix:
        """Return the attitude in which cameras see a vehicle in attitude `R`."""
        if (Q := self._turn("frame_turned")) is not None:
            R = Q @ R
        M = self._turn("markers_turned")
        return R if M is None else R @ M

    def rod(self, y: Vector) -> Vector:
        """Return the direction in which cameras see a rod along `y`."""
        if "rod_markers_off" in self._errors:
            off, b = self._errors["rod_markers_off"], _carry(self.memory["rod_frame"], self._y, y)
            y = unit(y + off[0] * b + off[1] * cross(y, b))
        Q = self._turn("frame_turned")
        return y if Q is None else Q @ y

    def mistaken(self, name: str, values: Numbers) -> Numbers:
        """Return the `values` read of a pose, or of another body in its place."""
        if "outliers" not in self._sizes or name not in POSES:
            return values
        draws, (_, off, sine, cosine) = self._draws["outliers"], ca.vertsplit(self._sizes["outliers"])
        wrong = self._happens("outliers", 7 if name == "rod" else 0)
        if name == "position":
            other = values + off * direction(draws[1:4])
        elif name == "attitude":
            other = ca.vec((ca.reshape(values, 3, 3).T @ _turn_about(direction(draws[4:7]), sine, cosine)).T)
        else:
            across = unit(tangent_part(values, draws[8:11]))
            other = cosine * values + sine * across
        return ca.if_else(wrong, other, values)

    def lost(self, name: str) -> Scalar | None:
        """Return whether a reading of the stream `name` is lost in a burst; None if there are none."""
        return self.memory["burst"] > 0 if "bursts" in self._sizes and name in POSES else None

    def shift(self, name: str) -> Scalar | None:
        """Return by how much (s) a reading of the stream `name` is later than is told; None if that is no number."""
        if not shifts(self._sensors) or name not in POSES:
            return None
        if "latency_jitter" not in self._sizes:
            return self._sizes["untold_latency"]
        return self._sizes["untold_latency"] + self._sizes["latency_jitter"] * uniform(self._draws["latency_jitter"])

    # IMU and joints ---------------------------------------------------------------------------------------------------

    def gyro(self, omega: Vector) -> Vector:
        """Return what a gyroscope reads at an angular velocity `omega`, body frame."""
        read = self._inertial("gyro", omega)
        return read + self._wave("gyro_vibration", 0) if "gyro_vibration" in self._sizes else read

    def accelerometer(self, force: Vector) -> Vector:
        """Return what an accelerometer reads under the mean specific `force` of the last period, body frame."""
        read = self._inertial("accelerometer", force)
        return read + self._wave("vibration", -self._period / 2) if "vibration" in self._sizes else read

    def _inertial(self, name: str, value: Vector) -> Vector:
        if (N := self._turn("imu_turned")) is not None:
            value = N.T @ value
        if (scale := self._errors.get(f"{name}_scale")) is not None:
            value = value + scale * value
        if (bias := self._errors.get(f"{name}_bias")) is not None:
            value = value + bias
        return value + self.memory[f"{name}_walk"] if f"{name}_walk" in self.memory else value

    def _wave(self, name: str, shift: float) -> Vector:
        """Return the wave of a vibration on each axis, `shift` s from now; thirds of a turn lie between the axes."""
        amplitude, rate = ca.vertsplit(self._sizes[name])
        phase = rate * (self._t + shift)
        return amplitude * ca.vertcat(*(ca.sin(phase + 2 * np.pi * axis / 3) for axis in range(3)))

    @property
    def turns_joints(self) -> bool:
        """Whether the joint angles are off."""
        return "joints_off" in self._errors

    def joints(self, roll: Scalar, pitch: Scalar) -> tuple[Scalar, Scalar]:
        """Return the angles that the joint tells at `roll` and `pitch`, rad."""
        off = self._errors.get("joints_off")
        return (roll, pitch) if off is None else (roll + off[0], pitch + off[1])
