"""What a file holds, as a table of fields, and the one check of it: for what is written and for what was read.

Records of numbers, strings and tables need no library for schemas: `Vehicle`, `Window`, `State` and `errors` check
themselves, and JSON in a file is an object of a few numbers.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from flypend import errors
from flypend.errors import InputError
from flypend.files.netcdf import Variable


class Field(NamedTuple):
    """An array of a file."""

    dims: tuple[str | int, ...]  # names of its axes, of which those of one name have one length; or their lengths
    dtype: str = "<f8"  # in memory, of NumPy; a file may hold another that converts to it without loss
    unit: str = ""
    finite: bool = True  # whether all numbers are finite; if not, they may be NaN and infinite
    low: float = -math.inf  # bounds of its numbers
    high: float = math.inf


def check_arrays(
    fields: Mapping[str, Field], given: Mapping[str, Any], lengths: Mapping[str, int] = MappingProxyType({})
) -> dict[str, NDArray[Any]]:
    """Return the arrays of all `fields` among those `given`, in the type of the field; others are left out.

    `lengths` are those of the axes that are known. Raises InputError for an array that is missing or not as its field.
    """
    known: dict[str | int, int] = dict(lengths.items())
    found = {}
    for name, field in fields.items():
        if name not in given:
            raise InputError(name, "an array", "nothing")
        found[name] = _check(name, field, np.asarray(given[name]), known)
    return found


def _check(name: str, field: Field, values: NDArray[Any], known: dict[str | int, int]) -> NDArray[Any]:
    """Return `values` as its `field` has them; lengths of axes that are not `known` become so."""
    wanted = np.dtype(field.dtype)
    fits = values.dtype.kind == "U" if wanted.kind == "U" else np.can_cast(values.dtype, wanted, "safe")
    if not fits:
        raise InputError(name, f"an array of {wanted.name}", f"one of {values.dtype.name}")
    if values.ndim == len(field.dims):
        for dim, size in zip(field.dims, values.shape, strict=True):
            known.setdefault(dim, dim if isinstance(dim, int) else size)
    if values.shape != (shape := tuple(known.get(dim, dim) for dim in field.dims)):
        raise InputError(name, f"shape ({', '.join(map(str, shape))})", f"shape {values.shape}")
    if wanted.kind == "U":
        return values
    out = values.astype(wanted, copy=False)
    if field.finite and not np.all(here := np.isfinite(out)):
        raise InputError(name, "finite numbers", f"{np.count_nonzero(~here)} that are NaN or infinite")
    if np.any((out < field.low) | (out > field.high)):
        low, high = np.nanmin(out), np.nanmax(out)
        raise InputError(name, f"numbers from {field.low:g} to {field.high:g}", f"{low:g} to {high:g}")
    return out


def check_variables(
    fields: Mapping[str, Field], given: Mapping[str, Variable], lengths: Mapping[str, int]
) -> dict[str, NDArray[Any]]:
    """Return `check_arrays` of the variables `given`, whose axes and units, if they say one, are those of `fields`."""
    for name, field in fields.items():
        if name in given:
            dims, unit = given[name].dims, given[name].attributes.get("units", field.unit)
            if dims != field.dims:
                raise InputError(name, f"the axes {field.dims}", dims)
            if unit != field.unit:
                raise InputError(name, f"the unit {field.unit!r}", repr(unit))
    return check_arrays(fields, {name: variable.values for name, variable in given.items()}, lengths)


def check_attributes(kinds: Mapping[str, type], given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes `given` that `kinds` names, strings or finite floats; others are left out.

    Raises InputError for one that is missing or of another kind.
    """
    found: dict[str, Any] = {}
    for name, kind in kinds.items():
        if name not in given:
            raise InputError(name, "an attribute", "nothing")
        if kind is str and not isinstance(given[name], str):
            raise InputError(name, "a string", repr(given[name])[:80])
        found[name] = given[name] if kind is str else errors.number(name, given[name])
    return found


def digest(arrays: Mapping[str, NDArray[Any]], attributes: Mapping[str, Any]) -> str:
    """Return a digest of all numbers and attributes, by which a reader knows a file that was damaged or changed."""
    found = hashlib.sha256(json.dumps(dict(attributes), sort_keys=True).encode())
    for name, values in sorted(arrays.items()):
        numbers = np.ascontiguousarray(values, dtype="<f8")
        found.update(f"{name} {numbers.shape}".encode())
        found.update(numbers.data)
    return found.hexdigest()
