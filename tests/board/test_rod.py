"""The rod's observer: against rods that swing under a pivot that is shaken."""

import numpy as np
import pytest

from flypend import geometry
from flypend.board.tracking import track_rod
from flypend.compile.numeric import as_numpy
from flypend.plants.sensing import NOTHING

PERIOD, FRAMES, LENGTH = 1e-3, 10, 0.5
GRAVITY = np.array([0.0, 0.0, 9.81])


def swung(steps, seed=1, smaller=20):
    """Rod, rate and specific force at the pivot, by a fine integration of pivot and bob in the world."""
    rng = np.random.default_rng(seed)
    waves, phases = rng.normal(size=(3, 3)) * 6, rng.uniform(0, 6, (3, 3))
    y = geometry.random_sphere(rng)
    y_dot, h = np.cross(y, rng.normal(size=3) * 4), PERIOD / smaller
    found = []
    for i in range(steps * smaller):
        force = GRAVITY + (waves * np.sin(phases + np.array([3, 7, 11]) * i * h)).sum(axis=1)
        if i % smaller == 0:
            found.append((y, y_dot, force))
        # The bob falls, the pivot is pushed by its specific force, and the rod keeps their distance.
        apart = LENGTH * y + h * LENGTH * y_dot - h**2 * force
        tangent = apart / np.linalg.norm(apart)
        y_dot = geometry.tangent_part(tangent, (tangent - y) / h)
        y = tangent
    return [np.array(part) for part in zip(*found, strict=True)]


def followed(y, force, *, late=0, noise=0.0, frames=FRAMES):
    track, memory, rng = (
        as_numpy(track_rod(PERIOD)),
        np.array([0, 0, -1.0, 0, 0, 0, NOTHING]),
        np.random.default_rng(0),
    )
    found = []
    for i in range(len(y)):
        fresh = i % frames == 0 and i >= late
        told = 1.3 * (y[i - late] + noise * rng.normal(size=3)) if fresh else np.zeros(3)
        memory = np.asarray(track(memory, told, late * PERIOD if fresh else -1.0, force[max(i - 1, 0)], LENGTH)).ravel()
        found.append(memory)
    return np.array(found)


@pytest.mark.parametrize("late", [0, 15])
def test_it_finds_direction_and_rate_of_a_shaken_rod(late):
    y, y_dot, force = swung(1500)
    found = followed(y, force, late=late)[300:]
    assert np.abs(np.diff(y_dot, axis=0)).max() > 0.02  # in a period: a rate 10 ms old is off by 0.2
    assert np.linalg.norm(found[:, :3] - y[300:], axis=1).max() < 0.004
    assert np.linalg.norm(found[:, 3:6] - y_dot[300:], axis=1).max() < 0.15
    without = followed(y, 0 * force, late=late)[300:]
    assert np.linalg.norm(without[:, 3:6] - y_dot[300:], axis=1).max() > 0.5  # the accelerometer is what it needs


def test_it_stays_on_the_sphere_and_its_rate_in_the_tangent_plane():
    y, _, force = swung(400, seed=2)
    found = followed(y, force, noise=0.01)
    assert np.allclose(np.linalg.norm(found[:, :3], axis=1), 1, atol=1e-12)
    assert np.allclose((found[:, :3] * found[:, 3:6]).sum(axis=1), 0, atol=1e-12)


def test_noise_of_a_millimetre_leaves_a_rate_to_fly_with():
    y, y_dot, force = swung(1500, seed=3)
    found = followed(y, force, noise=0.002)[300:]
    assert np.sqrt(np.mean(np.sum((found[:, 3:6] - y_dot[300:]) ** 2, axis=1))) < 0.15


def test_it_begins_anew_after_a_gap():
    y, y_dot, force = swung(900, seed=4)
    track, memory = as_numpy(track_rod(PERIOD)), np.array([0, 0, -1.0, 0, 0, 0, NOTHING])
    for i in range(900):
        fresh = i % FRAMES == 0 and not 300 <= i < 600
        memory = np.asarray(track(memory, y[i], 0.0 if fresh else -1.0, force[max(i - 1, 0)], LENGTH)).ravel()
        if i == 600:
            assert np.allclose(memory[:3], y[i])
            assert np.allclose(memory[3:6], 0)
    assert np.linalg.norm(memory[3:6] - y_dot[-1]) < 0.15
