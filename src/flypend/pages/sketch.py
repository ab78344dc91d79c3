"""What a picture shows, before any picture: quadrotor, rod, bob and thrust as points in space, with e₃ up."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from flypend import geometry
from flypend.model import State, Vehicle

DISC_POINTS = 25
DISC_SHARE = 0.28  # radius of a drawn rotor over the distance to its neighbour; the vehicle does not state one
BOB_SHARE = 0.08  # radius of the drawn bob over the length of the rod; a point mass has none
HOVER_ARROW = 0.7  # length of the thrust arrow in hover, and its largest length, over the length of the rod
LONGEST_ARROW = 1.1


@dataclass(frozen=True, eq=False, kw_only=True)
class Sketch:
    """Points of the drawing of one state, or of a batch (`...`), in the world with e₃ up; m.

    Parameters
    ----------
    pivot, bob : (..., 3)
        Ends of the rod.
    arms : (..., n, 2, 3)
        From the pivot to each of the n rotors.
    discs : (..., n, k, 3)
        Closed circles in the plane of the body around the rotors.
    front : (n,) bool
        Which rotors are foremost in the body frame.
    thrust : (..., 2, 3)
        Arrow from the pivot along the force of the rotors: 0.7 of the rod in hover, at most 1.1.
    """

    pivot: Any
    bob: Any
    arms: Any
    discs: Any
    front: Any
    thrust: Any

    @property
    def rod(self) -> Any:
        """The rod as a segment (..., 2, 3)."""
        return np.stack([self.pivot, self.bob], axis=-2)


def sketch(state: State, vehicle: Vehicle, thrust: Any = 0.0) -> Sketch:
    """The drawing of `state`.

    Parameters
    ----------
    state : State
        One state or a batch, in the frame with e₃ up.
    vehicle : Vehicle
        Its rotors and rod are drawn.
    thrust : (...)
        Force along z = R e₃, N; the length of the arrow.
    """
    rotors = vehicle.rotor_positions
    radius, angle = disc_radius(vehicle), np.linspace(0.0, 2 * np.pi, DISC_POINTS)
    circle = radius * np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)
    pivot = state.x
    ends = pivot[..., None, :] + np.einsum("...ij,nj->...ni", state.R, rotors)
    discs = pivot[..., None, None, :] + np.einsum("...ij,nkj->...nki", state.R, rotors[:, None] + circle)
    hover = max(vehicle.weight, 1e-9)  # without gravity there is no hover, and every force draws the longest arrow
    length = np.clip(HOVER_ARROW * np.asarray(thrust, dtype=float) / hover, -LONGEST_ARROW, LONGEST_ARROW)
    tip = pivot + geometry.scale(vehicle.rod_length * length, state.z)
    return Sketch(
        pivot=pivot,
        bob=pivot + vehicle.rod_length * state.y,
        arms=np.stack([np.broadcast_to(pivot[..., None, :], ends.shape), ends], axis=-2),
        discs=discs,
        front=rotors[:, 0] > rotors[:, 0].max() - 1e-9,
        thrust=np.stack([pivot, tip], axis=-2),
    )


def disc_radius(vehicle: Vehicle) -> float:
    """Radius of a drawn rotor of `vehicle`, m."""
    rotors = vehicle.rotor_positions
    gaps = np.linalg.norm(rotors[:, None] - rotors[None], axis=-1) + np.diag(np.full(len(rotors), np.inf))
    return float(DISC_SHARE * gaps.min())


def reach(vehicle: Vehicle) -> float:
    """Distance from the pivot within which the drawing of `vehicle` stays, arrow included; m."""
    rotors = float(np.linalg.norm(vehicle.rotor_positions, axis=-1).max()) + disc_radius(vehicle)
    return max(rotors, vehicle.rod_length * max(1 + BOB_SHARE, LONGEST_ARROW))


def main_direction(states: State) -> Any:
    """Horizontal unit vector (3,) along which the rod moves most; the vehicle, if the rod stays vertical.

    Of the two senses, the one in which the vehicle travels. `states` are a batch over time in the frame with e₃ up.
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
