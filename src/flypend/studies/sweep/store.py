"""The Zarr store of a study: one chunk of every column per task, and a mark that it is whole.

A mark is a digest of the numbers of a chunk, written after them. A chunk without a mark, or whose numbers do not give
its mark (a file cut off by a power cut, a disk that lies), counts as not flown.
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
    "settling": "s", "excursion": "m", "peak_force": "N", "end": "s", "x": "m", "x_dot": "m/s", "omega": "rad/s",
    "y_dot": "1/s", "tilt": "rad", "azimuth": "rad", "heading": "rad", "rate": "1/s",
}  # fmt: skip
NOTES = {
    "settling": "since when the criterion holds to the end; NaN for a failure",
    "excursion": "largest distance of the pivot from its reference",
    "effort": "root mean square of the rotor forces over their share of the weight",
    "peak_force": "largest force of a rotor",
    "end": "when the run ended",
    "tilt": "of the rod from inverted",
    "quat_xyzw": "rotation from body to world, order x, y, z, w",
    "final": "packed final state: x, x_dot, R by rows, omega, y, y_dot",
    MARKS: "digest of a chunk of runs that is whole; 0 for one that is not",
}


class Store:
    """The store at a path: which chunks are whole, and the writing and reading of chunks."""

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
        """Columns `names` (default all) of chunk `number`."""
        return {name: self._arrays[name][self._rows(number)] for name in names or self.columns}

    def unmark(self, number: int) -> None:
        """Say that chunk `number` is not whole."""
        self._marks[number] = 0

    def whole(self, number: int, *, verify: bool = False) -> bool:
        """Whether chunk `number` has its mark; with `verify`, whether its numbers give it, too."""
        try:
            mark = int(self._marks[number])
            return mark != 0 and (not verify or mark == _digest(self.read(number)))
        except Exception:  # a file that cannot be decoded: Zarr and its codecs raise what they like
            return False

    def _rows(self, number: int) -> slice:
        return slice(number * self.chunk, min((number + 1) * self.chunk, self.runs))


def _digest(columns: Mapping[str, Any]) -> int:
    """Sixty-four bits of the SHA-256 of numbers and names, never 0."""
    digest = hashlib.sha256()
    for name in sorted(columns):
        digest.update(name.encode())
        digest.update(np.ascontiguousarray(columns[name]).data)
    return int.from_bytes(digest.digest()[:8], "little") or 1


def opened(path: str | Path, study: Study, program: str, versions: Mapping[str, str], like: Mapping[str, Any]) -> Store:
    """The store of `study` at `path`, made if there is none.

    Parameters
    ----------
    path, study
        Where, ending in .zarr; and what for.
    program : str
        Digest of what is flown.
    versions : dict
        Of this package and those that the numbers depend on.
    like : dict
        Columns of a few runs: their names, types and shapes.

    Raises
    ------
    InputError
        For what cannot be written, and for a store of another study, the difference named.
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
    """`path` as the name of a store. Raises InputError for one that does not end in .zarr."""
    path = Path(path)
    if path.suffix != ".zarr":
        raise InputError("store", "a name ending in .zarr", str(path))
    return path


def existing(path: str | Path) -> Store:
    """The store at `path`. Raises InputError if there is none that a sweep has written."""
    path = checked_path(path)
    require("zarr", extra="studies", for_="store")
    try:
        store = Store(path) if path.is_dir() else None
    except Exception as error:  # not Zarr, or metadata that cannot be read
        raise InputError(str(path), "a store that a sweep has written", error) from None
    if store is None or store.attributes.get("flypend") != "sweep":
        raise InputError(str(path), "a store that a sweep has written", "nothing" if store is None else "another")
    return store


def removed(path: str | Path) -> None:
    """Remove the store at `path`, if a sweep has written one there. Raises InputError for anything else."""
    path = checked_path(path)
    if path.exists():
        existing(path)
        aside = path.with_name(f".{uuid4().hex}.removed")  # whole or gone, also if this stops half-way
        path.rename(aside)
        shutil.rmtree(aside)


def _create(path: Path, study: Study, attributes: dict[str, Any], like: Mapping[str, Any]) -> None:
    """Make an empty store beside `path` and move it there."""
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
    """Raise InputError that names the first difference between the study of a store and the one at hand."""
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
    """The file beside a store at `path` that a sweep holds."""
    return path.with_name(f".{path.name}.lock")


@contextmanager
def alone(store: Store) -> Iterator[None]:
    """Hold the store against a second sweep. The system lets go of it when the process ends, in whatever way."""
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
        # While it is held: whoever has opened the file before sees that its name is gone, and opens a new one.
        with suppress(OSError):  # a system that does not remove what is open; releasing removes it there
            place.unlink()
        lock.release()
