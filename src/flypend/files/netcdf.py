"""Named arrays as a NetCDF file, by SciPy: xarray writes the same file, but takes half a second to be imported."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np


class Variable(NamedTuple):
    """An array, of numbers or strings, with the names of its dimensions and its attributes, as xarray takes it."""

    dims: tuple[str, ...]
    values: Any
    attributes: Mapping[str, Any] = {}


def write_netcdf(path: Path, variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> None:
    """Write `variables` and the `attributes` of the whole, texts and numbers, to `path`. Raises OSError."""
    from scipy.io import netcdf_file

    with netcdf_file(path, "w", version=2) as file:
        _describe(file, attributes)
        for name, (dims, values, about) in variables.items():
            values = np.asarray(values)
            if values.dtype.kind in "iub":  # NetCDF 3 has no integers of 64 bits
                values = values.astype(float)
            if values.dtype.kind == "U":  # NetCDF 3 has characters only
                encoded = np.char.encode(values, "utf-8")
                values = encoded.view("S1").reshape(*values.shape, -1)
                dims, about = (*dims, f"{name}_length"), {**about, "_Encoding": "utf-8"}
            for dim, size in zip(dims, values.shape, strict=True):
                if dim not in file.dimensions:
                    file.createDimension(dim, size)
            written = file.createVariable(name, values.dtype, dims)
            written[:] = values
            _describe(written, about)


def _describe(target: Any, attributes: Mapping[str, Any]) -> None:
    for name, value in attributes.items():
        setattr(target, name, value.encode() if isinstance(value, str) else np.float64(value))
