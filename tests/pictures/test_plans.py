"""Figures of plans show what they are given."""

import numpy as np
import pytest

import flypend as fp
from flypend.geometry import norm
from flypend.pictures.plans import front_figure, plan_figure, strays_figure
from flypend.studies.limit import Front, Strays, _directions

HEHN = fp.vehicle("hehn2011")
HANGING = fp.State(y=(0, 0, -1))


@pytest.fixture(scope="module")
def plan():
    return fp.plan(HEHN, HANGING, time_limit=120)


def lines(axes):
    return [line.get_xydata() for line in axes.get_lines()]


def test_a_plan_beside_its_flight(plan):
    run = fp.simulate(HEHN, fp.track(plan), HANGING, plan.duration + 0.5)
    side, distance, lean, forces = plan_figure(plan, run, [fp.Window((0, 0, 0.2), 0.5, 0.4)]).axes
    for data, shown in zip(lines(distance), (plan, run), strict=True):
        np.testing.assert_allclose(data, np.column_stack([shown.t, norm(shown.x)]))
    assert lines(lean)[0][0, 1] == pytest.approx(180)
    assert len(lines(forces)) == 8 + 2
    walls = [data for data in lines(side) if np.ptp(data[:, 0]) == 0 and len(data) == 2]
    assert sorted(float(data[np.argmin(np.abs(data[:, 1] - 0.2)), 1]) for data in walls[-2:]) == [0.0, 0.4]


def test_a_front_leaves_out_what_failed(plan):
    failed = fp.plan(HEHN, HANGING, duration=0.4, time_limit=5)
    (axes,) = front_figure(Front(np.array([0.4, 3.0]), (failed, plan))).axes
    np.testing.assert_allclose(lines(axes)[0], [[3.0, plan.excursion]])


def test_the_sphere_has_both_hemispheres_of_laws_and_plan(plan):
    place, y = _directions(4)
    values = 0.5 + 0.1 * y[:, 2]
    ensemble = fp.plan_ensemble(HEHN, fp.State(y=y), guesses=1, duration=3.0, workers=1)
    strays = Strays(4, place, fp.State(y=y), {"inverted": values, "nmpc": values - 0.2}, ensemble)
    axes = strays_figure(strays).axes
    shown = [panel.collections[0].get_array() for panel in axes[:6]]
    assert np.nanmin(shown[0]) > 0.5 > np.nanmax(shown[1]) > 0.35 > np.nanmin(shown[2])
    assert sum(np.count_nonzero(~np.ma.getmaskarray(np.ma.masked_invalid(part))) for part in shown) == 3 * len(y)
