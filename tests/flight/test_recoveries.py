"""Recoveries: constructed flights with known answers, their identity with metrics, and flights that are struck."""

import dataclasses
import math

import numpy as np
import pytest

import flypend as fp
from tests.flight.test_metrics import E3, T, chord, flight, where


def away(*spans):
    """Places 0.5 m off and 0.1 m lower at the times between each of `spans`."""
    mask = np.any([(begin < T) & (end > T) for begin, end in spans], axis=0)
    return where(mask, np.array([0.5, 0, -0.1]), np.zeros(3))


def test_a_flight_within_its_tolerances_recovers_from_nothing():
    assert fp.recoveries(flight()) == []


def test_a_recovery_ends_where_the_tolerances_hold_again():
    (recovery,) = fp.recoveries(flight(x=away((0.495, 0.805))))
    assert recovery.begin == pytest.approx(0.5)
    assert recovery.time == pytest.approx(0.31)
    assert recovery.distance == pytest.approx(math.hypot(0.5, 0.1))
    assert recovery.height_lost == 0.0  # it left at the lower height


def test_height_is_lost_below_where_it_began_in_either_frame():
    y = where((T > 0.495) & (T < 1.005), chord(0.3), E3)
    x = away((0.6, 0.9))
    (recovery,) = fp.recoveries(flight(y=y, x=x))
    assert recovery.height_lost == pytest.approx(0.1)
    down = np.array([1.0, -1.0, -1.0])
    below = dataclasses.replace(flight(), e3="down", x=x * down, y=y * down)
    (recovery,) = fp.recoveries(below, fp.Criterion(axis=math.pi))
    assert recovery.height_lost == pytest.approx(0.1)


@pytest.mark.parametrize(("gap", "count"), [(0.9, 1), (1.0, 1), (1.02, 2), (1.5, 2)])
def test_what_returns_for_less_than_it_has_to_hold_is_the_same_recovery(gap, count):
    x = away((0.195, 0.405), (0.405 + gap, 0.455 + gap))
    found = fp.recoveries(flight(x=x))
    assert len(found) == count


def test_a_flight_that_ends_before_they_have_held_has_not_recovered():
    (recovery,) = fp.recoveries(flight(x=away((1.5, 2.5))))
    assert math.isnan(recovery.time)
    assert recovery.distance > 0.5


@pytest.mark.parametrize(("back", "recovered"), [(1.995, False), (1.985, True)])
def test_the_last_sample_decides_whether_they_have_held(back, recovered):
    """They have to hold for longer than a second, and the flight ends at 3 s."""
    (recovery,) = fp.recoveries(flight(x=away((0.495, back + 0.01))))
    assert math.isnan(recovery.time) != recovered


@pytest.mark.parametrize("lean", [0.6, 1.5, 3.0])
def test_of_a_start_the_time_is_that_of_the_metrics(lean):
    start = fp.State(y=(math.sin(lean), 0, math.cos(lean)))
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), start, duration=7)
    (recovery,), judged = fp.recoveries(run), fp.metrics(run)
    assert judged.success
    assert (recovery.begin, recovery.time) == (0.0, judged.settling)
    assert recovery.distance == judged.excursion
