"""A plan with its tracking gains as a table in C99, with the function that flies it."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from flypend import errors
from flypend.compile.c99 import REAL, SCRATCH, Precision, call, function, literal
from flypend.compile.program import lower
from flypend.compile.scratch import scratch
from flypend.errors import InputError
from flypend.export.source import ascii_of, rows
from flypend.export.write import fill
from flypend.files.staging import write_texts
from flypend.model import Vehicle
from flypend.model.state import SIZE
from flypend.planning.dynamics import Units
from flypend.planning.feedback import deviation, hovering, regulator
from flypend.planning.result import Plan
from flypend.planning.tracking import FAR_PIVOT, FAR_ROD
from flypend.plants.equations import rotor_step
from flypend.plants.lag import symbolic_timing

DOUBLINGS, TERMS = 5, 8  # of the exponential
SHORT = 1e-5  # of a stage: less than that after its beginning, its beginning is taken


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
    return {name: fill(name, values) for name in ("flypend_plan.h", "flypend_plan.c")}


def _values(plan: Plan, precision: Precision) -> dict[str, Any]:
    feedback, vehicle = regulator(plan), plan.vehicle
    n, (low, high) = len(vehicle.rotor_spins), vehicle.rotor_limits
    programs = [lower(made) for made in (advance(vehicle), deviation(n), hovering(n))]
    number = partial(literal, precision=precision)
    size = max(scratch(program).size for program in programs)
    return {
        "scratch": f"    {REAL} {SCRATCH}[{size}];\n" if size else "",
        "title": ascii_of(f"Plan for {vehicle.name}: {plan.duration:.2f} s, excursion {plan.excursion:.3f} m"),
        "precision": precision, "rotors": n, "stages": len(plan.commands),
        "duration": number(plan.duration), "stage": number(plan.stage), "state": SIZE + n, "off": 18 + n,
        "states": rows(feedback.states, precision), "commands": rows(feedback.commands, precision),
        "gains": rows(feedback.gains, precision),
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
