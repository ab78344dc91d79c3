"""A plan in coarser stages, for a computer with little time and memory."""

from __future__ import annotations

import math

import numpy as np

from flypend.errors import InputError
from flypend.laws.references import sample
from flypend.model import State
from flypend.model.state import SIZE
from flypend.planning.inequalities import EFFORT
from flypend.planning.problem import Request, request
from flypend.planning.result import Plan
from flypend.planning.search import Job, finished, improved
from flypend.planning.verdict import plans_of


def coarsened(plan: Plan, many: int) -> tuple[Plan, Request]:
    """Return `plan` solved again with stages `many` times as long, and the request that it answers.

    Raises InputError if it failed, does not end in inverted hover, has a path, windows or a mount that limits the rod,
    or cannot be flown in such stages. Constraints that a plan does not tell of, such as a box, are not kept.
    """
    if not isinstance(plan, Plan) or not plan:
        raise InputError("plan", "a plan that can be flown", getattr(plan, "reason", "") or repr(plan)[:80])
    if plan.path is not None or plan.windows or plan.vehicle.mount != "gimbal":
        raise InputError("plan", "one without path and windows, on a gimbal", f"{plan!r}")
    start, per_stage = State.trusted(plan.packed[0]), (len(plan.t) - 1) // len(plan.commands)
    rotors = np.clip(plan.rotor_forces[0], *plan.vehicle.rotor_limits)
    (target,) = sample(plan.reference, np.array([plan.duration]))
    asked = request(plan.vehicle, start, plan.objective, target, rotors)
    asked.numbers[EFFORT] *= many  # a stage lasts so much longer
    stages, n = math.ceil(len(plan.commands) / many), asked.rotors
    hover, left = asked.rest, stages * many - len(plan.commands)
    packed = np.column_stack([plan.packed, plan.rotor_forces])[::per_stage]
    packed[:, :3] -= plan.target
    states = np.concatenate([packed / asked.units.states(n), np.tile(hover, (left, 1))])[::many]
    commands = np.concatenate([plan.commands / asked.units.force, np.tile(hover[SIZE:], (left, 1))])
    commands = commands.reshape(stages, many, n).mean(axis=1)
    horizon, job = stages * many * plan.stage / asked.units.time, Job(asked, plan.guess)
    found = finished(job, horizon, improved(job, horizon, (states, commands), math.inf), math.inf)
    coarse = plans_of([asked], [found], horizon)[0]
    if not coarse:
        raise InputError("plan", f"one that can be flown in {stages} stages", coarse.reason)
    return coarse, asked
