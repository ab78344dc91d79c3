"""What the code base promises about itself: one direction of imports, documented arguments, no machine in the files."""

import ast
import dataclasses
import importlib
import importlib.util
import inspect
import re
import shutil
import subprocess
import unicodedata
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import flypend

ROOT = Path(__file__).parents[1]
SOURCE = Path(flypend.__file__).parent

# Imports point one way ------------------------------------------------------------------------------------------

# A module (or package) may import those that stand before it. `flypend` itself, the namespace of public names, stands
# after everything that it imports.
ORDER = [
    "errors",
    "geometry",
    "palette",
    "files",
    "model",
    "laws",
    "compile",
    "plants",
    "board",
    "pages",
    "flight",
    "export",
    "paper",
    "settings",
    "studies",
    "pictures",
    "report",
    "lab",
    "cli",
    "__main__",
]


def _sources():
    """Dotted name of each module below flypend, with its text."""
    sources = {}
    for path in sorted(SOURCE.rglob("*.py")):
        parts = path.relative_to(SOURCE).with_suffix("").parts
        sources[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path.read_text(encoding="utf-8")
    return sources


def _imports(text, modules):
    """Dotted names below flypend that a source imports, also inside functions; "" is flypend itself."""
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative imports hide the direction; write the full name"
            if node.module and node.module.split(".")[0] == "flypend":
                base = node.module.partition(".")[2]
                for alias in node.names:
                    name = f"{base}.{alias.name}".lstrip(".")
                    found.add(name if name in modules else base)
        elif isinstance(node, ast.Import):
            found |= {a.name.partition(".")[2] for a in node.names if a.name.split(".")[0] == "flypend"}
    return found


def _wrong_imports(sources):
    """One message per import against the order, per unknown module, and per cycle."""
    top = {name.split(".")[0] for name in sources} - {""}
    messages = [f"{name} is new: put it into ORDER of tests/test_architecture.py" for name in sorted(top - set(ORDER))]
    rank = {name: place for place, name in enumerate(ORDER)}
    graph = {name: _imports(text, sources) for name, text in sources.items()}
    rank[""] = max((rank.get(target.split(".")[0], 0) for target in graph.get("", ())), default=-1) + 0.5
    for name, targets in graph.items():
        here = name.split(".")[0]
        for target in sorted(targets):
            there = target.split(".")[0]
            if name and here != there and here in rank and there in rank and rank[there] > rank[here]:
                messages.append(f"flypend.{name} imports flypend.{target or '(the namespace)'}, which stands after it")
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        messages.append("cycle: " + " -> ".join(error.args[1]))
    return messages


def test_imports_point_one_way():
    assert not _wrong_imports(_sources())


def test_the_order_names_nothing_twice_and_the_foundation_exists():
    assert len(set(ORDER)) == len(ORDER)
    present = {name.split(".")[0] for name in _sources()}
    assert {"errors", "geometry", "model", "laws", "compile", "flight"} <= present


@pytest.mark.parametrize(
    ("sources", "complaint"),
    [
        ({"geometry": "from flypend.model import State", "model": ""}, "flypend.geometry imports flypend.model"),
        (
            {"model": "def f():\n    import flypend.studies", "studies": ""},
            "flypend.model imports flypend.studies",
        ),
        (
            {"model.state": "from flypend import laws", "laws": "", "model": ""},
            "flypend.model.state imports flypend.laws",
        ),
        ({"model": "from flypend import State", "": "from flypend.flight import simulate"}, "(the namespace)"),
        ({"brand_new": ""}, "brand_new is new"),
        ({"laws": "from flypend.laws.a import A", "laws.a": "from flypend.laws import B"}, "cycle: "),
    ],
)
def test_a_wrong_import_is_found(sources, complaint):
    messages = _wrong_imports(sources)
    assert len(messages) == 1
    assert complaint in messages[0]


def test_relative_imports_are_refused():
    with pytest.raises(AssertionError, match="relative"):
        _imports("from . import errors", {})


# Every public argument is documented ----------------------------------------------------------------------------

PUBLIC = (
    "",
    "geometry",
    "files.whole",
    "model",
    "laws",
    "plants",
    "flight.simulate",
    "flight.trajectory",
    "flight.metrics",
    "flight.ensemble",
    "flight.sensitivity",
    "export",
    "paper",
    "studies",
    "studies.sweep",
    "studies.tune",
    "pictures.stop_motion",
    "pictures.figures",
    "pictures.animate",
    "pictures.maps",
    "lab",
)

# Records of the package: a parameter called as its class in small letters and annotated with it is documented there.
RECORDS = (
    "State", "Vehicle", "Wrench", "Rates", "Law", "Flight", "Trajectory", "Experiment", "Outcome", "Control", "Guard",
)  # fmt: skip

# What a vector (v) and a matrix (m) are stands once, at the head of geometry.py.
ALWAYS_CLEAR = {"flypend.geometry": {"v", "m"}}

GREEK = {"φ": "phi", "ω": "omega", "τ": "tau"}


def _plain(docstring):
    """A docstring in the letters of the code: φ̇_d becomes phi_d_dot, e₃ becomes e3, ẏ becomes y_dot."""
    text = unicodedata.normalize("NFD", docstring)
    for mark, suffix in (("\u0307", "_dot"), ("\u0308", "_ddot")):
        text = re.sub(rf"(\w){mark}(_\w+)?", rf"\1\2{suffix}", text)
    for letter, name in GREEK.items():
        text = text.replace(letter, name)
    return unicodedata.normalize("NFKC", text)


def _where_parameters_stand(docstring):
    """The entries of the section Parameters of a docstring that has one; else the whole docstring."""
    section = re.search(r"^Parameters\n-+\n(.*?)(?=\n\w[^\n]*\n-{3,}\n|\Z)", docstring, re.DOTALL | re.MULTILINE)
    if not section:
        return docstring
    return "\n".join(line for line in section[1].splitlines() if not line.startswith(" "))


def _undocumented(name, thing, *, holder=""):
    """Complaints about a function or class: no docstring, or parameters whose names its docstring does not mention."""
    docstring = inspect.getdoc(thing)
    if not docstring or (dataclasses.is_dataclass(thing) and docstring.startswith(f"{thing.__name__}(")):
        return [f"{name} has no docstring"]
    words = set(re.findall(r"\w+", _plain(_where_parameters_stand(docstring))))
    missing = []
    for parameter in inspect.signature(thing).parameters.values():
        of_record = any(
            parameter.name == record.lower() and re.match(rf"{record}\b", str(parameter.annotation))
            for record in RECORDS
        )
        clear = parameter.name in ALWAYS_CLEAR.get(holder, ()) or parameter.name.startswith("_")
        if not (parameter.name in words or of_record or clear or parameter.name in ("self", "cls")):
            missing.append(f"{name} does not document {parameter.name}")
    return missing


def _complaints(name, thing, holder=""):
    """Complaints about a public object, with the public methods and properties of a class."""
    out = _undocumented(name, thing, holder=holder)
    if inspect.isclass(thing):
        for member, value in vars(thing).items():
            if member.startswith("_"):
                continue
            if isinstance(value, property):
                out += [] if inspect.getdoc(value) else [f"{name}.{member} has no docstring"]
            elif isinstance(value, classmethod | staticmethod) or inspect.isfunction(value):
                function = getattr(thing, member)
                out += _undocumented(f"{name}.{member}", function, holder=holder)
    return out


def _public(module):
    """Functions and classes that a module offers: those it lists, or else those it defines."""
    listed = getattr(module, "__all__", None)
    for name in listed or vars(module):
        thing = getattr(module, name)
        if name.startswith("_") or not (inspect.isclass(thing) or inspect.isfunction(thing)):
            continue
        if thing.__module__.startswith("flypend") if listed else thing.__module__ == module.__name__:
            yield name, thing


def _module_names():
    full = [f"flypend.{name}".rstrip(".") for name in PUBLIC]
    return [name for name in full if importlib.util.find_spec(name)]


@pytest.mark.parametrize("name", _module_names())
def test_every_public_argument_is_documented(name):
    module = importlib.import_module(name)
    assert inspect.getdoc(module)
    found = list(_public(module))
    assert found
    assert not [line for public, thing in found for line in _complaints(f"{name}.{public}", thing, thing.__module__)]


def test_the_walk_reaches_what_it_should():
    assert {"flypend", "flypend.geometry", "flypend.model", "flypend.laws"} <= set(_module_names())
    names = {name for name, _ in _public(flypend)}
    assert {"State", "Vehicle", "Wrench", "Law", "Trajectory", "simulate", "load", "vehicle"} <= names
    assert {"transport", "hat"} <= {name for name, _ in _public(importlib.import_module("flypend.geometry"))}


def test_an_undocumented_argument_is_found():
    @dataclasses.dataclass
    class Bare:
        depth: float

    @dataclasses.dataclass
    class Poor:
        """A thing with a depth."""

        depth: float
        width: float

        def part(self, ratio):
            """Some of it."""

        def silent(self):
            return self

        @property
        def area(self):
            return 0

    def partly(phi_d_dot, e3, y_dot, speed, state: "State", vehicle):  # noqa: F821
        """φ̇_d and ẏ with e₃ up; speedy."""

    def listed(depth, width):
        """Depth and width.

        Parameters
        ----------
        depth : float
            Not the width.

        Raises
        ------
        InputError
            For a width that is negative.
        """

    assert _complaints("listed", listed) == ["listed does not document width"]
    assert _complaints("Bare", Bare) == ["Bare has no docstring"]
    assert _complaints("Poor", Poor) == [
        "Poor does not document width",
        "Poor.part does not document ratio",
        "Poor.silent has no docstring",
        "Poor.area has no docstring",
    ]
    assert _complaints("partly", partly) == ["partly does not document speed", "partly does not document vehicle"]


# Files that travel ----------------------------------------------------------------------------------------------


def _tracked():
    if not (ROOT / ".git").exists() or shutil.which("git") is None:
        pytest.skip("not a git checkout")
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return [ROOT / name for name in listed.split("\0") if name and (ROOT / name).is_file()]


def _text(path):
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return ""


# Home and work folders of machines, written so that this file does not contain what it looks for.
MACHINE_PATH = re.compile(r"(?<![\w.])/(?:" + "|".join(("home", "root", "Users", "work", "mnt")) + r")/\w|\b[A-Z]:\\\w")
ADDRESS = re.compile(r"https?" + r"://|(?<!no-emit-)index-url|find-links")


def test_no_tracked_file_names_a_folder_of_a_machine():
    found = {
        str(path.relative_to(ROOT)): hit.group() for path in _tracked() if (hit := MACHINE_PATH.search(_text(path)))
    }
    assert not found


def test_what_installs_names_no_registry():
    files = [path for path in _tracked() if path.name in ("pyproject.toml", "requirements.lock", "Makefile", "run")]
    assert {"pyproject.toml", "requirements.lock", "Makefile"} <= {path.name for path in files}
    for path in files:
        # A homepage is no registry.
        text = re.sub(r"(?ms)^\[project\.urls\].*?(?=^\[|\Z)", "", _text(path))
        assert not ADDRESS.search(text), path.name


def test_the_searches_find_what_they_look_for():
    for line in ("cd /ho" + "me/me/x", "(/wo" + "rk/main)", '"C:' + "\\" + 'data"'):
        assert MACHINE_PATH.search(line)
    for line in ("a/home/b", "../work/x", "home/x", "/workshop"):
        assert not MACHINE_PATH.search(line)
    for line in ("--index-url x", "htt" + "ps://pypi.example", "--find-links=y"):
        assert ADDRESS.search(line)
    assert not ADDRESS.search("--no-emit-index-url")
