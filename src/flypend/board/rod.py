"""Where the rod points and how fast it turns, from its directions alone and what an accelerometer at the pivot feels.

With a the specific force at the pivot, world axes, a massless rod of length l without friction turns as

    ÿ = −(1 − y yᵀ) a / l − |ẏ|² y,

whatever the masses, the thrust and the force that holds or pushes the vehicle. Between directions that are told the
estimate follows this; each direction told corrects it with the gains of a critically damped observer.
"""

from __future__ import annotations

import casadi as ca

from flypend.compile.record import Field, Record
from flypend.geometry import dot, scale, tangent_part, unit
from flypend.plants.sensing import NOTHING

RECORD = Record(
    "rod_estimate",
    "Rod, from its directions and the specific force.",
    (
        Field("y", 3, "unit vector from the pivot to the bob, world"),
        Field("y_dot", 3, "its rate, world, 1/s"),
        Field("since", 0, "seconds since the last direction; negative before the first"),
    ),
)
BANDWIDTH = (
    100.0  # 1/s: a tenth of a second forgets a first rate of 0; 1 mrad of noise at 100 Hz is 0.025 rad/s of rate
)
GAP = 0.1  # s without a direction, after which it begins anew


def tracking(period: float) -> ca.Function:
    """Return (memory (7,), direction (3,), age, specific force (3,), rod length) → memory, `period` seconds later.

    The direction, world, is `age` seconds old, of any length; a negative age says that there is none. The specific
    force is that of the period that ends, world, m/s².
    """
    memory, told, age = ca.SX.sym("memory", RECORD.length), ca.SX.sym("told", 3), ca.SX.sym("age")
    force, length = ca.SX.sym("force", 3), ca.SX.sym("length")
    before = RECORD.split(memory)
    fresh, since = age >= 0, before["since"] + period
    first = (before["since"] < 0) + (since > GAP) > 0
    turning = -tangent_part(before["y"], force) / length - scale(dot(before["y_dot"], before["y_dot"]), before["y"])
    y = unit(before["y"] + period * before["y_dot"] + period**2 / 2 * turning)
    y_dot = tangent_part(y, before["y_dot"] + period * turning)
    off = tangent_part(y, told / ca.sqrt(ca.fmax(ca.sumsqr(told), 1e-12)) - (y - age * y_dot + age**2 / 2 * turning))
    pole = 1 / (1 + BANDWIDTH * since)
    better = unit(y + (1 - pole**2) * off)
    faster = tangent_part(better, y_dot + (1 - pole) ** 2 / since * off)
    begun = told / ca.sqrt(ca.fmax(ca.sumsqr(told), 1e-12))

    def chosen(kept: ca.SX, corrected: ca.SX, anew: ca.SX) -> ca.SX:
        return ca.if_else(fresh, ca.if_else(first, anew, corrected), kept)

    later = ca.if_else(before["since"] < 0, NOTHING, since)
    after = RECORD.join(
        {
            "y": chosen(y, better, begun),
            "y_dot": chosen(y_dot, faster, ca.SX.zeros(3)),
            "since": ca.if_else(fresh, 0, later),
        }
    )
    return ca.Function("track_rod", [memory, told, age, force, length], [ca.densify(after)])
