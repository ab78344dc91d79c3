"""Paths: a plan stays where they have the pivot, in time, with the rod up, faster than a law."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.geometry import norm
from flypend.laws import references

HEHN = fp.vehicle("hehn2011")
HOVER = np.full(4, HEHN.weight / 4)
RADIUS, DURATION = 0.5, 4.0
UP = {"lean": np.pi / 2, "rotors": HOVER, "duration": DURATION, "time_limit": 120.0}


def twice_around(t):
    """Two rounds of a circle, from rest to rest."""
    s = t / DURATION
    angle = 4 * np.pi * s**3 * (10 - 15 * s + 6 * s**2)
    return RADIUS * ca.vertcat(ca.cos(angle), ca.sin(angle), 0)


START = fp.State(x=(RADIUS, 0, 0), y=(0, 0, 1))


@pytest.fixture(scope="module")
def circle():
    return fp.plan(HEHN, START, path=twice_around, **UP)


def test_a_circle_is_kept_to_where_the_law_drops_the_rod(circle):
    assert circle.status == "converged"
    assert np.min(circle.y[:, 2]) > 0
    off = norm(circle.x - np.array([twice_around(t).full()[:, 0] for t in circle.t]))
    assert np.max(off) == pytest.approx(circle.excursion, rel=1e-12)
    assert circle.excursion < 0.1
    np.testing.assert_allclose(circle.target, [RADIUS, 0, 0], atol=1e-12)
    assert norm(circle.x[-1] - circle.target) < 0.01 * HEHN.l
    law = fp.simulate(HEHN, fp.laws.inverted(twice_around), START, DURATION, plant="rotors")
    assert np.max(norm(law.x - law.x_ref)) > 1
    assert np.min(law.y[:, 2]) < 0


def test_it_is_flown_and_judged_about_the_path(circle):
    run = fp.simulate(HEHN, fp.track(circle), START, DURATION + 2, plant="rotors")
    assert fp.metrics(run).success
    np.testing.assert_allclose(run.x_ref[-1], circle.target, atol=1e-12)
    assert fp.metrics(run).excursion < 1.2 * circle.excursion


def test_without_the_path_a_plan_stays_where_it_is(circle):
    stays = fp.plan(HEHN, START, target=(RADIUS, 0, 0), **UP)
    meant = np.array([twice_around(t).full()[:, 0] for t in stays.t])
    assert np.max(norm(stays.x - meant)) > RADIUS


def test_a_path_that_stays_at_the_target_is_none():
    start = fp.random_starts(1, seed=909)[0]
    free = fp.plan(HEHN, start, duration=3.0, time_limit=120.0)
    still = fp.plan(HEHN, start, path=references.hover(), duration=3.0, time_limit=120.0)
    assert still.excursion == pytest.approx(free.excursion, rel=1e-6)  # the same problem, compiled another way


def test_a_moving_end_is_another_frame():
    """A path at constant speed, begun and ended at rest in hover, differs from hover by what that takes."""
    there = references.line((0, 0, 0), (0.3, 0, 0))
    plan = fp.plan(HEHN, fp.State(y=(0, 0, 1)), path=there, rotors=HOVER, duration=3.0, time_limit=120.0)
    assert plan
    np.testing.assert_allclose(plan.target, [0.9, 0, 0], atol=1e-12)
    assert plan.excursion < 0.15 < 0.9


def test_ensembles_follow_paths_too(circle):
    lean = np.array([0.0, 0.1, -0.2])  # rad
    leans = fp.State(x=np.tile(START.x, (3, 1)), y=np.column_stack([np.sin(lean), 0 * lean, np.cos(lean)]))
    wishes = {name: value for name, value in UP.items() if name != "time_limit"}
    plans = fp.plan_ensemble(HEHN, leans, path=twice_around, **wishes)
    assert np.all(plans.success)
    assert plans[0].excursion == pytest.approx(circle.excursion, rel=0.1)  # two guesses instead of eight


@pytest.mark.parametrize(
    ("wish", "line"),
    [
        ({"path": twice_around}, "duration: expected the time that the path takes, s, got nothing"),
        ({"path": twice_around, "duration": 4, "target": (0, 0, 0)}, "target: expected nothing beside a path"),
        ({"path": twice_around, "duration": 4, "objective": "time"}, "objective: expected another beside a path"),
        ({"path": (1, 2, 3), "duration": 4}, "a function of time that gives a position"),
    ],
)
def test_what_cannot_be_is_told(wish, line):
    with pytest.raises(fp.InputError, match=line):
        fp.plan(HEHN, START, **wish)
