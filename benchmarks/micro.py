"""nmpc for a microcontroller: what its C code costs, and how it flies.

python -m benchmarks.micro --cost
python -m benchmarks.micro --runs 24 --seed 8101 --row nominal --row mismatch

Costs are of an iteration, flypend_nmpc_improve, at the beginning of the plan, when the horizon is longest: with the
step taken at full length, and with all lengths tried; and of flypend_nmpc_command. Instructions are those that QEMU's
Cortex-M4F executes, and cycles have the timings of its manual (benchmarks/cortex). A Cortex-M7 executes the same
instructions, some of them two at a time, and needs one cycle for a fused product where an M4 needs three.

Flights are of hehn2011 in MuJoCo, from random starts whose plan, made before the flight, has 150 stages. The C code is
compiled in single precision, and its iterations are there a tick after they begin.
"""

from __future__ import annotations

import argparse
import ctypes
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import flypend as fp
from benchmarks import cortex, run
from benchmarks.nmpc import ROWS, VEHICLE
from benchmarks.plans import quantiles
from benchmarks.results import record
from flypend.export.plan import COARSER, PHASES, export_nmpc, programs_of, table_of
from flypend.flight.metrics import wilson
from flypend.laws import Controller
from flypend.planning.planner import coarsen
from flypend.planning.tracking import Boards, fallback_law, rotors_only

DURATION = 5.0  # s
MEMORY = 50_000  # numbers: more than a flypend_nmpc has
STAGES = 150  # of plans that take the place of the exported one
CLOCKS = {"F405": 168e6, "H7": 480e6, "A": 1.2e9}  # Hz; A is a Cortex-A
KICK = 1.6  # m/s, after which no length of the first step serves
HANGING = fp.State(y=(0, 0, -1))
MAIN = """
#include "flypend_nmpc.h"
static flypend_nmpc nmpc;
int main(void)
{
    /* Hanging at rest, the rotors at their minimum, as the plan begins. */
    static flypend_real state[24] = {[6] = 1, [10] = 1, [14] = 1, [20] = -1}, rotors[4] = {LEAST, LEAST, LEAST, LEAST};
    flypend_real command[4];
    flypend_nmpc_begin(&nmpc, &flypend_nmpc_exported);
    state[3] += KICK;
    (void)flypend_nmpc_command(&nmpc, 0, state, rotors, command);
    return flypend_nmpc_improve(&nmpc, FLYPEND_NMPC_STAGE - FLYPEND_NMPC_TICK, state, rotors);
}
""".replace("LEAST", f"{VEHICLE.rotor_limits[0]}f")


def library(folder: Path) -> ctypes.CDLL:
    """Compile the C code for this machine."""
    export_nmpc(hanging(), folder)
    words = ("gcc", "-std=c99", "-O1", "-shared", "-fPIC", "flypend_nmpc.c", "-lm", "-o", "nmpc.so")
    run(*words, folder=folder)
    return ctypes.CDLL(str(folder / "nmpc.so"))


@cache
def hanging() -> fp.Plan:
    """Return the plan that is exported: from hanging at rest."""
    return fp.plan(VEHICLE, HANGING)


class OnBoard(Boards):
    """The flight computer of one flight by C `code`, begun with a `table`; when it ends or refuses, the law flies."""

    def __init__(self, code: ctypes.CDLL, table: Any, stage: float, latency: float, loop: Any, rotors: Any) -> None:
        super().__init__(loop, fallback_law(None, fp.laws.references.hover()), latency, rotors)
        self._code, self._table, self._tick = code, table, stage / PHASES
        self._memory = np.zeros(MEMORY, np.float32)
        code.flypend_nmpc_begin(_address(self._memory), _address(table))
        self._next = 0
        self.status, self.failed, self.iterations = 0, 0, 0

    def planned(self, t: float, state: Any, rotors: Any, outside: Any) -> Any:
        """See `Boards`."""
        if self.status:
            return None
        given = [np.asarray(part, np.float32) for part in (state, rotors)]
        found, when = np.zeros(4, np.float32), ctypes.c_float(t)
        everything = [_address(self._memory), when, *(_address(part) for part in given)]
        self.status = self._code.flypend_nmpc_command(*everything, _address(found))
        if t + 1e-6 >= self._next * self._tick:
            self._next += 1
            done = self._code.flypend_nmpc_improve(*everything)
            self.iterations += done < 2
            self.failed += done == 1
        return None if self.status else found.astype(float)


def _address(array: Any) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


def fly(code: ctypes.CDLL, plan: fp.Plan, start: fp.State, plant: fp.Plant, latency: float) -> tuple[Any, OnBoard]:
    """Return the flight from a `start` by `code` that begins with `plan`, and its computer."""
    coarse, _ = coarsen(plan, COARSER)
    table = np.concatenate([part.ravel() for part in table_of(coarse)]).astype(np.float32)
    computers = []

    def make(loop: Any, rotors: Any) -> OnBoard:
        computers.append(OnBoard(code, table, coarse.stage, latency, loop, rotors))
        return computers[-1]

    law = Controller(
        name="micro", function=rotors_only("micro"), reference=plan.reference, flight_computer=make, because="it is C"
    )
    return fp.simulate(VEHICLE, law, start, DURATION, plant=plant), computers[0]


def flights(code: ctypes.CDLL, name: str, runs: int, seed: int, beside: bool) -> str:
    """Fly a row by C code, and by nmpc `beside` it; return what came of it."""
    starts, found, row = fp.random_starts(runs, seed), [], ROWS[name]
    for i in range(runs):
        plan = fp.plan(VEHICLE, starts[i])
        if len(plan.commands) != STAGES:
            continue
        plant = row.plant(i)
        run, computer = fly(code, plan, starts[i], plant, row.latency)
        result = fp.metrics(run)
        found.append([result.success, computer.status, result.excursion, result.excursion / plan.excursion])
        if beside:
            other = fp.metrics(fp.simulate(VEHICLE, fp.nmpc(latency=row.latency), starts[i], DURATION, plant=plant))
            found[-1] += [other.success, other.excursion, result.excursion / other.excursion]
        print("  ", i, [round(float(v), 3) for v in found[-1]], computer.iterations, computer.failed, flush=True)
    stood, status, *columns = np.array(found, dtype=float).T
    count = int(stood.sum())
    succeed = [count, len(found), *(round(100 * share, 1) for share in wilson(count, len(found)))]
    names = ("excursion", "ratio to the plan", "nmpc succeeds", "nmpc", "ratio to nmpc")
    table = {
        name: [float(v) for v in np.quantile(values, (0.5, 0.95, 1.0))]
        for name, values in zip(names, columns, strict=False)
    }
    record(name, succeed=succeed, refused=int(np.sum(status == 1)), **table)
    parts = [
        f"{name} p50, p95, most {quantiles(values, 0.5, 0.95, 1.0)}"
        for name, values in zip(names, columns, strict=False)
    ]
    return ", ".join([f"succeed {succeed}, refused {int(np.sum(status == 1))}", *parts])


def costs(folder: Path) -> list[str]:
    """Return lines of costs: operations, memory, and what share of a processor they take."""
    plan = hanging()
    programs, layout = programs_of(coarsen(plan, COARSER)[1])
    counted = {name: sum(program.counts().values()) for name, program in programs.items()}
    record("operations", **counted, slopes=layout.of_slopes)
    lines = [f"operations: {counted}, entries of F {layout.of_slopes}"]
    export_nmpc(plan, folder)
    (folder / "main.c").write_text(MAIN)
    start, compiler = str(cortex.HERE / "start.c"), ("arm-none-eabi-gcc", *cortex.FLAGS, "-std=gnu99", "-O2")
    run(*compiler, "-c", "flypend_nmpc.c", folder=folder)
    for name, kick in (("improve", 0.0), ("improve", KICK), ("command", 0.0)):
        words = (f"-DKICK={kick}f", *cortex.LINKED, "main.c", "flypend_nmpc.o", start, "-lm", "-o", "main.elf")
        run(*compiler, *words, folder=folder)
        ((count, spent),) = cortex.executed(folder / "main.elf", f"flypend_nmpc_{name}")
        told = f"{name} (all lengths)" if kick else name
        times = {f"M4 cycles {where}": spent / hertz for where, hertz in CLOCKS.items()}
        times |= {f"one a cycle {where}": count / hertz for where, hertz in CLOCKS.items()}
        record(told, instructions=count, cycles=spent, **times)
        in_ms = ", ".join(f"{where} {1e3 * time:.2f} ms" for where, time in times.items())
        lines.append(f"{told}: {count} instructions, {spent} cycles, {in_ms}")
    sizes = run("arm-none-eabi-size", "main.elf", folder=folder).splitlines()
    code, data, memory = map(int, sizes[1].split()[:3])
    record("bytes", flash=code + data, memory=data + memory)
    return [*lines, f"bytes: flash {code + data}, memory {data + memory}"]


def main() -> None:
    """Print costs, or fly rows."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--cost", action="store_true")
    parser.add_argument("--runs", type=int, default=24)
    parser.add_argument("--seed", type=int, default=8101)
    parser.add_argument("--beside", action="store_true", help="fly nmpc from the same starts, too")
    parser.add_argument("--row", choices=ROWS, action="append")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as text:
        if asked.cost:
            for line in costs(Path(text)):
                print(line, flush=True)
            return
        code = library(Path(text))
        for name in asked.row or ("nominal", "mismatch"):
            print(f"{name}: {flights(code, name, asked.runs, asked.seed, asked.beside)}", flush=True)


if __name__ == "__main__":
    main()
