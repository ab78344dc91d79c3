"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from flypend.errors import InputError

_Command = TypeVar("_Command", bound=Callable[..., Any])
LAW_HELP = "a name that flypend laws lists, file.py:function or module:function"

path: Any = click.Path(path_type=Path)
laws_option = click.option("--law", multiple=True, help=f"Law to fly: {LAW_HELP}; repeatable.")
vehicle_option = click.option("--vehicle", default="hehn2011", help="Vehicle name or TOML file.")
sensors_option = click.option(
    "--sensors", default="perfect", help="perfect, mocap, onboard or laboratory, with the estimator; not ideal."
)
style_option = click.option(
    "--style", default="paper", help="paper (one or two columns) or slides (16:9, larger fonts)."
)


def out_option(default: str, describe: str = "Output folder.") -> Callable[[_Command], _Command]:
    """Return the option --out with this default: a folder, or a file if the default has an ending."""
    kind = "FILE" if Path(default).suffix else "DIR"
    return click.option("--out", "-o", type=path, default=default, metavar=kind, help=describe)


def refuse_idle(*names: str, why: str) -> None:
    """Raise InputError for the first of the options `names` that was given; `why` it would have no effect."""
    context = click.get_current_context()
    for parameter in context.command.params:
        given = context.get_parameter_source(str(parameter.name)) is click.core.ParameterSource.COMMANDLINE
        if parameter.name in names and given:
            option = max((*parameter.opts, *parameter.secondary_opts), key=len)
            raise InputError(option, f"nothing {why}", repr(context.params[parameter.name]))


def plant_asked(plant: str, sensors: str) -> Any:
    """Return the plant of --plant and --sensors, as a run file has it: a name, or a table. Raises InputError."""
    from flypend import errors
    from flypend.plants import PRESETS, SUITES

    errors.one_of("--plant", plant, PRESETS)
    if errors.one_of("--sensors", sensors, SUITES) == "perfect":
        return plant
    if plant == "ideal":
        raise errors.InputError("--sensors", "perfect, in the ideal plant", repr(sensors))
    return {"base": plant, "sensors": sensors}
