"""The problem that is handed to other solvers is that of a plan."""

from __future__ import annotations

import numpy as np
import pytest

import flypend as fp
from benchmarks.planned_peers import BROKEN, Shooting
from flypend.planning.constraints import Constraints
from flypend.planning.problem import request


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
