"""What an installation must be able to do, in half a minute, without pytest; `make lowest` runs it on the oldest.

python tests/smoke.py             # with the extras that are there
"""

import importlib.util
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import flypend as fp

VEHICLE = fp.vehicle("hehn2011")
STUDY = {
    "vehicle": "nayak2018", "law": {"name": "corrected"}, "duration": 1.0, "rtol": 1e-6, "runs": 64,
    "sampling": "sobol", "criterion": {"target": "e3", "position": float("inf")}, "vary": {"start": {"y": "uniform"}},
}  # fmt: skip
TUNE = {"runs": 8, "generations": 2, "gains": {"k_d": [0.3, 5.0], "k_1": [3.0, 100.0]}}


def flypend(*arguments):
    """The command, which succeeds."""
    subprocess.run([sys.executable, "-m", "flypend", *arguments], check=True, stdout=subprocess.DEVNULL)


def check_flying():
    """A single run, a batch of them, and the regulator, whose matrices come from the linear algebra of NumPy."""
    starts = fp.State.from_packed(np.repeat(fp.State(y=(0, 0, -1)).packed()[None], 20, axis=0))
    assert fp.simulate_ensemble(VEHICLE, fp.laws.inverted(), starts, 6.0, plant="rotors").rate == 1
    ideal = fp.simulate_ensemble(VEHICLE, fp.laws.inverted(), starts, 6.0, plant="ideal", rtol=1e-6)
    assert ideal.rate == 1
    near = fp.State(y=(np.sin(0.2), 0, np.cos(0.2)))
    assert fp.simulate(VEHICLE, fp.laws.lqr(), near, 10.0, plant="rotors").y[-1, 2] > 0.999


def check_commands():
    """Examples, a run that is saved and read, figures, pages, the law as C."""
    flypend("run", "1", "--no-figures", "--out", "one")
    flypend("examples")
    flypend("run", "examples/swing-up.toml", "--quick", "--html", "flight.html", "--out", "swing-up")
    flypend("replay", "one/run.nc", "swing-up/run.nc")
    flypend("figures", "swing-up/run.nc")
    flypend("compare", "--law", "examples.my_law:balance", "--law", "lqr", "--runs", "4", "--duration", "2")
    flypend("export-c", "--out", "c")
    flypend("movie", "swing-up/run.nc", "--out", "flight.gif", "--fps", "5", "--speed", "2")
    assert all(
        Path(name).stat().st_size for name in ("figures-out/full.pdf", "flight.html", "c/README.md", "flight.gif")
    )


def check_extras():
    """What the extras that are installed are for. Returns their modules."""
    found = [
        name
        for name in ("scipy", "mujoco", "imageio_ffmpeg", "tornado", "jax", "gymnasium")
        if importlib.util.find_spec(name)
    ]
    if "gymnasium" in found:
        from flypend.envs import World

        assert World("balance").reset(seed=0)[0].shape == (32,)
    run = fp.load("swing-up/run.nc")
    if "scipy" in found:
        assert len(run.to_xarray()["t"]) == len(run.t)
        assert fp.sweep(STUDY, "study.zarr", workers=2).sizes["run"] == 64
        flypend("map", "study.zarr", "--out", "map.png")
        assert fp.tune({**STUDY, "tune": TUNE}, workers=2).gains
        fp.simulate(VEHICLE, fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.1, plant="ideal", engine="scipy")
    if "mujoco" in found:
        fp.simulate(VEHICLE, fp.laws.inverted(), fp.State(y=(0, 0, -1)), 0.5, plant="mujoco")
    if "imageio_ffmpeg" in found:
        flypend("movie", "swing-up/run.nc", "--out", "flight.mp4", "--fps", "5", "--speed", "2")
    if "tornado" in found:
        importlib.import_module("flypend.lab")  # the server begins to listen when it is called
    return found


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        check_flying()
        check_commands()
        print(f"flypend {fp.__version__} on Python {sys.version.split()[0]} flies; extras: {check_extras()}")
        os.chdir("/")
