"""What an accelerometer feels beyond the modelled thrust: a scale of the thrust and a force, told apart.

Wrong masses, weak rotors and a sagging battery act along the thrust and in proportion to it; wind and what else the
model lacks does not. With the modelled thrust f, the accelerometer of a body with axes R tells the force

    s f e₃ + d + noise,    s the scale and d the force, body axes,

each period. A Kalman filter follows s and the third component of d jointly, and the two others by themselves. While f
hardly changes, as in hover, only the sum s f + d₃ is told, and the prior shares it; a manoeuvre tells both. The walk of
d is that of `Sensors.bandwidth`: slow in hover, where the model is better than the accelerometer, and fast in a
manoeuvre, where it is worse, so that the motion follows what the accelerometer reads.

A bias of the accelerometer is taken for a force. It gives itself away in hover: the pose is corrected against it again
and again, and the integral of these corrections is the bias. Where no attitude is measured, `error_state` finds it.
"""

from __future__ import annotations

from typing import Any

import casadi as ca

from flypend.compile.record import Field, Record
from flypend.geometry import Numbers, Scalar, Vector, clip, dot, scale
from flypend.model import Vehicle
from flypend.plants.sensors import Sensors

RECORD = Record(
    "felt",
    "What the accelerometer feels beyond the modelled thrust.",
    (
        Field("force", 3, "force beyond the scaled thrust, body, N"),
        Field("bias", 3, "of the accelerometer, body, m/s^2"),
        Field("scale", 0, "true over modelled thrust, less 1"),
        Field("across", 0, "variance of each of the first two components of the force, N^2"),
        Field("along", 0, "that of the third, N^2"),
        Field("doubt", 0, "variance of the scale"),
        Field("shared", 0, "covariance of scale and third component, N"),
    ),
)
# Prior standard deviations of scale and of force, in weights of the vehicle.
SCALE, FORCE = 0.1, 0.05
# Random walk of the scale, 1/√s: a battery and warm motors take minutes, a first estimate should take a second.
SCALE_WALK = 0.01
# Largest scale that is believed: masses 20 % lower with rotors 15 % stronger are 0.44. And the largest bias, m/s².
MOST_SCALE, MOST_BIAS = 0.5, 1.0


def begin(vehicle: Vehicle) -> Numbers:
    """Return the memory (11,) before the first reading, for a `vehicle` of numbers or symbols."""
    force = (FORCE * vehicle.g * vehicle.M) ** 2
    return RECORD.join({
        "force": ca.DM.zeros(3), "bias": ca.DM.zeros(3), "scale": 0, "across": force, "along": force,
        "doubt": SCALE**2, "shared": 0,
    })  # fmt: skip


def beyond(memory: Numbers, thrust: Scalar) -> Vector:
    """Return the force (3,) beyond the modelled `thrust` (N), body axes, N."""
    felt = RECORD.split(memory)
    return felt["force"] + ca.vertcat(0, 0, felt["scale"] * thrust)


def force_of(acceleration: Vector, along: Vector, vehicle: Vehicle) -> Vector:
    """Return the force (3,) on the vehicle, N, that accelerates the pivot by `acceleration` (3,), m/s².

    A force F accelerates it by F/M across the rod, whose direction is `along` (3,), and by F/(M+m) along it, as it
    moves the bob too. All in the same axes.
    """
    return vehicle.M * acceleration + vehicle.m * scale(dot(along, acceleration), along)


def correct_bias(memory: Numbers, correction: Vector, taken: Vector | float = 0.0) -> Numbers:
    """Return the memory with the accelerometer's bias corrected by `correction` (3,), m/s², and limited.

    `taken` (3,), body, N, is the force that it had been taken for, which goes.
    """
    felt = RECORD.split(memory)
    bias = clip(felt["bias"] + correction, -MOST_BIAS, MOST_BIAS)
    return RECORD.join(felt | {"bias": bias, "force": felt["force"] - taken})


def correct(
    memory: Numbers, fresh: Scalar, difference: Vector, thrust: Scalar, departure: Scalar, vehicle: Vehicle,
    sensors: Sensors, period: float,
) -> Numbers:  # fmt: skip
    """Return the `memory` (11,) after a control `period`, s.

    `fresh` is 1 if the accelerometer of `sensors` has read, else 0, and `difference` (3,) the force that it tells
    beyond the one expected, body axes, N. `thrust` is the modelled one, N, `departure` the squared departure of the
    specific force from that of hover, (m/s²)².
    """
    felt: dict[str, Any] = RECORD.split(memory)
    assert sensors.accelerometer is not None
    noise = vehicle.M**2 * sensors.accelerometer.variance
    walk = vehicle.M**2 * sensors.accelerometer.density(period) * sensors.bandwidth(departure) * period
    across, along = felt["across"] + walk, felt["along"] + walk
    doubt, shared = ca.fmin(felt["doubt"] + SCALE_WALK**2 * period, SCALE**2), felt["shared"]
    gain = fresh * across / (across + noise)
    seen, seen_by_scale = along + shared * thrust, shared + doubt * thrust
    total = seen + thrust * seen_by_scale + noise
    gain_along, gain_scale = fresh * seen / total, fresh * seen_by_scale / total
    scale = felt["scale"] + gain_scale * difference[2]
    return RECORD.join({
        "force": felt["force"] + ca.vertcat(gain * difference[:2], gain_along * difference[2]),
        "bias": felt["bias"],
        "scale": clip(scale, -MOST_SCALE, MOST_SCALE),
        "across": (1 - gain) * across,
        "along": along - gain_along * seen,
        "doubt": doubt - gain_scale * seen_by_scale,
        "shared": shared - gain_along * seen_by_scale,
    })  # fmt: skip
