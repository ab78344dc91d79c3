"""The drawing of a machine: its gaps, and what is on it."""

import numpy as np
import pytest

import flypend as fp
from flypend.model.by_name import vehicle_names
from flypend.pictures.machine import gaps, machine_figure


@pytest.mark.parametrize("name", vehicle_names())
def test_gaps_lie_between_the_arms_and_are_as_wide_as_the_discs_leave(name):
    """With arms of one length L, a level rod has 180°/n − arcsin((r + rod)/L) to either side of a bisector."""
    vehicle = fp.vehicle(name)
    centres, body = vehicle.rotors_from_pivot, vehicle.body
    arms = np.sort(np.arctan2(centres[:, 1], centres[:, 0]) % (2 * np.pi))
    between = (arms + np.diff([*arms, arms[0] + 2 * np.pi]) / 2) % (2 * np.pi)
    half = np.pi / len(arms) - np.arcsin((body.disc_radius + body.rod_radius) / np.linalg.norm(centres[0]))
    found = np.array(gaps(vehicle))
    middle = found.mean(axis=1) % (2 * np.pi)
    assert np.allclose(np.sort(middle), np.sort(between), atol=np.radians(0.5))
    width = np.diff(found)
    assert np.all((2 * half - np.radians(1.0) < width) & (width <= 2 * half))  # bearings inside, half a degree apart


def test_discs_without_room_between_them_leave_no_gap():
    wide = fp.vehicle("hehn2011").replace(body={"disc_radius": 0.13})
    assert gaps(wide) == []
    assert "no gap" in machine_figure(wide).axes[0].get_xlabel()


def test_front_is_up_and_left_is_left():
    """hehn2011's first rotor is in front, its second on the right."""
    axes = machine_figure(fp.vehicle("hehn2011")).axes[0]
    at = {text.get_text().split()[0]: text.get_position() for text in axes.texts if text.get_text()[0].isdigit()}
    assert at["1"][1] > 0.1
    assert at["2"][0] > 0.1


def test_a_vehicle_without_a_body_is_refused():
    with pytest.raises(fp.InputError, match="disc_radius"):
        machine_figure(fp.vehicle("hehn2011").replace(body=None))
