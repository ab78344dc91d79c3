"""The plan of least effort by crocoddyl: box-constrained FDDP, its stages called in Python, compiled C within.

It knows no constraint on states, so the end is a penalty alone, which grows until the end is within its tolerances.
"""

from __future__ import annotations

import time
from typing import Any

import casadi as ca
import crocoddyl
import numpy as np

from benchmarks.planned_peers import ITERATIONS, TOLERANCE, Answer, Shooting, compiled
from flypend.compile.numeric import as_numpy
from flypend.planning.inequalities import EFFORT, HIGH, LOW
from flypend.planning.problem import Request
from flypend.planning.solver import Settings

GROWTH = 10.0  # of the weight of the end, from one solve to the next, which begins where the last ended


class Stage(crocoddyl.ActionModelAbstract):
    """A stage: `step` and its derivatives (x, u) → x, A, B, and the weight of `effort`."""

    def __init__(self, step: Any, derivatives: Any, width: int, rotors: int) -> None:
        crocoddyl.ActionModelAbstract.__init__(self, crocoddyl.StateVector(width), rotors, 0)
        self._step, self._derivatives, self._shape = step, derivatives, (width, rotors)
        self.effort = 0.0
        self.spent = 0.0  # s, in the C of derivatives and steps

    def calc(self, data: Any, x: Any, u: Any = None) -> None:
        """Step."""
        begin = time.process_time()
        data.xnext = self._step(x, u)
        self.spent += time.process_time() - begin
        data.cost = self.effort * float((u - 1) @ (u - 1)) / 2

    def calcDiff(self, data: Any, x: Any, u: Any = None) -> None:
        """Differentiate."""
        begin = time.process_time()
        A, B = self._derivatives(x, u)
        self.spent += time.process_time() - begin
        width, rotors = self._shape
        data.Fx, data.Fu = A.reshape((width, width), order="F"), B.reshape((width, rotors), order="F")
        data.Lu, data.Luu = self.effort * (u - 1), self.effort * np.eye(rotors)


class End(crocoddyl.ActionModelAbstract):
    """The end: half the squares of its errors times a `weight`, its Hessian by Gauss and Newton."""

    def __init__(self, errors: Any, jacobian: Any, width: int, rotors: int) -> None:
        crocoddyl.ActionModelAbstract.__init__(self, crocoddyl.StateVector(width), rotors, 0)
        self._errors, self._jacobian, self.weight = errors, jacobian, Settings().end_weight

    def calc(self, data: Any, x: Any, u: Any = None) -> None:
        """Evaluate."""
        errors = self._errors(x)
        data.xnext, data.cost = x, self.weight * float(errors @ errors) / 2

    def calcDiff(self, data: Any, x: Any, u: Any = None) -> None:
        """Differentiate."""
        errors = self._errors(x)
        J = self._jacobian(x).reshape((len(errors), len(x)), order="F")
        data.Lx, data.Lxx = self.weight * (J.T @ errors), self.weight * (J.T @ J)


class Boxed:
    """The problem of `asked`, as `shooting` has it, for crocoddyl."""

    def __init__(self, shooting: Shooting, asked: Request) -> None:
        x, u = ca.SX.sym("x", shooting.width - 1), ca.SX.sym("u", asked.rotors)
        led, errors = ca.densify(shooting.step(x, u)), ca.densify(shooting.errors(x))
        by = [ca.densify(ca.vec(ca.jacobian(led, each))) for each in (x, u)]
        by_end = ca.densify(ca.vec(ca.jacobian(errors, x)))
        functions = (
            ca.Function("step", [x, u], [led]), ca.Function("derivatives", [x, u], by),
            ca.Function("errors", [x], [errors]), ca.Function("jacobian", [x], [by_end]),
        )  # fmt: skip
        generator = ca.CodeGenerator("boxed.c")
        for function in functions:
            generator.add(function)
        library = compiled("boxed", lambda _: generator.generate())
        step, derivatives, errors, jacobian = (as_numpy(ca.external(each.name(), library)) for each in functions)
        self._shooting, n = shooting, asked.rotors
        self._stage = Stage(step, derivatives, x.numel(), n)
        self._stage.u_lb, self._stage.u_ub = (np.full(n, asked.numbers[each]) for each in (LOW, HIGH))
        self._end = End(errors, jacobian, x.numel(), n)
        self._errors = errors

    def solve(self, asked: Request, states: Any, commands: Any) -> Answer:
        """Solve; see `planned_peers.Solve`."""
        self._stage.effort, self._end.weight = float(asked.numbers[EFFORT]), Settings().end_weight
        self._stage.spent, done = 0.0, 0
        begin = time.process_time()
        problem = crocoddyl.ShootingProblem(asked.start, [self._stage] * len(commands), self._end)
        solver = crocoddyl.SolverBoxFDDP(problem)
        solver.th_stop = TOLERANCE
        xs, us = [asked.start, *states[1:]], list(np.clip(commands, self._stage.u_lb, self._stage.u_ub))
        while done < ITERATIONS:
            solver.solve(xs, us, ITERATIONS - done, False)
            xs, us = [np.array(x) for x in solver.xs], [np.array(u) for u in solver.us]
            done += solver.iter + 1
            if np.max(np.abs(self._errors(xs[-1]))) <= 1 or self._end.weight >= Settings().most_end_weight:
                break
            self._end.weight *= GROWTH
        took, ways = time.process_time() - begin, (np.array(xs), np.array(us))
        return self._shooting.judged(asked, self._shooting.joined(*ways), *ways, done, took, self._stage.spent)
