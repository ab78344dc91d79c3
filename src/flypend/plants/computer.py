"""The flight computer of a sampled flight: predict, observe, evaluate the law, allocate, lead."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.closed_loop import upright_wrench
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.geometry import apply, cross
from flypend.laws.law import Controller, Law
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, SIZE
from flypend.plants.actuation import Actuation, rotor_forces
from flypend.plants.equations import EquationsEngine
from flypend.plants.observer import ForceObserver
from flypend.plants.plant import Plant

# Longest step of the prediction, s. It is shorter than the dynamics that it predicts and costs a tenth of the plant's.
TWIN_STEP = 1e-2


class FlightComputer:
    """Runs `law` for the `vehicle` that it believes in, once per control period of `plant`.

    It keeps what a flight computer keeps: the modelled rotor forces, the commands under way, the observer's state.
    """

    def __init__(self, law: Law | Controller, vehicle: Vehicle, plant: Plant) -> None:
        self._plant = plant
        self._latency = law.computer.latency
        self._period = 1 / plant.rate
        self._command = command_source(law, vehicle, plant)
        self._twin = Actuation(EquationsEngine(vehicle), vehicle, plant, TWIN_STEP)
        self._observer = ForceObserver(vehicle, law.computer)
        self._forces: Any = np.zeros(6)
        self._rotors: Any = np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0])
        self._current: Any = idle_command(vehicle, plant)
        self._pending: deque[tuple[float, Any]] = deque()

    def command(self, t: float, measured: Any) -> Any:
        """The command for the measurement `measured` (24,), e₃ up, taken at time `t` (s)."""
        self._forces = self._observer.update(measured, self._rotors, self._period)
        state, rotors = self._predict(t, measured)
        command = self._command(t + self._latency, state, rotors, self._forces)
        self._pending.append((t + self._latency, command))
        return command

    def _predict(self, t: float, measured: Any) -> tuple[Any, Any]:
        """State and rotor forces when a command given at `t` is planned to act, over the commands under way."""
        twin = self._twin
        twin.engine.reset(measured, self._rotors)
        now, command = t, self._current
        for act, following in self._pending:
            if act > now + 1e-9:
                twin.advance(command, act - now, self._forces)
                now = act
            command = following
        if t + self._latency > now + 1e-9:
            twin.advance(command, t + self._latency - now, self._forces)
        return twin.engine.packed, twin.engine.rotors

    def tick(self, t: float, measured: Any) -> None:
        """Move the model of the rotors from `t` over one period, over the commands that are planned to act in it."""
        twin, end = self._twin, t + self._period
        twin.engine.reset(measured, self._rotors)
        now = t
        while self._pending and self._pending[0][0] < end - 1e-9:
            act, following = self._pending.popleft()
            if act > now + 1e-9:
                twin.advance(self._current, act - now, self._forces)
                now = act
            self._current = following
        twin.advance(self._current, end - now, self._forces)
        self._rotors = twin.engine.rotors


def idle_command(vehicle: Vehicle, plant: Plant) -> Any:
    """The command before the first one arrives: rotors at their least force, or no thrust and no rates."""
    return np.zeros(4) if plant.interface == "rates" else np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0])


def command_source(law: Law | Controller, vehicle: Vehicle, plant: Plant) -> Callable[..., Any]:
    """(t, state (24,), modelled rotor forces (n,), external forces (6,)) → command, e₃ up whatever the law's frame.

    For the interface "wrench" a command is the rotor forces (n,), with the law's lead; for "rates" it is the thrust and
    the body rates (4,) whose proportional tracking on board gives the law's moment at this instant.
    """
    setting = (vehicle, plant.limits, plant.interface, plant.rate_loop_gain, usable_lead(law, vehicle, plant))
    if isinstance(law, Law):
        compiled: Callable[..., Any] = _law_command(law, *setting)
        return compiled
    if law.source is not None:
        if plant.interface != "wrench" or not plant.limits:
            raise InputError(
                "plant", f"rotor forces within limits, such as rotors or mujoco, for {law.name}", "another"
            )
        return law.source(vehicle, usable_lead(law, vehicle, plant))
    finish, sign = _finish_command(*setting), 1.0 if law.e3 == "up" else FLIP_PACKED

    def call(t: float, state: Any, rotors: Any, _: Any) -> Any:
        wrench = law.function(t, State.from_packed(state * sign))
        wrench = wrench if law.e3 == "up" else wrench.flipped()
        return finish(np.append(wrench.thrust, wrench.moment), state, rotors)

    return call


def usable_lead(law: Law | Controller, vehicle: Vehicle, plant: Plant) -> float:
    """The lead of `law`, at most what brings a rotor of `vehicle` to its force in one period of `plant`.

    More would make it overshoot between two commands: with a lag of T and a period of h, 1/(1 − e^{−h/T}).
    """
    lag = max(vehicle.rotor_lag, 1e-9)
    return float(min(law.computer.lead, 1 / -np.expm1(-1 / (plant.rate * lag))))


@lru_cache(maxsize=64)
def _law_command(law: Law, vehicle: Vehicle, limits: bool, interface: str, rate_gain: float, lead: float) -> Any:
    t, packed = ca.SX.sym("t"), ca.SX.sym("s", SIZE)
    rotors, external = ca.SX.sym("r", len(vehicle.rotor_spins)), ca.SX.sym("F", 6)
    wrench = upright_wrench(law, t, packed, vehicle, external)
    command = _finish(wrench, packed, rotors, vehicle, limits, interface, rate_gain, lead)
    return as_numpy(ca.Function("command", [t, packed, rotors, external], [ca.cse(ca.densify(command))]))


@lru_cache(maxsize=64)
def _finish_command(vehicle: Vehicle, limits: bool, interface: str, rate_gain: float, lead: float) -> Any:
    wrench, packed = ca.SX.sym("W", 4), ca.SX.sym("s", SIZE)
    rotors = ca.SX.sym("r", len(vehicle.rotor_spins))
    command = _finish(wrench, packed, rotors, vehicle, limits, interface, rate_gain, lead)
    return as_numpy(ca.Function("finish", [wrench, packed, rotors], [ca.densify(command)]))


def _finish(
    wrench: Any, packed: Any, rotors: Any, vehicle: Vehicle, limits: bool, interface: str, rate_gain: float, lead: float
) -> Any:
    """The command for a wrench (4,), e₃ up, in CasADi; NaN for a wrench that is none, which limits would hide."""
    thrust, moment = wrench[0], wrench[1:]
    if interface == "rates":
        omega = State.symbolic(packed).omega
        free = moment - cross(omega, apply(vehicle.I, omega))
        return ca.vertcat(thrust, omega + apply(vehicle.I_inv, free) / rate_gain)
    command = led(rotor_forces(thrust, moment, vehicle, limits), rotors, lead)
    if limits:
        command = ca.fmin(ca.fmax(command, vehicle.rotor_limits[0]), vehicle.rotor_limits[1])
    return ca.if_else(ca.norm_1(wrench) < np.inf, command, np.nan)


def led(wanted: Any, rotors: Any, lead: Any) -> Any:
    """Commands (n,), N, that bring `rotors`, modelled forces (n,), to the `wanted` forces; `lead` as in `Computer`."""
    return rotors + lead * (wanted - rotors)
