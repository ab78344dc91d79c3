"""Arrays by name, from files of NumPy."""

from __future__ import annotations

import zlib
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from flypend.errors import InputError

# What a file that is cut short, changed or something else makes NumPy and its libraries raise.
UNREADABLE = (OSError, EOFError, BadZipFile, zlib.error, KeyError, MemoryError, RuntimeError, TypeError, ValueError)


def read_arrays(field: str, path: Path, expected: str) -> dict[str, NDArray[Any]]:
    """Return all arrays of the file `path`, .npz, by name.

    Raises InputError, for `field` and what is `expected`, if there is none, or it cannot be read as a whole.
    """
    try:
        # From memory: of a damaged file NumPy leaves the stream open.
        with np.load(BytesIO(path.read_bytes()), allow_pickle=False) as stored:
            return {name: stored[name] for name in stored.files}
    except UNREADABLE as error:
        raise InputError(field, expected, f"{path}: {error}") from None
