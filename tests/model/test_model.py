"""State, Wrench and Vehicle: what they refuse, what they keep, and the same physics seen from either frame."""

import dataclasses
import re

import casadi as ca
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend import geometry as geo
from flypend.model import equations_of_motion, total_energy
from flypend.model.by_name import vehicle_names
from flypend.model.state import SHAPES, convert_packed, project, split

EPS = 1e-15
property_test = settings(max_examples=50, deadline=None, derandomize=True)

TURN = Rotation.from_euler("zyx", [0.3, -1.1, 2.0]).as_matrix()


def refused(field, **wanted):
    """Context that expects an InputError in one line `field: expected ..., got ...`."""
    expected, got = wanted.get("expected", ""), wanted.get("got", "")
    line = rf"^{re.escape(field)}: expected .*{re.escape(expected)}.*, got .*{re.escape(got)}.*$"
    return pytest.raises(fp.InputError, match=re.compile(line))  # no DOTALL: one line only


# State: what is refused ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SHAPES)
def test_a_field_of_the_wrong_shape_is_refused(name):
    good = {"y": (0, 0, 1)}
    for shape in ((2,), (4,), (), (3, 2), (4, 3, 4)):
        with refused(name, expected=str(SHAPES[name]).replace("(3,)", "(3)"), got=f"shape {shape}"):
            fp.State(**{**good, name: np.ones(shape)})
    with refused(name, expected="numbers", got="'up'"):
        fp.State(**{**good, name: "up"})
    with refused(name, expected="numbers"):
        fp.State(**{**good, name: [[1, 2], [3]]})
    with refused(name, expected="numbers"):
        fp.State(**{**good, name: None})


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_number_that_is_not_finite_is_refused(name, bad):
    value = np.array(np.eye(3) if name == "R" else [0.0, 0.0, 1.0])
    value[..., 0] = bad
    count = 3 if name == "R" else 1
    with refused(name, expected="finite numbers", got=f"{count} that are NaN or infinite"):
        fp.State(**{"y": (0, 0, 1), name: value})


def test_a_matrix_that_is_not_a_rotation_is_refused_with_the_amount():
    with refused("R", expected="a rotation (RᵀR = 1, det R = 1)", got="‖RᵀR − 1‖ = 0.364"):  # √3 (1.1² − 1)
        fp.State(R=1.1 * np.eye(3), y=(0, 0, 1))
    with refused("R", got="determinant < 0"):
        fp.State(R=np.diag([1, 1, -1]), y=(0, 0, 1))
    batch = np.stack([np.eye(3), TURN, 1.1 * TURN])
    with refused("R", got="‖RᵀR − 1‖ = 0.364"):
        fp.State(R=batch, y=(0, 0, 1))


def test_a_direction_that_is_not_a_unit_vector_is_refused_with_its_length():
    with refused("y", expected="a unit vector", got="|y| = 2"):
        fp.State(y=(0, 0, 2))
    with refused("y", got="|y| = 0"):
        fp.State(y=(0, 0, 0))
    with refused("y", got="|y| = 0.5"):
        fp.State(y=[[0, 0, 1], [0, 0, 1.2], [0, 0.5, 0]])


def test_experiment_2_as_printed_is_refused():
    root = 1 / np.sqrt(2)
    with refused("y_dot", expected="a tangent vector (y · y_dot = 0)", got="y · y_dot = 0.99"):
        fp.State(y=(root, 0, root), y_dot=(0.7, 0, 0.7))
    assert fp.State(y=(root, 0, root), y_dot=(0.7, 0, -0.7)).y_dot[2] == -0.7


def test_batches_of_different_length_are_refused():
    with refused("state", expected="the same batch axes", got="'x': (2,)"):
        fp.State(x=np.zeros((2, 3)), y=np.tile([0, 0, 1.0], (3, 1)))


@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_the_tolerance_of_the_manifold_is_where_it_is_said_to_be(factor):
    off = factor * 1e-4  # the documented tolerance
    for fields in (
        {"y": (0, 0, 1 + off)},
        {"y": (0, 0, 1 - off)},
        {"y": (0, 0, 1), "y_dot": (1, 0, 2 * off)},  # measured against 1 + |y_dot|
        {"y": (0, 0, 1), "R": np.diag([1, 1, np.sqrt(1 + 3 * off)])},  # of RᵀR − 1, nine entries: three times
    ):
        if factor > 1:
            with pytest.raises(fp.InputError):
                fp.State(**fields)
        else:
            _on_the_manifold(fp.State(**fields))


# State: what is kept ---------------------------------------------------------------------------------------------


def _on_the_manifold(state):
    assert np.max(geo.rotation_defect(state.R), initial=0) < 20 * EPS  # the SVD of a 3 × 3 matrix: some tens of eps
    assert np.max(np.abs(geo.norm(state.y) - 1), initial=0) < 2 * EPS
    assert np.max(np.abs(geo.dot(state.y, state.y_dot)), initial=0) < 10 * EPS


def test_input_rounded_to_four_decimals_is_projected():
    exact = fp.State.random(np.random.default_rng(0), 2000)
    rounded = {name: np.round(getattr(exact, name), 4) for name in SHAPES}
    state = fp.State(**rounded)
    _on_the_manifold(state)
    for name in SHAPES:  # the projection moves no more than rounding did: half a unit of the fourth decimal, thrice
        np.testing.assert_allclose(getattr(state, name), rounded[name], rtol=0, atol=3e-4)
    assert np.any(state.y != rounded["y"])


def test_exact_input_is_kept_and_cannot_be_written():
    x = np.array([1.0, 2.0, 3.0])
    state = fp.State(x=x, y=(0, 0, -1))
    x[0] = 7
    np.testing.assert_array_equal(state.x, [1, 2, 3])
    np.testing.assert_array_equal(state.R, np.eye(3))
    np.testing.assert_array_equal(state.z, [0, 0, 1])
    with pytest.raises(ValueError, match="read-only"):
        state.y[0] = 1
    with pytest.raises(AttributeError):
        state.y = (0, 0, 1)


@pytest.mark.parametrize("size", [(), (5,), (2, 3), (0,)])
def test_packed_and_back(size):
    state = fp.State.random(np.random.default_rng(2), size)
    packed = state.packed()
    assert packed.shape == (*size, 24)
    again = fp.State.from_packed(packed)
    np.testing.assert_allclose(again.packed(), packed, rtol=0, atol=10 * EPS)  # projected once more
    for name, value in split(packed).items():
        np.testing.assert_array_equal(value, getattr(state, name))
    with refused("packed state", expected="(24)", got="(23,)"):
        fp.State.from_packed(np.zeros(23))


def test_order_of_the_packed_state():
    state = fp.State(x=(1, 2, 3), x_dot=(4, 5, 6), R=TURN, omega=(7, 8, 9), y=(0, 0, 1), y_dot=(10, 11, 0))
    expected = [1, 2, 3, 4, 5, 6, *TURN[0], *TURN[1], *TURN[2], 7, 8, 9, 0, 0, 1, 10, 11, 0]
    np.testing.assert_allclose(state.packed(), expected, rtol=0, atol=4 * EPS)
    s = ca.SX.sym("s", 24)
    symbolic = fp.State.symbolic(s)
    got = ca.Function("f", [s], [symbolic.packed(), symbolic.R, symbolic.z])(expected)
    np.testing.assert_array_equal(got[0].full().ravel(), expected)
    np.testing.assert_array_equal(got[1].full(), TURN)
    np.testing.assert_array_equal(got[2].full().ravel(), TURN[:, 2])


@pytest.mark.parametrize("name", SHAPES)
def test_numbers_beside_an_expression_are_the_same_state(name):
    state = fp.State.random(np.random.default_rng(0))
    s = ca.SX.sym("s", *SHAPES[name])
    mixed = fp.State(**(vars(state) | {name: s}))
    got = ca.Function("f", [s], [mixed.packed(), mixed.z])(getattr(state, name))
    assert np.array_equal(np.array(got[0]).ravel(), state.packed())
    assert np.array_equal(np.array(got[1]).ravel(), state.z)
    with refused("x", expected="(3)"):
        fp.State(x=(0, 0), y=ca.SX.sym("y", 3))


def test_a_batch_has_members():
    batch = fp.State.random(np.random.default_rng(3), (4, 2))
    assert len(batch) == 4
    assert batch[1].batch_shape == (2,)
    assert batch[:, 0].batch_shape == (4,)
    np.testing.assert_allclose(batch[2, 1].packed(), batch.packed()[2, 1], rtol=0, atol=10 * EPS)
    assert [member.batch_shape for member in batch] == [(2,)] * 4
    single = batch[0, 0]
    with pytest.raises(IndexError, match="single state"):
        single[0]
    with pytest.raises(TypeError, match="single state"):
        len(single)


def test_one_field_may_carry_the_batch_for_all():
    state = fp.State(y=np.tile([0, 0, 1.0], (5, 1)), x=(1, 2, 3))
    assert state.batch_shape == (5,)
    np.testing.assert_array_equal(state.x, np.tile([1, 2, 3], (5, 1)))
    assert state.R.shape == (5, 3, 3)


def test_random_states_are_uniform_bounded_and_repeatable():
    count, radii = 4000, {"max_omega": 1.5, "max_y_dot": 2.5, "max_x_dot": 0.5}
    state = fp.State.random(np.random.default_rng(4), count, **radii)
    _on_the_manifold(state)
    again = fp.State.random(np.random.default_rng(4), (count,), **radii)
    np.testing.assert_array_equal(state.packed(), again.packed())
    np.testing.assert_array_equal(state.x, np.zeros((count, 3)))
    for value, radius, dimension in ((state.omega, 1.5, 3), (state.y_dot, 2.5, 2), (state.x_dot, 0.5, 3)):
        fill = (geo.norm(value) / radius) ** dimension  # uniform on 0 .. 1 in a ball of that dimension
        assert fill.max() <= 1 + 1e-14
        assert abs(fill.mean() - 0.5) < 6 * np.sqrt(1 / 12 / count)  # six standard deviations
        assert np.max(np.abs(value.mean(0))) < 6 * radius / np.sqrt(3 * count)


@property_test
@given(arrays(float, 24, elements=st.floats(-2, 2, allow_subnormal=False)))
def test_projection_of_a_packed_state_is_idempotent_and_tells_the_drift(packed):
    assume(np.linalg.norm(packed[18:21]) > 0.1)
    # Two equal singular values with negative determinant have no nearest rotation.
    assume(np.min(np.abs(np.diff(np.linalg.svd(packed[6:15].reshape(3, 3))[1]))) > 1e-3)
    projected, drift = project(packed)
    again, none = project(projected)
    np.testing.assert_allclose(again, projected, rtol=0, atol=1e-13)  # amplified by 1/|y| < 10
    assert np.max(none) < 1e-13
    y, y_dot = packed[18:21], packed[21:24]
    assert drift[0] == pytest.approx(abs(np.linalg.norm(y) - 1), abs=1e-14)
    assert drift[1] == pytest.approx(abs(y @ y_dot), abs=1e-14)
    assert drift[2] == geo.rotation_defect(packed[6:15].reshape(3, 3))
    untouched = [*range(6), *range(15, 18)]
    np.testing.assert_array_equal(projected[untouched], packed[untouched])


# Frames ----------------------------------------------------------------------------------------------------------

F = np.diag([1.0, -1.0, -1.0])


def test_flipped_twice_is_the_same():
    state = fp.State.random(np.random.default_rng(5), (6,))
    np.testing.assert_allclose(state.flipped().flipped().packed(), state.packed(), rtol=0, atol=10 * EPS)
    wrench = fp.Wrench(np.array([1.0, -2.0]), np.array([[1.0, 2, 3], [4, 5, 6]]))
    again = wrench.flipped().flipped()
    np.testing.assert_array_equal(again.thrust, wrench.thrust)
    np.testing.assert_array_equal(again.moment, wrench.moment)


def test_flipping_turns_the_inverted_pose_of_one_frame_into_that_of_the_other():
    up = fp.State(x=(1, 2, 3), omega=(1, 2, 3), y=(0, 0, 1), R=Rotation.from_euler("z", 0.3).as_matrix())
    down = up.flipped()
    np.testing.assert_array_equal(down.y, [0, 0, -1])
    np.testing.assert_array_equal(down.x, [1, -2, -3])
    np.testing.assert_array_equal(down.omega, [1, -2, -3])
    np.testing.assert_allclose(down.z, [0, 0, 1], rtol=0, atol=EPS)  # f z: the thrust changes sign instead
    assert fp.Wrench(5.0, np.array([1.0, 2, 3])).flipped().thrust == -5


def _rates_of_the_flipped(vehicle, seed, e3):
    rng = np.random.default_rng(seed)
    state, wrench = fp.State.random(rng, (20,)), fp.Wrench(rng.uniform(-9, 9, 20), rng.standard_normal((20, 3)))
    other = {"up": "down", "down": "up"}[e3]
    here = equations_of_motion(state, wrench, vehicle, e3)
    there = equations_of_motion(state.flipped(), wrench.flipped(), vehicle, other)
    return here, there


@pytest.mark.parametrize("e3", ["up", "down"])
@pytest.mark.parametrize("name", vehicle_names())
def test_flipping_commutes_with_the_equations_of_motion(name, e3):
    here, there = _rates_of_the_flipped(fp.vehicle(name), 6, e3)
    for field in ("x_dot", "x_ddot", "omega_dot", "y_dot", "y_ddot"):
        turned = getattr(here, field) @ F
        size = np.max(np.abs(turned))  # omega_dot of hehn2011 reaches 1000 rad/s²
        np.testing.assert_allclose(getattr(there, field), turned, rtol=0, atol=20 * EPS * size)
    np.testing.assert_allclose(there.R_dot, F @ here.R_dot @ F, rtol=0, atol=1e-14)


def test_flipping_commutes_for_an_inertia_with_products():
    inertia = [[0.08, 0.01, 0.005], [0.01, 0.09, 0.0], [0.005, 0.0, 0.13]]
    here, there = _rates_of_the_flipped(fp.vehicle("nayak2018").replace(inertia=inertia), 6, "up")
    np.testing.assert_allclose(there.omega_dot, here.omega_dot @ F, rtol=0, atol=1e-12)


def test_energy_does_not_depend_on_the_frame():
    vehicle, state = fp.vehicle("hehn2011"), fp.State.random(np.random.default_rng(7), (20,))
    here, there = total_energy(state, vehicle, "up"), total_energy(state.flipped(), vehicle, "down")
    np.testing.assert_allclose(here, there, rtol=0, atol=1e-14)


# Vehicle ---------------------------------------------------------------------------------------------------------

GOOD = fp.vehicle("hehn2011").to_dict()
GOOD_UNITS = {
    "mass": "kg",
    "bob_mass": "kg",
    "rod_length": ", m",
    "inertia": "kg m²",
    "rotor_limits": "; N",
    "drag_ratio": "; m",
}


@pytest.mark.parametrize("field", ["mass", "bob_mass", "rod_length", "drag_ratio"])
@pytest.mark.parametrize("bad", [0, -1, np.nan, np.inf, "1", True, None, [1, 2]])
def test_a_quantity_must_be_a_positive_number(field, bad):
    with refused(f"vehicle.{field}", expected="a finite number > 0", got=""):
        fp.Vehicle.from_dict({**GOOD, field: bad})


@pytest.mark.parametrize("field", ["gravity", "rotor_lag"])
def test_gravity_and_lag_may_vanish_but_not_be_negative(field):
    assert getattr(fp.Vehicle(**{**GOOD, field: 0}), field) == 0
    for bad in (-1e-9, np.nan, "0"):
        with refused(field, expected="a finite number >= 0"):
            fp.Vehicle(**{**GOOD, field: bad})


@pytest.mark.parametrize(
    ("inertia", "expected", "got"),
    [
        ([1, 1, -1], "positive definite", "a principal moment of -1 kg m²"),
        ([1, 1, 0], "positive definite", "a principal moment of 0 kg m²"),
        ([[1, 2, 0], [2, 1, 0], [0, 0, 1]], "positive definite", "a principal moment of -1 kg m²"),
        ([[1, 0.1, 0], [0, 1, 0], [0, 0, 1]], "symmetric", "[[1.0, 0.1, 0.0]"),
        ([1, 1, 2.1], "triangle inequality", "1 + 1 < 2.1"),
        ([1, 1], "shape (3)", "shape (2,)"),
        ([[1, 0, 0], [0, 1, 0]], "shape (3, 3)", "shape (2, 3)"),
        ([[[1, 0, 0], [0, 1, 0], [0, 0, 1]]], "shape (3, 3)", "shape (1, 3, 3)"),
        ([[1, 0, 0], [0, 1], [0, 0, 1]], "numbers", ""),
        ([1, np.nan, 1], "finite", "1 that are NaN"),
        (1.0, "shape (3, 3)", "shape ()"),
        ("round", "numbers", "'round'"),
    ],
)
def test_an_impossible_inertia_is_refused(inertia, expected, got):
    with refused("inertia", expected=expected, got=got):
        fp.Vehicle(**{**GOOD, "inertia": inertia})


def test_a_flat_body_is_at_the_bound_of_the_triangle_inequality():
    assert fp.Vehicle(**{**GOOD, "inertia": [0.01, 0.01, 0.02]}).I[2, 2] == 0.02


@pytest.mark.parametrize(
    ("field", "value", "expected", "got"),
    [
        ("rotor_spins", [1, 1, 1, 1], "rotors that produce every thrust and moment", "rank 3"),
        ("rotor_spins", [1, -1, 2, -1], "each +1 or -1", "2.0"),
        ("rotor_spins", [1, -1, 1], "shape (4)", "shape (3,)"),
        ("rotor_positions", [[1, 0, 0], [0, -1, 0], [-1, 0, 0]], "shape (3)", "shape (4,)"),
        ("rotor_positions", [[1, 0, 0], [2, 0, 0], [-1, 0, 0], [-2, 0, 0]], "every thrust and moment", "rank"),
        ("rotor_positions", [[1, 0], [0, 1], [-1, 0], [0, -1]], "shape (n, 3)", "shape (4, 2)"),
        ("rotor_limits", [1, 1], "0 <= least < largest", "[1.0, 1.0]"),
        ("rotor_limits", [-0.1, 1], "0 <= least < largest", "[-0.1, 1.0]"),
        ("rotor_limits", [2, 1], "0 <= least < largest", "[2.0, 1.0]"),
        ("rotor_limits", [1], "shape (2)", "shape (1,)"),
        ("rotor_limits", [0, np.inf], "finite", "1 that are NaN or infinite"),
    ],
)
def test_impossible_rotors_are_refused(field, value, expected, got):
    with pytest.raises(fp.InputError) as caught:
        fp.Vehicle(**{**GOOD, field: value})
    message = str(caught.value)
    assert re.fullmatch(r"rotor_(positions|spins|limits): expected .+, got .+", message)
    assert expected in message
    assert got in message


@pytest.mark.parametrize(
    "fields",
    [
        {"rotor_limits": np.ones((5, 2))},
        {"rotor_spins": np.ones((5, 4))},
        {"rotor_positions": np.zeros((1, 4, 3)), "rotor_spins": [1]},
    ],
)
def test_extra_axes_of_rotor_data_are_refused(fields):
    with pytest.raises(
        fp.InputError, match=r"^rotor_(positions|spins|limits): expected numbers of shape .*, got shape"
    ):
        fp.Vehicle(**{**GOOD, **fields})


def test_an_unknown_key_is_refused_with_the_nearest_name():
    with refused("vehicle.bob_mas", expected="one of name, mass, bob_mass", got="'bob_mas' (did you mean 'bob_mass'?)"):
        fp.Vehicle.from_dict({**GOOD, "bob_mas": 1})
    with refused("vehicle.rotor_spin", got="did you mean 'rotor_spins'?"):
        fp.vehicle("hehn2011").replace(rotor_spin=[1, -1, 1, -1])
    names = f"one of {', '.join(vehicle_names())}"
    with refused("vehicle", expected=names, got="'hehn2012' (did you mean 'hehn2011'?)"):
        fp.vehicle("hehn2012")
    with refused("vehicle", got="'zzz'") as caught:
        fp.vehicle("zzz")
    assert "did you mean" not in str(caught.value)


@pytest.mark.parametrize("field", [e.name for e in dataclasses.fields(fp.Vehicle) if e.default is dataclasses.MISSING])
def test_a_missing_key_is_named(field):
    with refused(f"vehicle.{field}", expected=GOOD_UNITS.get(field, ""), got="nothing"):
        fp.Vehicle.from_dict({k: v for k, v in GOOD.items() if k != field})


def test_replace_checks_again_and_leaves_the_original():
    vehicle = fp.vehicle("hehn2011")
    assert vehicle.replace(mass=2.0).M == 2.0
    assert vehicle.M == 0.5
    with refused("mass", got="-2"):
        vehicle.replace(mass=-2)


def test_letters_are_the_words():
    vehicle = fp.vehicle("nayak2018")
    assert (vehicle.M, vehicle.m, vehicle.l, vehicle.g) == (0.4, 0.1, 0.5, 9.81)
    np.testing.assert_array_equal(vehicle.I, np.diag([0.0820, 0.0845, 0.1377]))  # the paper's section IV
    np.testing.assert_allclose(vehicle.I_inv @ vehicle.I, np.eye(3), rtol=0, atol=EPS)
    assert vehicle.weight == pytest.approx(0.5 * 9.81, rel=EPS)
    with pytest.raises(ValueError, match="read-only"):
        vehicle.inertia[0, 0] = 1


# Rotors ----------------------------------------------------------------------------------------------------------


def _wrench_of_rotors(vehicle, forces):
    """Thrust and moment about the centre of mass, rotor by rotor: r × F and the reaction torque about the up axis."""
    up = np.array([0, 0, 1.0])
    moment = np.zeros(3)
    for position, spin, force in zip(vehicle.rotor_positions, vehicle.rotor_spins, forces, strict=True):
        moment += np.cross(position, force * up) + spin * vehicle.drag_ratio * force * up
    return np.array([np.sum(forces), *moment])


def _hexarotor():
    angles = np.pi / 3 * np.arange(6) + 0.2
    positions = np.stack([0.2 * np.cos(angles), 0.2 * np.sin(angles), np.full(6, 0.03)], axis=-1)
    return fp.vehicle("hehn2011").replace(rotor_positions=positions, rotor_spins=[1, -1] * 3)


@pytest.mark.parametrize(
    "vehicle", [fp.vehicle("nayak2018"), fp.vehicle("hehn2011"), _hexarotor()], ids=lambda v: v.name
)
def test_mixing_is_the_sum_of_moments_of_forces(vehicle):
    rng = np.random.default_rng(8)
    for _ in range(5):
        forces = rng.uniform(0, 4, len(vehicle.rotor_spins))
        expected = _wrench_of_rotors(vehicle, forces)
        np.testing.assert_allclose(vehicle.mixing() @ forces, expected, rtol=0, atol=20 * EPS)
        flipped = fp.Wrench(expected[0], expected[1:]).flipped()
        down = vehicle.mixing("down") @ forces
        np.testing.assert_allclose(down, [flipped.thrust, *flipped.moment], rtol=0, atol=20 * EPS)
    for e3 in ("up", "down"):
        mixing, unmixing = vehicle.mixing(e3), vehicle.unmixing(e3)
        # 1/c amplifies: the condition number of the mixing is below 1000.
        np.testing.assert_allclose(mixing @ unmixing, np.eye(4), rtol=0, atol=1e3 * EPS)
        if len(forces) == 4:
            np.testing.assert_allclose(unmixing @ mixing, np.eye(4), rtol=0, atol=1e3 * EPS)
    with refused("e3", expected="one of up, down"):
        vehicle.mixing("sideways")


def test_of_six_rotors_unmixing_takes_the_smallest_forces():
    vehicle = _hexarotor()
    wanted = np.array([6.0, 0.1, -0.2, 0.05])
    forces = vehicle.unmixing() @ wanted
    np.testing.assert_allclose(vehicle.mixing() @ forces, wanted, rtol=0, atol=1e3 * EPS)
    null = np.linalg.svd(vehicle.mixing())[2][4:]
    np.testing.assert_allclose(null @ forces, 0, rtol=0, atol=1e3 * EPS)


def test_mixing_of_the_paper_is_its_printed_matrix():
    d, c = 0.315, 8.004e-3
    printed = np.array([[1, 1, 1, 1], [0, -d, 0, d], [d, 0, -d, 0], [-c, c, -c, c]])  # (transfmu)
    np.testing.assert_array_equal(np.diag([-1, 1, 1, 1]) @ fp.vehicle("nayak2018").mixing("down"), printed)


def test_front_rotor_pitches_up_and_a_clockwise_rotor_yaws_left():
    # Front-left-up: more force in front turns the nose up, a negative turn about the left axis.
    vehicle = fp.vehicle("nayak2018")
    front = vehicle.mixing() @ [1, 0, 0, 0]
    assert front[2] < 0
    assert front[3] > 0  # spins clockwise seen from above, so the body is turned counterclockwise


# TOML ------------------------------------------------------------------------------------------------------------

TOML = """
name = "mine"
mass = 1.0
bob_mass = 0.1
rod_length = 0.5
inertia = [[0.02, 0.001, 0.0], [0.001, 0.02, 0.0], [0.0, 0.0, 0.03]]
rotor_positions = [[0.1, 0.1, 0.0], [-0.1, 0.1, 0.0], [-0.1, -0.1, 0.0], [0.1, -0.1, 0.0]]
rotor_spins = [1, -1, 1, -1]
drag_ratio = 0.02
rotor_limits = [0.0, 5.0]
"""


def test_a_vehicle_from_toml(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(TOML, encoding="utf-8")
    vehicle = fp.Vehicle.from_toml(path)
    assert vehicle.name == "mine"
    assert vehicle.I[0, 1] == 0.001
    assert (vehicle.gravity, vehicle.rotor_lag) == (9.81, 0.0)  # the documented defaults
    again = fp.Vehicle.from_dict(vehicle.to_dict())
    assert again.to_dict() == vehicle.to_dict()


def test_a_byte_order_mark_before_a_vehicle_is_no_part_of_it(tmp_path):
    (tmp_path / "mine.toml").write_text('base = "hehn2011"\nmass = 0.6\n', encoding="utf-8-sig")
    assert fp.vehicle(tmp_path / "mine.toml").mass == 0.6


def test_a_toml_that_cannot_be_taken_is_refused_in_one_line(tmp_path):
    path = tmp_path / "bad.toml"
    with refused(str(path), expected="a readable TOML file", got="No such file"):
        fp.Vehicle.from_toml(path)
    with refused(str(tmp_path), expected="a readable TOML file", got="Is a directory"):
        fp.Vehicle.from_toml(tmp_path)
    path.write_text("mass = ", encoding="utf-8")
    with refused(str(path), expected="a TOML file"):
        fp.Vehicle.from_toml(path)
    path.write_bytes(b"\xff\xfe\x00")
    with refused(str(path), expected="a TOML file"):
        fp.Vehicle.from_toml(path)
    path.write_text(TOML.replace("mass = 1.0", "mass = -1.0", 1), encoding="utf-8")
    with refused("vehicle.mass", expected="a finite number > 0 kg", got="-1"):
        fp.Vehicle.from_toml(path)


@pytest.mark.parametrize(
    ("field", "changes"),
    [
        ("mass", {"mass": 10**400}),
        ("inertia", {"inertia": [10**400] * 3}),
        ("bands.mass", {"bands": {"mass": [1, 10**400]}}),
    ],
)
def test_a_number_beyond_every_float_is_refused(field, changes):
    with pytest.raises(fp.InputError, match=rf"^{field}: expected .*, got \[?1") as said:
        fp.vehicle("hehn2011").replace(**changes)
    assert len(str(said.value)) < 200


def test_the_vehicles_of_the_package_are_those_announced():
    assert {"hehn2011", "nayak2018"} <= set(vehicle_names())
    for name in vehicle_names():
        assert fp.vehicle(name).name == name


def test_states_wrenches_and_packed_states_are_seen_in_either_frame():
    states = fp.State.random(np.random.default_rng(5), 3)
    wrench = fp.Wrench(np.array([1.0, 2.0, 3.0]), np.arange(9.0).reshape(3, 3))
    assert states.in_frame("up") is states
    assert wrench.in_frame("up") is wrench
    np.testing.assert_array_equal(states.in_frame("down").packed(), states.flipped().packed())
    # A few units in the last place: a State makes its R a rotation again.
    np.testing.assert_allclose(convert_packed(states.packed(), "down"), states.flipped().packed(), rtol=0, atol=1e-14)
    np.testing.assert_array_equal(convert_packed(states.packed(), "up"), states.packed())
    np.testing.assert_allclose(states.in_frame("down").in_frame("down").packed(), states.packed(), atol=1e-15)
    np.testing.assert_array_equal(wrench.in_frame("down").thrust, -wrench.thrust)
    np.testing.assert_array_equal(wrench.in_frame("down").moment, wrench.flipped().moment)
