"""Guesses that lean in a window: upright is a saddle, from which no first step tells a rod which way to lean.

A balanced rod stays upright, since the height of its end does not change with a small lean. Where the lean is limited
and there is a window to pass, most guesses therefore lean in the wall. Their rods lean by λ(t), a level vector, which
takes an acceleration λ − λ̈ of the pivot, in own units and while it is small. λ is the least sum of bumps that brings
the pivot from the start to rest at the target, through the middle of each window at a given speed, and leans as wanted
there. Thrust and attitude follow from it, as far as the rotors can.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flypend.geometry import E3, cross, unit
from flypend.planning.request import Request

# Per style: lean along the width of a window and along its normal, as shares of what is allowed, and speed, own units;
# two guesses stay upright. Then those for another attempt. They were chosen on windows of 0.3 m to 0.5 m by 0.55 m and
# 0.7 m, with hehn2011.
FIRST = [(0, 0, 0), (0, 0, 0), (0, 0.4, 2), (0.4, 0, 2), (0.6, 0, 3), (-0.6, 0, 3), (0.4, 0, 3), (0, 0.4, 3)]
AGAIN = [
    (-0.4, 0, 2),
    (-0.4, 0, 3),
    (0.6, 0, 2),
    (-0.6, 0, 2),
    (0, 0.6, 3),
    (0, 0.4, 2.5),
    (0.5, 0, 2.5),
    (-0.5, 0, 2.5),
]
WAYS = np.array([FIRST, AGAIN])
BUMPS = 16
MOST = 0.95  # of the lean that is allowed
LEAST = 1e-9

Array = NDArray[np.float64]


def leans(asked: Request, style: int) -> bool:
    """Whether a guess of this `style` leans in the windows that are `asked` for."""
    return asked.leaning and bool(np.any(_way(asked, style)))


def _way(asked: Request, style: int) -> Array:
    way: Array = WAYS[int(asked.again), style]
    return way


def leaned(asked: Request, style: int, stages: int, h: float) -> tuple[Array, Array]:
    """Return states (stages + 1, 24 + n) and commands (stages, n) of a guess that leans, in stages of `h`, own units.

    The first state is the start, from which it may jump.
    """
    windows, most = asked.limits.windows, float(asked.limits.lean or 0)
    along, across, speed = _way(asked, style)
    begin, middles = asked.start[:3], [(w.centre - asked.target) / asked.units.length for w in windows]
    route = np.array([begin, *middles, np.zeros(3)])
    passed = np.cumsum(np.linalg.norm(np.diff(route, axis=0), axis=1))
    when = np.clip(np.rint(stages * passed[:-1] / passed[-1]).astype(int), 1, stages - 1)
    wanted = np.array([most * (along * w.axes[0, :2] + across * w.axes[2, :2]) for w in windows])
    onward = np.array([-np.sign(begin @ w.axes[2]) * unit(w.axes[2] * (1, 1, 0))[:2] for w in windows])
    lean, level = _leaning(stages, h, when, wanted, (route[1:] - begin)[:, :2], speed * onward)
    size = np.hypot(*lean.T)[:, None] + LEAST
    held = np.minimum(size, MOST * most)
    # In the wall the middle of the rod is at the height of the middle of the window.
    under = asked.vehicle.reach / asked.units.length * np.cos(np.hypot(*wanted.T)) / 2
    heights = [begin[2], *(route[1:-1, 2] - under), 0.0]
    x = np.column_stack([begin[:2] + level, _smooth(np.arange(stages + 1.0), [0, *when, stages], heights)])
    return _with_thrust(asked, x, np.hstack([np.sin(held) * lean / size, np.cos(held)]), h)


def _leaning(
    stages: int, h: float, when: Array, wanted: Array, places: Array, speeds: Array
) -> tuple[Array, Array]:  # fmt: skip
    """Return λ and the way of the pivot, (stages + 1, 2) each.

    At the stages `when` (k,), λ is as `wanted` (k, 2), and the pivot passes `places` (k + 1, 2), about its start, with
    `speeds` (k, 2); in the last place it rests.
    """
    width = stages / (BUMPS + 1)
    off = (np.arange(stages + 1)[:, None] - width * np.arange(1, BUMPS + 1)) / width
    bumps = np.cos(np.pi / 2 * np.clip(off, -1, 1)) ** 2
    fast = _integral(bumps, h) - np.gradient(bumps, h, axis=0)
    far = _integral(fast, h)
    rows = np.array([*far[[*when, stages]], *fast[[*when, stages]], *bumps[when]])
    shares = np.linalg.lstsq(rows, np.array([*places, *speeds, np.zeros(2), *wanted]), rcond=None)[0]
    return bumps @ shares, far @ shares


def _integral(values: Array, h: float) -> Array:
    """Return the integral of `values` (stages + 1, k) from the first on, by trapezia."""
    whole: Array = h * (np.cumsum(values, axis=0) - (values + values[0]) / 2)
    return whole


def _smooth(at: Array, knots: list[int], values: list[float]) -> Array:
    """Return smooth steps through `values` at `knots`, which grow."""
    k = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(knots) - 2)
    first, run = np.array(knots)[k], np.diff(knots)[k]
    share = (at - first) / run
    steps: Array = np.array(values)[k] + np.diff(values)[k] * share**2 * (3 - 2 * share)
    return steps


def _with_thrust(asked: Request, x: Array, y: Array, h: float) -> tuple[Array, Array]:
    """Return states and commands for pivot and rod, (stages + 1, 3) each, that move like this."""
    m = asked.vehicle.m / (asked.vehicle.M + asked.vehicle.m)
    x_dot, y_dot = np.gradient(x, h, axis=0), np.gradient(y, h, axis=0)
    force = E3 + np.gradient(x_dot + m * y_dot, h, axis=0)
    z, forward = unit(force), asked.start[[6, 9, 12]]
    first = unit(forward - (z @ forward)[:, None] * z)
    R = np.stack([first, cross(z, first), z], axis=-1)
    turning = np.swapaxes(R, 1, 2) @ np.gradient(R, h, axis=0)
    omega = np.stack([turning[:, 2, 1], turning[:, 0, 2], turning[:, 1, 0]], axis=-1)
    low, high = asked.vehicle.rotor_limits / asked.units.force
    forces = np.repeat(np.clip(np.linalg.norm(force, axis=1), low, high)[:, None], asked.rotors, axis=1)
    states = np.hstack([x, x_dot, R.reshape(len(x), 9), omega, y, y_dot, forces])
    states[0] = asked.start
    return states, forces[:-1]
