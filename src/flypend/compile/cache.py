"""The cache of machine code on the disk.

An entry is run, so it is read only if nobody else can have written it: the folder and the file belong to this user, no
one else may write to them, and the file has one name. What was opened is checked, not the path to it: whoever can
change a folder on the way may change which folder is opened, but none that passes holds anything of theirs. Windows has
neither owners nor modes of this kind: there the cache is as safe as the permissions of its folder.
"""

# Not diskcache: it pickles, and keeps an SQLite file, which a network drive locks badly.
from __future__ import annotations

import atexit
import errno
import hashlib
import math
import os
import re
import shutil
import stat
import tempfile
import time
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache, lru_cache
from logging import getLogger
from pathlib import Path
from typing import NamedTuple

from platformdirs import user_cache_path, user_config_path

from flypend.errors import InputError, number, only_known

VARIABLE = "FLYPEND_CACHE"
LIMIT_VARIABLE = "FLYPEND_CACHE_LIMIT"
# MB: more than 4,000 kernels of the usual 44 kB, as many files as one can look through in 0.1 s.
LIMIT = 200.0
LEFT = 0.9  # of the limit is left by an eviction: the next few entries then fit without another one
LOOK = 0.01  # of the limit is written by a process before it looks at the size of the folder again
RECENT = 3600.0  # s; uses closer together are not told apart, which saves the disk a write at every use
_HEAD = b"flypend object 2\n"
_ENTRY, _PARTIAL = re.compile(r"[0-9a-f]{64}\.o"), re.compile(r"tmp\w{8}\.partial")
_PRIVATE = "that belongs to you and that nobody else may write to"
_AT = os.open in os.supports_dir_fd
_unseen = math.inf  # bytes that this process has written since it looked


class Place(NamedTuple):
    """The `folder` of the cache, what names it (a variable, a file, or "default"), and its largest size, bytes."""

    folder: Path
    named_by: str
    limit: float


class Summary(NamedTuple):
    """The place of the cache, the number of its entries, and their size, bytes."""

    place: Place
    entries: int
    size: int


class Found(NamedTuple):
    """A file of the cache: time of its last use, s since 1970, size in bytes, and name."""

    used: float
    size: int
    name: str


# Entries --------------------------------------------------------------------------------------------------------------


def load(entry: str) -> bytes | None:
    """Return the machine code of `entry`, 64 hexadecimal digits; None if there is none that is whole and ours.

    Raises InputError as `location`, and for a folder that is another user's, or that others may write to.
    """
    try:
        with _open_folder(location()) as folder:
            content = folder.read(f"{entry}.o")
    except OSError:
        return None
    begin = len(_HEAD) + 32
    if content is None or content[:begin] != _digest(entry, content[begin:]):  # damaged, or another's under this name
        return None
    return content[begin:]


def store(entry: str, code: bytes) -> None:
    """Keep `code` under `entry`, and remove the least recently used entries beyond the limit.

    Where the folder cannot be written, or the disk is full, nothing is kept. Raises InputError as `load`.
    """
    global _unseen
    place, content = location(), _digest(entry, code) + code
    if len(content) > place.limit:
        return
    with suppress(OSError), _open_folder(place, create=True) as folder:
        folder.write(f"{entry}.o", content)
        _unseen += len(content)
        if _unseen > LOOK * place.limit:
            _unseen = 0
            _evict(folder, place.limit)


def _digest(entry: str, code: bytes) -> bytes:
    """The first bytes of a file: its kind, and a digest that binds `code` to `entry`."""
    return _HEAD + hashlib.sha256(entry.encode() + code).digest()


def _evict(folder: Folder, most: float) -> None:
    found, now = sorted(folder.files()), time.time()
    for file in found:
        if _PARTIAL.fullmatch(file.name) and now - file.used > RECENT:  # of a process that was killed
            folder.remove(file.name)
    entries = [file for file in found if _ENTRY.fullmatch(file.name)]
    size = sum(file.size for file in entries)
    enough = LEFT * most if size > most else size
    for file in entries:
        if size <= enough:
            break
        folder.remove(file.name)
        size -= file.size


# The folder -----------------------------------------------------------------------------------------------------------


def location() -> Place:
    """Return where the cache is: $FLYPEND_CACHE, where `move` has put it, or a folder in the user's cache folder.

    A user without a home gets a folder that lasts as long as the process, and a warning. Raises InputError if
    $FLYPEND_CACHE_LIMIT is no size in MB, or the file that `move` writes is malformed, another user's, or others may
    write to it.
    """
    most: str | float = os.environ.get(LIMIT_VARIABLE) or LIMIT
    with suppress(ValueError):
        most = float(most)
    limit = 1e6 * number(LIMIT_VARIABLE, most, at_least=0, unit="MB")
    if given := os.environ.get(VARIABLE):
        return Place(Path(given), VARIABLE, limit)
    settings = _settings()
    if settings is not None and (folder := _read_place(settings)) is not None:
        return Place(folder, str(settings), limit)
    try:
        found = user_cache_path("flypend", appauthor=False) / "machine-code"
    except RuntimeError:  # no HOME, and no entry in the list of users
        return Place(_temporary(), "default", limit)
    return Place(found if found.is_absolute() else _temporary(), "default", limit)


@lru_cache(maxsize=1)
def _temporary() -> Path:
    """A folder that is removed when the process ends."""
    folder = Path(tempfile.mkdtemp(prefix="flypend-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    getLogger("flypend").warning(
        "flypend: no home folder; compiled code is kept in %s until the end (set %s)", folder, VARIABLE
    )
    return folder


class Folder:
    """An open folder that belongs to this user, and that nobody else may write to."""

    def __init__(self, path: Path, descriptor: int | None) -> None:
        self._path, self._descriptor = path, descriptor

    def files(self) -> list[Found]:
        """Return what flypend has written here, entries and what killed processes left of some."""
        found = []
        with os.scandir(self._path if self._descriptor is None else self._descriptor) as listed:
            for file in listed:
                if _ENTRY.fullmatch(file.name) or _PARTIAL.fullmatch(file.name):
                    with suppress(FileNotFoundError):  # removed by another process
                        status = file.stat(follow_symlinks=False)
                        found.append(Found(status.st_mtime, status.st_size, file.name))
        return found

    def read(self, name: str) -> bytes | None:
        """Return the content of the file `name`, and take note of its use.

        None, with a warning, if others can have written it. Raises OSError.
        """
        try:
            file = self._open(name, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))  # a pipe would wait
        except OSError as error:
            if error.errno == errno.ELOOP:
                _warn(self._path, "is a link")
            raise
        with os.fdopen(file, "rb") as content:
            status = os.fstat(file)
            wrong = _foreign(status)
            if not stat.S_ISREG(status.st_mode):
                wrong = wrong or "is no file"
            elif status.st_nlink > 1:  # another user may have put it here under a second name
                wrong = wrong or "has another name elsewhere"
            if wrong:
                _warn(self._path, wrong)
                return None
            if time.time() - status.st_mtime > RECENT:
                with suppress(OSError):
                    os.utime(self._at(name), dir_fd=self._descriptor)
            return content.read()

    def write(self, name: str, content: bytes) -> None:
        """Write the file `name` as a whole or not at all. Raises OSError."""
        partial = f"tmp{os.urandom(4).hex()}.partial"
        try:
            with os.fdopen(self._open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL), "wb") as file:
                file.write(content)
            os.replace(self._at(partial), self._at(name), src_dir_fd=self._descriptor, dst_dir_fd=self._descriptor)
        finally:
            self.remove(partial)

    def remove(self, name: str) -> None:
        """Remove the file `name`, unless it is gone. Raises OSError."""
        with suppress(FileNotFoundError):
            os.unlink(self._at(name), dir_fd=self._descriptor)

    def _open(self, name: str, flags: int) -> int:
        flags |= getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
        return os.open(self._at(name), flags, 0o600, dir_fd=self._descriptor)

    def _at(self, name: str) -> str:
        return str(self._path / name) if self._descriptor is None else name


@contextmanager
def _open_folder(place: Place, *, create: bool = False) -> Iterator[Folder]:
    """Open the folder of the cache. Raises OSError, or InputError unless it is private."""
    path = place.folder
    if create:
        path.parent.mkdir(parents=True, exist_ok=True)
        with suppress(FileExistsError):
            path.mkdir(0o700)
            path.chmod(0o700)  # the umask may have taken more away
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY) if _AT else None
    except PermissionError:
        _check_private(place, path.stat())
        raise
    try:
        _check_private(place, path.stat() if descriptor is None else os.fstat(descriptor))
        yield Folder(path, descriptor)
    finally:
        if descriptor is not None:
            os.close(descriptor)


def _check_private(place: Place, status: os.stat_result) -> None:
    if wrong := _foreign(status):
        field = str(place.folder) if place.named_by == "default" else place.named_by
        raise InputError(
            field, f"a folder {_PRIVATE} (chmod 700 it, or name another)", f"{place.folder}, which {wrong}"
        )


def _foreign(status: os.stat_result) -> str:
    """Why others can have written a file or folder; "" if they cannot."""
    if not hasattr(os, "geteuid"):
        return ""
    if status.st_uid != os.geteuid():
        return f"belongs to user {status.st_uid}"
    return "others may write to" if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH) else ""


@cache  # one line for all entries of a folder
def _warn(folder: Path, wrong: str) -> None:
    getLogger("flypend").warning("flypend: warning: %s has an entry that %s; it is compiled again", folder, wrong)


# What the command does ------------------------------------------------------------------------------------------------


def summarise(*, clear: bool = False) -> Summary:
    """Return what the cache holds; with `clear`, remove it.

    Raises InputError for a folder that others may write to, or that this user may not.
    """
    place, entries = location(), []
    try:
        with _open_folder(place) as folder:
            for file in folder.files():
                if clear:
                    folder.remove(file.name)
                if _ENTRY.fullmatch(file.name):
                    entries.append(file.size)
    except FileNotFoundError:  # nothing has been compiled
        pass
    except OSError as error:
        raise InputError(str(place.folder), "a folder that you may read and write", error.strerror or error) from None
    return Summary(place, len(entries), sum(entries))


def move(path: Path) -> None:
    """Keep the cache in the folder `path` from now on, and take along what it holds.

    Raises InputError if the folder is not private or cannot be written, and if $FLYPEND_CACHE names another.
    """
    from flypend.files.staging import check_writable  # kernels need none of these
    from flypend.files.toml import toml_text
    from flypend.files.whole import whole_file

    if given := os.environ.get(VARIABLE):
        raise InputError(VARIABLE, "no value, since it wins over the settings", given)
    if (settings := _settings()) is None:
        raise InputError("cache", f"a home folder, which keeps the settings (else set {VARIABLE})", "none")
    old = location()
    new = old._replace(folder=path.absolute(), named_by="DIR")
    check_writable(new.folder)
    try:
        settings.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(settings, (".toml",)) as partial, _open_folder(new, create=True) as target:
            partial.write_text(toml_text({"cache": str(new.folder)}), encoding="utf-8")
            partial.chmod(0o600)
            with suppress(OSError, InputError), _open_folder(old) as source:
                if not new.folder.samefile(old.folder):
                    _carry(source, target)
    except OSError as error:
        raise InputError(str(settings), "a file that can be written", error.strerror or error) from None


def _carry(source: Folder, target: Folder) -> None:
    for file in sorted(source.files()):  # the least recently used first, as which they arrive
        if _ENTRY.fullmatch(file.name) and (content := source.read(file.name)) is not None:
            target.write(file.name, content)
        source.remove(file.name)


def _settings() -> Path | None:
    """The file that says where the cache has been moved; None without a home."""
    try:
        folder = user_config_path("flypend", appauthor=False)
    except RuntimeError:
        return None
    return folder / "config.toml" if folder.is_absolute() else None


def _read_place(settings: Path) -> Path | None:
    """The folder that the file `settings` names; None if there is no such file."""
    try:
        with settings.open("rb") as file:
            wrong, content = _foreign(os.fstat(file.fileno())), file.read()
    except OSError:
        return None
    if wrong:
        raise InputError(str(settings), f"a file {_PRIVATE} (chmod 600)", f"one that {wrong}")
    try:
        given = tomllib.loads(content.decode())
    except ValueError as error:
        raise InputError(str(settings), "TOML", error) from None
    only_known(str(settings), given, ("cache",))
    folder = given.get("cache")
    if not isinstance(folder, str) or not Path(folder).is_absolute():
        raise InputError(f"{settings}.cache", "an absolute path", repr(folder))
    return Path(folder)
