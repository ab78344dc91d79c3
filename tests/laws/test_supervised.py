"""The supervisor: the first law outside the certified set, the almost global law in it, within rotor limits."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.export.interface import interface
from flypend.geometry import E3, norm
from flypend.laws import references

VEHICLE = fp.vehicle("hehn2011")
SET = {"level": 0.02, "yaw_rate": 0.1}  # within the certified set, which takes seconds to find
NEAR = fp.State(x=(0.005, 0, 0), y=(0, 0, 1))


def wrench_of(law, state):
    time, packed, F = ca.SX.sym("t"), ca.SX.sym("s", 24), ca.SX.sym("F", 6)
    external = (F[:3], F[3:])
    found = law.bind(VEHICLE).evaluate(time, fp.State.symbolic(packed), VEHICLE, external).wrench
    function = ca.Function("wrench", [time, packed, F], [ca.vertcat(found.thrust, found.moment)])
    return np.array(function(0.0, state.packed(), np.array([0.1, 0, -0.2, 0.01, 0.02, 0]))).ravel()


def test_the_state_decides_which_law_flies():
    supervised, B = fp.laws.supervised(**SET), fp.laws.almost_global()
    away = fp.State.random(np.random.default_rng(4))
    turning = fp.State(x=NEAR.x, y=NEAR.y, omega=(0, 0, 0.11))
    for state, other in ((away, fp.laws.inverted()), (NEAR, B), (turning, fp.laws.inverted())):
        np.testing.assert_allclose(wrench_of(supervised, state), wrench_of(other, state), rtol=1e-12)
    assert np.max(np.abs(wrench_of(supervised, NEAR) - wrench_of(fp.laws.inverted(), NEAR))) > 1e-3


def test_the_first_law_brings_its_computer_and_its_reference():
    first = fp.laws.inverted(references.hover((1.0, 2.0, 3.0)), lead=1.0)
    law = fp.laws.supervised(first=first, **SET).bind(VEHICLE)
    assert law.computer == first.bind(VEHICLE).computer
    np.testing.assert_array_equal(np.array(ca.DM(law.reference(0.0))).ravel(), [1.0, 2.0, 3.0])
    there = fp.State(x=(1.0, 2.0, 3.0), y=E3)
    run = fp.simulate(VEHICLE, law, there, 0.1, plant="ideal")
    assert run.signals["certified"][0] == 1


def test_the_set_is_the_certified_one_of_the_vehicle():
    found = fp.laws.almost_global().bind(VEHICLE).certified_set()
    assert fp.laws.supervised().bind(VEHICLE).gains == {"level": found.c, "yaw_rate": found.yaw_rate}


def test_within_limits_a_flight_that_enters_stays_and_converges():
    start = fp.State.random(np.random.default_rng(8), max_omega=6, max_y_dot=6)
    run = fp.simulate(VEHICLE, fp.laws.supervised(**SET), start, 20.0, plant=fp.Ideal(limits=True))
    inside, V = run.signals["certified"], run.signals["V_almost_global"]
    assert inside[0] == 0
    assert np.sum(np.abs(np.diff(inside))) == 1
    assert np.all(np.diff(V[inside == 1]) <= 1e-9 * SET["level"])
    assert norm(run.y[-1] - E3) < 1e-3
    assert norm(run.x[-1]) < 1e-2
    assert run.rotor_forces.min() >= VEHICLE.rotor_limits[0] - 1e-9
    assert run.rotor_forces.max() <= VEHICLE.rotor_limits[1] + 1e-9


def test_it_loses_no_flight_of_the_first_law_on_a_slow_vehicle():
    slow, starts = fp.vehicle("nayak2018"), fp.random_starts(40, 11)
    both = [
        fp.simulate_ensemble(slow, law, starts, 20.0).success
        for law in (fp.laws.inverted(), fp.laws.supervised(level=0.0042, yaw_rate=0.0025))
    ]
    assert both[0].sum() >= 30
    assert np.all(both[1] >= both[0])


def test_a_function_of_the_state_is_exported():
    assert interface(fp.laws.supervised(**SET), VEHICLE)


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: fp.laws.supervised(first=fp.laws.corrected()), "first"),
        (lambda: fp.laws.supervised(first=fp.laws.almost_global_lag()), "first"),
        (lambda: fp.laws.supervised(level=0.0), "level"),
        (lambda: fp.laws.supervised(references.circle(1.0, 5.0), **SET).bind(VEHICLE), "law.reference"),
    ],
)
def test_what_cannot_be_supervised_is_refused(make, field):
    with pytest.raises(fp.InputError) as error:
        make()
    assert error.value.field == field


# Rotor limits on the ideal plant --------------------------------------------------------------------------------------


def test_limits_of_the_ideal_plant_are_those_of_fast_sampling():
    start, law = fp.random_starts(1, 3)[0], fp.laws.inverted(lead=1, latency=0, delay_reach=0, observer=0)
    ideal = fp.simulate(VEHICLE, law, start, 1.0, plant=fp.Ideal(limits=True))
    fast = fp.simulate(VEHICLE, law, start, 1.0, plant=fp.Plant(lag=0.0, rate=1e4))
    assert norm(ideal.x[-1] - fast.x[-1]) < 1e-3  # a hold of 0.1 ms is all that differs
    free = fp.simulate(VEHICLE, law, start, 1.0, plant="ideal")
    assert norm(ideal.x[-1] - free.x[-1]) > 0.01


def test_limits_hold_in_either_frame():
    """A law with e₃ down is limited as the same law with e₃ up."""
    start, (low, high) = fp.random_starts(1, 6)[0].flipped(), (0.4, 1.4)
    narrow = VEHICLE.replace(rotor_limits=(low, high))
    free = fp.simulate(narrow, fp.laws.corrected(), start, 1.0, plant="ideal")
    run = fp.simulate(narrow, fp.laws.corrected(), start, 1.0, plant=fp.Ideal(limits=True))
    assert free.rotor_forces.min() < low or free.rotor_forces.max() > high
    assert run.rotor_forces.min() >= low - 1e-9
    assert run.rotor_forces.max() <= high + 1e-9


@pytest.mark.parametrize(
    ("law", "start"), [(fp.laws.corrected, fp.random_starts(1, 6)[0].flipped()), (fp.laws.almost_global, NEAR)]
)
def test_limits_that_nothing_meets_change_nothing(law, start):
    free = fp.simulate(VEHICLE, law(), start, 1.0, plant="ideal")
    low, high = VEHICLE.rotor_limits
    assert low < free.rotor_forces.min() < free.rotor_forces.max() < high
    run = fp.simulate(VEHICLE, law(), start, 1.0, plant=fp.Ideal(limits=True))
    np.testing.assert_allclose(run.packed, free.packed, rtol=0, atol=1e-6)


def test_the_first_law_flies_to_the_reference_that_is_given():
    there = fp.laws.references.hover((1.0, 0.0, 0.0))
    law = fp.laws.supervised(there, first=fp.laws.inverted(), level=0.05, yaw_rate=0.15)
    run = fp.simulate(fp.vehicle("hehn2011"), law, fp.State(y=(0, 0.6, 0.8)), 8, plant=fp.Ideal(limits=True))
    assert run.signals["certified"][-1] == 1
