"""Random steps of environments under AddressSanitizer: `python -m benchmarks.sanitised` makes 10⁷ of each task.

The loop's source and the programs that are linked into it for flights as well are compiled by clang, with a check
before every access to memory; the arrays are exactly as long as they have to be. `--planted NAME` shortens a buffer of
the loop by one vector, or an array by one byte: that must be found. Needs clang and its runtime (`make test-tools`).
"""

from __future__ import annotations

import argparse
import ctypes
import os
import re
import subprocess
import sys
import tempfile
import time
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks import omnidrones_tasks
from flypend.compile.llvm import jit
from flypend.compile.llvm.target import native
from flypend.compile.llvm.worlds import kernel_module
from flypend.envs import environment, kernel
from flypend.envs.make import TASKS
from flypend.envs.problem import problem

# What a sanitised kernel is made of: every task, and what else is in the memory of a world.
CASES: dict[str, dict[str, Any]] = {
    name: {"task": make()} for name, make in {**TASKS, **omnidrones_tasks.TASKS}.items()
} | {
    "hub": {"task": "swing_up", "mount": "hub"},
    "onboard": {"task": "balance", "sensors": "onboard"},
    "varied": {
        "task": "track", "action": "rates", "attitude": "6d",
        "randomise": {"mass": (0.8, 1.2), "lag": (0.8, 1.5), "delay": (0.0, 0.025), "wind": (0.0, 0.3)},
    },
}  # fmt: skip
SOURCE = Path(jit.__file__).parents[1] / "loops" / "worlds.cpp"
BUFFER = re.compile(r"(\w+)\[((?:[A-Z]+|some\([A-Z_]+\))(?: \+ [A-Z]+)?)\](?=[,;])")  # name and length
USED_WITH = {"start_draws": "sensors", "noise": "sensors", "before": "mount"}  # buffers that others do not use
DEFINED = re.compile(r"^(define .*\)(?: unnamed_addr)?)", re.MULTILINE)
# As in `build.sh`: text for a processor that passes vectors of any width by value, and what it says of this processor.
RAW = (
    "-target", "wasm64-unknown-unknown", "-O2", "-Xclang", "-disable-llvm-passes", "-S", "-emit-llvm", "-std=c++17",
    "-ffreestanding", "-fno-exceptions", "-fno-rtti", "-fno-strict-aliasing", "-Wno-psabi",
)  # fmt: skip
OF_WEB = re.compile(r'^target .*$|"(target-cpu|target-features|min-legal-vector-width)"="[^"]*"', re.MULTILINE)
DECLARED = re.compile(r"^declare .*@(\w+)\(", re.MULTILINE)
ALIGNED = 64
FOUND = 99  # exit status of a process in which the sanitiser found something


def tool(*command: str) -> str:
    """Run `command`; return what it prints. Raises RuntimeError with what it said if it fails."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}\n{done.stderr[:4000]}")
    return done.stdout.strip()


@lru_cache(maxsize=1)
def clang() -> tuple[str, ...]:
    """Return clang and what it needs to read the text of a kernel; before version 15 pointers had types."""
    version = int(tool("clang", "-dumpversion").split(".")[0])
    opaque = ("-mllvm", "-opaque-pointers") if version < 15 else ()
    return ("clang", "-fPIC", "-Wno-override-module", *opaque)


def programs(case: str) -> str:
    """Return the text of what is linked into the loop for a case."""
    return str(kernel_module(problem(environment(**CASES[case])), kernel.WIDTH))


def buffers(case: str) -> list[str]:
    """Return the names of the buffers of the loop that a case uses."""
    return [name for name, _ in BUFFER.findall(SOURCE.read_text()) if USED_WITH.get(name, "task") in CASES[case]]


def shortened(source: str, name: str) -> str:
    """Return the source of the loop with the buffer `name` lacking its last vector."""
    return BUFFER.sub(lambda found: f"{name}[{found[2]} - 1]" if found[1] == name else found[0], source)


def elementary() -> str:
    """Return the source of the functions that programs call, without what this processor has no instruction for."""
    source = (SOURCE.parent / "elementary.cpp").read_text()
    if not native().estimates_roots:
        source = source.split("#if BITS == 64 && WIDTH % 8 == 0")[0] + "}\n"
    return '#include "elementary.hpp"\nextern "C" const int64_t FUSES = 1;\n' + source


def built(written: str, source: str, folder: Path) -> Path:
    """Compile the loop's `source` and the text of its programs to a library in `folder` that checks each access.

    Return its path. The source becomes text as it does for flights, by `build.sh`. Checks are inserted before anything
    is optimised: afterwards some accesses beyond a buffer are gone. Buffers of vectors are aligned to 64 bytes, the
    sanitiser's own frames must be as well.
    """
    loop, library = folder / "worlds.cpp", folder / "kernel.so"
    loop.write_text(source)
    names = "-I", str(SOURCE.parent), f"-DWIDTH={kernel.WIDTH}", "-DBITS=64", "-fvisibility=default"
    functions = folder / "elementary.cpp"
    functions.write_text(elementary())
    own = {part: OF_WEB.sub("", tool("clang", *RAW, *names, str(part), "-o", "-")) for part in (loop, functions)}
    texts = {"loop": own[loop], "programs": written, "elementary": own[functions]}
    objects = [str(folder / f"{name}.o") for name in texts]
    for made, part in zip(objects, texts.values(), strict=True):
        plain, checked = folder / "plain.ll", folder / "checked.ll"
        plain.write_text(DEFINED.sub(r"\1 sanitize_address", part))
        checks = ("-fsanitize=address", "-mllvm", f"-asan-realign-stack={ALIGNED}", "-S", "-emit-llvm")
        tool(*clang(), "-O0", *checks, str(plain), "-o", str(checked))
        tool(*clang(), "-O1", "-march=native", "-c", str(checked), "-o", made)
    absent = set(DECLARED.findall(texts["loop"])) - set(re.findall(r'^define .*@"?(\w+)', written, re.MULTILINE))
    # Programs have names such as step, which the C library has as well; those that a case lacks are never called.
    linked = ["-fsanitize=address", "-shared-libasan", "-shared", "-Wl,-Bsymbolic"]
    linked += [f"-Wl,--defsym={name}=0" for name in sorted(absent)]
    tool("clang", *linked, *objects, "-o", str(library), "-lm")
    return library


def stepped(case: str, steps: int, count: int, planted: str = "") -> tuple[int, str]:
    """Step `count` worlds of a case in a process of its own; return its exit status and what it printed."""
    with tempfile.TemporaryDirectory() as folder:
        library = built(programs(case), shortened(SOURCE.read_text(), planted), Path(folder))
        runtime = tool("clang", f"-print-file-name=libclang_rt.asan-{os.uname().machine}.so")
        # Python itself leaves memory to its end; the symboliser outlives the process and would keep its output open.
        options = f"detect_leaks=0:symbolize=0:exitcode={FOUND}"
        done = subprocess.run(
            [sys.executable, "-m", "benchmarks.sanitised", "--library", library, "--case", case, "--steps", str(steps),
             "--count", str(count), "--planted", planted],
            capture_output=True, text=True, check=False, cwd=Path(__file__).parents[1],
            env=os.environ | {"LD_PRELOAD": runtime, "ASAN_OPTIONS": options},
        )  # fmt: skip
    return done.returncode, done.stdout + done.stderr


# In the process with the sanitiser ------------------------------------------------------------------------------------


def exact(array: NDArray[Any], lacking: int = 0) -> NDArray[Any]:
    """Return a copy of `array` in memory of its own that ends with it; or `lacking` bytes before."""
    place = ctypes.c_void_p()
    allocate = ctypes.CDLL(None).posix_memalign
    allocate.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_size_t]
    allocate(ctypes.byref(place), ALIGNED, array.nbytes - lacking)
    memory = (ctypes.c_char * array.nbytes).from_address(place.value)
    ctypes.memset(memory, 0, array.nbytes - lacking)
    copy = np.frombuffer(memory, dtype=array.dtype).reshape(array.shape)
    if not lacking:
        copy[...] = array
    return copy


def step(library: Path, case: str, steps: int, count: int, planted: str) -> None:
    """Step `count` worlds with the kernel in `library`, by random actions, some of them absurd."""
    function = ctypes.CDLL(str(library)).kernel
    function.restype, function.argtypes = None, kernel.KINDS
    kernel.compile_worlds = lambda made: function  # type: ignore[assignment, misc]
    worlds = kernel.Worlds(environment(**CASES[case]), count)
    worlds.arrays = {name: exact(array, name == planted) for name, array in worlds.arrays.items()}
    worlds.begin(np.arange(count))
    rng, length = np.random.default_rng(1), worlds.env.actions
    actions = rng.uniform(-1.5, 1.5, (50, count, length)).astype(np.float32)
    actions[7, ::11], actions[13, ::13], actions[29, ::17] = np.nan, np.inf, 1e30
    for k in range(-(-steps // count)):
        worlds.step(actions[rng.integers(50)] if k % 3 else np.roll(actions[k % 50], k, axis=0))
    if not all(np.isfinite(worlds.arrays[name]).all() for name in ("observations", "rewards")):
        sys.exit("observations or rewards are not finite")


def main() -> None:
    """Step all cases, or those asked for; exit with 1 if anything is found."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--steps", type=int, default=10**7)
    parser.add_argument("--count", type=int, default=4100)
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--planted", default="")
    parser.add_argument("--library", type=Path, help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.library:
        step(asked.library, asked.case[0], asked.steps, asked.count, asked.planted)
        return
    clean = True
    for case in asked.case or CASES:
        begin = time.perf_counter()
        status, said = stepped(case, asked.steps, asked.count, asked.planted)
        clean = clean and status == 0
        told = "nothing found" if status == 0 else said
        print(f"{case}: {asked.steps:.3g} steps in {time.perf_counter() - begin:.0f} s, {told}", flush=True)
    sys.exit(not clean)


if __name__ == "__main__":
    main()
