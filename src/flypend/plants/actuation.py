"""Actuation between command and motion: the rotors of either engine, and the onboard rate loop."""

from __future__ import annotations

from typing import Any, Protocol

import casadi as ca
import numpy as np

from flypend.building import built
from flypend.compile.numeric import as_numpy
from flypend.errors import InputError
from flypend.geometry import Numbers, Scalar, Vector
from flypend.model import Vehicle
from flypend.model.allocation import allocate
from flypend.model.momenta import moment_for
from flypend.model.state import SIZE
from flypend.plants.equations import EquationsEngine
from flypend.plants.motors import motion_parts
from flypend.plants.mujoco import MujocoEngine, filter_lag, substeps
from flypend.plants.mujoco_world import motors, step_numbers, surroundings
from flypend.plants.plant import Plant
from flypend.plants.schedule import steps_in

OMEGA = slice(15, 18)
NO_SYMBOLS = np.zeros(0)  # of a vehicle with numeric parameters


class Engine(Protocol):
    """Integrator of the motion, in the e₃-up frame."""

    @property
    def packed(self) -> Numbers:
        """The packed state (24,)."""

    @property
    def rotors(self) -> Numbers:
        """The rotor forces (n,), N."""

    def reset(self, packed: Numbers, rotors: Numbers) -> None:
        """Set the packed state (24,) and the rotor forces (n,), N."""

    def step(self, command: Numbers, duration: float, wind: Numbers) -> None:
        """Advance by `duration` (s) under commanded rotor forces (n,) and `wind` (6,): forces on vehicle and bob, N."""


class Mujoco:
    """MuJoCo as an engine, with equal internal time steps; its actuator filters model the rotor lag.

    Parameters
    ----------
    vehicle, plant
        As in `EquationsEngine`.
    """

    def __init__(self, vehicle: Vehicle, plant: Plant) -> None:
        self._vehicle, self._plant, self._lag = vehicle, plant, filter_lag(vehicle)
        self._engine = MujocoEngine(vehicle, lag=self._lag)
        self._motors, self._surroundings = _compile_world(vehicle, motion_parts(plant))
        self._lost = False

    @property
    def packed(self) -> Numbers:
        """The packed state (24,); NaN once a force has been NaN or too large for MuJoCo."""
        return np.full(SIZE, np.nan) if self._lost else self._engine.packed

    @property
    def rotors(self) -> Numbers:
        """The rotor forces (n,), N."""
        return self._engine.rotors

    def reset(self, packed: Numbers, rotors: Numbers) -> None:
        """Set the packed state (24,) and the rotor forces (n,), N."""
        self._engine.reset(packed, rotors)
        self._lost = False

    def step(self, command: Numbers, duration: float, wind: Numbers) -> None:
        """Advance by `duration` (s) in equal time steps under commanded forces (n,) and `wind` (6,), N."""
        steps = substeps(duration, self._vehicle, self._plant)
        self._engine.model.opt.timestep = duration / steps
        numbers = step_numbers(self._vehicle, self._plant, duration / steps)
        for _ in range(steps):
            try:
                self._engine.step(*self._prepare(command, wind, numbers))
            except InputError:
                self._lost = True
                return

    def _prepare(self, command: Numbers, wind: Numbers, numbers: Numbers) -> tuple[Any, ...]:
        """Return controls and outside forces for the next step of MuJoCo."""
        engine, controls = self._engine, command
        if self._motors is not None:
            controls, lags = self._motors(command, engine.rotors, numbers)
            if self._lag > 0:
                engine.respond_within(lags)
        if self._surroundings is None:
            return controls, wind[:3], wind[3:]
        coordinates = engine.coordinates(controls)
        on_vehicle, on_rod, joint = self._surroundings(*coordinates, engine.rotors, controls, wind, numbers)
        return controls, on_vehicle[:3], on_rod, on_vehicle[3:], joint


@built(maxsize=64)
def _compile_world(vehicle: Vehicle, plant: Plant) -> tuple[Any, Any]:
    made = (motors(vehicle, plant), surroundings(vehicle, plant))
    return tuple(None if function is None else as_numpy(function) for function in made)  # type: ignore[return-value]


def make_engine(vehicle: Vehicle, plant: Plant) -> Engine:
    """Create the engine of `plant` for `vehicle`, the true vehicle."""
    if plant.engine == "equations":
        return EquationsEngine(vehicle, plant)
    return Mujoco(vehicle, plant)


class Actuation:
    """Advances an engine under a command with zero-order hold.

    A command is the rotor forces (n,). For the interface "rates" it is collective thrust and body rates (4,), tracked
    by an onboard proportional loop: τ = I k (ω_command − ω) + ω × I ω.

    Parameters
    ----------
    engine : Engine
        Integrates the motion.
    vehicle : Vehicle
        Nominal vehicle of the rate loop.
    plant : Plant
        Source of the interface, the limits, and the rate and gain of the rate loop.
    """

    def __init__(self, engine: Engine, vehicle: Vehicle, plant: Plant) -> None:
        self.engine = engine
        self._rates = plant.interface == "rates"
        self._plant = plant
        if self._rates:
            self._loop = _compile_rate_loop(vehicle, plant.limits, plant.rate_loop_gain)

    def advance(self, command: Numbers, duration: float, wind: Numbers) -> None:
        """Hold `command` for `duration` (s) under `wind` (6,), N."""
        steps = steps_in(duration, self._plant)
        for _ in range(steps):
            forces = self._loop(command, self.engine.packed[OMEGA], NO_SYMBOLS) if self._rates else command
            self.engine.step(forces, duration / steps, wind)


@built(maxsize=32)
def _compile_rate_loop(vehicle: Vehicle, limits: bool, gain: float) -> Any:
    return as_numpy(rate_loop(vehicle, limits, gain))


def rate_loop(
    vehicle: Vehicle, limits: bool, gain: float, symbols: Numbers = None, name: str = "rate_loop"
) -> ca.Function:
    """Rate loop (command (4,), omega (3,), symbols) → rotor forces (n,), N, as a CasADi function.

    `gain` is in 1/s; `limits` says whether the forces are kept within the rotor limits. The parameters of `vehicle` may
    be symbolic, for code that receives them at run time; `symbols` are these. `name` is that of the function.
    """
    command, omega = ca.SX.sym("c", 4), ca.SX.sym("omega", 3)
    moment = moment_for(gain * (command[1:] - omega), omega, vehicle)
    inputs = [command, omega, ca.SX(0, 1) if symbols is None else symbols]
    return ca.Function(name, inputs, [rotor_forces(command[0], moment, vehicle, limits)])


def rotor_forces(thrust: Scalar, moment: Vector, vehicle: Vehicle, limits: bool) -> Numbers:
    """Rotor forces (n,), N, for a wrench, in CasADi: allocated within the limits of `vehicle`, or just unmixed."""
    if limits:
        return allocate(thrust, moment, vehicle)
    return ca.densify(ca.mtimes(vehicle.unmixing(), ca.vertcat(thrust, moment)))
