"""Bytes and JSON from files, within budgets that hold before anything is allocated; among them the free memory."""

from __future__ import annotations

import json
import math
import os
from contextlib import suppress
from pathlib import Path
from typing import Any

from flypend.errors import InputError

# Bytes of a text that is parsed, TOML or JSON: a thousand run files. Parsed, it takes up to a hundred times as much.
MOST_TEXT = 2**20
PIECE = 2**20  # bytes read at once; of a pipe or a device nobody knows how many follow
GIGABYTE = 1e9
ALWAYS = 1e8  # bytes that are not worth asking for


def read_bytes(path: str | Path, most: int, copies: int = 1) -> bytearray:
    """Return the content of the file at `path`, at most `most` bytes; whoever reads it needs `copies` times its memory.

    Raises InputError, before it is read, if there is more or the memory is short; and OSError.
    """
    content = bytearray()
    with Path(path).open("rb") as stream:
        size = stream.seek(0, 2) if stream.seekable() else 0
        if size:
            stream.seek(0)
            check_fits(str(path), copies * size, f"{size} bytes")
        while size <= most and len(content) <= most and (piece := stream.read(PIECE)):
            content += piece
    if max(size, len(content)) > most:
        raise InputError(str(path), f"a file of at most {most} bytes", max(size, len(content)))
    return content


def read_text(path: str | Path) -> str:
    """Return the text of the file at `path`. Raises InputError as `read_bytes` does, OSError and UnicodeDecodeError."""
    return read_bytes(path, MOST_TEXT).decode("utf-8-sig")


def parse_json(text: str) -> Any:
    """Parse JSON. Raises ValueError, also for what JSON or a reader has no use for.

    That is a number that is not finite or an integer beyond 64 bits, a key that is there twice, half of a character, or
    more than `MOST_TEXT`.
    """
    if len(text) > MOST_TEXT:
        raise ValueError(f"JSON of {len(text)} characters, of which at most {MOST_TEXT} are read")
    try:
        found = json.loads(
            text, parse_constant=_float, parse_float=_float, parse_int=_integer, object_pairs_hook=_object
        )
        json.dumps(found, ensure_ascii=False).encode()
    except RecursionError:
        raise ValueError("JSON that is nested too deeply") from None
    return found


def _float(text: str) -> float:
    if not math.isfinite(value := float(text)):
        raise ValueError(f"a number that is not finite ({text[:20]})")
    return value


def _integer(text: str) -> int:
    if len(text) > 20 or not -(2**63) <= (value := int(text)) < 2**63:
        raise ValueError(f"an integer beyond 64 bits ({text[:20]})")
    return value


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a key that is there twice")
    return found


def free_memory() -> float:
    """Return the bytes that this process may still take; inf where the system does not say.

    On Linux this is the memory that is available without swapping, or less in a control group with a limit.
    """
    found = [float("inf")]
    with suppress(OSError, ValueError, StopIteration):
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        found.append(1024 * float(next(line.split()[1] for line in lines if line.startswith("MemAvailable"))))
    with suppress(OSError, ValueError):  # "max" without a limit
        group = Path("/sys/fs/cgroup")
        limit, used = (float((group / f"memory.{name}").read_text(encoding="ascii")) for name in ("max", "current"))
        found.append(limit - used)
    if len(found) == 1:
        with suppress(OSError, ValueError, AttributeError):
            found.append(float(os.sysconf("SC_PHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE"))
    return min(found)


def check_fits(field: str, needed: float, what: str) -> None:
    """Raise InputError, which blames `field`, if `what` takes more than the free memory; `needed` is in bytes."""
    if needed > ALWAYS and needed > (free := free_memory()):
        given = f"{what}, which need {needed / GIGABYTE:.3g} GB"
        raise InputError(field, f"what fits the {free / GIGABYTE:.3g} GB of free memory", given)
