"""What a vehicle's numbers allow: the bound on leans against the equations it is derived from, and its reasons."""

import numpy as np
import pytest

import flypend as fp
from flypend.flight.feasibility import feasibility, forewarn
from flypend.flight.request import Flight
from flypend.laws.inverted_gains import angular_authority
from flypend.model.by_name import vehicle_names
from flypend.plants import Ideal

HEHN = fp.vehicle("hehn2011")


def mode_after(found, vehicle, lean, delay, seconds, step=1e-4):
    """s = θ̇ + w θ after `seconds` of full moment from a `lean` at rest, by small Euler steps."""
    w, alpha, lag = found.fall_rate, angular_authority(vehicle), vehicle.rotor_lag
    theta = np.array([lean, 0.0, 0.0, 0.0, 0.0])  # θ, θ̇, φ, φ̇, what of the moment has arrived
    for i in range(round(seconds / step)):
        command = 1.0 if i * step >= delay else 0.0
        turning = (command - theta[4]) / lag if lag else 0.0
        arrived = theta[4] if lag else command
        rates = [theta[1], w**2 * (theta[0] - theta[2]), theta[3], alpha * arrived, turning]
        theta = theta + step * np.array(rates)
    return theta[1] + w * theta[0]


@pytest.mark.parametrize(("lag", "delay"), [(0.0, 0.0), (0.05, 0.0), (0.0, 0.04), (0.03, 0.02)])
def test_full_moment_catches_leans_below_the_bound_and_none_above(lag, delay):
    vehicle = HEHN.replace(rotor_lag=lag)
    found = feasibility(vehicle, delay)
    # After 12/w all but e^{−12} (1 + 12 + 12²/2), 0.05 %, of the integral has acted, and Euler's steps err by 0.3 %.
    seconds = 12 / found.fall_rate
    assert mode_after(found, vehicle, 0.97 * found.catch, delay, seconds) < 0
    assert mode_after(found, vehicle, 1.03 * found.catch, delay, seconds) > 0


def test_agility_and_fall_rate_are_those_of_a_light_bob():
    light = HEHN.replace(bob_mass=1e-6)
    found = feasibility(light)
    assert found.fall_rate == pytest.approx(np.sqrt(light.g / light.l), rel=1e-5)
    assert found.agility == pytest.approx(angular_authority(light) * light.l / light.g, rel=1e-5)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"mass": 5.0}, "4 rotors push 14 N, the weight is 49.54 N with mass 5 kg + bob_mass 0.05 kg (not g)"),
        ({"gravity": 0.0}, "without gravity no pose of the rod is upright"),
        ({"rotor_limits": [2.0, 3.5]}, "4 rotors push at least 8 N, the weight is only 5.396 N"),
    ],
)
def test_what_is_impossible_has_one_reason(changes, reason):
    assert feasibility(HEHN.replace(**changes)).impossible == (reason,)


def test_vehicles_of_the_package_can_be_flown():
    for name in vehicle_names():
        found = feasibility(fp.vehicle(name))
        assert found.impossible == found.doubtful == ()


def test_a_late_vehicle_is_told_a_rod_with_which_it_is_not():
    late = HEHN.replace(rotor_lag=0.25)
    (doubt,) = feasibility(late).doubtful
    assert "rotor lag and delay of 250 ms are too long" in doubt
    factor = float(doubt.split(", or a rod ")[1].split(" times")[0])
    assert factor > 1
    assert not feasibility(late.replace(rod_length=1.01 * factor * late.rod_length)).doubtful
    assert feasibility(late.replace(rod_length=0.98 * factor * late.rod_length)).doubtful
    assert feasibility(HEHN.replace(rotor_lag=0.05), delay=0.2).doubtful


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"rotor_limits": [0.08, 1.5]}, "the largest thrust is 1.11 times the weight"),
        ({"inertia": [0.2, 0.2, 0.3]}, "no controller catches a rod that leans by more than"),
    ],
)
def test_doubts_name_what_is_short(changes, words):
    (doubt,) = feasibility(HEHN.replace(**changes)).doubtful
    assert words in doubt


def test_a_flight_is_forewarned_where_rotors_are_to_stand_a_rod():
    flight = Flight(vehicle=HEHN, law=fp.laws.lqr(), starts=fp.State(y=(0, 0, 1)), duration=1.0)
    late = flight.replace(plant=fp.Plant(lag=0.3))
    assert not forewarn(flight)
    assert forewarn(late)
    assert not forewarn(late.replace(plant=Ideal()))
    assert not forewarn(late.replace(law=fp.laws.corrected().bind(HEHN)))
