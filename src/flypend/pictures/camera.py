"""A camera: world points to points on the screen, with perspective or with parallel rays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

NEAREST = 0.05  # of the camera's distance: points closer to the eye are drawn as if they were here


@dataclass(frozen=True, eq=False, kw_only=True)
class Camera:
    """A camera that looks at `centre`.

    Parameters
    ----------
    direction : (3,)
        Unit vector from the camera into the scene.
    up : (3,)
        Unit vector normal to `direction`, up the screen.
    centre : (3,)
        World point in the middle of the picture; m.
    distance : float
        From the camera to `centre`, m; infinite for parallel rays.
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
    """How far points (..., 3) lie behind the centre of `camera`, m."""
    return (np.asarray(points) - camera.centre) @ np.asarray(camera.direction)


def magnification(camera: Camera, points: Any) -> Any:
    """Size on the screen of things at points (..., 3), relative to the same things at the centre of `camera`."""
    if np.isinf(camera.distance):
        return np.ones(np.shape(points)[:-1])
    return 1 / np.maximum(1 + depth(camera, points) / camera.distance, NEAREST)


def project(camera: Camera, points: Any) -> Any:
    """Screen coordinates (..., 2), to the right and up, of world points (..., 3); m in the plane of the centre."""
    from_centre = np.asarray(points) - camera.centre
    flat = np.stack([from_centre @ camera.right, from_centre @ np.asarray(camera.up)], axis=-1)
    return flat * magnification(camera, points)[..., None]
