"""Frames, units and time of the exported adapters, against Python's conversions."""

import ctypes

import numpy as np
import pytest
from cbuild import build
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend import geometry as geo

VEHICLE = fp.vehicle("hehn2011")
LAW = fp.laws.inverted().bind(VEHICLE)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return fp.export_c(LAW, VEHICLE, tmp_path_factory.mktemp("adapters"), check=False)


@pytest.fixture(scope="module")
def frames(folder):
    sources = ("adapters/flypend_frames.c",)
    return ctypes.CDLL(str(build(folder, sources, "frames.so", flags=("-shared", "-fPIC", "-I."))))


def _pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def _states(count=20, seed=3):
    rng = np.random.default_rng(seed)
    start = fp.State.random(rng, count)
    return fp.State(x=rng.uniform(-2, 2, (count, 3)), x_dot=start.x_dot, R=start.R, omega=start.omega, y=start.y, y_dot=start.y_dot)  # fmt: skip  # noqa: E501


def _bob(state):
    return state.x + VEHICLE.l * state.y, state.x_dot + VEHICLE.l * state.y_dot


def _quat_xyzw(R):
    return Rotation.from_matrix(R).as_quat()


# Frames and units -----------------------------------------------------------------------------------------------


def test_quaternions_degrees_and_rods_are_those_of_python(frames):
    frames.flypend_radians.restype = ctypes.c_double
    assert frames.flypend_radians(ctypes.c_double(-90.0)) == pytest.approx(-np.pi / 2, rel=1e-15)
    states, R, y, y_dot = _states(), np.empty(9), np.empty(3), np.empty(3)
    for state in states:
        x, y_, z, w = 1.7 * _quat_xyzw(state.R)  # of any length
        frames.flypend_rotation_of_wxyz(*(ctypes.c_double(value) for value in (w, x, y_, z)), _pointer(R))
        assert np.allclose(R.reshape(3, 3), geo.rotation_from_quat_xyzw([x, y_, z, w]), atol=1e-14)
        assert np.allclose(R.reshape(3, 3), state.R, atol=1e-14)
        inputs = [np.array(value) for value in (state.x, state.x_dot, *_bob(state))]
        frames.flypend_rod(*map(_pointer, inputs), _pointer(y), _pointer(y_dot))
        assert np.allclose(y, state.y, atol=1e-14)
        assert np.allclose(y_dot, state.y_dot, atol=1e-13)


def test_a_bob_at_the_pivot_and_no_quaternion_give_zeros_that_the_law_refuses(frames):
    zero, y, y_dot, R = np.zeros(3), np.ones(3), np.ones(3), np.ones(9)
    frames.flypend_rod(*[_pointer(zero)] * 4, _pointer(y), _pointer(y_dot))
    frames.flypend_rotation_of_wxyz(*[ctypes.c_double(0)] * 4, _pointer(R))
    assert not np.any([*y, *y_dot, *R])
    frames.flypend_rotation_of_wxyz(*map(ctypes.c_double, (0, 1e200, 0, 0)), _pointer(R))  # upside down, not upright
    assert not np.any(R)


def test_what_goes_along_the_rod_is_dropped(frames):
    state, y, y_dot = _states(1)[0], np.empty(3), np.empty(3)
    bob, bob_dot = _bob(state)
    inputs = [np.array(v) for v in (state.x, state.x_dot, bob, bob_dot + 0.7 * state.y)]
    frames.flypend_rod(*map(_pointer, inputs), _pointer(y), _pointer(y_dot))
    assert np.allclose(y_dot, state.y_dot, atol=1e-13)


def test_north_east_down_is_the_flipped_state_of_python(frames):
    for state in _states(5):
        other, R = state.flipped(), np.empty(9)
        for name in ("x", "x_dot", "omega", "y", "y_dot"):
            to = np.array(getattr(other, name))
            frames.flypend_flip(_pointer(to), _pointer(to))
            assert np.allclose(to, getattr(state, name), rtol=0, atol=1e-15)
        frames.flypend_flip_rotation(_pointer(np.ascontiguousarray(other.R)), _pointer(R))
        assert np.allclose(R.reshape(3, 3), state.R, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("times", "periods"),
    [
        ((1000, 2000, 3000, 4000), (1, 0, 1, 0)),  # twice as fast as 500 Hz
        ((1000, 2900, 5100, 7000), (1, 1, 1, 1)),  # jitter
        ((1000, 3000, 9000, 11000), (1, 1, 3, 1)),  # two periods were missed
        ((1000, 900000, 902000), (1, 50, 1)),  # no more than 50 are made up for
        ((900000, 1000, 3000), (1, 50, 1)),  # a clock that was set back
    ],
)
def test_time_is_kept_in_periods(frames, times, periods):
    due = ctypes.c_uint64(0)
    assert tuple(frames.flypend_due(ctypes.c_uint64(now), ctypes.byref(due)) for now in times) == periods
