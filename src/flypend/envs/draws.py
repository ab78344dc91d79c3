"""Random starts as expressions in uniform numbers, so that a kernel can draw them."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from flypend.geometry import rotation_from_quat_xyzw


class Draws:
    """Hands out symbols, each a number uniform in (0, 1), and what can be made of them."""

    def __init__(self) -> None:
        self._symbols: list[Any] = []

    @property
    def symbols(self) -> Any:
        """The symbols handed out so far (k, 1)."""
        return ca.vertcat(*self._symbols) if self._symbols else ca.SX(0, 1)

    def share(self) -> Any:
        """A number uniform in (0, 1)."""
        self._symbols.append(ca.SX.sym(f"u{len(self._symbols)}"))
        return self._symbols[-1]

    def between(self, low: float, high: float) -> Any:
        """A number uniform between `low` and `high`; no draw if they are equal."""
        return ca.SX(low) if low == high else low + (high - low) * self.share()

    def direction(self) -> Any:
        """A unit vector (3, 1), uniform on S²: its third component is uniform."""
        return self.cap(np.pi)

    def cap(self, angle: float) -> Any:
        """A unit vector (3, 1), uniform among those within `angle` (rad) of e₃."""
        height, turn = 1 - (1 - np.cos(angle)) * self.share(), 2 * np.pi * self.share()
        level = ca.sqrt(ca.fmax(1 - height**2, 0))
        return ca.vertcat(level * ca.cos(turn), level * ca.sin(turn), height)

    def ball(self, radius: float) -> Any:
        """A vector (3, 1), uniform in a ball; no draw if its radius is 0."""
        if radius == 0:
            return ca.SX(3, 1)
        return radius * self.share() ** (1 / 3) * self.direction()

    def tangent(self, y: Any, radius: float) -> Any:
        """A vector (3, 1) tangent to S² at `y`: one of the ball, projected."""
        vector = self.ball(radius)
        return vector - ca.dot(y, vector) * y

    def rotation(self) -> Any:
        """A rotation (3, 3), uniform on SO(3) (Shoemake 1992)."""
        share, first, second = self.share(), 2 * np.pi * self.share(), 2 * np.pi * self.share()
        small, large = ca.sqrt(1 - share), ca.sqrt(share)
        x, y, z, w = small * ca.sin(first), small * ca.cos(first), large * ca.sin(second), large * ca.cos(second)
        return rotation_from_quat_xyzw(ca.vertcat(x, y, z, w))

    def level(self, angle: float) -> Any:
        """A rotation (3, 3) of any heading whose third axis is within `angle` (rad) of e₃."""
        axis, turn = self.cap(angle), 2 * np.pi * self.share()
        heading = ca.vertcat(ca.cos(turn), ca.sin(turn), 0)
        side = ca.cross(axis, heading)
        second = side / ca.norm_2(side)
        return ca.horzcat(ca.cross(second, axis), second, axis)
