"""Frames of a movie: the camera follows the pivot over a scrolling grid, with y₃ and z₃ plotted below.

The static background is drawn once; each frame restores it and draws a dozen artists on top.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from functools import cache, lru_cache
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path
from matplotlib.textpath import TextPath
from matplotlib.transforms import IdentityTransform

from flypend import geometry
from flypend.flight.trajectory import Trajectory
from flypend.flight.verdict import verdict
from flypend.model import State, Vehicle
from flypend.pages import sketch
from flypend.pages.sketch import Camera, Sketch, depth, magnification, project
from flypend.palette import BLUE, GREEN, INK, ORANGE, REAR, RED, STATES
from flypend.pictures import drawing

Frame = Any  # memoryview of (height, width, 4) bytes, valid until the next frame is drawn
Pair = tuple[float, float]
Part = Callable[[int], list[Any]]  # updates artists for a frame and returns them in drawing order

TRAIL = 0.5  # length of the bob's trail, s of flight
ZOOM = 1.3  # half the shorter side of the scene, over the reach of the drawing
GRIDS = (0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)  # grid spacings, m
# Left, bottom, width and height as fractions of the picture. Static labels go above the scene, clear of the lines.
SCENE, STRIP, HEAD = (0.0, 0.215, 1.0, 0.665), (0.085, 0.07, 0.885, 0.115), (0.0, 0.88, 1.0, 0.12)
LINE = "#d4d4d4"


def stage(run: Trajectory, times: Any, view: str, speed: float, size: tuple[int, int]) -> Callable[[int, bool], Frame]:
    """Set up a picture of `size` pixels; return `render(i, ended)`, which draws the frame at `times[i]`."""
    rod = run.vehicle.rod_length
    camera = drawing.camera_for(run, view, distance=drawing.EYE * sketch.reach(run.vehicle))
    states = drawing.states_at(run, times)
    shape = drawing.sketch_at(run, times, states)
    # A fast rod turns too far between frames for a straight line: use `finer` path points per frame.
    turn = geometry.norm(states.y_dot).max() * np.diff(times).max(initial=0.0)
    finer = int(np.clip(np.ceil(turn / 0.15), 1, 24))
    fine = np.interp(np.arange((len(times) - 1) * finer + 1) / finer, np.arange(len(times)), times)
    path = drawing.states_at(run, fine)

    dpi = 100 * min(size) / 640  # a hundredth of a pixel is added so that no side is rounded down
    figure = Figure(figsize=((size[0] + 0.01) / dpi, (size[1] + 0.01) / dpi), dpi=dpi, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    head, scene, strip = (figure.add_axes(place) for place in (HEAD, SCENE, STRIP))
    half = _scene(scene, run, size)
    _head(head, view, speed, size)
    _strip(strip, run, fine, path)
    parts = [
        *_grids(scene, run, states.x, camera, view, half),
        _trail(scene, project(camera, rod * path.y), finer, fine),
        _body(scene, shape, camera, run.vehicle),
        _readout(head, times, states),
        _cursor(strip, times),
    ]
    outcome = verdict(run)
    words = outcome["words"].replace(", ", "\n")
    style = {"color": STATES[outcome["state"]], "fontsize": 14, "ha": "center", "va": "center"}
    box = {"facecolor": "white", "edgecolor": "none", "pad": 3.0}
    side = -0.6 if states.y[-1, 2] > 0 else 0.78  # away from the bob
    ending = scene.text(0, side * half[1], words, bbox=box, animated=True, **style)
    canvas.draw()
    background = canvas.copy_from_bbox(figure.bbox)

    def render(i: int, ended: bool) -> Frame:
        canvas.restore_region(background)
        for part in parts:
            for artist in part(i):
                artist.axes.draw_artist(artist)
        if ended:
            scene.draw_artist(ending)
        return canvas.buffer_rgba()

    return render


def _scene(ax: Any, run: Trajectory, size: tuple[int, int]) -> Pair:
    """Set up the scene around the pivot; return half its width and height, m."""
    pixels = (size[0] * SCENE[2], size[1] * SCENE[3])
    scale = ZOOM * sketch.reach(run.vehicle) / min(pixels)
    half = (pixels[0] * scale, pixels[1] * scale)
    ax.set(xlim=(-half[0], half[0]), ylim=(-half[1], half[1]), xticks=[], yticks=[])
    ax.spines[:].set_color(LINE)
    return half


def _head(ax: Any, view: str, speed: float, size: tuple[int, int]) -> None:
    """Draw the header, in units of its height: playback speed, direction of gravity, legend."""
    width = size[0] * HEAD[2] / (size[1] * HEAD[3])
    ax.set(xlim=(0, width), ylim=(0, 1))
    ax.set_axis_off()
    ax.text(0.12, 0.1, f"{speed:g} × real time", fontsize=8, color="#5a5a5a")
    drawing.gravity_symbol(ax, view, (0.56 * width, 0.5), 0.3, fontsize=12)
    handles = [
        Line2D([], [], color=GREEN, linewidth=2.5, label="thrusts, sum in outline"),
        Line2D([], [], color=BLUE, linewidth=1.8, label=f"bob, last {TRAIL:g} s"),
        Line2D([], [], color=ORANGE, linewidth=0, marker="o", markeredgecolor=INK, label="front rotor"),
    ]
    ax.legend(handles=handles, loc="center right", fontsize=9, frameon=False, handlelength=1.3, labelspacing=0.3)


def _strip(ax: Any, run: Trajectory, t: Any, states: State) -> None:
    """Plot y₃ and z₃ over time in the frame of the run, from `states` (e₃ up) at times `t`."""
    sign, pole = (1, "inverted") if run.e3 == "up" else (-1, "hanging")
    ax.plot(t, sign * states.y[:, 2], color=RED, linewidth=1.6, label=f"$y_3$ (1: {pole})")
    # Flipping both world and body frame leaves z₃ = R₃₃ unchanged.
    ax.plot(t, states.z[:, 2], color=BLUE, linewidth=1.3, linestyle="--", label="$z_3$ (1: upright)")
    ax.set(xlim=(run.t[0], max(run.t[-1], run.t[0] + 1e-3)), ylim=(-1.15, 1.15), yticks=[-1, 0, 1])
    ax.tick_params(labelsize=8, length=2.5)
    ax.grid(visible=True, color="#e3e3e3", linewidth=0.6)
    ax.set_xlabel("time (s)", fontsize=8, labelpad=1)
    at = {"loc": "lower left", "bbox_to_anchor": (0.0, 0.97), "borderaxespad": 0.1}
    ax.legend(fontsize=9, ncols=2, frameon=False, handlelength=1.8, columnspacing=1.2, **at)
    ax.text(1.0, 1.08, f"{run.law} law", transform=ax.transAxes, ha="right", fontsize=9)


def _grids(ax: Any, run: Trajectory, x: Any, camera: Camera, view: str, half: Pair) -> list[Part]:
    """Grid lines fixed in the world, in the plane of the pivot x (n, 3; e₃ up), with coordinate labels."""
    if view == "axis":  # coordinates in the frame of the run
        across, up, origin, names = geometry.E1, geometry.E2, 0.0, ("x₁ = ", "x₂ = ")
    else:
        across, up, origin, names = camera.right, geometry.E3, x[0], ("travel ", "height ")
    sign = -1 if view == "axis" and run.e3 == "down" else 1
    at = ((x - origin) @ across, (x - origin) @ up)
    # Coarse enough that the grid does not alias and seem to run backwards for half of the movie or more.
    per_frame = max(np.median(np.abs(np.diff(values, prepend=values[0]))) for values in at)
    spacing = next((s for s in GRIDS if s > max(3 * per_frame, 0.45 * min(half))), GRIDS[-1])
    return [
        _ruler(ax, at[0], spacing, 1.0, half, names[0], 1),
        _ruler(ax, at[1], spacing, float(np.dot(camera.up, up)), half[::-1], names[1], sign, upright=True),
    ]


def _ruler(
    ax: Any, at: Any, spacing: float, slant: float, half: Pair, name: str, sign: int, upright: bool = False
) -> Part:
    """Parallel lines every `spacing` m that scroll past a pivot at coordinate `at` (n,), to the right or `upright`.

    The picture extends `half[0]` m from the pivot along the coordinate, which is foreshortened by the factor `slant`,
    and `half[1]` m across. Labels show `name` and the coordinate times `sign`.
    """
    reach, across = half
    low = (0.92 if upright else 1.0) * reach  # keep lines clear of the labels at the bottom
    line = ax.add_line(Line2D([], [], color=LINE, linewidth=1.0, animated=True))
    labels = [lettering(ax, 8, "#5a5a5a", right=upright) for _ in range(int(2 * reach / slant / spacing) + 2)]

    def part(i: int) -> list[Any]:
        first, last = np.ceil((at[i] - low / slant) / spacing), np.floor((at[i] + reach / slant) / spacing)
        ticks = spacing * np.arange(first, last + 1)
        places = slant * (ticks - at[i])
        along = np.repeat(places, 3)
        along[2::3] = np.nan
        data = (along, np.tile([-across, across, np.nan], len(ticks)))
        line.set_data(*(data[::-1] if upright else data))
        shown = [line]
        for label, tick, place in zip(labels, ticks, places, strict=False):
            if place < (0.92 if upright else 0.72) * reach:  # keep labels inside the picture
                at_label = (0.98 * across, place) if upright else (place + 0.015 * reach, -0.985 * across)
                shown.append(label(f"{name}{sign * tick + 0.0:g} m", at_label))
        return shown

    return part


def _trail(ax: Any, points: Any, finer: int, t: Any) -> Part:
    """The last half second of the bob's path, fading: `points` (n, 2) at `t` (n,), `finer` points per frame."""
    first = np.searchsorted(t, t - TRAIL)
    shades = np.linspace(0.15, 1.0, 6)
    colors = [(*to_rgb(BLUE), shade) for shade in shades]
    trail = ax.add_collection(LineCollection([], colors=colors, linewidths=0.8 + 1.2 * shades, animated=True))

    def part(i: int) -> list[Any]:
        last = i * finer
        cuts = np.linspace(max(first[last], last - 600), last, len(shades) + 1).astype(int)
        trail.set_segments([points[a : b + 1] for a, b in itertools.pairwise(cuts)])
        return [trail]

    return part


def _body(ax: Any, shape: Sketch, camera: Camera, vehicle: Vehicle) -> Part:
    """Quadrotor, thrusts, rod and bob of `shape` (n, ...), with the pivot at the centre of `camera`."""
    discs, arms = project(camera, shape.discs), project(camera, shape.arms)
    rods, behind = project(camera, shape.rod), depth(camera, shape.bob) > 0
    radii = sketch.BOB_SHARE * vehicle.rod_length * magnification(camera, shape.bob)
    whole = drawing.outlines(project(camera, shape.thrust), vehicle, drawing.SUM)
    single = project(camera, shape.rotor_thrusts)
    angle = np.linspace(0, 2 * np.pi, 25)
    balls = rods[:, 1, None] + radii[:, None, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    faces = [(*to_rgb(ORANGE if front else REAR), 0.65) for front in shape.front]
    rotors = ax.add_collection(PolyCollection([], facecolors=faces, edgecolors=INK, linewidths=1.0, animated=True))
    frame = ax.add_line(Line2D([], [], color=INK, linewidth=3.0, animated=True))
    thrust = ax.add_patch(Polygon(np.zeros((1, 2)), fill=False, edgecolor=GREEN, linewidth=1.6, animated=True))
    thrusts = ax.add_collection(PolyCollection([], facecolors=GREEN, edgecolors="white", linewidths=0.6, animated=True))
    rod = ax.add_line(Line2D([], [], color=RED, linewidth=4.0, solid_capstyle="round", animated=True))
    bob = ax.add_patch(Polygon(np.zeros((1, 2)), facecolor=RED, edgecolor=INK, linewidth=1.2, animated=True))

    def part(i: int) -> list[Any]:
        rotors.set_verts(list(discs[i]))
        ends = np.concatenate([arms[i], np.full((arms.shape[1], 1, 2), np.nan)], axis=1).reshape(-1, 2)
        frame.set_data(*ends.T)
        thrust.set_xy(whole[i])
        thrusts.set_verts(list(drawing.outlines(single[i], vehicle, drawing.ROTOR)))
        rod.set_data(*rods[i].T)
        bob.set_xy(balls[i])
        body = [rotors, frame, thrusts]
        return [thrust, rod, bob, *body] if behind[i] else [thrust, *body, rod, bob]

    return part


def _readout(ax: Any, t: Any, states: State) -> Part:
    """Time, height above the start and speed of the vehicle, on the left of `ax`."""
    rise, pace = np.round(states.x[:, 2] - states.x[0, 2], 1) + 0.0, geometry.norm(states.x_dot)
    digits = 2 if t[-1] >= 1 else 4
    clock, below = lettering(ax, 13, INK), lettering(ax, 9, INK)

    def part(i: int) -> list[Any]:
        words = f"height {rise[i]:+.1f} m, speed {pace[i]:.1f} m/s"
        return [clock(f"{t[i]:.{digits}f} s", (0.12, 0.66)), below(words, (0.12, 0.38))]

    return part


def _cursor(ax: Any, t: Any) -> Part:
    line = ax.add_line(Line2D([], [], color=INK, linewidth=1.5, animated=True))

    def part(i: int) -> list[Any]:
        line.set_data([t[i], t[i]], [-1.15, 1.15])
        return [line]

    return part


# Text that changes between frames -------------------------------------------------------------------------------------


def lettering(ax: Any, fontsize: float, color: str, *, right: bool = False) -> Callable[[str, Any], Any]:
    """Create changeable text: returns `place(words, at)`, which sets its string and position in `ax` and returns it.

    The text starts at `at`, or ends there if `right`. It is drawn from cached glyph outlines: laying out a string
    again, as matplotlib's `Text` does, takes longer than the rest of a frame.
    """
    patch = ax.add_patch(PathPatch(Path([[0.0, 0.0]]), facecolor=color, edgecolor="none", animated=True))
    patch.set_transform(IdentityTransform())
    patch.set_clip_on(False)
    scale = fontsize * ax.figure.dpi / 72

    def place(words: str, at: Any) -> Any:
        vertices, codes, width = outline(words.replace("-", "−"))
        corner = ax.transData.transform(at) - (scale * width if right else 0.0, -0.2 * scale)
        patch.set_path(Path(scale * vertices + corner, codes))
        return patch

    return place


@lru_cache(maxsize=4096)
def outline(words: str) -> tuple[Any, Any, float]:
    """Vertices (n, 2), path codes (n,) and width of the string `words` at font size 1."""
    vertices, codes, x = [np.zeros((0, 2))], [np.zeros(0, dtype=Path.code_type)], 0.0
    for character in words:
        outline, advance = glyph(character)
        if outline is not None:
            vertices.append(np.add(outline.vertices, (x, 0.0)))
            codes.append(outline.codes)
        x += advance
    return np.concatenate(vertices), np.concatenate(codes), x


@cache
def glyph(character: str) -> tuple[Any, float]:
    """Outline of `character` at font size 1 (None for a space), and its advance width."""
    bar, pair = (TextPath((0, 0), words, size=1) for words in ("|", character + "|"))
    outline = None if character.isspace() else TextPath((0, 0), character, size=1)
    return outline, float(pair.vertices[:, 0].max() - bar.vertices[:, 0].max())
