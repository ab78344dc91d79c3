"""The Zarr store of a study: per task, one chunk of every column, and a mark that the chunk is complete.

A mark is a digest of the data of a chunk, written after the data. A chunk without a mark, or whose data do not match
it (a file truncated by a power cut, a faulty disk), counts as not flown.
"""

from __future__ import annotations

import hashlib
import shutil
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np
from filelock import FileLock, Timeout

from flypend.errors import InputError, require
from flypend.studies.sweep.chunk import CAUSES
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
    "omega": "rad/s", "y_dot": "1/s", "tilt": "rad", "azimuth": "rad", "heading": "rad", "rate": "1/s",
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


class Store:
    """The store at `path`: reads, writes and verifies chunks."""

    def __init__(self, path: Path) -> None:
        import zarr

        self.path = path
        self._group = zarr.open_group(path, mode="r+")
        self.attributes = dict(self._group.attrs)
        self._arrays: dict[str, Any] = {name: array for name, array in self._group.arrays() if name != MARKS}
        self._marks: Any = self._group[MARKS]

    @property
    def columns(self) -> list[str]:
        """Names of the columns, sorted."""
        return sorted(self._arrays)

    @property
    def runs(self) -> int:
        """Number of runs."""
        return int(self._arrays["cause"].shape[0])

    @property
    def chunk(self) -> int:
        """Runs per chunk."""
        return int(self._arrays["cause"].chunks[0])

    def write(self, number: int, columns: Mapping[str, Any]) -> None:
        """Write chunk `number`, then its mark."""
        for name in self.columns:
            self._arrays[name][self._rows(number)] = columns[name]
        self._marks[number] = _digest({name: np.asarray(columns[name]) for name in self.columns})

    def read(self, number: int, names: list[str] | None = None) -> dict[str, Any]:
        """Return the columns `names` (default all) of chunk `number`."""
        return {name: self._arrays[name][self._rows(number)] for name in names or self.columns}

    def unmark(self, number: int) -> None:
        """Mark chunk `number` as incomplete."""
        self._marks[number] = 0

    def whole(self, number: int, *, verify: bool = False) -> bool:
        """Whether chunk `number` has a mark; with `verify`, also whether its data match the mark."""
        try:
            mark = int(self._marks[number])
            return mark != 0 and (not verify or mark == _digest(self.read(number)))
        except Exception:  # undecodable data: Zarr and its codecs raise exceptions of many types
            return False

    def _rows(self, number: int) -> slice:
        return slice(number * self.chunk, min((number + 1) * self.chunk, self.runs))


def _digest(columns: Mapping[str, Any]) -> int:
    """Sixty-four bits of the SHA-256 of column names and data, never 0."""
    digest = hashlib.sha256()
    for name in sorted(columns):
        digest.update(name.encode())
        digest.update(np.ascontiguousarray(columns[name]).data)
    return int.from_bytes(digest.digest()[:8], "little") or 1


def opened(path: str | Path, study: Study, program: str, versions: Mapping[str, str], like: Mapping[str, Any]) -> Store:
    """Return the store of `study` at `path`, creating it if there is none.

    Parameters
    ----------
    path, study
        The path, which ends in .zarr; the study.
    program : str
        Digest of the program, from `program_digest`.
    versions : dict
        Versions of this package and of those on which the results depend.
    like : dict
        Columns of a few runs, for their names, types and shapes.

    Raises
    ------
    InputError
        If the path is not writable, or if the store belongs to another study (naming the first difference).
    """
    path = checked_path(path)
    attributes = {
        "flypend": "sweep",
        "study": study.text(),
        "program": program,
        "versions": dict(versions),
        "vehicle": study.flight.vehicle.name,
        "law": study.law.name,
        "e3": study.law.e3,
    }
    if not path.exists():
        _create(path, study, attributes, like)
    store = existing(path)
    _check_same(path, store.attributes, attributes)
    return store


def checked_path(path: str | Path) -> Path:
    """Return `path` as a `Path`. Raises InputError unless it ends in .zarr."""
    path = Path(path)
    if path.suffix != ".zarr":
        raise InputError("store", "a name ending in .zarr", str(path))
    return path


def existing(path: str | Path) -> Store:
    """Open the store at `path`. Raises InputError unless a sweep has written it."""
    path = checked_path(path)
    require("zarr", extra="studies", for_="store")
    try:
        store = Store(path) if path.is_dir() else None
    except Exception as error:  # not Zarr, or unreadable metadata
        raise InputError(str(path), "a store that a sweep has written", error) from None
    if store is None or store.attributes.get("flypend") != "sweep":
        raise InputError(str(path), "a store that a sweep has written", "nothing" if store is None else "another")
    return store


def removed(path: str | Path) -> None:
    """Remove the store at `path`, if any. Raises InputError if something other than a sweep's store is there."""
    path = checked_path(path)
    if path.exists():
        existing(path)
        aside = path.with_name(f".{uuid4().hex}.removed")  # atomic: present or gone, even if interrupted
        path.rename(aside)
        shutil.rmtree(aside)


def _create(path: Path, study: Study, attributes: dict[str, Any], like: Mapping[str, Any]) -> None:
    """Create an empty store next to `path` and rename it to `path`."""
    import zarr
    from zarr.codecs import BloscCodec, BloscShuffle

    partial = path.with_name(f".{path.stem}.partial")
    shutil.rmtree(partial, ignore_errors=True)
    try:
        group = zarr.create_group(partial, attributes=attributes)
        blosc = BloscCodec(cname="zstd", clevel=1, shuffle=BloscShuffle.shuffle)
        for name, value in like.items():
            dimensions = ["run"] if value.ndim == 1 else ["run", ROWS[name]]
            group.create_array(
                name,
                shape=(study.runs, *value.shape[1:]),
                chunks=(min(study.chunk, study.runs), *value.shape[1:]),
                dtype=value.dtype,
                compressors=blosc,
                dimension_names=dimensions,
                attributes=_notes(name),
                fill_value=np.nan if value.dtype.kind == "f" else 0,
            )
        group.create_array(
            MARKS, shape=(study.chunks,), chunks=(1,), dtype="uint64", compressors=None, dimension_names=["chunk"],
            attributes=_notes(MARKS), fill_value=0,
        )  # fmt: skip
        partial.rename(path)
    except OSError as error:
        raise InputError(str(path), "a folder that can be written", error.strerror or error) from None
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def _notes(name: str) -> dict[str, Any]:
    notes: dict[str, Any] = {"units": UNITS[name]} if name in UNITS else {}
    if name in NOTES:
        notes["long_name"] = NOTES[name]
    if name == "cause":
        notes |= {"flag_values": list(range(len(CAUSES))), "flag_meanings": " ".join(CAUSES)}
    return notes


def _check_same(path: Path, found: Mapping[str, Any], wanted: Mapping[str, Any]) -> None:
    """Raise InputError, naming the first difference, unless the store belongs to this study."""
    there, here = (
        _flat({"study": tomllib.loads(each["study"]), "versions": each["versions"]}) for each in (found, wanted)
    )
    for key in sorted(set(there) | set(here)):
        if there.get(key) != here.get(key):
            which = f"{there.get(key, 'nothing')}, as in {path} (--force replaces it)"
            raise InputError(key.removeprefix("study."), which, here.get(key, "nothing"))
    if found["program"] != wanted["program"]:
        raise InputError(str(path), "the equations that it was begun with (--force replaces it)", "others")


def _flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    out: dict[str, Any] = {}
    for key, value in table.items():
        out |= _flat(value, f"{prefix}{key}.") if isinstance(value, Mapping) else {f"{prefix}{key}": value}
    return out


def lock_of(path: Path) -> Path:
    """Return the path of the lock file of the store at `path`."""
    return path.with_name(f".{path.name}.lock")


@contextmanager
def alone(store: Store) -> Iterator[None]:
    """Lock the store against a second sweep. The system releases the lock however the process ends."""
    place = lock_of(store.path)
    lock = FileLock(place, timeout=0)
    try:
        lock.acquire()
    except Timeout:
        raise InputError(str(store.path), "a store that no other sweep is writing", "one in use") from None
    except OSError as error:
        raise InputError(str(place), "a file that can be written", error.strerror or error) from None
    try:
        yield
    finally:
        # Unlink while holding the lock: a process that has the old file open notices and opens a new one.
        with suppress(OSError):  # some systems cannot unlink an open file; there, releasing the lock removes it
            place.unlink()
        lock.release()
