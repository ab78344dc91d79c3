"""The command line: what it writes is what the library computes; bad input is one line, code 2, and no trace."""

import dataclasses
import errno
import importlib.metadata
import io
import json
import os
import re
import runpy
import signal
import subprocess
import sys
import time
from pathlib import Path

import click
import numpy as np
import pytest
from rich.console import Console

import flypend as fp
from flypend.cli import installation, terminal
from flypend.cli.app import app
from flypend.cli.terminal import progress_bar
from flypend.files import whole as files
from flypend.flight import simulate
from flypend.flight.trajectory import Trajectory
from flypend.model.table import vehicle_names
from flypend.paper import experiment
from flypend.paper.claims import SETTLED, theorem_claims
from flypend.pictures import animate, figures
from flypend.plants import PRESETS
from flypend.report import paper
from flypend.settings import runfile
from flypend.studies.basin import measure_basin
from tests.few import slow
from tests.folders import content

STEPPED = fp.Controller(name="stepped", function=lambda t, state: fp.Wrench(5.4, (0.0, 0.0, 0.0)))
ENVIRONMENT = {**os.environ, "COLUMNS": "80", "NO_COLOR": "1"}


def flypend(folder, *arguments):
    """The command in a process of its own, in `folder`."""
    command = [sys.executable, "-m", "flypend", *arguments]
    return subprocess.run(
        command, cwd=folder, env=ENVIRONMENT, capture_output=True, encoding="utf-8", timeout=120, check=False
    )


# What is asked and what is told -------------------------------------------------------------------------------------


def test_help_of_the_script_tells_what_there_is(tmp_path):
    script = Path(sys.executable).with_name("flypend")
    assert script.exists()
    done = subprocess.run([script, "--help"], cwd=tmp_path, env=ENVIRONMENT, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    commands = ("paper", "run", "compare", "ladder", "replay", "movie", "figures")
    for words in ("spherical pendulum on a quadrotor", "--version", *commands):
        assert words in done.stdout
    assert "…" not in done.stdout  # nothing cut off at 80 columns
    assert content(tmp_path) == {}


@pytest.mark.parametrize("command", ["paper", "run", "compare", "ladder", "replay", "movie", "figures"])
def test_help_of_a_command(call, command):
    code, told, complaints = call(command, "--help")
    assert (code, complaints) == (0, "")
    assert "--out" in told
    assert "…" not in told


def test_help_of_run_names_the_keys_of_a_file(call):
    told = call("run", "--help")[1]
    for word in (*runfile.KEYS, "--set", "--quick", "--no-figures", "2-projected"):
        assert word in told


def test_version_is_that_of_the_package(tmp_path):
    done = flypend(tmp_path, "--version")
    assert (done.returncode, done.stdout, done.stderr) == (0, f"flypend {fp.__version__}\n", "")
    assert importlib.metadata.version("flypend") == fp.__version__


def test_without_arguments_there_is_help(call):
    code, told, complaints = call()
    assert code == 2
    assert "Usage" in told + complaints
    assert "paper" in told + complaints
    assert "flypend:" not in complaints


# A run --------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def second(tmp_path_factory):
    """Experiment 2, flown by the command: its folder and what it printed."""
    folder = tmp_path_factory.mktemp("second")
    done = flypend(folder, "run", "2", "--no-figures", "--out", "out")
    assert (done.returncode, done.stderr) == (0, "")
    return folder, done.stdout


def test_a_run_writes_the_run_and_its_reports_and_nothing_else(second):
    folder, _ = second
    assert sorted(content(folder)) == ["out", "out/report.json", "out/report.md", "out/run.nc"]


def test_a_run_without_figures_imports_nothing_that_it_does_not_need(tmp_path):
    """Each of these takes longer to import than the run takes to fly."""
    heavy = ("numpy.ma", "scipy", "matplotlib", "mujoco", "xarray", "joblib", "distributed", "flypend.export", "jax")
    program = (
        "import runpy, sys\ntry:\n    runpy.run_module('flypend', run_name='__main__', alter_sys=True)\n"
        f"except SystemExit as end:\n    print(end.code, [name for name in {heavy} if name in sys.modules])"
    )
    command = [sys.executable, "-c", program, "run", "1", "--no-figures"]
    done = subprocess.run(command, cwd=tmp_path, env=ENVIRONMENT, capture_output=True, encoding="utf-8", check=True)
    assert done.stdout.splitlines()[-1] == "0 []"


def test_a_run_is_that_of_the_library(second):
    folder, _ = second
    row = experiment("2")
    written, flown = (
        fp.load(folder / "out" / "run.nc"),
        fp.simulate(row.vehicle, row.law(), row.start, 6.5, plant="ideal"),
    )
    np.testing.assert_array_equal(written.t, flown.t)
    for name in ("x", "x_dot", "R", "omega", "y", "y_dot", "thrust", "moment"):
        # Starts equal to an eps; rtol 1e-9 and numbers up to 1e2.
        np.testing.assert_allclose(getattr(written, name), getattr(flown, name), rtol=1e-8, atol=1e-8)
    assert written.vehicle == row.vehicle
    assert (written.law, written.e3, written.gains) == ("corrected", "down", row.law().values)


def test_a_report_is_that_of_the_library(second):
    folder, told = second
    report = json.loads((folder / "out" / "report.json").read_text(encoding="utf-8"))
    row = experiment("2")
    long_run = fp.simulate(row.vehicle, row.law(), row.start, SETTLED, plant="ideal")
    wanted = theorem_claims(fp.load(folder / "out" / "run.nc"), long_run)
    assert [(c["claim"], c["holds"], c["criterion"]) for c in report["claims"]] == [
        (v.claim, v.holds, v.criterion) for v in wanted
    ]
    np.testing.assert_allclose([c["value"] for c in report["claims"]], [v.value for v in wanted], rtol=1e-6)
    assert report["flypend"] == fp.__version__
    assert report["outcome"] == {"status": "completed", "time": 6.5, "reason": ""}
    assert report["settings"]["experiment"] == "2"
    assert "corrected, k_2 4.4 on nayak2018: completed at 6.5 s" in told
    assert "0.99905 ✓" in told
    lines = (folder / "out" / "report.md").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "# A run of corrected on nayak2018"
    assert any("0.99905 **holds**" in line and "1.19 **fails**" in line for line in lines)


def test_a_run_with_overrides_is_that_of_the_library(call, tmp_path):
    changes = ("--set", "law.name=printed", "--set", "law.gains.k_d=2", "--set", "duration=1")
    code, told, _ = call("run", "4", "--no-figures", "-o", "out", *changes)
    row = experiment("4")
    flown = fp.simulate(row.vehicle, fp.laws.printed(**{**row.gains, "k_d": 2}), row.start, 1.0, plant="ideal")
    written = fp.load(tmp_path / "out" / "run.nc")
    assert code == 1  # it has not flown to its end
    assert written.outcome.status == flown.outcome.status == "singular"
    assert written.outcome.time == pytest.approx(flown.outcome.time, rel=1e-6)
    assert "printed, k_d 2, k_1 12, k_2 5 on nayak2018: singular at 0.1068 s" in told


def test_a_file_of_ones_own_is_flown(call, tmp_path):
    own = 'vehicle = "hehn2011"\nlaw = { name = "inverted" }\nduration = 0.2\nstart = { y = [0.0, 0.0, -1.0] }\n'
    (tmp_path / "own.toml").write_text(own)
    code, told, _ = call("run", "own.toml", "--no-figures", "--out", "out")
    vehicle = fp.vehicle("hehn2011")
    flown = fp.simulate(vehicle, fp.laws.inverted(), fp.State(y=(0, 0, -1)), 0.2)  # in the plant rotors
    np.testing.assert_allclose(fp.load(tmp_path / "out" / "run.nc").y, flown.y, rtol=0, atol=1e-8)
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert (code, report["claims"]) == (0, [])  # it is not the theorem's law
    assert "Theorem" not in told


REPORTS = ["report.json", "report.md", "run.nc"]
PICTURES = [f"{kind}.{suffix}" for kind in ("full", "stop-motion", "y3-z3") for suffix in ("pdf", "png")]
MOVIES = ["movie-axis.mp4", "movie-side.mp4"]


@pytest.fixture
def sketches(monkeypatch):
    """Pictures and movies as files of a word, which take no time."""
    monkeypatch.setattr(files, "save_figure", lambda figure, path: path.write_text("picture"))
    monkeypatch.setattr(animate, "movie", lambda run, path, **options: path.write_text(f"{options}"))


def test_pictures_are_drawn(call, tmp_path):
    assert call("run", "4", "--set", "duration=0.2", "--out", "out", "--quick")[0] == 0
    assert list(content(tmp_path / "out")) == sorted(REPORTS + PICTURES)
    for name in PICTURES:
        head = b"\x89PNG" if name.endswith("png") else b"%PDF"
        assert (tmp_path / "out" / name).read_bytes().startswith(head)


@pytest.mark.parametrize(
    ("options", "names"),
    [
        ([], REPORTS + PICTURES + MOVIES),
        (["--quick"], REPORTS + PICTURES),
        (["--no-figures"], REPORTS),
        (["--no-figures", "--quick"], REPORTS),
    ],
)
def test_pictures_and_movies_are_made_unless_left_out(call, tmp_path, sketches, options, names):
    assert call("run", "4", "--set", "duration=0.1", "--out", "out", *options)[0] == 0
    assert list(content(tmp_path / "out")) == sorted(names)
    if not options:
        assert (tmp_path / "out" / "movie-axis.mp4").read_text() == "{'view': 'axis', 'speed': 0.25}"


def test_other_files_of_the_folder_stay(call, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "notes.txt").write_text("mine")
    (tmp_path / "out" / "report.md").write_text("old")
    assert call("run", "1", "--no-figures", "--out", "out", "--set", "duration=0.1")[0] == 0
    assert (tmp_path / "out" / "notes.txt").read_text() == "mine"
    assert (tmp_path / "out" / "report.md").read_text(encoding="utf-8").startswith("# A run of")
    assert list(content(tmp_path / "out")) == ["notes.txt", "report.json", "report.md", "run.nc"]


def test_only_the_law_that_settles_is_flown_for_longer(call, monkeypatch):
    flown, fly = [], simulate.fly

    def recorded(flight):
        flown.append(flight.duration)
        return fly(flight.replace(duration=0.1))

    monkeypatch.setattr(simulate, "fly", recorded)
    short = ("--no-figures", "--set", "duration=0.1")
    assert call("run", "1", *short)[0] == 0
    assert flown == [0.1, SETTLED]
    # Without beta the printed law would spin up to 1e6 rad/s within 20 s, and take minutes for it.
    assert call("run", "1", *short, "--set", "law.name=printed", "--set", "law.gains.beta=off")[0] == 0
    assert flown == [0.1, SETTLED, 0.1]
    # Nor is one on rotors, of which the theorem says nothing.
    assert call("run", "1", *short, "--set", "plant=rotors")[0] == 0
    assert flown == [0.1, SETTLED, 0.1, 0.1]


def test_names_that_look_like_markup_are_printed_as_they_are(call, tmp_path):
    name, own = "a[/]b", tmp_path / "own[bold]1.toml"
    own.write_text("experiment = 1\nduration = 0.1\n")
    code, told, complaints = call(
        "run", own.name, "--no-figures", "--out", "out[red]", "--set", f'vehicle.name="{name}"'
    )
    assert (code, complaints) == (0, "")
    assert f"corrected, k_1 8 on {name}: completed" in told
    assert "Results are in out[red]." in told
    assert "own[bold]" in told
    assert (tmp_path / "out[red]" / "run.nc").exists()


# What is refused ----------------------------------------------------------------------------------------------------

# Arguments after `run 2`, and the line.
WRONG = {
    "R is not a rotation": (
        "start.R=[[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.7]]",
        "start.R: expected a rotation (RᵀR = 1, det R = 1), got ‖RᵀR − 1‖ = 0.172",
    ),
    "y is not a unit vector": ("start.y=[1, 0, 1]", "start.y: expected a unit vector, got |y| = 1.41421"),
    "y_dot of experiment 2 as printed": (
        "start.y_dot=[0.7, 0, 0.7]",
        "start.y_dot: expected a tangent vector (y · y_dot = 0), got y · y_dot = 0.99",
    ),
    "negative mass": ("vehicle.mass=-0.4", "vehicle.mass: expected a finite number > 0 kg, got -0.4"),
    "zero mass of the bob": ("vehicle.bob_mass=0", "vehicle.bob_mass: expected a finite number > 0 kg, got 0"),
    "negative length": ("vehicle.rod_length=-0.5", "vehicle.rod_length: expected a finite number > 0 m, got -0.5"),
    "inertia is not positive definite": (
        "vehicle.inertia=[0.1, 0.1, -0.1]",
        "vehicle.inertia: expected a positive definite matrix, got a principal moment of -0.1 kg m²",
    ),
    "inertia against the triangle inequality": (
        "vehicle.inertia=[0.1, 0.1, 0.3]",
        "vehicle.inertia: expected principal moments within the triangle inequality, got 0.1 + 0.1 < 0.3",
    ),
    "unknown key": ("law.gains.kd=1", "law.gains.kd: expected one of *, got 'kd' (did you mean 'k_d'?)"),
    "NaN": ("start.x=[nan, 0, 0]", "start.x: expected finite numbers, got 1 that are NaN or infinite"),
    "no duration": ("duration=0", "duration: expected a finite number > 0 s, got 0"),
    "zero length": ("vehicle.rod_length=0", "vehicle.rod_length: expected a finite number > 0 m, got 0"),
    "zero mass": ("vehicle.mass=0", "vehicle.mass: expected a finite number > 0 kg, got 0"),
    "a reflection": (
        "start.R=[[1, 0, 0], [0, 1, 0], [0, 0, -1]]",
        "start.R: expected a rotation (RᵀR = 1, det R = 1), got determinant < 0",
    ),
    "negative duration": ("duration=-1", "duration: expected a finite number > 0 s, got -1"),
    "NaN in a gain": ("law.gains.k_1=nan", "law.gains.k_1: expected a finite number > 0 1/s², got nan"),
    "unknown law": ("law.name=corect", "law.name: expected one of *, got 'corect' (did you mean 'corrected'?)"),
    "unknown field of the vehicle": ("vehicle.weight=1", "vehicle.weight: expected one of *, got 'weight'*"),
    "numbers near the largest": ("start.y=[0, 0, 1e200]", "start.y: expected a unit vector, got |y| = inf"),
    "two starts": ("start.x=[[0, 0, 0], [1, 1, 1]]", "start: expected a single state, got a batch of shape (2,)"),
    "no value": ("duration", "--set: expected KEY.KEY=VALUE, such as law.gains.k_d=2, got 'duration'"),
    "an unprintable key": ("a\nb=1", "--set: expected KEY.KEY=VALUE, such as law.gains.k_d=2, got 'a\\nb=1'"),
}  # fmt: skip


def is_the_line(complaints, line):
    before, _, after = line.rstrip("*").partition("*")
    assert len(complaints.splitlines()) == 1
    assert complaints.startswith(f"flypend: {before}")
    assert line.endswith("*") or complaints.endswith(f"{after}\n")


@pytest.mark.parametrize("what", WRONG)
def test_bad_input_is_one_line_code_2_and_no_trace(call, tmp_path, what):
    override, line = WRONG[what]
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "report.md").write_text("old")
    before = content(tmp_path)
    code, told, complaints = call("run", "2", "--set", override, "--out", "out")
    assert (code, told) == (2, "")
    is_the_line(complaints, line)
    assert content(tmp_path) == before


def test_a_file_that_is_wrong_is_one_line_code_2_and_no_trace(tmp_path):
    own = 'vehicle = "nayak2018"\nlaw = { name = "corrected" }\nduration = 1\nstart = { z = [0, 0, 1] }\n'
    (tmp_path / "own.toml").write_text(own)
    before = content(tmp_path)
    done = flypend(tmp_path, "run", "own.toml")
    assert (done.returncode, done.stdout) == (2, "")
    is_the_line(done.stderr, "start.z: expected one of x, x_dot, R, omega, y, y_dot, got 'z'")
    assert content(tmp_path) == before


@pytest.mark.parametrize(
    ("what", "line"),
    [
        ("7", "run: expected an experiment (1, 2, 2-projected, 3, 4, 5) or a TOML file, got '7'"),
        ("none.toml", "none.toml: expected a readable TOML file, got No such file or directory"),
        ("folder", "folder: expected a readable TOML file, got Is a directory"),
        ("broken.toml", "broken.toml: expected a TOML file, got *"),
        ("two\nlines.toml", "two lines.toml: expected a readable TOML file, got No such file or directory"),
    ],
)
def test_what_cannot_be_flown_is_one_line_code_2_and_no_trace(call, tmp_path, what, line):
    (tmp_path / "folder").mkdir()
    (tmp_path / "broken.toml").write_text("duration = = 1\n")
    before = content(tmp_path)
    code, told, complaints = call("run", what)
    assert (code, told) == (2, "")
    is_the_line(complaints, line)
    assert content(tmp_path) == before


@pytest.fixture
def unwritable(tmp_path):
    """Folder names that cannot become folders, also for root, and why."""
    (tmp_path / "file").write_text("mine")
    (tmp_path / "link").symlink_to(tmp_path / "gone" / "far")
    return {
        "file": "file: expected a folder, got a file",
        "file/out": "file/out: expected a folder that can be written, got Not a directory",
        "none/out": "none/out: expected a folder that can be written, got No such file or directory",
        "link": "link: expected a folder, got a link that leads nowhere",
    }


@pytest.mark.parametrize("command", [("run", "2"), ("paper",), ("paper", "--quick")])
def test_a_folder_that_cannot_be_written_is_told_before_anything_is_flown(
    call, tmp_path, unwritable, command, monkeypatch
):
    def fly(*_):
        pytest.fail("flown")

    monkeypatch.setattr(simulate, "fly", fly)
    monkeypatch.setattr(paper, "fly_all", fly)
    before = content(tmp_path)
    for out, line in unwritable.items():
        code, told, complaints = call(*command, "--out", out)
        assert (code, told) == (2, "")
        is_the_line(complaints, line)
        assert content(tmp_path) == before


def test_a_folder_that_cannot_be_written_in_a_process_of_its_own(tmp_path, unwritable):
    before = content(tmp_path)
    done = flypend(tmp_path, "paper", "--out", "file/out")
    assert (done.returncode, done.stdout) == (2, "")
    is_the_line(done.stderr, unwritable["file/out"])
    assert content(tmp_path) == before


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_without_permission_is_one_line(call, tmp_path):
    (tmp_path / "closed").mkdir(mode=0o555)
    for out in ("closed", "closed/out"):
        code, _, complaints = call("run", "2", "--out", out)
        assert code == 2
        is_the_line(complaints, f"{out}: expected a folder that can be written, got Permission denied")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("fly",), "No such command 'fly'"),
        (("--quick",), "No such option"),
        (("run",), "Missing argument"),
        (("run", "2", "--sett", "duration=1"), "No such option"),
        (("run", "2", "3"), "unexpected extra argument"),
        (("run", "2", "--out"), "requires an argument"),
        (("paper", "--quick=yes"), "does not take a value"),
        (("compare", "--runs", "0"), "'--runs': 0 is not in the range x>=1"),
        (("compare", "--runs", "many"), "'--runs': 'many' is not a valid integer"),
    ],
)
def test_a_wrong_command_is_one_line_and_code_2(call, tmp_path, arguments, words):
    code, told, complaints = call(*arguments)
    assert (code, told) == (2, "")
    is_the_line(complaints, "*")
    assert words in complaints
    assert content(tmp_path) == {}


def test_a_wrong_command_in_a_process_of_its_own(tmp_path):
    done = flypend(tmp_path, "fly")
    assert (done.returncode, done.stdout, done.stderr) == (
        2,
        "",
        "flypend: No such command 'fly'. See flypend --help.\n",
    )


@pytest.mark.parametrize(
    ("arguments", "command"),
    [(("run",), "run"), (("check", "--runs", "0"), "check"), (("vehicle", "new"), "vehicle new")],
)
def test_a_wrong_command_says_where_its_arguments_are_explained(call, arguments, command):
    assert call(*arguments)[2].endswith(f" See flypend {command} --help.\n")


# What fails on the way ----------------------------------------------------------------------------------------------


@pytest.fixture
def old(tmp_path):
    """A folder with results of before."""
    (tmp_path / "out").mkdir()
    for name in ("run.nc", "report.md", "full.png"):
        (tmp_path / "out" / name).write_text(f"old {name}")
    return tmp_path


def fail(*_, **__):
    raise RuntimeError("out of ink")


@pytest.mark.parametrize("module_and_name", [(figures, "full_figure"), (files, "save_figure"), (animate, "movie")])
@pytest.mark.parametrize("out", ["out", "new"])
def test_a_figure_that_fails_leaves_nothing_new(call, old, sketches, monkeypatch, module_and_name, out):
    monkeypatch.setattr(*module_and_name, fail)
    before = content(old)
    with pytest.raises(RuntimeError, match="out of ink"):
        call("run", "4", "--set", "duration=0.1", "--out", out)
    assert content(old) == before


@pytest.mark.parametrize("out", ["out", "new"])
def test_a_full_disk_is_one_line_and_leaves_nothing_new(call, old, monkeypatch, out):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "write_text", full)
    before = content(old)
    code, told, complaints = call("run", "4", "--set", "duration=0.1", "--no-figures", "--out", out)
    assert (code, told) == (2, "")
    is_the_line(complaints, f"{out}: expected a folder that can be written, got No space left on device")
    assert content(old) == before


def test_a_run_file_that_cannot_be_saved_is_one_line_and_leaves_nothing_new(call, old, monkeypatch):
    def full(self, path):
        raise fp.InputError(str(path), "a file that can be written", "No space left on device")

    monkeypatch.setattr(Trajectory, "save", full)
    before = content(old)
    code, _, complaints = call("run", "4", "--set", "duration=0.1", "--no-figures", "--out", "out")
    assert code == 2
    is_the_line(complaints, "*run.nc: expected a file that can be written, got No space left on device")
    assert content(old) == before


@pytest.mark.parametrize(("name", "code"), [("SIGINT", 130), ("SIGTERM", 143)])
def test_an_interrupted_run_leaves_nothing_new(old, name, code):
    before = content(old)
    # A test run started in the background hands SIGINT down as ignored; a person's shell does not.
    default = "import signal, runpy; signal.signal(signal.SIGINT, signal.default_int_handler); "
    program = default + "runpy.run_module('flypend', run_name='__main__')"
    command = [sys.executable, "-c", program, "run", "4", "--out", "out"]
    with subprocess.Popen(
        command, cwd=old, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    ) as process:
        start = time.monotonic()
        while not list(old.glob("out/.flypend-partial-*/run.nc")):  # the figures and movies come after it
            assert process.poll() is None, process.stdout.read()
            assert time.monotonic() < start + 60
            time.sleep(0.01)
        process.send_signal(getattr(signal, name))
        told = process.communicate(timeout=60)[0]
    assert process.returncode == code
    assert b"Traceback" not in told
    assert content(old) == before


def test_what_stands_in_the_way_is_told_and_nothing_is_moved(call, old):
    (old / "out" / "run.nc").unlink()
    (old / "out" / "run.nc").mkdir()
    before = content(old)
    code, told, complaints = call("run", "4", "--set", "duration=0.1", "--no-figures", "--out", "out")
    assert (code, told) == (2, "")
    is_the_line(complaints, f"{Path('out') / 'run.nc'}: expected a file or nothing, got a folder")
    assert content(old) == before


def test_an_error_of_the_code_is_no_bad_input(call, monkeypatch):
    monkeypatch.setattr(runfile, "run_file", fail)
    with pytest.raises(RuntimeError, match="out of ink"):
        call("run", "2")


def test_a_terminal_that_lacks_the_signs_gets_something_else_for_them(tmp_path):
    command = [sys.executable, "-m", "flypend", "run", "2", "--no-figures", "--set", "duration=0.1"]
    environment = {**ENVIRONMENT, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "y ? e?" in done.stdout  # y → e₃
    assert "Results are in run-out." in done.stdout


# Interrupted ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", [signal.SIGINT, slow(signal.SIGTERM)])
def test_a_sweep_that_is_stopped_says_which_command_goes_on(number, tmp_path):
    """Sixty runs of minutes: below 64, nothing was heard. --force is not repeated, for it would start over."""
    (tmp_path / "study.toml").write_text(
        'vehicle = "hehn2011"\nlaw = { name = "lqr" }\nduration = 19000.0\njudge_period = 10.0\nruns = 60\nchunk = 60\n'
        '[vary.start]\nomega = { ball = 0.1 }\n[start]\ny = [0.0, 0.0, 1.0]\n',
        encoding="utf-8",
    )  # fmt: skip
    command = [sys.executable, "-m", "flypend", "sweep", "study.toml", "-o", "my runs.zarr", "--force"]
    # Whoever runs the tests in the background ignores SIGINT, and so would the process.
    deaf = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)}
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True, **deaf) as process:
        while not (tmp_path / "my runs.zarr").exists():
            assert process.poll() is None
            time.sleep(0.05)
        sent = time.monotonic()
        process.send_signal(number)
        told = process.communicate(timeout=60)[1]
        took = time.monotonic() - sent
    begin = time.monotonic()
    subprocess.run([sys.executable, "-c", "pass"], check=True)
    assert took < 0.5 + 10 * (time.monotonic() - begin)  # the second term is for the end of the process itself
    assert process.returncode == 128 + number
    assert "flypend sweep study.toml -o 'my runs.zarr'\n" in told
    assert "Traceback" not in told
    assert "--force" not in told


def test_an_interrupted_self_test_is_one_line(monkeypatch, capsys):
    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr("flypend.compile.llvm.target.native", interrupted)
    monkeypatch.delitem(sys.modules, "flypend.selftest", raising=False)
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("flypend.selftest", run_name="__main__")
    assert ended.value.code == 128 + signal.SIGINT
    assert capsys.readouterr().err == "flypend: interrupted\n"


# Words ----------------------------------------------------------------------------------------------------------------


def test_laws_and_vehicles_are_listed_with_gains_units_and_defaults(call):
    code, told, _ = call("laws")
    assert code == 0
    assert all(law in told for law in ("printed (e3 down)", "corrected (e3 down)", "inverted (e3 up)", "lqr (e3 up)"))
    row = next(line for line in told.splitlines() if line.strip().startswith("attitude_bandwidth"))
    assert row.split()[1:3] == [
        f"{fp.laws.inverted().gains_for(fp.vehicle('hehn2011'))['attitude_bandwidth']:.4g}",
        "rad/s",
    ]
    _, told, _ = call("laws", "corrected")
    assert "k_d" in told
    assert "inverted" not in told
    code, told, _ = call("vehicles")
    assert code == 0
    assert {"crazyflie", "hehn2011", "nayak2018"} <= set(told.split())
    machine = fp.vehicle("hehn2011")
    assert f"{4 * machine.rotor_limits[1] / machine.weight:.3g}" in told
    assert call("laws", "lqqr")[0] == 2


@pytest.mark.parametrize("columns", ["80", "40"])
def test_names_in_lists_are_whole_in_a_narrow_terminal(monkeypatch, capsys, columns):
    """What one types elsewhere is not cut short with …; in a table of gains, it goes on in the next line."""
    monkeypatch.setattr(installation, "console", Console(width=int(columns)))
    installation.vehicles.callback(None, None)
    told = capsys.readouterr().out
    assert set(vehicle_names()) <= set(told.split())
    installation.laws.callback("lqr", "hehn2011")
    told = capsys.readouterr().out
    assert "…" not in told
    if columns == "80":
        assert set(fp.laws.lqr().table) <= set(told.split())


def test_a_vehicle_is_told_as_its_file_and_drawn(call, tmp_path):
    """What is told is a file again, from which one's own vehicle begins."""
    code, told, _ = call("vehicles", "crazyflie")
    assert code == 0
    (tmp_path / "mine.toml").write_text(told, encoding="utf-8")
    assert fp.vehicle(tmp_path / "mine.toml") == fp.vehicle("crazyflie")
    assert "arXiv 2404.07837" in told
    assert call("vehicles", "mine.toml", "-o", "mine.svg")[0] == 0
    assert (tmp_path / "mine.svg").read_text(encoding="utf-8").startswith("<?xml")
    for wrong in (("nope",), ("nope.toml",), ("hehn2011", "-o", "a.txt"), ("-o", "a.png")):
        assert call("vehicles", *wrong)[0] == 2


def test_a_pipe_gets_whole_lines(tmp_path):
    """A table of the laws has lines of more than 80 columns; meanings wrap within their column."""
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    command = [sys.executable, "-m", "flypend", "laws", "inverted"]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
    gains = fp.laws.inverted().table
    rows = [line.split()[0] for line in done.stdout.splitlines() if line[1:2].strip()]  # not where a meaning goes on
    assert [row for row in rows if row in gains] == list(gains)
    words = " ".join(done.stdout.split())
    assert all(" ".join(gain.doc.split()) in words for gain in gains.values())


def test_a_run_file_and_a_study_are_not_mistaken_for_each_other(call, tmp_path):
    run = 'vehicle = "nayak2018"\nlaw = { name = "corrected" }\nduration = 1.0\n[start]\ny = [0.0, 0.0, 1.0]\n'
    (tmp_path / "run.toml").write_text(run, encoding="utf-8")
    (tmp_path / "study.toml").write_text("runs = 10\n" + run, encoding="utf-8")
    code, _, told = call("run", "study.toml", "--no-figures")
    assert (code, "got a study (it has runs): flypend sweep study.toml" in told) == (2, True)
    for command in (("sweep", "run.toml", "-o", "a.zarr"), ("map", "run.toml"), ("tune", "run.toml")):
        code, _, told = call(*command)
        assert (code, "flypend run run.toml" in told) == (2, True)


def test_overridden_vehicles_and_laws_are_called_so(call, tmp_path):
    text = 'vehicle = { base = "hehn2011", mass = 0.6 }\nduration = 0.1\nstart = { y = [0.0, 0.0, -1.0] }\n'
    law = 'law = { name = "inverted", gains = { throw_speed = 2.5 } }\n'
    (tmp_path / "own.toml").write_text(law + text, encoding="utf-8")
    _, told, _ = call("run", "own.toml", "--no-figures")
    assert told.startswith("inverted, throw_speed 2.5 on hehn2011, mass 0.6: completed")


def test_the_detuned_law_can_be_flown_alone(call, tmp_path):
    (tmp_path / "own.toml").write_text(
        'vehicle = "hehn2011"\nlaw = { name = "lqr" }\nduration = 0.1\nstart = { y = [0.0, 0.0, -1.0] }\n',
        encoding="utf-8",
    )
    code, told, _ = call("run", "own.toml", "--no-figures", "--law", "detuned")
    assert (code, told.startswith("detuned, ")) == (0, True)


def test_failed_flights_are_kept_and_fly_again_to_the_same_end(call, tmp_path):
    code, told, _ = call("compare", "--law", "lqr", "--runs", "4", "--duration", "1", "--keep", "kept")
    assert code == 0
    files = sorted((tmp_path / "compare-out" / "failed").iterdir())
    assert files
    assert f"{len(files)} failed flights in " in told
    assert sorted(path.stem for path in (tmp_path / "kept").iterdir()) == [path.stem for path in files]
    call("run", f"compare-out/failed/{files[0].name}", "--no-figures", "-o", "again")
    again, kept = fp.load(tmp_path / "again" / "run.nc"), fp.load(tmp_path / "kept" / f"{files[0].stem}.nc")
    np.testing.assert_array_equal(again.packed, kept.packed)
    starts = fp.random_starts(4, 1)
    flown = fp.compare(fp.vehicle("hehn2011"), [fp.laws.lqr()], starts, 1.0)
    number = int(files[0].stem.rpartition("-")[2])
    np.testing.assert_allclose(again.packed[-1], flown.ensembles["lqr"].final[number].packed(), atol=1e-9)
    _, told, _ = call("compare", "--law", "lqr", "--runs", "2", "--seed", "9", "--duration", "1")
    left = list((tmp_path / "compare-out" / "failed").iterdir())
    assert f"{len(left)} failed flights in " in told  # and none of the comparison before


def test_a_floor_is_an_option_of_what_flies(call, tmp_path):
    given = ("compare", "--law", "lqr", "--runs", "4", "--duration", "1", "--floor", "-0.4")
    assert call(*given)[0] == 0
    told = json.loads((tmp_path / "compare-out" / "report.json").read_text(encoding="utf-8"))
    assert told["settings"]["plant"] == {"base": "rotors", "floor": -0.4}
    (row,) = told["laws"]
    assert row["causes"]["collided"] > 0
    assert row["lowest_p5"] < 0 < row["box_z_p95"]


def test_a_long_command_tells_how_far_it_is_without_a_terminal(monkeypatch, capsys):
    """Runs that an earlier command flew cost no time, and a count does not pay for the pace of the one before it."""
    told = [  # time, task, done, and the time left that one can know
        (0.0, "lqr on ideal", 100, None), (5.0, "lqr on ideal", 200, None),
        (40.0, "lqr on ideal", 300, "2 min"),  # 200 in 40 s
        (3600.0, "lqr on ideal", 1000, None), (3600.0, "lqr on noise", 0, ""), (3620.0, "lqr on noise", 200, None),
        (3640.0, "lqr on noise", 400, "60 s"), (3650.0, "drawing a", 400, None), (3680.0, "drawing b", 500, "80 s"),
    ]  # fmt: skip
    clock = iter([0.0, *(now for now, *_ in told)])
    monkeypatch.setattr(terminal.time, "monotonic", lambda: next(clock))
    tell = terminal.lines(terminal.complaints())
    for _, task, done, _ in told:
        tell(task, done, 1000)
    expected = [
        f"{task}: {done} of 1000 done" + (f", about {left} left" if left else "")
        for _, task, done, left in told
        if left is not None
    ]
    assert capsys.readouterr().err.splitlines() == expected


def test_help_says_whether_a_command_writes_a_folder_or_a_file():
    kinds = {}
    for name, command in app.commands.items():
        for option in command.params:
            if "-o" in option.opts:
                kinds[name] = metavar = option.make_metavar(click.Context(command))
                default = option.default if isinstance(option.default, str) else ""
                assert metavar == ("FILE" if Path(default).suffix or name == "vehicles" else metavar)
                assert ("folder" in option.help.lower()) == (metavar != "FILE"), name
    files = {"identify", "map", "plan", "replay", "movie", "vehicles"}
    assert {name for name, kind in kinds.items() if kind == "FILE"} == files
    assert {name for name, kind in kinds.items() if kind == "STORE"} == {"sweep"}
    assert {"run", "check", "compare", "figures", "tune"} <= {name for name, kind in kinds.items() if kind == "DIR"}


@pytest.mark.parametrize("name", ["compare", "check", "map"])
def test_help_names_every_plant_that_a_command_takes(call, name):
    (option,) = (each for each in app.commands[name].params if each.name == "plant")
    known = [one for one in PRESETS if (name, one) != ("check", "ideal")]
    assert re.findall("|".join(PRESETS), option.help) == known
    assert all(one in call("run", "--help")[1] for one in PRESETS)


def test_compiled_c_is_not_called_python(call, tmp_path, monkeypatch):
    text = 'vehicle = "hehn2011"\nduration = 0.1\nlaw.name = "lqr"\nstart = { y = [0.0, 0.0, 1.0] }\n'
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    monkeypatch.setattr(runfile, "_controller", lambda law, *_: dataclasses.replace(STEPPED, name=f"{law.name}-c"))
    assert "step by step in Python" in call("run", "own.toml", "--no-figures")[2]
    assert call("run", "own.toml", "--no-figures", "--controller", "c")[2] == ""


def test_the_gains_of_all_laws_fit_100_columns_in_a_pipe(tmp_path):
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    command = [sys.executable, "-m", "flypend", "laws"]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
    assert max(len(line.rstrip()) for line in done.stdout.splitlines()) <= 100
    for name in ("detuned", "plan", "nmpc"):
        assert f"\n{name}: " in done.stdout


def test_the_goal_is_not_mistaken_for_a_law(call, tmp_path):
    text = 'vehicle = "hehn2011"\nduration = 0.1\nlaw.name = "lqr"\nstart = { y = [0.0, 0.0, -1.0] }\n'
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    _, told, _ = call("run", "own.toml", "--no-figures")
    law, goal = told.splitlines()[:2]
    assert law.startswith("lqr on hehn2011: ")
    assert goal.startswith("Goal: inverted hover not reached (")
    assert "\nGoal: inverted hover not reached (" in (tmp_path / "run-out" / "report.md").read_text(encoding="utf-8")


def test_a_law_of_the_paper_aims_at_a_hanging_rod(call):
    _, told, _ = call("run", "1", "--law", "corrected", "--set", "duration=15", "--no-figures")
    assert re.search(r"^Goal: hanging rod reached after \d+\.\d\d s, vehicle fell \d+ m, ", told, flags=re.MULTILINE)


def test_progress_cannot_be_taken_for_a_result():
    for rate in (False, True):
        on = Console(file=io.StringIO(), force_terminal=True, width=100)
        with progress_bar(on, rate=rate) as shown:
            shown.add_task("flying inverted", total=1200, completed=1200)
        assert "1,200 of 1,200 done" in on.file.getvalue()
        assert "1200/1200" not in on.file.getvalue()


def test_what_is_left_behind_names_its_law_relative_to_itself(call, tmp_path):
    """So that a folder of results can be moved together with the law."""
    (tmp_path / "here" / "laws").mkdir(parents=True)
    text = "import flypend as fp\ndef fall(t, state, vehicle): return fp.Wrench(vehicle.weight / 2, 0 * state.omega)"
    (tmp_path / "here" / "laws" / "own.py").write_text(text, encoding="utf-8")
    asked = ("--law", "here/laws/own.py:fall", "--runs", "1", "--duration", "1", "-o", "here/out")
    assert call("compare", *asked)[0] == 0
    (tmp_path / "here").rename(tmp_path / "there")
    left = tmp_path / "there" / "out" / "failed" / "fall-0.toml"
    assert str(tmp_path) not in left.read_text(encoding="utf-8")
    assert call("run", str(left), "--no-figures")[0] == 0


def test_the_basin_is_that_of_the_library(call, tmp_path):
    code, told, _ = call("theorem", "--basin", "--runs", "25", "--seed", "5", "-o", "out")
    found = measure_basin(fp.vehicle("hehn2011"), 25, 5)
    assert code == 0
    assert json.loads((tmp_path / "out" / "basin.json").read_text(encoding="utf-8")) == dataclasses.asdict(found)
    assert f"{found.entered} of 25 random starts" in told


def test_a_basin_on_a_hub_is_asked_for_by_options(call, tmp_path):
    code, told, _ = call("theorem", "--basin", "--mount", "hub", "--hanging", "--runs", "10", "-o", "out")
    assert code == 0
    found = json.loads((tmp_path / "out" / "basin.json").read_text(encoding="utf-8"))
    assert (found["mount"], found["starts"], found["entered"]) == ("hub", "hanging", 10)
    assert "10 of 10 hanging starts" in told
