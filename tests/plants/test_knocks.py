"""Knocks: one in every interval, at a moment without preference, of the size asked for, in no preferred direction."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.compile.llvm.random import normals
from flypend.compile.numeric import as_numpy
from flypend.model import linear_momentum
from flypend.plants.measurement import GUST_MEMORY, GUSTS, gusts, wind_numbers

RATE, PERIOD = 200.0, 0.1  # twenty ticks an interval
TICKS = round(PERIOD * RATE)


def forces(wind, ticks, seed=3):
    """The forces (ticks, 6) of `wind`, N."""
    step, numbers, memory, out = as_numpy(gusts()), wind_numbers(wind, 1 / RATE), np.zeros(GUST_MEMORY), []
    for drawn in normals(seed, ticks)[:, GUSTS]:
        memory, force = step(memory, drawn, numbers)
        out.append(force)
    return np.array(out)


def test_each_interval_has_one_knock_of_the_size_asked_for():
    given = forces(fp.Wind(knock_on_vehicle=0.3, knock_on_bob=0.02, knock_period=PERIOD), 50 * TICKS)
    for on, impulse in ((given[:, :3], 0.3), (given[:, 3:], 0.02)):
        size = np.linalg.norm(on, axis=1) / RATE
        hit = size > 0
        assert np.all(hit.reshape(50, TICKS).sum(axis=1) == 1)
        np.testing.assert_allclose(size[hit], impulse, rtol=1e-12)


def test_moments_and_directions_have_no_preference():
    knocks = 4000
    given = forces(fp.Wind(knock_on_bob=1.0, knock_period=PERIOD), knocks * TICKS)[:, 3:] / RATE
    hit = np.linalg.norm(given, axis=1) > 0
    counts = np.bincount(np.flatnonzero(hit) % TICKS, minlength=TICKS)
    expected = knocks / TICKS
    # chi-squared with 19 degrees of freedom: mean 19, standard deviation 6.2
    assert np.sum((counts - expected) ** 2 / expected) < 19 + 5 * 6.2
    directions = given[hit]
    assert np.max(np.abs(directions.mean(axis=0))) < 4 / np.sqrt(3 * knocks)
    np.testing.assert_allclose(directions.T @ directions / knocks, np.eye(3) / 3, atol=4 * 0.3 / np.sqrt(knocks))


def test_a_knock_changes_the_momentum_by_its_impulse_and_leaves_gusts_alone():
    wind = fp.Wind(knock_on_vehicle=0.05, knock_period=1.0)
    vehicle = fp.vehicle("hehn2011")

    def fall(t, state):
        return fp.Wrench(0.0, np.zeros(3))

    plant = fp.Plant(limits=False, lag=0.0, rate=RATE, wind=wind, seed=5)
    law = fp.Controller(name="fall", function=fall)
    times = np.arange(0, 201) / RATE
    run = fp.simulate(vehicle, law, fp.State(y=(0, 0, 1)), 1.0, plant=plant, times=times)
    gained = np.diff(linear_momentum(run.states, vehicle), axis=0) + np.array([0, 0, vehicle.weight / RATE])
    size = np.linalg.norm(gained, axis=1)
    assert np.sum(size > 1e-9) == 1
    assert np.max(size) == pytest.approx(0.05, rel=1e-6)  # roundoff of a difference of momenta of order 5 N s
    gust = fp.Wind(gust_on_bob=0.1)
    both = forces(fp.Wind(gust_on_bob=0.1, knock_on_bob=1e-9, knock_period=PERIOD), 100)
    np.testing.assert_allclose(both, forces(gust, 100), rtol=0, atol=1e-9 * RATE)


def test_gusts_blow_from_the_start_as_hard_as_later():
    """By the momentum that machines in free fall gain in the first two ticks."""
    size, period = 0.2, 1 / RATE
    vehicle, wind = fp.vehicle("hehn2011"), fp.Wind(gust_on_vehicle=size, gust_on_bob=size, gust_time=20.0)
    rest = fp.Law(name="rest", e3="up", control=lambda *_: fp.Wrench(ca.SX(0), ca.SX.zeros(3)))
    plant = fp.Plant(limits=False, lag=0.0, rate=RATE, wind=wind)
    starts = fp.State.trusted(np.tile(fp.State(y=(0, 0, 1)).packed(), (400, 1)))
    found = fp.simulate_ensemble(vehicle, rest, starts, 2 * period, plant=plant, times=[0.0, period, 2 * period])
    gained = np.diff(linear_momentum(found.samples, vehicle), axis=1) / period + np.array([0, 0, vehicle.weight])
    # Of 1200 numbers the standard deviation is known to a share of 1/√2400; six of those.
    np.testing.assert_allclose(gained.std(axis=(0, 2)), np.sqrt(2) * size, rtol=6 / np.sqrt(2400))
    single = fp.simulate(vehicle, rest, starts[3], 2 * period, plant=plant.replace(seed=3), engine="scipy")
    np.testing.assert_allclose(single.packed[-1], found.samples.packed()[3, -1], rtol=0, atol=1e-12)
