"""Compiled flights whose gains, lag, noise and wind are inputs: changing them recompiles nothing."""

from __future__ import annotations

import json
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any
from weakref import WeakSet

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend.flight.criterion import Criterion
from flypend.flight.kernels import IdealKernel, SampledKernel, kernel_for, structure
from flypend.flight.kernels.pieces import PiecesKernel, pieces_kernel
from flypend.flight.kernels.stopping import raise_if_stopped
from flypend.flight.verdict import goal
from flypend.lab.setting import Setting
from flypend.laws import BoundLaw, Controller, Law
from flypend.laws.closed_loop import lyapunov_function, symbolic_loop
from flypend.laws.lqr import by_matrix, entries, gain_matrix
from flypend.model import State, Vehicle, Wrench
from flypend.pages.offers import sliders_of
from flypend.plants import Sampled

MOST = 48
Tell = Callable[[], Any]


@dataclass(frozen=True)
class Tuned:
    """A compiled closed loop.

    Parameters
    ----------
    kernel : IdealKernel or SampledKernel
        The machine code; the parameters of its loop are inputs.
    wrench : Function
        (t, state, gains) → commanded thrust and moment.
    lyapunov : Function, optional
        (t, state, gains) → the law's Lyapunov function V; None for a law that has none.
    """

    kernel: IdealKernel | SampledKernel
    wrench: ca.Function
    lyapunov: ca.Function | None

    @property
    def vehicle(self) -> Vehicle:
        """The vehicle."""
        return self.kernel.loop.vehicle

    @property
    def law(self) -> BoundLaw:
        """The compiled law; its gains `names` are inputs."""
        return self.kernel.loop.symbolic

    @property
    def names(self) -> tuple[str, ...]:
        """The gains that are inputs."""
        return self.kernel.loop.parameters

    @property
    def criterion(self) -> Criterion:
        """The success criterion."""
        return self.kernel.criterion


@dataclass(frozen=True)
class Stepped:
    """A closed loop whose law is not symbolic: `vehicle`, bound `law` and success `criterion`."""

    vehicle: Vehicle
    law: Controller
    criterion: Criterion

    @property
    def names(self) -> tuple[str, ...]:
        """The gains that are inputs: none, since nothing is compiled."""
        return ()


_made: OrderedDict[str, Tuned] = OrderedDict()
_in_pieces: WeakSet[BoundLaw] = WeakSet()  # the laws of `_made` whose flights in pieces are compiled


def tune_loop(setting: Setting, tell: Tell = lambda: None) -> Tuned | Stepped:
    """Return the closed loop of `setting`; `tell` is called before a compilation, which takes about a second."""
    flight, law = setting.flight, setting.law
    if isinstance(law, Controller):
        return Stepped(flight.vehicle, _stoppable(law.bind(flight.vehicle)), goal(law.e3))
    fixed = {name: value for name, value in law.given.items() if not law.gains[name].label}
    kept = repr(structure(flight.plant)) if isinstance(flight.plant, Sampled) else "ideal"
    key = json.dumps(
        [flight.vehicle.to_dict(), law.name, setting.where, setting.stamp, fixed, kept, flight.tolerances.rtol],
        sort_keys=True,
    )
    if key not in _made:
        tell()
        _made[key] = _make(setting, law, fixed)
    _made.move_to_end(key)
    while len(_made) > MOST:
        _made.popitem(last=False)
    made = _made[key]
    if isinstance(flight.plant, Sampled) and isinstance(made.kernel, SampledKernel):
        return replace(made, kernel=made.kernel.through(flight.plant.replace(seed=0)))
    return made


def _stoppable(law: Controller) -> Controller:
    """Return the bound `law`, whose calls raise StoppedError once the flight is stopped."""

    def function(t: float, state: State) -> Wrench:
        raise_if_stopped()
        return law.function(t, state)

    return replace(law, function=function, steering=None)


def in_pieces(machine: Tuned, tell: Tell = lambda: None) -> PiecesKernel:
    """Return the flights in pieces of `machine`, a sampled one; `tell` is called before a compilation."""
    if machine.law not in _in_pieces:
        tell()
    kernel = pieces_kernel(machine.kernel.loop, machine.criterion)
    _in_pieces.add(machine.law)
    return kernel


def _make(setting: Setting, asked: Law, fixed: dict[str, Any]) -> Tuned:
    flight = setting.flight
    tunable, names = replace(asked, given=fixed), sliders_of(asked)
    if asked.name == "lqr" and not setting.where:
        tunable = by_matrix(gain_matrix(flight.vehicle, asked.values))
        names = tuple(tunable.gains)
    law = tunable.bind(flight.vehicle)
    loop = replace(flight.replace(law=law).loop, parameters=names)
    kernel = kernel_for(loop, goal(asked.e3), flight.tolerances)
    symbols = symbolic_loop(loop.vehicle, law, names)
    wrench = ca.densify(ca.vertcat(symbols.wrench.thrust, symbols.wrench.moment))
    output = ca.Function("wrench", [symbols.t, symbols.s, symbols.p], ca.cse([wrench]))
    return Tuned(kernel, output, lyapunov_function(loop.vehicle, law, names))


def values(setting: Setting) -> NDArray[np.float64]:
    """Return the values (k,) of the gains that are inputs."""
    law, vehicle = setting.law, setting.flight.vehicle
    if isinstance(law, Controller):
        return np.zeros(0)
    if law.name == "lqr" and not setting.where:
        return np.array(list(entries(gain_matrix(vehicle, law.values)).values()))
    gains = setting.gains
    return np.array([float(gains[name]) for name in sliders_of(law)])
