"""What an exported law costs: laws × precisions.

    python benchmarks/export_cost.py [--law inverted ...]

For flypend_step followed by flypend_mix, checks included, which take the same path at every valid state: operations of
the programs; x86-64 instructions per call by callgrind and microseconds on this core (gcc -O2); for a Cortex-M4F
(arm-none-eabi-gcc -O2) .text and stack (-fstack-usage) in bytes, cycles, and the share of an STM32F405 at 168 MHz that
500 calls a second take.

Cycles are counted, not measured, on code compiled with -fno-inline, which is slower: every instruction of the functions
that a call runs, in line, branches as if taken, the checking loop times its length, with the timings of the Cortex-M4
Technical Reference Manual: 14 for VDIV and VSQRT, 2 for a load or store, 1 + n for n words, 3 for a fused product or a
branch, 1 for the rest. Wait states of the flash, which the STM32's accelerator hides while code runs straight, and
stalls of a cycle on a value that was just computed are not in it. Double precision has no hardware there.
"""

import argparse
import re
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

import flypend as fp
from flypend.export import vectors
from flypend.export.interface import interface
from flypend.export.library import Library

LAWS = {
    "corrected": fp.laws.corrected,
    "printed": fp.laws.printed,
    "lqr": fp.laws.lqr,
    "inverted": fp.laws.inverted,
    "light": lambda: fp.laws.inverted(form="light"),
}
ARM = ("-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard", "-std=c99", "-O2")
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
int main(void)
{
    flypend_rotors r;
    for (int i = 0; i < CALLS; i++) {
        once(&flypend_vectors[i], &r);
    }
    return r.force[0] < 0;
}
"""
LOOPS = {"numbers": 4}  # a call of `numbers` runs its loop this often: most vectors have three entries, R has nine


def main() -> None:
    """Print one row per law and precision."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--law", action="append", choices=LAWS)
    parser.add_argument("--precision", action="append", choices=("double", "float"))
    parser.add_argument("--vehicle", default="hehn2011")
    given = parser.parse_args()
    vehicle = fp.vehicle(given.vehicle)
    names = ("ops", "instr", "us", "text", "stack", "cycles", "kHz", "M4%")
    print(f"{'law':10} {'reals':7}", *(f"{name:>7}" for name in names))
    for name in given.law or LAWS:
        for precision in given.precision or ("double", "float"):
            print(row(name, LAWS[name]().bind(vehicle), vehicle, precision), flush=True)


def row(name, law, vehicle, precision):
    """The line of `law` in `precision`."""
    made = interface(law, vehicle)
    ops = sum(sum(program.counts().values()) for program in (made.step, made.mix, made.check))
    with tempfile.TemporaryDirectory() as text:
        folder = fp.export_c(law, vehicle, Path(text) / "c", precision=precision)
        instructions = callgrind(folder)
        size, stack, cycles = cortex_m4(folder)
    cells = [ops, instructions, f"{microseconds(law, vehicle, precision):.2f}", size, stack]
    if precision == "double":
        cells += ["soft", "-", "-"]
    else:
        cells += [cycles, f"{CLOCK / cycles / 1e3:.1f}", f"{100 * RATE * cycles / CLOCK:.2f}"]
    return " ".join([f"{name:10} {precision:7}", *(f"{cell:>7}" for cell in cells)])


def run(*command, folder):
    """What a command prints; it must succeed."""
    return subprocess.run(list(map(str, command)), cwd=folder, check=True, capture_output=True, text=True).stdout


def callgrind(folder):
    """Instructions of one call on x86-64."""
    (folder / "main.c").write_text(MAIN)
    run("gcc", "-std=gnu99", "-O2", f"-DCALLS={CALLS}", "main.c", "flypend_law.c", "-lm", "-o", "main", folder=folder)
    tool = ("valgrind", "--tool=callgrind", "--toggle-collect=once", "--callgrind-out-file=calls")
    done = subprocess.run([*tool, "./main"], cwd=folder, check=True, capture_output=True, text=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1]) // CALLS


def microseconds(law, vehicle, precision):
    """Time of one call on this core: the best of five."""
    code = Library(law, vehicle, precision)
    state, reference = vectors.random_inputs(vehicle, 4000, 1, precision)
    best = np.inf
    for _ in range(5):
        begin = time.perf_counter()
        code.step(state, reference)
        best = min(best, time.perf_counter() - begin)
    return 1e6 * best / len(state)


def cortex_m4(folder):
    """Bytes of .text of what a call needs, bytes of stack, and cycles of one call."""
    fast, plain = compiled_for_m4(folder, "fast"), compiled_for_m4(folder, "plain", "-fno-inline")
    stack = {}
    for line in (folder / "fast.su").read_text().splitlines():
        where, size, _ = line.split("\t")
        stack[where.split(":")[-1]] = int(size)
    sizes = {}
    for line in run("arm-none-eabi-nm", "-S", "fast.o", folder=folder).splitlines():
        if len(cells := line.split()) == 4:
            sizes[cells[3]] = int(cells[1], 16)
    ends = ("flypend_step", "flypend_mix")
    needed = set().union(*(reached(fast, name) for name in ends))
    deepest = max(depth(fast, stack, name) for name in ends)
    return sum(sizes[name] for name in needed), deepest, sum(spent(plain, name) for name in ends)


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


def spent(functions, name):
    """Cycles of `name` and of its calls."""
    own = sum(cost(*instruction) for instruction in functions[name])
    return LOOPS.get(name, 1) * (own + sum(spent(functions, other) for other in called(functions, name)))


def cost(word, operands):
    """Cycles of one instruction of a Cortex-M4F."""
    if word.startswith(("vdiv", "vsqrt")):
        return 14
    if word.startswith(("vldm", "vstm", "ldm", "stm", "push", "pop", "vpush", "vpop")):
        return 1 + registers(operands)
    if word.startswith(("vldr", "vstr", "ldr", "str", "ldrd", "strd")):
        return 3 if word.startswith(("ldrd", "strd")) else 2
    if word.startswith(("vmla", "vmls", "vfma", "vfms", "vfnm", "vnml")):
        return 3
    return 3 if re.fullmatch(r"b(l|x|lx)?(\.\w+)?|b\w\w(\.\w)?|cbn?z", word) else 1


def registers(operands):
    """How many words the registers in braces hold."""
    count = 0
    for part in re.search(r"{(.*)}", operands)[1].split(","):
        first, _, last = part.strip().partition("-")
        words = 2 if first.startswith("d") else 1
        count += words * (int(last[1:]) - int(first[1:]) + 1 if last else 1)
    return count


if __name__ == "__main__":
    main()
