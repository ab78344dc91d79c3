"""Plans as C99: a table with the function that tracks it, or with iterations that improve it in flight.

The second is of fixed work: see `planning.real_time` for the method. Stage, derivatives, barrier and end are the
programs of `planning`, with the vehicle's numbers in them. The loops around them are those of `planning.solver` and
`compile/loops/riccati.cpp`, written for a processor with little memory: no cost to go is kept, since its slopes along a
step are the multipliers, which a recursion through the stages gives as well.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.building import builds
from flypend.compile.c99 import PRECISIONS, REAL, SCRATCH, Precision, call, define_real, function, literal
from flypend.compile.program import Program, lower
from flypend.compile.scratch import scratch
from flypend.errors import InputError
from flypend.export.source import ascii_of, literals, rows
from flypend.export.write import fill
from flypend.files.staging import write_texts
from flypend.model import Vehicle
from flypend.model.state import SIZE
from flypend.planning.dynamics import LEAST_ROOM, Stage, Units
from flypend.planning.feedback import deviation, hover_deviation, regulator
from flypend.planning.inequalities import HIGH, LOW, SHARED, Barrier, Structure
from flypend.planning.planner import coarsen
from flypend.planning.problem import Request
from flypend.planning.real_time import MOST_FAILED, SETTINGS, SUBSTEPS, SUNK
from flypend.planning.result import Plan
from flypend.planning.riccati import Layout
from flypend.planning.tracking import FAR_PIVOT, FAR_ROD
from flypend.plants.equations import rotor_step
from flypend.plants.lag import step_timing, symbolic_timing

Array = NDArray[np.float64]

DOUBLINGS, TERMS = 5, 8  # of the exponential
SHORT = 1e-5  # of a stage: less than that after its beginning, its beginning is taken
# Stages last so many of a plan's. Of 150 stages of 20 ms on hehn2011 50 are left; in 38, excursions are up to a fifth
# larger.
COARSER = 3
PHASES = 3  # iterations in a stage: one every 20 ms on hehn2011
# Shares of the stages of the horizon that remain at least, and of those of hover behind the plan: a third and two
# thirds, as in `real_time`.
LEAST, TAIL = 1 / 3, 2 / 3
LOG_TERMS = {"float": 4, "double": 10}  # of the series of the logarithm, whose argument is at most 0.172
# By this share of the merit a step may raise it: what rounding does to some 500 sums.
ROUNDING = {"float": 1e-6, "double": 0.0}
TINY = {"float": 1e-30, "double": 1e-300}  # numbers whose logarithm is not taken: a slack that is used up
OWN = (  # of `SETTINGS`, by their own names
    "barrier", "spread", "state_damping", "damping", "worse", "better", "least_damping", "most_damping", "room", "turn",
)  # fmt: skip


@errors.named_arguments
@builds
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
    feedback, n = regulator(plan), len(plan.vehicle.rotor_spins)
    programs = [lower(made) for made in (advance(plan.vehicle), deviation(n), hover_deviation(n))]
    size = max(scratch(program).size for program in programs)
    return _of_both(plan, precision) | {
        "scratch": f"    {REAL} {SCRATCH}[{size}];\n" if size else "",
        "title": ascii_of(f"Plan for {plan.vehicle.name}: {plan.duration:.2f} s, excursion {plan.excursion:.3f} m"),
        "state": SIZE + n, "off": 18 + n, "zero": literal(0.0, precision),
        "states": rows(feedback.states, precision), "commands": rows(feedback.commands, precision),
        "gains": rows(feedback.gains, precision),
        "functions": "\n\n".join(function(program, precision) for program in programs),
        "advance": call(programs[0], ["states[k]", "commands[k]", "&into"], ["nominal"]),
        "deviation": call(programs[1], ["nominal", "here"], ["off"]),
        "hovering": call(programs[2], ["nominal", "here"], ["off"]),
    }  # fmt: skip


def _of_both(plan: Plan, precision: Precision) -> dict[str, Any]:
    """What the templates of both ways to fly a `plan` take."""
    (low, high), far = plan.vehicle.rotor_limits, FAR_PIVOT * Units.of(plan.vehicle).length
    numbers = {
        "duration": plan.duration, "stage": plan.stage, "short": SHORT, "low": low, "high": high,
        "far_rod": FAR_ROD**2, "far_pivot": far**2,
    }  # fmt: skip
    written = {name: literal(value, precision) for name, value in numbers.items()}
    counts = {"rotors": len(plan.vehicle.rotor_spins), "stages": len(plan.commands)}
    return written | counts | {"real": define_real(precision)}


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


# Planned again in flight ----------------------------------------------------------------------------------------------


@errors.named_arguments
def export_nmpc(plan: Plan, folder: str | Path, *, precision: Precision = "float") -> None:
    """Write `plan` with iterations that improve it in flight as flypend_nmpc.h and flypend_nmpc.c.

    It is C99 without allocation, with a bounded number of operations per call, in stages three times as long as the
    plan's. External forces and wrong masses are not estimated; feedback and iterations correct for them.

    Parameters
    ----------
    plan : Plan
        A plan that can be flown, without constraints beyond the limits of the rotors, on a gimbal.
    folder : path
        Folder to write; one that flypend wrote before is replaced.
    precision : "float" or "double"
        Type of all numbers.

    Raises
    ------
    InputError
        If the plan failed, does not end in inverted hover, has a path or windows, or cannot be flown in so few stages,
        or its vehicle has a hub or cup.
    """
    errors.one_of("precision", precision, PRECISIONS)
    values = _again(*coarsen(plan, COARSER), precision)
    write_texts(folder, {name: fill(name, values) for name in ("flypend_nmpc.h", "flypend_nmpc.c")})


def sizes(stages: int) -> tuple[int, int]:
    """Return the least number of stages of a horizon, and of hover behind a plan, of so many `stages`."""
    return math.ceil(LEAST * stages), math.ceil(TAIL * stages)


def programs_of(asked: Request) -> tuple[dict[str, Program], Layout]:
    """Return the programs of an iteration of what is `asked`, by name, and how their matrices lie in memory."""
    n, stage = asked.rotors, Stage(asked.rotors)
    barrier, numbers = Barrier(stage, Structure()), ca.DM(asked.numbers)
    vehicle = ca.SX(ca.DM(asked.units.numbers(asked.vehicle)))

    parts = ca.substitute([*stage.derivatives()], [stage.machine.numbers], [vehicle])
    gap, A, B = parts[0], *map(ca.sparsify, parts[1:])
    layout = Layout(A.sparsity(), B.sparsity(), barrier.pattern + ca.Sparsity.diag(stage.coordinates))
    inputs = [stage.before, stage.after, stage.command, stage.timing]
    found = {"linearised": _function("linearised", inputs, gap, layout.slopes(A, B))}
    state, given, shared = ca.SX.sym("state", 24 + n), ca.SX.sym("command", n), ca.SX.sym("shared")
    slack, dual = (ca.SX.sym(name, barrier.inequalities) for name in ("s", "z"))
    moves = [ca.SX.sym("delta", stage.coordinates), ca.SX.sym("upsilon", n), ca.SX.sym("epsilon")]
    point, mu = [state, given, shared, numbers, vehicle], SETTINGS.barrier
    summary, new = barrier.values()(*point, slack, 0)
    found["values"] = _function("values", [state, given, shared], summary[0], new)
    cost = barrier.terms(layout)(*point, slack, dual, mu)
    found["terms"] = _function("terms", [state, given, shared, slack, dual], cost)
    _, change, shares = barrier.steps()(*point, slack, dual, mu, *moves)
    found["steps"] = _function("steps", [state, given, shared, slack, dual, *moves], change, shares[1])
    missed, to_go = barrier.end(layout)(state, numbers, SETTINGS.end_weight, np.zeros(barrier.end_size))
    found["errors"] = _function("errors", [state], missed)
    found["ending"] = _function("ending", [state], to_go)

    rollout = stage.rollout()
    nominal, old, held, gains, at, length, epsilon, _, timed, _ = rollout.sx_in()
    limits = ca.DM([asked.numbers[LOW], asked.numbers[HIGH], SETTINGS.room])
    led = rollout(nominal, old, held, gains, at, length, epsilon, limits, timed, vehicle)
    found["rollout"] = _function("rollout", [nominal, old, held, gains, at, length, epsilon, timed], *led)
    return {name: lower(made) for name, made in found.items()}, layout


def _function(name: str, inputs: Sequence[Any], *outputs: Any) -> ca.Function:
    return ca.Function(name, [*inputs], ca.cse([ca.densify(output) for output in outputs]))


def table_of(plan: Plan) -> tuple[Array, Array, Array]:
    """Return states (stages + 1, 24 + n) and commands (stages + 1, n) of a `plan`, own units, the last of them hover.

    Then its gains (stages, n, 18 + n), SI units.
    """
    feedback, units = regulator(plan), Units.of(plan.vehicle)
    states = feedback.states.copy()
    states[:, :3] -= plan.target
    return states / units.states(feedback.commands.shape[1]), feedback.commands / units.force, feedback.gains[:-1]


def _again(plan: Plan, asked: Request, precision: Precision) -> dict[str, Any]:
    """Return what the templates take for a coarse `plan` that answers what is `asked`."""
    vehicle, units, n = plan.vehicle, Units.of(plan.vehicle), asked.rotors
    programs, layout = programs_of(asked)
    flown = {made.name(): lower(made) for made in (advance(plan.vehicle), deviation(n))}
    everything = programs | flown
    stages, h = len(plan.commands), plan.stage / units.time
    least, tail = sizes(stages)
    of_state, lag = units.states(n), vehicle.rotor_lag / units.time
    own, forces, gains = table_of(plan)
    low, high = (float(limit) for limit in asked.numbers[LOW : HIGH + 1])
    inside = SETTINGS.inside * (high - low)
    number, numbers, table = (partial(write, precision=precision) for write in (literal, literals, rows))

    def integers(values: Any) -> str:
        return ", ".join(str(int(value)) for value in values)

    def calling(name: str, inputs: Sequence[str], outputs: Sequence[str], memory: str = "n->scratch") -> str:
        """Return the line of C that calls the program `name`."""
        return call(everything[name], inputs, outputs, memory)

    F, Q = layout.F, layout.Q
    Q_row, Q_column = Q.get_triplet()
    timings = [step_timing(lag, h * (1 - phase / PHASES)) for phase in range(PHASES)]
    here, old = ["x[k]", "u[k]"], ["x[k]", "u[k]", "&n->shared"]
    x, u, slack, dual = (f"n->{name}[first + k - 1]" for name in ("best.states", "best.commands", "slack", "dual"))
    return _of_both(plan, precision) | {
        "title": ascii_of(f"nmpc for {vehicle.name}: {plan.duration:.2f} s, excursion {plan.excursion:.3f} m"),
        "all": stages + tail, "least": least, "phases": PHASES, "ahead": SUBSTEPS,
        "slopes": layout.of_slopes, "to_go": layout.of_to_go, "cost": layout.of_stage,
        "errors": len(programs["errors"].outputs[0]), "curved": Q.nnz(),
        "scratch": max(scratch(program).size for program in everything.values()),
        "tick": number(plan.stage / PHASES), "timings": table(timings),
        "units": numbers(of_state), "target": numbers(plan.target),
        "states": table(own), "commands": table(forces), "gains": table(gains),
        "F_column": integers(F.colind()), "F_row": integers(F.row()),
        "Q_row": integers(Q_row), "Q_column": integers(Q_column),
        "programs": "\n\n".join(function(program, precision) for program in everything.values()),
        "tiny": number(TINY[precision]), "huge": number(1e30), "low_256": number(1 / 256), "half": number(0.5),
        "root_half": number(math.sqrt(0.5)), "root_two": number(math.sqrt(2)), "log_two": number(math.log(2)),
        "log_terms": LOG_TERMS[precision], "rounding": number(ROUNDING[precision]),
        "weight": number(SETTINGS.end_weight), **{name: number(getattr(SETTINGS, name)) for name in OWN},
        "ball_share": number(1 + SETTINGS.margin[0]), "ball_more": number(SETTINGS.margin[1]),
        "ball_weight": number(asked.numbers[SHARED]), "ball_sunk": number(SUNK * asked.numbers[SHARED]),
        "least_room": number(LEAST_ROOM), "price": number(1.2),
        "tries": 1 + len(SETTINGS.shrinks), "shrinks": numbers([1.0, *SETTINGS.shrinks]),
        "inside_low": number(low + inside), "inside_high": number(high - inside), "most_failed": MOST_FAILED,
        "sums_10": ", ".join(f"s{i} = 0" for i in range(10)), "sums_8": ", ".join(f"s{i} = 0" for i in range(8)),
        "add_10": " ".join(f"s{i} += by * row[{i}];" for i in range(10)),
        "add_8": " ".join(f"s{i} += by * row[{i}];" for i in range(8)),
        "put_10": " ".join(f"n->PF[i + {i}][j] = s{i};" for i in range(10)),
        "put_8": " ".join(f"sum[{i}] = s{i};" for i in range(8)),
        "call_values": calling("values", [*here, "&shared"], ["&own", "slack[k]"]),
        "call_limits": calling("values", old, ["&own", "slack[k]"]),
        "call_errors": calling("errors", ["x[count]"], ["missed"]),
        "call_ending": calling("ending", ["state"], ["n->to_go"]),
        "call_terms": calling("terms", [*old, "slack[k]", "dual[k]"], ["n->cost"]),
        "call_terms_before": calling("terms", [x, u, "&n->shared", slack, dual], ["n->cost"]),
        "call_linearised": calling(
            "linearised", ["x[k]", "x[k + 1]", "u[k]", "timing"], ["n->gap[k]", "n->slopes[k]"]
        ),
        "call_steps": calling(
            "steps", [*old, "slack[k]", "dual[k]", "delta", "upsilon", "&epsilon"], ["n->dual_step[k]", "&share"]
        ),
        "call_rollout": calling(
            "rollout",
            [*here, "n->gap[k]", "n->gains[k]", "n->new_states[k]", "&length", "&epsilon", "timing"],
            ["n->new_states[k + 1]", "n->new_commands[k]"],
        ),
        "call_advance": calling("advance", ["begun", "wanted", "&into"], ["nominal"], "w"),
        "call_advance_here": calling("advance", ["begun", "wanted", "&into"], ["nominal"]),
        "call_deviation": calling("deviation", ["nominal", "here"], ["off"], "w"),
    }  # fmt: skip
