"""The loops in C++: their bitcode is that of their source, and the source itself is free of undefined behaviour."""

import shutil
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import flypend
from flypend.compile.llvm import runge_kutta
from flypend.compile.llvm.loops import file_of
from flypend.compile.llvm.random import normals
from flypend.compile.methods import NAMES, method
from flypend.compile.problem import LONGEST
from tests.few import each_once

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


BOTH = ("runge_kutta", "elementary")


@pytest.mark.parametrize(
    ("loop", "width", "bits", "pointer"),
    [
        *((loop, width, bits, 64) for loop in BOTH for width, bits in ((8, 64), (16, 64), (16, 32), (32, 32))),
        *((loop, width, bits, 32) for loop in BOTH for width, bits in ((1, 64), (2, 64), (1, 32), (2, 32))),
        *(("sampled", width, 64, pointer) for width, pointer in ((1, 64), (8, 64), (1, 32), (2, 32))),
        *((loop, 8, 64, 64) for loop in ("worlds", "normals", "horizon", "riccati")),
        *((loop, 1, 64, 64) for loop in ("horizon", "elementary")),
    ],
)
def test_every_width_that_kernels_ask_for_is_there(loop, width, bits, pointer):
    assert (SOURCE / file_of(loop, width, bits, pointer)).read_bytes()[:2] == b"BC"


SIZES = {
    "N": 4, "PARAMETERS": 1, "WRENCH": 1, "GAUGES": 2, "BOUNDS": (0.0, 1.0), "SMOOTH": 1, "GUARDED": 1, "TOUCHES": 1,
    "MOST_STATE": 1e6, "LONGEST": LONGEST,
}  # fmt: skip
# The check of function types, at MuJoCo's addresses, needs a runtime that clang links to C++ alone.
SANITISERS = ("-fsanitize=address,undefined", "-fno-sanitize=function", "-fno-sanitize-recover=all")
FLAGS = ("-std=c++17", "-O1", "-g", "-fno-strict-aliasing", "-Wno-psabi", "-Wno-pass-failed", "-DBITS=64")


def defined(constants, *headers):
    """C++ that defines what `headers` declare."""
    lines = [*(f'#include "{header}"' for header in headers), 'extern "C" {']
    for name, value in constants.items():
        if isinstance(value, int):
            lines.append(f"const int64_t {name} = {value};")
        elif isinstance(value, float):
            lines.append(f"const double {name} = {value!r};")
        else:
            numbers = ", ".join(repr(float(number)) for number in np.ravel(value)) or "0"
            lines.append(f"const double {name}[] = {{{numbers}}};")
    return "\n".join([*lines, "}\n"])


@pytest.fixture(scope="module")
def fly(tmp_path_factory):
    """Return a function that runs `programs` around a `loop`, built with sanitizers, and tells what it says, and rows.

    What two of them share is compiled once: the loop, but for its constants.
    """
    folder = tmp_path_factory.mktemp("loops")

    @cache
    def compiled(text, width):
        path = folder / f"{len(list(folder.iterdir()))}.cpp"
        path.write_text(text, encoding="utf-8")
        options = [*FLAGS, *SANITISERS, f"-DWIDTH={width}", "-I", SOURCE]
        subprocess.run([clang(), *options, "-c", path, "-o", path.with_suffix(".o")], check=True)
        return path.with_suffix(".o")

    def run(loop, constants, headers, programs, width=2):
        texts = (f'#include "{loop}.cpp"\n', defined(constants, *headers), programs)
        objects = [compiled(text, width) for text in texts]
        subprocess.run([clang(), *SANITISERS, *objects, "-lstdc++", "-lm", "-o", folder / "fly"], check=True)
        told = subprocess.run([folder / "fly"], capture_output=True, text=True)
        return told, [[float(word) for word in line.split()] for line in told.stdout.splitlines()]

    return run


def source(name):
    """The programs in C++ beside this file."""
    return Path(__file__).with_name(name).read_text(encoding="utf-8")


def flown(fly, name, smooth=1, extra=("", "")):
    """Rows that the oscillators print; in the source of the programs, the second of `extra` replaces the first."""
    constants = {**SIZES, "SMOOTH": smooth, **runge_kutta._tableau(method(name))}
    return fly("runge_kutta", constants, ["open.hpp"], source("oscillators.cpp").replace(*extra))


def exact(start, omega, t):
    x, v = np.array(start[:2]), np.array(start[2:])
    c, s = np.cos(omega * t), np.sin(omega * t)
    return np.concatenate([x * c + v / omega * s, v * c - x * omega * s])


@pytest.mark.parametrize(("name", "smooth"), each_once(NAMES, (1, 0)))
def test_oscillators_fly_without_undefined_behaviour(fly, name, smooth):
    """Seven runs through two lanes: statuses, samples, verdicts and touches, against the solution in closed form."""
    told, rows = flown(fly, name, smooth)
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


def test_a_write_beyond_a_vector_is_found(fly):
    """The negative control: a program that writes a fourth entry of the drift, which has three."""
    told, _ = flown(fly, "dp5", extra=("i < 3; i++) drift", "i < 4; i++) drift"))
    assert told.returncode != 0
    assert "AddressSanitizer" in told.stderr


def test_philox_gives_its_known_answers(tmp_path):
    """Vectors of Salmon et al. (2011), philox4x32 with ten rounds, in both lanes."""
    program = tmp_path / "words.cpp"
    program.write_text(source("random_words.cpp"), encoding="utf-8")
    options = [*FLAGS, *SANITISERS, "-DWIDTH=2", "-I", SOURCE]
    subprocess.run([clang(), "-x", "c++", *options, program, "-lm", "-o", tmp_path / "words"], check=True)
    told = subprocess.run([tmp_path / "words"], capture_output=True, text=True, check=True)
    words = [[f"{int(word):08x}" for word in line.split()] for line in told.stdout.splitlines()]
    assert words[:2] == [["6627e8d5", "e169c58d", "bc57ac4c", "9b00dbd8"]] * 2
    assert words[2:] == [["408f276d", "41c83b0e", "a20bc7c6", "6d5451fd"]] * 2


# Sampled flights ------------------------------------------------------------------------------------------------------

CARTS = {
    "STATE": 4, "ROTORS": 2, "MEMORY": 3, "SLIDE": 1, "MEASURED": 4, "COMMAND": 2, "GAINS": 1, "NOISE": 1, "WIND": 1,
    "PARAMS": 1, "GUST": 1, "VALUES": 4, "PERIOD": 0.01, "STRETCHES": 2, "TIMING": 1, "AGES": (1, 0), "STEPS": (1, 2),
    "DEPTH": 2, "PIECES": 0, "RANDOM": 1, "DRAWS": 24, "FIRST_DRAW": 0,
    "END_DRAW": 19, "GUSTS": 18, "GUST_DRAWS": 1, "GUST_TICK": 8000, "RATES": 0, "MEASURES": 1, "TOUCHES": 1,
    "SENSES": 0, "SENSED": 0, "START_TICK": 9, "START_DRAWS": 0, "MOST_STATE": 1e3, "KINDS": (0, 1, 2, 3),
    "MUJOCO": 0, "QPOS": 2, "QVEL": 2, "FILTERED": 0, "DRIVEN": 0, "BLOWN": 0, "FILTER_STRIDE": 10, "MOST_FORCE": 1e3,
    "FUSES": 1,
}  # fmt: skip
VARIANTS = {
    "plain": (2, {}),
    "pieces": (2, {"PIECES": 1}),
    "sensors": (2, {"SENSES": 1, "MEASURES": 0, "NOISE": 0, "SENSED": 1, "START_DRAWS": 4}),
    "engine": (1, {"MUJOCO": 1, "TIMING": 2, "FILTERED": 1, "DRIVEN": 1, "BLOWN": 1}),
}


def driven(start, gain, seed, ticks=200):
    """States and forces of two carts at each tick, step by step."""
    start, gust = np.array(start, dtype=float), normals(seed, 1, first=CARTS["GUST_TICK"])[0, 18]
    rows = [start.copy()]
    state, held = start[:4].copy(), start[4:]
    for tick in range(ticks):
        draws = normals(seed, 1, first=tick)[0]
        told = state + 0.001 * draws[:4]
        before, held = held, -gain * told[:2] - 1.5 * told[2:]
        gust += 0.01 * draws[18]
        for command, h, steps in ((before, 0.004, 1), (held, 0.003, 2)):
            force = command + np.array([gust, 0])
            for _ in range(steps):
                state[:2] += h * state[2:] + h * h * force / 2
                state[2:] += h * force
        rows.append(np.append(state, held))
    return np.array(rows)


@pytest.mark.parametrize("variant", VARIANTS)
def test_carts_fly_without_undefined_behaviour(fly, variant):
    """Five flights: samples, reductions, statuses and touches, against the same step by step."""
    width, other = VARIANTS[variant]
    headers = ["sampled.hpp", "mujoco.hpp", "elementary.hpp"]
    told, rows = fly("sampled", CARTS | other, headers, source("carts.cpp"), width)
    assert told.returncode == 0, told.stderr
    C, D, U, T = (getattr(runge_kutta, name) for name in ("COMPLETED", "DIVERGED", "UNDEFINED", "COLLIDED"))
    assert [row[0] for row in rows] == [C, C, T, U, D]
    assert [row[1] for row in rows] == [-1, -1, 7, -1, -1]
    starts = [(1, 0.5, 0, 0, 0, 0), (0, 1, 0.3, 0.5, 1, -1), (0, 1, 0, 9, 0, 0)]
    t = np.arange(201) / 100
    for i, (row, start) in enumerate(zip(rows, starts, strict=False)):
        states, samples = driven(start, i + 1, 3 + i), np.reshape(row[12:], (201, 6))
        flew = ~np.isnan(samples[:, 0])
        x, value = states[:, 1], states[:, 0] - 0.2
        if row[0] == T:
            hit = int(np.argmax(x >= 1.5))
            assert row[2] == pytest.approx(t[hit - 1] + 0.01 * (1.5 - x[hit - 1]) / (x[hit] - x[hit - 1]))
            assert flew[:hit].all()
            np.testing.assert_allclose(samples[:hit], states[:hit], atol=1e-12)
            continue
        assert row[2] == 2
        assert row[3] == pytest.approx(1.5 - np.max(x))
        np.testing.assert_allclose(samples, states, atol=1e-12)
        late = np.flatnonzero(value > 0)
        last = t[late[-1]] if late.size else -1
        since = np.inf if value[-1] > 0 else t[late[-1] + 1] if late.size else 0
        np.testing.assert_allclose(row[4:8], [np.max(value), np.trapezoid(value, t) / 2, last, since])
        np.testing.assert_allclose(row[8:12], states[-1, :4], atol=1e-12)
