"""The ledger: what commands measured, one file of benchmarks/results each, and the pages that say so.

`python -m benchmarks.results` says which results are older than the code that they measure, and which files changed.
`python -m benchmarks.results NAME …` runs the commands of those results again, writes their files, and puts the new
numbers where pages say the old ones.
"""

from __future__ import annotations

import ast
import json
import math
import os
import platform
import re
import shlex
import subprocess
import sys
import tokenize
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from datetime import UTC, date, datetime
from functools import cache, partial
from hashlib import sha256
from io import StringIO
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.quantities import CODE, NUMBER, Said, numbers_in, said, value_of

ROOT = Path(__file__).parents[1]
FOLDER = Path(__file__).with_suffix("")
SOURCES = ROOT / "src" / "flypend"
REPORT = "FLYPEND_REPORT"  # the environment's name for the file that `record` writes
LINK = re.compile(r"\]\(([^)#:]+\.md)[^)]*\)")
CONSTANTS = tomllib.loads((FOLDER.parent / "constants.toml").read_text(encoding="utf-8"))

Values = dict[str, Any]  # row → numbers, or column → numbers
Code = dict[str, dict[str, str]]  # room or file → digest of each of its files; {} where none was recorded


@dataclass(frozen=True)
class Result:
    """What a `command` measured: `values` by row, of some `code`, on a `date` and `machine`.

    `code` has the rooms or files of src/flypend that it measures, and its own file of benchmarks or tests, each with
    the digests of its files.
    Values are in SI units, or as printed.
    """

    name: str
    command: str
    code: Code
    date: date = date.min
    machine: str = ""
    values: Values = field(default_factory=dict)

    def text(self) -> str:
        """Return the file of this result."""
        head = f"command = {json.dumps(self.command, ensure_ascii=False)}\ndate = {self.date}\n"
        tables = (f"\n[{name}]\n{_lines(table)}" for name, table in (("values", self.values), ("code", self.code)))
        return f"{head}machine = {json.dumps(self.machine)}\n{''.join(tables)}"

    def numbers(self) -> list[float]:
        """Return all values."""
        return [value for _, value in leaves(self.values)]

    def changed(self) -> dict[str, list[str]]:
        """Return by room which of its files are no longer as they were measured; not where nothing was recorded."""
        found = {}
        for source, old in self.code.items():
            new = digests(source)
            files = sorted(name for name in old.keys() | new.keys() if old.get(name) != new.get(name))
            if old and files:
                found[source] = files
        return found

    def age(self) -> str:
        """Return in words whether it is older than its code."""
        changed = self.changed()
        if not changed:
            return "fresh" if all(self.code.values()) else "of code that was not recorded"
        return f"older than {', '.join(_told(source, files) for source, files in changed.items())}"

    def again(self) -> tuple[Result, str]:
        """Run the command; return what it measures now, and what it printed. Raises RuntimeError if it fails."""
        with TemporaryDirectory() as folder:
            path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
            # The sources beside these benchmarks, whichever package is installed.
            sources = os.pathsep.join([str(ROOT), str(ROOT / "src")])
            surroundings = {**os.environ, "PATH": path, "PYTHONPATH": sources, "NO_COLOR": "1", "COLUMNS": "200"}
            surroundings[REPORT] = str(Path(folder, "own", "report.json"))
            place = folder if self.command.startswith("flypend ") else ROOT  # other commands are typed in a clone
            done = subprocess.run(
                self.command, shell=True, cwd=place, env=surroundings, capture_output=True, text=True, check=False
            )
            if done.returncode:
                raise RuntimeError(f"{self.command} ends with {done.returncode}:\n{done.stderr[-2000:]}")
            values = measured(done.stdout, Path(folder))
        code = {source: digests(source) for source in self.code}
        new = replace(self, code=code, date=datetime.now(UTC).date(), machine=machine_told(), values=values)
        return new, done.stdout


def _told(source: str, files: list[str]) -> str:
    if len(files) > 2:
        return f"{len(files)} files of {source}"
    return ", ".join(source if place_of(source).suffix else f"{source}/{name}" for name in files)


def place_of(source: str) -> Path:
    """Return where a room or file of `Result.code` is."""
    return (ROOT if source.startswith(("benchmarks/", "tests/")) else SOURCES) / source


def digests(source: str) -> dict[str, str]:
    """Return the digest of each file of a room, or of a file; none where there is no such place."""
    place = place_of(source)
    if place.is_file():
        return {place.name: digest(place.read_bytes(), place.suffix)}
    files = (path for path in sorted(place.rglob("*")) if path.is_file() and "__pycache__" not in path.parts)
    return {path.relative_to(place).as_posix(): digest(path.read_bytes(), path.suffix) for path in files}


@cache
def digest(content: bytes, suffix: str) -> str:
    """Return eight digits of a file's SHA-256; of Python without comments, docstrings and empty lines."""
    return sha256(_bare(content.decode()).encode() if suffix == ".py" else content).hexdigest()[:8]


def _bare(python: str) -> str:
    lines = python.splitlines()
    for token in tokenize.generate_tokens(StringIO(python).readline):
        if token.type == tokenize.COMMENT:
            row, column = token.start
            lines[row - 1] = lines[row - 1][:column]
    for node in ast.walk(ast.parse(python)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef) and ast.get_docstring(
            node
        ):
            first = node.body[0]
            lines[first.lineno - 1 : first.end_lineno] = [""] * ((first.end_lineno or 0) - first.lineno + 1)
    return "\n".join(line.rstrip() for line in lines if line.strip())


def _lines(table: Mapping[str, Any]) -> str:
    return "".join(f"{_key(name)} = {_inline(found)}\n" for name, found in table.items())


def _key(name: str) -> str:
    return name if re.fullmatch(r"[\w-]+", name, re.ASCII) else json.dumps(name, ensure_ascii=False)


def _inline(found: Any) -> str:
    if isinstance(found, Mapping):
        return "{ " + ", ".join(f"{_key(name)} = {_inline(value)}" for name, value in found.items()) + " }"
    return json.dumps(found)


def machine() -> dict[str, Any]:
    """Processor, cores, load, system, Python and date."""
    info = Path("/proc/cpuinfo")
    names = re.findall(r"^model name\s*: (.*)$", info.read_text(), re.MULTILINE) if info.exists() else []
    return {
        "processor": (names or [platform.processor() or platform.machine()])[0], "cores": os.cpu_count(),
        "load": os.getloadavg()[0] if hasattr(os, "getloadavg") else None, "system": platform.system(),
        "python": platform.python_version(), "date": datetime.now(UTC).strftime("%Y-%m-%d"),
    }  # fmt: skip


def machine_told() -> str:
    """Return the machine in a few words."""
    where = machine()
    load = "" if where["load"] is None else f", load {where['load']:.0f}"
    return f"{where['processor']}, {where['cores']} cores{load}"


def measured(printed: str, folder: Path) -> Values:
    """Return the values that a command left in `folder`, as a report.json, or those that it `printed`."""
    reports = sorted(folder.glob("*/report.json"), key=lambda path: path.stat().st_mtime_ns)
    if not reports:
        return rows(printed)
    found: Values = {}
    for name, row in _rows_of(json.loads(reports[-1].read_text(encoding="utf-8"))):
        found[_free(name, found)] = row
    return found


def _rows_of(tree: Mapping[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[str, Values]]:
    numbers = {name: _rounded(value) for name, value in tree.items() if _rounded(value) not in (None, [])}
    if numbers:
        yield " ".join(path) or "all", numbers
    for name, below in tree.items():
        for part in below if isinstance(below, list) else [below]:
            if isinstance(part, dict) and name != "settings":
                named = next((value for value in part.values() if isinstance(value, str)), "")
                yield from _rows_of(part, (*path, named if isinstance(below, list) else name))


def _rounded(value: Any) -> Any:
    """Return a finite number, or those of a list, to five digits."""
    if isinstance(value, list):
        return [number for number in map(_rounded, value) if isinstance(number, int | float)]
    if isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value):
        return value if isinstance(value, int) else float(f"{value:.5g}")
    return None


def rows(printed: str) -> Values:
    """Return the numbers of each line: of a Markdown table by column, of others as a list; named by what precedes."""
    found: Values = {}
    columns: list[str] = []
    for line in printed.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else []
        if cells and not columns:
            columns = cells
        elif cells:
            row = {name or "value": numbers_in(cell) for name, cell in zip(columns[1:], cells[1:], strict=False)}
            if row := {name: numbers for name, numbers in row.items() if numbers}:
                found[_free(cells[0], found)] = row
        else:
            columns = []
            first = re.match(r"[^:]{1,60}: ", line) or NUMBER.search(line)
            begin = 0 if not first else first.end() if first[0].endswith(": ") else first.start()
            if numbers := numbers_in(line[begin:]):
                found[_free(line[:begin], found)] = numbers
    return found


def _free(name: str, taken: Mapping[str, Any]) -> str:
    name = re.sub(r"[`*]|[\s,(:│]+$", "", name.strip()) or "all"
    return name if name not in taken else _free(f"{name} again", taken)


def record(row: str, **columns: Any) -> None:
    """Put a row of numbers into the report of a benchmark, which the ledger reads; for one that prints no table."""
    if path := os.environ.get(REPORT):
        told = json.loads(Path(path).read_text(encoding="utf-8")) if Path(path).exists() else {}
        Path(path).parent.mkdir(exist_ok=True)
        Path(path).write_text(json.dumps(told | {row: columns}), encoding="utf-8")


_text = cache(partial(Path.read_text, encoding="utf-8"))


def results() -> list[Result]:
    """Return the ledger."""
    files = {path.stem: tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(FOLDER.glob("*.toml"))}
    return [Result(name, **file) for name, file in files.items()]


@cache
def literals(place: Path) -> frozenset[float]:
    """Return the numbers that stand in the Python and in the TOML of a room, or in a module."""
    found: set[float] = set()
    for path in [place] if place.is_file() else sorted(place.rglob("*.py")):
        constants = (node.value for node in ast.walk(ast.parse(_text(path))) if isinstance(node, ast.Constant))
        found |= {float(value) for value in constants if isinstance(value, int | float)}
    for path in sorted(place.rglob("*.toml")):
        found |= set(numbers_in(_text(path)))
    return frozenset(found)


@cache
def typed(line: str) -> str:
    """Return a command line without its comment, in one spelling."""
    try:
        return shlex.join(shlex.split(" ".join(line.split()), comments=True))
    except ValueError:
        return line


@cache
def commands(page: str) -> frozenset[str]:
    """Return what stands on a page as code."""
    lines = (line for block in CODE.findall(page) for line in [block, *block.splitlines()])
    return frozenset(typed(line.strip("`")) for line in lines)


def pages() -> list[Path]:
    """Return what the ledger answers for: README.md and docs."""
    return [ROOT / "README.md", *sorted(path for path in (ROOT / "docs").rglob("*.md") if "_build" not in path.parts)]


def named(page: str, ledger: list[Result]) -> list[Result]:
    """Return the results whose commands stand on a page."""
    return [result for result in ledger if typed(result.command) in commands(page)]


def leaves(values: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], float]]:
    """Yield the numbers of `values`, each with its row, column and place."""
    if isinstance(values, int | float):
        yield path, values
    else:
        for name, below in values.items() if isinstance(values, Mapping) else enumerate(values):
            yield from leaves(below, (*path, name))


def unknown(page: str, path: Path, ledger: list[Result]) -> list[Said]:
    """Return the quantities of a page that are neither settings nor in the ledger.

    A setting is a number that somebody has typed: in the code of the page, in a vehicle, in the plants, in the room of
    src/flypend with the name of the page's folder, in a benchmark that the page names, or in constants.toml. A measured
    number is one of a result whose command stands on the page, or on one to which the section of the number leads.
    """
    places = [SOURCES / room for room in (*path.parent.relative_to(ROOT).parts[1:2], "vehicles", "plants")]
    places += [ROOT / "benchmarks" / f"{name}.py" for name in re.findall(r"\bbenchmarks[./](\w+)", page)]
    here = {value for block in CODE.findall(page) for value in numbers_in(re.sub(r"[=(\[]", " ", block))}
    typed_here = {f"{value:.9g}" for value in here}
    settings = typed_here | {f"{value:.9g}" for place in places if place.exists() for value in literals(place)}
    constants = {*CONSTANTS["everywhere"], *CONSTANTS.get(path.relative_to(ROOT).as_posix(), [])}
    own: list[Result] = named(page, ledger)
    found = []
    for number in said(page):
        value = value_of(number.text)
        if number.text in constants or f"{value / number.scale:.9g}" in settings or f"{value:.9g}" in typed_here:
            continue
        linked = (path.parent / place for place in LINK.findall(number.section))
        others = (named(_text(other), ledger) for other in linked if other.exists())
        if not any(number.agrees(value) for some in chain([own], others) for one in some for value in one.numbers()):
            found.append(number)
    return found


def put(page: str, wrong: list[Said], old: Values, new: Values) -> tuple[str, list[Said]]:
    """Return a `page` with `new` values for its `wrong` numbers, which are `old` ones, and the unclear numbers."""
    before, after, unclear = dict(leaves(old)), dict(leaves(new)), []
    for number in reversed(wrong):
        meant = [place for place, value in before.items() if number.agrees(value)]
        row = (place for place in meant if re.search(rf"(?<!\w){re.escape(str(place[0]))}(?!\w)", number.line))
        fresh = {number.as_written(after[place]) if place in after else "" for place in list(row) or meant}
        if len(fresh) == 1 and "" not in fresh:
            page = page[: number.begin] + fresh.pop() + page[number.begin + len(number.text) :]
        else:
            unclear.append(number)
    return page, unclear


def put_tables(page: str, old: Values, printed: str) -> str:
    """Return a `page` with the rows of its tables as `printed`: by columns and first cell, and by `old` numbers."""
    lines, places, found = page.splitlines(keepends=True), [], list(_table_rows(page))
    before = {re.sub(r"\s", "", name): [value for _, value in leaves(row)] for name, row in old.items()}
    for _, first, new in _table_rows(printed):
        numbers = before.get(first, [])
        places = [(i, own) for i, name, own in found if name == first and own.keys() <= new.keys()]
        alike = [sum(value in numbers for cell in own.values() for value in numbers_in(cell)) for _, own in places]
        if places and alike.count(max(alike)) == 1:
            i, own = places[alike.index(max(alike))]
            cells = [
                lines[i].split("|")[1].strip(),
                *(new[column] for column in own),
            ]  # the first as the page spells it
            lines[i] = f"| {' | '.join(cells)} |\n"
    return "".join(lines)


def _table_rows(text: str) -> Iterator[tuple[int, str, dict[str, str]]]:
    """Yield, for each row of a Markdown table, the number of its line, its first cell bare, and its cells by column."""
    columns: list[str] = []
    for i, line in enumerate(text.splitlines()):
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else []
        if cells and columns and not set(cells[0]) <= set("-:"):
            yield i, re.sub(r"[`*\s]", "", cells[0]), dict(zip(columns[1:], cells[1:], strict=False))
        columns = columns or cells if cells else []


def measure(old: Result, ledger: list[Result]) -> None:
    """Measure a result of the `ledger` again, write its file, and put the new numbers into the pages that name it."""
    new, printed = old.again()
    (FOLDER / f"{new.name}.toml").write_text(new.text(), encoding="utf-8")
    print(new.text())
    for path in pages():
        page = path.read_text(encoding="utf-8")
        if typed(new.command) in commands(page):
            page = put_tables(page, old.values, printed)
            before = {number.begin for number in unknown(page, path, ledger)}
            now = unknown(page, path, [new if result.name == new.name else result for result in ledger])
            page, unclear = put(page, [one for one in now if one.begin not in before], old.values, new.values)
            path.write_text(page, encoding="utf-8")
            for number in unclear:
                print(f"{path.relative_to(ROOT)}: write {number.text} in {number.line!r} by hand")


def main(names: list[str]) -> None:
    """List the results with their age, or measure those named again."""
    ledger = results()
    if {"-h", "--help"} & set(names):
        print(__doc__)
        return
    if missing := set(names) - {result.name for result in ledger}:
        sys.exit(f"no result {', '.join(sorted(missing))} in {FOLDER.relative_to(ROOT)}")
    for result in ledger:
        if result.name in names:
            measure(result, results())
        elif not names:
            print(f"{result.name:26} {result.date}  {result.age()}")


if __name__ == "__main__":
    main(sys.argv[1:])
