"""SciPy's DOP853 with the right-hand side in NumPy: what one writes first."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.peers import Fly, Peer


def make(problem: Any, threads: int) -> Fly:
    """solve_ivp, the right-hand side being the program as a Python function of floats."""
    from scipy.integrate import solve_ivp

    from flypend.compile.program import FOLD

    scope: dict[str, Any] = {"numpy": np, **{f"do_{name}": function for name, function in FOLD.items()}}
    exec(source(problem.programs.rates), scope)
    rates = scope["rates"]

    def one(start: Any, tolerance: float) -> Any:
        found = solve_ivp(rates, (0.0, problem.duration), start, "DOP853", rtol=tolerance, atol=tolerance)
        return found.y[:, -1]

    return lambda starts, tolerance: np.array([one(start, tolerance) for start in starts])


SIGNS = {"add": "+", "sub": "-", "mul": "*", "div": "/"}


def source(program: Any) -> str:
    """`program` (t, s, p) → rates as Python."""
    lines = ["def rates(t, s):", "    s = s.tolist()"]
    for place, (name, arguments, value) in enumerate(program.operations):
        taken = [f"v{number}" for number in arguments]
        if name == "input":
            form = "t" if arguments[0] == 0 else f"s[{arguments[1]}]"
        elif name == "constant":
            form = repr(value)
        elif name in SIGNS:
            form = f"{taken[0]} {SIGNS[name]} {taken[1]}"
        else:
            form = f"do_{name}({', '.join(taken)})"
        lines.append(f"    v{place} = {form}")
    lines.append(f"    return numpy.array([{', '.join(f'v{number}' for number in program.outputs[0])}])")
    return "\n".join(lines)


PEER = Peer("SciPy, Python right-hand side", "solve_ivp DOP853, floats", make, 6)
