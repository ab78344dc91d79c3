"""The arrays of a store: one per column, in chunks of runs, and one of marks."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from flypend.errors import InputError
from flypend.studies.sweep.chunk import CAUSES
from flypend.studies.sweep.claim import aside
from flypend.studies.sweep.study import Study

MARKS = "whole"
ROWS = {
    "y": "axis",
    "y_dot": "axis",
    "x": "axis",
    "x_dot": "axis",
    "omega": "axis",
    "quat_xyzw": "quat",
    "final": "packed",
}
UNITS = {
    "settling": "s", "excursion": "m", "peak_force": "N", "end": "s", "clearance": "m", "x": "m", "x_dot": "m/s",
    "omega": "rad/s",
    "y_dot": "1/s", "tilt": "rad", "azimuth": "rad", "heading": "rad", "rate": "1/s",
}  # fmt: skip
NOTES = {
    "settling": "time from which the criterion holds to the end; NaN for a failure",
    "excursion": "largest distance of the pivot from its reference",
    "effort": "root mean square of the rotor forces over their share of the weight",
    "peak_force": "largest force of any rotor",
    "end": "time at which the run ended",
    "clearance": "least distance of the rod to what its mount lets it touch; infinite on a gimbal",
    "tilt": "tilt of the rod from inverted",
    "quat_xyzw": "rotation from body to world, order x, y, z, w",
    "final": "packed final state: x, x_dot, R (row-major), omega, y, y_dot",
    MARKS: "digest of a complete chunk of runs; 0 for an incomplete one",
}
Columns = Mapping[str, tuple[str, list[int]]]


def columns_of(like: Mapping[str, Any]) -> dict[str, tuple[str, list[int]]]:
    """Return type and shape of a row of each column of `like`, as a store's attributes list them."""
    return {name: (value.dtype.str, list(value.shape[1:])) for name, value in sorted(like.items())}


def create(path: Path, study: Study, attributes: Mapping[str, Any], columns: Columns) -> None:
    """Create an empty store beside `path` and rename it to `path`. The caller holds the lock.

    Raises InputError if the folder cannot be written.
    """
    import zarr

    partial = aside(path, "partial")
    try:
        group = zarr.create_group(partial, attributes=dict(attributes))
        add_arrays(group, study, columns)
        partial.rename(path.resolve())
    except OSError as error:
        raise InputError(str(path), "a folder that can be written", error.strerror or error) from None
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def add_arrays(group: Any, study: Study, columns: Columns) -> None:
    """Create the array of each column in the Zarr `group`, and that of the marks; metadata only."""
    from zarr.codecs import BloscCodec, BloscShuffle

    blosc = BloscCodec(cname="zstd", clevel=1, shuffle=BloscShuffle.shuffle)
    for name, (kind, row) in columns.items():
        dtype = np.dtype(kind)
        group.create_array(
            name,
            shape=(study.runs, *row),
            chunks=(min(study.chunk, study.runs), *row),
            dtype=dtype,
            compressors=blosc,
            dimension_names=["run", ROWS[name]] if row else ["run"],
            attributes=_notes(name),
            fill_value=np.nan if dtype.kind == "f" else 0,
        )
    group.create_array(
        MARKS, shape=(study.chunks,), chunks=(1,), dtype="uint64", compressors=None, dimension_names=["chunk"],
        attributes=_notes(MARKS), fill_value=0,
    )  # fmt: skip


def model(study: Study, columns: Columns) -> Any:
    """Return a store in memory with the arrays of `add_arrays` and no data, to compare with."""
    import zarr

    group = zarr.create_group(zarr.storage.MemoryStore())
    add_arrays(group, study, columns)
    return group


def alike(found: Any, wanted: Any) -> bool:
    """Whether two arrays agree in all that decides what their chunks mean."""
    names = ("shape", "chunks", "dtype")
    same = all(getattr(found, name) == getattr(wanted, name) for name in names)
    dimensions = found.metadata.dimension_names == wanted.metadata.dimension_names
    return same and dimensions and dict(found.attrs) == dict(wanted.attrs)


def _notes(name: str) -> dict[str, Any]:
    notes: dict[str, Any] = {"units": UNITS[name]} if name in UNITS else {}
    if name in NOTES:
        notes["long_name"] = NOTES[name]
    if name == "cause":
        notes |= {"flag_values": list(range(len(CAUSES))), "flag_meanings": " ".join(CAUSES)}
    return notes
