"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field, fields
from functools import wraps
from pathlib import Path
from typing import Any, TypeVar

import click

from flypend.errors import InputError, one_of
from flypend.files.staging import check_writable
from flypend.files.whole import FIGURES, check_file

_Command = TypeVar("_Command", bound=Callable[..., Any])
LAW_HELP = "a name that flypend laws lists, file.py:function, module:function, or a policy (.npz, .onnx)"


class Output(click.Path):
    """A file that is to be written, with one of these `endings`; without endings a folder, made if there is none."""

    def __init__(self, *endings: str) -> None:
        super().__init__(path_type=Path)
        self.endings, self.name = endings, "file" if endings else "dir"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Path:
        """Return the path. Raises InputError unless it can be written, and no other option writes that file."""
        assert param is not None
        assert ctx is not None
        path = Path(value)
        if not self.endings:
            check_writable(path)
            return path
        check_file(path, self.endings, name_of(param))
        for other in ctx.command.params:
            taken = ctx.params.get(str(other.name)) if isinstance(other.type, Output) else None
            if taken is not None and taken.absolute() == path.absolute():
                raise InputError(name_of(param), f"another file than {name_of(other)}", str(path))
        return path


FIGURE = Output(*FIGURES)
path: Any = click.Path(path_type=Path)
laws_option = click.option("--law", multiple=True, help=f"Law to fly: {LAW_HELP}; repeatable.")
vehicle_option = click.option("--vehicle", default="hehn2011", help="Vehicle name or TOML file.")
SENSORS_HELP = "perfect; or mocap, onboard, laboratory or a TOML file, with the estimator (not on the plant ideal)."
sensors_option = click.option("--sensors", default="perfect", help=SENSORS_HELP)
BANDS_HELP = "Fly vehicles drawn from the vehicle's bands; the law assumes the values in its file."
bands_option = click.option("--bands", is_flag=True, help=BANDS_HELP)
FLOOR_HELP = "Height of a floor, upward from the origin: a machine that touches it has collided."
floor_option = click.option("--floor", type=float, metavar="M", help=FLOOR_HELP)
style_option = click.option(
    "--style", default="paper", help="paper (one or two columns) or slides (16:9, larger fonts)."
)


def out_option(default: str, describe: str = "Output folder.", *endings: str) -> Callable[[_Command], _Command]:
    """Return the option --out with this default: a file with one of the `endings`, or without them a folder."""
    return click.option("--out", "-o", type=Output(*endings), default=default, help=describe)


def option(describe: str, name: str = "", **settings: Any) -> Any:
    """Return a field of a dataclass that is an option of a command, with the `settings` of `click.option`.

    It is called as the field unless it has a `name` of its own. A bool is a flag.
    """
    return field(metadata={"name": name, "settings": {"help": describe, **settings}})


KINDS: dict[Any, dict[str, Any]] = {"bool": {"is_flag": True}, "float | None": {"type": float}}  # by annotation


def options_of(record: type, name: str) -> Callable[[_Command], Any]:
    """Return a decorator that adds an option for each field of a `record`, and passes the record as argument `name`."""
    options = fields(record)

    def decorate(function: _Command) -> Any:
        @wraps(function)
        def called(**given: Any) -> Any:
            own = {each.name: given.pop(each.name) for each in options}
            return function(**given, **{name: record(**own)})

        for each in reversed(options):
            called_as = each.metadata["name"] or f"--{each.name}"
            click.option(called_as, each.name, **KINDS.get(each.type, {}), **each.metadata["settings"])(called)
        return called

    return decorate


def refuse_idle(*names: str, why: str) -> None:
    """Raise InputError for the first of the options `names` that was given; `why` it would have no effect."""
    context = click.get_current_context()
    for parameter in context.command.params:
        given = context.get_parameter_source(str(parameter.name)) is click.core.ParameterSource.COMMANDLINE
        if parameter.name in names and given:
            raise InputError(name_of(parameter), f"nothing {why}", repr(context.params[parameter.name]))


def name_of(parameter: click.Parameter) -> str:
    """Return what messages call a `parameter`: the longest of its names."""
    return max((*parameter.opts, *parameter.secondary_opts), key=len)


def band_worlds(machine: Any, plant: Any, seed: int) -> dict[str, Any]:
    """Return the worlds of --bands by name; `plant` as in a run file. Raises InputError without bands."""
    from flypend.plants import as_sampled
    from flypend.settings.runfile import plant_of
    from flypend.studies.bands import worlds_within

    return dict(worlds_within(machine, as_sampled(plant_of(plant)), seed))


def sensors_asked(sensors: str) -> Any:
    """Return the sensors of --sensors, as a run file has them: the name of a suite, or the table in a TOML file.

    Raises InputError.
    """
    from flypend.files.toml import read_toml
    from flypend.plants import SUITES
    from flypend.plants.sensors import sensors_called

    if Path(sensors).suffix != ".toml":
        return one_of("--sensors", sensors, SUITES)
    table = read_toml(sensors)
    return "perfect" if sensors_called(table, "--sensors") is None else table


def plant_asked(plant: str, sensors: str, floor: float | None = None) -> Any:
    """Return the plant of --plant, --sensors and --floor, as a run file has it: a name, or a table.

    Raises InputError.
    """
    from flypend.plants import PRESETS

    one_of("--plant", plant, PRESETS)
    measured = sensors_asked(sensors)
    perfect = measured == "perfect"
    if plant == "ideal" and not perfect:
        raise InputError("--sensors", "perfect, in the ideal plant", repr(sensors))
    given = ({} if perfect else {"sensors": measured}) | ({} if floor is None else {"floor": floor})
    return {"base": plant, **given} if given else plant
