"""The problem that is handed to other solvers is that of a plan."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import flypend as fp
from benchmarks.planned_peers import BROKEN, IMPROVED, IMPROVING, NEAR, Shooting, cost_of, ways_of
from flypend.planning.constraints import Constraints
from flypend.planning.durations import HORIZONS
from flypend.planning.problem import request
from flypend.planning.search import together


def test_a_plan_keeps_the_constraints_of_its_peers() -> None:
    """The stages of a plan break none of them; another start, a state that is moved or a command too large do."""
    vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1))
    asked = request(vehicle, start, "excursion", (0, 0, 0), kept=Constraints(clearance=0))
    plan, shooting = fp.plan(vehicle, start, time_limit=600), Shooting(asked)
    states = np.column_stack([plan.packed, plan.rotor_forces]) / asked.units.states(asked.rotors)
    states, commands = states[:: (len(states) - 1) // shooting.N], plan.commands / asked.units.force
    z = shooting.joined(states, commands)
    assert shooting.broken(z, asked.start) <= BROKEN
    assert np.all(z >= shooting.bounds["lbx"])
    assert np.all(z <= shooting.bounds["ubx"])
    assert shooting.broken(z, asked.start + 0.01) == pytest.approx(0.01)  # own units, in every entry of the start
    moved = states.copy()
    moved[40, 0] += 0.01
    # The difference of a moved state, of order 1, and another is 0.01 but for rounding: 1e-16 of 1, 1e-14 of 0.01.
    assert shooting.broken(shooting.joined(moved, commands), asked.start) >= 0.01 * (1 - 1e-12)


def test_ipopt_does_not_improve_a_plan_that_has_converged() -> None:
    """It improves what the race of guesses found, which was called converged once."""
    vehicle, start = fp.vehicle("hehn2011"), fp.random_starts(60, 2211)[0]
    asked = request(vehicle, start, "effort", (0, 0, 0), kept=Constraints(clearance=0))
    shooting = Shooting(asked)
    quiet = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes", "ipopt.tol": 1e-6}
    solver = ca.nlpsol("improving", "ipopt", shooting.problem, {**quiet, **IMPROVING})
    plan, raced = fp.plan(vehicle, start, "effort"), together(asked, HORIZONS[0], np.inf)
    gains = []
    for ways in (ways_of(asked, plan), (raced.states, raced.commands)):
        answer = shooting.solve(solver, (NEAR, NEAR), asked, *ways)
        assert answer.plan
        gains.append(1 - answer.cost / cost_of(asked, *ways))
    assert plan.status == "converged"
    assert gains[0] < IMPROVED < gains[1]
