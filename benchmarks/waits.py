"""What a user waits for each common command: `python -m benchmarks.waits`, some six minutes on two idle cores.

Every command is a process of its own, first with an empty cache of compiled kernels, as on the first day, then again.
Its modules are compiled to bytecode before, as pip does. Prints a table for docs/flight/engine.md.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from benchmarks.report import machine

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


def waited(command: str, folder: Path, cache: Path) -> float:
    """Seconds on the wall that `command` takes in `folder`; for the laboratory, until its first line."""
    environment = os.environ | {
        "FLYPEND_CACHE": str(cache), "PYTHONPYCACHEPREFIX": str(folder / "bytecode"), "PYTHONDONTWRITEBYTECODE": "",
    }  # fmt: skip
    arguments = [sys.executable, "-m", *command.split()]
    begin = time.perf_counter()
    if command.startswith("flypend lab"):
        with subprocess.Popen(arguments, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            process.stdout.readline()
            spent = time.perf_counter() - begin
            process.send_signal(signal.SIGTERM)
        return spent
    subprocess.run(arguments, cwd=folder, env=environment, check=True, capture_output=True)
    return time.perf_counter() - begin


def main() -> None:
    """Print the table."""
    where = machine()
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        for name in ("swing-up.toml", "my_law.py", "studies/hanging.toml"):
            (folder / Path(name).name).write_bytes((EXAMPLES / name).read_bytes())
        waited("flypend --version", folder, folder)
        waited("flypend paper", folder, folder / "warm")  # bytecode of everything
        print(f"{where['processor']}, {where['cores']} cores (load {where['load']:.1f}), {where['date']}.\n")
        print("| command | what | first, s | again, s |\n|---|---|---|---|", flush=True)
        for wait in WAITS:
            with tempfile.TemporaryDirectory() as cache:
                first, again = (waited(wait.command, folder, Path(cache)) for _ in range(2))
            print(f"| `{wait.command}` | {wait.what} | {first:.1f} | {again:.1f} |", flush=True)


if __name__ == "__main__":
    main()
