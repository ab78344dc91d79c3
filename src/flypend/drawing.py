"""What a picture shows, before any picture: quadrotor, rod, bob and thrust as points in space, and the camera.

Figures and movies draw the same points through the same cameras. Everything here is in the frame with e₃ up, whatever
the frame of the run, so gravity points down every picture that looks horizontally (`axis` looks along it).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Circle

from flypend import errors, geometry
from flypend.camera import Camera, depth, magnification, project
from flypend.model import State, Vehicle
from flypend.model.state import project as project_states
from flypend.trajectory import Trajectory

VIEWS = ("side", "axis")

# Okabe and Ito's palette, which colour-blind readers can tell apart; used with line styles and widths, for print.
INK, GREY, BLUE, RED, GREEN, ORANGE = "#1a1a1a", "#8c8c8c", "#0072b2", "#d55e00", "#009e73", "#e69f00"

ROD: dict[str, Any] = {"color": RED, "linewidth": 2.2, "solid_capstyle": "round"}
TRAIL: dict[str, Any] = {"color": BLUE, "linewidth": 1.0, "linestyle": (0, (3, 1))}
THRUST: dict[str, Any] = {"color": GREEN, "linewidth": 1.1}
REAR = "#d9d9d9"  # rotors; the front ones are orange

EYE = 8.0  # distance of the camera of a picture, over the reach of the drawing
ELEVATION = np.deg2rad(12.0)  # of the side camera, so that a level rotor is a thin ellipse and not a line
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


def camera_for(run: Trajectory, view: str, *, elevation: float = ELEVATION, distance: float = np.inf) -> Camera:
    """The camera of a view of `run`, looking at the origin (subtract the pivot to follow it).

    Parameters
    ----------
    run : Trajectory
        In either frame.
    view : "side" or "axis"
        "side" looks horizontally, across the direction in which the rod moves most, so gravity points down the
        screen. "axis" is the camera that the paper mounts on its −e₃ axis: e₃ is along gravity there, so it is above
        and looks down; gravity points into the screen, and a hanging rod shrinks to its middle.
    elevation : float
        Of the side camera above the horizon, rad.
    distance : float
        From the origin, m.

    Raises
    ------
    InputError
        For an unknown view.
    """
    if errors.one_of("view", view, VIEWS) == "axis":
        return Camera(direction=-geometry.E3, up=geometry.E2, distance=distance)
    right = main_direction(run)
    level = np.cross(geometry.E3, right)
    c, s = np.cos(elevation), np.sin(elevation)
    return Camera(direction=c * level - s * geometry.E3, up=s * level + c * geometry.E3, distance=distance)


def main_direction(run: Trajectory) -> Any:
    """Horizontal unit vector (3,), e₃ up, along which the rod moves most; the vehicle, if the rod stays vertical.

    Of the two senses, the one in which the vehicle travels.
    """
    states = upright(run.states, run)
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


def upright(state: State, run: Trajectory) -> State:
    """`state`, which is in the frame of `run`, in the frame with e₃ up."""
    return state if run.e3 == "up" else state.flipped()


def states_at(run: Trajectory, times: Any) -> State:
    """States of `run` at `times` (n,), s, in the frame with e₃ up; from samples if the dense output is gone.

    Times outside the run mean its first and last instant. Between samples that are further apart than a quarter turn
    nothing can be interpolated, and the nearer one is taken.
    """
    times = np.clip(np.atleast_1d(np.asarray(times, dtype=float)), run.t[0], run.t[-1])
    if run.interpolant is not None:
        return upright(run.at(times), run)
    last = len(run.t) - 1
    before = np.clip(np.searchsorted(run.t, times, side="right") - 1, 0, max(last - 1, 0))
    after = np.minimum(before + 1, last)
    gap = np.where(after > before, run.t[after] - run.t[before], 1.0)
    share = (times - run.t[before]) / gap
    turned = np.einsum("tij,tij->t", run.R[before], run.R[after]) < 1  # trace(RᵀR′) < 1: more than a quarter turn
    far = turned | (geometry.dot(run.y[before], run.y[after]) < 0)
    share = np.where(far, np.round(share), share)[:, None]
    packed = run.states.packed()
    return upright(State.from_packed(project_states((1 - share) * packed[before] + share * packed[after])[0]), run)


def thrust_at(run: Trajectory, times: Any) -> Any:
    """Thrust of `run` at `times` (n,), s, along z = R e₃ of the frame with e₃ up; N, interpolated between samples."""
    return np.interp(times, run.t, run.thrust) * (1.0 if run.e3 == "up" else -1.0)


def draw(ax: Any, run: Trajectory, camera: Camera, middle: Any, t: float, *, since: float, ghosts: int = 5) -> None:
    """Draw `run` at a time around a point of `ax`, with the path of the bob about the pivot before.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Its units are metres.
    run : Trajectory
        In either frame.
    camera : Camera
        Looks at the origin, where the pivot is put.
    middle : (2,)
        Where in `ax` the pivot goes.
    t, since : float
        Time of the drawing and of the start of the path of the bob (of a rod that whirls, the last turn); s.
    ghosts : int
        Number of pale rods along the path.
    """

    def screen(points: Any) -> Any:
        return np.add(middle, project(camera, points))

    vehicle = run.vehicle
    rate = max(float(geometry.norm(states_at(run, t).y_dot)[0]), 1e-9)
    states = states_at(run, np.linspace(max(since, t - 2 * np.pi / rate), t, 40 * ghosts + 1))
    bobs = vehicle.rod_length * states.y
    shape = sketch(replace(states[-1], x=np.zeros(3)), vehicle, thrust_at(run, t))
    behind = depth(camera, shape.bob) > 0

    rods = [screen(np.array([shape.pivot, bob])) for bob in bobs[:-1:40]]
    ax.add_collection(LineCollection(rods, color="#c4c4c4", linewidth=0.8, zorder=1))
    ax.plot(*screen(bobs).T, **TRAIL, zorder=1.5)
    for front, color in ((False, REAR), (True, ORANGE)):
        style = {"facecolor": color, "edgecolor": INK, "linewidth": 0.6, "alpha": 0.6, "zorder": 3}
        ax.add_collection(PolyCollection(list(screen(shape.discs[shape.front == front])), **style))
    ax.add_collection(LineCollection(list(screen(shape.arms)), color=INK, linewidth=1.6, zorder=3.1))
    if np.linalg.norm(np.diff(project(camera, shape.thrust), axis=0)) > 0.1 * vehicle.rod_length:  # else only a head
        _arrow(ax, *screen(shape.thrust), **THRUST, zorder=4.2)
    ax.plot(*screen(shape.rod).T, **ROD, zorder=2 if behind else 4)
    radius = BOB_SHARE * vehicle.rod_length * float(magnification(camera, shape.bob))
    ball = {"facecolor": RED, "edgecolor": INK, "linewidth": 0.7, "zorder": 2.1 if behind else 4.1}
    ax.add_patch(Circle(screen(shape.bob), radius, **ball))


def gravity_symbol(ax: Any, view: str, at: Any, size: float, *, fontsize: float) -> None:
    """The letter g with an arrow down the screen, or ⊗ (into the screen) where the view looks along gravity.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        With units of equal length on both axes.
    view : "side" or "axis"
        As in `camera_for`.
    at : (2,)
        Middle of the symbol in units of `ax`.
    size : float
        Half the length of the arrow in units of `ax`.
    fontsize : float
        Of the letter, pt.
    """
    x, y = at
    if view == "axis":
        ax.add_patch(Circle((x, y), 0.75 * size, facecolor="white", edgecolor=INK, linewidth=1.2))
        d = 0.75 * size * np.sqrt(0.5)
        for tilt in (-1, 1):
            ax.plot([x - d, x + d], [y - tilt * d, y + tilt * d], color=INK, linewidth=1.2)
    else:
        _arrow(ax, (x, y + size), (x, y - size), color=INK, linewidth=1.2)
    ax.text(x + size, y, "g", fontsize=fontsize, va="center", style="italic")


def _arrow(ax: Any, tail: Any, tip: Any, *, zorder: float = 2.0, **style: Any) -> None:
    head = {"arrowstyle": "-|>,head_width=0.18,head_length=0.35", "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", tip, tail, arrowprops={**head, **style}, zorder=zorder)
