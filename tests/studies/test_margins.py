"""The search of margins finds where success drops, on worlds whose margins are known, and on the real one."""

import time
from dataclasses import replace

import numpy as np
import pytest

import flypend as fp
from flypend.flight.request import Flight
from flypend.flight.tasks import task_starts
from flypend.plants import MOTION_CAPTURE, ROTORS
from flypend.studies import margins
from flypend.studies.margins import RESOLUTION, Count, Quantity, quantities, search

HEHN = fp.vehicle("hehn2011")
INVERTED = fp.laws.inverted().bind(HEHN)
RUNS = 40
FLIGHT = Flight(vehicle=HEHN, law=INVERTED, starts=task_starts(HEHN, RUNS, 4)["random"], duration=8.0)


@pytest.fixture
def known(monkeypatch):
    """A function that lets all flights succeed inside a region of plants, and half of them outside; what was flown."""
    flown = []

    def let(inside):
        def succeed(flight):
            flown.append(flight.plant)
            return Count(RUNS if inside(flight.plant) else RUNS // 2, RUNS)

        monkeypatch.setattr(margins, "count_of", succeed)
        return flown

    return let


@pytest.mark.parametrize("edge", [0.004, 0.023, 0.11])
def test_the_boundary_of_a_known_margin_is_found_in_few_flights(known, edge):
    flown = known(lambda plant: plant.delay <= edge)
    (delay,) = search(FLIGHT, quantities(HEHN, ROTORS)[:1]).values()
    assert delay.high <= 1e3 * edge < delay.high * (1 + RESOLUTION) + 1e-9
    assert len(flown) <= 12
    assert not delay.open_high
    assert delay.values == tuple(sorted(1e3 * plant.delay for plant in flown))
    assert delay.values[0] == delay.nominal == 0.0
    assert delay.successes == tuple(RUNS if value <= 1e3 * edge else RUNS // 2 for value in delay.values)


def test_both_sides_of_a_factor_are_searched_and_may_be_open(known):
    known(lambda plant: plant.mismatch.get("mass", 1.0) > 0.6)
    (mass,) = (m for m in search(FLIGHT, quantities(HEHN, ROTORS)).values() if m.name == "mass")
    assert 0.6 < mass.low < 0.6 * (1 + RESOLUTION)
    assert mass.high == 4.0
    assert (mass.open_low, mass.open_high) == (False, True)
    assert mass.describe().endswith("to more than 4 times the believed")
    assert mass.describe().startswith("0.6")


def test_a_world_that_fails_at_once_has_no_margin(known):
    known(lambda plant: plant.noise is None)
    (noise,) = (m for m in search(FLIGHT, quantities(HEHN, ROTORS)).values() if m.name == "noise")
    assert (noise.high, noise.nominal, noise.successes[0]) == (0.0, 0.0, RUNS)


def test_a_margin_that_ends_before_its_first_step_is_searched_to_its_end(known):
    plant = ROTORS.replace(delay=0.49)
    flown = known(lambda plant: True)
    (delay,) = search(replace(FLIGHT, plant=plant), quantities(HEHN, plant)[:1]).values()
    assert (delay.high, delay.open_high) == (pytest.approx(500.0), True)
    assert len(flown) == 2


def test_a_search_that_is_broken_off_ends_those_under_way(monkeypatch):
    flown = []

    def succeed(flight):
        flown.append(flight)
        time.sleep(0.002)
        return Count(RUNS, RUNS)

    def tell(_name, done, _total):
        if done:
            raise RuntimeError

    monkeypatch.setattr(margins, "count_of", succeed)
    short, endless = (
        Quantity(name, "", 0.0, lambda _: ROTORS, float, 1.0, most, both=False)
        for name, most in (("short", 1.0), ("endless", np.inf))
    )
    with pytest.raises(RuntimeError):
        search(FLIGHT, [short, endless], tell)
    assert len(flown) < 500  # of a thousand, until a distance that doubles is infinite


def test_quantities_start_from_the_plant_and_leave_the_rest_of_it_alone():
    plant = fp.Plant(delay=0.01, noise=fp.Noise(y=1e-3), mismatch={"mass": 1.1, "rotor_lag": 2.0}, rate=250.0)
    by_name = {quantity.name: quantity for quantity in quantities(HEHN, plant)}
    assert by_name["delay"].plant(by_name["delay"].value(0.02)) == plant.replace(delay=0.03)
    assert by_name["noise"].plant(2.0).noise == fp.Noise(y=2e-3)
    assert by_name["mass"].plant(2.0).mismatch == {"mass": 2.2, "bob_mass": 2.0, "rotor_lag": 2.0}
    lag = by_name["rotor lag"]
    assert lag.nominal == pytest.approx(40.0)  # twice that of the vehicle
    assert lag.plant(lag.value(0.5)).true_vehicle(HEHN).rotor_lag == pytest.approx(0.06)
    for quantity in by_name.values():
        assert quantity.value(0.0) == pytest.approx(quantity.nominal)
        assert quantity.plant(quantity.nominal).true_vehicle(HEHN) == plant.true_vehicle(HEHN)


def test_rotors_without_lag_and_measurements_without_noise_have_margins_too():
    found = {quantity.name: quantity for quantity in quantities(HEHN, ROTORS.replace(lag=0.0))}
    assert (found["rotor lag"].nominal, found["rotor lag"].both) == (0.0, False)
    assert found["noise"].plant(1.5).noise.y == pytest.approx(1.5 * MOTION_CAPTURE.y)


def test_the_margin_of_the_inverted_law_is_where_flights_fail():
    """Of the law that does not find its delay; with what it finds, flights stand as far as the search goes."""
    law = fp.laws.inverted(delay_reach=0.0).bind(HEHN)
    (lag,) = search(replace(FLIGHT, law=law), quantities(HEHN, ROTORS)[1:2]).values()
    assert lag.high > 20.0
    rates = [
        fp.simulate_ensemble(HEHN, law, FLIGHT.starts, 8.0, plant=ROTORS.replace(lag=ms / 1e3)).rate
        for ms in (lag.high, 1.25 * lag.high)
    ]
    assert rates[0] >= 0.9 > rates[1]
    rate, bounds = lag.rate()
    assert np.all((bounds[0] <= rate) & (rate <= bounds[1]))
