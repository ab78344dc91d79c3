"""Environments from the arguments of `gymnasium.make`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, replace
from inspect import signature
from pathlib import Path
from typing import Any, Literal

from flypend import errors
from flypend.envs import task as tasks
from flypend.envs.problem import Environment
from flypend.envs.randomise import Randomisation
from flypend.envs.task import Task
from flypend.errors import InputError
from flypend.model import Vehicle
from flypend.model.by_name import vehicle as vehicle_named
from flypend.plants.plant import ROTORS

TASKS: Mapping[str, Callable[..., Task]] = {
    "balance": tasks.balance, "swing_up": tasks.swing_up, "track": tasks.track, "catch_in_cup": tasks.catch_in_cup,
}  # fmt: skip
PHYSICS = ROTORS.replace(rate=1000.0)
SETTINGS = ("plant", "action", "attitude", "observe", "sensors")  # arguments that go to an Environment as they are
DEFAULTS: Mapping[str, Any] = {"vehicle": "hehn2011", "plant": PHYSICS, "rate": 100.0, "randomise": Randomisation()}


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
    rate: float | None = None,
    randomise: Randomisation | Mapping[str, Any] | Literal["bands"] | None = None,
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
        Replaces the vehicle's mount; the task "catch_in_cup" needs a cup, and "swing_up" any other.
    rate : float, optional
        Actions per second; default that of the task, or 100 Hz.
    randomise : Randomisation, dict or "bands", optional
        What differs from world to world: see `flypend.envs.Randomisation`. "bands" stands for its `within_bands`.
        Default that of the task, or nothing.
    duration : float, optional
        Seconds after which a world is cut off; default that of the task.
    plant, action, attitude, observe, sensors
        See `flypend.envs.Environment`. The default plant has a rate of 1 kHz.
    about
        Arguments of the task: those of `flypend.envs.track`.

    Raises
    ------
    InputError
        If an argument is unknown or out of range.
    """
    given = {"vehicle": vehicle, "mount": mount, "rate": rate, "randomise": randomise, "duration": duration}
    given = {name: value for name, value in given.items() if value is not None}
    given |= {name: about.pop(name) for name in SETTINGS if name in about}
    check_known(task, about)
    made = _maker(task)(**about)
    errors.only_known("task.defaults", made.defaults, ARGUMENTS[1:])  # but for the task
    chosen = {**DEFAULTS, **made.defaults, **given}
    machine = chosen.pop("vehicle")
    machine = machine if isinstance(machine, Vehicle) else vehicle_named(machine)
    ranges = _ranges(chosen.pop("randomise"), machine, getattr(chosen["plant"], "delay", 0.0))
    machine = machine.commanded()
    if (wanted := chosen.pop("mount", None)) is not None:
        machine = machine.replace(mount=wanted)
    if (seconds := chosen.pop("duration", None)) is not None:
        made = replace(made, duration=seconds)
    return Environment(made, machine, randomise=ranges, **chosen)


ARGUMENTS = [*(name for name in signature(environment).parameters if name != "about"), *SETTINGS]


def _maker(task: str | Task) -> Callable[..., Task]:
    """What returns the task itself, or that of this name from its own arguments."""
    return (lambda: task) if isinstance(task, Task) else TASKS[errors.one_of("task", task, TASKS)]


def check_known(task: str | Task, about: Iterable[str], beside: Iterable[str] = ()) -> None:
    """Raise `UnknownArgumentError` for an argument that no environment of the task has, nor what is `beside` it."""
    try:
        errors.only_known("", about, dict.fromkeys([*ARGUMENTS, *beside, *signature(_maker(task)).parameters]))
    except InputError as error:
        got = str(error.got).replace(repr(error.field), f"an unexpected keyword argument {error.field!r}", 1)
        raise UnknownArgumentError(error.field, error.expected, got) from None


def environment_for(owner: type, task: str | Task, arguments: Mapping[str, Any]) -> Environment:
    """Return the `environment` of the `task` and `arguments`; those that the `owner` takes itself are known, too."""
    own = signature(owner).parameters.values()
    check_known(task, arguments, [one.name for one in own if one.kind is not one.VAR_KEYWORD])
    return environment(task, **arguments)


def _ranges(given: Any, vehicle: Vehicle, delay: float) -> Randomisation:
    if isinstance(given, Randomisation):
        return given
    if isinstance(given, str) and given == "bands":
        return Randomisation.within_bands(vehicle, delay)
    if not isinstance(given, Mapping):
        raise InputError("randomise", 'a Randomisation, a table of intervals, or "bands"', repr(given))
    errors.only_known("randomise", given, (entry.name for entry in fields(Randomisation)))
    return Randomisation(**given)
