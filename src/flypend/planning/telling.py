"""From what the search found to plans: dense states in SI units, checked."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from flypend.compile.llvm.abreast import abreast
from flypend.compile.llvm.stagewise import Stagewise
from flypend.model.state import SIZE
from flypend.planning.check import begins_touching, broken
from flypend.planning.request import Request
from flypend.planning.result import Plan
from flypend.planning.saved import Status
from flypend.planning.search import Found, stages_of
from flypend.planning.stage import Stage
from flypend.plants.lag import step_timing

DENSE = 4  # samples per stage


def told(asked: Sequence[Request], found: Sequence[Found], horizon: float) -> list[Plan]:
    """Return a plan with its verdict for each request `asked` and what was `found` with the `horizon`."""
    h = stages_of(horizon)[1] / DENSE
    return [_plan(each, what, _dense(each, what, h), horizon) for each, what in zip(asked, found, strict=True)]


def _dense(asked: Request, found: Found, h: float) -> Any:
    """Return states (DENSE stages + 1, 24 + n), own units, at equal times, by steps of length `h` in each stage."""
    stages, width = len(found.commands), found.states.shape[1]
    after, commands = np.empty((stages, width)), np.ascontiguousarray(found.commands)
    timing = np.array(step_timing(asked.vehicle.rotor_lag / asked.units.time, h))
    numbers, step, parts = asked.units.numbers(asked.vehicle), _step(asked.rotors), [found.states[:-1]]
    for _ in range(DENSE - 1):
        step(stages, np.ascontiguousarray(parts[-1]), commands, timing, numbers, after)
        parts.append(after.copy())
    return np.concatenate([np.stack(parts, axis=1).reshape(-1, width), found.states[-1:]])


@lru_cache(maxsize=4)
def _step(rotors: int) -> Stagewise:
    return abreast(Stage(rotors).step(), shared=(2, 3))


def _plan(asked: Request, found: Found, own: Any, horizon: float) -> Plan:
    """Return the plan with the states `own` (n, 24 + k) in own units about the target."""
    units, stage = asked.units, stages_of(horizon)[1] * asked.units.time
    dense = own * units.states(asked.rotors)
    dense[:, :3] += asked.target
    packed, forces = dense[:, :SIZE], dense[:, SIZE:]
    lacks = begins_touching(packed, forces, asked.vehicle) or found.lacks
    lacks = lacks or broken(packed, forces, asked.vehicle, asked.limits)
    status: Status = "failed" if lacks else "feasible" if found.unfinished else "optimal"
    return Plan(
        vehicle=asked.vehicle, objective=asked.objective, target=asked.target, path=asked.path,
        windows=asked.limits.windows,
        t=np.arange(len(dense), dtype=float) * float(stage / DENSE), packed=packed, rotor_forces=forces,
        commands=found.commands * units.force, stage=stage, status=status, reason=lacks or found.unfinished,
        solve_time=found.spent, iterations=found.iterations, guess=found.style,
    )  # fmt: skip
