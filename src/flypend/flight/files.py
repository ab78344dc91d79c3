"""Runs in files: what one holds, checked when it is written and when it is read."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from flypend import errors
from flypend.errors import InputError
from flypend.files.netcdf import Variable, read_netcdf, write_netcdf
from flypend.files.reading import parse_json
from flypend.files.schema import Field, check_attributes, check_variables, digest
from flypend.files.whole import whole_file
from flypend.flight.labels import AXES, DIMENSIONS, UNITS
from flypend.flight.outcome import STATUSES, Outcome
from flypend.model import State, Vehicle
from flypend.model.state import SHAPES

KIND = "a run saved by flypend"
ARRAYS = ("t", *SHAPES, "thrust", "moment", "rotor_forces", "x_ref")
# What a law commands may be undefined where it is singular (0/0): NaN. A state never is.
UNDEFINED = ("thrust", "moment", "rotor_forces")
# Beyond any flight, which ends at 1e6 (`model.state.MAX_STATE`); products of four such numbers are finite.
FAR = 1e12
FIELDS: Mapping[str, Field] = {
    **{name: Field(("t", *DIMENSIONS.get(name, ())), unit=UNITS[name], low=-FAR, high=FAR) for name in ARRAYS},
    **{name: Field(("t", *DIMENSIONS.get(name, ())), unit=UNITS[name], finite=False) for name in UNDEFINED},
}
DRIFT = Field(("step", "drift_of"), low=0)
DRIFT_OF = ("length of y", "tangency of y_dot", "orthogonality of R")
ATTRIBUTES: Mapping[str, type] = {
    "e3": str, "law": str, "gains": str, "vehicle": str, "frame": str, "outcome": str, "outcome_time": float,
    "outcome_reason": str, "signals": str,
}  # fmt: skip
LENGTHS = {**{name: len(values) for name, values in AXES.items()}, "drift_of": len(DRIFT_OF)}


def content(
    variables: Mapping[str, Variable], attributes: Mapping[str, Any], drift: Any
) -> tuple[dict[str, Variable], dict[str, Any]]:
    """Return what a file of a run holds: its variables, and its attributes with a digest of both. Raises InputError.

    It does if `run_from` would refuse them. A drift (steps, 3) without rows is left out: it would leave a data frame of
    the file none.
    """
    whole = {**{name: Variable((name,), np.array(values)) for name, values in AXES.items()}, **variables}
    if len(drift):
        whole["drift_of"] = Variable(("drift_of",), np.array(DRIFT_OF))
        whole["drift"] = Variable(("step", "drift_of"), np.asarray(drift), {"long_name": "before projection, per step"})
    return whole, {**attributes, "digest": check(whole, attributes)[1]}


def write(path: str | Path, variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> None:
    """Write a file .nc, atomically. Raises InputError if it is not writable."""
    with whole_file(path, [".nc"]) as partial:
        write_netcdf(partial, variables, attributes)


def read(path: str | Path, kind: str) -> tuple[dict[str, Variable], dict[str, Any]]:
    """Return variables and attributes of the file `path`. Raises InputError unless it is `kind`, or NetCDF at least."""
    try:
        return read_netcdf(Path(path))
    except OSError as error:
        raise InputError(str(path), kind, error.strerror or error) from None
    except InputError:
        raise
    except ValueError as error:
        raise InputError(str(path), kind, error) from None


def run_from(variables: Mapping[str, Variable], attributes: Mapping[str, Any], path: str) -> tuple[dict[str, Any], str]:
    """Return the fields of the `Trajectory` in the content of the file `path`, and its digest.

    Raises InputError if there is none, or the digest in the file is that of another. A file without the attribute
    `digest`, as after an edit with xarray, is checked all the same.
    """
    if missing := [name for name in ATTRIBUTES if name not in attributes]:
        raise InputError(path, KIND, f"NetCDF that flypend has not written: no {', '.join(missing)}")
    try:
        run, found = check(variables, attributes)
    except InputError as error:
        raise InputError(path, KIND, f"a damaged one ({error})") from None
    check_digest(path, KIND, attributes, "digest", found)
    return run, found


def check_digest(path: str, kind: str, attributes: Mapping[str, Any], name: str, found: str) -> None:
    """Raise InputError unless the attribute `name` in the file `path`, if it is there, is the digest `found`."""
    if attributes.get(name, found) != found:
        told = f"one that was damaged or changed since (without its attribute {name} it is loaded all the same)"
        raise InputError(path, kind, told)


def check(variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> tuple[dict[str, Any], str]:
    """Return the fields of the run that `variables` and `attributes` specify, and their digest. Raises InputError."""
    about = check_attributes(ATTRIBUTES, attributes)
    errors.one_of("e3", about["e3"], ("up", "down"))
    with np.errstate(all="ignore"):  # huge numbers overflow during validation, and so fail it
        vehicle = Vehicle.from_dict(json_of("vehicle", about, dict))
    lengths = LENGTHS | {"rotor": len(vehicle.rotor_spins)}
    signals, taken = json_of("signals", about, list), {*FIELDS, *LENGTHS, "drift"}
    if not all(isinstance(name, str) and name not in taken for name in signals) or len(set(signals)) != len(signals):
        raise InputError("signals", "names, once each, that are not those of other variables", repr(signals)[:80])
    fields = {**FIELDS, **{name: Field(("t",), unit=UNITS.get(name, ""), finite=False) for name in signals}}
    fields |= {"drift": DRIFT} if "drift" in variables else {}
    arrays: dict[str, Any] = {"drift": np.zeros((0, len(DRIFT_OF))), **check_variables(fields, variables, lengths)}
    if not len(t := arrays["t"]) or t[0] < 0 or np.any(np.diff(t) <= 0):
        raise InputError("t", "increasing times from 0 on", f"{len(t)} that are not")
    State(**{name: arrays[name] for name in SHAPES})  # raises for one that is none
    errors.one_of("outcome", about["outcome"], STATUSES)
    time = errors.number("outcome_time", about["outcome_time"], at_least=0, unit="s")
    run = dict(
        **{name: arrays[name] for name in (*ARRAYS, "drift")},
        signals={name: arrays[name] for name in signals},
        outcome=Outcome(about["outcome"], time, about["outcome_reason"]),
        e3=about["e3"],
        vehicle=vehicle,
        law=about["law"],
        gains=json_of("gains", about, dict),
    )
    return run, digest(arrays, about)


def json_of(name: str, attributes: Mapping[str, Any], kind: type) -> Any:
    """Return the attribute `name`, JSON of a dict or list, parsed. Raises InputError if it is none."""
    expected = f"JSON of {'an object' if kind is dict else 'an array'}"
    try:
        found = parse_json(attributes[name])
    except ValueError as error:
        raise InputError(name, expected, error) from None
    if not isinstance(found, kind):
        raise InputError(name, expected, repr(found)[:80])
    return found
