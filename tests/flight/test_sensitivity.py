"""Sensitivities: the tangent kernel against finite differences, an independent integration, and group structure."""

import casadi as ca
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import flypend as fp
from flypend.laws.closed_loop import symbolic_loop
from flypend.laws.linearise import COORDINATES, linearise, tangent_basis
from flypend.paper import experiment

CASE = experiment("1")
GAINS = ("k_d", "k_1", "k_2")
MOVING = fp.State(y=(0, 0.6, 0.8), y_dot=(0.5, 0.8, -0.6), omega=(1.0, -0.5, 0.3), x_dot=(0.1, 0.2, 0.3))


def moved(start, xi):
    """The start displaced by `xi` (16,) along its tangent basis; second-order terms are projected away."""
    from flypend.model.state import project

    return fp.State.from_packed(project(start.packed() + tangent_basis(start) @ xi)[0])


def end(law, start, duration):
    return fp.simulate(CASE.vehicle, law, start, duration, rtol=1e-12, plant="ideal").packed[-1]


@pytest.fixture(scope="module")
def found():
    return fp.sensitivity(CASE.vehicle, CASE.law(), CASE.start, 2.0, gains=GAINS, rtol=1e-11)


def test_the_basis_stays_on_the_manifold_to_first_order():
    """Constraints have no derivative along it: |y|² = 1, y·ẏ = 0, RᵀR = 1."""
    E = tangent_basis(MOVING)
    assert np.max(np.abs(MOVING.y @ E[18:21])) < 1e-15
    assert np.max(np.abs(MOVING.y_dot @ E[18:21] + MOVING.y @ E[21:24])) < 1e-15
    assert np.linalg.matrix_rank(E) == 16
    assert np.max(np.abs(MOVING.y_dot @ E[18:21])) > 0.1  # which takes the change of ẏ with y


def test_it_ends_where_the_run_ends(found):
    assert found.outcome.status == "completed"
    np.testing.assert_allclose(found.final.packed(), end(CASE.law(), CASE.start, 2.0), atol=1e-9)


def test_derivatives_by_the_start_are_the_finite_differences(found):
    """Central differences with h = 1e-5 of runs at 1e-12: errors h² of the third derivative and 1e-12/h, so 1e-6."""
    h = 1e-5
    for i in range(len(COORDINATES)):
        xi = h * np.eye(16)[i]
        difference = end(CASE.law(), moved(CASE.start, xi), 2.0) - end(CASE.law(), moved(CASE.start, -xi), 2.0)
        scale = 1 + np.max(np.abs(found.by_start[:, i]))
        np.testing.assert_allclose(
            found.by_start[:, i], difference / (2 * h), atol=1e-6 * scale, err_msg=COORDINATES[i]
        )


def test_derivatives_by_gains_are_the_finite_differences(found):
    h = 1e-5
    for i, name in enumerate(GAINS):
        ends = []
        for sign in (1, -1):
            changed = fp.laws.corrected(**{**CASE.gains, name: CASE.gains[name] + sign * h})
            ends.append(end(changed, CASE.start, 2.0))
        scale = 1 + np.max(np.abs(found.by_gains[:, i]))
        np.testing.assert_allclose(found.by_gains[:, i], (ends[0] - ends[1]) / (2 * h), atol=1e-6 * scale)
        assert np.max(np.abs(found.by_gains[:, i])) > 1e-3


def test_derivatives_are_those_of_an_independent_integration(found):
    """Ṡ = F_s S with the full Jacobian, 24 columns at once, by SciPy at 1e-11, without any projection."""
    law = CASE.law().bind(CASE.vehicle)
    loop = symbolic_loop(CASE.vehicle, law)
    rates = ca.Function("rates", [loop.t, loop.s, loop.p], [loop.rates, ca.jacobian(loop.rates, loop.s)])

    def motion(t, both):
        state, tangent = both[:24], both[24:].reshape(24, 24)
        velocity, jacobian = rates(t, state, [])
        return np.concatenate([np.array(velocity).ravel(), (np.array(jacobian) @ tangent).ravel()])

    begin = np.concatenate([CASE.start.packed(), np.eye(24).ravel()])
    solved = solve_ivp(motion, (0, 2.0), begin, method="DOP853", rtol=1e-11, atol=1e-11)
    full = solved.y[24:, -1].reshape(24, 24) @ tangent_basis(CASE.start)
    np.testing.assert_allclose(found.by_start, full, atol=1e-7 * np.max(np.abs(full)))


def test_a_shift_of_the_start_is_a_shift_of_the_end(found):
    """The law does not see the position: ∂x(T)/∂x(0) = 1, ∂x(T)/∂ẋ(0) = T, and nothing else moves: to roundoff."""
    expected = np.zeros((24, 6))
    expected[:3, :3], expected[:3, 3:], expected[3:6, 3:] = np.eye(3), 2.0 * np.eye(3), np.eye(3)
    np.testing.assert_allclose(found.by_start[:, :6], expected, atol=1e-9)


def test_over_two_stretches_derivatives_are_multiplied():
    law, vehicle = CASE.law(), CASE.vehicle
    first = fp.sensitivity(vehicle, law, MOVING, 0.4, rtol=1e-11)
    second = fp.sensitivity(vehicle, law, first.final, 0.6, rtol=1e-11)
    whole = fp.sensitivity(vehicle, law, MOVING, 1.0, rtol=1e-11)
    np.testing.assert_allclose(second.by_start @ first.on_manifold[0], whole.by_start, atol=1e-8)


def test_at_an_equilibrium_it_is_the_exponential_of_the_linearisation():
    vehicle, law = fp.vehicle("hehn2011"), fp.laws.lqr()
    from scipy.linalg import expm

    linear = linearise(law, vehicle)
    found = fp.sensitivity(vehicle, law, linear.at, 0.7, rtol=1e-11)
    np.testing.assert_allclose(found.on_manifold[0], expm(0.7 * linear.A), atol=1e-6)


def test_the_inverted_law_has_derivatives_by_its_gains():
    vehicle = fp.vehicle("hehn2011")
    start = fp.State(y=(0.6, 0, 0.8))
    found = fp.sensitivity(vehicle, fp.laws.inverted(), start, 0.5, gains=("rod_bandwidth",), rtol=1e-10)
    value = fp.laws.inverted().bind(vehicle).numbers["rod_bandwidth"]
    h, ends = 1e-4, []
    for sign in (1, -1):
        law = fp.laws.inverted(rod_bandwidth=value + sign * h)
        ends.append(fp.simulate(vehicle, law, start, 0.5, rtol=1e-12, plant="ideal").packed[-1])
    assert np.max(np.abs(found.by_gains)) > 1e-3
    np.testing.assert_allclose(found.by_gains[:, 0], (ends[0] - ends[1]) / (2 * h), atol=1e-5)


def test_a_jump_of_the_moment_shows_in_the_discrepancy(found):
    assert found.discrepancy < 1e-6
    vehicle, law = fp.vehicle("hehn2011"), fp.laws.inverted()
    start = fp.random_starts(60, seed=3)[16]  # the tilt limit sets in after 1.19 s
    (before, after), h = (fp.sensitivity(vehicle, law, start, time) for time in (1.0, 1.5)), 1e-4
    ends = [
        fp.simulate(vehicle, law, moved(start, h * sign * np.eye(16)[5]), 1.5, rtol=1e-11, plant="ideal").packed[-1]
        for sign in (1, -1)
    ]
    assert np.max(np.abs(after.by_start[:, 5] - (ends[0] - ends[1]) / (2 * h))) > 0.1
    assert before.discrepancy < 0.01
    assert after.discrepancy > 0.1


def test_a_run_that_does_not_complete_has_no_derivatives():
    case = experiment("4")
    found = fp.sensitivity(case.vehicle, case.law("printed"), case.start, 2.0)
    assert found.outcome.status in ("singular", "diverged")
    assert np.all(np.isnan(found.by_start))
    assert np.isnan(found.discrepancy)


@pytest.mark.parametrize(
    ("options", "line"),
    [
        ({"gains": ("k_3",)}, "gains.k_3"),
        ({"start": fp.State(y=[(0, 0, 1)] * 2)}, "start: expected a single State"),
        ({"law": fp.Controller(name="a", function=print)}, "law: expected a Law"),
        ({"duration": -1}, "duration"),
        ({"rtol": 0.0}, "rtol"),
    ],
)
def test_what_makes_no_sense_is_refused(options, line):
    given = {"vehicle": CASE.vehicle, "law": CASE.law(), "start": CASE.start, "duration": 1.0} | options
    with pytest.raises(fp.InputError, match=line):
        fp.sensitivity(**given)


def test_a_flight_that_touches_has_no_derivative():
    vehicle = fp.vehicle("hehn2011").replace(mount="hub")
    with pytest.raises(fp.InputError) as refused:
        fp.sensitivity(vehicle, fp.laws.inverted(), fp.State(y=(1, 0, 0)), 1.0)
    assert refused.value.field == "start"
    assert fp.sensitivity(vehicle, fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.1).outcome.status == "completed"
    with pytest.raises(fp.InputError, match="gains"):
        fp.sensitivity(vehicle, fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.1, gains="rod_bandwidth")
