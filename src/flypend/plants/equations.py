"""The package's own engine: one Runge-Kutta step of vehicle, pendulum and rotors as a compiled function."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.numeric import as_numpy
from flypend.model import State, Vehicle, Wrench
from flypend.model.motion import disturbed_motion
from flypend.model.state import SIZE, project_symbolic

TIMING_SIZE = 4
NONE = np.zeros(0)  # the symbols of a vehicle of numbers


class EquationsEngine:
    """Vehicle and pendulum with rotors that lag, in the frame with e₃ up, advanced by classical Runge-Kutta steps.

    Parameters
    ----------
    vehicle : Vehicle
        The vehicle that flies; its `rotor_lag` is used.
    pivot_offset : (3,)
        Ball joint relative to the centre of mass, body frame, m.
    """

    def __init__(self, vehicle: Vehicle, pivot_offset: tuple[float, ...] = (0.0, 0.0, 0.0)) -> None:
        self._step = _compiled_step(vehicle, tuple(pivot_offset))
        self._lag = vehicle.rotor_lag
        self.packed: Any = np.zeros(SIZE)
        self.rotors: Any = np.zeros(len(vehicle.rotor_spins))

    def reset(self, packed: Any, rotors: Any) -> None:
        """Set the packed state (24,) and the rotor forces (n,), N."""
        self.packed, self.rotors = np.array(packed), np.array(rotors)

    def step(self, command: Any, duration: float, wind: Any) -> None:
        """Advance by `duration` (s) under commanded rotor forces (n,) and `wind` (6,): forces on vehicle and bob, N."""
        timing = step_timing(self._lag, duration)
        self.packed, self.rotors = self._step(self.packed, self.rotors, command, wind, timing, NONE)


@lru_cache(maxsize=64)
def _compiled_step(vehicle: Vehicle, pivot_offset: tuple[float, ...]) -> Callable[..., Any]:
    return as_numpy(rotor_step(vehicle, pivot_offset))


@lru_cache(maxsize=256)
def step_timing(lag: float, duration: float) -> Any:
    """What `rotor_step` must know of its `duration` h (s): h, and e^{−t/T} at 0, h/2 and h for a `lag` of T (s)."""
    decay = np.exp(-duration / (2 * lag)) if lag > 0 else 0.0
    return np.array([duration, float(lag > 0), decay, decay**2])  # without a lag nothing is left from the beginning


def rotor_step(
    vehicle: Any,
    pivot_offset: tuple[float, ...] = (0.0, 0.0, 0.0),
    *,
    symbols: Any = None,
    rotors: int | None = None,
    timing: Any = None,
    project: bool = True,
    name: str = "rotor_step",
) -> ca.Function:
    """One step (state, rotors, command, wind, timing, symbols) → (state, rotors) of `vehicle` as a CasADi function.

    Rotor forces follow the command with the time constant of the vehicle, exactly; the motion is integrated by the
    Runge-Kutta method of order 4 and projected back onto the manifold.

    Parameters
    ----------
    vehicle : Vehicle
        What flies; its numbers may be symbols, for code that takes them at run time.
    pivot_offset : (3,)
        As in `EquationsEngine`.
    symbols : SX (k, 1), optional
        The symbols of such a vehicle.
    rotors : int, optional
        Its number of rotors.
    timing : (4,), optional
        What `step_timing` gives. It becomes a constant of the function, whose input `timing` is then empty.
    project : bool
        Whether the state is projected; a prediction of some steps projects its end only.
    name : str
        Name of the function.
    """
    n = rotors or len(vehicle.rotor_spins)
    packed, forces_before, command = ca.SX.sym("s", SIZE), ca.SX.sym("r", n), ca.SX.sym("u", n)
    wind, given = ca.SX.sym("w", 6), ca.SX.sym("h", TIMING_SIZE if timing is None else 0)
    timing = given if timing is None else ca.SX(ca.DM(timing))
    h = timing[0]
    mixing = vehicle.mixing()

    def rates(s: Any, forces: Any) -> Any:
        wrench = ca.mtimes(mixing, forces)
        motion = disturbed_motion(
            State.symbolic(s),
            Wrench(wrench[0], wrench[1:]),
            vehicle,
            "up",
            force_on_vehicle=wind[:3],
            force_on_bob=wind[3:],
            pivot_offset=np.array(pivot_offset),
        )
        return motion.packed()

    start, middle, end = (_lagging(forces_before, command, timing[i]) for i in (1, 2, 3))
    k_1 = rates(packed, start)
    k_2 = rates(packed + h / 2 * k_1, middle)
    k_3 = rates(packed + h / 2 * k_2, middle)
    k_4 = rates(packed + h * k_3, end)
    result = packed + h / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4)
    if project:
        result = project_symbolic(result)
    outputs = ca.cse([ca.densify(result), ca.densify(end)])
    inputs = [packed, forces_before, command, wind, given, ca.SX(0, 1) if symbols is None else symbols]
    return ca.Function(name, inputs, outputs)


def rotor_lag(n: int) -> ca.Function:
    """The `n` rotors of `rotor_step` alone: (rotors, command, timing) → rotors, as a CasADi function."""
    rotors, command, timing = ca.SX.sym("r", n), ca.SX.sym("u", n), ca.SX.sym("h", TIMING_SIZE)
    return ca.Function("rotor_lag", [rotors, command, timing], [_lagging(rotors, command, timing[3])])


def _lagging(rotors: Any, command: Any, decay: Any) -> Any:
    """Rotor forces that a `command` draws from `rotors`, when `decay` = e^{−t/T} of the difference is left."""
    return command + (rotors - command) * decay
