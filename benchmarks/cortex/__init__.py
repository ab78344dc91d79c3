"""Programs on the Cortex-M4F of QEMU's mps2-an386: what a call of a function executes, and the cycles that takes.

Cycles are those of the Cortex-M4 Technical Reference Manual for the instructions that ran: 14 for VDIV and VSQRT, 2 for
a load or store, 1 + n for n words, 3 for a fused product or a branch that is taken, 1 for the rest. Wait states of the
flash, which the STM32's accelerator hides while code runs straight, and stalls of a cycle on a value that was just
computed are not in it.
"""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

HERE = Path(__file__).parent
FLAGS = ("-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard")
LINKED = ("--specs=nano.specs", "--specs=nosys.specs", "-nostartfiles", "-T", str(HERE / "an386.ld"))
QEMU = ("qemu-system-arm", "-M", "mps2-an386", "-display", "none", "-monitor", "none", "-serial", "none")


def cycles(elf: Path, function: str) -> list[int]:
    """Cycles of each call of `function`, which is called by BL, while the program `elf` runs."""
    return [spent for _, spent in executed(elf, function)]


def executed(elf: Path, function: str) -> list[tuple[int, int]]:
    """Instructions and cycles of each call of `function`, as in `cycles`."""
    code = disassembled(elf)
    entry = next(at for at, (_, _, _, name) in code.items() if name == function)
    # Of each instruction what follows it, and what it costs if that comes next, and if not.
    prices = {
        at: (at + size, cost(word, operands, taken=False), cost(word, operands))
        for at, (word, operands, size, _) in code.items()
    }
    trace = elf.with_suffix(".trace")
    semihosting = ("-semihosting-config", "enable=on,target=native")
    steps = ("-singlestep", "-d", "exec,nochain", "-D", str(trace))
    subprocess.run([*QEMU, *semihosting, *steps, "-kernel", str(elf)], check=True, capture_output=True)
    calls, back, count, spent, before = [], None, 0, 0, None
    with trace.open() as lines:
        for line in lines:
            at = int(line.split("/", 2)[1], 16)
            if back is not None and before is not None:
                following, straight, taken = prices[before]
                count += 1
                spent += straight if at == following else taken
            if at == back:
                calls.append((count, spent))
                back = None
            if back is None and at == entry and before is not None:
                back, count, spent = before + code[before][2], 0, 0
            before = at
    trace.unlink()
    return calls


def disassembled(elf: Path) -> dict[int, tuple[str, str, int, str]]:
    """Mnemonic, operands, bytes, and the function if it is its first, of every instruction by address."""
    listed = subprocess.run(["arm-none-eabi-objdump", "-d", str(elf)], check=True, capture_output=True, text=True)
    code, name = {}, ""
    for line in listed.stdout.splitlines():
        if head := re.match(r"[0-9a-f]+ <([\w.]+)>:", line):
            name = head[1]
        elif body := re.match(r"\s*([0-9a-f]+):\t((?:[0-9a-f]{4} ?)+)\s*\t(\S+)\s*(.*)", line):
            code[int(body[1], 16)] = (body[3], body[4], 2 * len(body[2].split()), name)
            name = ""
    return code


def cost(word: str, operands: str, *, taken: bool = True) -> int:
    """Cycles of one instruction."""
    if word.startswith(("vdiv", "vsqrt")):
        return 14
    if word.startswith(("vldm", "vstm", "ldm", "stm", "push", "pop", "vpush", "vpop")):
        return 1 + _registers(operands)
    if word.startswith(("vldr", "vstr", "ldr", "str", "ldrd", "strd")):
        return 3 if word.startswith(("ldrd", "strd")) else 2
    if word.startswith(("vmla", "vmls", "vfma", "vfms", "vfnm", "vnml")):
        return 3
    branch = re.fullmatch(r"b(l|x|lx)?(\.\w+)?|b\w\w(\.\w)?|cbn?z", word)
    return 3 if branch and taken else 1


def _registers(operands: str) -> int:
    """How many words the registers in braces hold."""
    count = 0
    for part in re.search(r"{(.*)}", operands)[1].split(","):
        first, _, last = part.strip().partition("-")
        words = 2 if first.startswith("d") else 1
        count += words * (int(last[1:]) - int(first[1:]) + 1 if last else 1)
    return count
