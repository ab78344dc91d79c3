"""The loops in C++: their bitcode is that of their source, and the source itself is free of undefined behaviour."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import flypend
from flypend.compile.llvm import runge_kutta
from flypend.compile.llvm.loops import file_of
from flypend.compile.methods import NAMES, method
from flypend.compile.touch import LONGEST

SOURCE = Path(flypend.__file__).parent / "compile" / "loops"


def clang():
    """The compiler that `build.sh` names."""
    found = shutil.which("clang-14")
    assert found, "clang-14 is missing: run `make test-tools`"
    return found


def test_the_bitcode_is_that_of_the_source(tmp_path):
    clang()
    subprocess.run(["sh", SOURCE / "build.sh", tmp_path], check=True)
    built, tracked = ({path.name: path.read_bytes() for path in at.glob("*.bc")} for at in (tmp_path, SOURCE))
    assert built.keys() == tracked.keys()
    assert [name for name in built if built[name] != tracked[name]] == [], "run `make loops`"


@pytest.mark.parametrize(
    ("width", "bits", "pointer"),
    [(8, 64, 64), (16, 64, 64), (16, 32, 64), (32, 32, 64), (1, 64, 32), (2, 64, 32), (1, 32, 32), (2, 32, 32)],
)
def test_every_width_that_kernels_ask_for_is_there(width, bits, pointer):
    assert (SOURCE / file_of("runge_kutta", width, bits, pointer)).read_bytes()[:2] == b"BC"


SIZES = {
    "N": 4, "PARAMETERS": 1, "WRENCH": 1, "GAUGES": 2, "BOUNDS": (0.0, 1.0), "SMOOTH": 1, "GUARDED": 1, "TOUCHES": 1,
    "MOST_STATE": 1e6, "LONGEST": LONGEST,
}  # fmt: skip
SANITISERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
FLAGS = ("-std=c++17", "-O1", "-g", "-fno-strict-aliasing", "-Wno-psabi", "-Wno-pass-failed", "-DWIDTH=2", "-DBITS=64")


def defined(constants):
    """C++ that defines what `open.hpp` declares."""
    lines = ['#include "open.hpp"', 'extern "C" {']
    for name, value in constants.items():
        if isinstance(value, int):
            lines.append(f"const int64_t {name} = {value};")
        elif isinstance(value, float):
            lines.append(f"const double {name} = {value!r};")
        else:
            numbers = ", ".join(repr(float(number)) for number in np.ravel(value)) or "0"
            lines.append(f"const double {name}[] = {{{numbers}}};")
    return "\n".join([*lines, "}\n"])


def flown(folder, name, smooth=1, extra=""):
    """Rows that the oscillators print, built with sanitizers; `extra` is added to the source of the programs."""
    constants = folder / "constants.cpp"
    constants.write_text(defined({**SIZES, "SMOOTH": smooth, **runge_kutta._tableau(method(name))}), encoding="utf-8")
    programs = folder / "oscillators.cpp"
    programs.write_text(
        Path(__file__).with_name("oscillators.cpp").read_text(encoding="utf-8").replace(*(extra or ("", "")))
    )
    sources = [SOURCE / "runge_kutta.cpp", constants, programs]
    subprocess.run(
        [clang(), "-x", "c++", *FLAGS, *SANITISERS, "-I", SOURCE, *sources, "-lstdc++", "-lm", "-o", folder / "fly"],
        check=True,
    )
    told = subprocess.run([folder / "fly"], capture_output=True, text=True)
    return told, [[float(word) for word in line.split()] for line in told.stdout.splitlines()]


def exact(start, omega, t):
    x, v = np.array(start[:2]), np.array(start[2:])
    c, s = np.cos(omega * t), np.sin(omega * t)
    return np.concatenate([x * c + v / omega * s, v * c - x * omega * s])


@pytest.mark.parametrize("smooth", [1, 0])
@pytest.mark.parametrize("name", NAMES)
def test_oscillators_fly_without_undefined_behaviour(tmp_path, name, smooth):
    """Seven runs through two lanes: statuses, samples, verdicts and touches, against the solution in closed form."""
    told, rows = flown(tmp_path, name, smooth)
    assert told.returncode == 0, told.stderr
    starts = [(1, 0.5, 0, 0), (0, 1, 1, 0), (3, 0, 0, 0), None, (0.5, 0, 0, 5), (0.4, -1, 0, 0.1), (1.9, 0, 1, 0)]
    omegas = [1, 2, 1, 1, 2, 3, 1]
    C, S, U, T = runge_kutta.COMPLETED, runge_kutta.SINGULAR, runge_kutta.UNDEFINED, runge_kutta.COLLIDED
    assert [row[0] for row in rows] == [C, C, S, U, T, C, S]
    for run, (row, start, omega) in enumerate(zip(rows, starts, omegas, strict=True)):
        end, final, reductions, clearance = row[2], row[3:7], row[7:13], row[13]
        samples = np.reshape(row[14:], (5, 4))
        if start is None or start[0] == 3:
            continue
        np.testing.assert_allclose(final, exact(start, omega, end), atol=3e-8)
        times = np.array([0, 0.7, 0.7001, 2, 5])
        reached = times <= end
        for t, sample in zip(times[reached], samples[reached], strict=True):
            np.testing.assert_allclose(sample, exact(start, omega, t), atol=2e-8, err_msg=f"run {run} at {t} s")
        assert np.isnan(samples[~reached]).all()
        grid = np.arange(1, 501) / 100
        x = np.array([exact(start, omega, t)[:2] for t in grid[grid <= end]])
        if row[0] == C:
            # By the quintic through a step, or by dense output at every judged time.
            assert reductions[3] == pytest.approx(np.max(np.abs(x[:, 1])), abs=5e-6 if smooth else 3e-8)
            out = [grid[np.flatnonzero(x[:, 0] ** 2 > 0.25)[-1]] if np.any(x[:, 0] ** 2 > 0.25) else -1]
            assert reductions[1] == pytest.approx(out[0])
            fine = np.array([exact(start, omega, t)[0] for t in np.linspace(0, 5, 20_001)])
            assert reductions[4] == pytest.approx(np.trapezoid(fine**2, dx=5 / 20_000) / 5, abs=1e-5)
            assert reductions[5] == pytest.approx(np.max(np.abs(fine)), abs=0.02)
            assert clearance == pytest.approx(1.5 - np.max(x[:, 1]), abs=0.02)
        assert row[1] == (7 if row[0] == T else -1)
    # 2.5 sin 2t = 1.5, and 1.9 cos t + sin t = 2
    assert rows[4][2] == pytest.approx(np.arcsin(0.6) / 2, abs=1e-5)
    amplitude = np.hypot(1.9, 1)
    assert rows[6][2] == pytest.approx(np.arctan2(1, 1.9) - np.arccos(2 / amplitude), abs=1e-6)


def test_a_write_beyond_a_vector_is_found(tmp_path):
    """The negative control: a program that writes a fourth entry of the drift, which has three."""
    told, _ = flown(tmp_path, "dp5", extra=("i < 3; i++) drift", "i < 4; i++) drift"))
    assert told.returncode != 0
    assert "AddressSanitizer" in told.stderr
