"""Environments from the arguments of `gymnasium.make`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from inspect import signature
from pathlib import Path
from typing import Any, Literal

import numpy as np
from gymnasium.spaces import Box

from flypend import errors
from flypend.compile.llvm.worlds import BOUND
from flypend.envs import task as tasks
from flypend.envs.problem import Action, Environment, Observe
from flypend.envs.randomise import Randomisation
from flypend.envs.task import Task
from flypend.errors import InputError
from flypend.laws.seen import Attitude
from flypend.model import Vehicle
from flypend.model.shipped import vehicle as vehicle_named
from flypend.plants.plant import ROTORS, Sampled

TASKS: Mapping[str, Callable[..., Task]] = {
    "balance": tasks.balance, "swing_up": tasks.swing_up, "track": tasks.track, "catch_in_cup": tasks.catch_in_cup,
}  # fmt: skip
DEFAULTS: Mapping[str, Any] = {"vehicle": "hehn2011", "rate": 100.0, "randomise": Randomisation()}
PHYSICS = ROTORS.replace(rate=1000.0)
MOST_KEPT = 1000  # observations: ten seconds at 100 Hz, and 100 kB a world


class UnknownArgumentError(InputError, TypeError):
    """An argument that no environment has: in Python's words, so that libraries that try it go on without it."""

    def __init__(self, field: str, expected: str = "", got: str = "") -> None:
        if got:
            super().__init__(field, expected, got)
        else:  # gymnasium raises it again with another message, which is all that it gives
            ValueError.__init__(self, field)


def environment(
    task: str | Task,
    *,
    vehicle: str | Path | Vehicle | None = None,
    mount: str | None = None,
    plant: Sampled = PHYSICS,
    rate: float | None = None,
    action: Action = "rotors",
    attitude: Attitude = "matrix",
    observe: Observe = "all",
    randomise: Randomisation | Mapping[str, Any] | Literal["bands"] | None = None,
    sensors: Any = None,
    duration: float | None = None,
    **about: Any,
) -> Environment:
    """Return the environment that the arguments describe.

    Parameters
    ----------
    task : str or Task
        "balance", "swing_up", "track", "catch_in_cup", or a task of your own.
    vehicle : str, Path or Vehicle, optional
        Name, TOML file or vehicle; default that of the task, or hehn2011.
    mount : str, optional
        Replaces the vehicle's mount; the task "catch_in_cup" needs a cup.
    plant, action, attitude, observe, sensors
        See `flypend.envs.Environment`.
    rate : float, optional
        Actions per second; default that of the task, or 100 Hz.
    randomise : Randomisation, dict or "bands", optional
        What differs from world to world: see `flypend.envs.Randomisation`. "bands" stands for its `within_bands`.
        Default that of the task, or nothing.
    duration : float, optional
        Seconds after which a world is cut off; default that of the task.
    about
        Arguments of the task: those of `flypend.envs.track`.

    Raises
    ------
    InputError
        If an argument is unknown or out of range.
    """
    made = _task(task, about)
    given = {"vehicle": vehicle, "rate": rate, "randomise": randomise}
    chosen = {**DEFAULTS, **made.defaults, **{name: value for name, value in given.items() if value is not None}}
    machine = chosen["vehicle"] if isinstance(chosen["vehicle"], Vehicle) else vehicle_named(chosen["vehicle"])
    ranges = _ranges(chosen["randomise"], machine)
    machine = machine.commanded()
    wanted = "cup" if made.name == "CatchInCup" and mount is None else mount
    if wanted is not None:
        machine = machine.replace(mount=wanted)
    if made.name == "CatchInCup" and machine.mount != "cup":
        raise InputError("mount", "'cup', for the task catch_in_cup", repr(machine.mount))
    if duration is not None:
        made = replace(made, duration=duration)
    return Environment(
        made, machine, plant, rate=chosen["rate"], action=action, attitude=attitude, observe=observe, randomise=ranges,
        sensors=sensors,
    )  # fmt: skip


def _task(task: str | Task, about: Mapping[str, Any]) -> Task:
    """The task itself, or that of this name with its own arguments."""
    made: Callable[..., Task]
    made = (lambda: task) if isinstance(task, Task) else TASKS[errors.one_of("task", task, TASKS)]
    common = [name for name in signature(environment).parameters if name != "about"]
    try:
        errors.only_known("", about, [*common, *signature(made).parameters])
    except InputError as error:
        got = str(error.got).replace(repr(error.field), f"an unexpected keyword argument {error.field!r}", 1)
        raise UnknownArgumentError(error.field, error.expected, got) from None
    return made(**about)


def _ranges(given: Any, vehicle: Vehicle) -> Randomisation:
    if isinstance(given, Randomisation):
        return given
    if isinstance(given, str) and given == "bands":
        return Randomisation.within_bands(vehicle)
    if not isinstance(given, Mapping):
        raise InputError("randomise", 'a Randomisation, a table of intervals, or "bands"', repr(given))
    errors.only_known("randomise", given, (entry.name for entry in fields(Randomisation)))
    return Randomisation(**given)


def spaces(env: Environment, seen: int) -> tuple[Box, Box]:
    """Spaces of the observations, `seen` numbers each, and of the actions of one world."""
    observed = Box(-BOUND, BOUND, (seen,), np.float32)
    return observed, Box(-1.0, 1.0, (env.actions,), np.float32)


def memory_of(history: Any, observation_delay: Any) -> tuple[int, int]:
    """Return both numbers, checked. Raises InputError unless they are integers from 0 to 1,000."""
    return (
        errors.integer("history", history, 0, MOST_KEPT),
        errors.integer("observation_delay", observation_delay, 0, MOST_KEPT),
    )
