"""Machine code found by the LLVM text that it is made of: most edits of the source leave most of it as it is.

flypend's own cache finds code by the source of whatever may have written it, and so nothing after any edit.
"""

import hashlib
import os
from pathlib import Path

import llvmlite

MOST = 400e6  # bytes, of which a run of all tests needs a quarter


def use_machine_code_by_text(folder: Path) -> None:
    """Let this process keep machine code in `folder`, and compile only what no process has compiled there before."""
    from flypend.compile.llvm import jit  # imported here: mutants.py changes the source first

    llvm, compile_module = Path(jit.__file__).parent, jit.compile_module
    makers = [*(llvm / f"{name}.py" for name in ("jit", "loops", "target")), *(llvm.parent / "loops").glob("*.bc")]
    same = hashlib.sha256(llvmlite.__version__.encode())
    for path in sorted(makers):
        same.update(path.read_bytes())
    if compile_module.__module__ == __name__:  # as of a process that forked
        return
    folder.mkdir(parents=True, exist_ok=True)

    def found(module: object, target: jit.Target | None = None) -> bytes:
        target = target or jit.native()
        loop = getattr(module, "bitcode", ""), sorted(getattr(module, "inner", ()))
        digest = same.copy()
        digest.update(f"{module}{loop}{target.name}{target.jit}".encode())
        path = folder / digest.hexdigest()
        if path.exists():
            os.utime(path)
            return path.read_bytes()
        code = compile_module(module, target)
        part = path.with_suffix(f".{os.getpid()}")
        part.write_bytes(code)
        part.replace(path)
        return code

    jit.compile_module = found


def keep_what_was_used_last(folder: Path) -> None:
    """Remove from `folder` what is beyond `MOST`."""
    size = 0
    for status, path in sorted(((path.stat(), path) for path in folder.glob("*")), key=lambda one: -one[0].st_mtime):
        size += status.st_size
        if size > MOST:
            path.unlink(missing_ok=True)
