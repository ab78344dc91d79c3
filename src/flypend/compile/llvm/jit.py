"""Compilation of LLVM modules to machine code, or its equal from the cache."""

from __future__ import annotations

import ctypes
import hashlib
import os
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import casadi
import llvmlite.binding as llvm
import numpy

from flypend.building import building
from flypend.compile import cache
from flypend.compile.llvm.loops import link
from flypend.compile.llvm.target import Target, native
from flypend.signals.polling import call_in_thread

# Rooms that stand after those that write machine code, and can change it by no more than what is in its key.
ABOVE = frozenset(("export", "paper", "settings", "studies", "pictures", "report", "lab", "cli"))
_ROOT = Path(__file__).parents[2]
_names = iter(range(1 << 62))


def source_files() -> dict[str, tuple[int, int, int]]:
    """Return size, time of writing and time of change of each source file up to the rooms `ABOVE`, by its path."""
    root, found = str(_ROOT), {}
    for folder, inside, names in os.walk(root, followlinks=True):
        inside[:] = [name for name in inside if name != "__pycache__" and (folder != root or name not in ABOVE)]
        for path in (f"{folder}{os.sep}{name}" for name in names if name.endswith((".py", ".toml", ".bc"))):
            with suppress(FileNotFoundError):  # an editor's, such as a link that leads nowhere
                status = os.stat(path)  # noqa: PTH116 (300 of them, at every kernel)
                found[path] = status.st_size, status.st_mtime_ns, status.st_ctime_ns
    return found


def source_digest(files: Iterable[str]) -> str:
    """Return the digest of flypend's source `files`: code generators and what they call, tableaus, the version.

    It is empty if one of them cannot be read.
    """
    digest = hashlib.sha256()
    try:
        for path in sorted(files):
            with open(path, "rb", buffering=0) as file:  # noqa: PTH123 (half the time of Path.read_bytes)
                content = file.read()
            digest.update(f"{path[len(str(_ROOT)) :]} {len(content)}\n".encode() + content)
    except OSError:
        return ""
    return digest.hexdigest()


# The source as this process has imported it.
_files = source_files()
_source = source_digest(_files)


def may_cache() -> bool:
    """Whether `_source` is the source that this process runs: not if it has changed, or lies in an archive."""
    return bool(_source) and str(Path(__file__)) in _files and source_files() == _files


class Native:
    """A compiled function, called with numbers and addresses. Calls release the GIL.

    Instances can be pickled and sent to another process on the same machine.
    """

    def __init__(self, code: bytes, name: str, arguments: tuple[Any, ...]) -> None:
        self._made_of = (code, name, arguments)
        builder = llvm.JITLibraryBuilder().add_object_img(code).add_current_process().export_symbol(name)
        with building:
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

    `key` must determine the module. Processor, versions and flypend's source are added to the key here.
    `arguments` are the ctypes types of the function's arguments.
    """
    return Native(build_object(key, module, native()), name, tuple(arguments))


def build_object(key: str, module: Callable[[], Any], target: Target) -> bytes:
    """Return the object file of the LLVM module built by `module()`, or of a valid cache entry; `key` as in `build`.

    Raises InputError if others may write to the cache.
    """
    versions = f"casadi {casadi.__version__} numpy {numpy.__version__}"
    entry = hashlib.sha256("\n".join([key, target.name, versions, _source]).encode()).hexdigest()
    code = cache.load(entry) if may_cache() else None
    if code is None:
        code = call_in_thread(partial(compile_module, module(), target))
        if may_cache():
            cache.store(entry, code)
    return code


def compile_module(module: Any, target: Target | None = None) -> bytes:
    """Compile an LLVM `module` to an object file optimised for the `target`; default this processor."""
    target = target or native()
    machine = target.machine
    parsed = llvm.parse_assembly(str(module))
    if not target.jit:
        parsed.triple, parsed.data_layout = target.triple, str(machine.target_data)
    parsed = link(module, parsed, target)
    parsed.verify()
    options = llvm.create_pipeline_tuning_options(speed_level=1)
    llvm.create_pass_builder(machine, options).getModulePassManager().run(
        parsed, llvm.create_pass_builder(machine, options)
    )
    code: bytes = machine.emit_object(parsed)
    return code
