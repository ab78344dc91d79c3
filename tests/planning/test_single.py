"""Programs of one problem do what those of eight problems do, and their recursion finds the regulator of hover."""

from functools import partial

import casadi as ca
import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

import flypend as fp
from flypend.compile.llvm.stagewise import lanes
from flypend.compile.numeric import as_numpy
from flypend.planning import feedback
from flypend.planning.inequalities import Structure
from flypend.planning.kernels import kernels
from flypend.planning.method import Problem
from flypend.planning.race import Race, work
from flypend.planning.request import request
from flypend.planning.riccati import backward, packed_cost, packed_to_go
from flypend.planning.scaled import Units
from flypend.planning.search import Job, guessed
from flypend.planning.single import laid, single
from flypend.planning.solver import Solver

HEHN = fp.vehicle("hehn2011")
one = partial(lanes, width=1)


def asked_of(vehicle=HEHN, seed=501):
    start = fp.random_starts(1, seed=seed)[0]
    return request(vehicle, start, "excursion", np.zeros(3))


@pytest.mark.parametrize("rotors", [4, 6])
def test_the_recursion_by_rows_is_that_by_symbols(rotors):
    """Six rotors and 22 coordinates: rows end with numbers of no account."""
    rng, rows = np.random.default_rng(rotors), laid(rotors, Structure())
    shape, w = rows.shape, rows.width
    n, m = shape.n, shape.k
    A, B = (rng.normal(size=p.shape) * np.array(ca.DM(p, 1)) for p in (shape.A, shape.B))
    Q = rng.normal(size=(n, n))
    Q = np.array(ca.project(ca.DM(Q @ Q.T), rows.Q)) + 30 * np.eye(n)
    vectors = [ca.DM(rng.normal(size=length)) for length in (n, n, m)]
    R, (c, g, v), root = ca.DM(rng.uniform(0.5, 2, m)), rng.normal(size=3), rng.normal(size=(n, n))
    cost = (ca.DM(Q), R, *vectors, 3.0 + c, g)
    end = (ca.DM(root @ root.T), ca.DM(rng.normal(size=n)), ca.DM(rng.normal(size=n)), 30.0, g, v)
    d, damping = rng.normal(size=n), np.array([0.3, 0.7])

    def column(values):
        return np.array(ca.DM(values)).ravel()

    nonzeros = [column(ca.project(ca.DM(X), p).nonzeros()) for X, p in ((A, shape.A), (B, shape.B))]
    V, K = as_numpy(backward(shape))(column(packed_to_go(*end)), *nonzeros, d, column(packed_cost(*cost)), damping)
    F, to_go, gains = np.zeros((n, w)), one(2, rows.to_go), one(1, shape.gains)
    F[:, :n], F[:, n : n + m] = A, B
    to_go[1, :, 0] = column(ca.evalf(rows.end(*map(ca.SX, end))))
    of_stage = column(ca.evalf(rows.cost(*map(ca.SX, cost))))
    single(rotors, Structure()).backward(1, to_go[1:], F, d, of_stage, damping, to_go, gains)
    np.testing.assert_allclose(gains[0, :, 0], K, rtol=1e-9, atol=1e-10)  # the condition of S times rounding
    found = to_go[0, : n * w, 0].reshape(n, w)[:, :n]
    np.testing.assert_allclose(found[np.triu_indices(n)], V[: n * (n + 1) // 2], rtol=1e-9, atol=1e-8)
    np.testing.assert_allclose(to_go[0, (n + 2) * w : (n + 2) * w + 3, 0], V[-3:], rtol=1e-9)


def test_gains_in_hover_solve_the_algebraic_riccati_equation():
    """After 25 √(l/g) of an unstable pendulum: a cost to go that is not symmetric to the last bit would be far off."""
    plan = fp.plan(HEHN, fp.State(y=(0, 0.1, np.sqrt(0.99))), time_limit=60)
    units, n, shape = Units.of(HEHN), 4, laid(4, Structure()).shape
    hover = feedback._hover(plan) / units.states(n)
    compiled, arrays = single(n, Structure()), [one(9, 28), one(8, 4), one(4), one(31)]
    states, forces, timing, numbers = arrays
    states[:], forces[:] = hover[None, :, None], 1.0
    timing[:, 0] = fp.planning.feedback.step_timing(HEHN.rotor_lag / units.time, plan.stage / units.time)
    numbers[:, 0] = units.numbers(HEHN)
    d, F = one(8, shape.n), one(8, *compiled.slopes)
    compiled.linearised(8, states, states[1:], forces, timing, numbers, d, F)
    rows = F[0, :, 0].reshape(shape.n, -1)
    A, B = rows[:, :20], rows[:, 20:24]
    cost = feedback._cost(n)
    w = laid(n, Structure()).width
    Q = np.array(ca.DM(laid(n, Structure()).Q, cost[2 * w + n + 2 :][: laid(n, Structure()).Q.nnz()]))
    R = np.diag(cost[2 * w : 2 * w + n])
    P = solve_discrete_are(A, B, Q, R)
    K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
    # Position and velocity enter in SI units; what is left of the transient after 25 √(l/g) is below a thousandth.
    gains = (
        feedback.regulator(plan).gains[-1][:, :6]
        / units.force
        * np.repeat([units.length, units.length / units.time], 3)
    )
    np.testing.assert_allclose(gains, K[:, :6], rtol=1e-3, atol=1e-3)


def test_a_solver_of_one_problem_does_what_its_lane_does():
    asked = asked_of()
    problem, states, commands = guessed([Job(asked, style) for style in range(8)], 12.5)
    race = Race(single(4, asked.structure), problem, states, commands, rounds={})
    together = Solver(kernels(4, asked.structure), problem, states, commands)
    for _ in range(3):
        race.improve()
        together.improve()
        # Rounding grows by the condition of the problem.
        np.testing.assert_allclose(race.merit, together.merit, rtol=1e-6)


def test_a_race_gives_up_the_dearest():
    asked = asked_of()
    guesses = guessed([Job(asked, style) for style in range(8)], 12.5)
    race = Race(single(4, asked.structure), *guesses, rounds={2: 3})
    for _ in range(2):
        race.improve()
    alone = Race(single(4, asked.structure), *guesses, rounds={})
    for _ in range(2):
        alone.improve()
    going = np.flatnonzero(~race.stuck)
    assert len(going) == 3
    assert np.max(alone.cost[going]) <= np.min(np.delete(alone.cost, going))
    assert np.all(np.isinf(np.delete(race.cost, going)))
    assert work({2: 3}, 8, 5) == 8 + 8 + 3 + 3 + 3


def test_problems_in_turn_share_memory_without_seeing_each_other():
    asked = asked_of()
    problem, states, commands = guessed([Job(asked, style) for style in range(8)], 12.5)
    race = Race(single(4, asked.structure), problem, states, commands, rounds={})

    def column(values):
        own = one(*values.shape[:-1])
        own[..., 0] = values[..., 5]
        return own

    own = Problem(problem.stages, *(column(a) for a in (problem.timing, problem.vehicle, problem.numbers)))
    alone = Solver(single(4, asked.structure), own, column(states), column(commands))
    for _ in range(4):
        race.improve()
        alone.improve()
    np.testing.assert_array_equal(alone.states[..., 0], race.iterate(5)[0])
