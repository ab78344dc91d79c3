"""A law of the package is added by its file and a line in laws/by_name.py, as CONTRIBUTING.md says."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import flypend as fp

LAW = """
from flypend.laws.gain import Gain, table
from flypend.laws.law import Law
from flypend.model import Wrench

GAINS = table((Gain("damping", 0.1, "N m s", "Rate damping"),))


def _control(t, state, vehicle, gains):
    return Wrench(vehicle.weight, -gains.damping * state.omega)


def tame(**gains):
    return Law(name="tame", e3="up", gains=GAINS, given=gains, control=_control)
"""


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A copy of the sources with another law in it."""
    folder = tmp_path_factory.mktemp("package")
    shutil.copytree(Path(fp.__file__).parent, folder / "flypend", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "flypend" / "laws" / "tame.py").write_text(LAW, encoding="utf-8")
    named = folder / "flypend" / "laws" / "by_name.py"
    text = named.read_text(encoding="utf-8")
    text = text.replace("\n\nFACTORIES", "\nfrom flypend.laws.tame import tame\n\nFACTORIES", 1)
    text = text.replace('    "lqr": lqr,\n', '    "lqr": lqr,\n    "tame": tame,\n', 1)
    named.write_text(text, encoding="utf-8")
    return folder


def call(package, folder, *arguments):
    environment = {**os.environ, "PYTHONPATH": str(package), "NO_COLOR": "1"}
    done = subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_python_and_commands_know_it(package, tmp_path):
    flown = "fp.simulate(fp.vehicle('hehn2011'), fp.laws.tame(damping=0.2), fp.State(y=(0, 0, 1)), 0.1)"
    told = call(package, tmp_path, "-c", f"import flypend as fp; print({flown}.law, 'tame' in fp.laws.__all__)")
    assert told.split() == ["tame", "True"]
    assert "Rate damping" in call(package, tmp_path, "-m", "flypend", "laws")
    asked = ("compare", "--law", "tame", "--runs", "1", "--duration", "1")
    compared = call(package, tmp_path, "-m", "flypend", *asked)
    assert " tame " in compared


@pytest.mark.parametrize("name", ["nmpc", "track", "plan_and_track"])
def test_laws_that_plan_are_among_the_laws(name):
    assert getattr(fp.laws, name) is getattr(fp, name)


def test_what_is_no_law_is_no_attribute():
    with pytest.raises(AttributeError, match="nope"):
        _ = fp.laws.nope
