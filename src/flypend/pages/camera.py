"""A camera that maps world points to screen points, in perspective or orthographic projection."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

NEAREST = 0.05  # near plane over the camera distance: points closer to the eye are drawn as if on it


@dataclass(frozen=True, eq=False, kw_only=True)
class Camera:
    """A camera looking at `centre`.

    Parameters
    ----------
    direction : (3,)
        Unit vector from the camera into the scene.
    up : (3,)
        Unit vector normal to `direction` that points up the screen.
    centre : (3,)
        World point at the centre of the picture, m.
    distance : float
        Distance from the camera to `centre`, m; infinite for orthographic projection.
    """

    direction: Any
    up: Any
    centre: Any = (0.0, 0.0, 0.0)
    distance: float = np.inf

    @property
    def right(self) -> Any:
        """Unit vector to the right of the screen."""
        return np.cross(self.direction, self.up)


def depth(camera: Camera, points: Any) -> Any:
    """Depth of points (..., 3) behind the centre of `camera`, m."""
    return (np.asarray(points) - camera.centre) @ np.asarray(camera.direction)


def magnification(camera: Camera, points: Any) -> Any:
    """Screen size of objects at points (..., 3), relative to their size at the centre of `camera`."""
    if np.isinf(camera.distance):
        return np.ones(np.shape(points)[:-1])
    return 1 / np.maximum(1 + depth(camera, points) / camera.distance, NEAREST)


def project(camera: Camera, points: Any) -> Any:
    """Screen coordinates (..., 2), right and up, of world points (..., 3); m, to scale in the plane of the centre."""
    from_centre = np.asarray(points) - camera.centre
    flat = np.stack([from_centre @ camera.right, from_centre @ np.asarray(camera.up)], axis=-1)
    return flat * magnification(camera, points)[..., None]
