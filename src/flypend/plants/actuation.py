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
from flypend.plants.equations import EquationsEngine
from flypend.plants.plant import Plant

PLANT_STEP = 1e-3  # s, of the Runge-Kutta method: a rotor lags 20 times as long
MUJOCO_STEP = PLANT_STEP / 2  # s, the longest
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


class LaggedMujoco:
    """MuJoCo with the same rotors in front: over each of its steps it feels the mean force of a lagging rotor.

    Parameters
    ----------
    vehicle, pivot_offset
        As in `EquationsEngine`.
    """

    def __init__(self, vehicle: Vehicle, pivot_offset: tuple[float, ...]) -> None:
        from flypend.plants.mujoco import MujocoEngine

        self._engine = MujocoEngine(vehicle, timestep=MUJOCO_STEP, pivot_offset=pivot_offset)
        self._lag = vehicle.rotor_lag
        self._lost = False
        self.rotors: Any = np.zeros(len(vehicle.rotor_spins))

    @property
    def packed(self) -> Any:
        """The packed state (24,); NaN once a force was none, or too large for MuJoCo."""
        return np.full(SIZE, np.nan) if self._lost else self._engine.packed

    def reset(self, packed: Any, rotors: Any) -> None:
        """Set the packed state (24,) and the rotor forces (n,), N."""
        self._engine.reset(packed)
        self._lost = False
        self.rotors = np.array(rotors)

    def step(self, command: Any, duration: float, wind: Any) -> None:
        """Advance by `duration` (s) in equal time steps under commanded forces (n,) and `wind` (6,)."""
        steps = max(1, int(np.ceil(duration / MUJOCO_STEP - 1e-9)))
        timestep = duration / steps
        self._engine.model.opt.timestep = timestep
        decay = np.exp(-timestep / self._lag) if self._lag > 0 else 0.0
        mean = self._lag / timestep * (1 - decay)
        for _ in range(steps):
            behind = self.rotors - command
            try:
                self._engine.step(command + mean * behind, force_on_vehicle=wind[:3], force_on_bob=wind[3:])
            except InputError:
                self._lost = True
                return
            self.rotors = command + decay * behind


def make_engine(vehicle: Vehicle, plant: Plant) -> Engine:
    """The engine that `plant` names, for the vehicle that truly flies."""
    if plant.engine == "equations":
        return EquationsEngine(vehicle, plant.pivot_offset)
    return LaggedMujoco(vehicle, plant.pivot_offset)


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
            forces = self._loop(command, self.engine.packed[OMEGA]) if self._rates else command
            self.engine.step(forces, duration / steps, wind)


def steps_in(duration: float, plant: Plant, longest: float | None = None) -> int:
    """Number of equal steps of an engine in `duration` (s), none longer than `longest` (s; default that of `plant`)."""
    longest = longest or (1 / plant.rate_loop_rate if plant.interface == "rates" else PLANT_STEP)
    return max(1, int(np.ceil(duration / longest - 1e-9)))


@lru_cache(maxsize=32)
def _compiled_rate_loop(vehicle: Vehicle, limits: bool, gain: float) -> Any:
    return as_numpy(rate_loop(vehicle, limits, gain))


def rate_loop(vehicle: Vehicle, limits: bool, gain: float) -> ca.Function:
    """The loop (command (4,), omega (3,)) → rotor forces of `vehicle`, with `gain` (1/s), within `limits` if set."""
    command, omega = ca.SX.sym("c", 4), ca.SX.sym("omega", 3)
    gyroscopic = cross(omega, apply(vehicle.I, omega))
    moment = apply(vehicle.I, gain * (command[1:] - omega)) + gyroscopic
    return ca.Function("rate_loop", [command, omega], [rotor_forces(command[0], moment, vehicle, limits)])


def rotor_forces(thrust: Any, moment: Any, vehicle: Vehicle, limits: bool) -> Any:
    """Rotor forces (n,) for a wrench in CasADi: allocated within the limits of `vehicle`, or simply unmixed."""
    if limits:
        return allocate(thrust, moment, vehicle)
    return ca.densify(ca.mtimes(vehicle.unmixing(), ca.vertcat(thrust, moment)))
