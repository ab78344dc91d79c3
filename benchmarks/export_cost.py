"""What exported code costs: laws × precisions.

    python -m benchmarks.export_cost [--law inverted ...]

For the whole flight computer, flypend_board_step, and for the bare law, flypend_step followed by flypend_mix; checks
included, which take the same path at every valid state: operations of the programs; x86-64 instructions per call by
callgrind and microseconds on this core (gcc -O2); for a Cortex-M4F (arm-none-eabi-gcc -O2) .text and stack
(-fstack-usage) in bytes, cycles, and the share of an STM32F405 at 168 MHz that 500 calls a second take.

Cycles are those of the instructions that QEMU's Cortex-M4F executes, with the timings of the manual
(benchmarks/cortex): the most of five calls. Double precision has no hardware there.
"""

import argparse
import re
import subprocess
import tempfile
import time
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

import flypend as fp
from benchmarks import cortex, run
from flypend.compile.scratch import matrices
from flypend.export import vectors
from flypend.export.interface import interface
from flypend.export.library import CompiledBoard, library

LAWS = {
    "corrected": fp.laws.corrected,
    "lqr": fp.laws.lqr,
    "inverted": fp.laws.inverted,
    "light": lambda: fp.laws.inverted(form="light"),
    "learned": fp.laws.learned,
    "almost_global": fp.laws.almost_global,
    "policy": lambda: fp.laws.trained(mlp()),
}
HIDDEN = 64  # two layers of it are the default network of Stable-Baselines3
ARM = (*cortex.FLAGS, "-std=c99", "-O2")
CLOCK, RATE = 168e6, 500.0
CALLS = 100
MAIN = """
#include "flypend_law.h"
#include "flypend_vectors.h"
void once(const flypend_vector *v, flypend_rotors *r);
__attribute__((noinline)) void once(const flypend_vector *v, flypend_rotors *r)
{
    flypend_wrench w;
    (void)flypend_step(&v->state, &v->reference, &flypend_default_gains, &flypend_default_params, &w);
    (void)flypend_mix(&w, &flypend_default_params, r);
}
static flypend_board board;
void period(const flypend_period *p, flypend_rotors *r);
__attribute__((noinline)) void period(const flypend_period *p, flypend_rotors *r)
{
    (void)flypend_board_step(&board, &p->measurement, &p->path, &flypend_default_params, r);
}
int main(void)
{
    flypend_rotors r;
    (void)flypend_board_begin(&board, &flypend_default_gains, &flypend_default_params);
    for (int i = 0; i < CALLS; i++) {
        once(&flypend_vectors[i], &r);
        period(&flypend_flights[i], &r);
    }
    return r.force[0] < 0;
}
"""


def mlp() -> list[Any]:
    """Return layers of a policy: what they weigh makes no difference to the cost."""
    rng, sizes = np.random.default_rng(0), (24, HIDDEN, HIDDEN, 4)
    layers = [[rng.normal(0, 0.1, (after, before)), np.zeros(after), "tanh"] for before, after in pairwise(sizes)]
    layers[-1].pop()
    return layers


# What is measured: the functions that are called, and that of MAIN which calls them.
PARTS = {"board": (("flypend_board_step",), "period"), "law": (("flypend_step", "flypend_mix"), "once")}


def main() -> None:
    """Print one row per law and precision."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--law", action="append", choices=LAWS)
    parser.add_argument("--precision", action="append", choices=("double", "float"))
    parser.add_argument("--vehicle", default="hehn2011")
    given = parser.parse_args()
    vehicle = fp.vehicle(given.vehicle)
    names = ("ops", "instr", "us", "text", "stack", "cycles", "kHz", "M4%")
    print(f"| law, part, precision | {' | '.join(names)} |\n|{'---|' * (len(names) + 1)}")
    for name in given.law or LAWS:
        for precision in given.precision or ("double", "float"):
            for line in rows(name, LAWS[name]().bind(vehicle), vehicle, precision):
                print(line, flush=True)


def rows(name, law, vehicle, precision):
    """The rows of `law` in `precision`: the board, and the bare law."""
    made = interface(law, vehicle)
    own = {key: sum(program.counts().values()) for key, program in made.all_programs().items()}
    checks = own["rod"] + own["attitude"]
    ops = {"board": made.board.operations() + checks, "law": own["law"] + own["share"] + checks}
    with tempfile.TemporaryDirectory() as text:
        folder = fp.export_c(law, vehicle, Path(text) / "c", precision=precision, check=False)
        for part, (functions, caller) in PARTS.items():
            instructions = callgrind(folder, caller)
            size, stack = cortex_m4(folder, functions, made, 8 if precision == "double" else 4)
            cells = [ops[part], instructions, f"{microseconds(law, vehicle, precision, part):.2f}", size, stack]
            if precision == "double":
                cells += ["soft", "-", "-"]
            else:
                cycles = executed(folder, caller)
                cells += [cycles, f"{CLOCK / cycles / 1e3:.1f}", f"{100 * RATE * cycles / CLOCK:.2f}"]
            yield f"| {name}, {part}, {precision} | {' | '.join(map(str, cells))} |"


@cache
def built(folder, target, *command):
    """Compile with `command` to the file `target` in `folder`, once for all that is measured of it."""
    run(*command, "-o", target, folder=folder)


def callgrind(folder, caller):
    """Instructions of one call of the function `caller` on x86-64."""
    (folder / "main.c").write_text(MAIN)
    built(folder, "main", "gcc", "-std=gnu99", "-O2", f"-DCALLS={CALLS}", "main.c", "flypend_law.c", "-lm")
    tool = ("valgrind", "--tool=callgrind", f"--toggle-collect={caller}", "--callgrind-out-file=calls")
    done = subprocess.run([*tool, "./main"], cwd=folder, check=True, capture_output=True, text=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1]) // CALLS


def microseconds(law, vehicle, precision, part):
    """Time of one call on this core: the best of five."""
    code = library(law, vehicle, precision)
    fly = _boards(code, precision) if part == "board" else _steps(code, vehicle, precision)
    best = np.inf
    for _ in range(5):
        begin = time.perf_counter()
        count = fly()
        best = min(best, (time.perf_counter() - begin) / count)
    return 1e6 * best


def _steps(code, vehicle, precision):
    state, reference = vectors.random_inputs(vehicle, 4000, 1, precision)
    return lambda: len(code.step(state, reference)[0])


def _boards(code, precision):
    flown = vectors.flights(code.made.loop, 1, 400, 1, precision)
    measurement, path = code.array(flown.measurement), code.array(flown.path)
    board, count = CompiledBoard(code), len(measurement)
    rotors, status = np.empty((count, code.made.rotors.length), code.real), np.empty(count, np.int32)

    def fly():
        code.call("flypend_fly", count, board.numbers, measurement, path, code.params, rotors, status)
        return count

    return fly


def executed(folder, caller):
    """Cycles of the dearest of five calls of the function `caller` on a Cortex-M4F."""
    sources = ("main.c", "flypend_law.c", cortex.HERE / "start.c")
    words = (*cortex.FLAGS, "-std=gnu99", "-O2", "-DCALLS=5", *cortex.LINKED, *sources, "-lm")
    built(folder, "main.elf", "arm-none-eabi-gcc", *words)
    return max(cortex.cycles(folder / "main.elf", caller))


def cortex_m4(folder, ends, made, bytes_):
    """Bytes of code and tables that calls of `ends` need, with numbers of `bytes_`, and bytes of stack."""
    fast = compiled_for_m4(folder, "fast")
    stack = {}
    for line in (folder / "fast.su").read_text().splitlines():
        where, size, _ = line.split("\t")
        stack[where.split(":")[-1]] = int(size)
    sizes = {}
    for line in run("arm-none-eabi-nm", "-S", "fast.o", folder=folder).splitlines():
        if len(cells := line.split()) == 4:
            sizes[cells[3]] = int(cells[1], 16)
    needed = set().union(*(reached(fast, name) for name in ends))
    deepest = max(depth(fast, stack, name) for name in ends)
    # A layer that was inlined has no function of its own; its table is needed all the same.
    tables = weights(made)
    plain = compiled_for_m4(folder, "plain", "-fno-inline") if tables else {}
    held = set().union(*(reached(plain, name) for name in ends if tables)) & tables.keys()
    return sum(sizes[name] for name in needed) + sum(bytes_ * tables[name] for name in held), deepest


def weights(made):
    """Number of weights in the table of every function that is the layer of a network."""
    programs = [*made.all_programs().values(), *made.board.programs]
    return {
        f"{program.name}_{i}": len(layer.rows) * len(layer.columns)
        for program in programs
        for i, layer in enumerate(matrices(program))
    }


@cache
def compiled_for_m4(folder, name, *flags):
    """Instructions of every function of the law compiled to `name`.o, all in one section, so that calls have names."""
    run("arm-none-eabi-gcc", *ARM, *flags, "-fstack-usage", "-c", "flypend_law.c", "-o", f"{name}.o", folder=folder)
    return disassembled(run("arm-none-eabi-objdump", "-d", "--no-show-raw-insn", f"{name}.o", folder=folder))


def disassembled(text):
    """Instructions (mnemonic, operands) of every function."""
    functions, current = {}, None
    for line in text.splitlines():
        if head := re.match(r"[0-9a-f]+ <([\w.]+)>:", line):
            current = functions.setdefault(head[1], [])
        elif current is not None and (body := re.match(r"\s+[0-9a-f]+:\s+([a-z]\S*)\s*(.*)", line)):
            current.append((body[1], body[2]))
    return functions


def called(functions, name):
    """Functions of the file that `name` calls, once per call."""
    for word, operands in functions[name]:
        target = re.search(r"<([\w.]+)>", operands)
        if word in ("bl", "b.w", "b") and target and target[1] in functions and target[1] != name:
            yield target[1]


def reached(functions, name):
    """`name` and all that it calls."""
    return {name}.union(*(reached(functions, other) for other in set(called(functions, name))))


def depth(functions, stack, name):
    """Bytes of stack of `name` and its deepest call."""
    return stack.get(name, 0) + max(
        (depth(functions, stack, other) for other in set(called(functions, name))), default=0
    )


if __name__ == "__main__":
    main()
