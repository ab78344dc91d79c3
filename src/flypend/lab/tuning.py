"""Flights whose gains, lag, noise and wind are inputs of the machine code: others compile nothing."""

from __future__ import annotations

import json
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from threading import RLock
from typing import Any

import casadi as ca
import numpy as np

from flypend.flight.criterion import Criterion
from flypend.flight.kernels import IdealKernel, SampledKernel, ideal_kernel, method_for, sampled_kernel, structure
from flypend.lab.gains import sliders_of
from flypend.lab.setting import law_of
from flypend.laws import BoundLaw, Law, law_from_dict
from flypend.laws.closed_loop import symbolic_loop
from flypend.laws.lqr import by_matrix, entries, gain_matrix
from flypend.model import Vehicle
from flypend.plants import Plant
from flypend.plants import plant as plant_named
from flypend.plants.loop import Loop
from flypend.settings.runfile import Flight

MOST = 48
Tell = Callable[[], Any]


@dataclass(frozen=True)
class Tuned:
    """What flies a flight.

    Parameters
    ----------
    vehicle : Vehicle
        What flies.
    law : BoundLaw
        The law of the machine code, whose `names` are inputs.
    names : tuple of str
        Gains that are inputs.
    criterion : Criterion
        What the flight should do.
    plant : Plant, optional
        None for the ideal one.
    kernel : IdealKernel or SampledKernel
        The machine code.
    wrench : Function
        (t, state, gains) → thrust and moment, as commanded.
    """

    vehicle: Vehicle
    law: BoundLaw
    names: tuple[str, ...]
    criterion: Criterion
    plant: Plant | None
    kernel: IdealKernel | SampledKernel
    wrench: ca.Function


_made: OrderedDict[str, Tuned] = OrderedDict()
_building = RLock()  # CasADi's symbols are shared by no two threads


def tuned(flight: Flight, tell: Tell = lambda: None) -> Tuned:
    """What flies `flight`; `tell` is called if it has to be made first, which takes a second."""
    fixed = {name: value for name, value in law_of(flight).given.items() if not law_of(flight).gains[name].label}
    plant = None if flight.plant == "ideal" else plant_named(flight.plant).replace(seed=0)
    kept = None if plant is None else repr(structure(plant))
    key = json.dumps([flight.vehicle.to_dict(), law_of(flight).name, fixed, kept, flight.rtol], sort_keys=True)
    with _building:
        if key not in _made:
            tell()
            _made[key] = _make(flight, fixed, plant)
        _made.move_to_end(key)
        while len(_made) > MOST:
            _made.popitem(last=False)
        made = _made[key]
    if plant is None or not isinstance(made.kernel, SampledKernel):
        return made
    return replace(made, plant=plant, kernel=made.kernel.through(plant))


def _make(flight: Flight, fixed: dict[str, Any], plant: Plant | None) -> Tuned:
    vehicle, criterion = flight.vehicle, goal(law_of(flight))
    asked = law_of(flight)
    tunable, names = law_from_dict({"name": asked.name, "gains": fixed}), sliders_of(asked)
    if asked.name == "lqr":
        tunable = by_matrix(gain_matrix(vehicle, asked.values))
        names = tuple(tunable.gains)
    law = tunable.bind(vehicle)
    if plant is None:
        method = method_for(flight.rtol, law)
        kernel: Any = ideal_kernel(vehicle, law, criterion, names, method=method)
    else:
        kernel = sampled_kernel(Loop(vehicle, law, plant, names), criterion)
    loop = symbolic_loop(vehicle, law, names)
    wrench = ca.densify(ca.vertcat(loop.wrench.thrust, loop.wrench.moment))
    function = ca.Function("wrench", [loop.t, loop.s, loop.p], ca.cse([wrench]))
    return Tuned(vehicle, law, names, criterion, plant, kernel, function)


def values(flight: Flight) -> Any:
    """The values (k,) of the gains that are inputs."""
    law, vehicle = law_of(flight), flight.vehicle
    if law.name == "lqr":
        with _building:  # the linearisation is symbolic, too
            return np.array(list(entries(gain_matrix(vehicle, law.values)).values()))
    gains = law.gains_for(vehicle)
    return np.array([float(gains[name]) for name in sliders_of(law)])


def goal(law: Law) -> Criterion:
    """What `law` is to do: to stand inverted; for the paper's laws, to bring the rod to their e₃, anywhere."""
    return Criterion() if law.e3 == "up" else Criterion(target="e3", position=np.inf)
