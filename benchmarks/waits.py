"""What a user waits for each common command: `python -m benchmarks.waits`, some ten minutes on two idle cores.

Every command is a process of its own, first with an empty cache of compiled kernels, as on the first day, then again.
Its modules are compiled to bytecode before, as pip does. Prints a table for docs/flight/engine.md. Words after it
choose the commands that contain one of them.
"""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from benchmarks.results import machine

EXAMPLES = Path(__file__).parents[1] / "src" / "flypend" / "examples"


class Wait(NamedTuple):
    """A `command`, and what it does in a few words."""

    command: str
    what: str


WAITS = (
    Wait("flypend run 1 --no-figures", "an experiment of the paper, as numbers"),
    Wait("flypend run 1 --quick", "the same with figures"),
    Wait("flypend run 1", "the same with figures and movies"),
    Wait("flypend run swing-up.toml --no-figures", "a swing-up in the plant rotors"),
    Wait("flypend run swing-up.toml --law my_law.py:balance --no-figures", "a law of one's own"),
    Wait("flypend run swing-up.toml --set plant=mujoco --no-figures", "a swing-up in MuJoCo"),
    Wait("flypend paper --quick", "the paper without movies"),
    Wait("flypend paper", "the paper"),
    Wait("flypend compare", "four laws, 100 starts each"),
    Wait("flypend compare --runs 2000", "four laws, 2,000 starts each"),
    Wait("flypend ladder", "two laws on 19 plants, 100 starts each"),
    Wait("flypend map --law inverted --runs 20000 --force", "a map of the plant rotors"),
    Wait("flypend map --law inverted --plant ideal --runs 200000 --force", "a map of the ideal plant"),
    Wait("flypend tune hanging.toml", "three gains on the ideal plant, 20 generations"),
    Wait("flypend export-c", "the flight computer as C"),
    Wait("flypend replay run-out/run.nc", "a saved run as a page"),
    Wait("flypend lab --no-browser", "until the laboratory gives its address"),
)


def waited(command: str, folder: Path, cache: Path) -> tuple[float, float]:
    """Seconds of wall and of processor that `command` takes in `folder`; for the laboratory, until its first line."""
    environment = os.environ | {
        "FLYPEND_CACHE": str(cache), "PYTHONPYCACHEPREFIX": str(folder / "bytecode"), "PYTHONDONTWRITEBYTECODE": "",
    }  # fmt: skip
    arguments = [sys.executable, "-m", *command.split()]
    before, begin = _children(), time.perf_counter()
    if command.startswith("flypend lab"):
        with subprocess.Popen(arguments, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            process.stdout.readline()
            spent = time.perf_counter() - begin
            process.send_signal(signal.SIGTERM)
    else:
        subprocess.run(arguments, cwd=folder, env=environment, check=True, capture_output=True)
        spent = time.perf_counter() - begin
    return spent, _children() - before


def _children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    """Print the table."""
    where, words = machine(), sys.argv[1:]
    chosen = [wait for wait in WAITS if not words or any(word in wait.command for word in words)]
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        for name in ("swing-up.toml", "my_law.py", "studies/hanging.toml"):
            (folder / Path(name).name).write_bytes((EXAMPLES / name).read_bytes())
        for warm in ("flypend run 1 --quick --html run.html", *(wait.command for wait in chosen)):  # bytecode
            waited(warm, folder, folder / "warm")
        print(f"{where['processor']}, {where['cores']} cores (load {where['load']:.1f}), {where['date']}.\n")
        print("| command | what | first, s | again, s | of processor |\n|---|---|---|---|---|", flush=True)
        for wait in chosen:
            with tempfile.TemporaryDirectory() as cache:
                (first, _), (again, processor) = (waited(wait.command, folder, Path(cache)) for _ in range(2))
            print(f"| `{wait.command}` | {wait.what} | {first:.1f} | {again:.1f} | {processor:.1f} |", flush=True)


if __name__ == "__main__":
    main()
