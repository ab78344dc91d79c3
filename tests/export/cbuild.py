"""Compilers and checkers for the tests of exported C: one that is missing fails them (`make test-tools`)."""

import shutil
import subprocess
from pathlib import Path

STANDINS = Path(__file__).parent / "standins"
# As users compile: the last two see what a processor without doubles pays for.
WARNINGS = (
    "-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Wshadow", "-Wfloat-equal", "-Wdouble-promotion", "-Werror",
)  # fmt: skip


def tool(name):
    path = shutil.which(name)
    assert path, f"{name} is missing: run `make test-tools`"
    return path


def run(command, folder=None, given=None, check=True):
    """What `command` prints; if it fails and `check` is set, so does the test, with what it said."""
    done = subprocess.run(
        [tool(command[0]), *map(str, command[1:])], cwd=folder, input=given, capture_output=True, text=True, check=False
    )
    assert not check or done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout if check else done


def build(folder, sources, target, compiler="gcc", flags=()):
    standard = "-std=c++14" if compiler.endswith("++") else "-std=c99"
    run([compiler, standard, "-O1", *WARNINGS, *flags, *sources, "-lm", "-o", target], folder)
    return folder / target
