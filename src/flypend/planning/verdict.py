"""From what a search found to plans: states between the stages, and whether they keep what was asked for."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from flypend.compile.llvm.stagewise import Stagewise, stagewise
from flypend.model.state import SIZE
from flypend.planning.constraints import begins_touching, broken
from flypend.planning.dynamics import Stage
from flypend.planning.files import Status
from flypend.planning.problem import Request
from flypend.planning.result import Plan
from flypend.planning.search import NOT_REACHED, Found, agreeing
from flypend.plants.lag import step_timing

DENSE = 4  # samples per stage
FINER = 4  # times as many are checked: what moves at 10 m/s comes 12 mm farther between them on hehn2011


def plans_of(asked: Sequence[Request], found: Sequence[Found], horizon: float) -> list[Plan]:
    """Return a plan with its verdict for each request `asked` and what was `found` with the `horizon` (√(l/g))."""
    return [_plan(each, what, horizon) for each, what in zip(asked, found, strict=True)]


def _dense(asked: Request, found: Found, horizon: float, samples: int) -> Any:
    """Return states (samples · stages + 1, 24 + n), SI units, at equal times, by so many steps in each stage."""
    stages, width = len(found.commands), found.states.shape[1]
    h = horizon / stages / samples
    after, commands = np.empty((stages, width)), np.ascontiguousarray(found.commands)
    timing = np.array(step_timing(asked.vehicle.rotor_lag / asked.units.time, h))
    numbers, step, parts = asked.units.numbers(asked.vehicle), _step(asked.rotors), [found.states[:-1]]
    for _ in range(samples - 1):
        step(stages, np.ascontiguousarray(parts[-1]), commands, timing, numbers, after)
        parts.append(after.copy())
    dense = np.concatenate([np.stack(parts, axis=1).reshape(-1, width), found.states[-1:]])
    dense *= asked.units.states(asked.rotors)
    dense[:, :3] += asked.target
    return dense


@lru_cache(maxsize=4)
def _step(rotors: int) -> Stagewise:
    return stagewise(Stage(rotors).step(), shared=(2, 3), abreast=True)


def _plan(asked: Request, found: Found, horizon: float) -> Plan:
    units, h = asked.units, horizon / len(found.commands)
    stage, dense = h * units.time, _dense(asked, found, horizon, DENSE)
    packed, forces = dense[:, :SIZE], dense[:, SIZE:]
    lacks = begins_touching(packed, forces, asked.vehicle) or found.lacks
    lacks = "the target is not reached" if asked.structure.end and lacks == NOT_REACHED else lacks
    if not lacks:
        finer = _dense(asked, found, horizon, DENSE * FINER)
        lacks = broken(finer[:, :SIZE], finer[:, SIZE:], asked.vehicle, asked.kept)
    status: Status = "failed" if lacks else "feasible" if found.unfinished else "converged"
    return Plan(
        vehicle=asked.vehicle, objective=asked.objective, target=asked.target, path=asked.kept.path,
        windows=asked.kept.windows,
        t=np.arange(len(dense), dtype=float) * float(stage / DENSE), packed=packed, rotor_forces=forces,
        commands=found.commands * units.force, stage=stage, status=status, reason=lacks or found.unfinished,
        solve_time=found.spent, iterations=found.iterations, stationarity=found.stationarity, guess=found.style,
        guesses=len(found.costs), agreeing=0 if lacks else agreeing(found.costs),
    )  # fmt: skip
