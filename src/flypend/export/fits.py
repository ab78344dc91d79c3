"""What a law takes of a Crazyflie's processor, and the error that says by how much it is too much."""

from __future__ import annotations

import re
import shutil
from collections.abc import Mapping
from functools import cache, lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory

from flypend.errors import InputError
from flypend.export.interface import Interface
from flypend.signals import waiting

COMPILER = "arm-none-eabi-gcc"
FLAGS = ("-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard", "-Os", "-fno-math-errno", "-std=gnu11")
# Cycles of an operation, about those of the learned law, whose step is the longest (benchmarks/app_cost.py).
CYCLES_OF_OPERATION = 7
# Stack of the app's controller around a step of the law, and its static memory and code beside the law's
# (benchmarks/app_cost.py prints their sums).
APP_STACK, APP_MEMORY, APP_CODE = 248, 850, 9_400
# Cycles: of the 168,000 of a step of the firmware's loop. Stack: what the firmware's own controllers leave of the
# stabilizer task's 1,800 bytes. Flash and RAM: what a build for cf2 leaves free beside the firmware, less a tenth.
MOST = {"cycles": 100_000, "bytes of stack": 1_000, "bytes of flash": 650_000, "bytes of RAM": 33_000}


def check_fits(made: Interface, texts: Mapping[str, str]) -> None:
    """Raise InputError for a law that takes more than there is, with each quantity and by how much it is exceeded.

    Cycles are estimated. The others are those of the firmware's compiler for the `texts` by file name, where this
    machine has it, which a build needs in any case.
    """
    taken = {"cycles": CYCLES_OF_OPERATION * made.board.operations()}
    if shutil.which(COMPILER):
        taken |= compiled(texts["flypend_law.h"], texts["flypend_law.c"])
    over = {what: number for what, number in taken.items() if number > MOST[what]}
    if over:
        wanted = ", ".join(f"{MOST[what]:,} {what}" for what in over)
        came = ", ".join(f"{n:,} {what}, {100 * (n / MOST[what] - 1):.0f} % too many" for what, n in over.items())
        raise InputError("law", f"one whose step takes at most {wanted} of a Crazyflie", f"{made.law.name}: {came}")


@lru_cache(maxsize=8)
def compiled(header: str, source: str) -> dict[str, int]:
    """Return the bytes of stack, flash and RAM of an app with the law of `header` and `source`."""
    with TemporaryDirectory() as place:
        folder = Path(place)
        (folder / "flypend_law.h").write_text(header, encoding="utf-8")
        (folder / "flypend_law.c").write_text(source, encoding="utf-8")
        (folder / "memory.c").write_text('#include "flypend_law.h"\nflypend_board board;\n', encoding="utf-8")
        sources = ("flypend_law.c", "memory.c")
        _run(folder, COMPILER, *FLAGS, "-fcallgraph-info=su", "-c", *sources)
        sizes = _run(folder, "arm-none-eabi-size", "flypend_law.o", "memory.o").splitlines()[1:]
        text, data, bss = (sum(int(line.split()[i]) for line in sizes) for i in range(3))
        depth = deepest((folder / "flypend_law.ci").read_text(encoding="utf-8"), "flypend_board_step")
    return {
        "bytes of stack": APP_STACK + depth,
        "bytes of flash": APP_CODE + text + data,
        "bytes of RAM": APP_MEMORY + data + bss,
    }


def deepest(graph: str, entry: str) -> int:
    """Return the bytes of stack of the deepest calls of `entry` in a call graph of GCC; nothing in it recurses."""
    frames = {name: int(size) for name, size in re.findall(r'^node: .*label: "([\w.]+)\\n.*?(\d+) bytes', graph, re.M)}
    calls: dict[str, set[str]] = {}
    for caller, called in re.findall(r'sourcename: "(?:[^":]*:)?([\w.]+)" targetname: "(?:[^":]*:)?([\w.]+)"', graph):
        calls.setdefault(caller, set()).add(called)

    @cache
    def depth(name: str) -> int:
        return frames.get(name, 0) + max(map(depth, calls.get(name, ())), default=0)

    size: int = depth(entry)
    return size


def _run(folder: Path, *words: str) -> str:
    done = waiting.run(words, cwd=folder, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)}\n{done.stderr}")
    return str(done.stdout)
