"""What an installation must be able to do on this machine, in half a minute: `python -m flypend.selftest`."""

from __future__ import annotations

import os
import platform
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from filelock import FileLock, Timeout

import flypend as fp

STUDY: dict[str, Any] = {
    "vehicle": "nayak2018", "law": {"name": "corrected"}, "duration": 1.0, "rtol": 1e-6, "runs": 64,
    "sampling": "sobol", "criterion": {"target": "e3", "position": float("inf")}, "vary": {"start": {"y": "uniform"}},
}  # fmt: skip
TUNE = {"runs": 8, "generations": 2, "gains": {"k_d": [0.3, 5.0], "k_1": [3.0, 100.0]}}
HANGING = fp.State(y=(0, 0, -1))


class FailedError(Exception):
    """Something that this machine does not do."""


def expect(holds: Any, what: str) -> None:
    """Raise FailedError, which says `what`, unless it `holds`."""
    if not holds:
        raise FailedError(what)


def call(*arguments: str) -> None:
    """Run a command of flypend in a process of its own. Raises FailedError unless it succeeds."""
    words = [sys.executable, "-m", "flypend", *arguments]
    done = subprocess.run(words, capture_output=True, encoding="utf-8", errors="replace", check=False)  # noqa: S603
    expect(done.returncode == 0, f"flypend {' '.join(arguments)}: code {done.returncode}, {done.stderr.strip()[-300:]}")


def fly() -> None:
    """Fly kernels of both plants, one by one and in threads, and the LQR, whose gains come from linear algebra."""
    vehicle, law = fp.vehicle("hehn2011"), fp.laws.inverted()
    starts = fp.State.from_packed(np.repeat(HANGING.packed()[None], 20, axis=0))
    many = fp.simulate_ensemble(vehicle, law, starts, 6.0)
    expect(many.rate == 1, "a swing-up through rotors does not end inverted")
    one = fp.simulate(vehicle, law, HANGING, 6.0)
    expect(np.array_equal(one.y[-1], many.final.y[0]), "a flight in a batch differs from the same flight alone")
    ideal = fp.simulate_ensemble(vehicle, law, starts, 6.0, plant="ideal", rtol=1e-6)
    expect(ideal.rate == 1, "a swing-up on the ideal plant does not end inverted")
    near = fp.State(y=(np.sin(0.2), 0, np.cos(0.2)))
    expect(fp.simulate(vehicle, fp.laws.lqr(), near, 10.0).y[-1, 2] > 0.999, "the LQR does not catch a lean")


def step_in_python() -> None:
    """Fly a law of Python's own, step by step."""
    vehicle = fp.vehicle("hehn2011")
    law = fp.Controller(name="hover", function=lambda t, state: fp.Wrench(vehicle.weight, np.zeros(3)))
    run = fp.simulate(vehicle, law, fp.State(y=(0, 0, 1)), 0.1)
    expect(run.y[-1, 2] > 0.999, "a rod that stands falls within 0.1 s")


def settle() -> float:
    """Return the height at which one flight ends, for another process."""
    return float(fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), HANGING, 2.0).x[-1, 2])


def use_processes() -> None:
    """Fly in a process that is started anew, as on Windows and macOS, and get the same number."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        expect(pool.submit(settle).result() == settle(), "another process flies another flight")


def keep_files() -> None:
    """Save a run and read it again; hold a lock against others."""
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), HANGING, 1.0)
    run.save("kept.nc")
    expect(np.array_equal(fp.load("kept.nc").y, run.y), "a saved run reads differently")
    with FileLock("held.lock"):
        try:
            FileLock("held.lock", timeout=0).acquire()
        except Timeout:
            return
    raise FailedError("a lock can be taken twice")


def use_commands() -> None:
    """Type the commands: examples, a run that is saved and read, figures, pages, a movie, the law as C."""
    call("run", "1", "--no-figures", "--out", "one")
    call("examples")
    call("run", "examples/swing-up.toml", "--quick", "--html", "flight.html", "--out", "swing-up")
    call("replay", "one/run.nc", "swing-up/run.nc")
    call("figures", "swing-up/run.nc")
    call("compare", "--law", "examples/my_law.py:balance", "--law", "lqr", "--runs", "4", "--duration", "2")
    call("export-c", "--out", "c")
    call("movie", "swing-up/run.nc", "--out", "flight.gif", "--fps", "5", "--speed", "2")
    for name in ("figures-out/full.pdf", "flight.html", "c/README.md", "flight.gif"):
        expect(Path(name).stat().st_size, f"{name} is empty")


def study() -> None:
    """Sweep, map and tune (extra studies)."""
    run = fp.load("swing-up/run.nc")
    expect(len(run.to_xarray()["t"]) == len(run.t), "a run as xarray has another length")
    expect(fp.sweep(STUDY, "study.zarr", workers=2).sizes["run"] == 64, "a sweep has lost runs")
    call("map", "study.zarr", "--out", "map.png")
    expect(fp.tune({**STUDY, "tune": TUNE}, workers=2).gains, "no gains are found")
    fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.1, plant="ideal", engine="scipy")


def fly_in_mujoco() -> None:
    """Fly in MuJoCo (extra mujoco)."""
    fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), HANGING, 0.5, plant="mujoco")


def film() -> None:
    """Write an .mp4 (extra movies)."""
    call("movie", "swing-up/run.nc", "--out", "flight.mp4", "--fps", "5", "--speed", "2")


def step_worlds() -> None:
    """Step an environment (extra rl)."""
    from flypend.envs import World

    expect(World("balance").reset(seed=0)[0].shape == (32,), "an observation has another shape")


def open_laboratory() -> None:
    """Import the laboratory's server (extra lab)."""
    import flypend.lab.server  # noqa: F401


# Each step, and the module that it needs beyond the base install.
STEPS: tuple[tuple[Callable[[], None], str], ...] = (
    (fly, ""), (step_in_python, ""), (use_processes, ""), (keep_files, ""), (use_commands, ""),
    (study, "zarr"), (fly_in_mujoco, "mujoco"), (film, "imageio_ffmpeg"), (step_worlds, "gymnasium"),
    (open_laboratory, "tornado"),
)  # fmt: skip


def main() -> int:
    """Do every step in an empty folder and print a line for each; return how many fail."""
    from flypend.compile.llvm.target import native

    python = f"Python {platform.python_version()}, {platform.system()} {platform.machine()}"
    print(f"flypend {fp.__version__} on {python}, code for {native().triple} {native().cpu}", flush=True)
    failed, home = 0, Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            for step, module in STEPS:
                failed += not attempt(step, module)
        finally:
            os.chdir(home)  # Windows removes no folder in which a process is
    print("Everything works here." if not failed else f"{failed} of {len(STEPS)} steps fail.")
    return failed


def attempt(step: Callable[[], None], module: str) -> bool:
    """Do one `step` and print how it went; return False if it fails. Without the `module` it needs, it is left out."""
    name, begun = step.__name__.replace("_", " "), time.perf_counter()
    if module and find_spec(module) is None:
        print(f"  left out  {name}: no {module}", flush=True)
        return True
    try:
        step()
    except Exception as error:  # whatever it is, the user wants to see the other steps
        print(f"  FAILED    {name}: {type(error).__name__}: {error}", flush=True)
        return False
    print(f"  ok        {name} ({time.perf_counter() - begun:.1f} s)", flush=True)
    return True


if __name__ == "__main__":
    try:
        sys.exit(min(main(), 1))
    except KeyboardInterrupt:
        print("flypend: interrupted", file=sys.stderr)
        sys.exit(128 + signal.SIGINT)
