"""How far a machine extends: boxes against points of its parts, and the box about a flight."""

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from flypend.model.outline import extent, outline, outline_parts

VEHICLE = fp.vehicle("hehn2011").replace(rod_end=0.7, pivot_offset=(0.0, 0.01, 0.02))
STATES = fp.random_starts(20, 3)


def rim(state, centre, radius, points=2001):
    """Points of the edge of a rotor disc in the world."""
    angle = np.linspace(0, 2 * np.pi, points)[:, None]
    around = radius * np.hstack([np.cos(angle), np.sin(angle), 0 * angle])
    return state.x + (centre + around) @ state.R.T


def test_the_box_of_a_disc_holds_its_rim_and_nothing_more():
    low, high = outline(STATES, VEHICLE)
    for i in range(len(STATES)):
        for k, centre in enumerate(VEHICLE.rotor_positions - VEHICLE.pivot_offset):
            edge = rim(STATES[i], centre, VEHICLE.body.disc_radius)
            # Between two of 2,000 points the rim bulges by 1e-6 of its radius.
            np.testing.assert_allclose(low[i, 2 + k], edge.min(axis=0), atol=1e-6)
            np.testing.assert_allclose(high[i, 2 + k], edge.max(axis=0), atol=1e-6)


def test_hub_and_rod_are_balls_about_the_pivot_and_the_far_end():
    low, high = outline(STATES, VEHICLE)
    np.testing.assert_allclose((low + high)[:, 0] / 2, STATES.x, atol=1e-12)
    np.testing.assert_allclose((low + high)[:, 1] / 2, STATES.x + 0.7 * STATES.y, atol=1e-12)
    np.testing.assert_allclose((high - low)[:, 0], 2 * VEHICLE.body.hub_radius)
    np.testing.assert_allclose((high - low)[:, 1], 2 * VEHICLE.body.rod_radius)


def test_without_a_body_the_parts_are_points():
    low, high = outline(STATES, VEHICLE.replace(body=None))
    np.testing.assert_array_equal(low, high)
    assert low.shape == (20, len(outline_parts(VEHICLE)), 3)


@pytest.mark.parametrize("make", [outline, extent])
def test_expressions_give_the_same(make):
    packed = ca.SX.sym("s", 24)
    function = ca.Function("corners", [packed], list(make(fp.State.symbolic(packed), VEHICLE)))
    for i in range(len(STATES)):
        for ours, theirs in zip(make(STATES[i], VEHICLE), function(STATES[i].packed()), strict=True):
            np.testing.assert_allclose(ours, np.array(theirs).reshape(ours.shape), atol=1e-14)
