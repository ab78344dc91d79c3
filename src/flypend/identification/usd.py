"""Logs of the Crazyflie's µSD card deck, in the firmware's own format: variables by name, as cfusdlog reads them.

    0xBC, version 2, number of kinds of events; of each kind its id, its name and its variables, "group.name(type)"
    events: id, time in µs, the variables packed
    CRC-32 of all that

Types are letters of Python's struct. The firmware writes the checksum when logging is stopped.
"""

from __future__ import annotations

import struct
from typing import Any
from zlib import crc32

import numpy as np

from flypend import errors
from flypend.errors import InputError

MAGIC = b"\xbc\x02\x00"  # of version 2, which firmware since 2021 writes
SAMPLED = "fixedFrequency"  # the events that are written at a fixed rate, not when something happens
TYPES = "BbHhIife"
CHECKSUM = 4  # bytes


def is_usd(content: bytes | bytearray) -> bool:
    """Whether a file with this `content` is such a log."""
    return content.startswith(MAGIC)


def parse_usd(content: bytes | bytearray, field: str = "log") -> dict[str, Any]:
    """Return the variables (k,) that were sampled at a fixed rate, by name, with "timestamp" in ms.

    Raises InputError for a checksum that does not fit, as after power off while logging, and for any other content.
    """
    sum_of = crc32(content[:-CHECKSUM])
    if content[-CHECKSUM:] != sum_of.to_bytes(CHECKSUM, "little"):
        raise InputError(field, "a whole µSD log, stopped before power off", "a checksum that does not fit")
    try:
        kinds, begin = _kinds(content)
        return _sampled(content, kinds, begin, field)
    except (struct.error, ValueError, IndexError, KeyError) as error:
        raise InputError(field, "a µSD log of the Crazyflie", f"{type(error).__name__}: {error}") from None


def _kinds(content: bytes | bytearray) -> tuple[dict[int, tuple[str, list[str], struct.Struct]], int]:
    """Return name, variables and layout of each kind of event by its id, and where the events begin."""
    (count,), at = struct.unpack_from("<H", content, len(MAGIC)), len(MAGIC) + 2
    kinds = {}
    for _ in range(count):
        (number,) = struct.unpack_from("<H", content, at)
        name, at = _text(content, at + 2)
        (width,), at = struct.unpack_from("<H", content, at), at + 2
        variables, layout = [], "<"
        for _ in range(width):
            variable, at = _text(content, at)
            variables.append(variable[:-3])
            layout += errors.one_of("type", variable[-2], TYPES)
        kinds[number] = name, variables, struct.Struct(layout)
    return kinds, at


def _text(content: bytes | bytearray, at: int) -> tuple[str, int]:
    end = content.index(0, at)
    return content[at:end].decode("ascii"), end + 1


def _sampled(content: bytes | bytearray, kinds: dict[int, Any], at: int, field: str) -> dict[str, Any]:
    """Return the columns of the sampled events in `content`, from the byte `at` on. Raises InputError."""
    rows: list[tuple[float, ...]] = []
    names: list[str] = []
    while at < len(content) - CHECKSUM:
        number, us = struct.unpack_from("<HQ", content, at)
        name, variables, layout = kinds[number]
        values, at = layout.unpack_from(content, at + 10), at + 10 + layout.size
        if name == SAMPLED:
            names = variables
            rows.append((us / 1e3, *values))
    if not rows:
        raise InputError(field, f"events of the kind {SAMPLED!r}", "none")
    values = np.array(rows, dtype=float)
    values[~np.isfinite(values)] = np.nan  # no number was measured
    return dict(zip(["timestamp", *names], values.T, strict=True))
