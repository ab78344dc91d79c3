"""The name of a store: who may write under it, what killed sweeps left beside it, and its removal."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from uuid import uuid4

from filelock import FileLock, Timeout

from flypend.errors import InputError
from flypend.files.staging import check_writable

# Names of what a sweep leaves when it is killed: folders beside the store, and Zarr's files inside it.
_LEFT = r"\.{name}\.[0-9a-f]{{32}}\.(partial|removed)"
_HALF_WRITTEN = re.compile(r"(zarr|\d+)\.[0-9a-f]{32}\.partial")
_OF_A_STORE = re.compile(rf"zarr\.json|\d+|{_HALF_WRITTEN.pattern}")


def check_path(path: str | Path) -> Path:
    """Return `path` as a `Path`. Raises InputError unless it ends in .zarr and a folder can be called so."""
    path = Path(path)
    if path.suffix != ".zarr":
        raise InputError("store", "a name ending in .zarr", str(path))
    _real(path)
    return path


def check_place(path: str | Path) -> None:
    """Raise InputError unless a store can be at `path`: it ends in .zarr, and its folder can be written."""
    check_writable(_real(check_path(path)).parent)


def lock_of(path: str | Path) -> Path:
    """Return the path of the lock file of the store at `path`: the same through every link to the store."""
    real = _real(check_path(path))
    return real.with_name(f".{real.name}.lock")


def _real(path: Path) -> Path:
    try:
        return path.resolve()
    except (OSError, ValueError, RuntimeError) as error:  # loops of links, null bytes
        raise InputError("store", "a name that a folder can have", error) from None


@contextmanager
def lock_name(path: str | Path) -> Iterator[None]:
    """Lock the name `path` against every other sweep. The system releases the lock however the process ends.

    The lock file stays: unlinking it would let one process lock the old file while another locks a new one.

    Raises InputError if another sweep holds the lock, or the lock file cannot be written or is a link.
    """
    place = lock_of(path)
    lock = FileLock(place, timeout=0)
    try:
        lock.acquire()
    except Timeout:
        raise InputError(str(path), "a store that no other sweep is writing", "one in use") from None
    except OSError as error:
        raise InputError(str(place), "a file that can be written", error.strerror or error) from None
    try:
        yield
    finally:
        with suppress(OSError):
            lock.release()


def unused_name(path: Path, why: str) -> Path:
    """Return an unused name beside the store at `path`; `why` is "partial" or "removed"."""
    path = _real(path)
    return path.with_name(f".{path.name}.{uuid4().hex}.{why}")


def clear(path: Path) -> None:
    """Delete what killed sweeps left of the store at `path`, whose lock the caller holds; nothing of the user's."""
    path = _real(path)
    ours = re.compile(_LEFT.format(name=re.escape(path.name)))
    for entry in path.parent.iterdir():
        if ours.fullmatch(entry.name) and entry.is_dir() and not entry.is_symlink() and _foreign(entry) is None:
            shutil.rmtree(entry, ignore_errors=True)
    for file in path.rglob("*.partial"):
        if _HALF_WRITTEN.fullmatch(file.name) and file.is_file():
            with suppress(OSError):
                file.unlink()


def remove(path: Path) -> None:
    """Delete the store at `path`, whose lock the caller holds. Interrupted, it is there as a whole or gone.

    Raises InputError if a file that no sweep writes is inside, or the folder cannot be renamed.
    """
    if (foreign := _foreign(path)) is not None:
        raise InputError(str(path), "nothing but a store", foreign.relative_to(path))
    gone = unused_name(path, "removed")
    try:
        _real(path).rename(gone)
    except OSError as error:
        raise InputError(str(path), "a store that can be removed", error.strerror or error) from None
    shutil.rmtree(gone, ignore_errors=True)


def _foreign(folder: Path) -> Path | None:
    """Return an entry of `folder` that no store has: a file of another name, or a link."""
    for entry in sorted(folder.rglob("*")):
        if entry.is_symlink() or (entry.is_file() and not _OF_A_STORE.fullmatch(entry.name)):
            return entry
    return None
