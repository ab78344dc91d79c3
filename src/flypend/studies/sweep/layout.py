"""The arrays of a store: one per column, in chunks of runs, and one of marks."""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from flypend.errors import InputError
from flypend.files.reading import read_bytes
from flypend.files.schema import Field
from flypend.model.state import SIZE
from flypend.studies.sweep.chunk import CAUSES, FLOATS
from flypend.studies.sweep.claim import unused_name
from flypend.studies.sweep.design import design
from flypend.studies.sweep.study import Study

MARKS = "whole"
LARGEST_HEADER = 16  # bytes that Blosc adds to what it cannot compress
ROWS = dict.fromkeys(("x", "x_dot", "omega", "y", "y_dot"), "axis") | {"quat_xyzw": "quat", "final": "packed"}
UNITS = {
    "settling": "s", "excursion": "m", "peak_force": "N", "end": "s", "clearance": "m", "x": "m", "x_dot": "m/s",
    "omega": "rad/s", "lowest": "m", "box_x": "m", "box_y": "m", "box_z": "m",
    "y_dot": "1/s", "tilt": "rad", "azimuth": "rad", "heading": "rad", "rate": "1/s",
}  # fmt: skip
NOTES = {
    "settling": "time from which the criterion holds to the end; NaN for a failure",
    "excursion": "largest distance of the pivot from its reference",
    "effort": "root mean square of the rotor forces over their share of the weight",
    "peak_force": "largest force of any rotor",
    "end": "time at which the run ended",
    "clearance": "least distance of the rod to what its mount lets it touch; infinite on a gimbal",
    "lowest": "height of the lowest point of hub, rod and rotor discs; NaN in the ideal plant",
    **{f"box_{axis}": f"size along {axis} of the box that holds the machine; NaN in the ideal plant" for axis in "xyz"},
    "tilt": "tilt of the rod from inverted",
    "quat_xyzw": "rotation from body to world, order x, y, z, w",
    "final": "packed final state: x, x_dot, R (row-major), omega, y, y_dot",
    MARKS: "digest of a complete chunk of runs; 0 for an incomplete one",
}


def columns_of(study: Study) -> dict[str, Field]:
    """Return the columns of a store of `study`, by name: what varies, how a run ended, and perhaps its last state."""
    drawn = design(replace(study, samples=1, sampling="uniform"), 0, 1).columns
    found = {name: Field(("run", *value.shape[1:]), "<f4") for name, value in drawn.items()}
    found |= {name: Field(("run",), "<f4", finite=False) for name in FLOATS}  # of a run that failed, some are NaN
    found |= {"success": Field(("run",), "|b1"), "cause": Field(("run",), "|u1", low=0, high=len(CAUSES) - 1)}
    found |= {"final": Field(("run", SIZE), "<f8", finite=False)} if study.final else {}
    return dict(sorted(found.items()))


def create(path: Path, study: Study, attributes: Mapping[str, Any]) -> None:
    """Create an empty store beside `path` and rename it to `path`. The caller holds the lock.

    Raises InputError if the folder cannot be written.
    """
    import zarr

    partial = unused_name(path, "partial")
    try:
        group = zarr.create_group(partial, attributes=dict(attributes))
        add_arrays(group, study)
        partial.rename(path.resolve())
    except OSError as error:
        raise InputError(str(path), "a folder that can be written", error.strerror or error) from None
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def add_arrays(group: Any, study: Study) -> None:
    """Create the array of each column in the Zarr `group`, and that of the marks; metadata only."""
    from zarr.codecs import BloscCodec, BloscShuffle

    blosc = BloscCodec(cname="zstd", clevel=1, shuffle=BloscShuffle.shuffle)
    for name, field in columns_of(study).items():
        dtype, row = np.dtype(field.dtype), field.dims[1:]
        group.create_array(
            name, shape=(study.runs, *row), chunks=(min(study.chunk, study.runs), *row), dtype=dtype, compressors=blosc,
            dimension_names=["run", ROWS[name]] if row else ["run"], attributes=_notes(name),
            fill_value=np.nan if dtype.kind == "f" else 0,
        )  # fmt: skip
    group.create_array(
        MARKS, shape=(study.chunks,), chunks=(1,), dtype="uint64", compressors=None, dimension_names=["chunk"],
        attributes=_notes(MARKS), fill_value=0,
    )  # fmt: skip


def model(study: Study) -> tuple[Any, Mapping[str, Any]]:
    """Return a store in memory with the arrays of `add_arrays` and no data, to compare with, and its files."""
    import zarr

    files: dict[str, Any] = {}
    group = zarr.create_group(zarr.storage.MemoryStore(files))
    add_arrays(group, study)
    return group, files


def alike(found: Any, wanted: Any) -> bool:
    """Whether two arrays have the same metadata, as written: what their chunks mean, and how they are packed."""
    # As text, for a fill value of NaN is not equal to itself.
    first, second = (json.dumps(array.metadata.to_dict(), default=str, sort_keys=True) for array in (found, wanted))
    return first == second


def check_packed(folder: Path, number: int, array: Any) -> None:
    """Raise ValueError unless chunk `number` of the `array` in `folder` says that it unpacks to what a chunk holds.

    Blosc takes the memory that the first bytes of a chunk ask for.
    """
    size = math.prod(array.chunks) * array.dtype.itemsize
    path = folder.joinpath("c", str(number), *["0"] * (array.ndim - 1))
    try:
        content = read_bytes(path, size + LARGEST_HEADER)
    except FileNotFoundError:  # of a chunk that is all fill values Zarr writes none
        return
    if array.compressors and int.from_bytes(content[4:8], "little") != size:
        raise ValueError(f"{path}: {len(content)} bytes that do not unpack to {size}")


def _notes(name: str) -> dict[str, Any]:
    notes: dict[str, Any] = {"units": UNITS[name]} if name in UNITS else {}
    if name in NOTES:
        notes["long_name"] = NOTES[name]
    if name == "cause":
        notes |= {"flag_values": list(range(len(CAUSES))), "flag_meanings": " ".join(CAUSES)}
    return notes
