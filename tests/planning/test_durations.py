"""The search over durations: more time is never the worse, and the least time is the least that a slow search finds."""

from __future__ import annotations

import numpy as np
import pytest

import flypend as fp
from flypend.geometry import E3
from flypend.planning import guess
from flypend.planning.durations import EQUAL, HORIZONS, SHORTER, ladder
from flypend.planning.problem import request

HEHN, HANGING = fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1))
STARTS = fp.random_starts(9, 4712)


def test_the_least_time_from_hanging_is_within_two_per_cent_of_the_least_known():
    """An independent search found a flight of 0.975 s (issue 34); bisection of stages alone stops at 1.000 s."""
    plan = fp.plan(HEHN, HANGING, "time")
    assert plan.status == "converged"
    assert plan.duration < 1.02 * 0.975
    assert plan.y[-1, 2] > np.cos(0.022)
    assert plan.end_error < 1e-3
    assert plan.guesses > 20
    assert 1 <= plan.agreeing <= plan.guesses


def test_the_least_time_does_not_exceed_the_time_allowed():
    plan = fp.plan(HEHN, fp.State(y=(0.1, 0, np.sqrt(0.99))), "time", duration=1.2)
    assert plan
    assert plan.duration < 1.2
    assert not fp.plan(HEHN, HANGING, "time", duration=0.5)


@pytest.mark.parametrize("allowed", [1.0, 1.1])
def test_the_least_time_is_found_where_little_more_is_allowed(allowed):
    plan = fp.plan(HEHN, HANGING, "time", duration=allowed)
    assert plan
    assert plan.duration < 1.0


def test_a_start_that_hovers_has_a_shortest_plan():
    """It ended where floats do, with states that are no numbers."""
    plan = fp.plan(HEHN, fp.State(x=(0.004, 0, 0), y=E3), "time", rotors=np.full(4, HEHN.weight / 4))
    assert plan
    assert 0 < plan.duration < 0.05
    assert np.all(np.isfinite(plan.packed))


def test_a_search_for_the_least_time_that_is_stopped_says_so():
    plan = fp.plan(HEHN, HANGING, "time", time_limit=0.3)
    assert plan.status == "feasible"
    assert plan.reason == "stopped at the time limit"


@pytest.mark.parametrize("start", [7, 5])
def test_more_time_is_never_the_worse(start):
    """Each duration by itself leads to 0.169 m in 2 s after 0.156 m in 1.5 s from one of these starts."""
    least = np.inf
    for duration in (1.5, 2.0, 3.0, 4.0):
        plan = fp.plan(HEHN, STARTS[start], duration=duration)
        assert plan
        assert plan.duration <= duration + 1e-9
        assert plan.excursion < 1.01 * least
        least = min(least, plan.excursion)


def test_a_plan_takes_all_of_the_time_unless_less_is_better():
    short, long = (fp.plan(HEHN, HANGING, duration=duration) for duration in (2.0, 3.0))
    assert (short.duration, long.duration) == pytest.approx((2.0, 3.0))
    assert long.excursion < 0.9 * short.excursion


def test_horizons_grow_to_the_one_asked_for_and_a_path_has_no_other():
    free = request(HEHN, HANGING, "excursion", (0, 0, 0))
    assert ladder(None, free) == [*HORIZONS]
    walled = request(HEHN, HANGING, "excursion", (0, 0, 0), None, fp.Constraints(floor=-1.0))
    assert ladder(None, walled) == [SHORTER[-1], *HORIZONS]
    assert ladder(13.0, free) == [*SHORTER, 12.5, 13.0]
    assert ladder(12.5 * (1 + EQUAL / 2), free) == [*SHORTER, 12.5 * (1 + EQUAL / 2)]
    kept = fp.Constraints(path=fp.laws.references.hover())
    assert ladder(13.0, request(HEHN, HANGING, "excursion", (0, 0, 0), None, kept)) == [13.0]


def test_on_an_arc_the_rod_follows_its_equation_to_rest_over_the_target():
    """Across the rod, ÿ = −(e₃ + ẍ) in own units; the pivot ends at rest at the target."""
    start = fp.State(x=(0.1, -0.2, 0.05), x_dot=(0.3, 0.2, 0), y=(0.6, 0, -0.8), y_dot=(0.4, 1.0, 0.3))
    asked, stages, h = request(HEHN, start, "time", (0, 0, 0)), 400, 0.00875
    found = guess.arcs(asked, stages, h)
    assert len(found) == len(guess.AZIMUTHS) * len(guess.BUMPS_ASIDE)
    for states, commands in found:
        assert states.shape == (stages + 1, 28)
        assert np.array_equal(states[0], asked.start)
        x, y = states[:, :3], states[:, 18:21]
        bent = np.gradient(np.gradient(y, h, axis=0), h, axis=0)
        pull = bent + E3 + np.gradient(np.gradient(x, h, axis=0), h, axis=0)
        across = (pull - np.sum(pull * y, axis=1, keepdims=True) * y)[4:-4]

        assert np.max(np.abs(across)) < 0.1 * np.max(np.abs(bent))  # differences, with an error of order h
        fast = np.max(np.linalg.norm(np.gradient(states[:, 3:6], h, axis=0), axis=1))
        assert np.linalg.norm(x[-1]) < h * np.max(np.linalg.norm(x, axis=1))  # sums in place of integrals
        assert np.linalg.norm(states[-1, 3:6]) < h * fast  # a difference over the last stage
        assert np.allclose(y[-1], E3)
        assert np.all(commands <= HEHN.rotor_limits[1] / asked.units.force)
