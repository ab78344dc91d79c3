"""What `pip install` brings is complete: a wheel, built and unpacked, runs its commands from an empty folder."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from hatchling.builders.wheel import WheelBuilder

import flypend as fp

ROOT = Path(__file__).parents[1]
SOURCE = Path(fp.__file__).parent


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A folder with nothing in it but the wheel, unpacked as pip unpacks it."""
    folder = tmp_path_factory.mktemp("site")
    (wheel,) = WheelBuilder(str(ROOT)).build(directory=str(folder / "wheel"), versions=["standard"])
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    return folder


@pytest.fixture(scope="module")
def empty(tmp_path_factory):
    """An empty folder, far from the repository."""
    return tmp_path_factory.mktemp("empty")


def call(site, folder, *arguments):
    """What a command of the installed package prints; it succeeds."""
    environment = {**os.environ, "PYTHONPATH": str(site), "NO_COLOR": "1"}
    command = [sys.executable, *arguments]
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def flypend(site, folder, line):
    return call(site, folder, "-m", "flypend", *line.split())


def test_everything_is_in_the_wheel(site):
    """Every file of the package but caches: web bundle, templates, vehicles, examples, tableaus, py.typed."""
    wanted = {
        path.relative_to(SOURCE) for path in SOURCE.rglob("*") if path.is_file() and "__pycache__" not in path.parts
    }
    found = {path.relative_to(site / "flypend") for path in (site / "flypend").rglob("*") if path.is_file()}
    assert found == wanted
    some = {
        "py.typed",
        "pages/web/page.js",
        "vehicles/hehn2011.toml",
        "examples/my_law.py",
    }
    assert {Path(name) for name in some} <= found
    (entries,) = site.glob("*.dist-info/entry_points.txt")
    assert "flypend = flypend.cli:main" in entries.read_text(encoding="utf-8")


def test_it_is_the_wheel_that_runs(site, empty):
    told = call(site, empty, "-c", "import flypend; print(flypend.__file__)")
    assert Path(told.strip()).parents[1] == site
    assert flypend(site, empty, "--version").strip() == f"flypend {fp.__version__}"


def test_commands_run_from_an_empty_folder(site, empty):
    flypend(site, empty, "examples")
    flypend(site, empty, "run examples/swing-up.toml --quick --no-figures --html flight.html --set duration=0.5 -o out")
    flypend(site, empty, "run 1 --no-figures --set duration=0.5 -o one")
    flypend(site, empty, "figures out/run.nc -o figures")
    flypend(site, empty, "replay out/run.nc one/run.nc -o both.html")
    flypend(site, empty, "compare --law examples.my_law:balance --runs 1 --duration 1 -o compared")
    flypend(site, empty, "export-c --law inverted -o flight")
    made = {path.relative_to(empty).as_posix() for path in empty.rglob("*") if path.is_file()}
    assert {
        "examples/swing-up.toml", "examples/studies/hanging.toml", "flight.html", "out/run.nc", "figures/full.pdf",
        "both.html", "compared/report.md", "flight/README.md",
    } <= made  # fmt: skip
    assert "<script" in (empty / "flight.html").read_text(encoding="utf-8")
