"""The adapters of the exported flight computer, compiled against stand-in headers and fed with converted numbers."""

import ctypes

import numpy as np
import pytest
from cbuild import STANDINS, build, run
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend import geometry as geo
from flypend.board.program import initial_memory
from flypend.export import records, vectors
from flypend.plants.loop import Loop
from flypend.plants.plant import Sampled

VEHICLE = fp.vehicle("hehn2011")
LAW = fp.laws.inverted().bind(VEHICLE)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return fp.export_c(LAW, VEHICLE, tmp_path_factory.mktemp("adapters"), check=False)


NOT_BEGUN = 8


def _struck(folder, adapter, board):
    """The adapter with its `board` damaged before the first step, as a file beside it."""
    source = (folder / "adapters" / adapter).read_text()
    place = source.index("flypend_board_step(")
    line = source.rindex("\n", 0, place) + 1
    flip = f"        {{ static int struck = 0; if (struck++ == 0) {{ {board}.memory[3] += 1; }} }}\n"
    (folder / "adapters" / f"struck_{adapter}").write_text(source[:line] + flip + source[line:])
    return f"adapters/struck_{adapter}"


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


def _commands(state, target, steps):
    """Rotor forces (steps, n) of Python's board that sees the same `state` in every period and hovers at `target`."""
    loop = Loop(VEHICLE, LAW, Sampled())
    path = np.zeros(records.PATH.length)
    path[:3] = target
    memory, commands = initial_memory(loop, np.full(4, VEHICLE.rotor_limits[0])), []
    for _ in range(steps):
        answer = vectors.board_step(loop)(memory, np.append(0.0, state.packed()), path, [], [])
        memory, command = (np.array(value).ravel() for value in answer)
        commands.append(command)
    return np.array(commands)


def _lines(text):
    return [np.array(line.split(), dtype=float) for line in text.splitlines()]


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


# Adapters -------------------------------------------------------------------------------------------------------

OK, NULL, NOT_FINITE, ROD = range(4)


def test_the_px4_module_sees_the_state_and_commands_the_rotors(folder):
    sources = ("flypend_law.c", "adapters/flypend_frames.c")
    objects = [f"{name.split('/')[-1]}.o" for name in sources]
    for name, target in zip(sources, objects, strict=True):
        build(folder, (name,), target, flags=("-c", "-I."))
    flags = ("-I.", "-Iadapters", f"-I{STANDINS / 'px4'}")
    sources = (*objects, "adapters/flypend_px4.cpp", STANDINS / "fly_px4.cpp")
    program = build(folder, sources, "fly_px4", "g++", flags)
    state, target = _states(1)[0], np.array([0.3, -0.2, 0.4])
    ned = state.flipped()
    flip = np.array([1.0, -1.0, -1.0])
    x, y, z, w = _quat_xyzw(ned.R)
    bob, bob_dot = _bob(ned)
    numbers = [*ned.x, *ned.x_dot, w, x, y, z, *ned.omega, *bob, *bob_dot, *(flip * target)]
    seen, path, first, same, second, late, invalid, unused = _lines(
        run([str(program)], given=" ".join(map(repr, map(float, numbers))))
    )
    assert np.allclose(seen, state.packed(), atol=2e-6)  # PX4 speaks single precision
    assert np.allclose(path, [*target, *[0.0] * 24], atol=1e-6)  # and open entries, NaN, count as 0
    least, largest = VEHICLE.rotor_limits
    motors = _commands(state, target, 2) / largest
    assert np.allclose(first, [*motors[0], OK, 5], atol=1e-4)
    assert np.array_equal(same, first)  # half a period later nothing is due
    assert np.allclose(second, [*motors[1], OK, 2005], atol=1e-4)
    assert late[4] == ROD  # a bob that is 0.2 s old is no bob
    assert np.ptp(late[:4]) > 1e-2
    assert invalid[4] == NOT_FINITE
    assert np.isnan(unused[0])
    assert np.all((late[:4] >= least / largest - 1e-6) & (late[:4] <= 1))


def test_an_adapter_with_a_damaged_board_levels_out_once_and_begins_again(folder):
    state, target = _states(12)[4], np.array([0.3, -0.2, 0.4])
    least, largest = VEHICLE.rotor_limits

    for name, place in (("flypend_law.c", "law.o"), ("adapters/flypend_frames.c", "frames.o")):
        build(folder, (name,), place, flags=("-c", "-I."))
    ned = state.flipped()
    x, y, z, w = _quat_xyzw(ned.R)
    ned_bob, ned_bob_dot = _bob(ned)
    numbers = [*ned.x, *ned.x_dot, w, x, y, z, *ned.omega, *ned_bob, *ned_bob_dot, *target]
    flags = ("-I.", "-Iadapters", f"-I{STANDINS / 'px4'}")
    sources = ("law.o", "frames.o", _struck(folder, "flypend_px4.cpp", "_board"), STANDINS / "fly_px4.cpp")
    program = build(folder, sources, "struck_px4", "g++", flags)
    _, _, first, _, second, *_ = _lines(run([str(program)], given=" ".join(map(repr, map(float, numbers)))))
    assert (first[4], second[4]) == (NOT_BEGUN, OK)
    assert np.all((first[:4] >= least / largest - 1e-6) & (first[:4] <= 1))
