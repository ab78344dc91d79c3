"""The flight computer of a sampled flight: predict, observe, evaluate the law, allocate, lead."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.board.observer import ForceObserver
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.geometry import apply, cross
from flypend.laws import BoundLaw, Controller
from flypend.laws.closed_loop import upright_wrench
from flypend.model import State, Vehicle
from flypend.model.state import FLIP_PACKED, SIZE
from flypend.plants.actuation import Actuation, rotor_forces
from flypend.plants.equations import EquationsEngine
from flypend.plants.plant import Plant
from flypend.plants.schedule import Segment, ahead, within_period

# Longest step of the prediction, s. It is shorter than the dynamics that it predicts and costs a tenth of the plant's.
TWIN_STEP = 1e-2


class FlightComputer:
    """Runs `law` for the `vehicle` that it believes in, once per control period of `plant`.

    It keeps what a flight computer keeps: the modelled rotor forces, the commands under way, the observer's state.
    """

    def __init__(self, law: BoundLaw | Controller, vehicle: Vehicle, plant: Plant) -> None:
        self._plant = plant
        self._latency = law.computer.latency
        self._period = 1 / plant.rate
        self._command = command_source(law, vehicle, plant)
        self._twin = Actuation(EquationsEngine(vehicle), vehicle, plant, TWIN_STEP)
        self._observer = ForceObserver(vehicle, law.computer)
        self._forces: Any = np.zeros(6)
        self._rotors: Any = np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0])
        self._ahead = ahead(self._latency, self._period)
        self._within = within_period(self._latency, self._period)
        self._commands = Commands(idle_command(vehicle, plant))

    def command(self, t: float, measured: Any) -> Any:
        """The command for the measurement `measured` (24,), e₃ up, taken at time `t` (s)."""
        self._forces = self._observer.update(measured, self._rotors, self._period)
        state, rotors = self._predict(measured)
        command: Any = self._command(t + self._latency, state, rotors, self._forces)
        self._commands.add(command)
        return command

    def _predict(self, measured: Any) -> tuple[Any, Any]:
        """State and rotor forces when the command after `measured` is planned to act, over the commands under way."""
        return self._imagine(measured, self._ahead, newest=1)

    def tick(self, measured: Any) -> None:
        """Move the model of the rotors over one period, over the commands that are planned to act in it."""
        _, self._rotors = self._imagine(measured, self._within, newest=0)

    def _imagine(self, measured: Any, segments: Sequence[Segment], newest: int) -> tuple[Any, Any]:
        """State and rotor forces after `segments` from `measured`; the last command computed has age `newest`."""
        self._twin.engine.reset(measured, self._rotors)
        for age, duration in segments:
            self._twin.advance(self._commands[age - newest], duration, self._forces)
        return self._twin.engine.packed, self._twin.engine.rotors


class Commands:
    """The commands of a flight by age, 0 for the last one; `idle` before the first."""

    def __init__(self, idle: Any) -> None:
        self._idle = idle
        self._given: list[Any] = []

    def add(self, command: Any) -> None:
        """Take in the command of this tick."""
        self._given.append(command)

    def __getitem__(self, age: int) -> Any:
        """The command given `age` ticks before the last."""
        return self._given[-1 - age] if age < len(self._given) else self._idle


def idle_command(vehicle: Vehicle, plant: Plant) -> Any:
    """The command before the first one arrives: rotors at their least force, or no thrust and no rates."""
    return np.zeros(4) if plant.interface == "rates" else np.full(len(vehicle.rotor_spins), vehicle.rotor_limits[0])


def command_source(law: BoundLaw | Controller, vehicle: Vehicle, plant: Plant) -> Callable[..., Any]:
    """(t, state (24,), modelled rotor forces (n,), external forces (6,)) → command, e₃ up whatever the law's frame.

    For the interface "wrench" a command is the rotor forces (n,), with the law's lead; for "rates" it is the thrust and
    the body rates (4,) whose proportional tracking on board gives the law's moment at this instant.
    """
    setting = (vehicle, plant.limits, plant.interface, plant.rate_loop_gain, usable_lead(law, vehicle, plant))
    if isinstance(law, BoundLaw):
        return _compiled_command(law, *setting)
    if law.source is not None:
        if plant.interface != "wrench" or not plant.limits:
            expected = f"rotor forces within limits, such as rotors or mujoco, for {law.name}"
            raise InputError("plant", expected, "another")
        return law.source(vehicle, usable_lead(law, vehicle, plant))
    finish, sign = _finish_command(*setting), 1.0 if law.e3 == "up" else FLIP_PACKED

    def call(t: float, state: Any, rotors: Any, _: Any) -> Any:
        wrench = law.function(t, State.from_packed(state * sign))
        wrench = wrench if law.e3 == "up" else wrench.flipped()
        return finish(np.append(wrench.thrust, wrench.moment), state, rotors)

    return call


def usable_lead(law: BoundLaw | Controller, vehicle: Vehicle, plant: Plant) -> float:
    """The lead of `law`, at most what brings a rotor of `vehicle` to its force in one period of `plant`.

    More would make it overshoot between two commands: with a lag of T and a period of h, 1/(1 − e^{−h/T}).
    """
    lag = max(vehicle.rotor_lag, 1e-9)
    return float(min(law.computer.lead, 1 / -np.expm1(-1 / (plant.rate * lag))))


@lru_cache(maxsize=64)
def _compiled_command(law: BoundLaw, *setting: Any) -> Callable[..., Any]:
    compiled = as_numpy(law_command(law, *setting))
    none = np.zeros(0)
    return lambda t, state, rotors, forces: compiled(t, state, rotors, forces, none)


def law_command(
    law: BoundLaw,
    vehicle: Vehicle,
    limits: bool,
    interface: str,
    rate_gain: float,
    lead: float,
    parameters: Sequence[str] = (),
) -> ca.Function:
    """(t, state (24,), modelled rotor forces (n,), external forces (6,), p) → command, e₃ up, as a CasADi function.

    `vehicle` is the one that the law believes in; `limits`, `interface` and `rate_gain` are those of the plant, `lead`
    is `usable_lead`, and p holds the gains called `parameters`.
    """
    t, packed, p = ca.SX.sym("t"), ca.SX.sym("s", SIZE), ca.SX.sym("p", len(parameters))
    rotors, external = ca.SX.sym("r", len(vehicle.rotor_spins)), ca.SX.sym("F", 6)
    gains = {name: p[i] for i, name in enumerate(parameters)}
    wrench = upright_wrench(law, t, packed, vehicle, external, gains)
    command = _finish(wrench, packed, rotors, vehicle, limits, interface, rate_gain, lead)
    return ca.Function("command", [t, packed, rotors, external, p], [ca.cse(ca.densify(command))])


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
