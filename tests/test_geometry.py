"""Geometry of S² and SO(3): axioms, definitions by finite differences, and one answer in NumPy and CasADi."""

import casadi as ca
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import stats
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from flypend import geometry as geo

# Identities of a few products and sums of numbers up to |v|^k: roundoff is about 1e-15 of the largest term.
ROUNDOFF = 1e-13

property_test = settings(max_examples=60, deadline=None, derandomize=True)
vectors = arrays(float, 3, elements=st.floats(-3, 3, allow_subnormal=False))


@st.composite
def units(draw):
    v = draw(vectors)
    assume(np.linalg.norm(v) > 0.1)
    return v / np.linalg.norm(v)


@st.composite
def rotations(draw):
    q = draw(arrays(float, 4, elements=st.floats(-1, 1, allow_subnormal=False)))
    assume(np.linalg.norm(q) > 0.1)
    return Rotation.from_quat(q).as_matrix()


def close(a, b, atol=ROUNDOFF, size=1.0):
    np.testing.assert_allclose(a, b, rtol=0, atol=atol * max(1.0, size))


# Vectors of R³ ---------------------------------------------------------------------------------------------------


@property_test
@given(vectors, vectors)
def test_hat_is_the_matrix_of_the_vector_product_and_vee_its_inverse(v, w):
    close(geo.hat(v) @ w, np.cross(v, w), size=9)
    np.testing.assert_array_equal(geo.vee(geo.hat(v)), v)
    np.testing.assert_array_equal(geo.hat(v), -geo.hat(v).T)


@property_test
@given(arrays(float, (3, 3), elements=st.floats(-3, 3, allow_subnormal=False)))
def test_vee_takes_the_skew_part(m):
    close(geo.hat(geo.vee(m)), (m - m.T) / 2)


@property_test
@given(vectors, vectors, vectors, vectors)
def test_dot_and_cross_obey_lagrange_jacobi_and_the_triple_product(a, b, c, d):
    cross, dot = geo.cross, geo.dot
    size = 4 * 27 * 3  # up to four factors of length √27
    close(cross(a, b), -cross(b, a))
    close(dot(a, cross(a, b)), 0, size=size)
    close(dot(cross(a, b), c), dot(a, cross(b, c)), size=size)
    close(dot(cross(a, b), cross(c, d)), dot(a, c) * dot(b, d) - dot(a, d) * dot(b, c), size=size)
    close(cross(a, cross(b, c)) + cross(b, cross(c, a)) + cross(c, cross(a, b)), 0, size=size)
    close(cross(geo.E1, geo.E2), geo.E3)


@property_test
@given(vectors, st.floats(1e-6, 2))
def test_norms(v, floor):
    close(geo.norm(v), np.linalg.norm(v), size=6)
    close(geo.smooth_norm(v, floor), np.hypot(np.linalg.norm(v), floor), size=6)
    assert geo.smooth_norm(v, floor) >= floor * (1 - 1e-15)  # one rounding of the root


def test_the_smooth_norm_has_a_derivative_at_zero_and_the_norm_has_none():
    v = ca.SX.sym("v", 3)
    smooth, plain = (
        ca.Function("d", [v], [ca.jacobian(length, v)])(np.zeros(3)).full()
        for length in (geo.smooth_norm(v, 1e-2), geo.norm(v))
    )
    np.testing.assert_array_equal(smooth, np.zeros((1, 3)))
    assert np.all(np.isnan(plain))


# S² --------------------------------------------------------------------------------------------------------------


@property_test
@given(units(), vectors)
def test_hat_squared_is_minus_the_tangent_part(y, v):
    tangent = v - (v @ y) * y
    close(geo.hat_squared(y, v), -tangent, size=6)
    close(geo.tangent_part(y, v), tangent, size=6)
    close(geo.hat_squared(y, v), geo.hat(y) @ geo.hat(y) @ v, size=6)


@property_test
@given(units(), vectors)
def test_hat_squared_of_a_velocity_is_minus_the_velocity(y, v):
    # The paper's (fpeqn) rests on ŷ²ẏ = +ẏ.
    y_dot = np.cross(v, y)
    assume(np.linalg.norm(y_dot) > 0.1)
    close(geo.hat_squared(y, y_dot), -y_dot, size=6)
    assert np.linalg.norm(geo.hat_squared(y, y_dot) - y_dot) > 1.9 * np.linalg.norm(y_dot)


@property_test
@given(units(), vectors, st.floats(0.9, 1.1))
def test_hat_squared_stays_normal_to_y_off_the_sphere(y, v, length):
    # y(y·v) − v is not: there |y| would grow in the inverted pose.
    close(geo.dot(y, geo.hat_squared(length * y, v)), 0, size=6)


@property_test
@given(units(), units(), vectors)
def test_transport_is_tangent_never_longer_and_the_identity_at_the_reference(phi, phi_d, v):
    phi_d_dot = np.cross(v, phi_d)
    moved = geo.transport(phi, phi_d, phi_d_dot)
    close(geo.dot(moved, phi), 0, size=6)
    assert np.linalg.norm(moved) <= np.linalg.norm(phi_d_dot) * (1 + 1e-14) + 1e-15  # |ω_d × φ| ≤ |ω_d|, rounded
    close(geo.transport(phi_d, phi_d, phi_d_dot), phi_d_dot, size=6)


@property_test
@given(units(), units(), vectors, vectors)
def test_transport_is_compatible_with_the_distance_of_lemma_2(phi, phi_d, v, w):
    # d/dt(1 − φ·φ_d) = ⟨φ̂²φ_d, φ̇ − τφ̇_d⟩: what makes V_2 of Theorem 1 decrease.
    phi_dot, phi_d_dot = np.cross(v, phi), np.cross(w, phi_d)
    error = phi_dot - geo.transport(phi, phi_d, phi_d_dot)
    close(geo.dot(geo.hat_squared(phi, phi_d), error), -phi_dot @ phi_d - phi @ phi_d_dot, size=12)


def _curve(a, b, start):
    """t → exp(t â) exp(t b̂) start and its first two derivatives at 0, exact."""
    A, B = geo.hat(a), geo.hat(b)
    return (lambda t: expm(t * A) @ expm(t * B) @ start), (A + B) @ start, (A @ A + 2 * A @ B + B @ B) @ start


@property_test
@given(units(), units(), *[arrays(float, 3, elements=st.floats(-0.5, 0.5, allow_subnormal=False))] * 4)
def test_transport_derivative_is_the_tangent_part_of_the_change_of_the_transported_velocity(p, q, a, b, c, d):
    phi, phi_dot, _ = _curve(a, b, p)
    phi_d, phi_d_dot, phi_d_ddot = _curve(c, d, q)
    C, D = geo.hat(c), geo.hat(d)

    def transported(t):
        velocity = C @ phi_d(t) + expm(t * C) @ D @ expm(t * D) @ q
        return geo.transport(phi(t), phi_d(t), velocity)

    h = 1e-3
    change = (8 * (transported(h) - transported(-h)) - (transported(2 * h) - transported(-2 * h))) / (12 * h)
    expected = change - (change @ p) * p
    # Error of the five-point formula h⁴/30 |τ⁽⁵⁾|; three factors of rate ≤ √3 each give |τ⁽⁵⁾| ≤ √3 (3√3)⁵ < 7000,
    # so 3e-10; roundoff is 1e-16/h = 1e-13.
    close(geo.transport_derivative(p, phi_dot, q, phi_d_dot, phi_d_ddot), expected, atol=3e-10)
    close(geo.dot(geo.transport_derivative(p, phi_dot, q, phi_d_dot, phi_d_ddot), p), 0)


def test_the_feedforward_as_printed_is_not_the_derivative_of_the_transport():
    rng = np.random.default_rng(1)
    p, q = geo.random_sphere(rng, (2,))
    a, b, c, d = rng.standard_normal((4, 3))
    _, phi_dot, phi_ddot = _curve(a, b, p)
    _, phi_d_dot, phi_d_ddot = _curve(c, d, q)
    right = geo.transport_derivative(p, phi_dot, q, phi_d_dot, phi_d_ddot)
    printed = geo.transport_derivative(p, phi_dot, q, phi_d_dot, phi_ddot)
    assert np.linalg.norm(right - printed) > 0.5  # of the order of the accelerations, about 3


# Projections -----------------------------------------------------------------------------------------------------


@property_test
@given(units(), vectors, st.floats(0.5, 2), vectors)
def test_project_tangent_is_idempotent_and_nearest(y, v, length, w):
    normal = length * y
    p = geo.project_tangent(normal, v)
    close(p @ y, 0, size=6)
    close(geo.project_tangent(normal, p), p, size=6)
    other = np.cross(w, y)  # any tangent vector
    assert np.linalg.norm(v - p) <= np.linalg.norm(v - other) + ROUNDOFF


@property_test
@given(units(), units(), vectors)
def test_parallel_transport_is_the_shortest_rotation(y, y_after, v):
    assume(y @ y_after > -0.9)
    b = v - (y @ v) * y
    axis = np.cross(y, y_after)
    sine = np.linalg.norm(axis)
    turn = Rotation.from_rotvec(np.arctan2(sine, y @ y_after) * axis / max(sine, 1e-300))
    close(geo.parallel_transport(b, y, y_after), turn.apply(b), size=1e3)


@property_test
@given(units())
def test_any_tangent_is_a_unit_vector_across(y):
    for at in (y, *np.eye(3), *-np.eye(3)):
        b = geo.any_tangent(at)
        close([b @ at, b @ b], [0, 1])


@property_test
@given(vectors, st.floats(0.1, 3))
def test_shortened_keeps_direction_and_what_is_short(v, most):
    close(geo.shorten(v, most), v * min(1, most / max(np.linalg.norm(v), 1e-300)), size=3)


@property_test
@given(vectors, units())
def test_unit_is_idempotent_and_nearest(v, other):
    assume(np.linalg.norm(v) > 1e-3)
    p = geo.unit(v)
    close(geo.norm(p), 1)
    close(geo.unit(p), p)
    assert np.linalg.norm(v - p) <= np.linalg.norm(v - other) + ROUNDOFF


@property_test
@given(rotations(), arrays(float, (3, 3), elements=st.floats(-1, 1, allow_subnormal=False)), rotations(), vectors)
def test_project_rotation_is_a_rotation_idempotent_and_nearest(R, noise, other, v):
    m = R + noise  # also far from SO(3), also with negative determinant
    p = geo.project_rotation(m)
    close(p.T @ p, np.eye(3))
    assert np.linalg.det(p) > 0
    close(geo.project_rotation(p), p)
    for candidate in (other, p @ Rotation.from_rotvec(1e-3 * v).as_matrix()):
        assert np.linalg.norm(m - p) <= np.linalg.norm(m - candidate) + ROUNDOFF


@property_test
@given(rotations(), arrays(float, (3, 3), elements=st.floats(-1, 1, allow_subnormal=False)), st.floats(1e-8, 1e-3))
def test_a_polar_step_squares_the_distance_from_the_nearest_rotation(R, noise, size):
    m = R + size * noise
    left = np.linalg.norm(geo.polar_step(m) - geo.project_rotation(m))
    assert left <= 1.5 * np.linalg.norm(m - geo.project_rotation(m)) ** 2 * 1.01 + ROUNDOFF  # of each singular value
    close(geo.polar_step(R), R)
    close(geo.transpose(np.stack([R, m])), [R.T, m.T])


@property_test
@given(rotations(), st.floats(-0.5, 0.5))
def test_rotation_defect_measures_the_distance(R, strain):
    close(geo.rotation_defect(R), 0)
    close(geo.rotation_defect((1 + strain) * R), np.sqrt(3) * abs((1 + strain) ** 2 - 1))
    assert geo.rotation_defect(R @ np.diag([1, 1, -1])) >= 2  # a mirror satisfies mᵀm = 1


def test_rotation_defect_of_a_batch_judges_each_matrix():
    batch = np.array([np.eye(3), 2 * np.eye(3), -np.eye(3)])
    close(geo.rotation_defect(batch), [0, 3 * np.sqrt(3), 2])


@pytest.mark.parametrize("scale", [0.0, 5e-324, 1e-310, 1e-200, 1e200, 1e307])
def test_rotation_defect_of_sizes_beyond_reason_warns_of_nothing(scale, recwarn):
    """A file can hold such matrices; LAPACK's determinant divides by their pivots."""
    m = np.random.default_rng(0).standard_normal((50, 3, 3)) * scale
    assert np.all(geo.rotation_defect(m) >= 1.7)  # a zero matrix is the square root of 3 away
    assert not recwarn.list


def test_project_rotation_refuses_what_is_not_a_number():
    with pytest.raises(np.linalg.LinAlgError):
        geo.project_rotation(np.full((3, 3), np.nan))


@property_test
@given(arrays(float, (5, 4), elements=st.floats(-2, 2, allow_subnormal=False)))
def test_rotation_from_quaternion_agrees_with_scipy(q):
    assume(np.all(np.linalg.norm(q, axis=-1) > 0.1))
    close(geo.rotation_from_quat_xyzw(q), Rotation.from_quat(q).as_matrix())
    close(geo.rotation_from_quat_xyzw(q[0]), Rotation.from_quat(q[0]).as_matrix())
    close(geo.rotation_from_quat_xyzw(-q), geo.rotation_from_quat_xyzw(q))


@property_test
@given(arrays(float, (5, 4), elements=st.floats(-2, 2, allow_subnormal=False)))
def test_quaternion_of_a_rotation_gives_the_rotation_back(q):
    assume(np.all(np.linalg.norm(q, axis=-1) > 0.1))
    given_back = geo.quat_xyzw_from_rotation(Rotation.from_quat(q).as_matrix())
    close(np.abs(np.sum(given_back * q, axis=-1)), np.linalg.norm(q, axis=-1))
    assert np.all(np.max(given_back, axis=-1) >= 0.5 - 1e-12)  # the largest of four entries of a unit quaternion
    close(given_back[0], geo.quat_xyzw_from_rotation(Rotation.from_quat(q[0]).as_matrix()))


@pytest.mark.parametrize("turn", [(0, 0, 0), (1e-9, 0, 2e-9), (0.1, 0.2, -3), (0, np.pi, 0), (4, -5, 6)])
def test_rotation_from_a_vector_agrees_with_scipy(turn):
    close(geo.rotation_from_vector(turn), Rotation.from_rotvec(turn).as_matrix())


# Random points ---------------------------------------------------------------------------------------------------

COUNT = 20_000
# Kolmogorov's statistic of COUNT uniform samples exceeds this once in 1000 seeds; the seed is fixed.
KOLMOGOROV = 1.95 / np.sqrt(COUNT)
# Means of entries with variance at most 1/3: six standard deviations.
MEAN = 6 * np.sqrt(1 / 3 / COUNT)


def _kolmogorov(samples, cdf):
    return stats.kstest(samples, cdf).statistic


def test_random_sphere_is_uniform():
    v = geo.random_sphere(np.random.default_rng(7), (COUNT,))
    close(geo.norm(v), np.ones(COUNT))
    assert np.max(np.abs(v.mean(0))) < MEAN
    assert np.max(np.abs(v.T @ v / COUNT - np.eye(3) / 3)) < MEAN
    for axis in ([1, 0, 0], [0, 0, 1], np.array([1, -2, 3]) / np.sqrt(14)):  # Archimedes: any coordinate is uniform
        assert _kolmogorov(v @ axis, stats.uniform(-1, 2).cdf) < KOLMOGOROV


def test_random_rotation_is_uniform():
    R = geo.random_rotation(np.random.default_rng(8), (COUNT,))
    assert np.max(geo.rotation_defect(R)) < ROUNDOFF
    flat = R.reshape(COUNT, 9)
    assert np.max(np.abs(flat.mean(0))) < MEAN
    assert np.max(np.abs(flat.T @ flat / COUNT - np.eye(9) / 3)) < MEAN  # E[R_ij R_kl] = δ_ik δ_jl / 3 under Haar
    angle = np.arccos(np.clip((np.trace(R, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert _kolmogorov(angle, lambda a: (a - np.sin(a)) / np.pi) < KOLMOGOROV  # Haar measure of the angle


def test_random_tangent_is_uniform_in_its_disc():
    rng = np.random.default_rng(9)
    y = geo.random_sphere(rng, (COUNT,))
    v = geo.random_tangent(rng, y, 3.0)
    close(geo.dot(y, v), np.zeros(COUNT), size=3)
    length = geo.norm(v)
    assert length.max() <= 3.0 * (1 + 1e-15)
    assert _kolmogorov((length / 3.0) ** 2, stats.uniform().cdf) < KOLMOGOROV  # area is uniform in the disc
    one = np.tile(geo.E3, (COUNT, 1))
    direction = geo.random_tangent(rng, one, 1.0)
    angle = np.arctan2(direction[:, 1], direction[:, 0])
    assert _kolmogorov(angle, stats.uniform(-np.pi, 2 * np.pi).cdf) < KOLMOGOROV


def test_random_points_are_those_of_the_generator():
    for draw in (geo.random_sphere, geo.random_rotation):
        np.testing.assert_array_equal(*(draw(np.random.default_rng(3), (2, 4)) for _ in range(2)))
    assert geo.random_sphere(np.random.default_rng(0)).shape == (3,)
    assert geo.random_rotation(np.random.default_rng(0), (2, 4)).shape == (2, 4, 3, 3)


# NumPy and CasADi ------------------------------------------------------------------------------------------------

# function and the kinds of its arguments: v vector, s scalar, m matrix
FUNCTIONS = {
    "dot": (geo.dot, "vv"),
    "norm": (geo.norm, "v"),
    "smooth_norm": (lambda v: geo.smooth_norm(v, 0.3), "v"),
    "scale": (geo.scale, "sv"),
    "cross": (geo.cross, "vv"),
    "unit": (geo.unit, "v"),
    "hat": (geo.hat, "v"),
    "vee": (geo.vee, "m"),
    "hat_squared": (geo.hat_squared, "vv"),
    "tangent_part": (geo.tangent_part, "vv"),
    "apply": (geo.apply, "mv"),
    "transport": (geo.transport, "vvv"),
    "transport_derivative": (geo.transport_derivative, "vvvvv"),
    "project_tangent": (geo.project_tangent, "vv"),
    "shortened": (lambda v: geo.shorten(v, 1.5), "v"),
    "parallel_transport": (geo.parallel_transport, "vvv"),
    "any_tangent": (geo.any_tangent, "v"),
    "transpose": (geo.transpose, "m"),
    "polar_step": (geo.polar_step, "m"),
}
SHAPE = {"v": (3,), "s": (), "m": (3, 3)}
NUMPY_ONLY_IN_BATCH = (
    "hat",
    "vee",
    "apply",
    "transpose",
    "polar_step",
)  # they make or take matrices, of which CasADi has no batch


def _arguments(kinds, batch):
    rng = np.random.default_rng(5)
    return [rng.standard_normal((*batch, *SHAPE[kind])) for kind in kinds]


@pytest.mark.parametrize("batch", [(4,), (2, 3), (1,), (3,), (0,)])
@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_numpy_batch_is_the_single_results_in_order(name, batch):
    function, kinds = FUNCTIONS[name]
    arguments = _arguments(kinds, batch)
    result = function(*arguments)
    single = [function(*(a[index] for a in arguments)) for index in np.ndindex(batch)]
    assert result.shape[: len(batch)] == batch
    if single:
        np.testing.assert_array_equal(result, np.reshape(single, (*batch, *np.shape(single[0]))))


@pytest.mark.parametrize("kind", [ca.SX, ca.MX])
@pytest.mark.parametrize("name", FUNCTIONS)
def test_casadi_column_gives_the_numbers_of_numpy(name, kind):
    function, kinds = FUNCTIONS[name]
    arguments = _arguments(kinds, ())
    symbols = [kind.sym(f"a{i}", *{"v": (3, 1), "s": (1, 1), "m": (3, 3)}[k]) for i, k in enumerate(kinds)]
    got = ca.Function("f", symbols, [function(*symbols)])(*arguments).full()
    expected = function(*arguments)
    close(got, np.reshape(expected, got.shape))  # a sum may be ordered differently
    if np.ndim(expected) == 2:
        assert got.shape == (3, 3)


@pytest.mark.parametrize("batch", [1, 3, 5])  # 3 looks like a matrix, 1 like a row
@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name not in NUMPY_ONLY_IN_BATCH])
def test_casadi_batch_gives_the_numbers_of_numpy(name, batch):
    function, kinds = FUNCTIONS[name]
    arguments = _arguments(kinds, (batch,))
    symbols = [ca.SX.sym(f"a{i}", batch, 3 if k == "v" else 1) for i, k in enumerate(kinds)]
    got = ca.Function("f", symbols, [function(*symbols)])(*arguments).full()
    close(got, np.reshape(function(*arguments), got.shape))
    assert got.shape[0] == batch


def test_a_fixed_vector_may_meet_a_casadi_batch():
    v = ca.SX.sym("v", 4, 3)
    values = np.random.default_rng(0).standard_normal((4, 3))
    for function in (geo.cross, geo.hat_squared):
        got = ca.Function("f", [v], [function(v, geo.E3)])(values).full()
        close(got, function(values, geo.E3))


def test_clip_is_that_of_numpy_for_arrays_and_expressions():
    value, low, high = np.random.default_rng(3).standard_normal((3, 20))
    symbols = [ca.SX.sym(name, 20) for name in "vlh"]
    expected = np.minimum(np.maximum(value, low), high)
    np.testing.assert_array_equal(geo.clip(value, low, high), expected)
    np.testing.assert_array_equal(
        ca.Function("f", symbols, [geo.clip(*symbols)])(value, low, high).full()[:, 0], expected
    )
    np.testing.assert_array_equal(geo.clip(value, -0.5, 0.5), np.clip(value, -0.5, 0.5))


def test_casadi_turns_a_quaternion_into_the_matrix_of_numpy():
    q, given = ca.SX.sym("q", 4), np.array([0.3, -0.8, 0.1, 1.7])
    close(ca.Function("f", [q], [geo.rotation_from_quat_xyzw(q)])(given).full(), geo.rotation_from_quat_xyzw(given))


def test_wrong_shapes_are_refused():
    for shape in ((3, 2), (4, 1), (4, 2), (1, 1)):
        with pytest.raises(ValueError, match=r"expected a CasADi vector of shape"):
            geo.dot(ca.SX.sym("a", *shape), ca.SX.sym("b", *shape))
    with pytest.raises(ValueError, match=r"not a batch"):
        geo.hat(ca.SX.sym("a", 4, 3))
    with pytest.raises(ValueError, match=r"broadcast"):
        geo.cross(np.ones((2, 3)), np.ones((4, 3)))


@pytest.mark.parametrize("length", [2, 4])
def test_a_numpy_vector_has_three_components(length):
    with pytest.raises(ValueError, match=r"3"):
        geo.dot(np.ones(length), np.ones(length))


def test_one_casadi_matrix_applies_to_each_vector_of_a_batch():
    m, v = ca.SX.sym("m", 3, 3), ca.SX.sym("v", 3, 3)
    matrix, vectors_ = _arguments("m", ())[0], _arguments("v", (3,))[0]
    got = ca.Function("f", [m, v], [geo.apply(m, v)])(matrix, vectors_).full()
    close(got, geo.apply(matrix, vectors_))


def test_a_casadi_column_meets_a_casadi_batch_and_no_numpy_batch():
    with pytest.raises(ValueError, match=r"NumPy batch"):
        geo.cross(ca.SX.sym("a", 3), np.ones((5, 3)))
    column, batch = ca.SX.sym("a", 3), ca.SX.sym("b", 5, 3)
    values = _arguments("vv", (5,))
    got = ca.Function("f", [column, batch], [geo.cross(column, batch)])(values[0][0], values[1]).full()
    close(got, geo.cross(values[0][0], values[1]))  # one vector meets each of a CasADi batch
