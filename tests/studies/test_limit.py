"""Excursion against allowed time, and over the sphere of the rod."""

import numpy as np
import pytest

import flypend as fp
from flypend.geometry import norm
from flypend.studies.limit import _directions, front, strays
from flypend.studies.sweep.bins import EDGE, lambert

HEHN = fp.vehicle("hehn2011")
HANGING = fp.State(y=(0, 0, -1))


def test_less_time_takes_more_room():
    found = front(HEHN, HANGING, 3, time_limit=120)
    assert found.durations[-1] == pytest.approx(12.5 * np.sqrt(HEHN.l / HEHN.g))
    assert np.all(np.diff(found.excursion) < 0)
    assert found.excursion[0] > 4 * found.excursion[-1]
    for plan, allowed in zip(found.plans, found.durations, strict=True):
        assert plan.duration == pytest.approx(allowed, rel=0.01)  # whole stages of 20 ms


def test_counts_are_whole():
    with pytest.raises(fp.InputError, match=r"^count: expected an integer >= 2, got 2\.5"):
        front(HEHN, HANGING, 2.5)
    with pytest.raises(fp.InputError, match=r"^cells: expected an integer >= 2, got 2\.5"):
        strays(HEHN, [fp.laws.inverted()], 2.5)


def test_where_nothing_can_be_planned_the_front_is_one_failure():
    box = ((-0.05, -0.05, -0.7), (0.05, 0.05, 0.7))
    found = front(HEHN, HANGING, 3, time_limit=2.0, box=box)
    assert len(found.plans) == 1
    assert np.isnan(found.excursion).all()


def test_directions_are_the_middles_of_equal_cells():
    place, y = _directions(9)
    np.testing.assert_allclose(norm(y), 1, atol=1e-12)
    upper, flat = lambert(y)
    np.testing.assert_array_equal(upper, place[:, 0] == 0)
    middles = (place[:, [2, 1]] + 0.5) / 9 * 2 * EDGE - EDGE
    np.testing.assert_allclose(flat, middles, atol=1e-12)
    assert np.all(np.linalg.norm(flat, axis=-1) < EDGE)
    assert np.abs(y.mean(axis=0)).max() < 1e-12  # equal areas, evenly spread


def test_plans_stray_less_than_the_law_everywhere():
    found = strays(HEHN, [fp.laws.inverted()], 3, guesses=4, workers=1)
    assert np.all(found.plans.success)
    assert np.all(found.plans.excursion < 0.2 * found.by_law["inverted"])
    upper = found.disc(found.by_law["inverted"], 0)
    assert upper.shape == (3, 3)
    assert np.isfinite(upper).all()
