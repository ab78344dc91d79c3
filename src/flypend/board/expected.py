"""What an estimator expects of each sensor, and what a reading that differs tells of its errors."""

from __future__ import annotations

from typing import Any

import casadi as ca

from flypend.board import error_state as errors
from flypend.board.error_state import Reading
from flypend.board.history import History
from flypend.geometry import cross, dot, scale, unit
from flypend.model import State
from flypend.plants.sensing import WIDTH
from flypend.plants.sensors import Sensors


class Expected:
    """The readings of one control tick beside an estimate, in CasADi.

    Parameters
    ----------
    sensors : Sensors
        What is read.
    history : History
        Layout of the past.
    readings : SX
        What has arrived, as `plants.sensing` delivers it.
    state : State
        The estimate before correction.
    b : SX (3,)
        First vector of the rod's frame.
    turned : SX (3, 3)
        Product of all corrections of the attitude.
    past : SX
        Memory of the past.
    """

    def __init__(
        self, sensors: Sensors, history: History, readings: Any, state: State, b: Any, turned: Any, past: Any
    ) -> None:
        self._sensors, self._history = sensors, history
        self._s, self._b, self._turned, self._past = state, b, turned, history.split(past)
        self._values: dict[str, Any] = {}
        self._ages: dict[str, Any] = {}
        place = 0
        for name in sensors.streams:
            self._values[name] = readings[place : place + WIDTH[name]]
            self._ages[name] = readings[place + WIDTH[name]]
            place += WIDTH[name] + 1

    def fresh(self, name: str) -> Any:
        """1 if the sensor `name` has a reading that is not older than the memory of the past, else 0."""
        age = self._ages[name]
        return (age >= 0) * (age <= self._history.oldest(name))

    def readings(self, vehicle: Any) -> list[Reading]:
        """Return what is read of centre of mass, attitude and rod, number by number."""
        found: list[Reading] = []
        kinds = {
            "position": lambda: self._position(vehicle), "attitude": self._attitude, "rod": self._rod,
            "joints": self._joints, "rod_gyro": self._rod_rate,
        }  # fmt: skip
        for name, sensor in self._sensors.streams.items():
            if name in kinds:
                difference, rows = kinds[name]()
                variance, fresh = sensor.variance, self.fresh(name)
                found += [Reading(difference[i], rows[i, :], variance, fresh) for i in range(rows.shape[0])]
        return found

    def omega(self, gain: float) -> Any:
        """Return the angular velocity (3,), rad/s, corrected by the gyroscope with a `gain`."""
        expected = self._s.omega + self._history.at(self._past["turning"], 0.0, self._ages["gyro"])
        return self._s.omega + self.fresh("gyro") * gain * (self._values["gyro"] - expected)

    def force(self, before: Any, gain: float, vehicle: Any) -> Any:
        """Return the force beyond the modelled thrust (3,), body frame, N, corrected by the accelerometer.

        A force F on the vehicle accelerates it by F/M across the rod and by F/(M+m) along it, as it moves the bob too.
        """
        felt, s = self._past["force"], self._s
        difference = self._values["accelerometer"] - self._history.at(felt[1:], felt[0], self._ages["accelerometer"])
        along = s.R.T @ s.y
        force = vehicle.M * difference + vehicle.m * scale(dot(along, difference), along)
        return before + self.fresh("accelerometer") * gain * force

    # Expectations: the difference of a reading, and its sensitivities -----------------------------------------------

    def _position(self, vehicle: Any) -> tuple[Any, Any]:
        age, s = self._ages["position"], self._s
        expected = s.x - age * s.x_dot + self._history.at(self._past["x"], 0.0, age)
        return self._values["position"] - expected, errors.position_rows(self._b, s.y, age, vehicle)

    def _attitude(self) -> tuple[Any, Any]:
        read = ca.reshape(self._values["attitude"], 3, 3).T
        return errors.turned_by(read @ self._attitude_at(self._ages["attitude"]).T), errors.attitude_rows()

    def _rod(self) -> tuple[Any, Any]:
        age = self._ages["rod"]
        y, B = self._rod_at(age)
        return B.T @ (self._values["rod"] - y), errors.rod_rows(age)

    def _joints(self) -> tuple[Any, Any]:
        age = self._ages["joints"]
        y, B = self._rod_at(age)
        return B.T @ (self._attitude_at(age) @ self._values["joints"] - y), errors.joint_rows(B, y, age)

    def _rod_rate(self) -> tuple[Any, Any]:
        age, s = self._ages["rod_gyro"], self._s
        y, B = self._rod_at(age)
        y_dot = s.y_dot + self._history.at(self._past["swinging"], 0.0, age)
        read = self._attitude_at(age) @ self._values["rod_gyro"]
        return B.T @ (cross(read, y) - y_dot), errors.rod_rate_rows(B, y, y_dot)

    def _rod_at(self, age: Any) -> tuple[Any, Any]:
        """Return the rod `age` seconds ago, and the frame there that its errors now are carried to."""
        s = self._s
        y = unit(s.y - age * s.y_dot + self._history.at(self._past["y"], 0.0, age))
        return y, errors.frame(errors.carried_frame(self._b, s.y, y), y)

    def _attitude_at(self, age: Any) -> Any:
        entries = self._past["attitude"]
        if not entries:
            return self._s.R
        now = ca.vec((self._turned.T @ self._s.R).T)
        return self._turned @ ca.reshape(self._history.at(entries, now, age), 3, 3).T
