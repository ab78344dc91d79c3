"""Between command and motion: rotors in front of either engine, and the rate loop on board."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Protocol

import casadi as ca
import numpy as np

from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.geometry import apply, cross
from flypend.model import Vehicle
from flypend.model.allocation import allocate
from flypend.model.state import SIZE
from flypend.plants.equations import NONE, EquationsEngine
from flypend.plants.plant import Plant
from flypend.plants.schedule import steps_in

OMEGA = slice(15, 18)


class Engine(Protocol):
    """What integrates the motion, in the frame with e₃ up."""

    @property
    def packed(self) -> Any:
        """The packed state (24,)."""

    @property
    def rotors(self) -> Any:
        """The forces of the rotors (n,), N."""

    def reset(self, packed: Any, rotors: Any) -> None:
        """Set the packed state (24,) and the rotor forces (n,), N."""

    def step(self, command: Any, duration: float, wind: Any) -> None:
        """Advance by `duration` (s) under commanded rotor forces (n,) and `wind` (6,), N."""


class Mujoco:
    """MuJoCo in equal steps of its own, the rotors being its filters.

    Parameters
    ----------
    vehicle, pivot_offset
        As in `EquationsEngine`.
    """

    def __init__(self, vehicle: Vehicle, pivot_offset: tuple[float, ...]) -> None:
        from flypend.plants.mujoco import MujocoEngine

        self._engine = MujocoEngine(vehicle, pivot_offset=pivot_offset, lag=vehicle.rotor_lag)
        self._lost = False

    @property
    def packed(self) -> Any:
        """The packed state (24,); NaN once a force was none, or too large for MuJoCo."""
        return np.full(SIZE, np.nan) if self._lost else self._engine.packed

    @property
    def rotors(self) -> Any:
        """The forces of the rotors (n,), N."""
        return self._engine.rotors

    def reset(self, packed: Any, rotors: Any) -> None:
        """Set the packed state (24,) and the rotor forces (n,), N."""
        self._engine.reset(packed, rotors)
        self._lost = False

    def step(self, command: Any, duration: float, wind: Any) -> None:
        """Advance by `duration` (s) in equal time steps under commanded forces (n,) and `wind` (6,)."""
        from flypend.plants.mujoco import substeps

        steps = substeps(duration)
        self._engine.model.opt.timestep = duration / steps
        for _ in range(steps):
            try:
                self._engine.step(command, force_on_vehicle=wind[:3], force_on_bob=wind[3:])
            except InputError:
                self._lost = True
                return


def make_engine(vehicle: Vehicle, plant: Plant) -> Engine:
    """The engine that `plant` names, for the vehicle that truly flies."""
    if plant.engine == "equations":
        return EquationsEngine(vehicle, plant.pivot_offset)
    return Mujoco(vehicle, plant.pivot_offset)


class Actuation:
    """Turns a command, held over a while, into motion of an engine.

    A command is the rotor forces (n,), or for the interface "rates" the collective thrust and the body rates (4,),
    which a proportional loop on board tracks: τ = I k (ω_command − ω) + ω × I ω.

    Parameters
    ----------
    engine : Engine
        What moves.
    vehicle : Vehicle
        The vehicle that the rate loop believes in.
    plant : Plant
        Gives interface, limits, rate and gain of the loop.
    step : float, optional
        Longest step of the engine, s; default that of the plant, or of its rate loop.
    """

    def __init__(self, engine: Engine, vehicle: Vehicle, plant: Plant, step: float | None = None) -> None:
        self.engine = engine
        self._rates = plant.interface == "rates"
        self._longest = step
        self._plant = plant
        if self._rates:
            self._loop = _compiled_rate_loop(vehicle, plant.limits, plant.rate_loop_gain)

    def advance(self, command: Any, duration: float, wind: Any) -> None:
        """Hold `command` for `duration` seconds under `wind` (6,)."""
        steps = steps_in(duration, self._plant, self._longest)
        for _ in range(steps):
            forces = self._loop(command, self.engine.packed[OMEGA], NONE) if self._rates else command
            self.engine.step(forces, duration / steps, wind)


@lru_cache(maxsize=32)
def _compiled_rate_loop(vehicle: Vehicle, limits: bool, gain: float) -> Any:
    return as_numpy(rate_loop(vehicle, limits, gain))


def rate_loop(vehicle: Any, limits: bool, gain: float, symbols: Any = None, name: str = "rate_loop") -> ca.Function:
    """The loop (command (4,), omega (3,), symbols) → rotor forces, with `gain` (1/s), within `limits` if set.

    `vehicle` and `symbols` as in `rotor_step`.
    """
    command, omega = ca.SX.sym("c", 4), ca.SX.sym("omega", 3)
    gyroscopic = cross(omega, apply(vehicle.I, omega))
    moment = apply(vehicle.I, gain * (command[1:] - omega)) + gyroscopic
    inputs = [command, omega, ca.SX(0, 1) if symbols is None else symbols]
    return ca.Function(name, inputs, [rotor_forces(command[0], moment, vehicle, limits)])


def rotor_forces(thrust: Any, moment: Any, vehicle: Any, limits: bool) -> Any:
    """Rotor forces (n,) for a wrench in CasADi: allocated within the limits of `vehicle`, or simply unmixed."""
    if limits:
        return allocate(thrust, moment, vehicle)
    return ca.densify(ca.mtimes(vehicle.unmixing(), ca.vertcat(thrust, moment)))
