"""Sensors as data: what is measured of the state, how often, how late and how well."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from types import MappingProxyType
from typing import Any, Literal

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.plants import defects
from flypend.plants.noise import Noise

# What a pilot's own estimate, or that of an estimator which has run for a while, may be wrong by.
START = Noise(x=0.02, x_dot=0.2, attitude=0.03, omega=0.05, y=0.03, y_dot=0.2)
Rates = Literal["estimated", "differenced"]
Error = Any  # a number, from which errors are drawn, or a vector
# Longest latency of a reading, s; the estimator remembers the flight that long.
LONGEST_LATENCY = 0.2
# Bandwidth, 1/s, at which the estimator follows the force that an accelerometer tells, in hover, where what the model
# lacks changes slowly, and how much faster for every m/s² by which the specific force departs from that of hover, where
# wrong masses and rotors make it change with the thrust.
FOLLOWED, FOLLOWED_MORE = 0.5, 2.0


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Sensor:
    """A stream of readings, the first at time 0.

    Parameters
    ----------
    rate : float
        Readings per second, Hz. Of several readings in one control period, the newest counts.
    noise : float
        Standard deviation of white noise per axis, in the unit of the reading.
    latency : float
        Time from a reading until the flight computer receives it, s.
    dropouts : float
        Probability that a reading never arrives.
    quantisation : float
        Step of the readings, in the unit of the reading; for joints, of the angles. The estimator knows it. Not for
        attitude and rod.
    """

    rate: float
    noise: float = 0.0
    latency: float = 0.0
    dropouts: float = 0.0
    quantisation: float = 0.0

    @property
    def variance(self) -> float:
        """Variance of a reading per axis; quantisation counts as uniform noise."""
        return float(self.noise**2 + self.quantisation**2 / 12)

    def density(self, period: float) -> float:
        """Return the spectral density of the noise, unit²/Hz, if at most one reading counts per control `period`, s."""
        return self.variance / (min(self.rate, 1 / period) * (1 - self.dropouts))

    def check(self, name: str) -> None:
        """Raise InputError if a field is out of range; messages begin with `name`."""
        errors.number(f"{name}.rate", self.rate, above=0, at_most=1e5, unit="Hz")
        errors.number(f"{name}.noise", self.noise, at_least=0)
        errors.number(f"{name}.latency", self.latency, at_least=0, at_most=LONGEST_LATENCY, unit="s")
        errors.number(f"{name}.dropouts", self.dropouts, at_least=0)
        errors.number(f"{name}.quantisation", self.quantisation, at_least=0)
        if self.dropouts >= 1:
            raise InputError(f"{name}.dropouts", "a probability below 1", f"{self.dropouts:g}")
        if self.quantisation and name.endswith(("attitude", "rod")):
            raise InputError(f"{name}.quantisation", "0 for what is a direction", f"{self.quantisation:g}")
        if self.variance == 0:
            raise InputError(f"{name}.noise", "a number > 0, by which the estimator weighs readings", "0")


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Sensors:
    """The sensors of vehicle and rod, their errors, and what the estimator on board assumes.

    Parameters
    ----------
    position : Sensor, optional
        Position of the pivot, world frame, m.
    attitude : Sensor, optional
        Rotation from body to world; noise in rad.
    rod : Sensor, optional
        Direction of the rod, world frame; noise in rad.
    gyro : Sensor
        Angular velocity, body frame, rad/s.
    accelerometer : Sensor, optional
        Specific force at the centre of mass, averaged over the last control period, body frame, m/s².
    joints : Sensor, optional
        Two joint angles of the rod, rad: its direction in the body frame.
    rod_gyro : Sensor, optional
        Gyroscope of an IMU on the rod: angular velocity y × ẏ in the body frame, rad/s.
    start : Noise
        Standard deviations of the error of the first estimate of a flight.
    rates : "estimated" or "differenced"
        How rates are obtained: from the estimator or, as a negative control, as differences of the last two poses,
        which must be measured.
    force_error : float
        Density of the unmodelled specific forces on vehicle and bob in hover, m/s²/√Hz. It describes forces that
        change; those that last are estimated.
    manoeuvre_error : float
        What is added to `force_error` for each m/s² by which the specific force departs from that of hover, 1/√Hz.
    moment_error : float
        Density of the unmodelled angular acceleration, rad/s²/√Hz.
    command_delay : float, optional
        Delay from measurement to command that the estimator assumes, s; default that of the plant. If the law finds its
        delay in flight, the estimator uses that one as soon as it is found.
    gyro_bias, gyro_scale : float or (3,)
        Constant error of the gyroscope, rad/s, and relative error of its scale, per axis. For these and all errors
        below that may be vectors: a vector is the error of every flight; a number is the standard deviation per
        component of an error that each flight draws with its own seed. The estimator knows none of them.
    accelerometer_bias, accelerometer_scale : float or (3,)
        The same of the accelerometer, m/s².
    gyro_bias_walk, accelerometer_bias_walk : float
        Random walk of the biases, rad/s/√s and m/s²/√s.
    imu_turned : float or (3,)
        Rotation vector from the body to the IMU's axes, rad.
    markers_off : float or (3,)
        Position of the vehicle's marker body relative to the pivot, body frame, m.
    markers_turned : float or (3,)
        Rotation vector from the body to the marker body, rad.
    rod_markers_off : float or (2,)
        Two angles between the rod and its markers, in a frame that moves with the rod, rad; a marker displaced by d at
        a distance a from the pivot gives d/a.
    joints_off : float or (2,)
        Error of the zeros of both joint angles, rad.
    frame_off, frame_turned : float or (3,)
        Origin (m) and rotation vector (rad) of the world in the frame of the cameras; yaw is the third component.
    frame_scale : float or (3,)
        Relative error of the cameras' lengths.
    vibration, gyro_vibration : float
        Amplitude of a wave on each axis of accelerometer (m/s²) and gyroscope (rad/s).
    vibration_rate : float
        Its frequency, that of the rotors, Hz; readings at a lower rate alias it.
    outliers : float
        Share of the poses of vehicle or rod that are of a wrong body.
    outlier_off, outlier_turned : float
        Distance (m) and rotation (rad) of that wrong body from the true one, each in a random direction.
    bursts, burst_time : float
        Mean number of bursts per second in which cameras send nothing, and how long one lasts, s.
    untold_latency : float
        Time by which poses are older than their stated age, s.
    latency_jitter : float
        Largest further delay of a pose, s, drawn for each frame uniformly from 0.
    adjustable : tuple of str, or "all"
        Defects that are compiled in even where they are 0, so that changing their sizes compiles nothing, and each
        piece of a flight in pieces can have other sizes. All of them draw random numbers.

    Raises
    ------
    InputError
        If a field is out of range, or a sensor is missing: position, gyroscope, and the rod's direction or joint angles
        are needed.
    """

    position: Sensor | None = None
    attitude: Sensor | None = None
    rod: Sensor | None = None
    gyro: Sensor | None = None
    accelerometer: Sensor | None = None
    joints: Sensor | None = None
    rod_gyro: Sensor | None = None
    start: Noise = START
    rates: Rates = "estimated"
    force_error: float = 5e-4
    manoeuvre_error: float = 3e-3
    moment_error: float = 1.0
    command_delay: float | None = None
    gyro_bias: Error = 0.0
    gyro_scale: Error = 0.0
    gyro_bias_walk: float = 0.0
    accelerometer_bias: Error = 0.0
    accelerometer_scale: Error = 0.0
    accelerometer_bias_walk: float = 0.0
    imu_turned: Error = 0.0
    markers_off: Error = 0.0
    markers_turned: Error = 0.0
    rod_markers_off: Error = 0.0
    joints_off: Error = 0.0
    frame_off: Error = 0.0
    frame_turned: Error = 0.0
    frame_scale: Error = 0.0
    vibration: float = 0.0
    gyro_vibration: float = 0.0
    vibration_rate: float = 170.0
    outliers: float = 0.0
    outlier_off: float = 0.05
    outlier_turned: float = 0.17
    bursts: float = 0.0
    burst_time: float = 0.1
    untold_latency: float = 0.0
    latency_jitter: float = 0.0
    adjustable: Any = ()

    def __post_init__(self) -> None:
        for name in STREAMS:
            sensor = getattr(self, name)
            if isinstance(sensor, Mapping):
                sensor = Sensor(**sensor)
                object.__setattr__(self, name, sensor)
            if sensor is not None and not isinstance(sensor, Sensor):
                raise InputError(f"sensors.{name}", "a Sensor or a table", repr(sensor))
            if sensor is not None:
                sensor.check(f"sensors.{name}")
        if isinstance(self.start, Mapping):
            object.__setattr__(self, "start", Noise(**self.start))
        if not isinstance(self.start, Noise):
            raise InputError("sensors.start", "a Noise or a table", repr(self.start))
        errors.one_of("sensors.rates", self.rates, ("estimated", "differenced"))
        errors.number("sensors.force_error", self.force_error, above=0)
        errors.number("sensors.manoeuvre_error", self.manoeuvre_error, at_least=0)
        errors.number("sensors.moment_error", self.moment_error, above=0)
        if self.command_delay is not None:
            errors.number("sensors.command_delay", self.command_delay, at_least=0, at_most=0.5, unit="s")
        self._check_complete()
        defects.check_defects(self)
        defects.check_adjustable(self)

    def _check_complete(self) -> None:
        needed = ["position", "gyro"]
        if self.rates == "differenced":
            needed += ["attitude", "rod"]
        for name in needed:
            if getattr(self, name) is None:
                raise InputError(f"sensors.{name}", "a Sensor", "none")
        if self.rod is None and self.joints is None:
            raise InputError("sensors.rod", "a Sensor, or one of the joints", "neither")

    @property
    def streams(self) -> dict[str, Sensor]:
        """The sensors that there are, by name."""
        return {name: getattr(self, name) for name in STREAMS if getattr(self, name) is not None}

    @property
    def told(self) -> Sensors:
        """The sensors as the estimator knows them: without defects."""
        return replace(self, **self._usual())

    def _usual(self) -> dict[str, Any]:
        """Return what the fields of the defects are without any."""
        return {entry.name: entry.default for entry in fields(self) if entry.name in (*defects.NAMES, "adjustable")}

    def bandwidth(self, departure: Any) -> Any:
        """Return the squared bandwidth, 1/s², at which the estimator follows the force that an accelerometer shows.

        `departure` is the squared departure of the specific force from that of hover, (m/s²)².
        """
        return FOLLOWED**2 + FOLLOWED_MORE**2 * departure

    def trust(self, period: float, departure: Any) -> Any:
        """Return the share of the motion for which the accelerometer answers, not the model: 0 without one.

        `period` is the control period, s, `departure` as in `bandwidth`. It compares two squared bandwidths: that of
        `bandwidth`, and that at which the position corrects the velocity (of a Kalman filter of a mass under a force of
        density `force_error`). An accelerometer that is followed more slowly than that hardly passes its noise on.
        """
        if self.accelerometer is None:
            return 0.0
        assert self.position is not None
        followed = self.bandwidth(departure)
        return followed / (followed + self.force_error / np.sqrt(self.position.density(period)))

    def process_noise(self, period: float, departure: Any) -> tuple[Any, Any]:
        """Return the densities of specific forces on vehicle and bob that the estimator assumes, (m/s²)²/Hz.

        `period` is the control period, s, `departure` as in `bandwidth`. The faster the accelerometer is followed, the
        less the model's own errors count. The accelerometer's noise counts in full. In hover less of it passes, since
        lasting forces are estimated from the same corrections; this is neglected.
        """
        steady, moving = self.force_error**2, self.manoeuvre_error**2 * departure
        noise = 0.0 if self.accelerometer is None else self.accelerometer.density(period)
        return steady + (1 - self.trust(period, departure)) * moving + noise, steady + moving

    def accelerometer_density(self, period: float, departure: Any = 0.0) -> Any:
        """Return the density of the accelerometer's noise in the estimate, (m/s²)²/Hz.

        `period` is the control period, s, `departure` as in `bandwidth`.
        """
        found = 0.0 if self.accelerometer is None else self.accelerometer.density(period)
        return self.trust(period, departure) * found

    def replace(self, **changes: Any) -> Sensors:
        """Return a copy with the fields in `changes` replaced, validated again. Raises InputError."""
        errors.only_known("sensors", changes, [entry.name for entry in fields(self)])
        return replace(self, **changes)

    def noisier(self, factor: float) -> Sensors:
        """Return a copy with the noise of every sensor times `factor`; the estimator knows it."""
        return self.replace(**{n: replace(s, noise=factor * s.noise) for n, s in self.streams.items()})

    def to_dict(self) -> dict[str, Any]:
        """Return the fields as plain tables, without defaults and absent sensors; `Sensors(**…)` takes them back."""
        usual = self._usual()
        given = {name: value for name, value in asdict(self).items() if value is not None}
        return {name: value for name, value in given.items() if name not in usual or value != usual[name]}


STREAMS = ("position", "attitude", "rod", "gyro", "accelerometer", "joints", "rod_gyro")

_POSE = {"rate": 200.0, "latency": 0.01}
_LOST = {**_POSE, "dropouts": 0.05}
_ANGLE = float(np.radians(0.5))  # per axis, so that a rotation is off by 0.9 degrees on average
_GYRO, _ACCELEROMETER = Sensor(rate=500.0, noise=2e-2), Sensor(rate=500.0, noise=0.2)
_MOCAP = Sensors(
    position=Sensor(noise=1e-3, **_POSE),
    attitude=Sensor(noise=3.5e-3, **_POSE),
    rod=Sensor(noise=3.5e-3, **_POSE),
    gyro=_GYRO,
    accelerometer=_ACCELEROMETER,
)
SUITES: Mapping[str, Sensors | None] = MappingProxyType(
    {
        "perfect": None,
        # Poses of vehicle and rod by cameras, and the IMU of a hobby flight controller on a vibrating frame.
        "mocap": _MOCAP,
        "mocap-without-accelerometer": _MOCAP.replace(accelerometer=None),
        # The same IMU, encoders of 12 bits in the joint, and the position of an ultra-wideband or visual system.
        "onboard": Sensors(
            position=Sensor(rate=100.0, noise=1e-2, latency=0.01),
            gyro=_GYRO,
            accelerometer=_ACCELEROMETER,
            joints=Sensor(rate=500.0, noise=1e-3, quantisation=2 * np.pi / 4096),
            manoeuvre_error=1e-2,  # for a rod whose length is wrong, which would be taken for a tilt
        ),
        # Those of "mocap" in a careful laboratory, each flight with errors of its own.
        "laboratory": _MOCAP.replace(
            position=Sensor(noise=1e-3, **_LOST),
            attitude=Sensor(noise=3.5e-3, **_LOST),
            rod=Sensor(noise=3.5e-3, **_LOST),
            gyro_bias=0.005,
            imu_turned=_ANGLE,
            markers_turned=_ANGLE,
            rod_markers_off=_ANGLE,
            frame_turned=_ANGLE,
            untold_latency=0.008,
        ),
    }
)


def sensors_called(given: Any, field: str = "plant.sensors") -> Sensors | None:
    """Return sensors given as a record, by name of a suite, or as a table on top of `base` (a suite); None if perfect.

    In such a table, the table of a sensor overrides fields of the suite's. Raises InputError, with the name `field`.
    """
    if given is None or isinstance(given, Sensors):
        return given
    if isinstance(given, str):
        return SUITES[errors.one_of(field, given, SUITES)]
    if not isinstance(given, Mapping):
        raise InputError(field, "a Sensors, a suite (" + ", ".join(SUITES) + ") or a table", repr(given))
    table = dict(given)
    name = table.pop("base", "perfect")
    base = SUITES[errors.one_of(f"{field}.base", name, SUITES)]
    if base is None and not table:
        return None
    errors.only_known(field, table, [entry.name for entry in fields(Sensors)])
    known = base.to_dict() if base is not None else {}
    for key, value in table.items():
        nested = isinstance(value, Mapping) and isinstance(known.get(key), Mapping)
        known[key] = {**known[key], **value} if nested else value
    return Sensors(**known)
