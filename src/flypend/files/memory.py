"""Requests that would not fit the memory, refused before any of it is taken."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from flypend.errors import InputError

GIGABYTE = 1e9
ALWAYS = 1e8  # bytes that are not worth asking for


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
        told = f"{what}, which need {needed / GIGABYTE:.3g} GB"
        raise InputError(field, f"what fits the {free / GIGABYTE:.3g} GB of free memory", told)
