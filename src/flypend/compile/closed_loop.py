"""The closed loop of a vehicle and a law as one CasADi program, from which everything that runs is made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from flypend.laws.law import Law
from flypend.model import State, Vehicle, equations_of_motion, lie_derivative
from flypend.model.state import SIZE


@dataclass(frozen=True)
class ClosedLoop:
    """Closed loop of `vehicle` under `law`.

    `rates` maps (t, state (24,)) to the rates of the state; `outputs` maps the same to thrust, moment (3,) and the
    scalars named in `signal_names`.
    """

    vehicle: Vehicle
    law: Law
    rates: ca.Function
    outputs: ca.Function
    signal_names: tuple[str, ...]


def close_loop(vehicle: Vehicle, law: Law) -> ClosedLoop:
    """Write the closed loop of `vehicle` under `law` in symbols and compile it to CasADi functions.

    The law's Lyapunov functions are summed to V, and their rates along the closed loop are added as signals.
    """
    t, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
    state = State.symbolic(packed)
    control = law.evaluate(t, state, vehicle)
    rates = equations_of_motion(state, control.wrench, vehicle, law.e3)

    lyapunov = dict(control.lyapunov)
    if lyapunov:
        lyapunov["V"] = sum(lyapunov.values())
    lyapunov |= {f"{name}_rate": lie_derivative(value, state, rates, t) for name, value in lyapunov.items()}
    signals = {**lyapunov, **control.signals}

    outputs = ca.vertcat(control.wrench.thrust, control.wrench.moment, *signals.values())
    rate_vector, outputs = ca.cse([rates.packed(), outputs])
    return ClosedLoop(
        vehicle=vehicle,
        law=law,
        rates=ca.Function("rates", [t, packed], [rate_vector], ["t", "s"], ["s_dot"]),
        outputs=ca.Function("outputs", [t, packed], [outputs], ["t", "s"], ["outputs"]),
        signal_names=tuple(signals),
    )


def as_numpy(function: ca.Function) -> Callable[[float, Any], Any]:
    """A CasADi function of (t, s) with one dense output as a NumPy callable, without conversion per call."""
    buffer, trigger = function.buffer()
    t, s = np.zeros(1), np.zeros(function.size1_in(1))
    out = np.zeros(function.nnz_out(0))
    size = function.size1_out(0)
    rows = np.array(function.sparsity_out(0).row())
    buffer.set_arg(0, memoryview(t))  # type: ignore[arg-type]
    buffer.set_arg(1, memoryview(s))  # type: ignore[arg-type]
    buffer.set_res(0, memoryview(out))  # type: ignore[arg-type]

    def call(time: float, state: Any) -> Any:
        t[0], s[:] = time, state
        trigger()
        result = np.zeros(size)
        result[rows] = out
        return result

    call.buffer = buffer  # type: ignore[attr-defined]  # `trigger` points into it: it must live as long
    return call
