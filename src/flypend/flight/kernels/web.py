"""Flights for web pages: the kernels of this room as modules of WebAssembly, with what a page needs beside them."""

from __future__ import annotations

import casadi as ca
import numpy as np

from flypend.compile.llvm import jit
from flypend.compile.llvm.emit import Lanes, define
from flypend.compile.llvm.loops import LoopModule
from flypend.compile.llvm.target import wasm32
from flypend.compile.program import lower
from flypend.compile.wasm import module
from flypend.flight.criterion import Criterion, observe
from flypend.flight.kernels import ideal, sampled
from flypend.flight.kernels.pieces import pieces_problem
from flypend.flight.request import Tolerances
from flypend.laws.closed_loop import lyapunov_function, symbolic_loop
from flypend.model import State, Vehicle, Wrench, rod_tension
from flypend.model.mount import least_margin, rod_in_body
from flypend.model.state import SIZE, convert_packed
from flypend.plants import Ideal
from flypend.plants.equations import struck
from flypend.plants.knobs import turn_knobs
from flypend.plants.loop import Loop

LANES = 2  # of a kernel: two flights take the time of one, and the module is no larger (benchmarks/web.py)


def web_module(loop: Loop, criterion: Criterion, exact: Tolerances, lanes: int = LANES) -> bytes:
    """Return the module that flies `loop`, `lanes` flights at a time, and judges by `criterion`.

    It is compiled or from the cache. Its functions are "kernel" and `shown_values`, and

    - for a sampled plant, which flies in pieces: "context_size", which stores the bytes of the kernel's argument
      "context", and "turned", from `flypend.plants.knobs` to the argument "plant". The kernel has the arguments
      `ARGUMENTS` of `flypend.compile.llvm.sampled`;
    - for the ideal plant, whose method and precision are those of `exact`: `row`, `own` and "strike", an impulse. The
      kernel has the arguments `ARGUMENTS` of `flypend.compile.llvm.runge_kutta`.

    Raises
    ------
    InputError
        If the law has operations that cannot be compiled, or another engine simulates the plant.
    """
    if isinstance(loop.plant, Ideal):
        problem, chosen = ideal.ideal_problem(loop, criterion), (exact.method_for(loop.symbolic), exact.precision)
        key, kernel = ideal.write_ideal(problem, lanes, *chosen, wasm32())
        centred = loop.vehicle.replace(pivot_offset=(0.0, 0.0, 0.0))  # as the ideal plant has it
        names, beside = ["kernel"], [own(loop), row(loop), struck(centred)]
    else:
        key, kernel = sampled.write_sampled(pieces_problem(loop, criterion), lanes, wasm32())
        names, beside = ["kernel", "context_size"], [turn_knobs(loop.sampled)]
    programs = tuple(lower(function) for function in (*beside, shown_values(loop, criterion)))

    def whole() -> LoopModule:
        made = kernel()
        for program in programs:
            define(Lanes(made, 1, target=wasm32()), program, visible=True)
        return made

    exported = [*names, *(program.name for program in programs)]
    return module(jit.build_object(f"{key} {programs!r}", whole, wasm32()), exported)


def own(loop: Loop) -> ca.Function:
    """Return the CasADi function (state, e₃ up; origin) → the state in the frame of the law, whose origin is there."""
    packed, origin = ca.SX.sym("s", SIZE), ca.SX.sym("o", 3)
    return ca.Function("own", [packed, origin], [ca.densify(convert_packed(_beside(packed, origin), loop.law.e3))])


def row(loop: Loop) -> ca.Function:
    """Return the CasADi function (t, state of `own`, gains, origin) → state and rotor forces, e₃ up.

    The rotor forces, N, are those that the wrench of the law requires.
    """
    symbols, law, origin = symbolic_loop(loop.vehicle, loop.symbolic, loop.parameters), loop.law, ca.SX.sym("o", 3)
    up = _beside(convert_packed(symbols.s, law.e3), -origin)
    wrench = ca.vertcat(symbols.wrench.thrust, symbols.wrench.moment)
    forces = ca.mtimes(ca.DM(loop.vehicle.unmixing(law.e3)), wrench)
    return ca.Function("row", [symbols.t, symbols.s, symbols.p, origin], [ca.densify(ca.vertcat(up, forces))])


def _beside(packed: ca.SX, origin: ca.SX) -> ca.SX:
    """The state `packed` as seen from `origin`."""
    return ca.vertcat(packed[:3] - origin, packed[3:SIZE])


def shown_values(loop: Loop, criterion: Criterion) -> ca.Function:
    """Return the CasADi function (t, state and rotor forces, origin, gains) → what a page shows beside them.

    It is the reference position (3,) in the law's frame, m, with the law's origin at `origin` (3,), e₃ up; the thrust
    along z = R e₃ of that frame, N; the clearance of the rod, m, infinite on a gimbal; the worst excess over the
    tolerances of `criterion`; and V, if the law has one. The state is e₃ up, the gains are the parameters of `loop`.
    """
    law, true = loop.symbolic, true_vehicle(loop)
    t, origin = ca.SX.sym("t"), ca.SX.sym("o", 3)
    packed = ca.SX.sym("s", SIZE + len(true.rotor_spins))
    place = ca.SX(3, 1) if law.reference is None else ca.densify(law.reference(t))
    moved = convert_packed(ca.vertcat(origin, ca.SX(SIZE - 3, 1)), law.e3)[:3]
    thrust = ca.mtimes(ca.DM(true.mixing(law.e3)[:1]), packed[SIZE:])
    state, upward = State.symbolic(packed[:SIZE]), ca.sum1(packed[SIZE:])
    clearance = ca.SX(np.inf)
    if true.mount != "gimbal":
        push = -rod_tension(state, Wrench(upward, ca.SX(3, 1)), true)
        clearance = least_margin(rod_in_body(state, "up")[0], push, true)[2]
    own = convert_packed(_beside(packed, origin), law.e3)
    excess = observe(t, State.symbolic(own[:SIZE]), packed[SIZE:], true, law.reference, criterion, law.e3)[0]
    gains, numbers = ca.SX.sym("p", len(loop.parameters)), [place + moved, thrust, clearance, excess]
    lyapunov = lyapunov_function(loop.vehicle, law, loop.parameters)
    if lyapunov is not None:
        numbers.append(lyapunov(t, own, gains))
    return ca.Function("shown", [t, packed, origin, gains], [ca.densify(ca.vertcat(*numbers))])


def true_vehicle(loop: Loop) -> Vehicle:
    """Return the vehicle that flies: in a sampled plant the true one, which may differ from what the law believes."""
    return loop.vehicle if isinstance(loop.plant, Ideal) else loop.sampled.true_vehicle(loop.vehicle)
