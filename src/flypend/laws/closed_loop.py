"""The symbolic closed loop of a vehicle and a law: the source of all code that runs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from flypend import errors
from flypend.building import built
from flypend.geometry import Numbers, Scalar
from flypend.laws.bound import BoundLaw, Control
from flypend.laws.guarantee import Guarantee
from flypend.laws.law import Law
from flypend.model import State, Vehicle, Wrench, equations_of_motion
from flypend.model.state import SIZE

WRENCH = 4  # entries of a wrench: thrust, N, and moment, N m
COMMANDS = ("thrust_command", "moment_command_1", "moment_command_2", "moment_command_3")  # signals, through a lag


@dataclass(frozen=True)
class SymbolicLoop:
    """Closed loop as CasADi expressions.

    Parameters
    ----------
    t, s, p : SX
        Symbols: time, packed state (24, 1), and the gains that may vary between runs, in the order of `parameters`.
        Through a lag, the state is followed by the wrench that acts, (28, 1).
    rates : SX (24, 1) or (28, 1)
        Derivative of `s`.
    wrench : Wrench
        The wrench that acts: as commanded, or the one in `s`.
    signals : dict of SX
        Signals of the law, the sum V of its Lyapunov functions, and the rates of V and of each along the loop.
    parameters : tuple of str
        Names of the gains in `p`.
    """

    t: Scalar
    s: Numbers
    p: Numbers
    rates: Numbers
    wrench: Wrench
    signals: dict[str, Scalar]
    parameters: tuple[str, ...]


@dataclass(frozen=True)
class ClosedLoop:
    """Closed loop of `vehicle` under `law`.

    `rates` maps (t, state (24,)) to the state derivative; `outputs` maps the same to thrust, moment (3,) and the
    scalars named in `signal_names`. Through a lag, the state is followed by the wrench that acts, (28,).
    """

    vehicle: Vehicle
    law: BoundLaw
    rates: ca.Function
    outputs: ca.Function
    signal_names: tuple[str, ...]


def symbolic_loop(
    vehicle: Vehicle, law: Law | BoundLaw, parameters: Sequence[str] = (), *, lag: bool = False
) -> SymbolicLoop:
    """Build the symbolic closed loop of `vehicle` under `law`; the gains named in `parameters` are symbols too.

    With `lag`, the wrench w follows the commanded one, w_c, through the rotors' lag T: T ẇ = w_c − w.

    Raises InputError if a parameter is not a numeric gain of the law, or does not appear in its equations (for example,
    a weight from which a gain matrix was computed in advance); and for a law that takes the wrench that acts, without
    `lag`.
    """
    return _symbolic_loop(vehicle, *_check(vehicle, law, parameters), lag)


@built(maxsize=8)  # a run needs the same symbols for its kernel and for its signals
def _symbolic_loop(vehicle: Vehicle, bound: BoundLaw, parameters: tuple[str, ...], lag: bool) -> SymbolicLoop:
    """The equations of motion under `bound`, with its signals and the rates of its Lyapunov functions."""
    t, s, p, control = _output(vehicle, bound, parameters, lag)
    acting, command, commands = wrench_in(s) if lag else control.wrench, _stack(control.wrench), {}
    rates = equations_of_motion(State.symbolic(s), acting, vehicle, bound.e3).packed()
    if lag:
        commands = dict(zip(COMMANDS, ca.vertsplit(command), strict=True))
        rates = ca.vertcat(rates, (command - s[SIZE:]) / vehicle.rotor_lag)
    lyapunov, flow = _lyapunov(control), (ca.vertcat(s, t), ca.vertcat(rates, 1))
    derived = {f"{name}_rate": ca.jtimes(value, *flow) for name, value in lyapunov.items()}
    signals = {**lyapunov, **derived, **control.signals, **commands}
    return SymbolicLoop(t, s, p, ca.densify(rates), acting, signals, parameters)


def wrench_in(s: Numbers) -> Wrench:
    """Return the wrench that acts, from a packed state (28, 1) through a lag, in CasADi."""
    return Wrench(s[SIZE], s[SIZE + 1 :])


def _stack(wrench: Wrench) -> Numbers:
    return ca.densify(ca.vertcat(wrench.thrust, wrench.moment))


def _lyapunov(control: Control) -> dict[str, Scalar]:
    """Return the Lyapunov functions of a law by name, and their sum V if there are any."""
    return dict(control.lyapunov) | ({"V": sum(control.lyapunov.values())} if control.lyapunov else {})


@built(maxsize=8)
def _output(
    vehicle: Vehicle, bound: BoundLaw, parameters: tuple[str, ...], lag: bool = False
) -> tuple[Scalar, Numbers, Numbers, Control]:
    """Return the symbols t, s and p of a `SymbolicLoop`, and what the law answers to them."""
    t, s, p = ca.SX.sym("t"), ca.SX.sym("s", SIZE + WRENCH * lag), ca.SX.sym("p", len(parameters))
    gains = {name: p[i] for i, name in enumerate(parameters)}
    acting = wrench_in(s) if lag else None
    control = bound.evaluate(t, State.symbolic(s), vehicle, gains=gains, acting=acting)
    check_parameters(bound.name, _stack(control.wrench), parameters, p)
    return t, s, p, control


def lyapunov_function(vehicle: Vehicle, law: Law | BoundLaw, parameters: Sequence[str] = ()) -> ca.Function | None:
    """Return the CasADi function (t, state (24,), gains) → V of `law`; None for a law that has no V.

    The gains are those named in `parameters`; raises InputError as `symbolic_loop`. For a law that takes the wrench
    that acts, the state is (28,). The rates, which take most of the time of a closed loop, are not derived.
    """
    bound, names = _check(vehicle, law, parameters)
    t, s, p, control = _output(vehicle, bound, names, bound.uses_wrench)
    if not control.lyapunov:
        return None
    return ca.Function("V", [t, s, p], [ca.cse(ca.densify(_lyapunov(control)["V"]))])


def signal_names(vehicle: Vehicle, law: Law | BoundLaw) -> tuple[str, ...]:
    """Return the names of the signals of `law`, as in `SymbolicLoop.signals`, without deriving a rate."""
    *_, control = _output(vehicle, *_check(vehicle, law, ()))
    lyapunov = _lyapunov(control)
    return tuple(dict.fromkeys((*lyapunov, *(f"{name}_rate" for name in lyapunov), *control.signals)))


def _check(vehicle: Vehicle, law: Law | BoundLaw, parameters: Sequence[str]) -> tuple[BoundLaw, tuple[str, ...]]:
    """Return `law` bound to `vehicle`, and its gains `parameters`. Raises InputError for one that is no number."""
    bound = law.bind(vehicle)
    errors.only_known("law.gains", dict.fromkeys(parameters), bound.numbers)
    return bound, tuple(parameters)


def check_parameters(law: str, wrench: Numbers, parameters: Sequence[str], symbols: Numbers) -> None:
    """Raise InputError for one of the `parameters` whose symbol the `wrench` of the `law` does not contain.

    A run would not depend on it: a weight from which a gain matrix was computed beforehand, or a number of the flight
    computer.
    """
    for i, name in enumerate(parameters):
        if not ca.depends_on(wrench, symbols[i]):
            raise errors.InputError(f"law.gains.{name}", f"a gain in the equations of {law}", "one outside them")


def close_loop(vehicle: Vehicle, law: Law | BoundLaw, *, lag: bool = False) -> ClosedLoop:
    """Build the closed loop of `vehicle` under `law` as CasADi functions; `lag` as in `symbolic_loop`."""
    return _close_loop(vehicle, law.bind(vehicle), lag)


@built(maxsize=8)  # what a theorem says of each of many starts takes the same
def _close_loop(vehicle: Vehicle, bound: BoundLaw, lag: bool) -> ClosedLoop:
    loop = symbolic_loop(vehicle, bound, lag=lag)
    outputs = ca.vertcat(_stack(loop.wrench), *loop.signals.values())
    rates, outputs = ca.cse([loop.rates, ca.densify(outputs)])
    return ClosedLoop(
        vehicle=vehicle,
        law=bound,
        rates=ca.Function("rates", [loop.t, loop.s], [rates], ["t", "s"], ["s_dot"]),
        outputs=ca.Function("outputs", [loop.t, loop.s], [outputs], ["t", "s"], ["outputs"]),
        signal_names=tuple(loop.signals),
    )


def signals_at(law: BoundLaw, start: State) -> Mapping[str, float]:
    """Return the signals of `law` at time 0 at a single `start`, in the law's frame. Raises InputError for a batch.

    A law that takes the wrench that acts gets that of rotors at their minimum.
    """
    if start.batch_shape:
        raise errors.InputError("start", "a single state", f"a batch of shape {start.batch_shape}")
    loop, packed, vehicle = close_loop(law.vehicle, law, lag=law.uses_wrench), start.packed(), law.vehicle
    if law.uses_wrench:
        idle = vehicle.mixing() @ np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0])
        packed = np.concatenate([packed, idle])
    with np.errstate(all="ignore"):
        values = np.array(loop.outputs(0.0, packed)).ravel()[WRENCH:]
    return dict(zip(loop.signal_names, values.tolist(), strict=True))


def outside(law: BoundLaw, found: Mapping[str, float], sets: Mapping[str, str]) -> Guarantee | None:
    """Return the guarantee of a start on an exceptional set; None for one in the domain.

    `sets` maps the signal whose value −1 marks a set to its equation; `found` are the signals at the start.
    """
    assert law.guard is not None
    for signal, equation in sets.items():
        if not 1 + found[signal] > law.guard.threshold:
            return Guarantee(covered=False, reason=f"outside the domain: {equation}", V=math.inf)
    return None
