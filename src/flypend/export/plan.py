"""A plan with its tracking gains as a table in C99, with the function that flies it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.compile.c99 import REAL, SCRATCH, Precision, call, function, literal
from flypend.compile.program import lower
from flypend.compile.scratch import scratch
from flypend.errors import InputError
from flypend.export.source import ascii_of
from flypend.files.staging import write_texts
from flypend.model import Vehicle
from flypend.model.state import SIZE
from flypend.planning.dynamics import Units
from flypend.planning.feedback import deviation, hovering, regulator
from flypend.planning.result import Plan
from flypend.planning.tracking import FAR_PIVOT, FAR_ROD
from flypend.plants.equations import rotor_step
from flypend.plants.lag import symbolic_timing

NAME = "flypend_plan"
DOUBLINGS, TERMS = 5, 8  # of the exponential
SHORT = 1e-5  # of a stage: less than that after its beginning, its beginning is taken

_HEADER = """\
/* {title}
 *
 * Fly it with {name}_command at every tick, from t = 0 where the plan starts. SI units, world frame with e3 up.
 * A state has 24 numbers: position of the pivot, its velocity, the rotation from body to world row by row, angular
 * velocity in the body frame, direction of the rod and its rate. Predict it to the time at which a command acts, and
 * add that delay to t. */
#ifndef FLYPEND_PLAN_H
#define FLYPEND_PLAN_H

#define FLYPEND_PLAN_ROTORS {rotors}
#define FLYPEND_PLAN_STAGES {stages}
#define FLYPEND_PLAN_DURATION {duration} /* s; then it hovers */

typedef {real} {REAL};

/* Rotor forces (N), within their limits, for a state and the forces of the rotors at time t (s), before 0 as at 0.
 * Returns 0; or 1, and leaves `command`, if rod or pivot are too far from the plan, an input is not a finite number, or
 * the answer would not be: then another law has to take over, for good. */
int {name}_command({REAL} t, const {REAL} *state, const {REAL} *rotors, {REAL} *command);

#endif
"""

_SOURCE = """\
/* {title} */
#include <math.h>
#include "{name}.h"

#ifdef __FAST_MATH__
#error "-ffast-math lets a compiler assume that no number is NaN, and drops the checks below"
#endif

enum {{ ROTORS = FLYPEND_PLAN_ROTORS, STAGES = FLYPEND_PLAN_STAGES, STATE = {state}, OFF = {off} }};
static const {REAL} stage = {stage};
/* Nominal states and rotor forces at the beginning of each stage, the last being hover. */
static const {REAL} states[STAGES + 1][STATE] = {{
{states}
}};
static const {REAL} commands[STAGES + 1][ROTORS] = {{
{commands}
}};
static const {REAL} gains[STAGES + 1][ROTORS][OFF] = {{
{gains}
}};

{functions}

int {name}_command({REAL} t, const {REAL} *state, const {REAL} *rotors, {REAL} *command)
{{
    {scratch}{REAL} here[STATE], nominal[STATE], off[OFF], forces[ROTORS], into, rod, pivot, sum;
    int i, j, k = STAGES;

    sum = {zero} * t; /* 0 as long as all are finite, else not a number */
    for (i = 0; i < 24; i++)
        here[i] = state[i];
    for (i = 0; i < ROTORS; i++)
        here[24 + i] = rotors[i];
    for (i = 0; i < STATE; i++)
        sum += {zero} * here[i];
    if (t < stage * ({REAL})STAGES)
        k = (t > 0) ? (int)(t / stage) : 0;
    into = t - stage * ({REAL})k;
    if (k < STAGES && into > {short} * stage) {{
        {advance}
    }} else {{
        for (i = 0; i < STATE; i++)
            nominal[i] = states[k][i];
    }}
    if (k < STAGES)
        {deviation}
    else
        {hovering}
    rod = off[12] * off[12] + off[13] * off[13] + off[14] * off[14];
    pivot = off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
    for (i = 0; i < ROTORS; i++) {{
        forces[i] = commands[k][i];
        for (j = 0; j < OFF; j++)
            forces[i] -= gains[k][i][j] * off[j];
        sum += {zero} * forces[i];
    }}
    if (!(rod < {far_rod} && pivot < {far_pivot} && sum >= 0))
        return 1;
    for (i = 0; i < ROTORS; i++)
        command[i] = (forces[i] < {low}) ? {low} : ((forces[i] > {high}) ? {high} : forces[i]);
    return 0;
}}
"""


@errors.named_arguments
def export_plan(plan: Plan, folder: str | Path, *, precision: Precision = "float") -> None:
    """Write `plan` with its tracking gains as flypend_plan.h and flypend_plan.c, C99 without allocation.

    Parameters
    ----------
    plan : Plan
        A plan that can be flown.
    folder : path
        Folder to write; one that flypend wrote before is replaced.
    precision : "float" or "double"
        Type of all numbers.

    Raises
    ------
    InputError
        If the plan failed, or the precision cannot hold its numbers.
    """
    write_texts(folder, files(plan, precision))


def files(plan: Plan, precision: Precision) -> dict[str, str]:
    """Name and text of both files of a `plan`. Raises InputError as `export_plan`."""
    if not isinstance(plan, Plan) or not plan:
        raise InputError("plan", "a plan that can be flown", getattr(plan, "reason", "") or repr(plan)[:80])
    values = _values(plan, precision)
    return {f"{NAME}.h": _HEADER.format(**values), f"{NAME}.c": _SOURCE.format(**values)}


def _values(plan: Plan, precision: Precision) -> dict[str, Any]:
    feedback, vehicle = regulator(plan), plan.vehicle
    n, (low, high) = len(vehicle.rotor_spins), vehicle.rotor_limits
    programs = [lower(made) for made in (advance(vehicle), deviation(n), hovering(n))]

    def number(value: float) -> str:
        return literal(float(value), precision)

    def rows(values: Any) -> str:
        return ",\n".join("    {" + ", ".join(number(value) for value in row) + "}" for row in values)

    gains = ",\n".join(f"    {{\n{rows(each)}\n    }}" for each in feedback.gains)
    size = max(scratch(program).size for program in programs)
    return {
        "scratch": f"{REAL} {SCRATCH}[{size}];\n    " if size else "",
        "title": ascii_of(f"Plan for {vehicle.name}: {plan.duration:.2f} s, excursion {plan.excursion:.3f} m"),
        "name": NAME, "REAL": REAL, "real": precision, "rotors": n, "stages": len(plan.commands),
        "duration": number(plan.duration), "stage": number(plan.stage), "state": SIZE + n, "off": 18 + n,
        "states": rows(feedback.states), "commands": rows(feedback.commands), "gains": gains,
        "functions": "\n\n".join(function(program, precision) for program in programs),
        "advance": call(programs[0], ["states[k]", "commands[k]", "&into"], ["nominal"]),
        "deviation": call(programs[1], ["nominal", "here"], ["off"]),
        "hovering": call(programs[2], ["nominal", "here"], ["off"]),
        "zero": number(0.0), "short": number(SHORT), "low": number(low), "high": number(high),
        "far_rod": number(FAR_ROD**2), "far_pivot": number((FAR_PIVOT * Units.of(vehicle).length) ** 2),
    }  # fmt: skip


def advance(vehicle: Vehicle) -> ca.Function:
    """Return (state with rotor forces, command, time) → state with rotor forces after that time of a stage."""
    n, lag = len(vehicle.rotor_spins), vehicle.rotor_lag
    begin, command, into = ca.SX.sym("begin", SIZE + n), ca.SX.sym("command", n), ca.SX.sym("into")
    timing = symbolic_timing(lag, into, _exponential) if lag > 0 else ca.vertcat(into, 0, 0, 0)
    step = rotor_step(vehicle, windy=False)
    moved, rotors = step(begin[:SIZE], begin[SIZE:], command, np.zeros(6), timing)
    return ca.Function("advance", [begin, command, into], [ca.densify(ca.cse(ca.vertcat(moved, rotors)))])


def _exponential(value: Any) -> Any:
    """Return e^value without the C library: a series for a part of the value, squared."""
    part = value / 2**DOUBLINGS
    total = ca.SX(1)
    for k in range(TERMS, 0, -1):
        total = 1 + part / k * total
    for _ in range(DOUBLINGS):
        total = total**2
    return total
