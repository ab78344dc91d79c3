"""What a flight tells of its model: scales are told from forces, and blows from both."""

import numpy as np
import pytest

import flypend as fp
from flypend.planning.model_error import BLOW, ModelError
from flypend.plants.equations import EquationsEngine

HEHN = fp.vehicle("hehn2011")
PERIOD = 0.002
NONE = np.zeros(6)


def flown(vehicle, wind=NONE, seconds=1.5, delivered=1.0):
    """Return the error that is found of HEHN where `vehicle` flies, tumbling under commands of every kind."""
    engine, error, rng = EquationsEngine(vehicle), ModelError(HEHN, PERIOD), np.random.default_rng(5)
    rotors = np.full(4, HEHN.weight / 4)
    engine.reset(fp.random_starts(1, seed=8)[0].packed(), delivered * rotors)
    for k in range(round(seconds / PERIOD)):
        if k % 50 == 0:
            command = rng.uniform(0.3, 3.0) * (1 + 0.02 * rng.standard_normal(4))
        engine.step(delivered * command, PERIOD, wind)
        error.update(engine.packed, engine.rotors / delivered)
    return error


@pytest.mark.parametrize("factor", [0.8, 1.2])
def test_equal_mass_errors_are_a_scale_of_the_thrust_and_no_force(factor):
    error = flown(HEHN.replace(mass=factor * HEHN.mass, bob_mass=factor * HEHN.bob_mass))
    assert error.scales == pytest.approx([1 / factor, 1], abs=0.01)  # the prior pulls by so much after 1.5 s
    assert np.max(np.abs(error.forces)) < 0.02 * HEHN.weight


def test_wind_is_a_force_and_no_scale():
    wind = np.array([0.4, -0.2, 0.3, 0.02, 0.0, 0.0])
    error = flown(HEHN, wind)
    assert error.scales == pytest.approx([1, 1], abs=0.02)
    np.testing.assert_allclose(error.forces, wind, atol=0.1)


def test_weak_rotors_and_wind_are_told_apart():
    wind = np.array([0.4, 0.0, 0.0, 0.0, 0.0, 0.0])
    error = flown(HEHN, wind, delivered=0.85)
    assert error.scales[0] == pytest.approx(0.85, abs=0.02)
    np.testing.assert_allclose(error.forces, wind, atol=0.1)


def test_a_model_without_error_is_left_alone():
    error = flown(HEHN)
    np.testing.assert_allclose(error.scales, 1, atol=1e-4)  # the trapezoidal rule over a period
    assert np.max(np.abs(error.forces)) < 1e-3


def test_the_machine_that_is_found_moves_under_the_same_forces_as_the_true_one():
    true = HEHN.replace(mass=1.2 * HEHN.mass, bob_mass=1.2 * HEHN.bob_mass)
    error = ModelError(HEHN, PERIOD)
    error.scales = np.array([1 / 1.2, 1.0])
    engines = [EquationsEngine(vehicle) for vehicle in (true, error.machine, HEHN)]
    command = np.array([1.0, 1.5, 2.0, 0.5])
    for engine in engines:
        engine.reset(fp.random_starts(1, seed=8)[0].packed(), command)
        engine.step(command, 0.02, NONE)
    np.testing.assert_allclose(engines[1].packed, engines[0].packed, atol=1e-12)
    assert np.max(np.abs(engines[2].packed - engines[0].packed)) > 1e-2


@pytest.mark.parametrize(("jump", "told"), [(0.9, True), (1.1, False)])
def test_a_blow_tells_nothing(jump, told):
    error, rotors = ModelError(HEHN, PERIOD), np.full(4, HEHN.weight / 4)
    for speed in (0.0, jump * BLOW * np.sqrt(HEHN.g * HEHN.l)):
        error.update(fp.State(x_dot=(0, 0, speed), y=(0, 0, 1)).packed(), rotors)
    assert (error.scales[0] != 1) == told
