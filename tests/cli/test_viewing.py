"""The commands that look at saved runs, and what `flypend run` adds: replay, movie, figures in a style."""

import json
import math
import re

import numpy as np
import pytest
from PIL import Image

import flypend as fp
from flypend.cli import terminal
from flypend.files import whole as files
from flypend.lab import standalone
from flypend.paper import experiment
from flypend.pictures import animate
from flypend.pictures.style import STYLES
from tests.few import few


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Two short saved runs: their folder."""
    folder = tmp_path_factory.mktemp("runs")
    for name in ("4", "5"):
        case = experiment(name)
        fp.simulate(case.vehicle, case.law(), case.start, 0.1, plant="ideal").save(folder / f"{name}.nc")
    return folder


def embedded(path):
    text = path.read_text(encoding="utf-8")
    return json.loads(re.search(r'<script id="flypend-data" type="application/json">(.*?)</script', text, re.S)[1])


def left(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_replay_as_mcap(call, runs, tmp_path):
    pytest.importorskip("mcap")
    told = call("replay", runs / "4.nc", "--out", "run.mcap")
    assert told == (0, "Open run.mcap in Foxglove or PlotJuggler.\n", "")
    assert left(tmp_path) == ["run.mcap"]
    status, _, told = call("replay", runs / "4.nc", runs / "5.nc", "--out", "both.mcap")
    assert status == 2
    assert "RUNS: expected one run, for a file .mcap, got 2" in told


def test_replay_of_one_run(call, runs, tmp_path):
    assert call("replay", runs / "4.nc") == (0, "Open replay.html in a browser.\n", "")
    assert left(tmp_path) == ["replay.html"]
    data = embedded(tmp_path / "replay.html")
    assert (len(data["runs"]), data["layout"], data["speed"]) == (1, "overlay", 1.0)


def test_replay_of_two_runs(call, runs, tmp_path):
    options = ("--beside", "--title", "Four and five", "--speed", "0.25", "-o", "x.html")
    assert call("replay", runs / "5.nc", runs / "4.nc", *options)[0] == 0
    data = embedded(tmp_path / "x.html")
    assert (data["title"], data["layout"], data["speed"]) == ("Four and five", "beside", 0.25)
    gains = [", ".join(f"{name} = {value}" for name, value in run["gains"]) for run in data["runs"]]
    assert gains == ["k_d = 1, k_1 = 9, k_2 = 4", "k_d = 1, k_1 = 12, k_2 = 5"]


def test_a_run_writes_its_replay_as_well(call, tmp_path):
    short = ("--set", "duration=0.1", "--no-figures", "--out", "out")
    code, told, _ = call("run", "4", *short, "--html", "flight.html")
    assert code == 0
    assert "the replay is flight.html" in " ".join(told.split())
    assert left(tmp_path) == ["flight.html", "out", "out/report.json", "out/report.md", "out/run.nc"]
    assert embedded(tmp_path / "flight.html")["runs"][0]["law"] == "corrected"


@pytest.mark.parametrize("plant", ["rotors", "ideal"])
def test_a_run_writes_a_page_that_flies(call, tmp_path, plant):
    short = ("--set", "duration=0.1", "--set", f"plant={plant}", "--no-figures", "--out", "out")
    code, told, _ = call("run", "4", *short, "--html", "live.html", "--live")
    assert code == 0
    assert "the live page is live.html" in " ".join(told.split())
    assert len(embedded(tmp_path / "live.html")["engine"]["code"]) > 1000


def test_the_laboratory_is_written_as_one_page(call, tmp_path, monkeypatch):
    monkeypatch.setattr(standalone.lab_page, "__defaults__", (("hehn2011",), ("lqr",)))
    code, told, _ = call("lab", "--html", "lab.html")
    assert (code, told) == (0, "The laboratory is in lab.html.\n")
    assert list(embedded(tmp_path / "lab.html")["engines"]) == [
        "hehn2011/gimbal/lqr/rotors/perfect",
        "hehn2011/gimbal/lqr/ideal/perfect",
    ]
    for option in (("--law", "my_law.py:balance"), ("--port", "80"), ("--no-browser",)):
        code, _, told = call("lab", "--html", "mine.html", *option)
        assert (code, option[0] in told, left(tmp_path)) == (2, True, ["lab.html"])


def test_movie(call, runs, tmp_path, monkeypatch):
    made = []
    monkeypatch.setattr(animate, "movie", lambda run, path, **options: made.append((run, path, options)))
    assert call("movie", runs / "4.nc") == (0, "The movie is flight.mp4.\n", "")
    options = ("--camera", "axis", "--speed", "0.5", "--fps", "24", "--size", "320", "240", "-o", "a.gif")
    assert call("movie", runs / "4.nc", *options)[0] == 0
    told = [options.pop("progress") for _, _, options in made]
    assert all(callable(tell) for tell in told)
    assert [(str(path), options) for _, path, options in made] == [
        ("flight.mp4", {"view": "side", "speed": 0.25, "fps": 30, "size": (640, 640)}),
        ("a.gif", {"view": "axis", "speed": 0.5, "fps": 24, "size": (320, 240)}),
    ]
    np.testing.assert_array_equal(made[0][0].y, fp.load(runs / "4.nc").y)


def test_a_movie_is_really_written(call, runs, tmp_path):
    assert call("movie", runs / "4.nc", "--size", "160", "160", "--fps", "10", "-o", "a.mp4")[0] == 0
    assert left(tmp_path) == ["a.mp4"]
    assert (
        animate._frames_in(tmp_path / "a.mp4") == 5 + 15
    )  # a second and a half with the verdict  # 0.1 s / 0.25, and the last instant


def test_figures_take_a_font_and_leave_out_titles(call, runs, tmp_path):
    assert call("figures", runs / "4.nc", "-o", "x", "--font", "STIXGeneral", "--no-title")[0] == 0
    content = (tmp_path / "x" / "full.pdf").read_bytes()
    assert b"STIXGeneral" in content
    code, _, said = call("figures", runs / "4.nc", "-o", "y", "--font", "STIXGenera")
    assert code == 2
    assert said.startswith("flypend: --font: expected a font family that is installed, got 'STIXGenera'")
    assert not (tmp_path / "y").exists()


@pytest.mark.parametrize("style", few(["paper"], STYLES))
def test_figures(call, runs, tmp_path, style, monkeypatch):
    monkeypatch.setattr(terminal, "EVERY", math.inf)  # a busy machine would tell how far it is
    assert call("figures", runs / "4.nc", "--style", style, "-o", "out") == (0, "Figures are in out.\n", "")
    kinds = ("full", "stop-motion", "y3-z3")
    assert left(tmp_path) == ["out", *(f"out/{kind}.{suffix}" for kind in kinds for suffix in ("pdf", "png"))]
    width = {"paper": 1432, "slides": 1920}[style]
    for kind in ("full", "stop-motion"):
        with Image.open(tmp_path / "out" / f"{kind}.png") as picture:
            assert picture.size[0] == pytest.approx(width, abs=1)
            if (style, kind) == ("slides", "full"):
                assert picture.size[1] == 1080


def test_a_run_draws_in_the_style_asked_for(call, tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr(files, "save_figure", lambda figure, path: drawn.append(figure.get_size_inches()[0]))
    call("run", "4", "--set", "duration=0.1", "--quick", "--style", "slides")
    assert set(drawn) == {STYLES["slides"].half[0], STYLES["slides"].full[0]}


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["replay", "none.nc"], "none.nc: expected a run saved by flypend, got No such file or directory"),
        (["replay", "{}/4.nc", "-o", "a.htm"], "--out: expected a file name ending in .html or .mcap, got a.htm"),
        (["replay", "{}/4.nc", "--speed", "0"], "speed: expected a finite number > 0, got 0"),
        (["replay", *["{}/4.nc"] * 5], "runs: expected 1 to 4 runs, got 5"),
        (["movie", "{}/4.nc", "--camera", "sid"], "--camera: expected one of side, axis, got 'sid'"),
        (["movie", "{}/4.nc", "--speed", "-1"], "speed: expected a finite number > 0, got -1"),
        (["movie", "{}/4.nc", "-o", "a.avi"], "--out: expected a file name ending in .mp4 or .gif, got a.avi"),
        (
            ["movie", "{}/4.nc", "--size", "3", "3"],
            "size: expected two even numbers of pixels, 160 to 4096, got (3, 3)",
        ),
        (["figures", "{}/4.nc", "--style", "poster"], "--style: expected one of paper, slides, got 'poster'"),
        (["run", "4", "--style", "slide"], "--style: expected one of paper, slides, got 'slide'"),
        (["run", "4", "--html", "a.txt"], "--html: expected a file name ending in .html, got a.txt"),
        (["run", "4", "--html", "none/a.html"], "none/a.html: expected a file that can be written"),
        (["run", "4", "--live"], "--live: expected --html FILE, the page that flies, got none"),
        (
            ["run", "4", "--set", "plant=mujoco", "--html", "a.html", "--live"],
            "live: expected a plant of the built-in equations, such as rotors, got the plant mujoco",
        ),
    ],
)
def test_bad_input_is_one_line_and_leaves_nothing(call, runs, tmp_path, arguments, line):
    code, told, complaints = call(*(argument.format(runs) for argument in arguments))
    assert (code, told) == (2, "")
    assert complaints.startswith(f"flypend: {line}")
    assert complaints.count("\n") == 1
    assert left(tmp_path) == []


def test_a_replay_that_is_there_is_kept_when_the_new_one_cannot_be_flown(call, tmp_path):
    (tmp_path / "flight.html").write_text("mine")
    assert call("run", "4", "--html", "flight.html", "--set", "law.gains.k_d=x")[0] == 2
    assert call("run", "4", "--html", "flight.html", "--style", "x")[0] == 2
    assert (tmp_path / "flight.html").read_text() == "mine"
