"""What the code base promises about itself: one direction of imports, documented arguments, no machine in the files."""

import ast
import dataclasses
import importlib
import importlib.util
import inspect
import re
import shutil
import subprocess
import sys
import unicodedata
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import flypend
from flypend.compile.llvm.jit import ABOVE

ROOT = Path(__file__).parents[1]
SOURCE = Path(flypend.__file__).parent

# Rooms and their direction --------------------------------------------------------------------------------------

# A room (a package) or single module may import those that stand before it. `flypend` itself, the namespace of public
# names, stands after everything that it imports.
ORDER = [
    "signals",
    "registry",
    "building",
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
    "envs",
    "planning",
    "identification",
    "learning",
    "export",
    "paper",
    "settings",
    "studies",
    "pictures",
    "report",
    "lab",
    "cli",
    "selftest",
    "__main__",
]
MOST_SINGLE = 8  # modules directly under src/flypend; the next one belongs in a room

# Folders of data, which nothing imports.
DATA = {"examples", "policies", "vehicles"}

# Who imports modules by names that no reader of the source can know, and which.
COMPUTED = {
    "": "public names, when they are first used",
    "settings.laws": "the law of a user",
}


def _sources():
    """Dotted name of each module below flypend, with its text."""
    sources = {}
    for path in sorted(SOURCE.rglob("*.py")):
        parts = path.relative_to(SOURCE).with_suffix("").parts
        if parts[0] not in DATA:
            sources[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path.read_text(encoding="utf-8")
    return sources


def _below_flypend(name):
    """The dotted name below flypend of a full one: "" for flypend itself, None for what belongs to others."""
    top, _, rest = name.partition(".")
    return rest if top == "flypend" else None


def _named(node):
    """What an argument of `import_module` says: (name, whether all of it is known); None for one that says nothing."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value, True
    if isinstance(node, ast.JoinedStr) and isinstance(node.values[0], ast.Constant):
        fixed = node.values[0].value.rpartition(".")[0]
        return None if fixed == "flypend" else (fixed, False)
    return None


def _importers(tree):
    """Names by which a source calls `importlib.import_module` and `__import__`."""
    renamed = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module == "importlib"]
    aliases = {a.asname or a.name for node in renamed for a in node.names if a.name in ("import_module", "__import__")}
    return aliases | {"import_module", "__import__"}


class _Imports:
    """What a source imports below flypend, also inside functions and through importlib.

    `modules` are whole names, `rooms` the rooms of names that are computed in part ("" is flypend itself), `relative`
    and `computed` the lines of relative imports and of names that cannot be read.
    """

    def __init__(self, text, known):
        self.modules, self.rooms, self.relative, self.computed = set(), set(), [], []
        tree = ast.parse(text)
        importers = _importers(tree)
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                self._from(node, known)
            elif isinstance(node, ast.Import):
                self._add(alias.name for alias in node.names)
            elif isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] in importers:
                self._call(node)

    def _add(self, names):
        self.modules |= {below for name in names if (below := _below_flypend(name)) is not None}

    def _from(self, node, known):
        if node.level:
            self.relative.append(node.lineno)
        elif (base := _below_flypend(node.module)) is not None:
            names = [f"{base}.{alias.name}".lstrip(".") for alias in node.names]
            self.modules |= {name if name in known or name.split(".")[0] in DATA else base for name in names}

    def _call(self, node):
        keywords = [keyword.value for keyword in node.keywords if keyword.arg == "name"]
        named = _named([*node.args, *keywords][0])
        if named is None:
            self.computed.append(node.lineno)
        elif named[0].startswith("."):
            self.relative.append(node.lineno)
        elif named[1]:
            self._add([named[0]])
        elif (below := _below_flypend(named[0])) is not None:
            self.rooms.add(below.split(".")[0])


def _wrong_imports(sources):
    """One message per import against the order, relative or unreadable, per unknown module, and per cycle."""
    rank = {name: place for place, name in enumerate(ORDER)}
    top = {name.split(".")[0] for name in sources} - {""}
    messages = [f"{name} is new: put it into ORDER of tests/test_architecture.py" for name in sorted(top - set(ORDER))]
    found = {name: _Imports(text, sources) for name, text in sources.items()}
    if "" in found:
        rank[""] = max((rank.get(target.split(".")[0], 0) for target in found[""].modules), default=-1) + 0.5
    for name, imports in found.items():
        messages += [f"flypend.{name}, line {line}: a relative import hides the direction" for line in imports.relative]
        if name not in COMPUTED:
            messages += [f"flypend.{name}, line {line}: imports a name that is computed" for line in imports.computed]
        here = name.split(".")[0]
        for target in sorted(imports.modules | imports.rooms):
            there = target.split(".")[0]
            if there in DATA:
                messages.append(f"flypend.{name} imports flypend.{target}, which is data")
            elif name and here != there and here in rank and rank.get(there, -1) > rank[here]:
                messages.append(f"flypend.{name} imports flypend.{target or '(the namespace)'}, which stands after it")
    try:
        TopologicalSorter({name: imports.modules for name, imports in found.items()}).prepare()
    except CycleError as error:
        messages.append("cycle: " + " -> ".join(error.args[1]))
    return messages


def test_contributing_names_all_rooms_in_their_order():
    section = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8").partition("## The rooms")[2].partition("\n## ")[0]
    rooms = [word for names in re.findall(r"^    (.*?)  ", section, flags=re.MULTILINE) for word in names.split()]
    assert rooms == ORDER[:-1]


def _single(sources):
    """Modules directly under flypend that are no rooms."""
    rooms = {name.split(".")[0] for name in sources if "." in name}
    return sorted({name or "__init__" for name in sources if "." not in name} - rooms)


def _crowd(sources):
    """A complaint about more single modules than there may be; a room of one file counts as what it is, a room."""
    single = [name for name in _single(sources) if not (SOURCE / name).is_dir()]
    return [f"{', '.join(single)}: more than {MOST_SINGLE}, make a room"] if len(single) > MOST_SINGLE else []


def _strangers(folders, known):
    """Complaints about folders of tests or docs that are called as no room."""
    return [f"{name} is no room of src/flypend" for name in sorted(set(folders) - set(known))]


def _folders(where):
    """Names of the folders in `where` that hold a tracked kind of file, caches left out."""
    return {path.name for path in where.iterdir() if path.is_dir() and not path.name.startswith((".", "__"))}


def test_imports_point_one_way():
    assert not _wrong_imports(_sources())


def test_the_order_names_nothing_twice_and_nothing_that_is_gone():
    assert len(set(ORDER)) == len(ORDER)
    assert {name.split(".")[0] for name in _sources()} - {""} == set(ORDER)
    assert set(COMPUTED) <= set(_sources())
    assert {name for name in DATA if (SOURCE / name).is_dir()} == DATA


def test_there_are_few_single_modules():
    assert not _crowd(_sources())
    assert {"__init__", "__main__", "errors", "geometry"} <= set(_single(_sources()))


def test_a_ninth_single_module_is_found():
    eight = dict.fromkeys(["", "__main__", *"abcdef"], "") | {"model": "", "model.state": ""}
    assert not _crowd(eight)
    assert _crowd(eight | {"ninth": ""}) == ["__init__, __main__, a, b, c, d, e, f, ninth: more than 8, make a room"]


@pytest.mark.parametrize(
    ("place", "more"),
    [("tests", set()), ("docs", {"img", "_build", "how-to", "notebooks", "reference", "site", "tutorials"})],
)
def test_the_folders_are_called_as_the_rooms(place, more):
    rooms = _folders(SOURCE) - DATA
    assert not _strangers(_folders(ROOT / place), rooms | more)
    assert _strangers({"model", "cupboard"}, rooms | more) == ["cupboard is no room of src/flypend"]


@pytest.mark.parametrize(
    ("sources", "complaint"),
    [
        ({"geometry": "from flypend.model import State", "model": ""}, "flypend.geometry imports flypend.model"),
        ({"model": "def f():\n    import flypend.studies", "studies": ""}, "flypend.model imports flypend.studies"),
        (
            {"model.state": "from flypend import laws", "laws": "", "model": ""},
            "flypend.model.state imports flypend.laws",
        ),
        (
            {"model": "import importlib\nimportlib.import_module('flypend.lab')", "lab": ""},
            "flypend.model imports flypend.lab",
        ),
        (
            {"model": "from importlib import import_module as f\ndef g():\n    f(name='flypend.lab.page')", "lab": ""},
            "flypend.model imports flypend.lab",
        ),
        ({"model": "__import__('flypend.lab')", "lab": ""}, "flypend.model imports flypend.lab"),
        ({"model": "import importlib as i\ni.import_module(f'flypend.lab.{x}')"}, "flypend.model imports flypend.lab"),
        ({"model": "import_module(f'flypend.{x}')"}, "imports a name that is computed"),
        ({"model": "import_module(name)"}, "imports a name that is computed"),
        ({"model": "import_module(f'{x}.lab')"}, "imports a name that is computed"),
        ({"model": "import_module('.state', 'flypend.model')"}, "a relative import"),
        ({"model": "from . import state"}, "a relative import"),
        ({"model": "def f():\n    from ..errors import InputError"}, "a relative import"),
        ({"model": "from flypend.examples.my_law import balance"}, "which is data"),
        ({"model": "from flypend import State", "": "from flypend.flight import simulate"}, "(the namespace)"),
        ({"brand_new": ""}, "brand_new is new"),
        ({"laws": "from flypend.laws.a import A", "laws.a": "from flypend.laws import B"}, "cycle: "),
        ({"laws.b": "def f():\n    import flypend.laws.a", "laws.a": "from flypend.laws import b"}, "cycle: "),
        ({"laws.b": "import_module('flypend.laws.a')", "laws.a": "from flypend.laws.b import x"}, "cycle: "),
    ],
)
def test_a_wrong_import_is_found(sources, complaint):
    messages = _wrong_imports(sources)
    assert len(messages) == 1
    assert complaint in messages[0]


# Machine code ---------------------------------------------------------------------------------------------------


def test_rooms_outside_the_key_of_the_cache_write_no_machine_code():
    """They stand last, so no generator imports them, and they hand none over: what they compile is in the key."""
    assert set(ORDER[ORDER.index("export") : ORDER.index("cli") + 1]) == ABOVE
    sources = _sources()
    for name, text in sources.items():
        if name.split(".")[0] in ABOVE:
            modules = _Imports(text, sources).modules
            assert not modules & {"compile.llvm", "compile.llvm.jit", "compile.llvm.emit"}, name
            assert not re.search(r"(import|from) llvmlite", text), name


# Public names ---------------------------------------------------------------------------------------------------


def test_every_public_name_is_found_where_it_is_said_to_be():
    assert sorted(flypend.__all__) == flypend.__all__
    assert set(flypend.__all__) == set(flypend._MODULES) | {"laws"}
    for name in flypend.__all__:
        assert getattr(flypend, name) is not None
        assert name in dir(flypend)
    with pytest.raises(AttributeError, match="module 'flypend' has no attribute 'simulat'"):
        flypend.simulat  # noqa: B018


def test_nothing_heavy_is_imported_before_it_is_used():
    program = "import sys, flypend; sys.exit(bool({'casadi', 'llvmlite', 'numpy', 'scipy'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


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
    "learning",
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


def _silent(source, many=4):
    """Names of functions with `many` parameters or more and no docstring; a class says what `__init__` takes."""
    for function in ast.walk(ast.parse(source)):
        if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef) and function.name != "__init__":
            taken = [one.arg for one in (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)]
            if len(taken) - (taken[:1] in (["self"], ["cls"])) >= many and not ast.get_docstring(function):
                yield function.name


def test_a_function_of_four_arguments_says_what_it_does():
    assert list(_silent("def f(a, b, *, c, d): pass\ndef g(a, b, c, d): 'says'\ndef h(self, b, c, d): pass")) == ["f"]
    assert not [f"{path.name}: {name}" for path in SOURCE.rglob("*.py") for name in _silent(path.read_text("utf-8"))]


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


INSTALLERS = ("pyproject.toml", "Makefile", "run")


def test_what_installs_names_no_registry():
    files = [path for path in _tracked() if path.suffix == ".lock" or path.name in INSTALLERS]
    assert {
        *INSTALLERS,
        "requirements.lock",
        "requirements-lowest.lock",
        "requirements-bench.lock",
        "requirements-learners.lock",
    } <= {path.name for path in files}
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
