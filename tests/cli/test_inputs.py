"""Every option of every command with wrong values, and combinations that contradict: one line, code 2, before any work.

Work is what flies, plans, compiles, films or serves: where it would begin, the call ends as accepted.
"""

import importlib
import pkgutil
import time
import tomllib
from pathlib import Path

import click
import pytest

import flypend
import flypend as fp
from flypend.cli.app import app
from flypend.compile.llvm import jit
from flypend.files.toml import toml_text

LONGEST = 20.0  # s of processor time of a command that does no work: other tests run beside it
STUDY = """
vehicle = "nayak2018"
law = { name = "corrected" }
plant = "ideal"
duration = 2.0
runs = 4
[vary.start]
y = "uniform"
[tune.gains]
k_d = [0.3, 5.0]
"""
RUN = 'vehicle = "hehn2011"\nlaw = "inverted"\nduration = 2.0\nstart = { y = [0.0, 0.0, -1.0] }\n'
# A law of the user's own, and what can be wrong with it, by file.
LAW = "from flypend import Wrench\ndef f(t, state, vehicle):\n    return {}\n"
LAWS = {
    "f": "Wrench(vehicle.weight, -state.omega)", "swapped": "Wrench(-state.omega, vehicle.weight)",
    "nan": "Wrench(float('nan'), -state.omega)", "tuple": "(1, 2)", "typo": "Wrench(vehicle.weigt, -state.omega)",
    "raises": "Wrench(1 / 0, -state.omega)", "syntax": "(",
}  # fmt: skip
# What each command needs before its options.
NEEDED = {
    "run": ["run.toml", "--no-figures"], "sweep": ["study.toml", "-o", "s.zarr"], "map": ["study.toml"],
    "tune": ["study.toml"], "check": ["hehn2011"], "replay": ["run.nc"], "movie": ["run.nc"], "figures": ["run.nc"],
    "lab": ["--no-browser"], "export-app": ["crazyflie", "crazyflie"], "identify": ["log.csv", "--rehearse"],
    "vehicle": [
        "new", "--mass", "0.6", "--arm", "0.17", "--propeller", "8x4.5", "--rod-length", "1", "--bob-mass", "0.04",
    ],
}  # fmt: skip
# Where work begins.
WORK = (
    "flypend.flight.simulate.fly", "flypend.flight.ensemble.fly_many", "flypend.studies.compare.fly_each",
    "flypend.studies.ladder.fly_each", "flypend.planning.planner.prepare",
    "flypend.studies.check.fly_tasks", "flypend.studies.sweep.run.fly_range", "flypend.studies.tune.program_digest",
    "flypend.studies.trial.fly_many", "flypend.report.paper.fly_all", "flypend.report.theorem.fly_repaired",
    "flypend.pictures.animate.stage", "flypend.report.flight.figure_tasks",
    "flypend.lab.server.serve", "flypend.lab.standalone.lab_page", "flypend.export.write.interface",
    "flypend.export.app.interface",
)  # fmt: skip
NUMBERS = [
    "x",
    "",
    "nan",
    "inf",
    "-inf",
    "-1",
    "0",
    "1e400",
    "1e30",
    "1e-30",
    "1,5",
    "½",
    "0x10",
    "99999999999999999999",
]
WORDS = ["", "x", "invertd", "a\x01b", "a" * 3000, "🚁", "nan", "../..", ":", "x:y", "none.py:f", ".", "f.py:g", "3"]
PATHS = [
    "",
    "/proc/none/out.nc",
    "a.txt",
    "folder",
    "missing/deep/out.png",
    "n" * 300,
    "dangling",
    "🚁",
    "...",
]


class AcceptedError(Exception):
    """Every check is passed, and work would begin."""


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    path = tmp_path_factory.mktemp("saved") / "run.nc"
    fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0, 0, 1.0)), 0.05).save(path)
    return path.read_bytes()


def files(folder):
    """Every path below a folder with what it holds; bytecode of a law's file apart."""
    return {
        str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
        for path in folder.rglob("*")
        if "__pycache__" not in path.parts
    }


@pytest.fixture(scope="module")
def imported():
    """Every module, so that none is imported while a function is replaced, and keeps what replaces it."""
    for found in pkgutil.walk_packages(flypend.__path__, "flypend."):
        # No command imports the adapter for a library that is not here.
        if not found.name.endswith(("__main__", "envs.sb3")):
            importlib.import_module(found.name)


@pytest.fixture
def attempt(call, saved, imported, tmp_path, monkeypatch):
    """Call a command that does no work. A refusal is one line with code 2 and leaves every file as it was."""

    def accepted(*_args, **_more):
        raise AcceptedError

    for place in WORK:
        module, _, name = place.rpartition(".")
        monkeypatch.setattr(importlib.import_module(module), name, accepted)
    monkeypatch.setattr(jit.Native, "__call__", accepted)
    for name, text in (("study.toml", STUDY), ("run.toml", RUN), ("a.txt", "text")):
        (tmp_path / name).write_text(text, encoding="utf-8")
    for name, answer in LAWS.items():
        (tmp_path / f"{name}.py").write_text(LAW.format(answer), encoding="utf-8")
    (tmp_path / "run.nc").write_bytes(saved)
    (tmp_path / "folder").mkdir()
    (tmp_path / "dangling").symlink_to(tmp_path / "nowhere")

    def tried(*arguments):
        before, begin = files(tmp_path), time.process_time()
        try:
            code, _, told = call(*arguments)
        except AcceptedError:
            code, told = "accepted", ""
        took = time.process_time() - begin
        assert took < LONGEST, f"{arguments} took {took:.1f} s"
        assert "Traceback" not in told, (arguments, told)
        assert code in (0, 1, 2, "accepted"), (arguments, code)
        if code == 2:
            assert told.startswith("flypend: "), (arguments, told)
            assert told.count("\n") == 1, (arguments, told)
            assert len(told) < 8000, arguments
            assert files(tmp_path) == before, (arguments, files(tmp_path).keys() ^ before.keys())
        return code, told

    return tried


def wrong_values(parameter):
    """Values to try for one parameter of a command, each as a list of words."""
    kind = parameter.type
    if isinstance(kind, click.types.Tuple | click.types.CompositeParamType) or parameter.nargs > 1:
        width = parameter.nargs
        yield from ([value] * width for value in NUMBERS)
        yield ["1"] * (width - 1)
        return
    numeric = isinstance(kind, click.types.IntParamType | click.types.FloatParamType)
    values = NUMBERS if numeric else PATHS if isinstance(kind, click.Path) else WORDS
    yield from ([value] for value in values)


OPTIONS = [
    pytest.param(
        name, parameter, id=f"{name} {parameter.opts[0] if parameter.param_type_name == 'option' else parameter.name}"
    )
    for name, command in app.commands.items()
    for parameter in command.params
    if not getattr(parameter, "is_flag", False)
]


@pytest.mark.parametrize(("name", "parameter"), OPTIONS)
def test_wrong_values_of_an_option_are_refused_or_valid(attempt, name, parameter):
    refused = 0
    for values in wrong_values(parameter):
        needed = list(NEEDED.get(name, []))
        if parameter.param_type_name == "argument":
            arguments = [name, *values, *needed[1:]]
        else:
            if "-o" in needed and "-o" in parameter.opts:
                needed = needed[: needed.index("-o")]
            if name == "map" and parameter.name in ("vehicle", "plant", "sensors", "runs", "seed", "duration", "law"):
                needed = [] if parameter.name == "law" else ["--law", "inverted"]
            arguments = [name, *needed, parameter.opts[0], *values]
        refused += attempt(*arguments)[0] == 2
    free = {"title", "host", "font"}  # any text is a title
    assert refused > 0 or parameter.name in free, f"{name} {parameter.opts[0]} takes everything"


def test_every_command_with_its_defaults_is_accepted(attempt):
    """Negative control: it is the wrong value that is refused."""
    for name in app.commands:
        if name not in ("map", "vehicles", "laws", "examples", "tune", "learn", "movie", "figures"):
            code, told = attempt(name, *NEEDED.get(name, []))
            assert code in (0, "accepted"), (name, told)


TABLE = tomllib.loads((Path(__file__).parent / "inputs.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("line", TABLE["lines"], ids=range(len(TABLE["lines"])))
def test_a_wrong_line_names_its_field(attempt, line):
    command, field = line
    code, told = attempt(*command.split())
    assert code == 2, (command, code)
    assert told.startswith(f"flypend: {field}"), (command, told)


@pytest.mark.parametrize(("edit", "field"), TABLE["studies"], ids=range(len(TABLE["studies"])))
def test_a_wrong_study_names_its_field(attempt, tmp_path, edit, field):
    key, _, value = edit.partition(" = ")
    *tables, name = key.split(".")
    settings = table = tomllib.loads(STUDY)
    for inner in tables:
        if not isinstance(table.get(inner), dict):
            table[inner] = {}
        table = table[inner]
    table[name] = tomllib.loads(f"value = {value}")["value"]
    (tmp_path / "study.toml").write_text(toml_text(settings), encoding="utf-8")
    code, told = attempt(
        *(["tune", "study.toml"] if key.startswith("tune") else ["sweep", "study.toml", "-o", "s.zarr"])
    )
    assert code == 2, edit
    assert told.startswith(f"flypend: {field}"), (edit, told)
