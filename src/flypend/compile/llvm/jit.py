"""Machine code from LLVM modules: compiled once, kept on disk, checked before it is trusted."""

from __future__ import annotations

import ctypes
import hashlib
import os
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from threading import Lock
from typing import Any

import llvmlite
import llvmlite.binding as llvm
from platformdirs import user_cache_path

CACHE_VARIABLE = "FLYPEND_CACHE"
_ENTRY = b"flypend object 1\n"
_names = iter(range(1 << 62))
_lock = Lock()


def cache_folder() -> Path:
    """Where compiled kernels are kept: $FLYPEND_CACHE, or `flypend` in the user's folder for caches."""
    given = os.environ.get(CACHE_VARIABLE)
    if given:
        return Path(given)
    return user_cache_path("flypend", appauthor=False)


@lru_cache(maxsize=1)
def _machine() -> tuple[Any, str]:
    """The target of this processor, and the text that names it and the versions at work."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    cpu, features = llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()
    target = llvm.Target.from_default_triple()
    machine = target.create_target_machine(cpu=cpu, features=features, opt=2, jit=True, reloc="pic")
    version = ".".join(map(str, llvm.llvm_version_info))
    return machine, f"{target.triple} {cpu} {features} llvmlite {llvmlite.__version__} llvm {version}"


@lru_cache(maxsize=1)
def source_digest() -> str:
    """Digest of the code generators' own source: what they make of a key changes when they do."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


class Native:
    """A compiled function: called with numbers and addresses, it lets other Python threads run meanwhile.

    It can be sent to another process of the same machine.
    """

    def __init__(self, code: bytes, name: str, arguments: tuple[Any, ...]) -> None:
        self._made_of = (code, name, arguments)
        builder = llvm.JITLibraryBuilder().add_object_img(code).add_current_process().export_symbol(name)
        with _lock:
            self._library = builder.link(_jit(), f"flypend{next(_names)}")
        self._call = ctypes.CFUNCTYPE(None, *arguments)(self._library[name])

    def __call__(self, *values: Any) -> None:
        """Call it."""
        self._call(*values)

    def __reduce__(self) -> tuple[Any, ...]:
        """By its machine code."""
        return Native, self._made_of


@lru_cache(maxsize=1)
def _jit() -> Any:
    return llvm.create_lljit_compiler(_machine()[0])


def build(key: str, module: Callable[[], Any], name: str, arguments: Sequence[Any]) -> Native:
    """The function `name` of the LLVM module that `module()` writes, from the cache if an entry for `key` is sound.

    `key` must determine the module; processor, versions and the generators' source are added to it here. `arguments`
    are the ctypes of its arguments.
    """
    entry = hashlib.sha256("\n".join([key, _machine()[1], source_digest()]).encode()).hexdigest()
    path = cache_folder() / f"{entry}.o"
    code = _read(path)
    if code is None:
        code = compiled(module())
        _write(path, code)
    return Native(code, name, tuple(arguments))


def compiled(module: Any) -> bytes:
    """The object file of an LLVM `module`, optimised for this processor."""
    machine, _ = _machine()
    parsed = llvm.parse_assembly(str(module))
    parsed.verify()
    options = llvm.create_pipeline_tuning_options(speed_level=1)
    llvm.create_pass_builder(machine, options).getModulePassManager().run(
        parsed, llvm.create_pass_builder(machine, options)
    )
    code: bytes = machine.emit_object(parsed)
    return code


def _read(path: Path) -> bytes | None:
    """The object kept at `path`; None if there is none, or one that is not what was written."""
    try:
        entry = path.read_bytes()
    except OSError:
        return None
    header, digest, code = entry[: len(_ENTRY)], entry[len(_ENTRY) : len(_ENTRY) + 32], entry[len(_ENTRY) + 32 :]
    return code if header == _ENTRY and digest == hashlib.sha256(code).digest() else None


def _write(path: Path, code: bytes) -> None:
    """Keep `code` at `path`, whole or not at all; without a folder that can be written nothing is kept."""
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, partial = tempfile.mkstemp(dir=path.parent, suffix=".partial")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_ENTRY + hashlib.sha256(code).digest() + code)
            Path(partial).replace(path)
        finally:
            Path(partial).unlink(missing_ok=True)
