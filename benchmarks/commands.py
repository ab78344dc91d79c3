"""How long each command takes: `python -m benchmarks.commands [name …]`, all of them or those named.

Seconds of processor time of the command and of what it starts, on all cores together: first with no compiled code on
the disk, then again. Each is typed into a folder of its own, with the examples and a saved run in it.
"""

import os
import resource
import shlex
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from flypend.compile.cache import VARIABLE

# The first two write what others need.
LINES = (
    "flypend examples",
    "flypend run examples/swing-up.toml --quick --out flown",
    "flypend run examples/swing-up.toml --quick --html live.html --live",
    "flypend replay flown/run.nc",
    "flypend movie flown/run.nc",
    "flypend figures flown/run.nc",
    "flypend laws",
    "flypend vehicles",
    "flypend cache",
    "flypend lab --no-browser",
    "flypend paper --quick",
    "flypend theorem",
    "flypend compare --law inverted --law lqr --runs 500",
    "flypend ladder --law inverted --runs 20",
    "flypend check hehn2011",
    "flypend plan",
    "flypend plan --fly mujoco --figure plan.png",
    "flypend map --law lqr --runs 20000",
    "flypend sweep examples/studies/hanging.toml --out hanging.zarr",
    "flypend tune examples/studies/hanging.toml",
    "flypend export-c --precision float",
    "flypend export-app crazyflie crazyflie --out app",
    "flypend export-app px4 hehn2011 --out px4-app",
    "flypend learn --updates 20",
    "flypend vehicle new --mass 620g --arm 17cm --propeller 8x4.5 --rod-length 90cm --bob-mass 40g",
    "flypend identify flight.csv --rehearse --duration 20",
)
FOR_OTHERS = LINES[:2]


def spent(line: str, folder: Path, cache: Path) -> float:
    """Type `line` in `folder`; return its processor time, s. The laboratory is closed once it has told its address."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", *shlex.split(line)]
    environment = {**os.environ, VARIABLE: str(cache)}
    with subprocess.Popen(
        command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as typed:
        if "lab" in command:
            typed.stdout.readline()
            typed.send_signal(signal.SIGINT)
        _, said = typed.communicate()
    if typed.returncode not in (0, 128 + signal.SIGINT):
        raise RuntimeError(f"{line}: {said.decode()}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(names: list[str]) -> None:
    """Print a row of the table for each command."""
    with TemporaryDirectory() as folder:
        prepared = Path(folder) / "prepared"
        prepared.mkdir()
        for line in FOR_OTHERS:
            spent(line, prepared, Path(folder) / "cache")
        print("| command | first | again |\n|---|---|---|")
        for i, line in enumerate(LINES):
            if names and shlex.split(line)[1] not in names:
                continue
            cache = Path(folder) / f"cache-{i}"
            places = [Path(shutil.copytree(prepared, Path(folder) / f"{time}-{i}")) for time in ("first", "again")]
            first, again = (spent(line, place, cache) for place in places)
            print(f"| `{line}` | {first:.1f} | {again:.1f} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
