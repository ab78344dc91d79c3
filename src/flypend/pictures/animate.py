"""Slow-motion movies of a run as .mp4 or .gif; `flypend.pictures.frames` draws the frames."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from flypend import errors, signals
from flypend.files.whole import whole_file
from flypend.flight.trajectory import Trajectory
from flypend.pictures.frames import Frame, stage
from flypend.signals import polling

Progress = Callable[[int, int], None]

MAX_FRAMES = 100_000
LARGEST = 4096  # pixels: what H.264 encodes on any machine
HOLD = 1.5  # s of playback for which the last frame is held, with the verdict


@signals.defer()
def movie(
    run: Trajectory,
    path: str | Path,
    *,
    view: str = "side",
    speed: float = 0.25,
    fps: float = 30,
    size: tuple[int, int] = (640, 640),
    progress: Progress | None = None,
) -> None:
    """Write a movie of `run` atomically.

    Parameters
    ----------
    run : Trajectory
        In either frame. The last frame is held for 1.5 s with the verdict of the studies.
    path : str or Path
        Path ending in .mp4 (H.264, yuv420p) or .gif.
    view : "side" or "axis"
        Camera; see `flypend.pictures.drawing.camera_for`.
    speed : float
        Flight time over playback time, > 0; 0.25 is slow motion.
    fps : float
        Frames per second of playback, > 0; at most 50 for a .gif.
    size : (2,) int
        Width and height in pixels, even and at least 160.
    progress : callable, optional
        Called as `progress(done, total)` after each frame.

    Raises
    ------
    InputError
        If the view or suffix is unknown, a number is out of range, or the file is not writable.
    """
    path, gif = Path(path), Path(path).suffix.lower() == ".gif"
    check_encoder(path)
    times = frame_times(run, speed=speed, fps=fps)
    if gif and fps > 50:
        raise errors.InputError("fps", "at most 50 for a .gif", f"{fps:g}")
    shape = errors.array("size", size, (2,))
    if np.any(shape < 160) or np.any(shape > LARGEST) or np.any(shape % 2):
        raise errors.InputError("size", f"two even numbers of pixels, 160 to {LARGEST}", size)
    width, height = (int(side) for side in shape)
    hold = round(HOLD * fps)
    with whole_file(path, (".mp4", ".gif")) as partial:
        frames = _frames(stage(run, times, view, speed, (width, height)), len(times), hold, progress)
        if gif:
            _write_gif(partial, frames, (width, height), fps, len(times) + hold)
        else:
            _write_mp4(partial, frames, (width, height), fps, len(times) + hold)


def check_encoder(path: str | Path = "movie.mp4") -> None:
    """Raise InputError if `path` needs a video encoder that is not installed; a .gif needs none."""
    if Path(path).suffix.lower() != ".gif":
        errors.require("imageio_ffmpeg", extra="movies", for_="movie")


def frame_times(run: Trajectory, *, speed: float, fps: float) -> Any:
    """Times (n,) of the frames of `run`, s, at playback `speed` and `fps` frames per second; the last is its end.

    Raises InputError if a number is not positive, or there are more than 100,000 frames.
    """
    step = errors.number("speed", speed, above=0) / errors.number("fps", fps, above=0, unit="1/s")
    start, end = float(run.t[0]), float(run.t[-1])
    count = (end - start) / step
    if count > MAX_FRAMES:
        raise errors.InputError("speed", f"at most {MAX_FRAMES} frames", f"{count:.4g} of {step:.3g} s each")
    # The tolerance absorbs roundoff: 6.5 s / 0.25 × 30 is exactly 780 frames.
    return np.minimum(start + step * np.arange(int(np.ceil(count - 1e-6)) + 1), end)


def _frames(render: Callable[[int, bool], Frame], count: int, hold: int, progress: Progress | None) -> Iterator[Frame]:
    """Yield all frames: `count` of the flight, then the last one `hold` times with the verdict written on it."""
    for i in range(count + hold):
        signals.poll()
        if i <= count:
            frame = render(min(i, count - 1), i >= count)
        yield frame
        if progress is not None:
            progress(i + 1, count + hold)


def _write_mp4(path: Path, frames: Iterator[Frame], size: tuple[int, int], fps: float, count: int) -> None:
    """Write `count` frames of `size` (pixels) at `fps` (1/s) as H.264."""
    import imageio_ffmpeg

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
    # Only ffmpeg notices a full disk; it then leaves a truncated file, or one without an index.
    if (written := _frames_in(path)) != count:
        raise OSError(f"{written} of {count} frames from ffmpeg")


def _frames_in(path: Path) -> int:
    """Count the frames of the movie at `path` without decoding; 0 if it is not a movie."""
    import imageio_ffmpeg

    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-v", "quiet", "-i", str(path), "-c", "copy"]
    command += ["-progress", "-", "-f", "null", "-"]
    report = polling.run(command, stdin=subprocess.DEVNULL)
    counts = re.findall(rb"^frame=\s*(\d+)", report.stdout, flags=re.MULTILINE)
    return int(counts[-1]) if counts and report.returncode == 0 else 0


def _send(encoder: Any, frame: Frame | None) -> None:
    try:
        encoder.send(frame)
    except (OSError, RuntimeError) as error:  # only the first line: the rest is the whole command
        raise OSError(f"ffmpeg failed ({str(error).splitlines()[0]})") from None


def _write_gif(path: Path, frames: Iterator[Frame], size: tuple[int, int], fps: float, count: int) -> None:
    """Write `count` frames of `size` (pixels) at `fps` (1/s) as a GIF."""

    def image(frame: Frame) -> Any:
        return Image.frombuffer("RGBA", size, bytes(frame), "raw", "RGBA", 0, 1).convert("RGB")

    first = image(next(frames)).quantize(128, dither=Image.Dither.NONE)
    rest = (image(frame).quantize(palette=first, dither=Image.Dither.NONE) for frame in frames)
    # GIF frame durations are in units of 10 ms: mix 3 and 4 to average 30 frames per second.
    ends = np.round(100 / fps * np.arange(count + 1)).astype(int)
    durations = (10 * np.diff(ends)).tolist()
    with path.open("wb") as file:
        first.save(file, format="GIF", save_all=True, append_images=rest, duration=durations, loop=0)
