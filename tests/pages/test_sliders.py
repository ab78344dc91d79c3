"""Sliders: they stand where the flight has them, and what cannot be flown in a page has none."""

import numpy as np
import pytest

import flypend as fp
from flypend.flight.live import live_loop
from flypend.pages.offers import _last_good, _reach, gain_sliders, plant_sliders
from flypend.plants import Plant, Wind

VEHICLE = fp.vehicle("hehn2011")


def test_sliders_of_a_plant_stand_where_the_plant_is():
    wind = Wind(on_vehicle=(0.3, -0.1, 0.2), gust_on_vehicle=0.15)
    flown = Plant(delay=0.01, lag=0.02, mismatch={"rotor_lag": 1.5}, wind=wind)
    sliders = {one["path"]: one for one in plant_sliders(flown, VEHICLE)}
    expected = {
        "vehicle.rotor_limits": VEHICLE.rotor_limits[1], "plant.lag": 0.03, "plant.delay": 0.01,
        "plant.wind.on_vehicle": 0.3, "plant.wind.gust_on_vehicle": 0.15,
    }  # fmt: skip
    assert {name: sliders[name]["value"] for name in expected} == pytest.approx(expected)
    for one in sliders.values():
        assert one["low"] <= one["value"] <= one["high"]
    assert sliders["plant.wind.on_vehicle"]["put"] == [{"#": 1}, -0.1, 0.2]


def test_a_callable_law_has_no_live_page(tmp_path):
    hold = fp.Controller(name="hold", function=lambda t, state: fp.Wrench(5.0, np.zeros(3)), rate=100.0)
    run = fp.simulate(VEHICLE, hold, fp.State(y=(0, 0, 1)), 0.1, plant="rotors")
    with pytest.raises(fp.InputError, match=r"^live: expected a law in symbols, .* the callable hold$"):
        run.to_html(tmp_path / "flight.html", live=True)
    with pytest.raises(fp.InputError, match=r"^live: expected a law in symbols"):
        live_loop(run.flight)


def test_the_ideal_plant_with_lag_has_no_live_page(tmp_path):
    """Its state holds a wrench, which the page would take for the next sample of the motion."""
    run = fp.simulate(VEHICLE, fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.1, plant=fp.Ideal(lag=True))
    with pytest.raises(fp.InputError, match=r"^live: expected an ideal plant without lag, .* got Ideal\(lag=True\)$"):
        run.to_html(tmp_path / "flight.html", live=True)


def test_a_slider_of_a_negative_gain_reaches_as_far_to_either_side():
    reach = _reach(-2.0)
    assert reach.low == -reach.high < -2.0
    assert not reach.log


def test_a_slider_ends_where_its_values_begin_to_be_refused():
    assert _last_good(lambda value: value > 0.3, 0.1, 1.0) == pytest.approx(0.3, rel=1e-3)
    assert _last_good(lambda value: value > 1.0, 0.1, 1.0) == 1.0


def test_a_slider_of_a_gain_that_is_given_as_0_is_not_logarithmic():
    law = fp.laws.inverted(throw_speed=0).bind(VEHICLE)
    (found,) = (one for one in gain_sliders(law, VEHICLE, law.gains) if one["path"] == "law.gains.throw_speed")
    assert (found["value"], found["low"], found["log"]) == (0, 0, False)
    usual = fp.laws.inverted().bind(VEHICLE)
    assert all(one["log"] for one in gain_sliders(usual, VEHICLE, usual.gains) if one["low"] > 0)
