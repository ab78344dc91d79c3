"""Sizes of drawings: rotors of a vehicle that tells none leave room between them, and a picture holds what moves."""

import numpy as np
import pytest

import flypend as fp
from flypend.pages.sketch import disc_radius, reach


@pytest.mark.parametrize("name", ["hehn2011", "crazyflie", "hummingbird-omnidrones"])
def test_discs_of_no_told_size_are_seen_and_do_not_overlap(name):
    vehicle = fp.vehicle(name).replace(body=None, mount="gimbal")
    places = vehicle.rotors_from_pivot
    nearest = min(np.linalg.norm(a - b) for i, a in enumerate(places) for b in places[:i])
    assert 0.2 * nearest < disc_radius(vehicle) < 0.5 * nearest


@pytest.mark.parametrize("name", ["hehn2011", "crazyflie"])
def test_a_picture_holds_discs_and_bob_wherever_they_turn(name):
    vehicle = fp.vehicle(name)
    discs = np.linalg.norm(vehicle.rotors_from_pivot, axis=1) + disc_radius(vehicle)
    assert reach(vehicle) >= max(*discs, vehicle.l)
