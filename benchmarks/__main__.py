"""Run everything and write the tables: `python -m benchmarks [folder]`, or `make bench`."""

import sys
from itertools import chain
from pathlib import Path

from benchmarks.compare import compare
from benchmarks.lines import lines
from benchmarks.report import machine, markdown, save, with_ratios
from benchmarks.versions import goals


def say(text: str) -> None:
    """To the person who waits."""
    print(text, file=sys.stderr, flush=True)


def main() -> None:
    """Everything, in some twenty minutes."""
    folder, where = Path(sys.argv[1] if len(sys.argv) > 1 else "bench-out"), machine()
    rows = with_ratios(compare(say))
    found = []
    for line in chain(lines(), goals()):
        say(f"{line.name}: {line.value:.4g} {line.unit}")
        found.append(line)
    save(folder, rows, found, where)
    print(markdown(rows, found, where))


if __name__ == "__main__":
    main()
