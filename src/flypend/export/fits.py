"""What a law takes of a firmware's processor, and the error that says by how much it is too much."""

from __future__ import annotations

import re
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory

from flypend.errors import InputError
from flypend.export.interface import Interface
from flypend.signals import polling

COMPILER = "arm-none-eabi-gcc"
# Cycles of an operation, about those of the learned law, whose step is the longest (benchmarks/app_cost.py).
CYCLES_OF_OPERATION = 7
FLAGS = ("-Os", "-fno-math-errno", "-std=gnu11")


@dataclass(frozen=True)
class Budget:
    """What a firmware has for a law.

    Parameters
    ----------
    of : str
        Whose processor, in words.
    processor : tuple of str
        The compiler's flags for it.
    stack, memory, code : int
        Bytes of stack around a step of the law, of static memory and of code that the app takes beside the law's.
    most : Mapping
        Largest amount of each quantity that is limited.
    """

    of: str
    processor: tuple[str, ...]
    stack: int
    memory: int
    code: int
    most: Mapping[str, int] = field(hash=False)


BUDGETS: Mapping[str, Budget] = {
    # App: benchmarks/app_cost.py prints the sums. Cycles: of the 168,000 of a step of the firmware's loop. Stack: what
    # the firmware's own controllers leave of the stabilizer task's 1,800 bytes. Flash and RAM: what a build for cf2
    # leaves free beside the firmware, less a tenth.
    "crazyflie": Budget(
        of="a Crazyflie",
        processor=("-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"),
        stack=256,
        memory=914,
        code=9_724,
        most={"cycles": 100_000, "bytes of stack": 1_000, "bytes of flash": 650_000, "bytes of RAM": 33_000},
    ),
    # App: tests/export/test_px4.py compares with the module beside the law. Cycles: a quarter of a period
    # of the gyroscope's default 400 Hz on the slowest of its processors, an STM32F7 at 216 MHz. Stack: what the
    # module's own queue (PX4_STACK) leaves when a kilobyte goes to uORB, interrupts and logging. Flash and RAM differ
    # by board and by its list of modules.
    "px4": Budget(
        of="a flight controller with PX4",
        processor=("-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard"),
        stack=480,
        memory=1_500,
        code=8_000,
        most={"cycles": 135_000, "bytes of stack": 3_000},
    ),
}
PX4_STACK = 4_096


def check_fits(made: Interface, texts: Mapping[str, str], budget: Budget) -> Mapping[str, int]:
    """Return what a law takes of `budget`; raise InputError for too much, with each quantity and by how much.

    Cycles are estimated. The others are those of the firmware's compiler for the `texts` by file name, where this
    machine has it, which a build needs in any case.
    """
    flown = made.board if made.sensing is None else made.sensing.board
    taken = {"cycles": CYCLES_OF_OPERATION * flown.operations()}
    if shutil.which(COMPILER):
        taken |= measure_size(tuple(sorted(texts.items())), budget)
    over = {what: number for what, number in taken.items() if number > budget.most.get(what, number)}
    if over:
        wanted = ", ".join(f"{budget.most[what]:,} {what}" for what in over)
        came = ", ".join(
            f"{n:,} {what}, {100 * (n / budget.most[what] - 1):.0f} % too many" for what, n in over.items()
        )
        raise InputError("law", f"one whose step takes at most {wanted} of {budget.of}", f"{made.law.name}: {came}")
    return taken


@lru_cache(maxsize=8)
def measure_size(texts: tuple[tuple[str, str], ...], budget: Budget) -> dict[str, int]:
    """Return the bytes of stack, flash and RAM that an app with the computer of `texts`, by file, takes of `budget`."""
    names = [Path(name).stem for name, _ in texts if name.endswith(".c")]
    computer = "sensors" if "flypend_sensors" in names else "board"
    header = "flypend_sensors.h" if computer == "sensors" else "flypend_law.h"
    with TemporaryDirectory() as place:
        folder = Path(place)
        for name, content in texts:
            (folder / name).write_text(content, encoding="utf-8")
        (folder / "memory.c").write_text(f'#include "{header}"\nflypend_{computer} held;\n', encoding="utf-8")
        names.append("memory")
        flags = (*budget.processor, *FLAGS, "-fcallgraph-info=su")
        _run(folder, COMPILER, *flags, "-c", *(f"{name}.c" for name in names))
        sizes = _run(folder, "arm-none-eabi-size", *(f"{name}.o" for name in names)).splitlines()[1:]
        text, data, bss = (sum(int(line.split()[i]) for line in sizes) for i in range(3))
        graph = "".join((folder / f"{name}.ci").read_text(encoding="utf-8") for name in names)
        depth = max(deepest(graph, entry) for entry in (f"flypend_{computer}_step", "flypend_plan_command"))
    return {
        "bytes of stack": budget.stack + depth,
        "bytes of flash": budget.code + text + data,
        "bytes of RAM": budget.memory + data + bss,
    }


def deepest(graph: str, entry: str) -> int:
    """Return the bytes of stack of the deepest calls of `entry` in call graphs of GCC; nothing in them recurses.

    Static functions are called file:name.
    """
    nodes = re.findall(r'^node: { title: "([^"]+)" label: "[^"]*?(\d+) bytes', graph, re.MULTILINE)
    frames = {name: int(size) for name, size in nodes}
    calls: dict[str, set[str]] = {}
    for caller, called in re.findall(r'sourcename: "([^"]+)" targetname: "([^"]+)"', graph):
        calls.setdefault(caller, set()).add(called)

    @cache
    def depth(name: str) -> int:
        return frames.get(name, 0) + max(map(depth, calls.get(name, ())), default=0)

    size: int = depth(entry)
    return size


def _run(folder: Path, *words: str) -> str:
    done = polling.run(words, cwd=folder, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)}\n{done.stderr}")
    return str(done.stdout)
