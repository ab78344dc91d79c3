"""Movies: they decode to what was asked for, show gravity down, end sensibly, and leave nothing half-written."""

import dataclasses
import warnings

import imageio_ffmpeg
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.textpath import TextPath
from PIL import Image

import flypend as fp
from flypend import palette
from flypend.flight.verdict import verdict
from flypend.pages import sketch
from flypend.pages.sketch import project
from flypend.paper import experiment
from flypend.pictures import animate, drawing, frames

ARRAYS = ("t", "x", "x_dot", "R", "omega", "y", "y_dot", "thrust", "moment", "rotor_forces", "x_ref")
SMALL = {"size": (192, 160), "speed": 1.0, "fps": 20.0}
RED, GREEN = (213, 94, 0), (0, 158, 115)  # of rod and bob, and of the thrust
ALARM = tuple(int(palette.ALARM[i : i + 2], 16) for i in (1, 3, 5))  # of a verdict


@pytest.fixture(scope="module")
def run():
    case = experiment("4")
    return fp.simulate(case.vehicle, case.law(), case.start, case.duration, plant="ideal")


@pytest.fixture(scope="module")
def short(run):
    return fp.simulate(run.vehicle, experiment("4").law(), experiment("4").start, 0.6, plant="ideal")


@pytest.fixture(scope="module")
def singular():
    """The printed law in experiment 4, which ends after 0.014 s."""
    case = experiment("4")
    return fp.simulate(case.vehicle, case.law("printed"), case.start, case.duration, plant="ideal")


def decode(path):
    """Frames (n, height, width, 3), what ffmpeg says about the file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)  # read_frames leaves the pipes of an ended ffmpeg open
        reader = imageio_ffmpeg.read_frames(path)
        about = next(reader)
        width, height = about["size"]
        frames = np.stack([np.frombuffer(frame, np.uint8).reshape(height, width, 3) for frame in reader])
        del reader
    return frames, about


def pictures(run, times, view="side", size=(640, 640)):
    """Frames (n, height, width, 3) as drawn, before any encoder."""
    render = frames.stage(run, np.asarray(times), view, 0.25, size)
    return np.stack([np.array(render(i, False))[..., :3] for i in range(len(times))])


def middle_of(picture, color, tolerance=30):
    """Column and row of the middle of all pixels of a colour in the scene, relative to where the pivot is drawn."""
    height, width = picture.shape[:2]
    top, bottom = (round(height * (1 - share)) for share in (0.88, 0.215))
    rows, columns = np.nonzero(np.abs(picture[top:bottom].astype(int) - color).max(axis=-1) < tolerance)
    assert len(rows) > 50
    return columns.mean() - width / 2, rows.mean() - (bottom - top) / 2


# What is in the picture -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("turn", [False, True])
def test_a_hanging_rod_is_below_the_pivot_and_an_inverted_one_above(run, turn):
    shown = run.flipped() if turn else run
    start, end = pictures(shown, [0.0, 6.5])  # from inverted to hanging
    assert middle_of(start, RED)[1] < -50
    column, row = middle_of(end, RED)
    assert row > 50
    assert abs(column) < 5
    assert middle_of(end, GREEN)[1] < -20  # the thrust that carries points up


def test_seen_along_gravity_the_rod_shrinks_to_the_middle(run):
    sideways, end = pictures(run, [0.54, 6.5], "axis")
    assert np.hypot(*middle_of(sideways, RED)) > 50
    assert np.hypot(*middle_of(end, RED)) < 5


def test_both_frames_give_the_same_movie(run):
    times = run.t[[0, 30, 60, 90, 300]]
    # Both from the samples: the flipped run has no dense output.
    sampled = dataclasses.replace(run, interpolant=None)
    one, other = pictures(sampled, times), pictures(run.flipped(), times)
    scene = slice(0, round(640 * (1 - 0.215)))  # below it the legend names the poles of y₃: hanging or inverted
    difference = np.abs(one.astype(int) - other)
    assert difference[:, scene].max() <= 12  # of 255: rounding at the edges of lines, a pixel or two
    assert difference[:, scene.stop :].max() > 100


def test_the_grid_moves_against_the_vehicle():
    """A vehicle that rises 0.1 m between frames: lines and labels go down by as much."""
    t = np.array([0.0, 0.1])
    case = experiment("4")
    resting = fp.simulate(case.vehicle, case.law(), case.start, 0.1, times=t, plant="ideal")
    still = {name: np.repeat(getattr(resting, name)[:1], 2, axis=0) for name in ARRAYS}
    still |= {"t": t, "R": np.tile(np.diag([1.0, -1, -1]) @ np.diag([1.0, -1, -1]), (2, 1, 1))}
    still["x"] = np.array([[0, 0, 0], [0, 0, -0.1]])  # e₃ down
    rising = dataclasses.replace(resting, **still, interpolant=None)
    rows = []
    for picture in pictures(rising, t):
        left = picture[80:500, 2:20].astype(int)  # beside the drawing, short of the first upright line
        rows.append(np.nonzero(np.all(np.abs(left - 212) < 25, axis=(1, 2)))[0])
    metre = 640 * 0.665 / (2 * frames.ZOOM * sketch.reach(rising.vehicle))
    moved = rows[1].mean() - rows[0].mean() if len(rows[0]) == len(rows[1]) else np.nan
    assert moved == pytest.approx(0.1 * metre * np.cos(drawing.ELEVATION), abs=1.0)


def test_the_cursor_runs_with_time(run):
    columns = []
    for picture in pictures(run, [1.0, 2.0, 4.0]):
        strip = picture[round(640 * (1 - 0.185)) + 3 : round(640 * (1 - 0.07)) - 3, 60:615]
        columns.append(np.mean(np.nonzero(np.all(strip < 60, axis=(0, 2)))[0]))
    second = 640 * 0.885 / 6.5
    np.testing.assert_allclose(np.diff(columns), [second, 2 * second], atol=1.0)


def test_the_rod_of_a_frame_goes_from_pivot_to_bob(run):
    times = np.array([0.0, 1.0, 3.0])
    camera = drawing.camera_for(run, "side")
    shape = drawing.sketch_at(run, times, drawing.states_at(run, times))
    part = frames._body(Figure().add_subplot(), shape, camera, run.vehicle)
    for i in range(3):
        (rod,) = (one for one in part(i) if isinstance(one, Line2D) and one.get_color() == palette.RED)
        np.testing.assert_array_equal(rod.get_xydata(), project(camera, shape.rod)[i])


def test_frames_do_not_depend_on_those_before(run):
    times = run.t[::100]
    render = frames.stage(run, times, "side", 0.25, (320, 320))
    forwards = [np.array(render(i, False)) for i in range(len(times))]
    for i in reversed(range(len(times))):
        np.testing.assert_array_equal(np.array(render(i, False)), forwards[i])


@pytest.mark.parametrize("words", ["height −12.3 m, speed 4.5 m/s", "0.25 s"])
def test_words_are_laid_out_as_matplotlib_does(words):
    vertices, codes, width = frames.outline(words)
    whole = TextPath((0, 0), words, size=1)
    np.testing.assert_array_equal(codes, whole.codes)
    np.testing.assert_allclose(vertices, whole.vertices, atol=0.02)  # font units; kerning is left out
    assert width == pytest.approx(whole.vertices[:, 0].max(), abs=0.1)


# Time -----------------------------------------------------------------------------------------------------------


def test_frame_times(run):
    times = animate.frame_times(run, speed=0.25, fps=30)
    assert len(times) == 781  # 6.5 s in 26 s of playback, and the first frame
    np.testing.assert_allclose(np.diff(times), 0.25 / 30)
    assert (times[0], times[-1]) == (0, 6.5)
    uneven = animate.frame_times(run, speed=1.0, fps=0.4)
    np.testing.assert_allclose(uneven, [0, 2.5, 5.0, 6.5])


# Files ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("view", drawing.VIEWS)
def test_a_movie_has_the_frames_size_and_format_asked_for(short, tmp_path, view):
    seen = []
    path = tmp_path / "a.mp4"
    animate.movie(short, path, view=view, progress=lambda done, total: seen.append((done, total)), **SMALL)
    frames, about = decode(path)
    assert frames.shape == (43, 160, 192, 3)
    assert (about["codec"], about["fps"]) == ("h264", 20.0)
    assert about["pix_fmt"].startswith("yuv420p")
    assert seen == [(i + 1, 43) for i in range(43)]
    assert list(tmp_path.iterdir()) == [path]
    drawn = pictures(short, animate.frame_times(short, speed=1.0, fps=20.0), view, (192, 160))
    assert np.abs(frames[:13].astype(int) - drawn).mean() < 4  # of 255: the encoder's loss


def test_a_movie_of_a_loaded_run(short, tmp_path):
    short.save(tmp_path / "run.nc")
    animate.movie(fp.load(tmp_path / "run.nc"), tmp_path / "a.mp4", **SMALL)
    assert len(decode(tmp_path / "a.mp4")[0]) == 43  # and one and a half seconds with the verdict


def test_a_gif_has_the_frames_and_the_duration_asked_for(short, tmp_path):
    path = tmp_path / "a.GIF"
    animate.movie(short, path, size=(192, 160), speed=0.5, fps=30)
    with Image.open(path) as gif:
        assert (gif.n_frames, gif.size) == (38, (192, 160))
        lasts = []
        for i in range(gif.n_frames):
            gif.seek(i)
            lasts.append(gif.info["duration"])
        gif.seek(36)
        last = np.array(gif.convert("RGB")).astype(int)
    assert sum(lasts) == 1230 + 1500  # ms: 37 frames at 30 per second, and the last one held
    drawn = pictures(short, animate.frame_times(short, speed=0.5, fps=30), size=(192, 160))[-1]
    assert np.abs(last - drawn).mean() < 4


def test_the_last_frame_stays_with_the_verdict(short, tmp_path):
    """In red for a flight that has not stood for a second; the frame before it has no words there."""
    animate.movie(short, tmp_path / "a.mp4")
    frames, _ = decode(tmp_path / "a.mp4")
    flown, last = frames[-46], frames[-1]
    assert not verdict(short)["good"]
    around = np.s_[85:500, 120:520]
    red = [np.sum(np.abs(picture[around].astype(int) - ALARM).max(axis=-1) < 60) for picture in (flown, last)]
    assert red[1] > red[0] + 300  # a line of words; the rod is red, too
    np.testing.assert_array_equal(frames[-2], last)


@pytest.mark.parametrize("suffix", [".mp4", ".gif"])
def test_a_run_that_ended_early_stays_with_its_outcome(singular, tmp_path, suffix):
    assert singular.outcome.time < 0.015
    path = tmp_path / f"a{suffix}"
    total = []
    animate.movie(singular, path, progress=lambda done, of: total.append((done, of)))
    assert total[-1] == (3 + 45, 3 + 45)  # 0.014 s are three frames, then one and a half seconds
    if suffix == ".gif":
        with Image.open(path) as gif:
            lasts = []
            for i in range(gif.n_frames):
                gif.seek(i)
                lasts.append(gif.info["duration"])
            last = np.array(gif.convert("RGB"))
        assert sum(lasts) == 1600
        flown = pictures(singular, [singular.outcome.time])[0]
    else:
        frames, _ = decode(path)
        assert len(frames) == 48
        flown, last = frames[2], frames[-1]
    above = np.s_[85:500, 120:520]
    red = [np.sum(np.abs(picture[above].astype(int) - ALARM).max(axis=-1) < 60) for picture in (flown, last)]
    assert red[1] > red[0] + 300  # a line of words; the rod is red, too


def test_a_run_that_ended_where_it_started(singular, tmp_path):
    first = {name: getattr(singular, name)[:1] for name in ARRAYS}
    outcome = fp.Outcome("singular", 0.0, "0/0")
    start = dataclasses.replace(singular, **first, signals={}, outcome=outcome, interpolant=None)
    animate.movie(start, tmp_path / "a.mp4", **SMALL)
    assert len(decode(tmp_path / "a.mp4")[0]) == 1 + 30


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"view": "below"}, "view"),
        ({"speed": 0}, "speed"),
        ({"speed": -1}, "speed"),
        ({"speed": float("nan")}, "speed"),
        ({"speed": 1e-4}, "speed"),
        ({"fps": 0}, "fps"),
        ({"fps": "fast"}, "fps"),
        ({"size": (640, 641)}, "size"),
        ({"size": (100, 640)}, "size"),
        ({"size": 640}, "size"),
        ({"size": ((640, 640), (640, 640))}, "size"),
        ({"size": (640.5, 640)}, "size"),
        ({"path": "a.avi"}, "path"),
        ({"path": "a"}, "path"),
        ({"path": "a.gif", "fps": 60}, "fps"),
        ({"path": "none/a.mp4"}, "none"),
        ({"path": "folder.mp4"}, "folder"),
    ],
)
def test_bad_input_is_told_and_leaves_nothing(short, tmp_path, options, field):
    (tmp_path / "folder.mp4").mkdir()
    path = tmp_path / options.pop("path", "a.mp4")
    with pytest.raises(fp.InputError) as error:
        animate.movie(short, path, **(SMALL | options))
    assert field in error.value.field
    assert "\n" not in str(error.value)
    assert [entry.name for entry in tmp_path.iterdir()] == ["folder.mp4"]


@pytest.mark.parametrize("suffix", [".mp4", ".gif"])
@pytest.mark.parametrize("interruption", [KeyboardInterrupt, ZeroDivisionError])
def test_an_interrupted_movie_leaves_the_old_one(short, tmp_path, suffix, interruption):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(b"old")

    def stop(done, total):
        if done == 3:
            raise interruption

    with pytest.raises(interruption):
        animate.movie(short, path, progress=stop, **SMALL)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_frames_in_a_file_are_counted(short, tmp_path):
    path = tmp_path / "a.mp4"
    animate.movie(short, path, **SMALL)
    assert animate._frames_in(path) == 43
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    assert animate._frames_in(path) != 43
    path.write_bytes(b"")
    assert animate._frames_in(path) == 0


def test_what_ffmpeg_did_not_write_is_noticed(short, tmp_path, monkeypatch):
    """An ffmpeg that takes all frames and ends without a movie, as on a full disk."""
    silent = tmp_path / "ffmpeg"
    silent.write_text("#!/bin/sh\ncat > /dev/null\n", encoding="utf-8")
    silent.chmod(0o755)
    monkeypatch.setenv("IMAGEIO_FFMPEG_EXE", str(silent))
    out = tmp_path / "out"
    out.mkdir()
    with pytest.raises(fp.InputError, match="ffmpeg"):
        animate.movie(short, out / "a.mp4", **SMALL)
    assert not list(out.iterdir())
