"""The Zarr store of a study: per task, one chunk of every column, and a mark that the chunk is complete.

A mark is a digest of the chunk: of the store's attributes, the chunk's number and its data. It is written after the
data. A chunk without a mark counts as not flown; one that does not match its mark (truncated by a power cut, lost,
copied from elsewhere) is flown again by a sweep and refused by every reader.
"""

from __future__ import annotations

import hashlib
import json
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np

from flypend.errors import InputError, require
from flypend.files.reading import MOST_TEXT, parse_json, read_bytes, read_text
from flypend.files.schema import check_arrays, check_attributes
from flypend.studies.sweep import layout
from flypend.studies.sweep.claim import check_path, clear, remove
from flypend.studies.sweep.layout import MARKS
from flypend.studies.sweep.study import Study, comparable, study_in

METADATA = "zarr.json"
ATTRIBUTES = ("study", "program", "vehicle", "law", "e3", "seal", "id")
_NUMBER = re.compile(r"\d{1,9}")


class Store:
    """The store of `study` at `path`: reads, writes and verifies chunks.

    Raises InputError, if `writable` is false, for arrays whose metadata are not those of the study; they are restored
    otherwise.
    """

    def __init__(self, path: Path, group: Any, study: Study, *, writable: bool) -> None:
        self.path = path
        self._group = group
        self.attributes = dict(group.attrs)
        self.study = study
        self._fields = layout.columns_of(self.study)
        self._arrays = self._open(writable)
        self._marks: Any = self._arrays.pop(MARKS)

    @property
    def columns(self) -> list[str]:
        """Names of the columns, sorted."""
        return sorted(self._arrays)

    def write(self, number: int, columns: Mapping[str, Any]) -> None:
        """Write chunk `number`, then its mark.

        Raises InputError if a column is not as a reader expects it, a file cannot be written, or the store is gone.
        """
        self._check(columns)
        mark = self._digest(number, columns)
        try:
            for name in self.columns:
                self._check_place()
                self._arrays[name][self._rows(number)] = np.ascontiguousarray(columns[name])
            self._check_place()
            self._marks[number] = mark
        except OSError as error:
            where = str(error.filename2 or self.path)  # of a rename, not the temporary file that is renamed
            wanted = "a file that can be written (rerun to resume)"
            raise InputError(where, wanted, error.strerror or error) from None

    def read(self, number: int, names: list[str] | None = None) -> dict[str, Any]:
        """Return the columns `names` (default all) of chunk `number`. Raises InputError unless it matches its mark."""
        try:
            columns = {}
            for name, array in sorted(self._arrays.items()):
                layout.check_packed(self.path / name, number, array)
                columns[name] = array[self._rows(number)]
            sound = self._mark(number) == self._digest(number, columns)
        except Exception:  # undecodable data: Zarr and its codecs raise exceptions of many types
            sound = False
        if not sound:
            wanted = f"chunk {number} as it was written (flypend sweep flies it again)"
            raise InputError(str(self.path), wanted, "a chunk that does not match its digest")
        self._check(columns)
        return columns if names is None else {name: columns[name] for name in names}

    def _check(self, columns: Mapping[str, Any]) -> None:
        """Raise InputError unless `columns` are as those of a chunk of the study."""
        try:
            found = check_arrays(self._fields, columns)
        except InputError as error:
            wanted = f"chunks whose {error.field} has {error.expected} (--force replaces the store)"
            raise InputError(str(self.path), wanted, error.got) from None
        if np.any(found["success"] != (found["cause"] == 0)):
            raise InputError(str(self.path), "the cause 0 for success (--force replaces the store)", "others")

    def numbers(self) -> list[int]:
        """Return the numbers of the chunks for which `is_flown`, without asking for every chunk."""
        folder = self.path / MARKS / "c"
        names = {entry.name for entry in folder.iterdir()} if folder.is_dir() else set()
        found = sorted(int(name) for name in names if _NUMBER.fullmatch(name))
        return [number for number in found if number < self.study.chunks and self.is_flown(number)]

    def is_flown(self, number: int) -> bool:
        """Whether chunk `number` has been flown: it has a mark, which is perhaps unreadable."""
        try:
            return self._mark(number) != 0
        except Exception:  # as in `read`
            return True

    def whole(self, number: int) -> bool:
        """Whether chunk `number` has been flown and matches its mark."""
        try:
            return self.is_flown(number) and bool(self.read(number))
        except InputError:
            return False

    def _mark(self, number: int) -> int:
        layout.check_packed(self.path / MARKS, number, self._marks)
        return int(self._marks[number])

    def _rows(self, number: int) -> slice:
        rows = self.study.rows(number)
        return slice(rows.start, rows.stop)

    def _digest(self, number: int, columns: Mapping[str, Any]) -> int:
        """Sixty-four bits of the SHA-256 of attributes, number and data, never 0."""
        digest = hashlib.sha256(f"{self.attributes['seal']} {number}".encode())
        for name in self.columns:
            value = np.ascontiguousarray(columns[name])
            digest.update(f"{name} {value.dtype.str} {value.shape}".encode())
            digest.update(value.data)
        return int.from_bytes(digest.digest()[:8], "little") or 1

    def _check_place(self) -> None:
        """Raise InputError unless the folder at the path is still this store."""
        try:
            found = parse_json(read_text(self.path / METADATA))["attributes"]["id"]
        except (OSError, ValueError, LookupError, TypeError):
            found = None
        if found != self.attributes["id"]:
            raise InputError(str(self.path), "the store that this sweep has begun", "nothing, or another one")

    def _open(self, writable: bool) -> dict[str, Any]:
        """The arrays by name, their metadata compared with those of a new store."""
        model, files = layout.model(self.study)
        found = {}
        for name, wanted in model.arrays():
            array = _array_in(self.path, self._group, name)
            if array is None or not layout.alike(array, wanted):
                if not writable:
                    wanted = f"the metadata of {name} as they were written (flypend sweep restores them)"
                    raise InputError(str(self.path), wanted, "none" if array is None else "others")
                _restore(self.path / name / METADATA, files[f"{name}/{METADATA}"].to_bytes())
                array = self._group[name]
            found[name] = array
        return found


def _array_in(path: Path, group: Any, name: str) -> Any:
    """Return the array `name` of `group`, the store at `path`; None if it cannot be opened."""
    import zarr

    try:
        read_bytes(path / name / METADATA, MOST_TEXT)
        array = group[name]
    except Exception:  # as in `Store.read`
        return None
    return array if isinstance(array, zarr.Array) else None


def _restore(target: Path, metadata: bytes) -> None:
    """Write the `metadata` of an array."""
    try:
        target.parent.mkdir(exist_ok=True)
        partial = target.with_name(f"zarr.{uuid4().hex}.partial")
        partial.write_bytes(metadata)
        partial.replace(target)
    except OSError as error:
        raise InputError(str(target), "a file that can be written", error.strerror or error) from None


def open_store(path: str | Path, study: Study, program: str, versions: Mapping[str, str]) -> Store:
    """Return the store of `study` at `path` for writing, creating it if there is none. The caller holds its lock.

    `program` is the digest from `program_digest`, `versions` are those of the packages on which the results depend.
    Raises InputError if the path is not writable, or if the store is another study's (naming the first difference).
    """
    path = check_path(path)
    attributes: dict[str, Any] = {
        "flypend": "sweep",
        "study": study.text(path.parent),
        "program": program,
        "versions": dict(versions),
        "vehicle": study.flight.vehicle.name,
        "law": study.law.name,
        "e3": study.law.e3,
    }
    clear(path)
    if not path.exists():
        layout.create(path, study, {**attributes, "id": uuid4().hex, "seal": _seal(attributes)})
    group = _sealed_group(path)
    _study_in(path, dict(group.attrs))  # raises for one that cannot be compared
    _check_same(path, dict(group.attrs), attributes)
    return Store(path, group, study, writable=True)


def find_store(path: str | Path) -> Store:
    """Open the store at `path` for reading. Raises InputError unless a sweep has written it and its metadata are whole.

    Its study is without its law: see `study_in`.
    """
    path = check_path(path)
    group = _sealed_group(path)
    return Store(path, group, _study_in(path, dict(group.attrs)), writable=False)


def _sealed_group(path: Path) -> Any:
    """The Zarr group of a sweep at `path`. Raises InputError unless its attributes are as they were written."""
    group = _group_at(path)
    attributes = dict(group.attrs)
    if attributes.get("seal") != _seal(attributes) or not isinstance(attributes.get("id"), str):
        wanted = "the attributes that a sweep has written (--force replaces the store)"
        raise InputError(str(path), wanted, "others: they were changed, or are of another version of flypend")
    return group


def discard(path: str | Path) -> None:
    """Delete the store at `path`, if any, whole or not. The caller holds its lock.

    Raises InputError if something is there that no sweep has written.
    """
    path = check_path(path)
    if path.exists():
        _group_at(path)
        remove(path)


def _group_at(path: Path) -> Any:
    """The Zarr group of a sweep at `path`. Raises InputError if there is none."""
    require("zarr", extra="studies", for_="store")
    import zarr

    wanted = "a store that a sweep has written"
    try:
        if path.is_dir():
            read_bytes(path / METADATA, MOST_TEXT)
        group = zarr.open_group(path, mode="r+", use_consolidated=False, zarr_format=3) if path.is_dir() else None
    except Exception as error:  # not Zarr, or unreadable metadata
        raise InputError(str(path), wanted, error) from None
    if group is None or group.attrs.get("flypend") != "sweep":
        raise InputError(str(path), wanted, "nothing" if group is None else "another")
    return group


def _seal(attributes: Mapping[str, Any]) -> str:
    """Return the digest of all attributes but the id, which says nothing about the runs, and the seal itself."""
    with_checksum = {name: value for name, value in attributes.items() if name not in ("id", "seal")}
    return hashlib.sha256(json.dumps(with_checksum, sort_keys=True).encode()).hexdigest()


def _study_in(path: Path, attributes: Mapping[str, Any]) -> Study:
    """The study of a store, without its law. Raises InputError if it cannot be read."""
    try:
        texts = check_attributes(dict.fromkeys(ATTRIBUTES, str), attributes)
        return study_in(texts["study"], texts["law"], texts["e3"])
    except InputError as error:
        wanted = f"a store whose study can be read ({error.field}: expected {error.expected})"
        raise InputError(str(path), wanted, error.got) from None


def _check_same(path: Path, found: Mapping[str, Any], wanted: Mapping[str, Any]) -> None:
    """Raise InputError, naming the first difference, unless the store belongs to this study."""
    there, here = (
        _flat({"study": comparable(tomllib.loads(each["study"])), "versions": each["versions"]})
        for each in (found, wanted)
    )
    for key in sorted(set(there) | set(here)):
        if there.get(key) != here.get(key):
            which = f"{there.get(key, 'nothing')}, as in {path} (--force replaces it)"
            raise InputError(key.removeprefix("study."), which, here.get(key, "nothing"))
    if any(found[key] != wanted[key] for key in ("program", "vehicle", "law", "e3")):
        raise InputError(str(path), "the equations that it was begun with (--force replaces it)", "others")


def _flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    out: dict[str, Any] = {}
    for key, value in table.items():
        out |= _flat(value, f"{prefix}{key}.") if isinstance(value, Mapping) else {f"{prefix}{key}": value}
    return out
