"""Plants mutations in the source and runs the tests that can see each: `make mutants`, or with rooms and files.

    python tests/mutants.py [--count 200] [--limit 60] [--minutes 10] [board laws/passage.py ...]

A mutation is one change of one expression: a sign, a comparison, an index off by one, two arguments in each other's
place, a term or a check left out, a matrix not transposed, a unit not converted. Which ones are drawn follows from the
text of each expression alone, so that everybody gets the same and an edit elsewhere changes none of them.

Each runs in a process of its own, forked after the imports of others' packages, on a copy of the source. Tests nearest
to the mutated module by imports come first, quick ones before slow ones, until one fails or `--limit` seconds are over.
What catches a mutation must pass without one: that is tried at the end. `mutants.toml` holds survivors that change
nothing that one could assert, each with its reason.

`--minutes 10` judges a part of them, and the next call goes on: judged.json holds what caught each, until its line
changes, and survivors are tried again. `--minutes 0` tells how many have been judged.

Not mutmut (it cannot keep a package whose source the tests import from a folder of their own, and instruments functions
with trampolines, which the CasADi graphs built from them do not see), and not cosmic-ray (a new interpreter for every
mutation: imports and machine code cost more than the tests).
"""

from __future__ import annotations

import argparse
import ast
import compileall
import gc
import hashlib
import json
import os
import re
import shutil
import signal
import sys
import time
import tomllib
import traceback
from collections import defaultdict
from collections.abc import Iterable
from contextlib import suppress
from functools import lru_cache
from itertools import islice, zip_longest
from pathlib import Path
from typing import NamedTuple

# Others' packages, which every child needs; none of flypend's.
import casadi  # noqa: F401
import hypothesis
import llvmlite.binding  # noqa: F401
import matplotlib.pyplot  # noqa: F401
import mujoco  # noqa: F401
import numpy as np
import playwright.sync_api  # noqa: F401
import pytest
import scipy.integrate
import scipy.spatial.transform  # noqa: F401
import sympy  # noqa: F401
import zarr  # noqa: F401
from hypothesis import Phase

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "flypend"
WORK = ROOT / ".pytest_cache" / "mutants"
JUDGED = Path(__file__).with_name("judged.json")
# No room goes without, whatever its size.
LEAST = 4
# Read the source as text, build packages, or try the documentation.
BLIND = ("test_architecture", "test_docs", "test_install", "test_release", "test_first_contact", "test_mutants")
# Fail without a mutation too: flypend's own cache is off here, a clock that also counts for a limit is coarse, and no
# pages lie beside the copy of the source.
UNFIT = (
    "test_a_cache_on_a_full_disk_is_no_error", "test_a_line_is_printed[rotors]",
    "test_every_example_is_on_the_page_with_its_picture",
)  # fmt: skip
# Data, what is shown to users, and what is a test itself.
UNSEEN = ("examples", "vehicles", "policies", "__main__.py", "selftest.py")
OPTIONS = ("-q", "--assert=plain", "-p", "no:cacheprovider", "-p", "no:unraisableexception")
QUICK = 1.0  # s; tests that take longer wait for those of the same distance that do not
HANGS = 60.0  # s; a test that takes longer, and ten times longer than without a mutation, has seen it


# Files of tests, or single tests, by distance.
Tests = list[tuple[int, list[str]]]


@lru_cache(maxsize=400)
def _read(path: str) -> bytes:
    return (SOURCE / path).read_bytes()


class Mutation(NamedTuple):
    """Bytes `begin` to `end` of the file `path`, below the package, become `text`.

    `kind` says which mistake that is, `within` names the functions and classes around it.
    """

    path: str
    begin: int
    end: int
    text: bytes
    kind: str
    within: tuple[str, ...]

    def applied(self) -> bytes:
        """The source with the mutation."""
        source = _read(self.path)
        return source[: self.begin] + self.text + source[self.end :]

    def changes(self) -> bool:
        """Whether the mutated source is Python, and another program."""
        try:
            return ast.dump(ast.parse(self.applied())) != ast.dump(ast.parse(_read(self.path)))
        except SyntaxError:
            return False

    def name(self) -> str:
        """Where it is, and what stands there now: "path: what stood there → what stands there"."""
        source = _read(self.path)
        first = source.rfind(b"\n", 0, self.begin) + 1
        last = source.find(b"\n", self.end)
        line = source[first:last].decode().strip()
        changed = (source[first : self.begin] + self.text + source[self.end : last]).decode().strip()
        return f"{self.path}: {line} → {changed}"

    def lot(self) -> bytes:
        return hashlib.sha256(self.name().encode()).digest()

    def line(self) -> int:
        return _read(self.path).count(b"\n", 0, self.begin) + 1


# Mutations ------------------------------------------------------------------------------------------------------------

FLIPPED = {
    ast.Lt: ">", ast.Gt: "<", ast.LtE: ">=", ast.GtE: "<=", ast.Eq: "!=", ast.NotEq: "==",
    ast.Is: "is not", ast.IsNot: "is", ast.In: "not in", ast.NotIn: "in",
}  # fmt: skip
SIGNS = {ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"), ast.MatMult: None}
ALIKE = {"M": "m", "m": "M", "x": "y", "y": "x", "x_dot": "y_dot", "y_dot": "x_dot", "lower": "upper", "upper": "lower"}
PAIRED = {"min": "max", "max": "min", "fmin": "fmax", "fmax": "fmin", "minimum": "maximum", "maximum": "minimum",
          "sin": "cos", "cos": "sin", "all": "any", "any": "all", "floor": "ceil", "ceil": "floor",
          "horzcat": "vertcat"}  # fmt: skip
UNITS = ("radians", "degrees", "rad2deg", "deg2rad")


class _Finder(ast.NodeVisitor):
    """The mutations of one file."""

    def __init__(self, path: str) -> None:
        self.path, self.source = path, _read(path)
        self._lines = [0]
        for line in self.source.splitlines(keepends=True):
            self._lines.append(self._lines[-1] + len(line))
        self.found: list[Mutation] = []
        self._within: tuple[str, ...] = ()
        self.visit(ast.parse(self.source))

    def _span(self, node: ast.AST) -> tuple[int, int]:
        return self._lines[node.lineno - 1] + node.col_offset, self._lines[node.end_lineno - 1] + node.end_col_offset

    def _text(self, node: ast.AST) -> bytes:
        begin, end = self._span(node)
        return self.source[begin:end]

    def _change(self, begin: int, end: int, text: bytes, kind: str) -> None:
        self.found.append(Mutation(self.path, begin, end, text, kind, self._within))

    def _replace(self, node: ast.AST, text: bytes, kind: str) -> None:
        self._change(*self._span(node), text, kind)

    # Messages and types are no behaviour.
    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        pass

    def visit_Raise(self, node: ast.Raise) -> None:
        pass

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self.visit(node.value)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        if node.name not in ("__repr__", "__dir__"):
            self._inside(node.name, (*node.body, *node.args.defaults))

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        self._inside(node.name, node.body)

    def _inside(self, name: str, nodes: Iterable[ast.AST]) -> None:
        outer, self._within = self._within, (*self._within, name)
        for each in nodes:
            self.visit(each)
        self._within = outer

    def visit_If(self, node: ast.If) -> None:
        if isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            return
        if all(isinstance(each, ast.Raise) for each in node.body) and not node.orelse:
            self._replace(node.test, b"False", "dropped check")
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        self.generic_visit(node)
        strings = (ast.Constant, ast.JoinedStr)
        sides = (node.left, node.right)
        if any(isinstance(s, strings) and not isinstance(getattr(s, "value", 0), (int, float)) for s in sides):
            return
        swap = SIGNS.get(type(node.op))
        left, right = self._span(node.left)[1], self._span(node.right)[0]
        gap = self.source[left:right]
        if swap is None or b"#" in gap:
            return
        place = left + gap.index(swap[0].encode())
        self._change(place, place + 1, swap[1].encode(), "sign" if isinstance(node.op, (ast.Add, ast.Sub)) else "unit")
        if isinstance(node.op, (ast.Add, ast.Sub)):
            self._change(place, self._span(node)[1], b"", "dropped term")

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        self.generic_visit(node)
        if isinstance(node.op, ast.USub):
            self._replace(node, b"(" + self._text(node.operand) + b")", "sign")
        if isinstance(node.op, ast.Not):
            self._replace(node, b"bool(" + self._text(node.operand) + b")", "comparison")

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        self.generic_visit(node)
        word, other = (b"and", b"or") if isinstance(node.op, ast.And) else (b"or", b"and")
        between, after = self._span(node.values[0])[1], self._span(node.values[1])[0]
        place = self.source.find(word, between, after)
        if place >= 0:
            self._change(place, place + len(word), other, "comparison")

    def visit_Compare(self, node: ast.Compare) -> None:
        self.generic_visit(node)
        if len(node.ops) == 1 and type(node.ops[0]) in FLIPPED:
            left, right = self._text(node.left), self._text(node.comparators[0])
            self._replace(node, left + b" " + FLIPPED[type(node.ops[0])].encode() + b" " + right, "comparison")

    def visit_Attribute(self, node: ast.Attribute) -> None:
        self.generic_visit(node)
        value = self._text(node.value)
        if node.attr == "T":
            self._replace(node, value, "transposed")
        elif node.attr in ALIKE and isinstance(node.ctx, ast.Load):
            self._replace(node, value + b"." + ALIKE[node.attr].encode(), "swapped")

    def visit_Call(self, node: ast.Call) -> None:
        self.generic_visit(node)
        called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        name_begin = self._span(node.func)[1] - len(called)
        if called in PAIRED:
            self._change(name_begin, name_begin + len(called), PAIRED[called].encode(), "comparison")
        if called in UNITS and len(node.args) == 1:
            self._replace(node, b"(" + self._text(node.args[0]) + b")", "unit")
        plain = (ast.Name, ast.Attribute)
        for one, other in zip(node.args, node.args[1:], strict=False):
            if isinstance(one, plain) and isinstance(other, plain) and called not in ("isinstance", "issubclass"):
                (begin, _), (_, end) = self._span(one), self._span(other)
                between = self.source[self._span(one)[1] : self._span(other)[0]]
                self._change(begin, end, self._text(other) + between + self._text(one), "swapped")

    def visit_Subscript(self, node: ast.Subscript) -> None:
        self.visit(node.value)
        self.generic_visit(node.slice) if isinstance(node.slice, ast.Tuple) else self.visit(node.slice)
        for part in ast.walk(node.slice):
            if isinstance(part, ast.Constant) and type(part.value) is int:
                self._replace(part, str(part.value + 1).encode(), "off by one")


def candidates() -> dict[str, list[Mutation]]:
    """Return the mutations of each room, drawn by lot: the first n of a room are its n."""
    rooms: dict[str, list[Mutation]] = defaultdict(list)
    for path in sorted(SOURCE.rglob("*.py")):
        below = path.relative_to(SOURCE).as_posix()
        if below.split("/")[0] not in UNSEEN:
            rooms[below.split("/")[0].removesuffix(".py")] += _Finder(below).found
    return {room: _shuffled(found) for room, found in rooms.items() if found}


def _shuffled(found: list[Mutation]) -> list[Mutation]:
    """Mix the kinds evenly, and within each kind by lot."""
    kinds: dict[str, list[Mutation]] = defaultdict(list)
    for one in sorted(found, key=Mutation.lot):
        kinds[one.kind].append(one)
    return [one for layer in zip_longest(*kinds.values()) for one in layer if one]


def drawn(count: int) -> list[Mutation]:
    """Return `count` mutations, of each room in proportion to what can be mutated there, but `LEAST` at least."""
    rooms = candidates()
    total = sum(map(len, rooms.values()))
    shares = {room: min(len(found), max(LEAST, round(count * len(found) / total))) for room, found in rooms.items()}
    while excess := sum(shares.values()) - count:
        largest = max(shares, key=lambda room: shares[room])
        shares[largest] -= 1 if excess > 0 else -1
    chosen = [one for room, found in rooms.items() for one in islice(filter(Mutation.changes, found), shares[room])]
    return sorted(chosen, key=Mutation.lot)


# Tests that can see one -----------------------------------------------------------------------------------------------


class Nearness:
    """How near each file of tests is to each module, by what they import."""

    def __init__(self) -> None:
        self._files = {self._dotted(path): path for path in SOURCE.rglob("*.py")}
        self._exports = {
            name: self._from_imports(ast.parse(path.read_bytes()))
            for name, path in self._files.items()
            if path.name == "__init__.py"
        }
        self._imports = {name: self._imported(path) for name, path in self._files.items() if name != "flypend"}
        files = [path for path in sorted(ROOT.glob("tests/**/test_*.py")) if path.stem not in BLIND]
        self._tests = {path: self._imported(path) for path in files}
        self._words = {path: set(re.findall(r"\w+", path.read_text(encoding="utf-8"))) for path in files}

    @staticmethod
    def _dotted(path: Path) -> str:
        return ".".join(path.relative_to(SOURCE.parent).with_suffix("").parts).removesuffix(".__init__")

    @staticmethod
    def _from_imports(tree: ast.Module) -> dict[str, str]:
        """The module of each name that a package imports."""
        froms = (node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module)
        return {alias.asname or alias.name: node.module for node in froms for alias in node.names}

    def _home(self, module: str, name: str) -> str:
        """The module that defines the `name` imported from `module`."""
        if f"{module}.{name}" in self._files:
            return f"{module}.{name}"
        exported = self._exports.get(module, {}).get(name)
        return self._home(exported, name) if exported and exported != module else module

    def _imported(self, path: Path) -> set[str]:
        tree, found = ast.parse(path.read_bytes()), set()
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.module:
                found |= {self._home(node.module, alias.name) for alias in node.names}
            elif isinstance(node, ast.Import):
                found |= {alias.name for alias in node.names}
            elif isinstance(node, ast.Attribute) and ast.unparse(node.value) == "fp":
                found.add(self._home("flypend", node.attr))
            elif isinstance(node, ast.Attribute) and ast.unparse(node.value) == "fp.laws":
                found.add(self._home("flypend.laws", node.attr))
        return found & self._files.keys()

    def tests(self, one: Mutation) -> Tests:
        """Return the files of tests by their distance from a mutation, the nearest ones first.

        Those in the folder of the room are nearer by one, and by one more for each of these: they have the name of the
        module, they name the mutated function or its class.
        """
        path, near = one.path, {}
        target = self._dotted(SOURCE / path)
        far, layer = {target: 0}, {target}
        while layer:
            layer = {name for name, seen in self._imports.items() if name not in far and seen & layer}
            far |= dict.fromkeys(layer, max(far.values()) + 1)
        for test, seen in self._tests.items():
            if "templates" in path and Path(path).stem in self._words[test]:
                near[test] = 0  # a program that is exported is imported by nobody
            if distances := [far[name] for name in seen if name in far]:
                own = path.split("/")[0].removesuffix(".py") in test.relative_to(ROOT / "tests").as_posix()
                same = test.stem == f"test_{target.rpartition('.')[2]}"
                near[test] = min(distances) - own - same - (not self._words[test].isdisjoint(one.within))
        by_distance = defaultdict(list)
        for test, distance in near.items():
            by_distance[distance].append(str(test))
        return sorted(by_distance.items())


# One mutation, in a process of its own --------------------------------------------------------------------------------


class Watch:
    """A plugin: runs quick tests or slow ones until the time is over, first those that name the mutated code."""

    def __init__(self, named: tuple[str, ...], seconds: dict[str, float], quick: bool, until: float) -> None:
        self._named, self._known, self._quick, self._until = set(named), seconds, quick, until
        self.took: dict[str, float] = {}
        self.failed: list[str] = []
        self.rest = 0

    def pytest_configure(self, config: pytest.Config) -> None:
        keep_machine_code()
        hypothesis.settings.register_profile("mutants", phases=(Phase.explicit, Phase.generate))  # none is shrunk
        hypothesis.settings.load_profile("mutants")

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        mine = [one for one in items if (self._known.get(one.nodeid, 0.0) < QUICK) == self._quick]
        self.rest = len(items) - len(mine)
        mine = [one for one in mine if one.name not in UNFIT]
        items[:] = sorted(mine, key=self._place)

    def _place(self, item: pytest.Item) -> tuple[bool, float]:
        other = self._named.isdisjoint(item.function.__code__.co_names)
        return other, 0.0 if self._quick else self._known[item.nodeid]

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        (WORK / f"running-{os.getpid()}").write_text(nodeid)
        most = max(HANGS, 10 * self._known.get(nodeid, 0.0))
        signal.setitimer(signal.ITIMER_PROF, most)  # of this process alone, so
        signal.alarm(int(10 * most))
        self._began = processor()

    def pytest_runtest_logfinish(self, nodeid: str) -> None:
        self.took[nodeid] = processor() - self._began

    def pytest_runtest_teardown(self, item: pytest.Item) -> None:
        if processor() > self._until:
            item.session.shouldstop = "time is over"

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.failed += [report.nodeid] * report.failed

    pytest_collectreport = pytest_runtest_logreport


def processor() -> float:
    """Return the processor time of this process and of its children that have ended, s."""
    return sum(os.times()[:4])


def keep_machine_code() -> None:
    """Let machine code be found by its text: most mutations leave most of it as it is."""
    from flypend.compile.llvm import jit
    from tests.machine_code import use_machine_code_by_text

    os.environ["FLYPEND_CACHE"] = str(WORK / "machine-code")
    use_machine_code_by_text(WORK / "machine-code-by-text")
    jit.may_cache = lambda: False  # flypend's own cache would hold every kernel once for each mutation


def watched(one: Mutation | None, tests: Tests, limit: float, seconds: dict[str, float]) -> dict:
    """Run `tests`, with a mutation until one fails; return those that failed, and how long each took."""
    took, until, options = {}, processor() + limit, OPTIONS if one is None else (*OPTIONS, "-x")
    for _, files in tests:
        for quick in (True, False):
            watch = Watch(one.within if one else (), seconds | took, quick, until)
            code = pytest.main([*options, *files], plugins=[watch])
            took |= watch.took
            if code in (pytest.ExitCode.INTERNAL_ERROR, pytest.ExitCode.USAGE_ERROR):  # conftest.py cannot be imported
                watch.failed.append(os.path.relpath(files[0], ROOT))
            if watch.failed or processor() > until:
                return {"failed": watch.failed, "took": took}
            if not watch.rest:
                break
    return {"failed": [], "took": took}


def isolated(one: Mutation | None, tests: Tests, limit: float, seconds: dict[str, float]) -> dict:
    """Run `watched` in a child process on a copy of the source with the mutation `one`; return what it returns."""
    began, read, write = processor(), *os.pipe()
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)
        try:
            prepared(one)
            with os.fdopen(write, "w") as pipe:
                json.dump(watched(one, tests, limit, seconds), pipe)
        except BaseException:
            traceback.print_exc()
            raise
        finally:
            sys.stderr.flush()
            os._exit(0)
    os.close(write)
    with os.fdopen(read) as pipe:
        said = pipe.read()
    os.waitpid(child, 0)
    with suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)  # what a test left behind
    running, output = WORK / f"running-{child}", WORK / f"output-{child}"
    if said:
        found = json.loads(said)
    elif running.exists():  # this test hung, or crashed the process
        found = {"failed": [running.read_text()], "took": {}}
    else:
        sys.exit(output.read_text())
    for rest in (running, output):
        rest.unlink(missing_ok=True)
    shutil.rmtree(WORK / f"source-{child}", ignore_errors=True)
    return found | {"seconds": processor() - began}


def prepared(one: Mutation | None) -> None:
    """Let this process, and those that it starts, import a copy of the source with the mutation `one`; silence it."""
    tree = WORK / f"source-{os.getpid()}"
    shutil.copytree(SOURCE, tree / "flypend")
    if one is not None:
        (tree / "flypend" / one.path).write_bytes(one.applied())
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(tree))
    os.environ |= {"PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"}
    os.chdir(ROOT)
    silent = os.open(WORK / f"output-{os.getpid()}", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for stream in (1, 2):
        os.dup2(silent, stream)


# All of them ----------------------------------------------------------------------------------------------------------


def mistakes(rows: list[dict[str, str]]) -> list[tuple[Mutation, Tests]]:
    """Return the mutations that `rows` of mutants.toml spell out, each with the test that has to catch it."""
    found = []
    for row in rows:
        source, was = _read(row["path"]), row["was"].encode()
        if source.count(was) != 1:
            sys.exit(f"mutants.toml: expected once in {row['path']}: {row['was']}")
        begin = source.index(was)
        one = Mutation(row["path"], begin, begin + len(was), row["is"].encode(), "mistake", ())
        found.append((one, [(0, [row["test"]])]))
    return found


def main() -> None:
    """Plant what is asked for; exit with 1 if something survives without a reason."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("where", nargs="*", help="rooms or files; default: all")
    parser.add_argument("--count", type=int, default=200, help="mutations drawn by lot")
    parser.add_argument("--limit", type=float, default=60.0, help="processor seconds of tests per mutation")
    parser.add_argument("--minutes", type=float, help="go on where the last such run stopped, for so long")
    given = parser.parse_args()
    (WORK / "machine-code").mkdir(parents=True, exist_ok=True)
    compileall.compile_dir(SOURCE, quiet=2)
    compileall.compile_dir(ROOT / "tests", quiet=2)
    table = tomllib.loads((ROOT / "tests" / "mutants.toml").read_text(encoding="utf-8"))
    reasons = {row["mutation"]: row["why"] for row in table["survivor"]}
    planted = mistakes(table["mistake"])
    if given.count:
        nearness = Nearness()
        planted += [(one, nearness.tests(one)) for one in drawn(given.count)]
    planted = [(one, tests) for one, tests in planted if not given.where or one.path.startswith(tuple(given.where))]
    durations = WORK / "durations.json"
    seconds = _remembered(durations)
    judged = {} if given.minutes is None else _remembered(JUDGED)  # what caught each by name, "" if nothing did
    until = np.inf if given.minutes is None else time.monotonic() + 60 * given.minutes
    gc.freeze()  # no child looks through what it shares
    waiting = [(one, tests) for one, tests in planted if not judged.get(one.name())]
    names = [one.name() for one, _ in planted]

    def keep() -> None:
        if given.minutes is not None:
            kept = judged if given.where else {name: judged[name] for name in names if name in judged}
            JUDGED.write_text(json.dumps(kept, indent=0, sort_keys=True, ensure_ascii=False) + "\n", encoding="utf-8")

    catchers = set()
    for one, tests in sorted(waiting, key=lambda each: each[0].name() in judged):  # those that survived come last
        if time.monotonic() > until:
            break
        found = isolated(one, tests, given.limit, seconds)
        catcher = judged[one.name()] = found["failed"][0] if found["failed"] else ""
        catchers |= {catcher} - {""}
        seconds |= {test: took for test, took in found["took"].items() if test not in found["failed"]}
        durations.write_text(json.dumps(seconds))
        keep()
        state = "caught" if catcher else "known" if one.name() in reasons else "SURVIVED"
        print(f"{state:8} {found['seconds']:4.0f} s {one.kind}, line {one.line()}, {one.name()}")
        print(f"      {catcher}", flush=True)
    blamed = isolated(None, [(0, sorted(catchers))], np.inf, {})["failed"] if catchers else []
    for test in blamed:
        print(f"fails without a mutation: {test}")
    judged |= {name: "" for name, catcher in judged.items() if catcher in blamed}
    keep()
    names = [name for name in names if name in judged]
    survived = [name for name in names if not judged[name]]
    new = [name for name in survived if name not in reasons]
    caught, known = len(names) - len(survived), len(survived) - len(new)
    ends = f"{caught} caught, {known} survived with a reason, {len(new)} without"
    print(f"{len(names)} of {len(planted)} mutations: {ends}")
    for name in new:
        print(f"  {name}")
    sys.exit(bool(new))


def _remembered(path: Path) -> dict:
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


if __name__ == "__main__":
    main()
