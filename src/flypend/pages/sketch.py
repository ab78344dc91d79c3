"""Geometry of drawings: quadrotor, rod, bob and thrust in the e₃-up world frame, and a camera that looks at them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend import geometry
from flypend.model import State, Vehicle

NEAREST = 0.05  # near plane over the camera distance: points closer to the eye are drawn as if on it
DISC_POINTS = 25
DISC_SHARE = 0.28  # drawn rotor radius over the distance to the nearest rotor, for a vehicle that tells no other
BOB_SHARE = 0.08  # drawn bob radius over the rod length; the bob is a point mass
HOVER_ARROW = 0.7  # length of the thrust arrow in hover over the rod length
LONGEST_ARROW = 1.1  # maximum length of the thrust arrow over the rod length
ROTOR_ARROW = 0.32 / HOVER_ARROW  # length of a rotor's arrow over that of the whole, both carrying their share


@dataclass(frozen=True, eq=False, kw_only=True)
class Sketch:
    """Points of the drawing of one state or a batch (`...`), in the e₃-up world frame; m.

    Parameters
    ----------
    pivot, bob : (..., 3)
        Ends of the rod.
    arms : (..., n, 2, 3)
        Segments from the pivot to each of the n rotors.
    discs : (..., n, k, 3)
        Closed circles around the rotors, in the rotor plane.
    front : (n,) bool
        Which rotors are foremost along the body x axis.
    thrust : (..., 2, 3)
        Arrow from the pivot along the thrust: 0.7 rod lengths in hover, at most 1.1.
    rotor_thrusts : (..., n, 2, 3)
        Arrows from the rotors along their forces: 0.32 rod lengths in hover, at most 0.5.
    """

    pivot: Any
    bob: Any
    arms: Any
    discs: Any
    front: Any
    thrust: Any
    rotor_thrusts: Any

    @property
    def rod(self) -> Any:
        """The rod as a segment (..., 2, 3)."""
        return np.stack([self.pivot, self.bob], axis=-2)


def sketch(state: State, vehicle: Vehicle, thrust: Any = 0.0, rotor_forces: Any = 0.0) -> Sketch:
    """Compute the drawing of `state`.

    Parameters
    ----------
    state : State
        One state or a batch, in the e₃-up frame.
    vehicle : Vehicle
        Source of the rotor positions and the rod length.
    thrust : (...)
        Thrust along z = R e₃, N, which sets the length of the arrow.
    rotor_forces : (..., n)
        Force of each rotor, N, which sets the length of its arrow.
    """
    rotors = vehicle.rotors_from_pivot
    radius, angle = disc_radius(vehicle), np.linspace(0.0, 2 * np.pi, DISC_POINTS)
    circle = radius * np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)
    pivot = state.x
    ends = pivot[..., None, :] + np.einsum("...ij,nj->...ni", state.R, rotors)
    discs = pivot[..., None, None, :] + np.einsum("...ij,nkj->...nki", state.R, rotors[:, None] + circle)
    hover = max(vehicle.weight, 1e-9)  # without gravity, any thrust gets the longest arrow
    tip = pivot + geometry.scale(_length(vehicle, np.asarray(thrust) / hover), state.z)
    single = ROTOR_ARROW * _length(vehicle, len(rotors) * np.asarray(rotor_forces) / hover)
    tips = ends + geometry.scale(np.broadcast_to(single, ends.shape[:-1]), state.z[..., None, :])
    return Sketch(
        pivot=pivot,
        bob=pivot + vehicle.rod_length * state.y,
        arms=np.stack([np.broadcast_to(pivot[..., None, :], ends.shape), ends], axis=-2),
        discs=discs,
        front=rotors[:, 0] > rotors[:, 0].max() - 1e-9,
        thrust=np.stack([pivot, tip], axis=-2),
        rotor_thrusts=np.stack([ends, tips], axis=-2),
    )


def _length(vehicle: Vehicle, relative: Any) -> Any:
    """Length of the arrow (m) of a force `relative` to that in hover."""
    return vehicle.rod_length * np.clip(HOVER_ARROW * np.asarray(relative, float), -LONGEST_ARROW, LONGEST_ARROW)


def disc_radius(vehicle: Vehicle) -> float:
    """Drawn radius of the rotors of `vehicle`, m."""
    if vehicle.body is not None:
        return float(vehicle.body.disc_radius)
    rotors = vehicle.rotors_from_pivot
    gaps = np.linalg.norm(rotors[:, None] - rotors[None], axis=-1) + np.diag(np.full(len(rotors), np.inf))
    return float(DISC_SHARE * gaps.min())


def reach(vehicle: Vehicle) -> float:
    """Radius around the pivot that contains the drawing of `vehicle`, including the thrust arrows; m."""
    rod, span = vehicle.rod_length, float(np.linalg.norm(vehicle.rotors_from_pivot, axis=-1).max())
    rotors = max(span + disc_radius(vehicle), float(np.hypot(span, ROTOR_ARROW * LONGEST_ARROW * rod)))
    return max(rotors, rod * max(1 + BOB_SHARE, LONGEST_ARROW))


def main_direction(states: State) -> Any:
    """Horizontal unit vector (3,) along which the rod moves most, or the vehicle if the rod stays vertical.

    Its sign follows the travel of the vehicle. `states` is a batch over time in the e₃-up frame.
    """
    travel = states.x[-1] - states.x[0]
    axis = np.array([1.0, 0.0])
    for points in (states.y[:, :2], states.x[:, :2] - states.x[0, :2]):
        values, vectors = np.linalg.eigh(points.T @ points / len(points))
        if values[-1] > 1e-6:
            axis = vectors[:, -1]
            break
    along = float(travel[:2] @ axis)
    sense = along if abs(along) > 1e-9 else axis[np.argmax(np.abs(axis))]
    return np.array([*(axis if sense > 0 else -axis), 0.0])


@dataclass(frozen=True, eq=False, kw_only=True)
class Camera:
    """A camera looking at `centre`, in perspective or orthographic projection.

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
