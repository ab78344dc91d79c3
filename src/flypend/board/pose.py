"""Where a vehicle is, how fast it moves and how it is turned, from poses of motion capture and what its IMU feels.

Between poses, position and velocity follow the accelerometer and the attitude follows the gyroscope. Each pose corrects
what was predicted for the time at which it was taken: position and velocity with the gains of a critically damped
observer, the attitude by a share of the rotation vector between the two. Neither rod, thrust nor masses enter.
"""

from __future__ import annotations

import casadi as ca

from flypend.compile.record import Field, Record
from flypend.geometry import E3, cross, polar_step, vee
from flypend.plants.cascade import rotation_by
from flypend.plants.sensing import NOTHING

RECORD = Record(
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


def tracking(period: float, gravity: float) -> ca.Function:
    """Return (memory (19,), position (3,), attitude (9,), age, gyro (3,), force (3,)) → memory, `period` s later.

    Position (m) and attitude (rotation by rows) are `age` seconds old; a negative age says that there is no pose. Gyro
    is the angular velocity (rad/s) now, force the mean specific force (m/s²) of the period that ends, both body axes.
    `gravity` in m/s².
    """
    memory, position, attitude = ca.SX.sym("memory", RECORD.length), ca.SX.sym("position", 3), ca.SX.sym("attitude", 9)
    age, gyro, force = ca.SX.sym("age"), ca.SX.sym("gyro", 3), ca.SX.sym("force", 3)
    before = RECORD.split(memory)
    since = before["since"] + period
    begins = (before["since"] < 0) + (since > GAP) > 0
    R = ca.reshape(before["R"], 3, 3).T @ rotation_by(period / 2 * (before["omega"] + gyro))
    a = R @ (force - period / 2 * cross(gyro, force)) - gravity * ca.DM(E3)  # the mean attitude of the period
    x = before["x"] + period * before["x_dot"] + period**2 / 2 * a
    x_dot = before["x_dot"] + period * a

    off = position - (x - age * x_dot + age**2 / 2 * a)
    pole = 1 / (1 + BANDWIDTH * since)
    told = ca.reshape(attitude, 3, 3).T
    error = rotation_by(age * gyro) @ R.T @ told  # (R exp(−age ω))ᵀ told, by which it was turned too little
    turn = 4 * vee(error) / ca.fmax(1 + ca.trace(error), 1)  # twice the half tangent
    share = 1 - 1 / (1 + TURN_BANDWIDTH * since)
    corrected = ca.if_else(ca.trace(error) < 1 + 2 * FAR, told, R @ rotation_by(share * turn))
    fresh = age >= 0

    def chosen(kept: ca.SX, better: ca.SX, anew: ca.SX) -> ca.SX:
        return ca.if_else(fresh, ca.if_else(begins, anew, better), kept)

    R = polar_step(chosen(R, corrected, told))  # rounding off the rotations
    after = RECORD.join(
        {
            "x": chosen(x, x + (1 - pole**2) * off, position),
            "x_dot": chosen(x_dot, x_dot + (1 - pole) ** 2 / since * off, ca.SX.zeros(3)),
            "R": ca.vec(R.T),
            "omega": gyro,
            "since": ca.if_else(fresh, 0, ca.if_else(before["since"] < 0, NOTHING, since)),
        }
    )
    return ca.Function("track_pose", [memory, position, attitude, age, gyro, force], [ca.densify(after)])
