"""Run everything and write the tables: `python -m benchmarks [folder]`, or `make bench`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

from benchmarks.compare import compare
from benchmarks.lines import LINES, Line
from benchmarks.problem import Problem
from benchmarks.report import markdown, save, with_ratios
from benchmarks.results import machine
from benchmarks.versions import goals


def say(text: str) -> None:
    """To the person who waits."""
    print(text, file=sys.stderr, flush=True)


def gathered(groups: dict[str, Callable[[], Iterable[Line]]]) -> tuple[list[Line], dict[str, str]]:
    """The lines of all `groups`, and why the rest of a group is missing, by its name."""
    found, missing = [], {}
    for name, group in groups.items():
        try:
            for line in group():
                say(f"{line.name}: {line.value:.4g} {line.unit}")
                found.append(line)
        except Exception as error:  # whatever it is: the others are printed, and the table says what is missing
            missing[name] = f"{type(error).__name__}: {error}"
            say(f"{name}: left out, {missing[name]}")
    return found, missing


def main() -> None:
    """Everything, in some twenty minutes; exit with 1 if anything is missing."""
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", nargs="?", type=Path, default=Path("bench-out"))
    parser.add_argument("--share", type=float, default=1.0, help="of the runs; less is a trial of the benchmark itself")
    asked = parser.parse_args()
    where = machine() | {"share": asked.share}
    rows, missing = compare(say, asked.share)
    groups: dict[str, Callable[[], Iterable[Line]]] = {
        group.__name__: partial(group, Problem(), asked.share) for group in LINES
    }
    found, rest = gathered(groups | {"versions": partial(goals, asked.share)})
    rows = with_ratios(rows)
    save(asked.folder, rows, found, missing | rest, where)
    print(markdown(rows, found, missing | rest, where))
    sys.exit(bool(missing | rest))


if __name__ == "__main__":
    main()
