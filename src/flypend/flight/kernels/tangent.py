"""The kernel of the ideal plant with its tangent: a state, and a direction in which start and gains change.

One run carries one direction v of the state and q of the gains: ṡ = F(t, s, p), v̇ = F_s v + F_p q, by forward
derivatives of the same program.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.llvm import jit
from flypend.compile.problem import Problem
from flypend.compile.program import lower
from flypend.flight.kernels.flown import Flown
from flypend.flight.kernels.ideal import MAX_STEPS, call, closed, compiled
from flypend.laws import BoundLaw
from flypend.laws.closed_loop import symbolic_loop
from flypend.model import Vehicle
from flypend.model.state import SIZE, project_symbolic


def fly_tangents(
    vehicle: Vehicle,
    law: BoundLaw,
    gains: tuple[str, ...],
    starts: Any,
    directions: Any,
    values: Any,
    rates: Any,
    duration: float,
    rtol: float,
) -> Flown:
    """Fly `starts` with their `directions`; final states (n, 48) are states and their derivatives.

    Parameters
    ----------
    vehicle, law, duration, rtol
        As in `simulate`, the law being bound.
    gains : tuple of str
        Which may change, k of them.
    starts, directions : (n, 24)
        Packed states and directions tangent to the manifold.
    values, rates : (n, k)
        Gains and directions of them.
    """
    joined = np.ascontiguousarray(np.concatenate([starts, directions], axis=1), dtype=float)
    parameters = np.ascontiguousarray(np.concatenate([values, rates], axis=1), dtype=float)
    out = Flown.of_size(len(joined), joined.shape[1], samples=None, steps=True, judged=False)
    call(_kernel(vehicle, law, gains), joined, parameters, (duration, rtol, rtol, MAX_STEPS), closed(()), out)
    return out


@lru_cache(maxsize=16)
def _kernel(vehicle: Vehicle, law: BoundLaw, gains: tuple[str, ...]) -> jit.Native:
    problem = tangent_problem(vehicle, law, gains)
    return compiled(f"tangent {problem!r}", problem, "dop853")


def tangent_problem(vehicle: Vehicle, law: BoundLaw, gains: tuple[str, ...]) -> Problem:
    """State and direction (48) with gains and their direction (2 k), of the closed loop of `vehicle` under `law`."""
    loop = symbolic_loop(vehicle, law, gains)
    k = len(gains)
    both, parameters = ca.SX.sym("sv", 2 * SIZE), ca.SX.sym("pq", 2 * k)
    along = ca.jtimes(loop.rates, loop.s, both[SIZE:])
    if k:
        along += ca.jtimes(loop.rates, loop.p, parameters[k:])
    old, new = [loop.s, loop.p], [both[:SIZE], parameters[:k]]
    inputs = [loop.t, both, parameters]
    rates = ca.cse(ca.substitute([ca.densify(ca.vertcat(loop.rates, along))], old, new))
    margin = None
    if law.guard is not None:
        signal = loop.signals[law.guard.signal] - law.guard.threshold
        margin = lower(ca.Function("margin", inputs, ca.substitute([ca.densify(signal)], old, new)))
    return Problem(
        rates=lower(ca.Function("rates", inputs, rates)),
        project=lower(_projection(both)),
        observe=lower(ca.Function("observe", inputs, [ca.SX(0, 1)])),  # nothing is judged
        reductions=(),
        margin=margin,
    )


def _projection(both: Any) -> ca.Function:
    """The state is drawn back onto the manifold; its derivative changes by no more than a step's error."""
    out = ca.vertcat(project_symbolic(both[:SIZE]), both[SIZE:])
    return ca.Function("project", [both], [ca.densify(out), ca.DM.zeros(3)])
