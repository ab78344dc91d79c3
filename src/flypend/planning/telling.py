"""From what the search found to plans: dense states in SI units, checked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from flypend.compile.llvm.stagewise import WIDTH, lanes
from flypend.model.state import SIZE
from flypend.planning.check import broken
from flypend.planning.kernels import kernels
from flypend.planning.request import Request
from flypend.planning.result import Plan, Status
from flypend.planning.search import Found, stages_of
from flypend.plants.lag import step_timing

DENSE = 4  # samples per stage


def told(asked: Sequence[Request], found: Sequence[Found], horizon: float) -> list[Plan]:
    """Return a plan with its verdict for each request `asked` and what was `found` with the `horizon`."""
    plans: list[Plan] = []
    for first in range(0, len(asked), WIDTH):
        some = slice(first, first + WIDTH)
        dense = _dense(asked[some], found[some], stages_of(horizon)[1] / DENSE)
        plans += [_plan(*each, horizon) for each in zip(asked[some], found[some], dense, strict=True)]
    return plans


def _dense(asked: Sequence[Request], found: Sequence[Found], h: float) -> list[Any]:
    """Return states (DENSE stages + 1, 24 + n), SI units, at equal times, by steps of length `h` in each stage."""
    stages, width = found[0].commands.shape[0], found[0].states.shape[1]
    here, after, command = lanes(stages, width), lanes(stages, width), lanes(stages, asked[0].rotors)
    timing, numbers = lanes(4), lanes(len(asked[0].units.numbers(asked[0].vehicle)))
    for lane in range(WIDTH):
        own, each = asked[lane % len(asked)], found[lane % len(asked)]
        here[..., lane], command[..., lane] = each.states[:-1], each.commands
        timing[:, lane] = step_timing(own.vehicle.rotor_lag / own.units.time, h)
        numbers[:, lane] = own.units.numbers(own.vehicle)
    parts = [here.copy()]
    step = kernels(asked[0].rotors, asked[0].wishes).step
    for _ in range(DENSE - 1):
        step(stages, here, command, timing, numbers, after)
        parts.append(after.copy())
        here[:] = after
    inside = np.stack(parts, axis=1).reshape(-1, width, WIDTH)
    return [np.concatenate([inside[..., lane], each.states[-1:]]) for lane, each in enumerate(found)]


def _plan(asked: Request, found: Found, own: Any, horizon: float) -> Plan:
    """Return the plan with the states `own` (n, 24 + k) in own units about the target."""
    units, stage = asked.units, stages_of(horizon)[1] * asked.units.time
    dense = own * units.states(asked.rotors)
    dense[:, :3] += asked.target
    packed, forces = dense[:, :SIZE], dense[:, SIZE:]
    lacks = found.lacks or broken(packed, forces, asked.vehicle, asked.limits)
    status: Status = "failed" if lacks else "feasible" if found.unfinished else "optimal"
    return Plan(
        vehicle=asked.vehicle, objective=asked.objective, target=asked.target,
        t=np.arange(len(dense), dtype=float) * float(stage / DENSE), packed=packed, rotor_forces=forces,
        commands=found.commands * units.force, stage=stage, status=status, reason=lacks or found.unfinished,
        solve_time=found.spent, iterations=found.iterations, guess=found.style,
    )  # fmt: skip
