"""The closed loop of a vehicle and a law as one CasADi program, from which everything that runs is made."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

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
    rate_vector, outputs = ca.cse([ca.densify(rates.packed()), ca.densify(outputs)])
    return ClosedLoop(
        vehicle=vehicle,
        law=law,
        rates=ca.Function("rates", [t, packed], [rate_vector], ["t", "s"], ["s_dot"]),
        outputs=ca.Function("outputs", [t, packed], [outputs], ["t", "s"], ["outputs"]),
        signal_names=tuple(signals),
    )
