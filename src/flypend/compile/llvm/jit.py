"""Compilation of LLVM modules to machine code, with a disk cache whose entries are verified by checksum."""

from __future__ import annotations

import atexit
import ctypes
import hashlib
import os
import shutil
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import lru_cache, partial
from logging import getLogger
from pathlib import Path
from threading import Lock
from typing import Any

import llvmlite.binding as llvm
from platformdirs import user_cache_path

from flypend.compile.aside import aside
from flypend.compile.llvm.target import Target, native

CACHE_VARIABLE = "FLYPEND_CACHE"
_ENTRY = b"flypend object 2\n"
_names = iter(range(1 << 62))
_lock = Lock()


def cache_folder() -> Path:
    """Folder of compiled kernels: $FLYPEND_CACHE, or `flypend` in the user's cache folder.

    A user without a home gets a folder that lasts as long as the process, and a warning.
    """
    given = os.environ.get(CACHE_VARIABLE)
    if given:
        return Path(given)
    try:
        found = user_cache_path("flypend", appauthor=False)
    except RuntimeError:  # no HOME, and no entry in the list of users
        return _temporary()
    return found if found.is_absolute() else _temporary()


@lru_cache(maxsize=1)
def _temporary() -> Path:
    """A folder that is removed when the process ends."""
    folder = Path(tempfile.mkdtemp(prefix="flypend-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    getLogger("flypend").warning(
        "flypend: no home folder; compiled code is kept in %s until the end (set %s)", folder, CACHE_VARIABLE
    )
    return folder


@lru_cache(maxsize=1)
def source_digest() -> str:
    """Digest of the source of the code generators, which invalidates cache entries when they change."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


class Native:
    """A compiled function, called with numbers and addresses. Calls release the GIL.

    Instances can be pickled and sent to another process on the same machine.
    """

    def __init__(self, code: bytes, name: str, arguments: tuple[Any, ...]) -> None:
        self._made_of = (code, name, arguments)
        builder = llvm.JITLibraryBuilder().add_object_img(code).add_current_process().export_symbol(name)
        with _lock:
            self._library = builder.link(_jit(), f"flypend{next(_names)}")
        self._call = ctypes.CFUNCTYPE(None, *arguments)(self._library[name])

    def __call__(self, *values: Any) -> None:
        """Call the function."""
        self._call(*values)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the machine code."""
        return Native, self._made_of


@lru_cache(maxsize=1)
def _jit() -> Any:
    return llvm.create_lljit_compiler(native().machine)


def build(key: str, module: Callable[[], Any], name: str, arguments: Sequence[Any]) -> Native:
    """Return the function `name` of the LLVM module built by `module()`, or of a valid cache entry for `key`.

    `key` must determine the module. Processor, versions and the generators' source are added to the key here.
    `arguments` are the ctypes types of the function's arguments.
    """
    return Native(build_object(key, module, native()), name, tuple(arguments))


def build_object(key: str, module: Callable[[], Any], target: Target) -> bytes:
    """Return the object file of the LLVM module built by `module()`, or of a valid cache entry; `key` as in `build`."""
    entry = hashlib.sha256("\n".join([key, target.name, source_digest()]).encode()).hexdigest()
    path = cache_folder() / f"{entry}.o"
    code = _read(path, entry)
    if code is None:
        code = aside(partial(compiled, module(), target))
        _write(path, entry, code)
    return code


def compiled(module: Any, target: Target | None = None) -> bytes:
    """Compile an LLVM `module` to an object file optimised for the `target`; default this processor."""
    target = target or native()
    machine = target.machine
    parsed = llvm.parse_assembly(str(module))
    if not target.jit:
        parsed.triple, parsed.data_layout = target.triple, str(machine.target_data)
    parsed.verify()
    options = llvm.create_pipeline_tuning_options(speed_level=1)
    llvm.create_pass_builder(machine, options).getModulePassManager().run(
        parsed, llvm.create_pass_builder(machine, options)
    )
    code: bytes = machine.emit_object(parsed)
    return code


def _read(path: Path, entry: str) -> bytes | None:
    """Read the cached object of `entry` at `path`; None if it is missing, corrupt, or another's under this name."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    begin = len(_ENTRY) + 32
    code = content[begin:]
    return code if content[:begin] == _head(entry, code) else None


def _head(entry: str, code: bytes) -> bytes:
    """The first bytes of a cache file: the kind of file, and a digest that binds `code` to `entry`."""
    return _ENTRY + hashlib.sha256(entry.encode() + code).digest()


def _write(path: Path, entry: str, code: bytes) -> None:
    """Write `code` to `path` atomically; do nothing if the folder is not writable."""
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, partial = tempfile.mkstemp(dir=path.parent, suffix=".partial")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_head(entry, code) + code)
            Path(partial).replace(path)
        finally:
            Path(partial).unlink(missing_ok=True)
