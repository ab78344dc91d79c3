"""The exported flight computer with an estimator: the same answers as in Python, and none that is not finite."""

from dataclasses import replace

import numpy as np
import pytest
from cbuild import run

import flypend as fp
from flypend.export import compiled
from flypend.export.library import CompiledSensors, library
from flypend.flight.request import Flight
from flypend.flight.sampled import fly_stepwise
from flypend.plants import SUITES, Plant
from tests.few import slow

VEHICLE, LAW = fp.vehicle("hehn2011"), fp.laws.inverted()
POSES = ("position", "attitude", "rod")
SLOWER = SUITES["mocap"].replace(**{name: replace(getattr(SUITES["mocap"], name), rate=100.0) for name in POSES})
START = fp.State(y=(0.6, 0.0, 0.8), omega=(1.0, -0.5, 0.2), x_dot=(0.2, 0.1, 0.0)).packed()


def flown(law, plant, start, duration):
    flight = Flight(
        vehicle=VEHICLE, law=law, starts=fp.State.from_packed(start), duration=duration, plant=plant, seed=4
    )
    return fly_stepwise(flight)


@pytest.mark.parametrize(
    "plant",
    [
        Plant(sensors=SLOWER),  # with calmer gains
        *(slow(p) for p in (Plant(sensors="mocap"), Plant(sensors="onboard", delay=0.003))),
    ],
)
def test_a_flight_by_exported_code_is_the_flight_of_the_board(plant):
    python = flown(LAW.bind(VEHICLE), plant, START, 0.6)
    code = flown(compiled(LAW, VEHICLE), plant, START, 0.6)
    assert code.outcome.status == "completed"
    # Order of operations only, over 300 periods of a closed loop.
    np.testing.assert_allclose(code.packed[-1], python.packed[-1], rtol=1e-7, atol=1e-7)


@pytest.mark.slow
def test_single_precision_flies_the_same_to_its_own_precision():
    plant = Plant(sensors="mocap")
    python = flown(LAW.bind(VEHICLE), plant, START, 0.4)
    code = flown(compiled(LAW, VEHICLE, "float"), plant, START, 0.4)
    # 200 periods, in each of which 1e-7 of some numbers is lost.
    np.testing.assert_allclose(code.packed[-1], python.packed[-1], atol=1e-3)


@pytest.fixture(scope="module")
def code():
    return library(LAW.bind(VEHICLE), VEHICLE, "double", 500.0, SUITES["mocap"].replace(command_delay=0.0))


def begun(code):
    computer = CompiledSensors(code)
    computer.estimate_from(START)
    assert computer.status == 0
    return computer


def sound_readings():
    s = fp.State.from_packed(START)
    return np.concatenate([s.x, [0.01], s.R.ravel(), [0.01], s.y, [0.01], s.omega, [0.0], s.R.T @ (0, 0, 9.81), [0.0]])


@pytest.mark.parametrize(
    ("spoil", "status"),
    [
        (lambda r: None, 1),
        (lambda r: np.where(np.arange(len(r)) == 1, np.nan, r), 2),
        (lambda r: np.where((np.arange(len(r)) >= 14) & (np.arange(len(r)) < 17), 2 * r + 0.1, r), 3),
        (lambda r: np.where((np.arange(len(r)) >= 4) & (np.arange(len(r)) < 13), 0.0, r), 4),
    ],
)
def test_unsound_readings_are_told_and_flown_through(code, spoil, status):
    without, with_ = begun(code), begun(code)
    silent = np.full(len(sound_readings()), -1.0)
    expected = without.step(silent)
    assert without.status == 0
    given = with_.step(spoil(sound_readings()))
    assert with_.status == status
    np.testing.assert_array_equal(given, expected)  # as if nothing had arrived
    np.testing.assert_array_equal(with_.memory, without.memory)
    # And sound ones are heard.
    heard = begun(code)
    heard.step(sound_readings() + np.concatenate([[0.05, 0, 0], np.zeros(len(silent) - 3)]))
    assert heard.status == 0
    assert np.max(np.abs(heard.memory - without.memory)) > 1e-3


def test_it_does_not_fly_before_it_has_begun(code):
    computer = CompiledSensors(code)
    rotors = computer.step(sound_readings())
    assert computer.status == 8
    np.testing.assert_allclose(rotors, VEHICLE.rotor_limits[0])


def test_whatever_arrives_the_answer_is_finite_and_within_limits(code):
    rng, computer = np.random.default_rng(0), begun(code)
    low, high = VEHICLE.rotor_limits
    for _ in range(3000):
        readings = sound_readings() + 10.0 ** rng.uniform(-6, 12) * rng.standard_normal(len(sound_readings()))
        readings[rng.integers(len(readings))] = rng.choice([np.nan, np.inf, -1.0, 1e300])
        rotors = computer.step(readings)
        assert np.all((rotors >= low - 1e-12) & (rotors <= high + 1e-12))
        assert np.all(np.isfinite(computer.memory))


def test_the_folder_has_the_two_files_and_only_with_sensors(tmp_path):
    mocap = SUITES["mocap"]
    quiet = mocap.replace(rod=replace(mocap.rod, noise=1e-3))  # which needs no calmer law
    fp.export_c(LAW, VEHICLE, tmp_path / "with", sensors=quiet, check=False)
    fp.export_c(LAW, VEHICLE, tmp_path / "without", check=False)
    names = {file.name for file in (tmp_path / "with").iterdir()} - {f.name for f in (tmp_path / "without").iterdir()}
    assert names == {"flypend_sensors.h", "flypend_sensors.c"}
    law = "flypend_law.c"
    assert (tmp_path / "with" / law).read_text() == (tmp_path / "without" / law).read_text()
    (tmp_path / "with" / "flypend_sensors.h").write_text("/* my own */")
    fp.export_c(LAW, VEHICLE, tmp_path / "with", check=False)
    left = {file.name for file in (tmp_path / "with").iterdir()} - {f.name for f in (tmp_path / "without").iterdir()}
    assert left == {"flypend_sensors.h"}
    with pytest.raises(fp.InputError, match="sensors"):
        fp.export_c(LAW, VEHICLE, tmp_path / "wrong", sensors="onbord", check=False)


def test_a_memory_that_is_damaged_in_flight_begins_again_at_the_last_estimate(monkeypatch):
    struck = []

    def striking(self, t, measured, command=CompiledSensors.command):
        if round(t * 500) in (100, 200):
            self.memory[150] += 0.5
            struck.append(t)
        return command(self, t, measured)

    monkeypatch.setattr(CompiledSensors, "command", striking)
    upright = fp.State(y=(0.0, 0.0, 1.0)).packed()
    run = flown(compiled(LAW, VEHICLE), Plant(sensors=SLOWER), upright, 3.0)
    assert run.outcome.status == "completed"
    assert len(struck) == 2
    assert run.packed[-1, 20] > 0.98


@pytest.mark.parametrize(
    "spoil",
    [
        lambda computer: computer.step(sound_readings()[:-1]),
        lambda computer: computer.step(sound_readings(), np.zeros(26)),
        lambda computer: computer.begin(np.ones(3)),
    ],
)
def test_arrays_that_c_would_read_past_are_refused(code, spoil):
    with pytest.raises(fp.InputError, match="numbers of shape"):
        spoil(begun(code))


def test_cmake_builds_the_estimator_too_without_a_warning_of_clang(tmp_path):
    """Of a law that reads no path, whose step has one pointer to check."""
    fp.export_c(fp.laws.corrected(), VEHICLE, tmp_path, precision="float", sensors="mocap", check=False)
    flags = ("-DCMAKE_C_COMPILER=clang", "-DCMAKE_C_FLAGS=-Werror")
    run(["cmake", "-S", ".", "-B", "build", *flags], tmp_path)
    run(["cmake", "--build", "build", "--target", "flypend_law"], tmp_path)
    assert " T flypend_sensors_step" in run(["nm", "build/libflypend_law.a"], tmp_path)
    assert "flypend_sensors.h" in (tmp_path / "README.md").read_text(encoding="utf-8")
    # The next export into the folder has none; that of the last, in the other precision, is no part of it.
    fp.export_c(fp.laws.corrected(), VEHICLE, tmp_path, check=False)
    run(["cmake", "--build", "build", "--target", "flypend_law"], tmp_path)
