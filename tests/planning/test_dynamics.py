"""Coordinates, the step and its derivatives, the barrier's terms: by their definitions and finite differences."""

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend.compile.numeric import as_numpy
from flypend.geometry import rotation_defect
from flypend.model.state import SIZE
from flypend.planning.constraints import own_function
from flypend.planning.dynamics import Stage, Units, local, plane, retract
from flypend.planning.inequalities import Barrier, Structure, end_errors
from flypend.planning.riccati import Layout
from flypend.plants.equations import EquationsEngine
from flypend.plants.lag import step_timing

HEHN = fp.vehicle("hehn2011")
SIX = HEHN.replace(
    rotor_positions=[[0.2 * np.cos(a), 0.2 * np.sin(a), 0.0] for a in np.arange(6) * np.pi / 3],
    rotor_spins=[1, -1, 1, -1, 1, -1], rotor_limits=[0.05, 2.5], inertia=[3e-3, 4e-3, 6e-3],
)  # fmt: skip


def numeric(function):
    return as_numpy(function)


def random_state(rng, vehicle):
    start = fp.State.random(rng).packed()
    return np.append(start, rng.uniform(*vehicle.rotor_limits, len(vehicle.rotor_spins)))


@pytest.fixture(scope="module")
def maps():
    state, other, delta = ca.SX.sym("s", 28), ca.SX.sym("o", 28), ca.SX.sym("d", 20)
    return (
        numeric(ca.Function("retract", [state, delta], [ca.densify(retract(state, delta))])),
        numeric(ca.Function("local", [state, other], [ca.densify(local(state, other))])),
    )


def test_coordinates_are_inverted_and_stay_on_the_manifold(maps):
    forth, back = maps
    rng = np.random.default_rng(3)
    for _ in range(20):
        state, delta = random_state(rng, HEHN), rng.normal(size=20)
        moved = forth(state, delta)
        assert rotation_defect(moved[6:15].reshape(3, 3)) < 1e-14
        assert np.linalg.norm(moved[18:21]) == pytest.approx(1, abs=1e-14)
        assert moved[18:21] @ moved[21:24] == pytest.approx(0, abs=1e-13)
        np.testing.assert_allclose(back(state, moved), delta, rtol=0, atol=1e-12)  # well conditioned for |δ| of order 1
    np.testing.assert_allclose(back(state, state), 0, atol=1e-15)


@pytest.mark.parametrize("y", [(0, 0, 1), (0, 0, -1), (0.6, -0.8, 0), (0.6, 0, -0.8), (-1, 0, -0.0)])
def test_the_basis_is_orthonormal_and_right_handed_everywhere(y):
    b = np.array(ca.DM(ca.evalf(plane(ca.SX(ca.DM(y))))))
    whole = np.column_stack([b, y])
    np.testing.assert_allclose(whole.T @ whole, np.eye(3), atol=1e-15)
    assert np.linalg.det(whole) == pytest.approx(1)


@pytest.mark.parametrize("vehicle", [HEHN, SIX, fp.vehicle("crazyflie")])
def test_a_stage_in_own_units_is_a_step_of_the_plant(vehicle):
    units, n, h = Units.of(vehicle), len(vehicle.rotor_spins), 0.01
    rng = np.random.default_rng(4)
    begin, command = random_state(rng, vehicle), rng.uniform(*vehicle.rotor_limits, n)
    engine = EquationsEngine(vehicle)
    engine.reset(begin[:SIZE], begin[SIZE:])
    engine.step(command, h, np.zeros(6))
    step = numeric(Stage(n).step())
    timing = step_timing(vehicle.rotor_lag / units.time, h / units.time)
    end = step(begin / units.states(n), command / units.force, timing, units.numbers(vehicle)) * units.states(n)
    np.testing.assert_allclose(end, np.append(engine.packed, engine.rotors), rtol=1e-12, atol=1e-13)


def test_forces_from_outside_act_as_in_the_plant():
    units, forces, h = Units.of(HEHN), np.array([0.4, -0.3, 0.2, 0.05, 0.1, -0.08]), 0.01
    rng = np.random.default_rng(6)
    begin, command = random_state(rng, HEHN), rng.uniform(*HEHN.rotor_limits, 4)
    engine = EquationsEngine(HEHN)
    engine.reset(begin[:SIZE], begin[SIZE:])
    engine.step(command, h, forces)
    numbers, timing = units.numbers(HEHN), step_timing(HEHN.rotor_lag / units.time, h / units.time)
    numbers[-6:] = forces / HEHN.weight
    end = numeric(Stage(4).step())(begin / units.states(4), command / units.force, timing, numbers) * units.states(4)
    np.testing.assert_allclose(end, np.append(engine.packed, engine.rotors), rtol=1e-12, atol=1e-13)


def test_derivatives_are_those_by_finite_differences(maps):
    forth, back = maps
    stage, units = Stage(4), Units.of(HEHN)
    gap_of, A_of, B_of = stage.derivatives()
    slopes = [ca.vertcat(*of.nonzeros()) for of in (A_of, B_of)]
    linearised, step = numeric(stage.linearise(gap_of, *slopes)), numeric(stage.step())
    rng = np.random.default_rng(5)
    before, after = (random_state(rng, HEHN) / units.states(4) for _ in range(2))
    command, timing, numbers = rng.uniform(0.1, 2, 4), step_timing(0.08, 1 / 12), units.numbers(HEHN)
    gap, a, b = linearised(before, after, command, timing, numbers)
    np.testing.assert_allclose(gap, back(after, step(before, command, timing, numbers)), atol=1e-13)
    A, B = np.array(ca.DM(A_of.sparsity(), a)), np.array(ca.DM(B_of.sparsity(), b))
    eps = 1e-6  # the error of central differences is 1e-12 of the third derivative, and 1e-10 by roundoff
    for i in range(24):
        ends = []
        for sign in (1, -1):
            move = np.zeros(24)
            move[i] = sign * eps
            ends.append(back(after, step(forth(before, move[:20]), command + move[20:], timing, numbers)))
        column = (ends[0] - ends[1]) / (2 * eps)
        np.testing.assert_allclose(A[:, i] if i < 20 else B[:, i - 20], column, rtol=1e-7, atol=2e-8)


COST = own_function(lambda m: [0.3 * m.omega, m.y[2] ** 2, m.rotor_forces[1]], 4, "cost").serialize()


@pytest.mark.parametrize("structure", [Structure(), Structure(box=True, speed=True), Structure(speed=True, cost=COST)])
def test_the_terms_are_the_gradient_of_the_barrier(maps, structure):
    """With s = g and z = μ/s, the gradient of the linear-quadratic problem is that of cost − μ Σ log g."""
    forth, _ = maps
    stage = Stage(4)
    barrier = Barrier(stage, structure)
    layout = Layout(ca.Sparsity(20, 20), ca.Sparsity(20, 4), barrier.pattern)
    values, terms = numeric(barrier.values()), numeric(barrier.terms(layout))
    rng = np.random.default_rng(6)
    state = random_state(rng, HEHN) / Units.of(HEHN).states(4)
    state[:3] = rng.normal(size=3) * 0.3
    # The ceiling is a little below the pivot; last are the weight of that, and a margin that the mount would keep.
    walls, soft = ([1.0, *[-3.0] * 3, 3.0, 3.0, state[2] - 0.01], [10.0, 0.0]) if structure.box else ([], [])
    own = [0.1, 0.2, 0.3, 0.6, 0.25, 2.0, 0.3] if structure.cost else []
    numbers = np.array([1.0, 0.3, 0.06, 2.6, 0.1, *own, *walls, *([5.0] if structure.speed else []), *soft])
    command, vehicle, mu = rng.uniform(0.2, 2.4, 4), Units.of(HEHN).numbers(HEHN), 0.02

    def merit(delta, upsilon, epsilon):
        point = (forth(state, delta), command + upsilon, 2.0 + epsilon, numbers, vehicle)
        return values(*point, np.full(barrier.inequalities, -np.inf), mu)

    (_, violation, lack, *wished), slack = merit(np.zeros(20), np.zeros(4), 0.0)
    above = [max(0.0, height - walls[6]) for height in (state[2], state[2] + state[20])] if walls else [0.0]
    assert (violation, lack) == (0, pytest.approx(sum(above)))
    assert bool(wished) == bool(structure.cost)
    assert np.all(slack > 0)
    cost = terms(state, command, 2.0, numbers, vehicle, slack, mu / slack, mu)
    q, r, g = cost[:20], cost[20:24], cost[[2 * layout.width + 5]]
    eps = 1e-6
    for i in range(25):
        move = eps * np.eye(25)[i]
        pair = [merit(sign * move[:20], sign * move[20:24], sign * move[24])[0][0] for sign in (1, -1)]
        assert np.concatenate([q, r, g])[i] == pytest.approx((pair[0] - pair[1]) / (2 * eps), rel=1e-6, abs=1e-8)


def test_the_end_is_hover_and_nothing_else():
    state, numbers = ca.SX.sym("s", 28), ca.DM.ones(64)
    errors = numeric(ca.Function("errors", [state], [end_errors(state, numbers)]))
    hover = np.append(fp.State(y=(0, 0, 1)).packed(), np.ones(4))
    np.testing.assert_array_equal(errors(hover), 0)
    for y in ((0, 0, -1), (0.6, 0, -0.8), (1, 0, 0), (0, 0.1, np.sqrt(0.99))):
        for one in (fp.State(y=y), fp.State(R=turned_to(y), y=(0, 0, 1))):
            assert np.linalg.norm(errors(np.append(one.packed(), np.ones(4)))) > 1
    # A small error counts by its size: the double tangent of half an angle is the angle to third order.
    first, second = (
        errors(np.append(fp.State(y=(np.sin(a), 0, np.cos(a))).packed(), np.ones(4))) for a in (0.01, 0.02)
    )
    np.testing.assert_allclose(np.linalg.norm(second), 2 * np.linalg.norm(first), rtol=1e-3)


def turned_to(z):
    """The rotation about a horizontal axis that turns e₃ to `z`."""
    axis = np.cross((0, 0, 1), z)
    axis = axis / np.linalg.norm(axis) if np.any(axis) else np.array([1.0, 0.0, 0.0])
    return Rotation.from_rotvec(np.arccos(z[2]) * axis).as_matrix()
