"""Damaged memories of the exported flight computer, under AddressSanitizer and UndefinedBehaviorSanitizer.

    python -m benchmarks.damaged_memory [--count 1000000] [--computer board-float ...]

The C code flies; in every period copies of its memory are damaged, in ten ways, and stepped with a good measurement. A
row says how often a kind of damage changed the memory, how often the step refused it (FLYPEND_NOT_BEGUN: then it is
begun again, and must fly), and of the others, how many commanded what the sound memory does, and how many did not. An
earlier state of the whole memory cannot be told from a sound one. `--unchecked` removes the check. Needs clang.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple

import flypend as fp

SOURCE = Path(__file__).with_suffix(".c")
COMPUTERS = {
    f"{name}-{precision}": (precision, sensors)
    for name, sensors in {"board": None, "mocap": "mocap", "onboard": "onboard"}.items()
    for precision in ("float", "double")
}
REPLAYED = "all of the past"
FLAGS = (
    "-std=c99", "-g", "-Wall", "-Wextra", "-Werror", "-fsanitize=address,undefined,float-cast-overflow",
    "-fno-sanitize-recover=all",
)  # fmt: skip
READ = {"position": "x", "attitude": "R", "rod": "y", "gyro": "omega"}
BOARD = """\
#include "flypend_law.h"
#include "flypend_vectors.h"
#define COMPUTER flypend_board
#define GAINS &flypend_default_gains
#define PARAMS &flypend_default_params
#define begin(computer) flypend_board_begin(computer, GAINS, PARAMS)
#define restart(computer, rotors) flypend_board_restart(computer, GAINS, PARAMS, rotors)
#define step(computer, period, rotors) \\
    flypend_board_step(computer, &(period)->measurement, &(period)->path, PARAMS, rotors)
#define pass(computer) flypend_board_pass(computer)
"""
SENSORS = """\
#include <string.h>
#include "flypend_sensors.h"
#include "flypend_vectors.h"
#define COMPUTER flypend_sensors
#define GAINS &flypend_default_gains
#define PARAMS &flypend_default_params
static flypend_state estimate;
static flypend_status begin(flypend_sensors *computer)
{{
    memset(&estimate, 0, sizeof estimate);
    memcpy(&estimate, &flypend_flights[0].measurement, sizeof flypend_flights[0].measurement);
    return flypend_sensors_begin(computer, GAINS, PARAMS, &estimate);
}}
#define restart(computer, rotors) flypend_sensors_restart(computer, GAINS, PARAMS, &estimate, rotors)
static flypend_status step(flypend_sensors *computer, const flypend_period *period, flypend_rotors *rotors)
{{
    flypend_readings r;
    memset(&r, 0, sizeof r);
{readings}
    return flypend_sensors_step(computer, &r, &period->path, PARAMS, rotors);
}}
#define pass(computer) flypend_sensors_estimate(computer, &estimate)
"""


class Row(NamedTuple):
    """How often one `kind` of damage was tried and refused, and how often it went unseen: without effect, or with."""

    kind: str
    tried: int
    refused: int
    same: int
    other: int


def built(folder: Path, computer: str, *, checked: bool = True, level: str = "-O1") -> Path:
    """Export a flight computer to `folder` and compile what damages it; return the path of the program.

    At `level` -O0 it compiles ten times as fast, and runs a ninth as fast.
    """
    precision, sensors = COMPUTERS[computer]
    fp.export_c(fp.laws.inverted(), fp.vehicle("hehn2011"), folder, precision=precision, sensors=sensors, check=False)
    sources, flown = ["flypend_law.c"], BOARD
    if sensors is not None:
        streams = fp.plants.SUITES[sensors].streams
        lines = [
            f"    memcpy(r.{name}, period->measurement.{READ[name]}, sizeof r.{name});"
            for name in streams
            if name in READ
        ]
        lines += [f"    r.{name}_age = -1;" for name in streams if name not in READ]
        sources, flown = ["flypend_law.c", "flypend_sensors.c"], SENSORS.format(readings="\n".join(lines))
    (folder / "flown.h").write_text(flown)
    if not checked:
        for name in sources:
            text = (folder / name).read_text()
            for memory in ("board", "computer"):
                text = text.replace(f" && ({memory}->check == check_of({memory}))", "")
            (folder / name).write_text(text)
    command = ["clang", level, *FLAGS, "-I.", str(SOURCE), *sources, "-lm", "-o", "damaged"]
    subprocess.run(command, cwd=folder, check=True)
    return folder / "damaged"


def damaged(program: Path, count: int, seed: int) -> list[Row]:
    """Return what `count` damages end in. Raises CalledProcessError if a sanitiser or a check finds anything."""
    said = subprocess.run([program, str(count), str(seed)], check=True, capture_output=True, text=True).stdout
    cells = (line.split(",") for line in said.splitlines())
    return [Row(kind, *map(int, numbers)) for kind, *numbers in cells]


def main() -> None:
    """Damage the memories of all computers, or of those asked for, and print a table for each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10**6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--computer", action="append", choices=COMPUTERS)
    parser.add_argument("--unchecked", action="store_true")
    given = parser.parse_args()
    for computer in given.computer or COMPUTERS:
        with tempfile.TemporaryDirectory() as folder:
            rows = damaged(built(Path(folder), computer, checked=not given.unchecked), given.count, given.seed)
        replayed = next(row for row in rows if row.kind == REPLAYED)
        print(f"{computer}\n{'':24} {'changed':>8} {'refused':>8} {'same':>8} {'other':>8}")
        total = Row(
            "all but that", *(sum(column) for column in zip(*(r[1:] for r in rows if r != replayed), strict=True))
        )
        for kind, *numbers in (*rows, total):
            print(f"{kind:24}", *(f"{number:8}" for number in numbers))
        print(flush=True)


if __name__ == "__main__":
    main()
