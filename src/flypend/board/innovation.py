"""What an estimator expects of each sensor, and what a reading that differs tells of its errors."""

from __future__ import annotations

import casadi as ca

from flypend.board import error_state as errors
from flypend.board.accelerometer import force_of
from flypend.board.error_state import Reading
from flypend.board.history import REACH, History, finds_latency
from flypend.geometry import Matrix, Numbers, Scalar, Vector, cross, parallel_transport, unit, vee
from flypend.model import State, Vehicle
from flypend.plants.defects import POSES
from flypend.plants.sensing import readings_record
from flypend.plants.sensors import Sensors

# Streams that correct centre of mass, attitude and rod.
GATED = ("position", "attitude", "rod", "joints", "rod_gyro")


class Expected:
    """The readings of one control tick beside an estimate, in CasADi.

    `readings` are what has arrived of `sensors`, as `plants.sensing` delivers it, and `state` is the estimate before
    correction, with the first vector `b` (3,) of the rod's frame. `turned` (3, 3) is the product of all corrections of
    the attitude, and `past` the memory of the past, which `history` lays out. Poses are `late` seconds older than told.
    """

    def __init__(
        self, sensors: Sensors, history: History, readings: Numbers, state: State, b: Vector, turned: Matrix,
        past: Numbers, late: Scalar = 0.0,
    ) -> None:  # fmt: skip
        self._sensors, self._history = sensors, history
        self._s, self._b, self._turned, self._past = state, b, turned, history.split(past)
        self._read = readings_record(sensors).split(readings)
        self._fresh = {name: self._has_arrived(name) for name in sensors.streams}
        for name in POSES:
            if name in sensors.streams:
                self._read[f"{name}_age"] += late

    def fresh(self, name: str) -> Scalar:
        """1 if the sensor `name` has a reading that is not older than the memory of the past, else 0."""
        return self._fresh[name]

    def _has_arrived(self, name: str) -> Scalar:
        age = self._read[f"{name}_age"]
        reach = REACH if name in POSES and finds_latency(self._sensors) else 0.0
        return (age >= 0) * (age <= self._history.oldest(name) - reach)

    def lateness(self) -> tuple[Vector, Vector]:
        """Return by how much the attitude read is turned from the expected one, rad, and its mean rate since, rad/s.

        Both in the world; one that is older than believed is turned back at that rate.
        """
        age = self._read["attitude_age"]
        rate = vee(self._s.R @ self._attitude_at(age).T) / ca.fmax(age, self._history.period)
        return self._attitude()[0], rate

    def readings(self, vehicle: Vehicle) -> list[list[Reading]]:
        """Return what is read of centre of mass, attitude and rod, number by number, for each stream of GATED."""
        found: list[list[Reading]] = []
        kinds = {
            "position": lambda: self._position(vehicle), "attitude": self._attitude, "rod": self._rod,
            "joints": self._joints, "rod_gyro": self._rod_rate,
        }  # fmt: skip
        for name, sensor in self._sensors.streams.items():
            if name in GATED:
                difference, rows = kinds[name]()
                variance, fresh = sensor.variance, self.fresh(name)
                found.append([Reading(difference[i], rows[i, :], variance, fresh) for i in range(rows.shape[0])])
        return found

    def omega(self, bias: Vector, gain: float) -> Vector:
        """Return the angular velocity (3,), rad/s, corrected with a `gain` by the gyroscope, which has a `bias`."""
        expected = self._s.omega + bias + self._history.at(self._past["turning"], 0.0, self._read["gyro_age"])
        return self._s.omega + self.fresh("gyro") * gain * (self._read["gyro"] - expected)

    def felt(self, bias: Vector, vehicle: Vehicle) -> tuple[Scalar, Vector]:
        """Return whether the accelerometer has read, and the force (3,) that it tells beyond the expected, body, N.

        It has a `bias` (3,), m/s².
        """
        felt, s = self._past["force"], self._s
        expected = self._history.at(felt[1:], felt[0], self._read["accelerometer_age"])
        difference = self._read["accelerometer"] - bias - expected
        return self.fresh("accelerometer"), force_of(difference, s.R.T @ s.y, vehicle)

    # Expectations: the difference of a reading, and its sensitivities -----------------------------------------------

    def _position(self, vehicle: Vehicle) -> tuple[Vector, Numbers]:
        age, s = self._read["position_age"], self._s
        expected = s.x - age * s.x_dot + self._history.at(self._past["x"], 0.0, age)
        return self._read["position"] - expected, errors.position_rows(self._b, s.y, age, vehicle)

    def _attitude(self) -> tuple[Vector, Numbers]:
        read = ca.reshape(self._read["attitude"], 3, 3).T
        return vee(read @ self._attitude_at(self._read["attitude_age"]).T), errors.attitude_rows()

    def _rod(self) -> tuple[Numbers, Numbers]:
        age = self._read["rod_age"]
        y, B = self._rod_at(age)
        return B.T @ (self._read["rod"] - y), errors.rod_rows(age)

    def _joints(self) -> tuple[Numbers, Numbers]:
        age = self._read["joints_age"]
        y, B = self._rod_at(age)
        return B.T @ (self._attitude_at(age) @ self._read["joints"] - y), errors.joint_rows(B, y, age)

    def _rod_rate(self) -> tuple[Numbers, Numbers]:
        age, s = self._read["rod_gyro_age"], self._s
        y, B = self._rod_at(age)
        y_dot = s.y_dot + self._history.at(self._past["swinging"], 0.0, age)
        read = self._attitude_at(age) @ self._read["rod_gyro"]
        return B.T @ (cross(read, y) - y_dot), errors.rod_rate_rows(B, y, y_dot)

    def _rod_at(self, age: Scalar) -> tuple[Vector, Numbers]:
        """Return the rod `age` seconds ago, and the frame there that its errors now are carried to."""
        s = self._s
        y = unit(s.y - age * s.y_dot + self._history.at(self._past["y"], 0.0, age))
        return y, errors.frame(parallel_transport(self._b, s.y, y), y)

    def _attitude_at(self, age: Scalar) -> Matrix:
        entries = self._past["attitude"]
        if not entries:
            return self._s.R
        now = ca.vec((self._turned.T @ self._s.R).T)
        return self._turned @ ca.reshape(self._history.at(entries, now, age), 3, 3).T
