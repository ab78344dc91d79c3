"""Programs of one problem do what those of eight problems do, and their recursion finds the regulator of hover."""

from dataclasses import replace
from functools import partial

import casadi as ca
import numpy as np
import pytest
from scipy.linalg import solve_discrete_are
from scipy.spatial.transform import Rotation

import flypend as fp
from flypend.compile.llvm.stagewise import lanes
from flypend.compile.numeric import as_numpy
from flypend.planning import feedback
from flypend.planning.dynamics import Units
from flypend.planning.inequalities import Structure
from flypend.planning.multistart import Job, Race, work
from flypend.planning.problem import request
from flypend.planning.riccati import backward
from flypend.planning.search import make_guesses
from flypend.planning.solver import Problem, Solver, programs
from flypend.plants.lag import step_timing

HEHN = fp.vehicle("hehn2011")
one = partial(lanes, width=1)


def asked_of(vehicle=HEHN, seed=501):
    start = fp.random_starts(1, seed=seed)[0]
    return request(vehicle, start, "excursion", np.zeros(3))


@pytest.mark.parametrize("rotors", [4, 6])
def test_the_recursion_of_one_problem_is_that_of_eight(rotors):
    """Six rotors and 22 coordinates: rows end with numbers of no account."""
    rng, compiled = np.random.default_rng(rotors), programs(rotors, Structure(), lanes=False)
    rows, columns = compiled.layout, replace(compiled.layout, block=1)
    n, m, w = rows.n, rows.m, rows.width
    A, B = (rng.normal(size=p.shape) * np.array(ca.DM(p, 1)) for p in (rows.A, rows.B))
    Q = rng.normal(size=(n, n))
    Q = np.array(ca.project(ca.DM(Q @ Q.T), rows.Q)) + 30 * np.eye(n)
    vectors = [ca.DM(rng.normal(size=length)) for length in (n, n, m)]
    R, (c, g, v), root = ca.DM(rng.uniform(0.5, 2, m)), rng.normal(size=3), rng.normal(size=(n, n))
    cost = (ca.DM(Q), R, *vectors, 3.0 + c, g)
    end = (ca.DM(root @ root.T), ca.DM(rng.normal(size=n)), ca.DM(rng.normal(size=n)), 30.0, g, v)
    d, damping = rng.normal(size=n), np.array([0.3, 0.7])

    def column(values):
        return np.array(ca.DM(values)).ravel()

    def memory(layout):
        slopes, after, of_stage = layout.slopes(A, B), layout.to_go(*map(ca.SX, end)), layout.cost(*map(ca.SX, cost))
        return [column(ca.evalf(ca.SX(values))) for values in (after, slopes, of_stage)]

    after, F, of_stage = memory(columns)
    eight = [lanes(len(values)) for values in (after, F, d, of_stage, damping)]
    for array, values in zip(eight, (after, F, d, of_stage, damping), strict=True):
        array.T[:] = values
    V, K = lanes(columns.of_to_go), lanes(columns.of_gains)
    backward(columns)(1, *eight, V, K)
    V, K = V[:, 3], K[:, 3]
    to_go, gains = one(2, rows.of_to_go), one(1, rows.of_gains)
    to_go[1, :, 0], F, of_stage = memory(rows)
    compiled.backward(1, to_go[1:], F, d, of_stage, damping, to_go, gains)
    np.testing.assert_allclose(gains[0, :, 0], K, rtol=1e-9, atol=1e-10)  # the condition of S times rounding
    found = to_go[0, : n * w, 0].reshape(n, w)[:, :n]
    np.testing.assert_allclose(found.T[np.tril_indices(n)], V[: n * (n + 1) // 2], rtol=1e-9, atol=1e-8)
    np.testing.assert_allclose(to_go[0, rows.of_shared : rows.of_shared + 3, 0], V[-3:], rtol=1e-9)


def test_gains_in_hover_solve_the_algebraic_riccati_equation():
    """After 25 √(l/g) of an unstable pendulum: a cost to go that is not symmetric to the last bit would be far off."""
    plan = fp.plan(HEHN, fp.State(y=(0, 0.1, np.sqrt(0.99))), time_limit=60)
    units, n = Units.of(HEHN), 4
    hover = feedback._hover(plan) / units.states(n)
    compiled, arrays = programs(n, Structure(), lanes=False), [one(9, 28), one(8, 4), one(4), one(31)]
    states, forces, timing, numbers = arrays
    states[:], forces[:] = hover[None, :, None], 1.0
    timing[:, 0] = step_timing(HEHN.rotor_lag / units.time, plan.stage / units.time)
    numbers[:, 0] = units.numbers(HEHN)
    layout = compiled.layout
    d, F = one(8, layout.n), one(8, layout.of_slopes)
    compiled.linearised(8, states, states[1:], forces, timing, numbers, d, F)
    rows = F[0, :, 0].reshape(layout.n, -1)
    A, B = rows[:, :20], rows[:, 20:24]
    cost = feedback._cost(n)
    w = layout.width
    Q = np.array(ca.DM(layout.Q, cost[2 * w + n + 2 :][: layout.Q.nnz()]))
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
    problem, states, commands = make_guesses([Job(asked, style) for style in range(8)], 12.5)
    race = Race(programs(4, asked.structure, lanes=False), problem, states, commands, rounds={})
    together = Solver(programs(4, asked.structure, lanes=True), problem, states, commands)
    for _ in range(3):
        race.improve()
        together.improve()
        # Rounding grows by the condition of the problem.
        np.testing.assert_allclose(race.measures.cost, together.measures.cost, rtol=1e-6)


def test_a_race_gives_up_the_dearest():
    asked = asked_of()
    guesses = make_guesses([Job(asked, style) for style in range(8)], 12.5)
    race = Race(programs(4, asked.structure, lanes=False), *guesses, rounds={2: 3})
    for _ in range(2):
        race.improve()
    alone = Race(programs(4, asked.structure, lanes=False), *guesses, rounds={})
    for _ in range(2):
        alone.improve()
    going = np.flatnonzero(~race.measures.stuck)
    assert len(going) == 3
    assert np.max(alone.measures.cost[going]) <= np.min(np.delete(alone.measures.cost, going))
    assert np.all(np.isinf(np.delete(race.measures.cost, going)))
    assert work({2: 3}, 8, 5) == 8 + 8 + 3 + 3 + 3


def test_problems_in_turn_share_memory_without_seeing_each_other():
    asked = asked_of()
    problem, states, commands = make_guesses([Job(asked, style) for style in range(8)], 12.5)
    race = Race(programs(4, asked.structure, lanes=False), problem, states, commands, rounds={})

    def column(values):
        own = one(*values.shape[:-1])
        own[..., 0] = values[..., 5]
        return own

    own = Problem(problem.stages, *(column(a) for a in (problem.timing, problem.vehicle, problem.numbers)))
    alone = Solver(programs(4, asked.structure, lanes=False), own, column(states), column(commands))
    for _ in range(4):
        race.improve()
        alone.improve()
    np.testing.assert_array_equal(alone.states[..., 0], race.iterate(5)[0])


def test_every_guess_brings_a_rod_that_hangs_at_rest_over_its_pivot():
    """There nothing is to be pumped: a guess has to push first."""
    asked = request(HEHN, fp.State(y=(0, 0, -1)), "excursion", (0, 0, 0))
    _, states, _ = make_guesses([Job(asked, style) for style in range(8)], 12.5)
    assert np.all(np.max(states[:, 20], axis=0) > 0)


@pytest.mark.parametrize("angle", [0.4, -1.9, 3.0])
def test_from_a_hover_of_any_heading_a_deviation_is_what_the_body_sees(angle):
    """Turned about the vertical of the pivot, a deviation changes in its heading alone."""
    off, yawed = as_numpy(feedback.hover_deviation(4)), Rotation.from_rotvec([0, 0, 0.7]).as_matrix()
    hover, tilt = fp.State(x=(0.3, -0.2, 0.1), R=yawed, y=(0, 0, 1)), Rotation.from_rotvec([0.02, -0.03, 0]).as_matrix()
    y = np.array([0.03, 0.05, 1.0]) / np.linalg.norm([0.03, 0.05, 1.0])
    near = fp.State(
        x=(0.4, -0.1, 0.3),
        x_dot=(0.1, 0.2, 0.3),
        R=tilt @ yawed,
        omega=(0.1, -0.2, 0.3),
        y=y,
        y_dot=np.cross((0, 0.1, 0), y),
    )
    turn = Rotation.from_rotvec([0, 0, angle]).as_matrix()

    def turned(s):
        return fp.State(
            x=hover.x + turn @ (s.x - hover.x), x_dot=turn @ s.x_dot, R=turn @ s.R, omega=s.omega,
            y=turn @ s.y, y_dot=turn @ s.y_dot,
        )  # fmt: skip

    def seen(s):
        return off(np.append(hover.packed(), np.ones(4)), np.append(s.packed(), np.ones(4)))

    rest = np.arange(22) != feedback.ATTITUDE.stop - 1
    np.testing.assert_allclose(seen(turned(near))[rest], seen(near)[rest], atol=1e-9)
    heading = np.clip(2 * np.tan(angle / 2), -feedback.MOST_HEADING, feedback.MOST_HEADING)
    np.testing.assert_allclose(seen(turned(hover)), np.where(rest, 0, heading), atol=1e-9)
