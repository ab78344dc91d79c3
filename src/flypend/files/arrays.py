"""Arrays by name, in files of NumPy (.npz)."""

from __future__ import annotations

import re
import zlib
from collections.abc import Mapping
from io import BytesIO
from math import prod
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, ZipInfo

import numpy as np
from numpy.typing import NDArray

from flypend.errors import InputError
from flypend.files.reading import read_bytes
from flypend.files.schema import Field, check_arrays
from flypend.files.whole import whole_file

# Bytes of a file, and of its arrays unpacked. A checkpoint of the largest network has 0.4 MB.
MOST_BYTES = 2**24
# What a file that is cut short, changed or something else makes the libraries that unpack it raise.
_UNREADABLE = (OSError, EOFError, BadZipFile, zlib.error, KeyError, RuntimeError, TypeError, ValueError)
# The header of an array, as NumPy writes it; NumPy itself evaluates it as Python.
_HEADER = re.compile(
    rb"\x93NUMPY\x01\x00..\{'descr': '([<>|][biufU]\d+)', 'fortran_order': (False|True), "
    rb"'shape': \(([\d, ]*)\), \} *\n",
    re.DOTALL,
)


def save_arrays(path: Path, fields: Mapping[str, Field], arrays: Mapping[str, Any]) -> None:
    """Write `arrays`, which are as their `fields`, to the file `path`, .npz; equal arrays give equal bytes.

    Raises InputError if they are not, or the file is not writable.
    """
    checked = check_arrays(fields, arrays)
    with whole_file(path, (".npz",)) as partial, partial.open("wb") as stream:
        np.savez(stream, **checked)  # type: ignore[arg-type]


def read_arrays(field: str, path: Path, expected: str, fields: Mapping[str, Field]) -> dict[str, NDArray[Any]]:
    """Return the arrays of the file `path`, .npz, that are among `fields`.

    Raises InputError, for `field` and what is `expected`, if one is missing or not as its field, or the file cannot be
    read.
    """
    try:
        with ZipFile(BytesIO(read_bytes(path, MOST_BYTES))) as archive:
            return check_arrays(fields, _unpack(archive, fields))
    except (*_UNREADABLE, InputError) as error:
        raise InputError(field, expected, f"{path}: {error}") from None


def _unpack(archive: ZipFile, fields: Mapping[str, Field]) -> dict[str, NDArray[Any]]:
    """Return the arrays in `archive` that are among `fields`. Raises ValueError, and what unpacking raises."""
    names = archive.namelist()
    if len(set(names)) != len(names):
        raise ValueError("a name that is there twice")
    members = {name: archive.getinfo(f"{name}.npy") for name in fields if f"{name}.npy" in names}
    if (size := sum(member.file_size for member in members.values())) > MOST_BYTES:
        raise ValueError(f"{size} bytes unpacked, of which at most {MOST_BYTES} are read")
    return {name: _array(_content(archive, member)) for name, member in members.items()}


def _content(archive: ZipFile, member: ZipInfo) -> bytes:
    """Return the bytes of a `member`, no more than it says that there are."""
    if member.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
        raise ValueError(f"{member.filename} packed as flypend does not")
    with archive.open(member) as stream:
        return stream.read(member.file_size)


def _array(content: bytes) -> NDArray[Any]:
    """Return the array in the `content` of a file .npy, whose header and length agree. Raises ValueError."""
    if (header := _HEADER.match(content)) is None:
        raise ValueError("an array that NumPy has not written")
    kind, in_columns, lengths = (part.decode() for part in header.groups())
    dtype, shape = np.dtype(kind), tuple(int(length) for length in lengths.split(",") if length.strip())
    data = content[header.end() :]
    if dtype.itemsize * prod(shape) != len(data):
        raise ValueError(f"{len(data)} bytes for numbers of type {dtype} and shape {shape}")
    return np.ndarray(shape, dtype, data, order="F" if in_columns == "True" else "C")
