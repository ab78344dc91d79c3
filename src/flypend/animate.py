"""Slow-motion movies of a run: the camera follows the pivot, a grid scrolls past, y₃ and z₃ run along below.

Everything that does not move is drawn once; a frame restores that background and draws a dozen artists over it.
"""

from __future__ import annotations

import itertools
import re
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path as FilePath
from typing import Any

import imageio_ffmpeg
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
from PIL import Image

from flypend import drawing, errors, geometry
from flypend.drawing import BLUE, GREEN, INK, ORANGE, REAR, RED, Camera, Sketch
from flypend.figures import whole_file
from flypend.model import State
from flypend.trajectory import Trajectory

Progress = Callable[[int, int], None]
Frame = Any  # memoryview of (height, width, 4) bytes, valid until the next frame is drawn
Part = Callable[[int], list[Any]]  # sets artists to a frame and returns them in the order of drawing

MAX_FRAMES = 100_000
HOLD = 1.5  # s of playback for which the last instant of a run that did not complete stays, with the reason
TRAIL = 0.5  # s of flight that the path of the bob goes back
ZOOM = 1.3  # half the shorter side of the scene over the reach of the drawing
GRIDS = (0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)  # spacings, m
# Left, bottom, width and height in the picture; what does not move is written above the scene, where no line runs.
SCENE, STRIP, HEAD = (0.0, 0.215, 1.0, 0.665), (0.085, 0.07, 0.885, 0.115), (0.0, 0.88, 1.0, 0.12)
LINE = "#d4d4d4"


def movie(
    run: Trajectory,
    path: str | FilePath,
    *,
    view: str = "side",
    speed: float = 0.25,
    fps: float = 30,
    size: tuple[int, int] = (640, 640),
    progress: Progress | None = None,
) -> None:
    """Write a movie of `run`, whole or not at all.

    Parameters
    ----------
    run : Trajectory
        In either frame. One that ends early is shown to its end, which stays for 1.5 s with the outcome.
    path : str or Path
        Ends in .mp4 (H.264, yuv420p) or .gif.
    view : "side" or "axis"
        Camera, see `flypend.drawing.camera_for`.
    speed : float
        Time of the flight over time of playback, > 0; 0.25 is slow motion.
    fps : float
        Frames per second of playback, > 0, at most 50 for a .gif.
    size : (2,) int
        Width and height in pixels, even and at least 160.
    progress : callable, optional
        Called as `progress(done, total)` after each frame.

    Raises
    ------
    InputError
        For an unknown view or suffix, numbers out of range, and a file that cannot be written.
    """
    path, gif = FilePath(path), FilePath(path).suffix.lower() == ".gif"
    times = frame_times(run, speed=speed, fps=fps)
    if gif and fps > 50:
        raise errors.InputError("fps", "at most 50 for a .gif", f"{fps:g}")
    shape = errors.array("size", size, (2,))
    if shape.shape != (2,) or np.any(shape < 160) or np.any(shape % 2):
        raise errors.InputError("size", "two even numbers of pixels, at least 160", size)
    width, height = (int(side) for side in shape)
    hold = 0 if run.outcome.status == "completed" else round(HOLD * fps)
    with whole_file(path, (".mp4", ".gif")) as partial:
        frames = _frames(_stage(run, times, view, speed, (width, height)), len(times), hold, progress)
        if gif:
            _write_gif(partial, frames, (width, height), fps, len(times) + hold)
        else:
            _write_mp4(partial, frames, (width, height), fps, len(times) + hold)


def frame_times(run: Trajectory, *, speed: float, fps: float) -> Any:
    """Instants (n,) of `run` (s) at playback `speed` and `fps` frames per second; the last is the end of the run.

    Raises InputError for numbers that are not positive, or more than 100,000 frames.
    """
    step = errors.number("speed", speed, above=0) / errors.number("fps", fps, above=0, unit="1/s")
    start, end = float(run.t[0]), float(run.t[-1])
    count = (end - start) / step
    if count > MAX_FRAMES:
        raise errors.InputError("speed", f"at most {MAX_FRAMES} frames", f"{count:.4g} of {step:.3g} s each")
    # The tolerance is there for 6.5 s / 0.25 × 30, which is 780 frames and no sliver of a frame more.
    return np.minimum(start + step * np.arange(int(np.ceil(count - 1e-6)) + 1), end)


def _frames(render: Callable[[int, bool], Frame], count: int, hold: int, progress: Progress | None) -> Iterator[Frame]:
    """All frames: `count` of the flight, the last one again `hold` times with the outcome written on it."""
    for i in range(count + hold):
        if i <= count:
            frame = render(min(i, count - 1), i >= count)
        yield frame
        if progress is not None:
            progress(i + 1, count + hold)


def _write_mp4(path: FilePath, frames: Iterator[Frame], size: tuple[int, int], fps: float, count: int) -> None:
    options = ["-preset", "veryfast", "-crf", "20", "-movflags", "+faststart"]
    encoder = imageio_ffmpeg.write_frames(
        path, size, pix_fmt_in="rgba", fps=fps, quality=None, codec="libx264", macro_block_size=2,
        ffmpeg_log_level="error", output_params=options,
    )  # fmt: skip
    try:
        _send(encoder, None)
        for frame in frames:
            _send(encoder, frame)
    finally:
        encoder.close()
    # A full disk is noticed by ffmpeg only; it then leaves a file that ends early or has no index.
    if (written := _frames_in(path)) != count:
        raise OSError(f"{written} of {count} frames from ffmpeg")


def _frames_in(path: FilePath) -> int:
    """Number of frames in the movie at `path`, read but not decoded; 0 for a file that is none."""
    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-v", "quiet", "-i", str(path), "-c", "copy"]
    command += ["-progress", "-", "-f", "null", "-"]
    report = subprocess.run(command, capture_output=True, stdin=subprocess.DEVNULL, check=False)  # noqa: S603
    counts = re.findall(rb"^frame=\s*(\d+)", report.stdout, flags=re.MULTILINE)
    return int(counts[-1]) if counts and report.returncode == 0 else 0


def _send(encoder: Any, frame: Frame | None) -> None:
    try:
        encoder.send(frame)
    except (OSError, RuntimeError) as error:  # of many lines, with the whole command
        raise OSError(f"ffmpeg failed ({str(error).splitlines()[0]})") from None


def _write_gif(path: FilePath, frames: Iterator[Frame], size: tuple[int, int], fps: float, count: int) -> None:
    def image(frame: Frame) -> Any:
        return Image.frombuffer("RGBA", size, bytes(frame), "raw", "RGBA", 0, 1).convert("RGB")

    first = image(next(frames)).quantize(128, dither=Image.Dither.NONE)
    rest = (image(frame).quantize(palette=first, dither=Image.Dither.NONE) for frame in frames)
    # A GIF counts hundredths of a second: frames last 3 or 4 of them so that 30 per second come out on average.
    ends = np.round(100 / fps * np.arange(count + 1)).astype(int)
    durations = (10 * np.diff(ends)).tolist()
    with path.open("wb") as file:
        first.save(file, format="GIF", save_all=True, append_images=rest, duration=durations, loop=0)


def _stage(run: Trajectory, times: Any, view: str, speed: float, size: tuple[int, int]) -> Callable[[int, bool], Frame]:
    """Set up the picture of `size` pixels; returns `render(i, ended)`, which draws the instant `times[i]`."""
    rod = run.vehicle.rod_length
    camera = drawing.camera_for(run, view, distance=drawing.EYE * drawing.reach(run.vehicle))
    states = drawing.states_at(run, times)
    shape = drawing.sketch(replace(states, x=np.zeros(3)), run.vehicle, drawing.thrust_at(run, times))
    # Between frames a fast rod goes further than a line can follow: `finer` points of its path for each frame.
    turn = geometry.norm(states.y_dot).max() * np.diff(times).max(initial=0.0)
    finer = int(np.clip(np.ceil(turn / 0.15), 1, 24))
    fine = np.interp(np.arange((len(times) - 1) * finer + 1) / finer, np.arange(len(times)), times)
    path = drawing.states_at(run, fine)

    dpi = 100 * min(size) / 640  # a hundredth of a pixel more, so that no side is rounded down
    figure = Figure(figsize=((size[0] + 0.01) / dpi, (size[1] + 0.01) / dpi), dpi=dpi, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    head, scene, strip = (figure.add_axes(place) for place in (HEAD, SCENE, STRIP))
    half = _scene(scene, run, size)
    _head(head, view, speed, size)
    _strip(strip, run, fine, path)
    parts = [
        *_grids(scene, run, states.x, camera, view, half),
        _trail(scene, drawing.project(camera, rod * path.y), finer, fine),
        _body(scene, shape, camera, rod),
        _readout(head, times, states),
        _cursor(strip, times),
    ]
    words = f"{run.outcome.status} at {run.outcome.time:.4g} s"
    box = {"facecolor": "white", "edgecolor": "none", "pad": 2.0}
    ending = scene.text(0, 0.85 * half[1], words, color=RED, fontsize=14, ha="center", bbox=box, animated=True)
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


def _scene(ax: Any, run: Trajectory, size: tuple[int, int]) -> tuple[float, float]:
    """Prepare the middle of the picture, around the pivot; returns half its width and height in metres."""
    pixels = (size[0] * SCENE[2], size[1] * SCENE[3])
    scale = ZOOM * drawing.reach(run.vehicle) / min(pixels)
    half = (pixels[0] * scale, pixels[1] * scale)
    ax.set(xlim=(-half[0], half[0]), ylim=(-half[1], half[1]), xticks=[], yticks=[])
    ax.spines[:].set_color(LINE)
    return half


def _head(ax: Any, view: str, speed: float, size: tuple[int, int]) -> None:
    """Prepare the upper end of the picture, with units of its height: how slow, which way is down, what is what."""
    width = size[0] * HEAD[2] / (size[1] * HEAD[3])
    ax.set(xlim=(0, width), ylim=(0, 1))
    ax.set_axis_off()
    ax.text(0.12, 0.1, f"{speed:g} × real time", fontsize=8, color="#5a5a5a")
    drawing.gravity_symbol(ax, view, (0.64 * width, 0.5), 0.3, fontsize=12)
    handles = [
        Line2D([], [], color=GREEN, linewidth=2.5, label="thrust"),
        Line2D([], [], color=BLUE, linewidth=1.8, label=f"bob, last {TRAIL:g} s"),
        Line2D([], [], color=ORANGE, linewidth=0, marker="o", markeredgecolor=INK, label="front rotor"),
    ]
    ax.legend(handles=handles, loc="center right", fontsize=9, frameon=False, handlelength=1.3, labelspacing=0.3)


def _strip(ax: Any, run: Trajectory, t: Any, states: State) -> None:
    """y₃ and z₃ over time in the frame of the run, from `states` (e₃ up) at times `t`."""
    sign, pole = (1, "inverted") if run.e3 == "up" else (-1, "hanging")
    ax.plot(t, sign * states.y[:, 2], color=RED, linewidth=1.6, label=f"$y_3$ (1: {pole})")
    # Turning the world and the body frame over leaves z₃ = R₃₃ what it is.
    ax.plot(t, states.z[:, 2], color=BLUE, linewidth=1.3, linestyle="--", label="$z_3$ (1: upright)")
    ax.set(xlim=(run.t[0], max(run.t[-1], run.t[0] + 1e-3)), ylim=(-1.15, 1.15), yticks=[-1, 0, 1])
    ax.tick_params(labelsize=8, length=2.5)
    ax.grid(visible=True, color="#e3e3e3", linewidth=0.6)
    ax.set_xlabel("time (s)", fontsize=8, labelpad=1)
    at = {"loc": "lower left", "bbox_to_anchor": (0.0, 0.97), "borderaxespad": 0.1}
    ax.legend(fontsize=9, ncols=2, frameon=False, handlelength=1.8, columnspacing=1.2, **at)
    ax.text(1.0, 1.08, f"{run.law} law", transform=ax.transAxes, ha="right", fontsize=9)


def _grids(ax: Any, run: Trajectory, x: Any, camera: Camera, view: str, half: tuple[float, float]) -> list[Part]:
    """Lines that stand still in the world, in the plane of the pivot x (n, 3; e₃ up), with their coordinates."""
    if view == "axis":  # coordinates as in the frame of the run
        across, up, origin, names = geometry.E1, geometry.E2, 0.0, ("x₁ = ", "x₂ = ")
    else:
        across, up, origin, names = camera.right, geometry.E3, x[0], ("travel ", "height ")
    sign = -1 if view == "axis" and run.e3 == "down" else 1
    at = ((x - origin) @ across, (x - origin) @ up)
    # Coarse enough not to run backwards for half of the movie or more, like the wheels of a coach.
    per_frame = max(np.median(np.abs(np.diff(values, prepend=values[0]))) for values in at)
    spacing = next((s for s in GRIDS if s > max(3 * per_frame, 0.45 * min(half))), GRIDS[-1])
    return [
        _ruler(ax, at[0], spacing, 1.0, half, names[0], 1),
        _ruler(ax, at[1], spacing, float(np.dot(camera.up, up)), half[::-1], names[1], sign, upright=True),
    ]


def _ruler(
    ax: Any,
    at: Any,
    spacing: float,
    slant: float,
    half: tuple[float, float],
    name: str,
    sign: int,
    upright: bool = False,
) -> Part:
    """Parallel lines every `spacing` metres past a pivot at the coordinate `at` (n,), to the right or `upright`.

    The picture reaches `half[0]` metres from the pivot along the coordinate, drawn shorter by `slant`, and `half[1]`
    across. A label is the `name` and the coordinate times `sign`.
    """
    reach, across = half
    low = (0.92 if upright else 1.0) * reach  # no line runs through the labels at the bottom
    line = ax.add_line(Line2D([], [], color=LINE, linewidth=1.0, animated=True))
    labels = [_words(ax, 8, "#5a5a5a", right=upright) for _ in range(int(2 * reach / slant / spacing) + 2)]

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
            if place < (0.92 if upright else 0.72) * reach:  # no label runs over an edge
                at_label = (0.98 * across, place) if upright else (place + 0.015 * reach, -0.985 * across)
                shown.append(label(f"{name}{sign * tick + 0.0:g} m", at_label))
        return shown

    return part


def _trail(ax: Any, points: Any, finer: int, t: Any) -> Part:
    """The last half second of the path of the bob, `points` (n, 2) at `t` (n,), `finer` to a frame, paler backwards."""
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


def _body(ax: Any, shape: Sketch, camera: Camera, rod_length: float) -> Part:
    """Quadrotor, thrust, rod and bob of `shape` (n, ...), whose pivot is where `camera` looks."""
    discs, arms = drawing.project(camera, shape.discs), drawing.project(camera, shape.arms)
    rods, behind = drawing.project(camera, shape.rod), drawing.depth(camera, shape.bob) > 0
    radii = drawing.BOB_SHARE * rod_length * drawing.magnification(camera, shape.bob)
    arrows = _arrows(drawing.project(camera, shape.thrust), 0.06 * rod_length)
    angle = np.linspace(0, 2 * np.pi, 25)
    balls = rods[:, 1, None] + radii[:, None, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    faces = [(*to_rgb(ORANGE if front else REAR), 0.65) for front in shape.front]
    rotors = ax.add_collection(PolyCollection([], facecolors=faces, edgecolors=INK, linewidths=1.0, animated=True))
    frame = ax.add_line(Line2D([], [], color=INK, linewidth=3.0, animated=True))
    thrust = ax.add_patch(Polygon(np.zeros((1, 2)), facecolor=GREEN, edgecolor="none", animated=True))
    rod = ax.add_line(Line2D([], [], color=RED, linewidth=4.0, solid_capstyle="round", animated=True))
    bob = ax.add_patch(Polygon(np.zeros((1, 2)), facecolor=RED, edgecolor=INK, linewidth=1.2, animated=True))

    def part(i: int) -> list[Any]:
        rotors.set_verts(list(discs[i]))
        ends = np.concatenate([arms[i], np.full((arms.shape[1], 1, 2), np.nan)], axis=1).reshape(-1, 2)
        frame.set_data(*ends.T)
        thrust.set_xy(arrows[i])
        rod.set_data(*rods[i].T)
        bob.set_xy(balls[i])
        return [rod, bob, rotors, frame, thrust] if behind[i] else [rotors, frame, rod, bob, thrust]

    return part


def _arrows(segments: Any, width: float) -> Any:
    """Outlines (n, 7, 2) of arrows of the given `width` along `segments` (n, 2, 2); heads shrink with short arrows."""
    along = segments[:, 1] - segments[:, 0]
    length = np.linalg.norm(along, axis=1)[:, None]
    along = along / np.maximum(length, 1e-9)
    side = np.stack([-along[:, 1], along[:, 0]], axis=1)
    head = np.minimum(2.5 * width, length)
    neck, tip = segments[:, 1] - head * along, segments[:, 1]
    shaft, barb = 0.22 * width * side, 0.36 * head * side
    tail = segments[:, 0]
    return np.stack([tail + shaft, neck + shaft, neck + barb, tip, neck - barb, neck - shaft, tail - shaft], axis=1)


def _readout(ax: Any, t: Any, states: State) -> Part:
    """Time, height above the start and speed of the vehicle, at the left of `ax`."""
    rise, pace = np.round(states.x[:, 2] - states.x[0, 2], 1) + 0.0, geometry.norm(states.x_dot)
    digits = 2 if t[-1] >= 1 else 4
    clock, below = _words(ax, 13, INK), _words(ax, 9, INK)

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


def _words(ax: Any, fontsize: float, color: str, *, right: bool = False) -> Callable[[str, Any], Any]:
    """A text that changes: returns `place(words, at)`, an artist with words that start, or end, at a point of `ax`.

    It is drawn as outlines of characters kept from one frame to the next: laying out a string anew, as matplotlib's
    `Text` does, takes longer than drawing all the rest of a frame.
    """
    patch = ax.add_patch(PathPatch(Path([[0.0, 0.0]]), facecolor=color, edgecolor="none", animated=True))
    patch.set_transform(IdentityTransform())
    patch.set_clip_on(False)
    scale = fontsize * ax.figure.dpi / 72

    def place(words: str, at: Any) -> Any:
        vertices, codes, width = _outline(words.replace("-", "−"))
        corner = ax.transData.transform(at) - (scale * width if right else 0.0, -0.2 * scale)
        patch.set_path(Path(scale * vertices + corner, codes))
        return patch

    return place


@lru_cache(maxsize=4096)
def _outline(words: str) -> tuple[Any, Any, float]:
    """Vertices (n, 2), codes (n,) and width of `words` in a font of size 1."""
    vertices, codes, x = [np.zeros((0, 2))], [np.zeros(0, dtype=Path.code_type)], 0.0
    for character in words:
        outline, advance = _glyph(character)
        if outline is not None:
            vertices.append(np.add(outline.vertices, (x, 0.0)))
            codes.append(outline.codes)
        x += advance
    return np.concatenate(vertices), np.concatenate(codes), x


@cache
def _glyph(character: str) -> tuple[Any, float]:
    """Outline of `character` in a font of size 1 (None for a space), and how far the next one stands from it."""
    bar, pair = (TextPath((0, 0), words, size=1) for words in ("|", character + "|"))
    outline = None if character.isspace() else TextPath((0, 0), character, size=1)
    return outline, float(pair.vertices[:, 0].max() - bar.vertices[:, 0].max())
