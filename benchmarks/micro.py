"""nmpc for a microcontroller: what its C code costs, and how it flies.

python -m benchmarks.micro --cost
python -m benchmarks.micro --runs 24 --seed 8101 --row nominal --row mismatch

Costs are of an iteration, flypend_nmpc_improve, at the beginning of the plan, when the horizon is longest: with the step
taken at full length, and with all lengths tried; and of flypend_nmpc_command. Cycles are those that QEMU's Cortex-M4F
executes, with the timings of its manual (benchmarks/cortex). A Cortex-M7 executes the same instructions, two at a time
where it can.

Flights are of hehn2011 in MuJoCo, from random starts whose plan, made before the flight, has 150 stages. The C code is
compiled in single precision, and its iterations are there a tick after they begin.
"""

from __future__ import annotations

import argparse
import ctypes
import subprocess
import tempfile
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

import flypend as fp
from benchmarks import cortex
from benchmarks.nmpc import ROWS, VEHICLE, Row
from benchmarks.plans import quantiles
from flypend.export.nmpc import COARSER, PHASES, export_nmpc, programs_of, table_of
from flypend.flight.metrics import wilson
from flypend.laws import Controller
from flypend.planning.coarse import coarsened
from flypend.planning.tracking import Boards, fallback_law, rotors_only

DURATION = 6.0  # s
MEMORY = 50_000  # numbers: more than a flypend_nmpc has
STAGES = 150  # of plans that take the place of the exported one
CLOCKS = {"STM32F405, 168 MHz": 168e6, "STM32H7, 480 MHz": 480e6}
KICKS = (0.0, 1.0)  # m, from the plan: the first is followed; after the second all lengths of the step are tried
HANGING = fp.State(y=(0, 0, -1))
MAIN = """
#include "flypend_nmpc.h"
static flypend_nmpc nmpc;
int main(void)
{
    flypend_real state[24], rotors[FLYPEND_NMPC_ROTORS], command[FLYPEND_NMPC_ROTORS];
    const flypend_nmpc_table *plan = &flypend_nmpc_exported;
    static const flypend_real units[FLYPEND_NMPC_STATE] = {UNITS};
    int i;
    flypend_nmpc_begin(&nmpc, plan);
    for (i = 0; i < FLYPEND_NMPC_STATE; i++) {
        const flypend_real value = plan->states[0][i] * units[i];
        if (i < 24) {
            state[i] = value;
        } else {
            rotors[i - 24] = value;
        }
    }
    state[0] += KICK;
    state[15] += 10 * KICK;
    (void)flypend_nmpc_command(&nmpc, 0, state, rotors, command);
    return flypend_nmpc_improve(&nmpc, FLYPEND_NMPC_STAGE - FLYPEND_NMPC_TICK, state, rotors);
}
"""


def library(folder: Path) -> ctypes.CDLL:
    """Compile the C code for this machine."""
    export_nmpc(hanging(), folder)
    words = ("gcc", "-std=c99", "-O1", "-shared", "-fPIC", "flypend_nmpc.c", "-lm", "-o", "nmpc.so")
    subprocess.run(words, cwd=folder, check=True)
    return ctypes.CDLL(str(folder / "nmpc.so"))


@cache
def hanging() -> fp.Plan:
    """Return the plan that is exported: from hanging at rest."""
    return fp.plan(VEHICLE, HANGING)


class OnBoard(Boards):
    """The flight computer of one flight by C `code`, begun with a `table`; once it refuses, the law flies."""

    def __init__(self, code: ctypes.CDLL, table: Any, stage: float, loop: Any, rotors: Any) -> None:
        super().__init__(loop, fallback_law(None, fp.laws.references.hover()), 0.0, rotors)
        self._code, self._table, self._tick = code, table, stage / PHASES
        self._memory = np.zeros(MEMORY, np.float32)
        code.flypend_nmpc_begin(_address(self._memory), _address(table))
        self._next = 0
        self.flies, self.failed, self.iterations = True, 0, 0

    def planned(self, t: float, state: Any, rotors: Any, outside: Any) -> Any:
        """See `Boards`."""
        if not self.flies:
            return None
        given = [np.asarray(part, np.float32) for part in (state, rotors)]
        found, when = np.zeros(4, np.float32), ctypes.c_float(t)
        everything = [_address(self._memory), when, *(_address(part) for part in given)]
        self.flies = not self._code.flypend_nmpc_command(*everything, _address(found))
        if t + 1e-6 >= self._next * self._tick:
            self._next += 1
            done = self._code.flypend_nmpc_improve(*everything)
            self.iterations += done < 2
            self.failed += done == 1
        return found.astype(float) if self.flies else None


def _address(array: Any) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


def fly(code: ctypes.CDLL, plan: fp.Plan, start: fp.State, plant: fp.Plant) -> tuple[Any, OnBoard]:
    """Return the flight from a `start` by `code` that begins with `plan`, and its computer."""
    coarse, _ = coarsened(plan, COARSER)
    table = np.concatenate([part.ravel() for part in table_of(coarse)]).astype(np.float32)
    computers = []

    def make(loop: Any, rotors: Any) -> OnBoard:
        computers.append(OnBoard(code, table, coarse.stage, loop, rotors))
        return computers[-1]

    law = Controller(
        name="micro", function=rotors_only("micro"), reference=plan.reference, flight_computer=make, because="it is C"
    )
    return fp.simulate(VEHICLE, law, start, DURATION, plant=plant), computers[0]


def flights(code: ctypes.CDLL, row: Row, runs: int, seed: int) -> str:
    """Fly a row by C code, by nmpc and by the law; return what came of it."""
    starts, found = fp.random_starts(runs, seed), []
    for i in range(runs):
        plan = fp.plan(VEHICLE, starts[i])
        if len(plan.commands) != STAGES:
            continue
        plant = row.plant(i)
        run, computer = fly(code, plan, starts[i], plant)
        others = [
            fp.simulate(VEHICLE, law, starts[i], DURATION, plant=plant) for law in (fp.nmpc(), fp.laws.inverted())
        ]
        results = [fp.metrics(each) for each in (run, *others)]
        found.append([plan.excursion, *(r.excursion for r in results), *(r.success for r in results), computer.flies])
        print("  ", i, [round(float(v), 3) for v in found[-1]], computer.iterations, computer.failed, flush=True)
    best, ours, nmpc, law, *stood, flew = np.array(found, dtype=float).T
    low, high = wilson(int(stood[0].sum()), len(found))
    parts = [
        f"succeed {int(stood[0].sum())} of {len(found)} ({low:.1%} to {high:.1%})",
        f"excursion p50, p95 {quantiles(ours, 0.5, 0.95)} m",
        f"nmpc {int(stood[1].sum())}, {quantiles(nmpc, 0.5, 0.95)} m",
        f"law {int(stood[2].sum())}, {quantiles(law, 0.5, 0.95)} m",
        f"ratio to the plan p50, p95 {quantiles(ours / best, 0.5, 0.95)}",
        f"ratio to nmpc p50, p95 {quantiles(ours / nmpc, 0.5, 0.95)}",
        f"given up {int(np.sum(flew == 0))}",
    ]
    return ", ".join(parts)


def costs(folder: Path) -> list[str]:
    """Return lines of costs: operations, memory, cycles and what share of a processor they take."""
    plan = hanging()
    coarse, asked = coarsened(plan, COARSER)
    programs, layout = programs_of(asked)
    counted = {name: sum(program.counts().values()) for name, program in programs.items()}
    lines = [f"operations of the programs: {counted}; entries of F: {layout.of_slopes}"]
    export_nmpc(plan, folder)
    (folder / "main.c").write_text(MAIN.replace("UNITS", ", ".join(f"{unit!r}f" for unit in asked.units.states(asked.rotors).tolist())))
    for kick in KICKS:
        words = (*cortex.FLAGS, "-std=gnu99", "-O2", f"-DKICK={kick}", *cortex.LINKED, "main.c", "flypend_nmpc.c")
        built = ("arm-none-eabi-gcc", *words, str(cortex.HERE / "start.c"), "-lm", "-o", "main.elf")
        subprocess.run(built, cwd=folder, check=True)
        for name in ("improve", "command")[: 1 if kick else 2]:
            (spent,) = cortex.cycles(folder / "main.elf", f"flypend_nmpc_{name}")
            shares = (f"{clock}: {1e3 * spent / hertz:.2f} ms" for clock, hertz in CLOCKS.items())
            lines.append(f"{name}, {kick} m off: {spent} cycles; {', '.join(shares)}")
    sizes = subprocess.run(("arm-none-eabi-size", "main.elf"), cwd=folder, check=True, capture_output=True, text=True)
    return [*lines, sizes.stdout]


def main() -> None:
    """Print costs, or fly rows."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--cost", action="store_true")
    parser.add_argument("--runs", type=int, default=24)
    parser.add_argument("--seed", type=int, default=8101)
    parser.add_argument("--row", choices=ROWS, action="append")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as text:
        if asked.cost:
            for line in costs(Path(text)):
                print(line, flush=True)
            return
        code = library(Path(text))
        for name in asked.row or ("nominal", "mismatch", "blow"):
            print(f"{name}: {flights(code, ROWS[name], asked.runs, asked.seed)}", flush=True)


if __name__ == "__main__":
    main()
