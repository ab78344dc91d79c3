"""The kernel of the ideal plant: what `compile/loops/runge_kutta.cpp` leaves open, from a problem and a method."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from flypend.compile.llvm.loops import LoopModule, several
from flypend.compile.llvm.target import Target
from flypend.compile.methods import Method
from flypend.compile.problem import LONGEST, Problem
from flypend.compile.program import Program, drop_dead
from flypend.model.state import MAX_STATE

COMPLETED, DIVERGED, SINGULAR, UNDEFINED, TOO_SMALL, TOO_MANY, COLLIDED = range(7)

ARGUMENTS = (
    "starts", "parameters", "queue", "runs", "begin", "until", "rtol", "atol", "max_steps",
    "times", "time_count", "judge_times", "bins", "bin_count", "bin_rate",
    "samples", "reductions", "final", "end", "status", "steps", "knots", "clearance", "part", "stop",
)  # fmt: skip
# The runs fly from `begin` until `until`, s; all times lie between.
INTEGERS = ("runs", "max_steps", "time_count")
REALS = ("begin", "until", "rtol", "atol", "bin_count", "bin_rate")
STRANDS = 4  # divides the length of a state, with or without its tangent


def kernel_module(
    problem: Problem, method: Method, width: int, precision: str = "double", target: Target | None = None
) -> LoopModule:
    """Return the module of the function "kernel" for `problem`; its arguments are `ARGUMENTS`."""
    if problem.size % STRANDS:
        raise ValueError(f"the state length must be a multiple of {STRANDS}, not {problem.size}")
    programs = {name: several(program) for name, program in _programs(problem).items()}
    return LoopModule("runge_kutta", (width, precision, target), programs, {**_sizes(problem), **_tableau(method)})


def _programs(problem: Problem) -> dict[str, Program]:
    rates, project, judging, touch = problem.rates, problem.project, problem.judging, problem.touch
    if len(rates.outputs) == 1:
        rates = replace(rates, outputs=(*rates.outputs, ()))  # no wrench
    onto = drop_dead(Program("onto", project.inputs, project.operations, project.outputs[:1]))
    programs = {"rates": rates, "project": project, "onto": onto}
    if problem.margin is not None:
        programs["margin"] = problem.margin
    if judging is not None:
        programs |= {"gauges": judging.gauges, "values": judging.values, "forces": judging.forces}
    if touch is not None:
        programs |= {"room": touch.room, "touching": touch.touching}
    return programs


def _sizes(problem: Problem) -> dict[str, Any]:
    judging, wrenches = problem.judging, problem.rates.outputs[1:]
    bounds = () if judging is None else judging.bounds
    return {
        "N": problem.size,
        "PARAMETERS": problem.rates.inputs[2],
        "WRENCH": len(wrenches[0]) if wrenches else 0,
        "GAUGES": len(bounds),
        "BOUNDS": bounds,
        "SMOOTH": int(judging is not None and judging.smooth),
        "GUARDED": int(problem.margin is not None),
        "TOUCHES": int(problem.touch is not None),
        "MOST_STATE": float(MAX_STATE),
        "LONGEST": LONGEST,
    }


def _tableau(method: Method) -> dict[str, Any]:
    return {
        "STAGES": method.stages,
        "EXTRA": len(method.C_extra),
        "ESTIMATES": len(method.errors),
        "USES_END": int(method.errors[0][-1] != 0),  # otherwise f at the end is evaluated once a step is accepted
        "ORDER": 8.0 if method.stages > 8 else 5.0,
        "A": _wide(method.A, method.stages),
        "B": method.B,
        "C": method.C,
        "E": np.array(method.errors),
        "A_EXTRA": _wide(method.A_extra, method.stages + 1 + len(method.C_extra)),
        "C_EXTRA": method.C_extra,
        "DENSE": method.dense,
    }


def _wide(rows: Any, columns: int) -> Any:
    """`rows` filled up with zeros to so many columns."""
    return np.pad(rows, ((0, 0), (0, columns - rows.shape[1])))
