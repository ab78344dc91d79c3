"""Rotor forces in closed form: mean, first moment and end are those of the exponentials."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from flypend.plants.lag import hold, hold_in_turn, join_ramps, step_timing

DURATIONS = {
    "one": [0.02],
    "a delay of one tick and a half": [1e-3] + [2e-3] * 11,
    "all different": [1e-3, 4e-3, 2e-3, 3e-3],
    "two groups": [3e-3, 3e-3, 1e-3, 1e-3],
}


def by_quadrature(rotors, commands, durations, lag):
    """Mean, 12 times the first moment about the middle, and end of the forces, by Gauss's rule in each interval."""
    nodes, weights = leggauss(20)
    whole, begin = sum(durations), 0.0
    mean, change, r = 0.0, 0.0, rotors
    for u, duration in zip(commands, durations, strict=True):
        t, w = (nodes + 1) / 2 * duration, weights / 2 * duration / whole
        decay = np.exp(-t / lag) if lag > 0 else np.zeros_like(t)
        force = u + (r - u) * decay[:, None]
        mean = mean + w @ force
        change = change + 12 * (w * ((begin + t) / whole - 0.5)) @ force
        r = u + (r - u) * (np.exp(-duration / lag) if lag > 0 else 0.0)
        begin += duration
    return mean, change, r


@pytest.mark.parametrize("lag", [0.0, 0.005, 0.02, 0.5])
@pytest.mark.parametrize("durations", DURATIONS.values(), ids=DURATIONS)
def test_several_commands_in_turn(durations, lag):
    rng = np.random.default_rng(1)
    rotors, commands = rng.uniform(0, 3, 4), rng.uniform(0, 3, (len(durations), 4))
    ramp, end = hold_in_turn(rotors, list(commands), durations, lag)
    mean, change, last = by_quadrature(rotors, commands, durations, lag)
    np.testing.assert_allclose(ramp.mean, mean, rtol=0, atol=1e-13)
    # Roundoff of the end, 1e-16 N, comes in 12 (T/H)² times, and T/H is 62 at most.
    np.testing.assert_allclose(ramp.change, change, rtol=0, atol=1e-10)
    np.testing.assert_allclose(end, last, rtol=0, atol=1e-14)


@pytest.mark.parametrize("lag", [0.0, 0.003, 0.02])
def test_one_command_is_the_case_of_one(lag):
    rng = np.random.default_rng(4)
    rotors, command = rng.uniform(0, 3, (2, 4))
    one, end = hold(rotors, command, step_timing(lag, 2e-3))
    turn, last = hold_in_turn(rotors, [command], [2e-3], lag)
    for a, b in zip((*one, end), (*turn, last), strict=True):
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-12)


def test_a_ramp_starts_and_ends_about_its_mean():
    ramp, _ = hold(np.array([0.0]), np.array([1.0]), step_timing(1.0, 1e-3))
    # Over a thousandth of the lag the force rises along its tangent, 1e-3, up to second order.
    assert ramp.start == pytest.approx(0.0, abs=1e-6)
    assert ramp.end == pytest.approx(1e-3, abs=1e-6)


def test_joined_ramps_are_those_of_commands_in_turn():
    rotors, one, other = np.array([1.0, 2.0]), np.array([3.0, 0.5]), np.array([0.0, 4.0])
    first, middle = hold(rotors, one, step_timing(0.03, 4e-3))
    second, end = hold(middle, other, step_timing(0.03, 11e-3))
    expected, last = hold_in_turn(rotors, [one, other], [4e-3, 11e-3], 0.03)
    joined = join_ramps(first, second, 4e-3, 11e-3)
    assert np.allclose(joined.mean, expected.mean, rtol=1e-12)
    assert np.allclose(joined.change, expected.change, rtol=1e-9)  # differences of the means, times 12 lags over a step
    assert np.allclose(end, last, rtol=1e-12)
