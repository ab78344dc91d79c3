"""The way of a rod that must not touch the arms: where it will cross the rotor plane, and the yaw that opens a gap.

The crowding Σ ((1 + cos Δᵢ)/2)ᵖ, Δᵢ being the angle to arm i in the rotor plane, has a bump over each arm. It is
smooth, least in the gaps, and defined for arms of any bearings. Yaw follows its slope.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend.geometry import E1, Numbers, Scalar, Vector, apply
from flypend.laws.axis import spin
from flypend.laws.smooth import smooth_step
from flypend.model import State, Vehicle

# p in units of (arms/2)², rounded: the bumps of neighbouring arms overlap little.
SHARPNESS = 3.2
# Below this length the rod's way has no bearing: it lies along the thrust axis, which is not to turn much either.
LEVEL_FLOOR = 0.1
# Yaw acceleration demanded, in units of what the rotors can give, per unit slope of the crowding.
STEERING = 3.0
# The way is free up to the first, and blocked from the second, share of the crowding between gap and arm.
OPEN, SHUT = 0.25, 0.6


class Passage(NamedTuple):
    """The arms around the pivot, as the law needs them.

    `arms` (n, 2) are unit vectors of their bearings in the body frame, `gap` (3,) one into the widest gap; `least` and
    `most` are the crowding in that gap and over an arm; `turning` is the yaw acceleration, rad/s², that the rotors can
    give at hover.
    """

    arms: NDArray[np.float64]
    gap: NDArray[np.float64]
    power: int
    least: float
    most: float
    turning: float


class Steering(NamedTuple):
    """What steering asks for.

    Direction `aside` (3, 1) in which a rod hanging at rest may leave; 1 where its way is `clear`, 0 where it leads over
    an arm; and the `yaw` acceleration that opens a gap, rad/s².
    """

    aside: Vector
    clear: Scalar
    yaw: Scalar


# The steering of a vehicle whose rod may pass anywhere.
FREE = Steering(E1, 1.0, 0.0)


def passage_of(vehicle: Vehicle) -> Passage:
    """Return the passage between the arms of `vehicle`."""
    x, y, _ = vehicle.rotor_positions.T
    bearings = np.unique(np.round(np.arctan2(y, x), 6))
    ways = np.diff(np.append(bearings, bearings[0] + 2 * np.pi))
    widest = int(np.argmax(ways))
    arms = _unit(bearings)
    gap = _unit(bearings[widest] + ways[widest] / 2)
    power = round(SHARPNESS * (len(arms) / 2) ** 2)
    least, most = (float(np.sum(((1 + arms @ way) / 2) ** power)) for way in (gap, arms[0]))
    return Passage(arms, np.append(gap, 0.0), power, least, most, yaw_authority(vehicle))


def _unit(bearing: Numbers) -> Numbers:
    return np.stack([np.cos(bearing), np.sin(bearing)], axis=-1)


def yaw_authority(vehicle: Vehicle) -> float:
    """Return the yaw acceleration, rad/s², of half the rotors above their force at hover and half below it."""
    low, high = vehicle.rotor_limits
    count = len(vehicle.rotor_spins)
    hover = min(vehicle.weight / count, high)
    return float(vehicle.drag_ratio * count * min(hover - low, high - hover) / vehicle.inertia[2, 2])


def heading(state: State, rod: Vector, axis: Vector, time: Scalar) -> Numbers:
    """Return (2, 1), of length 1 at most: where the `rod` will cross the rotor plane, in the body frame in `time` s.

    The thrust axis turns to `axis` within the plane of both, and takes the arms along. So the rod will appear in that
    plane, as far as it lies along the thrust axis now. The yaw rate turns the body meanwhile.
    """
    seen, turned = apply(state.R.T, rod), apply(state.R.T, axis)
    way = seen[:2] - seen[2] * turned[:2]
    way = way / ca.sqrt(ca.dot(way, way) + LEVEL_FLOOR**2)
    return spin(way, -time * state.omega[2])


def _power(value: Scalar, exponent: int) -> Scalar:
    """Return `value` to a natural `exponent`, by products: exported C calls no library."""
    if exponent == 0:
        return 1.0
    half = _power(value, exponent // 2)
    return half * half * value if exponent % 2 else half * half


def steer(state: State, way: Numbers, passage: Passage) -> Steering:
    """Return the steering of a rod that heads along `way` (2, 1), as from `heading`."""
    crowding: Any = 0
    push: Any = 0
    for arm in passage.arms:
        cosine = way[0] * float(arm[0]) + way[1] * float(arm[1])
        sine = way[1] * float(arm[0]) - way[0] * float(arm[1])
        near = (1 + cosine) / 2
        slope = _power(near, passage.power - 1)
        crowding, push = crowding + near * slope, push + passage.power / 2 * sine * slope
    share = (crowding - passage.least) / (passage.most - passage.least)
    clear = 1 - smooth_step((share - OPEN) / (SHUT - OPEN))
    return Steering(apply(state.R, passage.gap), clear, -STEERING * passage.turning * push)
