"""Guesses that lean in windows: their rods move as the equations want it while the lean is small."""

import numpy as np
import pytest

import flypend as fp
from flypend.planning.constraints import Constraints
from flypend.planning.guess import WAYS, lean_guess, leans
from flypend.planning.problem import request
from flypend.planning.search import stages_of

HEHN = fp.vehicle("hehn2011")
START = fp.State(x=(-1.5, 0.1, 0.2), y=(0.1, 0, np.sqrt(0.99)), omega=(1, 0, 0))
LOW = fp.Window(centre=(0, 0.1, 0.2), width=0.7, height=0.4, normal=(1, 0.3, 0))
SIDEWAYS = 4


def asked(window=LOW, lean=1.0):
    return request(HEHN, START, "effort", np.array([1.5, 0, 0]), kept=Constraints(lean=lean, window=window))


@pytest.mark.parametrize("style", [2, SIDEWAYS, 7])
def test_it_passes_the_middle_of_the_window_leaning_as_wanted_at_its_speed(style):
    wish, (stages, h) = asked(), stages_of(12.5)
    states, commands = lean_guess(wish, style, stages, h)
    unit = wish.units.length
    inside = LOW.inside(states[:, :3] * unit + wish.target)
    k = int(np.argmin(np.linalg.norm(inside[:, ::2], axis=1)))
    # One stage's way at this speed is the resolution.
    along, across, speed = WAYS[0, style]
    assert np.linalg.norm(inside[k, ::2]) < speed * h * unit
    rod, velocity = LOW.axes @ states[k, 18:21], LOW.axes @ states[k, 3:6]
    np.testing.assert_allclose(rod[[0, 2]], np.sin(np.hypot(along, across)) * np.sign([along, across]), atol=0.1)
    assert velocity[2] == pytest.approx(speed, rel=0.1)
    np.testing.assert_array_equal(states[0], wish.start)
    np.testing.assert_allclose(states[-1, :3], 0, atol=0.02)
    low, high = HEHN.rotor_limits / wish.units.force
    assert low <= np.min(commands) <= np.max(commands) <= high


def left_of_the_equation(finer):
    """What λ̈ = λ − ẍ, in own units, leaves of λ̈ by differences, as a share, with stages so many times shorter."""
    stages, h = stages_of(12.5)
    states, _ = lean_guess(asked(lean=1.5), SIDEWAYS, finer * stages, h / finer)
    angle, first = np.arccos(states[:, 20]), slice(5 * finer, -5 * finer)  # the first state is the start
    assert 0.5 < np.max(angle) < 1.4  # beyond 0.95 of the limit it is cut
    lean = states[:, 18:20] * (angle / np.maximum(np.sin(angle), 1e-9))[:, None]

    def twice(values):
        return np.gradient(np.gradient(values, h / finer, axis=0), h / finer, axis=0)[first]

    return np.linalg.norm(twice(lean) - lean[first] + twice(states[:, :2])) / np.linalg.norm(twice(lean))


def test_the_lean_moves_the_pivot_by_the_equation_of_a_rod_that_leans_a_little():
    """The second derivative of a bump jumps at its ends, so differences converge with the first order."""
    once, finer = left_of_the_equation(1), left_of_the_equation(2)
    assert once < 0.12
    assert finer < 0.6 * once


def test_only_where_the_lean_is_limited_and_a_wall_stands():
    hatch = fp.Window(centre=(0, 0, 0), width=0.7, height=0.7, normal=(1e-3, 0, 1), up=(1, 0, 0))
    assert leans(asked(), SIDEWAYS)
    assert not leans(asked(), 0)  # an upright style
    assert not leans(asked(lean=None), SIDEWAYS)
    assert not leans(asked(window=None), SIDEWAYS)
    above, below = fp.State(x=(0, 0, -1), y=(0, 0, 1)), np.array([0, 0, 1.0])
    assert not leans(request(HEHN, above, "effort", below, kept=Constraints(lean=1.0, window=hatch)), SIDEWAYS)
