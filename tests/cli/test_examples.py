"""What people try first works as it stands: the examples, the Python of the README, its commands and its links."""

import ast
import inspect
import re
import runpy
import shlex
import sys
from pathlib import Path

import numpy as np
import pytest
from click import ClickException

import flypend as fp
from flypend.cli import app as cli
from flypend.cli.installation import read_shipped
from flypend.flight.metrics import metrics
from flypend.flight.simulate import fly
from flypend.settings.runfile import run_file
from flypend.studies import law_named
from tests.few import slow

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
EXAMPLES = Path(fp.__file__).parent / "examples"
TOML = sorted(EXAMPLES.rglob("*.toml"))
OWN = sorted(EXAMPLES.rglob("*.py"))
RUNS = [path for path in TOML if path.parent == EXAMPLES]
VEHICLE = fp.vehicle("hehn2011")


@pytest.fixture
def at_home(tmp_path, monkeypatch):
    """In a folder with the examples, as a reader who types the commands; what is imported from there is forgotten."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    cli.app(["examples"], standalone_mode=False)
    yield
    for name in [name for name in sys.modules if name.split(".")[0] == "examples"]:
        del sys.modules[name]


# Files to run ---------------------------------------------------------------------------------------------------------


def test_there_are_examples_and_all_are_found():
    assert {str(name) for name in read_shipped()} == {p.relative_to(EXAMPLES).as_posix() for p in TOML + OWN}
    assert "swing-up.toml" in {path.name for path in TOML}
    assert "my_law.py" in {path.name for path in OWN}


@pytest.mark.parametrize("path", RUNS, ids=lambda path: path.name)
def test_a_file_builds_a_flight_and_flies(path):
    run = fly(run_file(str(path), ["duration=0.3"]).flight)
    assert (run.outcome.status, run.t[-1]) == ("completed", pytest.approx(0.3))
    assert run_file(str(path)).flight.duration > 1  # shortened here only


def test_the_swing_up_swings_up_and_has_limits():
    chosen = run_file(str(EXAMPLES / "swing-up.toml")).flight
    np.testing.assert_array_equal(chosen.starts.y, [0, 0, -1])
    run = fly(chosen)
    judged = metrics(run)
    assert judged.success
    assert judged.peak_force <= chosen.vehicle.rotor_limits[1] + 1e-9
    # Negative control: the law of the paper does not, from the same start.
    paper = ["law.name=corrected", "start.y=[0.0, 0.0, 1.0]"]  # the same pose with e₃ down
    hanging = fly(run_file(str(EXAMPLES / "swing-up.toml"), paper).flight)
    assert metrics(hanging).cause == "rod"


def test_the_other_plant_that_the_swing_up_names_flies_as_well():
    pytest.importorskip("mujoco")
    assert '"mujoco" flies it in MuJoCo' in (EXAMPLES / "swing-up.toml").read_text(encoding="utf-8")
    run = fly(run_file(str(EXAMPLES / "swing-up.toml"), ["plant=mujoco", "duration=0.1"]).flight)
    assert run.outcome.status == "completed"


# The command that writes them -----------------------------------------------------------------------------------------


def write(*arguments):
    cli.app(["examples", *arguments], standalone_mode=False)


def test_the_examples_are_written_and_nothing_else_is_touched(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").mkdir()
    (tmp_path / "examples" / "mine.toml").write_text("mine", encoding="utf-8")
    write()
    write()  # what is there already is left as it is
    found = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()}
    assert found == {f"examples/{name}" for name in read_shipped()} | {"examples/mine.toml"}
    for name, source in read_shipped().items():
        assert (tmp_path / "examples" / name).read_bytes() == source.read_bytes()


def test_a_file_that_differs_is_replaced_only_if_asked(tmp_path):
    changed = tmp_path / "out" / "my_law.py"
    write("--out", str(tmp_path / "out"))
    changed.write_text("# mine now", encoding="utf-8")
    (tmp_path / "out" / "swing-up.toml").unlink()
    with pytest.raises(fp.InputError, match=rf"^{re.escape(str(changed))}: expected .*--force"):
        write("--out", str(tmp_path / "out"))
    assert changed.read_text(encoding="utf-8") == "# mine now"
    assert not (tmp_path / "out" / "swing-up.toml").exists()  # nothing is written if not all is
    write("--out", str(tmp_path / "out"), "--force")
    assert changed.read_bytes() == (EXAMPLES / "my_law.py").read_bytes()


# A law of one's own ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("direction", [0.0, 2.0, 4.0])
def test_the_law_of_ones_own_balances_a_tilt(at_home, direction):
    law = law_named("examples/my_law.py:balance")
    tilt = np.array([np.sin(0.2) * np.cos(direction), np.sin(0.2) * np.sin(direction), np.cos(0.2)])
    run = fp.simulate(VEHICLE, law, fp.State(y=tilt), 12.0, plant="rotors")
    assert metrics(run).success
    assert run.law == "balance"


def test_the_law_of_ones_own_does_not_swing_up_as_it_says(at_home):
    law = law_named("examples/my_law.py:balance")
    assert "does not swing up" in inspect.getdoc(law.control.function.function)
    for y in ((0, 0, -1), (np.sin(0.1), 0, -np.cos(0.1))):
        judged = metrics(fp.simulate(VEHICLE, law, fp.State(y=y), 6.0, plant="rotors"))
        assert judged.cause in ("rod", "diverged")


def test_the_law_of_ones_own_is_as_short_as_it_is_said_to_be():
    function = ast.parse((EXAMPLES / "my_law.py").read_text(encoding="utf-8")).body[-1]
    assert isinstance(function, ast.FunctionDef)
    assert function.end_lineno - function.lineno < 10  # the README says ten lines


# Manoeuvres -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["cube", "door", "slalom", "poke", "circle", slow("low"), slow("eight")])
def test_a_manoeuvre_is_flown_as_it_is_described(at_home, name):
    own = runpy.run_path("examples/manoeuvres.py")
    start, wishes = own["MANOEUVRES"][name]
    plan, run = own["fly"](name)
    assert metrics(run).success
    # Past waypoints a thousand iterations end with a plan that keeps them, but not quite at an optimum.
    assert plan.status == ("feasible" if name == "slalom" else "converged")
    upright = run.y[:, 2].min() > 0
    assert upright == (name not in ("cube", "low"))
    tips = np.abs([run.x, run.x + VEHICLE.reach * run.y])
    if name == "cube":
        assert tips.max() < 0.5 + 0.005  # feedback leaves the plan by millimetres
    elif name in ("door", "low"):
        assert own[name.upper()].room(run.states, VEHICLE).min() > 0
    elif name == "slalom":
        for point in wishes["waypoints"]:
            assert np.linalg.norm(run.x - point, axis=1).min() < 0.03
    elif name in ("circle", "eight"):
        assert metrics(run).excursion < 0.12  # off the path
        law = fp.simulate(VEHICLE, fp.laws.inverted(wishes["path"]), start, 4.0, plant="rotors")
        assert law.y[:, 2].min() < 0
    else:
        law = fp.simulate(VEHICLE, fp.laws.inverted(), start, 6.0)
        assert law.y[:, 2].min() < -0.9  # which lets the rod fall


@pytest.mark.slow  # its plans are those of "poke", more of them
def test_the_worst_blow_is_flown():
    """It is level, on the bob: lighter ones, or those on the vehicle, take less; and the law drops the rod."""
    own = runpy.run_path(str(EXAMPLES / "manoeuvres.py"))
    plan, run = own["fly"]("worst")
    start = fp.State.from_packed(run.packed[0])
    np.testing.assert_array_equal(start.x_dot, 0)
    assert metrics(run).success
    assert run.y[:, 2].min() > 0
    on_vehicle = fp.plan(VEHICLE, own["hit"](own["BLOW"], "vehicle", np.array([1.0, 0, 0])), lean=np.pi / 2)
    assert on_vehicle.excursion < 0.1 * plan.excursion
    law = fp.simulate(VEHICLE, fp.laws.inverted(), start, 6.0)
    assert law.y[:, 2].min() < -0.9


# The README -----------------------------------------------------------------------------------------------------------


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", README, flags=re.MULTILINE | re.DOTALL)


def test_the_python_of_the_readme_runs_as_it_stands(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (code,) = blocks("python")
    names = {}
    exec(compile(code, "README.md", "exec"), names)
    run = names["run"]
    assert run.outcome.status == "completed"
    assert metrics(run).success
    told = capsys.readouterr().out
    assert told == "completed at 6 s\n"
    np.testing.assert_allclose(run.y[-1], [0, 0, 1], atol=0.05)
    assert {path.name for path in tmp_path.iterdir()} == {"swing-up.nc", "swing-up.html"}
    np.testing.assert_array_equal(fp.load("swing-up.nc").y, run.y)


def test_the_python_of_the_page_of_flights_runs(capsys):
    page = (ROOT / "docs" / "flight" / "flights.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(.*?)^```$", page, flags=re.MULTILINE | re.DOTALL)
    exec(compile(code, "flights.md", "exec"), {})
    assert capsys.readouterr().out.startswith("completed at 6 s 1.0 ")


def commands():
    """Every line of flypend that the README or an example tells one to type."""
    sources = [README, *(path.read_text(encoding="utf-8") for path in TOML + OWN)]
    lines = [line for text in sources for line in re.findall(r"^    (flypend .*)$", text, flags=re.MULTILINE)]
    lines += [line for text in sources for line in re.findall(r"`(flypend [^`]*)`", text)]
    lines += [
        line.rstrip('".') for text in sources for line in re.findall(r"^(?:#|\"\"\").*?: (flypend .*)$", text, re.M)
    ]
    return lines


def parsed(line):
    """Name and parameters of a command line, as the command itself would get them; raises what it would."""
    _, *arguments = shlex.split(line.split(" > ")[0], comments=True)  # a shell redirects
    group = cli.app
    with group.make_context("flypend", list(arguments)) as context:
        name, command, rest = group.resolve_command(context, arguments)
        with command.make_context(name, rest, parent=context) as inner:
            return name, inner.params


def test_commands_are_found():
    found = {shlex.split(line, comments=True)[1] for line in commands()}
    assert {"run", "compare", "check", "export-c"} <= found
    assert len(commands()) >= 6
    assert any(line.startswith("flypend run examples/swing-up.toml --out") for line in commands())
    assert any("examples/my_law.py:balance --law inverted --runs 20" in line for line in commands())


@pytest.mark.parametrize("line", commands())
def test_a_command_that_is_named_can_be_typed(at_home, line):
    """Its options exist and take such values, its files and laws are there."""
    name, options = parsed(line)
    if name == "run":
        chosen = run_file(options["what"], options["override"] or ()).flight
        assert chosen.duration > 0
    laws = options.get("law") or ()
    for law in [laws] if isinstance(laws, str) else laws:
        assert law_named(law).bind(VEHICLE)


def commands_of_pages():
    """Lines of flypend that a page in docs tells one to type, but for those that leave something out."""
    pages = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs").rglob("*.md"))]
    return sorted({line for text in pages for line in re.findall(r"^    (flypend [^…\n]*)$", text, flags=re.MULTILINE)})


@pytest.mark.parametrize("line", commands_of_pages())
def test_a_command_of_a_page_can_be_typed(at_home, line):
    """Its options exist and take such values; files may be the reader's own."""
    assert len(commands_of_pages()) >= 8
    parsed(line)


@pytest.mark.parametrize("line", ["flypend ladder --step 1", "flypend fly", "flypend compare --runs many"])
def test_a_command_that_cannot_be_typed_is_noticed(line):
    with pytest.raises(ClickException):
        parsed(line)


def test_the_targets_of_make_that_are_named_exist():
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), flags=re.MULTILINE))
    named = set(
        re.findall(
            r"\bmake ([\w-]+)", "\n".join([*re.findall(r"^    (.*)$", README, re.M), *re.findall(r"`([^`]*)`", README)])
        )
    )
    assert named
    assert named <= targets


DOCUMENTS = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_what_a_document_links_to_exists(path):
    text = path.read_text(encoding="utf-8")
    links = [link.split("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in link]
    missing = [link for link in links if link and not (path.parent / link).exists()]
    assert not missing
    assert links or path.name != "README.md"


def test_files_that_the_readme_names_exist():
    named = set(re.findall(r"\b((?:docs|examples|src|tests|shared)/[\w./-]*\w)", README))
    assert {"examples/my_law.py", "docs/paper/errata.md"} <= named
    places = [EXAMPLES.parent / name if name.startswith("examples/") else ROOT / name for name in named]
    assert not [place for place in places if not place.exists()]
