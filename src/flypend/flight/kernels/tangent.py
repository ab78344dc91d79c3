"""The kernel of the ideal plant with its variational equation.

Each run propagates one direction, v of the state and q of the gains: ṡ = F(t, s, p), v̇ = F_s v + F_p q, by forward
derivatives of the same program.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.llvm import jit
from flypend.compile.problem import Problem
from flypend.compile.program import lower
from flypend.flight.kernels.flown import Flown, inputs_of
from flypend.flight.kernels.ideal import Limits, Moments, call, compile_ideal
from flypend.flight.kernels.stopping import heard
from flypend.flight.request import Flight
from flypend.geometry import Numbers
from flypend.laws.closed_loop import symbolic_loop
from flypend.model.state import SIZE, project_symbolic
from flypend.plants.loop import Loop


def fly_tangents(flight: Flight, gains: tuple[str, ...], directions: Any, rates: Any) -> Flown:
    """Fly the single start of `flight` along many `directions`; final states (n, 48) hold state and derivative.

    Parameters
    ----------
    flight : Flight
        A request with a single start, in the ideal plant.
    gains : tuple of str
        The k gains that vary.
    directions : (n, 24)
        Directions of the start, tangent to the manifold.
    rates : (n, k)
        Directions of the gains.
    """
    loop = replace(flight.loop, parameters=gains)
    starts = np.tile(flight.starts.packed(), (len(directions), 1))
    joined = np.ascontiguousarray(np.concatenate([starts, directions], axis=1))
    parameters = np.ascontiguousarray(np.concatenate([inputs_of(loop, None, len(directions)), rates], axis=1))
    out = Flown.of_size(len(joined), joined.shape[1], samples=None, steps=True, judged=False)
    kernel, limits = _kernel(loop), Limits.of(flight.duration, flight.tolerances)
    heard([lambda stop: call(kernel, joined, parameters, limits, Moments.of(), out, stop)])
    return out


@lru_cache(maxsize=16)
def _kernel(loop: Loop) -> jit.Native:
    problem = tangent_problem(loop)
    return compile_ideal(f"tangent {problem!r}", problem, "dop853")


def tangent_problem(closed: Loop) -> Problem:
    """Return the `closed` loop as programs on (state, direction) (48,) and (parameters, their direction) (2 k,)."""
    law, k = closed.symbolic, len(closed.parameters)
    loop = symbolic_loop(closed.vehicle, law, closed.parameters)
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
        margin=margin,
    )


def _projection(both: Numbers) -> ca.Function:
    """Project the state onto the manifold; this would change the derivative by no more than a step's error."""
    out = ca.vertcat(project_symbolic(both[:SIZE]), both[SIZE:])
    return ca.Function("project", [both], [ca.densify(out), ca.DM.zeros(3)])
