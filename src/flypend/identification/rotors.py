"""Forces of the rotors over a log, from what was commanded, and their derivatives.

The forces follow commands exactly, hold by hold; a delay shifts them in time. So the force's integral is known at every
instant, and its mean over any step.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from flypend.building import built
from flypend.geometry import Numbers
from flypend.identification.model import places
from flypend.plants.lag import symbolic_timing
from flypend.plants.motors import follow, sag_forces

# Differences by which forces are differentiated; their own errors are a thousandth of the smallest standard error.
DIFFERENCE = {"lag": 1e-6, "spin_up": 1e-5, "sag": 1e-5, "delay": 1e-6, "curve": 1e-5}
SETTLED = 1e-9  # s; keeps a hold that has just begun from dividing by zero


class Forces(NamedTuple):
    """Forces of the rotors at the instants of a grid: `mean` and `change` over the step that follows (k−1, n), `now`
    (k, n), N.
    """  # noqa: D205

    mean: Numbers
    change: Numbers
    now: Numbers


def rotor_table(rotors: int) -> dict[str, int]:
    """Return the numbers of the rotors and their lengths: scale and shares (which rotor is stronger) are logarithms.

    `curve` bends the thrust of a command that is a fraction, towards its square.
    """
    return {"lag": 1, "spin_up": 1, "sag": 1, "delay": 1, "scale": 1, "shares": rotors - 1, "curve": 1}


def patterns(rotors: int) -> Any:
    """Return an orthonormal basis (n, n − 1) of differences between rotors, whose logarithms sum to zero."""
    full, _ = np.linalg.qr(np.column_stack([np.ones(rotors), np.eye(rotors)[:, 1:]]))
    return full[:, 1:]


@built(maxsize=4)
def _programs(rotors: int, count: int) -> tuple[ca.Function, ca.Function, ca.Function]:
    """Return programs of `rotors`, the second of which makes `count` holds, one after the other.

    (commands, largest, sag) → what forces settle at; (forces, target and duration, lag and spin-up) → forces after; and
    the same → their integral and forces after.
    """
    f, target, h, timing = (ca.SX.sym(a, k) for a, k in (("f", rotors), ("u", rotors), ("h", 1), ("p", 2)))
    falling, rising = symbolic_timing(timing[0], h), symbolic_timing(timing[0] * timing[1], h)
    ramp, end = follow(f, target, ca.vertcat(falling, rising))
    inputs, most, sag = [f, ca.vertcat(target, h), timing], ca.SX.sym("most"), ca.SX.sym("sag")
    return (
        ca.Function("settling", [f, most, sag], [sag_forces(f, most, sag)]),
        ca.Function("after", inputs, [end]).mapaccum(count),
        ca.Function("within", inputs, [ramp.mean * h, end]),
    )


def rotor_forces(
    t: Numbers, command: Numbers, grid: Numbers, numbers: dict[str, Any], most: float, pwm: bool
) -> Forces:
    """Return the forces on the instants `grid` (k,), s, of commands (N, n) that are held from `t` (N,), s.

    Commands are in N, or with `pwm` fractions of `most`, the largest force of a rotor, N. `numbers` has values by the
    names of `rotor_table`.
    """
    n = command.shape[1]
    settling, following, within = _programs(n, len(t))
    asked = command * most * (1 + numbers["curve"][0] * (command - 1)) if pwm else command
    strength = np.exp(numbers["scale"][0] + patterns(n) @ numbers["shares"])
    target = np.asarray(settling(asked.T, most, numbers["sag"][0])) * strength[:, None]
    timing = np.array([numbers["lag"][0], numbers["spin_up"][0]])
    driven = np.vstack([target, np.append(np.diff(t), 1.0)])
    ends = np.asarray(following(target[:, 0], driven, timing))
    begin = np.column_stack([target[:, 0], ends[:, :-1]])
    whole = np.asarray(within(begin, driven, timing)[0])
    before = np.column_stack([np.zeros(n), np.cumsum(whole, axis=1)[:, :-1]])
    at = grid - numbers["delay"][0]
    k = np.maximum(np.searchsorted(t, at, side="right") - 1, 0)
    since = np.maximum(at - t[k], SETTLED)
    part, now = (np.asarray(value) for value in within(begin[:, k], np.vstack([target[:, k], since]), timing))
    early = at < t[0]  # the first command is taken to have been held before
    area = before[:, k] + np.where(early, target[:, :1] * (at - t[0]), part)
    now = np.where(early, target[:, :1], now)
    return Forces((np.diff(area, axis=1) / np.diff(grid)).T, np.diff(now, axis=1).T, now.T)


def rotor_slopes(middle: Forces, forces: Any, rotors: Numbers, table: dict[str, int], free: Numbers) -> Numbers:
    """Return derivatives (2, k, n, q) of the mean over the step that follows, and of the force now.

    `forces` makes them of numbers (q,), `middle` of `rotors`; what is not `free` (q,) has none.
    """
    n = middle.now.shape[1]
    slopes = np.zeros((2, len(middle.now), n, len(rotors)))
    shape = np.column_stack([np.ones(n), patterns(n)])  # forces are proportional to their strengths
    for name, place in places(table).items():
        for i in range(place.start, place.stop):
            if not free[i]:
                continue
            if name in ("scale", "shares"):
                by = shape[:, i - place.start + (name == "shares")]
                slopes[0, :-1, :, i], slopes[1, :, :, i] = by * middle.mean, by * middle.now
                continue
            moved = rotors.copy()
            moved[i] += DIFFERENCE[name]
            other = forces(moved)
            slopes[0, :-1, :, i] = (other.mean - middle.mean) / DIFFERENCE[name]
            slopes[1, :, :, i] = (other.now - middle.now) / DIFFERENCE[name]
    return slopes
