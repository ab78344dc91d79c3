"""Run files: an experiment of the paper or a TOML file, with overrides, becomes a `Flight`."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.files.toml import read_toml, toml_text
from flypend.flight.request import Flight, Tolerances
from flypend.laws import Controller, Law
from flypend.laws.by_name import THEOREM_1
from flypend.model import State, Vehicle
from flypend.model.by_name import vehicle_table
from flypend.model.state import SHAPES
from flypend.paper import experiment, experiment_names
from flypend.plants import AnyPlant, Ideal, Noise, Wind, plant
from flypend.settings.laws import absolute, law_from, law_table, relative, table_of

KEYS = ("vehicle", "law", "start", "duration", "plant", "rtol", "experiment", "controller")
# Keys that only a study has; a file with none of them is a run file.
STUDY_KEYS = (
    "judge_period", "precision", "max_steps", "runs", "sampling", "seed", "chunk", "final", "criterion", "vary", "tune",
)  # fmt: skip
# Settings that are lists of words; all other lists are of numbers.
WORDS = ("plant.air", "plant.sensors.adjustable")
TABLES = ("law.window",)
Record = TypeVar("Record")


class RunFile(NamedTuple):
    """The request for one run, and the equivalent content of a TOML file."""

    flight: Flight
    settings: dict[str, Any]


@contextmanager
def shallow(field: str) -> Iterator[None]:
    """Raise InputError, for `field`, if settings that the block goes through are nested too deeply for Python."""
    try:
        yield
    except RecursionError:
        raise InputError(field, "settings nested a few levels deep", "hundreds of levels") from None


@shallow("run")
def run_file(what: str, overrides: Iterable[str] = (), law: str | None = None) -> RunFile:
    """Return the run `what`: an experiment of the paper by name, or a TOML file by path.

    `law`, in the form used on the command line, replaces the law. `overrides` are strings such as `law.gains.k_d=2`,
    applied in order; a value that is not valid TOML is a plain string.

    Raises InputError if anything is unknown (naming the closest match), missing, or out of range.
    """
    settings = _read(what)
    if law is not None:
        settings["law"] = table_of(law)
    for override in overrides:
        _override(settings, override)
    return run_of(settings)


@shallow("run")
def run_of(settings: dict[str, Any]) -> RunFile:
    """Return the run that `settings`, the content of a TOML file, specifies. Raises InputError like `run_file`."""
    for key, value in settings.items():
        check_plain(key, value)
    with np.errstate(all="ignore"):  # huge numbers overflow during validation, and so fail it
        return _build(_complete(settings))


def run_text(settings: dict[str, Any], folder: str | Path) -> str:
    """Return `settings` as the text of a run file in `folder`, to which the file of its law is relative."""
    return toml_text({**settings, "law": relative(settings["law"], Path(folder))})


def _read(what: str) -> dict[str, Any]:
    if what in experiment_names():
        return {"experiment": what}
    if "\0" not in what and (what.endswith(".toml") or os.path.exists(what)):  # noqa: PTH110 (False for any invalid name)
        if what.endswith(".nc"):
            raise InputError(what, "a run file (.toml)", f"a saved run: flypend replay {what}")
        settings = read_toml(what)
        if study := sorted(settings.keys() & STUDY_KEYS):
            given = f"a study (it has {study[0]}): flypend sweep {what} -o {Path(what).stem}.zarr"
            raise InputError(what, "a run file", given)
        if "law" in settings:
            settings["law"] = absolute(settings["law"], Path(what).parent)
        return settings
    raise InputError("run", f"an experiment ({', '.join(experiment_names())}) or a TOML file", repr(what))


def check_plain(key: str, value: Any) -> None:
    """Reject TOML values that no setting accepts: dates, integers beyond 64 bits, lists of what they are not."""
    if not key.isprintable():
        raise InputError("run", "printable keys", repr(key))
    if isinstance(value, dict):
        for name, entry in value.items():
            check_plain(f"{key}.{name}", entry)
    elif isinstance(value, list):
        for entry in value:
            known = (isinstance(entry, str) and key in WORDS) or (isinstance(entry, dict) and key in TABLES)
            if isinstance(entry, bool | dict | str) and not known:
                raise InputError(key, "a list of numbers", repr(value))
            check_plain(key, entry)
    elif not isinstance(value, bool | int | float | str):
        raise InputError(key, "a number, a word, a list or a table", value)
    elif isinstance(value, int) and not -(2**63) <= value < 2**63:
        raise InputError(key, "an integer of 64 bits", f"one of {value.bit_length()} bits")


def _complete(settings: dict[str, Any]) -> dict[str, Any]:
    """Fill in the values of `experiment`, and expand the vehicle to a full table."""
    errors.only_known("", settings, KEYS)
    out = deepcopy(settings)
    if "law" in out:
        out["law"] = absolute(law_table(out["law"]), Path.cwd())
    if "experiment" in out:
        row = experiment(str(out["experiment"]))
        start = {name: getattr(row.start, name).tolist() for name in SHAPES}
        out["start"] = start | table_at(out, "start")
        law = table_at(out, "law")
        law = law if "function" in law else {"name": "corrected"} | law
        if law.get("name") in THEOREM_1:
            law["gains"] = dict(row.gains) | table_at(law, "gains", "law.gains")
        out["law"] = law
        if not isinstance(out.get("vehicle"), str):
            out["vehicle"] = {"base": row.vehicle.name} | table_at(out, "vehicle")
        out["duration"] = out.get("duration", row.duration)
        out["plant"] = out.get("plant", row.plant)
    for key in ("vehicle", "law", "start", "duration"):
        if key not in out:
            raise InputError(key, "a value (or `experiment`, which brings one)", "nothing")
    out["vehicle"] = vehicle_table(out["vehicle"])
    return out


def start_of(table: dict[str, Any]) -> State:
    """Return the single state in a table of fields. Raises InputError with field names that begin with `start`."""
    errors.only_known("start", table, SHAPES)
    if "y" not in table:
        raise InputError("start.y", "a unit vector", "nothing")
    try:
        state = State(**table)
    except InputError as error:
        raise InputError(f"start.{error.field}", error.expected, error.got) from None
    if state.batch_shape:
        raise InputError("start", "a single state", f"a batch of shape {state.batch_shape}")
    return state


def plant_of(value: Any) -> AnyPlant:
    """Return a plant, given by name or as a table on top of `base` (default "rotors").

    Noise and wind are tables; sensors the name of a suite, or a table on top of one (its own `base`).
    """
    if isinstance(value, str):
        return plant(value)
    if not isinstance(value, dict):
        raise InputError("plant", "a name or a table", repr(value))
    given = dict(value)
    base = plant(given.pop("base", "rotors"))
    if isinstance(base, Ideal):
        if given.keys() - {"floor"}:
            raise InputError("plant", "a base with numbers, such as 'rotors'", "the ideal plant")
        return replace(base, **given)
    for key, kind in (("noise", Noise), ("wind", Wind)):
        if key in given:
            given[key] = record_at(given, key, kind, f"plant.{key}")
    return base.replace(**given)


def _controller(law: Law | Controller, vehicle: Vehicle, world: AnyPlant, kind: Any) -> Law | Controller:
    """Return the law itself (`kind` "python"), or its exported and compiled C ("c" in double, "c-float" in float).

    Raises InputError unless the C can command the plant `world`.
    """
    if errors.one_of("controller", kind, ("python", "c", "c-float")) == "python":
        return law
    if isinstance(law, Controller):
        raise InputError("controller", "python, for a law that is not written in symbols", repr(kind))
    from flypend.export import compiled  # slow to import, and seldom needed
    from flypend.export.library import check_plant

    check_plant(world)
    return compiled(law, vehicle, "double" if kind == "c" else "float")


def table_at(settings: Mapping[str, Any], key: str, field: str = "") -> dict[str, Any]:
    """Return the table `key` of `settings`, empty if absent. Raises InputError, with the field name `field`."""
    value = settings.get(key, {})
    if not isinstance(value, dict):
        raise InputError(field or key, "a table", repr(value))
    return dict(value)


def record_at(settings: Mapping[str, Any], key: str, kind: type[Record], field: str = "") -> Record:
    """Return the record whose fields the table `key` of `settings` has. Raises InputError, with the name `field`."""
    table = table_at(settings, key, field)
    errors.only_known(field or key, table, [entry.name for entry in fields(cast("Any", kind))])
    return kind(**table)


def _override(settings: dict[str, Any], text: str) -> None:
    """Apply one override `a.b.c=value` to `settings`."""
    path, equals, value = text.partition("=")
    keys = [key.strip() for key in path.split(".")]
    if not equals or not all(key and key.isprintable() for key in keys):
        raise InputError("--set", "KEY.KEY=VALUE, such as law.gains.k_d=2", repr(text))
    if len(keys) > 1:
        errors.only_known("", keys[:1], KEYS)
        if keys[0] in ("vehicle", "plant", "law") and isinstance(name := settings.get(keys[0]), str):
            settings[keys[0]] = table_of(name) if keys[0] == "law" else {"base": name}
    table = settings
    for depth, key in enumerate(keys[:-1], 1):
        table = table.setdefault(key, {})
        if not isinstance(table, dict):
            raise InputError("--set", f"a table at {'.'.join(keys[:depth])}", repr(table))
    try:
        parsed = tomllib.loads(f"value = {value}")
    except ValueError:  # not TOML, or an integer with thousands of digits
        parsed = {}
    table[keys[-1]] = parsed["value"] if parsed.keys() == {"value"} else value.strip()


def _build(settings: dict[str, Any]) -> RunFile:
    vehicle, plant = Vehicle.from_dict(table_at(settings, "vehicle")), plant_of(settings.get("plant", "rotors"))
    law = _controller(law_from(settings["law"]), vehicle, plant, settings.get("controller", "python"))
    flight = Flight(
        vehicle=vehicle,
        law=law.bind(vehicle),
        starts=start_of(table_at(settings, "start")),
        duration=settings["duration"],
        plant=plant,
        tolerances=Tolerances(rtol=settings.get("rtol", 1e-9)),
    )
    return RunFile(flight, settings)
