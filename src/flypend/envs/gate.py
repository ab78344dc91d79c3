"""A gate of two bars, and how far a machine with its rod is from them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.envs.task import Moment


@errors.named_arguments
@dataclass(frozen=True)
class Gate:
    """Two level bars along the second axis of the world, one above the other, above the origin; m.

    Parameters
    ----------
    radius : float
        Of each bar.
    lower : float
        Height of the lower bar.
    spacing : (2,)
        Least and largest height of the upper bar above the lower, drawn when a world begins.
    payload : float
        Radius of the payload.

    Raises
    ------
    InputError
        If a radius or a height is out of range.
    """

    radius: float = 0.04
    lower: float = 1.2
    spacing: tuple[float, float] = (0.9, 1.2)
    payload: float = 0.04

    def __post_init__(self) -> None:
        for name in ("radius", "payload"):
            errors.number(f"gate.{name}", getattr(self, name), at_least=0, unit="m")
        errors.number("gate.lower", self.lower, unit="m")
        least, largest = errors.array("gate.spacing", self.spacing, (2,)).tolist()
        errors.number("gate.spacing", least, at_least=0, unit="m")
        errors.number("gate.spacing", largest, at_least=least, unit="m")

    def bars(self, spacing: Any) -> list[Any]:
        """Return where the bars are, (2, 1) each: along the first axis, and height."""
        return [ca.vertcat(0, self.lower), ca.vertcat(0, self.lower + spacing)]

    def clearance(self, now: Moment, spacing: Any) -> Any:
        """Return the least distance, m, between a bar and rod, payload or vehicle; below 0 they touch.

        The vehicle is a disc about its pivot that reaches to the rims of its rotors, as thick as its hub. Along the
        bars a disc is seen as an ellipse; what is taken is the stadium around it with the same axes, which is the
        ellipse itself for a vehicle that is level or stands on edge.
        """
        pivot, end, z = now.state.x[[0, 2]], now.end[[0, 2]], now.state.R[:, 2]
        body = now.vehicle.body
        span = float(np.linalg.norm(now.vehicle.rotor_positions[:, :2], axis=1).max()) + body.disc_radius
        seen = ca.fabs(z[1])  # how much of the disc's face is seen along a bar
        half = span * ca.sqrt((1 - seen) / (1 + seen)) * ca.vertcat(-z[2], z[0])
        free = [
            ca.fmin(
                ca.fmin(_apart(bar, pivot, end) - body.rod_radius, ca.norm_2(bar - end) - self.payload),
                _apart(bar, pivot - half, pivot + half) - span * seen - body.hub_radius,
            )
            for bar in self.bars(spacing)
        ]
        return ca.fmin(*free) - self.radius


def _apart(point: Any, a: Any, b: Any) -> Any:
    """Distance of a `point` from the segment from `a` to `b`, m."""
    along = b - a
    share = ca.fmin(ca.fmax(ca.dot(point - a, along) / ca.fmax(ca.sumsqr(along), 1e-12), 0), 1)
    return ca.norm_2(point - a - share * along)
