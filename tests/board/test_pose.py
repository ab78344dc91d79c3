"""The observer of position, velocity and attitude: against motions whose derivatives are taken by differences."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from flypend.board.tracking import POSE, track_pose
from flypend.compile.numeric import as_numpy
from flypend.plants.sensing import NOTHING

PERIOD, FRAMES, GRAVITY = 1e-3, 10, 9.81
BIAS = np.array([0.01, -0.01, 0.005])  # rad/s


def moved(steps, seed=1, spin=12.0):
    """Position, velocity, attitude, gyroscope (n, 3) and the mean specific force of the period before, body axes."""
    rng = np.random.default_rng(seed)
    waves, phases, turns = rng.normal(size=(3, 3)) * 0.2, rng.uniform(0, 6, (3, 3)), rng.normal(size=(3, 3))
    speeds, h = np.array([3, 7, 11]), 1e-5

    def x(t):
        return (waves * np.sin(phases + speeds * t[:, None, None])).sum(axis=-1)

    def R(t):
        angles = (spin / 7 * turns * np.sin(phases + speeds * t[:, None, None])).sum(axis=-1)
        return Rotation.from_rotvec(angles).as_matrix()

    t = PERIOD * np.arange(steps)
    x_dot = (x(t + h) - x(t - h)) / (2 * h)
    gyro = Rotation.from_matrix(np.swapaxes(R(t - h), 1, 2) @ R(t + h)).as_rotvec() / (2 * h)
    a = np.diff(x_dot, axis=0, prepend=2 * x_dot[:1] - x_dot[1:2]) / PERIOD
    force = np.einsum("nji,nj->ni", R(t - PERIOD / 2), a + np.array([0, 0, GRAVITY]))
    return x(t), x_dot, R(t), gyro, force


def followed(motion, *, late=0, noise=0.0, turned=0.0, bias=0.0, seen=lambda i: True):
    """Memories (n, 19), with poses of so much noise (m, rad) that arrive `late` periods after they were taken."""
    x, _, R, gyro, force = motion
    track, memory = as_numpy(track_pose(PERIOD, GRAVITY)), np.zeros(POSE.length)
    memory[POSE.place("R")], memory[-1] = np.eye(3).ravel(), NOTHING
    rng, found = np.random.default_rng(0), []
    for i in range(len(x)):
        fresh = i % FRAMES == 0 and i >= late and seen(i)
        told = R[i - late] @ Rotation.from_rotvec(turned * rng.normal(size=3)).as_matrix()
        at = x[i - late] + noise * rng.normal(size=3)
        memory = track(memory, at, told.ravel(), late * PERIOD if fresh else -1.0, gyro[i] + bias, force[i])
        memory = np.asarray(memory).ravel()
        found.append(memory)
    return np.array(found)


def errors(found, motion, begin=600):
    """Largest errors of position (m), velocity (m/s) and attitude (rad) from the period `begin` on."""
    x, x_dot, R, *_ = motion
    turn = Rotation.from_matrix(np.swapaxes(found[:, 6:15].reshape(-1, 3, 3), 1, 2) @ R).magnitude()
    off = np.linalg.norm(found[:, :3] - x, axis=1), np.linalg.norm(found[:, 3:6] - x_dot, axis=1), turn
    return [values[begin:].max() for values in off]


@pytest.mark.parametrize(("late", "allowed"), [(0, (1e-5, 5e-4, 2e-4)), (10, (1e-3, 0.03, 0.02))])
def test_it_finds_position_velocity_and_attitude_in_fast_turns(late, allowed):
    motion = moved(1500)
    assert np.linalg.norm(motion[3], axis=1).max() > 10  # rad/s: an attitude 10 ms old is off by 0.1
    assert np.all(errors(followed(motion, late=late), motion) < np.array(allowed))


def test_the_imu_is_what_it_needs():
    x, x_dot, R, gyro, force = moved(1500)
    blind = followed((x, x_dot, R, 0 * gyro, 0 * force + R.transpose(0, 2, 1) @ [0, 0, GRAVITY]))
    assert errors(blind, (x, x_dot, R))[1] > 0.3
    assert errors(blind, (x, x_dot, R))[2] > 0.3


def test_noise_of_motion_capture_and_a_gyroscopes_bias_leave_a_state_to_fly_with():
    motion = moved(2000, seed=2)
    off = errors(followed(motion, noise=3e-4, turned=np.radians(0.5), bias=BIAS), motion)
    assert np.all(off < np.array((1e-3, 0.03, np.radians(0.8))))


def test_its_attitude_stays_a_rotation():
    R = followed(moved(1000, seed=3), turned=0.02)[:, 6:15].reshape(-1, 3, 3)
    assert np.allclose(np.swapaxes(R, 1, 2) @ R, np.eye(3), atol=1e-6)


def test_it_begins_anew_after_a_gap_and_from_an_attitude_far_off():
    motion = moved(1500, seed=4)
    found = followed(motion, seen=lambda i: not 300 <= i < 600)
    assert np.allclose(found[600, :3], motion[0][600])
    assert np.allclose(found[600, 3:6], 0)
    assert found[599, -1] == pytest.approx(0.309)
    assert np.all(errors(found, motion, 1300) < np.array((1e-4, 5e-3, 2e-4)))
    track, memory = as_numpy(track_pose(PERIOD, GRAVITY)), found[-1].copy()
    memory[6:15] = (motion[2][-1] @ Rotation.from_rotvec([0, 0, 3.1]).as_matrix()).ravel()
    after = np.asarray(track(memory, motion[0][-1], motion[2][-1].ravel(), 0.0, np.zeros(3), np.zeros(3))).ravel()
    assert np.allclose(after[6:15], motion[2][-1].ravel(), atol=1e-9)
