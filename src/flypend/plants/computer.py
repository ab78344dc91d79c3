"""The flight computer of a sampled flight: predict, observe, evaluate the law, allocate, lead."""

from __future__ import annotations

from collections import deque
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.numeric import as_numpy
from flypend.geometry import apply, cross
from flypend.laws.law import Law
from flypend.model import State, Vehicle, Wrench
from flypend.model.state import FLIP_PACKED, SIZE
from flypend.plants.actuation import Actuation, rotor_forces
from flypend.plants.equations import EquationsEngine
from flypend.plants.observer import ForceObserver
from flypend.plants.plant import Plant

# Longest step of the prediction, s. It is shorter than the dynamics that it predicts and costs a tenth of the plant's.
TWIN_STEP = 1e-2
CALM = np.zeros(6)


class FlightComputer:
    """Runs `law` for the `vehicle` that it believes in, once per control period of `plant`.

    It keeps what a flight computer keeps: the modelled rotor forces, the commands under way, the observer's state.
    """

    def __init__(self, law: Law, vehicle: Vehicle, plant: Plant) -> None:
        self._plant = plant
        self._latency = law.computer.latency
        self._period = 1 / plant.rate
        self._command = command_function(law, vehicle, plant.limits, plant.interface, plant.rate_loop_gain)
        self._twin = Actuation(EquationsEngine(vehicle), vehicle, plant, TWIN_STEP)
        self._observer = ForceObserver(vehicle, law.computer)
        self._rotors: Any = np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0])
        self._current: Any = idle_command(vehicle, plant)
        self._pending: deque[tuple[float, Any]] = deque()

    def command(self, t: float, measured: Any) -> Any:
        """The command for the measurement `measured` (24,), e₃ up, taken at time `t` (s)."""
        forces = self._observer.update(measured, self._rotors, self._period)
        state, rotors = self._predict(t, measured)
        command = self._command(t + self._latency, state, rotors, forces)
        self._pending.append((t + self._latency, command))
        return command

    def _predict(self, t: float, measured: Any) -> tuple[Any, Any]:
        """State and rotor forces when the next command is planned to act; moves the rotor model on to `t` + period."""
        twin = self._twin
        twin.engine.reset(measured, self._rotors)
        now, command = t, self._current
        for act, following in self._pending:
            if act > now + 1e-9:
                twin.advance(command, act - now, CALM)
                now = act
            command = following
        if t + self._latency > now + 1e-9:
            twin.advance(command, t + self._latency - now, CALM)
        return twin.engine.packed, twin.engine.rotors

    def tick(self, t: float, measured: Any) -> None:
        """Move the model of the rotors from `t` over one period, over the commands that are planned to act in it."""
        twin, end = self._twin, t + self._period
        twin.engine.reset(measured, self._rotors)
        now = t
        while self._pending and self._pending[0][0] < end - 1e-9:
            act, following = self._pending.popleft()
            if act > now + 1e-9:
                twin.advance(self._current, act - now, CALM)
                now = act
            self._current = following
        twin.advance(self._current, end - now, CALM)
        self._rotors = twin.engine.rotors


def idle_command(vehicle: Vehicle, plant: Plant) -> Any:
    """The command before the first one arrives: rotors at their least force, or no thrust and no rates."""
    return np.zeros(4) if plant.interface == "rates" else np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0])


@lru_cache(maxsize=64)
def command_function(law: Law, vehicle: Vehicle, limits: bool, interface: str, rate_gain: float) -> Any:
    """(t, state (24,), modelled rotor forces (n,), external forces (6,)) → command, for e₃ up whatever the law's frame.

    For the interface "wrench" a command is the rotor forces (n,), with the law's lead; for "rates" it is the thrust and
    the body rates (4,) whose proportional tracking with `rate_gain` (1/s) gives the law's moment at this instant.
    """
    n = len(vehicle.rotor_spins)
    t, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
    rotors, external = ca.SX.sym("r", n), ca.SX.sym("F", 6)
    own = packed if law.e3 == "up" else packed * FLIP_PACKED
    wrench: Wrench = law.evaluate(t, State.symbolic(own), vehicle, (external[:3], external[3:])).wrench
    if law.e3 == "down":
        wrench = Wrench(-wrench.thrust, wrench.moment * np.array([1.0, -1.0, -1.0]))
    if interface == "rates":
        omega = packed[15:18]
        free = wrench.moment - cross(omega, apply(vehicle.I, omega))
        rates = omega + apply(vehicle.I_inv, free) / rate_gain
        command = ca.vertcat(wrench.thrust, rates)
    else:
        wanted = rotor_forces(wrench.thrust, wrench.moment, vehicle, limits)
        command = rotors + law.computer.lead * (wanted - rotors)
        if limits:
            command = ca.fmin(ca.fmax(command, vehicle.rotor_limits[0]), vehicle.rotor_limits[1])
    command = ca.cse(ca.densify(command))
    return as_numpy(ca.Function("command", [t, packed, rotors, external], [command]))
