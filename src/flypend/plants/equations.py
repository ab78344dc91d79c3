"""The built-in engine: one step of vehicle, pendulum and rotors as a compiled function."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.numeric import as_numpy
from flypend.model import State, Vehicle, Wrench
from flypend.model.motion import disturbed_motion
from flypend.model.rod import shared_out
from flypend.model.state import SIZE, project_symbolic
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import TIMING_SIZE, Ramp, held, step_timing

NO_OFFSET = (0.0, 0.0, 0.0)


class EquationsEngine:
    """Vehicle, pendulum and rotors with first-order lag, e₃-up frame.

    Parameters
    ----------
    vehicle : Vehicle
        The true vehicle, including its `rotor_lag`.
    pivot_offset : (3,)
        Position of the ball joint relative to the centre of mass, body frame, m.
    """

    def __init__(self, vehicle: Vehicle, pivot_offset: tuple[float, ...] = NO_OFFSET) -> None:
        self._step = _compiled_step(vehicle, tuple(pivot_offset))
        self._lag = vehicle.rotor_lag
        self.packed: Any = np.zeros(SIZE)
        self.rotors: Any = np.zeros(len(vehicle.rotor_spins))

    def reset(self, packed: Any, rotors: Any) -> None:
        """Set the packed state (24,) and the rotor forces (n,), N."""
        self.packed, self.rotors = np.array(packed), np.array(rotors)

    def step(self, command: Any, duration: float, wind: Any) -> None:
        """Advance by `duration` (s) under commanded rotor forces (n,) and `wind` (6,): forces on vehicle and bob, N."""
        self.packed, self.rotors = self._step(self.packed, self.rotors, command, wind, step_timing(self._lag, duration))


@lru_cache(maxsize=64)
def _compiled_step(vehicle: Vehicle, pivot_offset: tuple[float, ...]) -> Callable[..., Any]:
    return as_numpy(rotor_step(vehicle, pivot_offset))


def rotor_step(
    vehicle: Vehicle, pivot_offset: tuple[float, ...] = NO_OFFSET, *, windy: bool = True, name: str = "rotor_step"
) -> ca.Function:
    """One step (state, rotors, command, wind, timing) → (state, rotors) of `vehicle` as a CasADi function.

    The rotor forces follow the command as an exact first-order lag with the time constant of the vehicle.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle parameters.
    pivot_offset : (3,)
        As in `EquationsEngine`.
    windy : bool
        Whether there is wind; the input `wind` is ignored otherwise.
    name : str
        Name of the function.
    """
    n = len(vehicle.rotor_spins)
    packed, rotors, command = ca.SX.sym("s", SIZE), ca.SX.sym("r", n), ca.SX.sym("u", n)
    wind, timing = ca.SX.sym("w", 6), ca.SX.sym("h", TIMING_SIZE)
    forces, after = held(rotors, command, timing)
    wrench, outside = forces.mixed(vehicle.mixing()), wind if windy else None
    if tuple(pivot_offset) == NO_OFFSET:
        if windy:
            at_pivot, on_bob = shared_out(wind[3:], vehicle)
            outside = ca.vertcat(wind[:3] + at_pivot, on_bob)
        moved = cascade_step(packed, wrench, outside, timing[0], vehicle)
    else:
        moved = runge_kutta_step(packed, wrench, outside, timing[0], vehicle, pivot_offset)
    outputs = ca.cse([ca.densify(moved), ca.densify(after)])
    return ca.Function(name, [packed, rotors, command, wind, timing], outputs)


def runge_kutta_step(
    packed: Any, wrench: Ramp, outside: Any, h: Any, vehicle: Vehicle, pivot_offset: tuple[float, ...]
) -> Any:
    """Return the state (24, 1), e₃ up, after a classical Runge-Kutta step and projection onto the manifold, in CasADi.

    It is for a pivot beside the centre of mass, where rotation and rod depend on each other; arguments as in
    `cascade_step`, and the pivot offset (3,), m.
    """
    wind = ca.SX(6, 1) if outside is None else outside

    def rates(s: Any, acting: Any) -> Any:
        motion = disturbed_motion(
            State.symbolic(s),
            Wrench(acting[0], acting[1:]),
            vehicle,
            "up",
            force_on_vehicle=wind[:3],
            force_on_bob=wind[3:],
            pivot_offset=np.array(pivot_offset),
        )
        return motion.packed()

    k_1 = rates(packed, wrench.start)
    k_2 = rates(packed + h / 2 * k_1, wrench.mean)
    k_3 = rates(packed + h / 2 * k_2, wrench.mean)
    k_4 = rates(packed + h * k_3, wrench.end)
    return project_symbolic(packed + h / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4))
