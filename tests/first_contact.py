"""What a newcomer types, on an installation without extras: `make first-contact`.

python -m tests.first_contact WHEEL FOLDER

Each Python from 3.11 to 3.13 that is here gets an environment in FOLDER with WHEEL and what it depends on. There every
command of README.md, of the examples and of the first pages of the docs is typed as it is printed, in the order of the
page, together with the Python between them; so is every command that the output of another one suggests. Each ends as
tests/first_contact.toml says, and one of the ledger prints the numbers that pages have from it. The first Python takes
everything, each other one what takes seconds.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.results import Values, measured, results, unknown
from benchmarks.results import typed as command

ROOT = Path(__file__).parents[1]
VERSIONS = ("3.11", "3.12", "3.13")
PAGES = ("README.md", "docs/index.md", "docs/start.md", "docs/findings.md")
EXAMPLES = "src/flypend/examples"
RULES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
# On a page: a block of Python, a line by itself, a command within a sentence.
TYPED = re.compile(
    r"^```python\n(?P<python>(?s:.*?))^```$|^    (?P<line>flypend .*)$|`(?P<inline>flypend [^`]*)`", re.M
)
# In an example: what stands by itself, in a comment, in quotes, or after a colon.
SHOWN = re.compile(r'(?:^|: |# |`)((?:flypend |python examples/)[^"`\[\n]*)', re.MULTILINE)
SUGGESTED = re.compile(r"^Try: (flypend .*)$", re.MULTILINE)
LEDGER = {command(result.command): result for result in results()}


class BrokenError(Exception):
    """What a newcomer would stumble over."""


@dataclass(frozen=True)
class Step:
    """One thing to type: a command, without its comment and with each word as the shell sees it, or Python."""

    text: str
    is_python: bool = False


def steps_of(page: str) -> list[Step]:
    """Return what the text of a `page` tells one to type, in its order."""
    found, session = [], ""
    for typed in TYPED.finditer(page):
        if typed["python"]:
            session += typed["python"]  # a block goes on from those before it
        found.append(Step(session, True) if typed["python"] else Step(command(typed["line"] or typed["inline"])))
    return found


def steps_of_examples() -> list[Step]:
    """Return what the examples tell one to type."""
    files = sorted(path for path in (ROOT / EXAMPLES).rglob("*") if path.suffix in (".toml", ".py"))
    lines = [line for path in files for line in SHOWN.findall(path.read_text(encoding="utf-8"))]
    return [Step(command(line.removesuffix("."))) for line in lines]


def journeys() -> dict[str, list[Step]]:
    """Return what is typed in one folder after the other, by page; who reads the README goes on to the examples."""
    found = {page: steps_of((ROOT / page).read_text(encoding="utf-8")) for page in PAGES}
    return {**found, PAGES[0]: list(dict.fromkeys([*found[PAGES[0]], *steps_of_examples()]))}


def check_numbers(page: str, line: str, printed: Values) -> int:
    """Return how many numbers of a `page` come from `line`. Raises BrokenError for one that is not `printed` now."""
    text, path = (ROOT / page).read_text(encoding="utf-8"), ROOT / page
    fresh = [replace(result, values=printed) if result is LEDGER[line] else result for result in LEDGER.values()]
    if wrong := unknown(text, path, fresh):
        raise BrokenError(f"{page} says {wrong[0].text} in {wrong[0].line!r}, {line} prints another number")
    return len(unknown(text, path, [result for result in fresh if result.values is not printed]))


class Machine:
    """An environment of one Python with flypend in it, and a cache of machine code of its own."""

    def __init__(self, python: Path, whole: bool, cache: Path) -> None:
        self.python, self.whole, self.typed, self.numbers = python, whole, 0, 0
        self.environment = {
            **{name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "FLYPEND"))},
            "PATH": f"{python.parent}{os.pathsep}{os.environ['PATH']}",
            "FLYPEND_CACHE": str(cache), "NO_COLOR": "1", "MPLBACKEND": "agg",
        }  # fmt: skip

    def call(self, words: list[str], folder: Path) -> subprocess.CompletedProcess:
        return subprocess.run(
            [shutil.which(words[0], path=self.environment["PATH"]) or words[0], *words[1:]],
            cwd=folder, env=self.environment, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8",
            check=False,
        )  # fmt: skip

    def type(self, step: Step, folder: Path) -> str:
        """Type `step` in `folder`; return what it printed. Raises BrokenError unless it ends as the rules say."""
        self.typed += 1
        if step.is_python:
            return self.ended(self.call([str(self.python), "-c", step.text], folder), "the Python of the page")
        line = step.text
        if extra := RULES["needs"].get(line):
            return self.refused(line, extra, folder)
        if package := RULES["foreign"].get(line):
            told = self.call(shlex.split(line), folder).stderr
            if not re.search(rf"^ModuleNotFoundError: .*{package}", told, re.MULTILINE):
                raise BrokenError(f"{line} does not name {package}:\n{told}")
            return told
        done = self.call(shlex.split(RULES["smaller"].get(line, line)), folder)
        printed = self.ended(done, line)
        if line in LEDGER and line not in RULES["smaller"]:
            fresh = measured(printed, folder)
            self.numbers += sum(check_numbers(page, line, fresh) for page, steps in journeys().items() if step in steps)
        for other in SUGGESTED.findall(printed):
            self.type(Step(command(other)), folder)
        return printed

    def ended(self, done: subprocess.CompletedProcess, what: str) -> str:
        if done.returncode != 0:
            raise BrokenError(f"{what} ends with {done.returncode}, not 0:\n{done.stdout[-500:]}{done.stderr[-1500:]}")
        return done.stdout

    def refused(self, line: str, extra: str, folder: Path) -> str:
        """A command tells the extra that it lacks in one line, and leaves nothing behind; an example raises it."""
        before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
        done = self.call(shlex.split(line), folder)
        told = done.stderr.splitlines()
        is_command = line.startswith("flypend ")
        if not told or f"expected the extra {extra} (pip install " not in told[-1] or done.stdout:
            raise BrokenError(f"{line} does not say that it needs the extra {extra}:\n{done.stdout}{done.stderr}")
        if is_command and (len(told) > 1 or done.returncode != 2):
            raise BrokenError(f"{line} ends with {done.returncode}, after {len(told)} lines:\n{done.stderr}")
        if is_command and before != {path: path.stat().st_mtime_ns for path in folder.rglob("*")}:
            raise BrokenError(f"{line} needs the extra {extra}, and leaves something behind all the same")
        return told[-1]

    def install_as_told(self, folder: Path) -> None:
        """What a message tells one to type to add an extra is something that pip can do."""
        told = self.refused("flypend lab", RULES["needs"]["flypend lab"], folder)
        pip, *words = shlex.split(told.partition("(")[2].partition("), got")[0])
        line = [
            str(self.python),
            "-m",
            pip,
            words[0],
            "--dry-run",
            "--quiet",
            "--disable-pip-version-check",
            *words[1:],
        ]
        self.ended(self.call(line, folder), shlex.join(line))


def python_of(version: str) -> str | None:
    """Return a Python of this version: on the PATH, or of pyenv, which may hide it from the PATH."""
    hidden = sorted(Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")).glob(f"versions/{version}.*/bin/python"))
    for candidate in (sys.executable, f"python{version}", *map(str, hidden)):
        asked = "import sys; print('%d.%d' % sys.version_info[:2])"
        try:
            found = subprocess.run([candidate, "-c", asked], capture_output=True, text=True, check=False).stdout.strip()
        except OSError:
            continue
        if found == version:
            return candidate
    return None


def is_installed(python: str, wheel: Path, folder: Path) -> Path:
    """Return the Python of an environment in `folder` with `wheel` and its dependencies; one that is there is kept."""
    own = folder / "bin" / "python"
    if not own.exists():
        subprocess.run([python, "-m", "venv", str(folder)], check=True)
    pip = [str(own), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, str(wheel)], check=True)
    subprocess.run([*pip, "--no-deps", "--force-reinstall", str(wheel)], check=True)
    return own


def main(wheel: Path, folder: Path) -> None:
    """Type everything on each Python; the first thing that is broken ends it."""
    whole = True
    for version in VERSIONS:
        python = python_of(version)
        if python is None:
            print(f"first contact: no Python {version} here, which is left out")
            continue
        begin = time.monotonic()
        with TemporaryDirectory() as home:
            machine = Machine(is_installed(python, wheel, folder / version), whole, Path(home) / "cache")
            (Path(home) / "cache").mkdir(mode=0o700)
            for page, steps in journeys().items():
                place = Path(home) / Path(page).stem
                place.mkdir()
                for step in steps:
                    if whole or step.text not in RULES["long"]["commands"]:
                        since = time.monotonic()
                        machine.type(step, place)
                        told = "the Python of the page" if step.is_python else step.text
                        print(f"{time.monotonic() - since:6.1f} s  {told}", flush=True)
            machine.install_as_told(place)
        told = f"{machine.typed} commands typed, {machine.numbers} numbers compared"
        print(f"first contact: Python {version}: {told} in {time.monotonic() - begin:.0f} s", flush=True)
        whole = False
    if whole:
        raise BrokenError(f"no Python of {', '.join(VERSIONS)} is here")


if __name__ == "__main__":
    try:
        main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
    except BrokenError as broken:
        sys.exit(f"first contact: {broken}")
