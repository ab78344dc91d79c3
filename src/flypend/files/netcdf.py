"""Named arrays in NetCDF files (classic format, 64-bit offsets), read and written with NumPy alone.

SciPy can do this too, but would make up a fifth of an installation. The format follows appendix B of the NetCDF User's
Guide: a header of dimensions, attributes and variables, then the data, big-endian and padded to four bytes. Record
dimensions are not supported, except that the writer stores an array of length 0 as one with no records.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np

from flypend.files.reading import read_bytes

T = TypeVar("T")
DIMENSIONS, VARIABLES, ATTRIBUTES = 10, 11, 12
CHARACTERS, DOUBLES = 2, 6
KINDS = {1: ">i1", CHARACTERS: "S1", 3: ">i2", 4: ">i4", 5: ">f4", DOUBLES: ">f8"}
MAGIC = b"CDF\x02"
# Budgets of a file that is read, before anything is allocated. An hour of flight at 500 Hz takes 0.7 GB.
MOST_BYTES = 2**32
COPIES = 3  # the bytes, the numbers in the machine's order, and those in double precision
MOST_ENTRIES = 10_000  # dimensions, attributes and variables together; a run has some sixty
MOST_DIMENSIONS = 8  # of one variable; the rotations of a run have three


class Variable(NamedTuple):
    """An array of numbers or strings with its dimension names and attributes: the arguments of `xarray.Variable`."""

    dims: tuple[str, ...]
    values: Any
    attributes: Mapping[str, Any] = {}


def write_netcdf(path: Path, variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> None:
    """Write `variables` and the global `attributes` (strings and numbers) to `path`. Raises OSError."""
    stored = {name: _to_stored(name, variable) for name, variable in variables.items()}
    sizes = {dim: size for v in stored.values() for dim, size in zip(v.dims, v.values.shape, strict=True)}
    blocks = [_pad(variable.values.tobytes()) for variable in stored.values()]
    begin = len(_header(stored, sizes, attributes, [0] * len(blocks)))
    begins = [begin + sum(map(len, blocks[:place])) for place in range(len(blocks))]
    path.write_bytes(_header(stored, sizes, attributes, begins) + b"".join(blocks))


def _to_stored(name: str, variable: Variable) -> Variable:
    """Convert `variable` to a NetCDF type: big-endian floats; strings as characters along an extra dimension."""
    dims, values, about = variable.dims, np.asarray(variable.values), variable.attributes
    if values.dtype.kind == "U":
        encoded = np.char.encode(values, "utf-8")
        characters = encoded.view("S1").reshape(*values.shape, -1)
        return Variable((*dims, f"{name}_length"), characters, {**about, "_Encoding": "utf-8"})
    return Variable(dims, values.astype(">f4" if values.dtype == np.float32 else ">f8"), about)


def _header(
    stored: Mapping[str, Variable], sizes: Mapping[str, int], attributes: Mapping[str, Any], begins: list[int]
) -> bytes:
    """Return the header: `sizes` of the dimensions, and where each stored variable `begins`, in bytes."""
    places = {dim: place for place, dim in enumerate(sizes)}
    out = [MAGIC, _int(0), _list_of(DIMENSIONS, [_text(dim) + _int(size) for dim, size in sizes.items()])]
    out += [_attributes(attributes)]
    entries = []
    for (name, (dims, values, about)), begin in zip(stored.items(), begins, strict=True):
        kind = next(kind for kind, dtype in KINDS.items() if np.dtype(dtype) == values.dtype)
        record = math.prod(values.shape[1:]) if 0 in values.shape[:1] else values.size
        size = -(-record * values.itemsize // 4) * 4
        ids = b"".join(_int(places[dim]) for dim in dims)
        entry = [_text(name), _int(len(dims)), ids, _attributes(about), _int(kind), _int(size), begin.to_bytes(8)]
        entries.append(b"".join(entry))
    return b"".join([*out, _list_of(VARIABLES, entries)])


def _attributes(attributes: Mapping[str, Any]) -> bytes:
    entries = []
    for name, value in attributes.items():
        content = value.encode() if isinstance(value, str) else np.array(value, ">f8").tobytes()
        kind, count = (CHARACTERS, len(content)) if isinstance(value, str) else (DOUBLES, len(content) // 8)
        entries.append(_text(name) + _int(kind) + _int(count) + _pad(content))
    return _list_of(ATTRIBUTES, entries)


def _list_of(tag: int, entries: list[bytes]) -> bytes:
    return _int(tag) + _int(len(entries)) + b"".join(entries) if entries else _int(0) + _int(0)


def _text(text: str) -> bytes:
    return _int(len(text.encode())) + _pad(text.encode())


def _int(value: int) -> bytes:
    return value.to_bytes(4)


def _pad(content: bytes) -> bytes:
    return content + bytes(-len(content) % 4)


def read_netcdf(path: Path) -> tuple[dict[str, Variable], dict[str, Any]]:
    """Read the variables of the file at `path`, strings as arrays of single characters, and its global attributes.

    Raises OSError if it cannot be read, InputError if it is larger than `MOST_BYTES` or the free memory, and ValueError
    if it is not NetCDF in the classic format, is truncated, has records, names anything twice, or lets two variables
    share bytes: what is read takes no more memory than the file, but for the type of its numbers.
    """
    return _Reader(memoryview(read_bytes(path, MOST_BYTES, COPIES))).file()


class _Entry(NamedTuple):
    """A variable as the header describes it; its data are the bytes from `begin` to `end`."""

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    attributes: dict[str, Any]
    dtype: np.dtype[Any]
    begin: int
    end: int


class _Reader:
    """The bytes of a file and the read position."""

    def __init__(self, content: memoryview) -> None:
        self._content, self._at, self._left = content, 4, MOST_ENTRIES
        magic = bytes(content[:4])
        if magic not in (b"CDF\x01", MAGIC):
            kind = "NetCDF 4" if magic == b"\x89HDF" else "an empty file" if not content else "another file"
            raise ValueError(f"{kind}, not NetCDF in the classic format")
        self._offset = 4 if magic[3] == 1 else 8

    def file(self) -> tuple[dict[str, Variable], dict[str, Any]]:
        if self._int():
            raise ValueError("files with records are not supported")
        dimensions = list(self._read_named(DIMENSIONS, lambda _: self._int()).items())
        attributes = self._read_named(ATTRIBUTES, self._attribute)
        entries = self._read_named(VARIABLES, lambda name: self._entry(name, dimensions))
        self._check_apart(entries)
        return {name: self._variable(entry) for name, entry in entries.items()}, attributes

    def _read_named(self, tag: int, read: Callable[[str], T]) -> dict[str, T]:
        """Return what `read` returns for the name of each entry of a list. Raises ValueError for a name twice."""
        kind, count = self._int(), self._int()
        if kind != tag and (kind or count):
            raise ValueError("corrupt header")
        self._left -= count
        if self._left < 0:
            raise ValueError(f"a header of more than {MOST_ENTRIES} entries")
        found: dict[str, T] = {}
        for _ in range(count):
            if (name := self._text()) in found:
                raise ValueError("corrupt header (a name that is there twice)")
            found[name] = read(name)
        return found

    def _entry(self, name: str, dimensions: list[tuple[str, int]]) -> _Entry:
        numbers = [self._int() for _ in range(min(self._int(), MOST_DIMENSIONS + 1))]
        if len(numbers) > MOST_DIMENSIONS or any(number >= len(dimensions) for number in numbers):
            raise ValueError(f"corrupt header (dimensions of {name})")
        about, dtype = self._read_named(ATTRIBUTES, self._attribute), self._dtype()
        self._int()  # size in bytes, implied by the shape
        begin = int.from_bytes(self._take(self._offset))
        dims = tuple(dimensions[number][0] for number in numbers)
        shape = tuple(dimensions[number][1] for number in numbers)
        return _Entry(dims, shape, about, dtype, begin, begin + math.prod(shape) * dtype.itemsize)

    def _check_apart(self, entries: Mapping[str, _Entry]) -> None:
        """Raise ValueError unless the data of all variables lie behind the header, inside the file, and apart."""
        before = self._at
        for name, entry in sorted(entries.items(), key=lambda item: item[1].begin):
            if entry.end > len(self._content):
                raise ValueError(f"a file that is cut off (inside {name})")
            if entry.end > entry.begin < before:
                raise ValueError(f"corrupt header ({name} shares bytes)")
            before = max(before, entry.end)

    def _variable(self, entry: _Entry) -> Variable:
        data = self._content[entry.begin : entry.end]
        values = np.frombuffer(data, entry.dtype).reshape(entry.shape).astype(entry.dtype.newbyteorder("="))
        return Variable(entry.dims, values, entry.attributes)

    def _attribute(self, _name: str) -> Any:
        dtype, count = self._dtype(), self._int()
        content = self._take(count * dtype.itemsize)
        self._take(-len(content) % 4)
        if dtype.kind == "S":
            return content.decode().rstrip("\0")  # SciPy writes "" as "\0"
        values = np.frombuffer(content, dtype)
        return values[0] if count == 1 else values

    def _dtype(self) -> np.dtype[Any]:
        kind = self._int()
        if kind not in KINDS:
            raise ValueError(f"unknown data type ({kind})")
        return np.dtype(KINDS[kind])

    def _text(self) -> str:
        length = self._int()
        text = self._take(length).decode()
        self._take(-length % 4)
        return text

    def _int(self) -> int:
        return int.from_bytes(self._take(4))

    def _take(self, count: int) -> bytes:
        content = bytes(self._content[self._at : self._at + count])
        if len(content) != count:
            raise ValueError("a file that is cut off (inside its header)")
        self._at += count
        return content
