"""The basin as a number: which flights enter the certified set, and what their share says."""

import json

import numpy as np
import pytest
from scipy.stats import binomtest

import flypend as fp
from flypend.flight.tasks import SWAY, free_starts, random_hanging, touches
from flypend.laws.lag import lead_law
from flypend.studies import basin
from flypend.studies.basin import measure_basin
from tests.few import slow

VEHICLE = fp.vehicle("hehn2011")


@pytest.fixture(scope="module")
def certified():
    return fp.laws.almost_global().bind(VEHICLE).certified_set()


def test_nearly_all_starts_enter_under_the_inverted_law():
    found = measure_basin(VEHICLE, 500, 3)
    assert found.entered == 500
    assert 2 < found.slowest < 10
    bound = binomtest(500, 500, alternative="greater").proportion_ci(0.95, "exact").low
    assert found.least == pytest.approx(bound, rel=1e-12)


def test_another_law_enters_from_fewer_and_those_flights_do_converge(certified):
    lqr = fp.laws.lqr()
    starts = fp.State.random(np.random.default_rng(2), 200, max_omega=0.3, max_y_dot=0.3, max_x_dot=0.3)
    entering, _ = basin._find_entry(lqr.bind(VEHICLE), certified, starts, *basin.PASSES[0])
    assert 0 < np.sum(np.isfinite(entering)) < 200
    law = fp.laws.supervised(first=lqr, level=certified.c, yaw_rate=certified.yaw_rate)
    flown = fp.simulate_ensemble(VEHICLE, law, starts, 25.0, plant=fp.Ideal(limits=True))
    assert np.all(flown.success[np.isfinite(entering)])


def test_a_flight_counts_only_if_its_own_error_leaves_it_inside(certified, monkeypatch):
    """With a safety factor beyond measure no flight is inside for sure."""
    starts = fp.random_starts(20, 4)
    law = fp.laws.inverted().bind(VEHICLE)
    assert np.all(np.isfinite(basin._find_entry(law, certified, starts, *basin.PASSES[0])[0]))
    monkeypatch.setattr(basin, "SAFETY", 1e300)
    assert np.all(np.isnan(basin._find_entry(law, certified, starts, *basin.PASSES[0])[0]))


def test_those_that_are_late_are_flown_again(monkeypatch):
    monkeypatch.setattr(basin, "PASSES", ((2.5, 1e-6, 1e-8), basin.PASSES[1]))
    found = measure_basin(VEHICLE, 30, 3)
    assert found.again > 5
    assert found.entered == 30


def test_no_runs_are_refused():
    with pytest.raises(fp.InputError) as error:
        measure_basin(VEHICLE, 0, 3)
    assert error.value.field == "runs"


def test_what_the_theorem_does_not_model_is_refused():
    with pytest.raises(fp.InputError) as error:
        measure_basin(VEHICLE.replace(mount="cup"), 10, 3)
    assert error.value.field == "law.vehicle"
    with pytest.raises(fp.InputError) as error:
        measure_basin(VEHICLE, 10, 3, starts="level")
    assert error.value.field == "starts"


@pytest.mark.parametrize("lag", [False, slow(True)])
def test_on_a_hub_starts_are_free_and_what_does_not_enter_touches(lag):
    hub = VEHICLE.replace(mount="hub")
    found = measure_basin(hub, 100, 3, starts="hanging", lag=lag)
    assert (found.mount, found.starts, found.entered, found.touched) == ("hub", "hanging", 100, 0)
    found = measure_basin(hub, 200, 5, lag=lag)
    assert 100 < found.entered < 195
    assert found.entered + found.touched == 200
    starts = free_starts(hub, basin.DRAWS["random"], np.random.default_rng((5, 0)), basin.CHUNK)[:200]
    assert not touches(hub, starts).any()
    law = lead_law(fp.laws.inverted()) if lag else fp.laws.inverted()
    flown = fp.simulate_ensemble(hub, law, starts, 40.0, plant=fp.Ideal(limits=True, lag=lag))
    assert np.sum(np.isfinite(flown.end) & (flown.clearance <= 0)) == found.touched


def test_hanging_starts_are_level_at_rest_near_straight_down():
    starts = random_hanging(np.random.default_rng(3), 4000)
    angle = np.pi - np.arccos(starts.y[:, 2])
    assert 0.99 * SWAY < angle.max() <= SWAY
    # Uniform on the cap: half of its area lies within 10°/√2 of its centre, nearly.
    assert np.median(angle) == pytest.approx(SWAY / np.sqrt(2), rel=0.03)
    np.testing.assert_allclose(starts.R[:, :, 2], np.broadcast_to([0, 0, 1], (4000, 3)), rtol=0, atol=1e-15)
    assert not starts.omega.any()
    assert not starts.y_dot.any()


def test_the_numbers_are_saved(tmp_path):
    found = measure_basin(VEHICLE, 20, 3)
    found.save(tmp_path / "basin.json")
    assert json.loads((tmp_path / "basin.json").read_text())["entered"] == found.entered
