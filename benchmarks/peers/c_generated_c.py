"""The same algorithm as C with vectors of eight lanes, from the same program: what a C compiler makes of it."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers import Fly, Peer

# With the freedoms that flypend gives LLVM: fused operations, sums in any order, shared reciprocals.
OPTIONS = [
    "-O3", "-march=native", "-ffp-contract=fast", "-fassociative-math", "-fno-signed-zeros", "-freciprocal-math",
    "-fno-math-errno", "-fno-trapping-math", "-w", "-std=c++17",
]  # fmt: skip


def make(problem: Any, threads: int, method: str = "dp5", lanes: int = 8) -> Fly:
    """Compile the template for `lanes`, and call it."""
    compiler = shutil.which("g++")
    if compiler is None:
        raise ModuleNotFoundError("g++")
    folder = Path(tempfile.mkdtemp())
    source, library = folder / "kernel.cpp", folder / "kernel.so"
    source.write_text(text(problem.programs, method, lanes))
    subprocess.run([compiler, *OPTIONS, "-shared", "-fPIC", "-o", str(library), str(source)], check=True)
    kernel = ctypes.CDLL(str(library)).kernel
    kinds = [ctypes.c_void_p, ctypes.c_int64, *[ctypes.c_double] * 3, ctypes.c_void_p]
    kernel.argtypes, kernel.restype = kinds, None

    def fly(starts: Any, rtol: float) -> Any:
        starts, out = np.ascontiguousarray(starts), np.empty_like(starts)
        size = 8192 if threads == 1 else max(512, -(-len(starts) // (4 * threads)))  # as flypend's own

        def part(first: int) -> None:
            some, place = starts[first : first + size], out[first : first + size]
            kernel(some.ctypes.data, len(some), problem.duration, rtol, rtol, place.ctypes.data)

        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(part, range(0, len(starts), size)))
        return out

    return fly


def text(programs: Any, method: str, lanes: int) -> str:
    """The C++ source (for its `?:` on vectors; the rest is C with GCC's vectors)."""
    from flypend.compile.methods import method as method_named

    table = method_named(method)
    s = table.stages
    fsal = int(table.errors[0][-1] != 0)
    A = np.zeros((s, s))
    A[:, : table.A.shape[1]] = table.A[:s, :s]
    # The step control of compile/loops/runge_kutta.cpp.
    numbers = {"N": 24, "STAGES": s, "FSAL": fsal, "ESTIMATES": len(table.errors), "ORDER": 8 if s > 8 else 5,
               "SAFETY": 0.8, "LEAST_FACTOR": 0.2, "MOST_FACTOR": 5.0}  # fmt: skip
    tables = [f"#define {name} {value}" for name, value in numbers.items()]
    tables += [array("A", A), array("B", table.B), array("C", table.C[:s]), array("E", np.array(table.errors))]
    body = (Path(__file__).parent / "template.cpp").read_text()
    rates = replace(programs.rates, outputs=programs.rates.outputs[:1])  # what else it computes is for judging
    programs_text = "\n".join([function(rates, ["t", "s", "p"]), function(programs.project, ["s"])])
    head, rest = body.split("//PROGRAMS\n")
    return f"#define W {lanes}\n" + head + programs_text + rest.replace("//TABLES", "\n".join(tables))


def array(name: str, values: Any) -> str:
    """A constant array."""
    sizes = "".join(f"[{size}]" for size in values.shape)
    return f"static constexpr double {name}{sizes} = {str(values.tolist()).replace('[', '{').replace(']', '}')};"


FORMS = {"add": "{} + {}", "sub": "{} - {}", "mul": "{} * {}", "div": "{} / {}", "neg": "-{}", "sqrt": "root({})",
         "fabs": "size({})"}  # fmt: skip


def function(program: Any, inputs: list[str]) -> str:
    """`program` as a function of pointers to vectors; all inputs are read before any output is written."""
    lines = []
    for place, (name, arguments, value) in enumerate(program.operations):
        if name == "input":
            form = f"{inputs[arguments[0]]}[{arguments[1]}]"
        elif name == "constant":
            form = f"all({value!r})"
        else:
            form = FORMS[name].format(*(f"v{number}" for number in arguments))
        lines.append(f"    const V v{place} = {form};")
    outputs = [f"out{i}" for i in range(len(program.outputs))]
    for output, vector in zip(outputs, program.outputs, strict=True):
        lines += [f"    {output}[{i}] = v{number};" for i, number in enumerate(vector)]
    arguments = ", ".join([f"const V *{name}" for name in inputs] + [f"V *{name}" for name in outputs])
    return f"static __attribute__((noinline)) void {program.name}({arguments}) {{\n" + "\n".join(lines) + "\n}\n"


PEER = Peer("generated C, vectors, dp5", "g++ -O3, 8 lanes by GCC's vectors, same algorithm", make, 8192, threaded=True)
scalar = partial(make, lanes=1)
order_8 = partial(make, method="dop853")
