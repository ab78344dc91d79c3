"""Sampled flights for web pages: the kernel of `flypend.flight.kernels.pieces` as a WebAssembly module."""

from __future__ import annotations

import casadi as ca
import numpy as np
from llvmlite import ir

from flypend.compile.llvm import jit
from flypend.compile.llvm.emit import define
from flypend.compile.llvm.target import wasm32
from flypend.compile.llvm.vector import Lanes
from flypend.compile.program import lower
from flypend.compile.wasm import module
from flypend.flight.criterion import Criterion
from flypend.flight.kernels.pieces import pieces_problem
from flypend.flight.kernels.sampled import written
from flypend.laws.closed_loop import lyapunov_function
from flypend.model import State, Wrench, rod_tension
from flypend.model.mount import least_margin, rod_in_body
from flypend.model.state import SIZE, seen_packed
from flypend.plants.knobs import turned
from flypend.plants.loop import Loop


def web_kernel(loop: Loop, criterion: Criterion) -> bytes:
    """Return a module that flies `loop` in pieces and judges by `criterion`, compiled or from the cache.

    Its functions are "kernel", with the arguments `ARGUMENTS` and `RESUMED_ARGUMENTS` of
    `flypend.compile.llvm.sampled` in that order; "context_size", which stores its bytes; "turned", from
    `flypend.plants.knobs` to the kernel's argument "plant"; and `shown`.

    Raises
    ------
    InputError
        If the law has operations that cannot be compiled, or another engine simulates the plant.
    """
    problem, programs = pieces_problem(loop, criterion), [lower(turned(loop.sampled)), lower(shown(loop))]
    key, kernel = written(problem, 1, wasm32())

    def whole() -> ir.Module:
        made = kernel()
        for program in programs:
            define(Lanes(made, 1, target=wasm32()), program).linkage = "external"
        return made

    names = ["kernel", "context_size", *(program.name for program in programs)]
    return module(jit.build_object(f"{key} {programs!r}", whole, wasm32()), names)


def shown(loop: Loop) -> ca.Function:
    """Return the CasADi function (t, state and rotor forces, origin, gains) → what a page shows beside them.

    It is the reference position (3,) in the law's frame, m, with the law's origin at `origin` (3,), e₃ up; the thrust
    along z = R e₃ of that frame, N; the clearance of the rod, m, infinite on a gimbal; and V, if the law has one. The
    state is e₃ up, the gains are the parameters of `loop`.
    """
    law, true = loop.symbolic, loop.sampled.true_vehicle(loop.vehicle)
    t, origin = ca.SX.sym("t"), ca.SX.sym("o", 3)
    packed = ca.SX.sym("s", SIZE + len(true.rotor_spins))
    place = ca.SX(3, 1) if law.reference is None else ca.densify(law.reference(t))
    moved = seen_packed(ca.vertcat(origin, ca.SX(SIZE - 3, 1)), law.e3)[:3]
    thrust = ca.mtimes(ca.DM(true.mixing(law.e3)[:1]), packed[SIZE:])
    state, upward = State.symbolic(packed[:SIZE]), ca.sum1(packed[SIZE:])
    clearance = ca.SX(np.inf)
    if true.mount != "gimbal":
        push = -rod_tension(state, Wrench(upward, ca.SX(3, 1)), true)
        clearance = least_margin(rod_in_body(state, "up")[0], push, true)[2]
    gains, numbers = ca.SX.sym("p", len(loop.parameters)), [place + moved, thrust, clearance]
    lyapunov = lyapunov_function(loop.vehicle, law, loop.parameters)
    if lyapunov is not None:
        beside = ca.vertcat(packed[:3] - origin, packed[3:SIZE])
        numbers.append(lyapunov(t, seen_packed(beside, law.e3), gains))
    return ca.Function("shown", [t, packed, origin, gains], [ca.densify(ca.vertcat(*numbers))])
