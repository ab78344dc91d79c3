"""Measurement noise as data."""

from __future__ import annotations

from dataclasses import dataclass, fields

from flypend import errors


@errors.named_arguments
@dataclass(frozen=True, kw_only=True)
class Noise:
    """Standard deviations of white measurement noise, drawn independently at every control tick.

    Parameters
    ----------
    x, x_dot : float
        Position (m) and velocity (m/s).
    attitude, omega : float
        Rotation vector (rad) and angular velocity (rad/s).
    y, y_dot : float
        Rod direction (rad) and its rate (1/s).
    """

    x: float = 0.0
    x_dot: float = 0.0
    attitude: float = 0.0
    omega: float = 0.0
    y: float = 0.0
    y_dot: float = 0.0

    def __post_init__(self) -> None:
        for entry in fields(self):
            errors.number(f"noise.{entry.name}", getattr(self, entry.name), at_least=0)


# Motion capture and a gyroscope: 1 mm, 0.2 degrees; rates from filtered differences.
MOTION_CAPTURE = Noise(x=1e-3, x_dot=1e-2, attitude=3.5e-3, omega=2e-2, y=3.5e-3, y_dot=3e-2)
