"""Where a vehicle and its rod are and how they move, from motion capture and an IMU: neither thrust nor masses enter.

Between the frames of motion capture, position and velocity follow the accelerometer and the attitude follows the
gyroscope. With a the specific force at the pivot, world axes, a massless rod of length l without friction turns as

    ÿ = −(1 − y yᵀ) a / l − |ẏ|² y,

whatever the masses, the thrust and the force that holds or pushes the vehicle. Each frame corrects what was predicted
for the time at which it was taken: positions and rates with the gains of a critically damped observer, the attitude by
a share of the rotation vector between the two.
"""

from __future__ import annotations

import casadi as ca

from flypend.compile.record import Field, Record
from flypend.geometry import E3, Numbers, Scalar, cross, polar_step, tangent_part, unit, vee
from flypend.laws.sphere import acceleration
from flypend.plants.cascade import rotation_by
from flypend.plants.sensing import NOTHING

POSE = Record(
    "pose_estimate",
    "Position, velocity and attitude, from poses, gyroscope and accelerometer.",
    (
        Field("x", 3, "position, world, m"),
        Field("x_dot", 3, "velocity, world, m/s"),
        Field("R", 9, "rotation from body to world, by rows"),
        Field("omega", 3, "the gyroscope's last reading, body, rad/s"),
        Field("since", 0, "seconds since the last pose; negative before the first"),
    ),
)
# 1/s. A scale error of 2 % of the accelerometer moves the estimate by 0.2 mm and 0.01 m/s; 0.3 mm of noise at 100 Hz
# are 2 mm/s.
BANDWIDTH = 30.0
# 1/s, of the attitude: 0.5° of noise at 100 Hz become 0.1°, and a gyroscope's bias of 0.01 rad/s 0.06°.
TURN_BANDWIDTH = 10.0
GAP = 0.2  # s without a pose, after which it begins anew
FAR = 0.8  # cosine of the angle, 37°, beyond which a pose begins the attitude anew

ROD = Record(
    "rod_estimate",
    "Rod, from its directions and the specific force.",
    (
        Field("y", 3, "unit vector from the pivot to the bob, world"),
        Field("y_dot", 3, "its rate, world, 1/s"),
        Field("since", 0, "seconds since the last direction; negative before the first"),
    ),
)
# 1/s: a tenth of a second forgets a first rate of 0; 1 mrad of noise at 100 Hz is 0.025 rad/s of rate.
ROD_BANDWIDTH = 100.0
ROD_GAP = 0.1  # s without a direction, after which it begins anew


class _Arrival:
    """What was told at a step `since` (s) the last time, if its `age` is not negative; `before` is that time before."""

    def __init__(self, age: Scalar, before: Scalar, period: float, gap: float) -> None:
        self._fresh, self._before, self.since = age >= 0, before, before + period
        self._begins = (before < 0) + (self.since > gap) > 0

    def gains(self, bandwidth: float) -> tuple[Scalar, Scalar]:
        """Return the gains of a critically damped observer: of what is told, and of its rate, 1/s."""
        pole = 1 / (1 + bandwidth * self.since)
        return 1 - pole**2, (1 - pole) ** 2 / self.since

    def chosen(self, kept: Numbers, corrected: Numbers, anew: Numbers) -> Numbers:
        """Return `kept` if nothing is told, what is `corrected` if something is, or what begins `anew`."""
        return ca.if_else(self._fresh, ca.if_else(self._begins, anew, corrected), kept)

    @property
    def after(self) -> Scalar:
        """Time since something was told, after this step, s."""
        return ca.if_else(self._fresh, 0, ca.if_else(self._before < 0, NOTHING, self.since))


def track_pose(period: float, gravity: float) -> ca.Function:
    """Return (memory (19,), position (3,), attitude (9,), age, gyro (3,), force (3,)) → memory, `period` s later.

    Position (m) and attitude (rotation by rows) are `age` seconds old; a negative age says that there is no pose. Gyro
    is the angular velocity (rad/s) now, force the mean specific force (m/s²) of the period that ends, both body axes.
    `gravity` in m/s².
    """
    memory, position, attitude = ca.SX.sym("memory", POSE.length), ca.SX.sym("position", 3), ca.SX.sym("attitude", 9)
    age, gyro, force = ca.SX.sym("age"), ca.SX.sym("gyro", 3), ca.SX.sym("force", 3)
    before = POSE.split(memory)
    arrival = _Arrival(age, before["since"], period, GAP)
    R = ca.reshape(before["R"], 3, 3).T @ rotation_by(period / 2 * (before["omega"] + gyro))
    a = R @ (force - period / 2 * cross(gyro, force)) - gravity * ca.DM(E3)  # the mean attitude of the period
    x = before["x"] + period * before["x_dot"] + period**2 / 2 * a
    x_dot = before["x_dot"] + period * a

    off = position - (x - age * x_dot + age**2 / 2 * a)
    gain, rate_gain = arrival.gains(BANDWIDTH)
    seen = ca.reshape(attitude, 3, 3).T
    error = rotation_by(age * gyro) @ R.T @ seen  # (R exp(−age ω))ᵀ seen, by which it was turned too little
    turn = 4 * vee(error) / ca.fmax(1 + ca.trace(error), 1)  # twice the half tangent
    share = 1 - 1 / (1 + TURN_BANDWIDTH * arrival.since)
    corrected = ca.if_else(ca.trace(error) < 1 + 2 * FAR, seen, R @ rotation_by(share * turn))
    after = POSE.join({
        "x": arrival.chosen(x, x + gain * off, position),
        "x_dot": arrival.chosen(x_dot, x_dot + rate_gain * off, ca.SX.zeros(3)),
        "R": ca.vec(polar_step(arrival.chosen(R, corrected, seen)).T),  # rounding off the rotations
        "omega": gyro,
        "since": arrival.after,
    })  # fmt: skip
    return ca.Function("track_pose", [memory, position, attitude, age, gyro, force], [ca.densify(after)])


def track_rod(period: float) -> ca.Function:
    """Return (memory (7,), direction (3,), age, specific force (3,), rod length) → memory, `period` seconds later.

    The direction, world, is `age` seconds old, of any length; a negative age says that there is none. The specific
    force is that of the period that ends, world, m/s².
    """
    memory, direction, age = ca.SX.sym("memory", ROD.length), ca.SX.sym("direction", 3), ca.SX.sym("age")
    force, length = ca.SX.sym("force", 3), ca.SX.sym("length")
    before = ROD.split(memory)
    arrival = _Arrival(age, before["since"], period, ROD_GAP)
    turning = acceleration(before["y"], before["y_dot"], -tangent_part(before["y"], force) / length)
    y = unit(before["y"] + period * before["y_dot"] + period**2 / 2 * turning)
    y_dot = tangent_part(y, before["y_dot"] + period * turning)

    seen = direction / ca.sqrt(ca.fmax(ca.sumsqr(direction), 1e-12))
    off = tangent_part(y, seen - (y - age * y_dot + age**2 / 2 * turning))
    gain, rate_gain = arrival.gains(ROD_BANDWIDTH)
    better = unit(y + gain * off)
    faster = tangent_part(better, y_dot + rate_gain * off)
    after = ROD.join({
        "y": arrival.chosen(y, better, seen),
        "y_dot": arrival.chosen(y_dot, faster, ca.SX.zeros(3)),
        "since": arrival.after,
    })  # fmt: skip
    return ca.Function("track_rod", [memory, direction, age, force, length], [ca.densify(after)])
