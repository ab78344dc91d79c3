"""`Window`: an opening in a wall to fly through, and how much room a machine leaves in it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flypend import errors
from flypend.errors import InputError
from flypend.geometry import cross, norm
from flypend.model import State, Vehicle

RIM = 24  # corners of the polygons that stand for discs
STEEP = 1e-3  # least sine between the normal and what is up in the window
TINY = 1e-12

Array = NDArray[np.float64]


@errors.named_arguments
@dataclass(frozen=True, eq=False)
class Window:
    """A rectangular opening in a plane wall without end, world frame with e₃ up.

    Parameters
    ----------
    centre : (3,)
        Centre of the opening, m.
    width, height : float
        Its sides: level, or normal to `up`, and along `up`; m.
    normal : (3,)
        Direction normal to the wall, either way.
    up : (3,)
        Direction along which the height is measured; its part along the normal does not count.
    depth : float
        Thickness of the wall, m.

    Raises
    ------
    InputError
        If a side is not positive, the depth negative, or `up` normal to the wall.
    """

    centre: Any
    width: float
    height: float
    normal: Any = (1.0, 0.0, 0.0)
    up: Any = (0.0, 0.0, 1.0)
    depth: float = 0.0

    def __post_init__(self) -> None:
        for name in ("centre", "normal", "up"):
            object.__setattr__(self, name, errors.array(f"window.{name}", getattr(self, name), (3,)))
        for name in ("width", "height"):
            object.__setattr__(self, name, errors.number(f"window.{name}", getattr(self, name), above=0, unit="m"))
        object.__setattr__(self, "depth", errors.number("window.depth", self.depth, at_least=0, unit="m"))
        if not norm(self.normal) > 0:
            raise InputError("window.normal", "a direction", self.normal.tolist())
        if not norm(cross(self.normal, self.up)) > STEEP * norm(self.normal) * norm(self.up):
            raise InputError("window.up", "a direction along the wall", self.up.tolist())

    @property
    def axes(self) -> Array:
        """Unit vectors (3, 3), as rows: along the width, along the height, and normal to the wall."""
        n = self.normal / norm(self.normal)
        v = self.up - np.dot(self.up, n) * n
        v /= norm(v)
        return np.array([cross(v, n), v, n])

    @property
    def halves(self) -> Array:
        """Half of width and height (2,), m."""
        return np.array([self.width, self.height]) / 2

    def inside(self, points: ArrayLike) -> Array:
        """Return `points` (..., 3), world, about the centre along the `axes`, m."""
        about: Array = (np.asarray(points) - self.centre) @ self.axes.T
        return about

    def room(self, states: State, vehicle: Vehicle) -> Array:
        """Return how much room a vehicle leaves between itself and the frame, (n,), m; negative where they overlap.

        It is the least distance, along the wall, between the frame and what is within the wall: rod, arms, hub and
        rotor discs, each with its radius. It is infinite where nothing of the machine is.

        Parameters
        ----------
        states : State
            A batch of n states, e₃ up.
        vehicle : Vehicle
            The vehicle, with a body.
        """
        first, last, radii = _edges(states, vehicle)
        a, b = self.inside(first), self.inside(last)
        run = b[..., 2] - a[..., 2]
        run = np.where(np.abs(run) < TINY, TINY, run)
        deep = self.depth / 2 + radii
        meets = np.sort([(-deep - a[..., 2]) / run, (deep - a[..., 2]) / run], axis=0)
        enters, leaves = np.maximum(meets[0], 0.0), np.minimum(meets[1], 1.0)
        across = [np.abs(a + share[..., None] * (b - a))[..., :2] for share in (enters, leaves)]
        left = np.min(self.halves - across, axis=(0, -1)) - radii  # along a straight edge the ends are nearest
        least: Array = np.min(np.where(enters <= leaves, left, np.inf), axis=-1)
        return least


def body_of(vehicle: Vehicle) -> tuple[float, float, float]:
    """Return radius and height over the pivot of a disc about all discs of `vehicle`, and the radius of its parts.

    That is the larger one of rod and arms; all in m. Raises InputError without a body.
    """
    body = vehicle.body
    if body is None:
        raise InputError("vehicle.body", "the radii of the machine's parts, to fly through a window", "nothing")
    centres = vehicle.rotors_from_pivot
    radius = float(np.max(np.linalg.norm(centres[:, :2], axis=1))) + body.disc_radius
    return radius, float(np.mean(centres[:, 2])), max(body.rod_radius, body.arm_radius)


def _edges(states: State, vehicle: Vehicle) -> tuple[Array, Array, Array]:
    """Return the ends (n, k, 3), world, of the edges of a machine, and how thick they are (k,), m.

    They are the rod, the arms, and polygons about rotor discs and hub.
    """
    body, centres = vehicle.body, vehicle.rotors_from_pivot
    turn = 2 * np.pi * np.arange(RIM) / RIM
    circle = np.stack([np.cos(turn), np.sin(turn), np.zeros(RIM)], axis=-1) / np.cos(np.pi / RIM)
    discs = [(centre, body.disc_radius) for centre in centres] + [(np.zeros(3), body.hub_radius)]
    corners = np.concatenate([centre + radius * circle for centre, radius in discs])
    following = np.concatenate([centre + radius * np.roll(circle, -1, axis=0) for centre, radius in discs])
    begin = np.concatenate([np.zeros_like(centres), corners])
    end = np.concatenate([centres, following])
    x, R = states.x[:, None, :], states.R
    first = np.concatenate([x, x + begin @ np.swapaxes(R, -1, -2)], axis=1)
    last = np.concatenate([x + vehicle.reach * states.y[:, None, :], x + end @ np.swapaxes(R, -1, -2)], axis=1)
    thick = np.concatenate([[body.rod_radius], np.full(len(centres), body.arm_radius), np.zeros(len(corners))])
    return first, last, thick
