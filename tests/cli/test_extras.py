"""What is not installed is told in one line, before anything is flown; and the lists of what installs are complete."""

import ast
import json
import re
import sys
import tomllib
from pathlib import Path
from urllib.parse import quote

import pytest
from packaging.requirements import Requirement
from packaging.version import Version

import flypend as fp
from flypend import errors
from flypend.compile.llvm import jit

ROOT = Path(__file__).parents[2]
SOURCE = Path(fp.__file__).parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
STUDY = 'vehicle = "nayak2018"\nduration = 1.0\nruns = 10\nlaw = {{ name = "corrected" }}\n{more}'

# Distributions whose modules have another name.
MODULES = {"imageio-ffmpeg": "imageio_ffmpeg", "mcap-ros2-support": "mcap_ros2", "pillow": "PIL", "tomli-w": "tomli_w"}


def modules_of(requirements):
    names = [re.match(r"[\w.-]+", requirement)[0].lower() for requirement in requirements]
    return {MODULES.get(name, name) for name in names}


BASE = modules_of(PROJECT["dependencies"])
EXTRAS = {name: modules_of(listed) for name, listed in PROJECT["optional-dependencies"].items() if name != "all"}


@pytest.fixture
def call(call, monkeypatch, capsys):
    """The command in an empty folder, in which nothing may be flown: its code, and the lines of its complaints."""

    def flown(*_args, **_kwargs):
        pytest.fail("something was flown first")

    monkeypatch.setattr(jit.Native, "__call__", flown)  # whatever is flown by machine code

    def run(*arguments):
        code, _, said = call(*arguments)
        return code, said.splitlines()

    run.complaints = lambda: capsys.readouterr().err.splitlines()
    return run


@pytest.mark.parametrize(
    ("line", "module", "extra", "field"),
    [
        ("run 4 --quick --set plant=mujoco", "mujoco", "mujoco", "plant"),
        ("compare --plant mujoco", "mujoco", "mujoco", "plant"),
        ("plan --fly mujoco", "mujoco", "mujoco", "plant"),
        ("ladder --rung MuJoCo", "mujoco", "mujoco", "plant"),
        ("sweep study.toml -o s.zarr", "zarr", "studies", "sweep"),
        ("sweep study.toml -o s.zarr", "xarray", "studies", "sweep"),
        ("sweep study.toml -o s.zarr --scheduler tcp://a:1", "distributed", "studies", "sweep"),
        ("sweep sobol.toml -o s.zarr", "scipy", "studies", "sampling"),
        ("map --law lqr", "zarr", "studies", "map"),
        ("map study.toml", "scipy", "studies", "map"),
        ("map s.zarr", "xarray", "studies", "map"),
        ("tune study.toml", "cma", "studies", "tune"),
        ("lab --no-browser", "tornado", "lab", "lab"),
    ],
)
def test_a_command_names_the_extra_that_it_needs(call, tmp_path, monkeypatch, line, module, extra, field):
    tune = "[vary.start]\ny = 'uniform'\n[tune.gains]\nk_d = [0.3, 5.0]\n"
    (tmp_path / "study.toml").write_text(STUDY.format(more=tune), encoding="utf-8")
    (tmp_path / "sobol.toml").write_text(STUDY.format(more="sampling = 'sobol'\n" + tune), encoding="utf-8")
    before = sorted(path.name for path in tmp_path.iterdir())
    monkeypatch.setitem(sys.modules, module, None)
    for name in [name for name in sys.modules if name.startswith("flypend.lab")]:
        monkeypatch.delitem(sys.modules, name)
    code, told = call(*line.split())
    wanted = f"the extra {extra} (pip install -e '{ROOT}[{extra}]')"  # as these tests have it installed
    assert (code, told) == (2, [f"flypend: {field}: expected {wanted}, got no module {module}"])
    assert sorted(path.name for path in tmp_path.iterdir()) == before


def test_a_flight_is_noticed(call):
    """Negative control: what has all it needs does fly."""
    with pytest.raises(pytest.fail.Exception, match="flown first"):
        call("run", "4", "--quick")


def test_functions_name_the_extra_that_they_need(monkeypatch):
    vehicle, law, start = fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1))
    run = fp.simulate(vehicle, law, start, 0.1, plant="ideal")
    for module in ("xarray", "scipy", "mujoco"):
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(fp.InputError, match=r"^to_xarray: expected the extra studies "):
        run.to_xarray()
    with pytest.raises(fp.InputError, match=r"^engine: expected the extra studies "):
        fp.simulate(vehicle, law, start, 0.1, plant="ideal", engine="scipy")
    with pytest.raises(fp.InputError, match=r"^plant: expected the extra mujoco "):
        fp.simulate(vehicle, law, start, 0.1, plant="mujoco")


@pytest.fixture
def installed_from(tmp_path, monkeypatch):
    """Return a function that lets flypend look as if it were installed from a direct URL, or None: from an index."""

    def put(origin):
        info = tmp_path / "site" / "flypend-0.3.0.dist-info"
        info.mkdir(parents=True)
        needs = "".join(
            f"Requires-Dist: {text}\n"
            for text in (
                "numpy>=1.26; extra == 'studies'",  # one that is there
                'nowhere>=3; extra == "studies"',
                "not-there>=1,<2 ; python_version >= '3.9' and extra == 'studies'",
                "absent>=1; extra == 'studies-more'",
            )
        )
        text = f"Metadata-Version: 2.4\nName: flypend\nVersion: 0.3.0\n{needs}\n"
        (info / "METADATA").write_text(text, encoding="utf-8")
        if origin is not None:
            (info / "direct_url.json").write_text(json.dumps(origin), encoding="utf-8")
        monkeypatch.syspath_prepend(str(tmp_path / "site"))

    return put


MISSING = "pip install 'nowhere>=3' 'not-there>=1,<2'"


@pytest.mark.parametrize(
    ("origin", "command"),
    [
        ({"url": "HERE", "dir_info": {}}, "pip install '.[studies]'"),
        ({"url": "HERE", "dir_info": {"editable": True}}, "pip install -e '.[studies]'"),
        ({"url": "HERE/a clone", "dir_info": {}}, "pip install 'HERE/a clone[studies]'"),
        ({"url": "HERE/flypend-0.3.0.whl", "archive_info": {}}, "pip install 'HERE/flypend-0.3.0.whl[studies]'"),
        ({"url": "HERE/gone.whl", "archive_info": {}}, MISSING),
        ({"url": "https://a.b/flypend.whl", "archive_info": {}}, MISSING),
        (
            {"url": "https://a.b/flypend", "vcs_info": {"vcs": "git", "commit_id": "c0ffee"}},
            "pip install 'flypend[studies] @ git+https://a.b/flypend@c0ffee'",
        ),
        ({}, MISSING),
        (None, MISSING),
    ],
)
def test_the_command_that_adds_an_extra_fits_the_installation(installed_from, tmp_path, monkeypatch, origin, command):
    (tmp_path / "a clone").mkdir()
    (tmp_path / "flypend-0.3.0.whl").touch()
    monkeypatch.chdir(tmp_path)
    if origin and origin["url"].startswith("HERE"):
        origin = {**origin, "url": tmp_path.as_uri() + quote(origin["url"].removeprefix("HERE"))}
    installed_from(origin)
    assert errors.install_command("studies") == command.replace("HERE", str(tmp_path))


def test_a_run_leaves_the_movies_out_and_says_so(call, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    wanted = [f"flypend: without movies: needs the extra movies (pip install -e '{ROOT}[movies]')"]
    for line in ("run 4", "paper"):
        with pytest.raises(pytest.fail.Exception, match="flown first"):  # it goes on
            call(*line.split())
        assert call.complaints() == wanted
    for line in ("run 4 --quick", "run 4 --no-figures", "paper --quick"):
        with pytest.raises(pytest.fail.Exception, match="flown first"):
            call(*line.split())
        assert call.complaints() == []
    code, told = call("run", "missing.toml")  # the mistake that is there, not the extra
    assert (code, len(told)) == (2, 1)
    assert "missing.toml" in told[0]


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """A run in a file."""
    path = tmp_path_factory.mktemp("saved") / "run.nc"
    fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.05, plant="ideal").save(path)
    return path


def test_a_movie_names_its_extra_and_a_file_that_is_missing_first(saved, call, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    code, (line,) = call("movie", "nowhere.nc")
    assert (code, line.startswith("flypend: nowhere.nc: ")) == (2, True)
    code, (line,) = call("movie", str(saved))
    assert (code, line.startswith("flypend: movie: expected the extra movies (")) == (2, True)
    assert not list(tmp_path.iterdir())


def test_a_ladder_leaves_a_rung_out_and_says_so(call, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(pytest.fail.Exception, match="flown first"):
        call("ladder", "--runs", "1")
    wanted = f"flypend: without the rung MuJoCo: needs the extra mujoco (pip install -e '{ROOT}[mujoco]')"
    assert call.complaints() == [wanted]


def test_what_is_installed_is_not_complained_about_and_not_imported(monkeypatch):
    monkeypatch.delitem(sys.modules, "this", raising=False)
    errors.require("this", extra="none", for_="nothing")
    assert "this" not in sys.modules


# What installs ------------------------------------------------------------------------------------------------------


def _imports(text):
    """(module, whether a function asks for it) of each import of a source, but for those that only types need."""
    tree = ast.parse(text)
    typing = [node for node in ast.walk(tree) if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)]
    late = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    inside = {id(child) for node in late for child in ast.walk(node)}
    skipped = {id(child) for node in typing for child in ast.walk(node)}
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        names += [node.module] if isinstance(node, ast.ImportFrom) and node.module else []
        yield from ((name.split(".")[0], id(node) in inside) for name in names)


# What comes with another package of an extra: dask with distributed, pandas with xarray.
BROUGHT = {"dask", "pandas"}
# What an example shows beside flypend.
THEIRS = {
    "examples/gradient.py": "torch",
    "examples/train.py": "stable_baselines3",
    "envs/sb3.py": "stable_baselines3",
    "export/templates/crazyflie/flypend_host.py": "cflib",
}


def _missing(sources):
    """What the sources import and the lists of pyproject.toml lack; an extra may be imported inside a function only."""
    extras = set().union(*EXTRAS.values(), BROUGHT)
    late_rooms = (
        "lab/",
        "envs/",
        "examples/train.py",
        "flight/integrate.py",
        "laws/certificate.py",
    )  # imported where the extra has been asked for
    for path, text in sources.items():
        for module, late in _imports(text):
            own = module in sys.stdlib_module_names or module == "flypend" or module in BASE
            # mpl_toolkits comes with matplotlib.
            if (
                not own
                and module != THEIRS.get(path)
                and module != "mpl_toolkits"
                and not (module in extras and (late or path.startswith(late_rooms)))
            ):
                yield f"{path} imports {module}"


def test_everything_that_is_imported_is_listed():
    sources = {path.relative_to(SOURCE).as_posix(): path.read_text("utf-8") for path in SOURCE.rglob("*.py")}
    assert not list(_missing(sources))


@pytest.mark.parametrize(
    "text", ["import polars", "def f():\n    import polars", "from scipy.integrate import DOP853", "import xarray"]
)
def test_what_is_not_listed_is_found(text):
    assert len(list(_missing({"flight/new.py": text}))) == 1


def test_the_extras_that_are_named_bring_the_modules():
    asked = {}
    for path in SOURCE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] == "require":
                extra = next(keyword.value.value for keyword in node.keywords if keyword.arg == "extra")
                if isinstance(node.args[0], ast.Constant):
                    asked.setdefault(extra, set()).add(node.args[0].value)
    assert set(asked) == set(EXTRAS)
    for extra, modules in asked.items():
        assert modules <= EXTRAS[extra] | BROUGHT


def test_the_extra_all_is_all_of_them():
    (everything,) = PROJECT["optional-dependencies"]["all"]
    assert set(re.search(r"\[(.*)\]", everything)[1].split(",")) == set(EXTRAS)


def _bounds(requirements):
    """(name, version) of each lower bound that a list of requirements names for this Python."""
    found = [Requirement(text) for text in requirements]
    here = [wanted for wanted in found if wanted.marker is None or wanted.marker.evaluate()]
    for wanted in here:
        (bound,) = wanted.specifier
        assert bound.operator == ">=", wanted
        yield wanted.name, Version(bound.version)


def test_the_oldest_versions_that_are_flown_are_the_bounds():
    """Where a package has two bounds, the second is for newer Pythons and the larger one."""
    text = (ROOT / "requirements-lowest.lock").read_text(encoding="utf-8")
    pinned = [Requirement(line.rstrip(" \\")) for line in re.findall(r"^[\w.-]+==.*$", text, re.MULTILINE)]
    here = {
        pin.name: Version(next(iter(pin.specifier)).version)
        for pin in pinned
        if not pin.marker or pin.marker.evaluate()
    }
    extras = PROJECT["optional-dependencies"]
    listed = [
        *PROJECT["dependencies"],
        *(text for name in extras if name != "all" for text in extras[name]),
    ]
    bounds = {}
    for name, version in _bounds(listed):
        bounds[name] = max(version, bounds.get(name, version))
    assert {"casadi", "numpy", "zarr", "mujoco"} <= set(bounds)
    # A bound of "xarray>=2024.11" means 2024.11.0; where no such release is, the next one.
    late = {
        name: (version, here[name])
        for name, version in bounds.items()
        if here[name].release[:2] != (*version.release, 0)[:2]
    }
    assert not late


def test_a_system_without_a_fork_has_no_laboratory(call, monkeypatch):
    monkeypatch.setattr("multiprocessing.get_all_start_methods", lambda: ["spawn"])
    code, complaints = call("lab", "--no-browser")
    assert code == 2
    (line,) = complaints
    assert "lab: expected a system that forks processes, or --html" in line
