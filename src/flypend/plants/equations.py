"""The built-in engine: one step of vehicle, pendulum and rotors as a compiled function."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from flypend.building import built
from flypend.compile.llvm.stagewise import single
from flypend.geometry import Numbers, Scalar
from flypend.model import State, Vehicle, Wrench
from flypend.model.air import air_wrench
from flypend.model.joint import friction
from flypend.model.motion import Disturbance, disturbed_motion
from flypend.model.rod import share_out
from flypend.model.state import SIZE, project_symbolic
from flypend.plants import machine
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import Ramp
from flypend.plants.motors import follow, motion_parts, motor_timing, settle_forces, timing_size
from flypend.plants.plant import ROTORS, Plant


class EquationsEngine:
    """Vehicle, pendulum and rotors, e₃-up frame.

    Parameters
    ----------
    vehicle : Vehicle
        The true vehicle, including its `rotor_lag`.
    plant : Plant
        Source of motors, air and ground.
    """

    def __init__(self, vehicle: Vehicle, plant: Plant = ROTORS) -> None:
        self._vehicle, self._moving = vehicle, motion_parts(plant)
        self._lag, self._plant = vehicle.rotor_lag, plant
        self.packed: Any = np.zeros(SIZE)
        self.rotors: Any = np.zeros(len(vehicle.rotor_spins))

    def reset(self, packed: Numbers, rotors: Numbers) -> None:
        """Set the packed state (24,) and the rotor forces (n,), N."""
        self.packed, self.rotors = np.array(packed), np.array(rotors)

    def step(self, command: Numbers, duration: float, wind: Numbers) -> None:
        """Advance by `duration` (s) under commanded rotor forces (n,) and `wind` (6,): forces on vehicle and bob, N."""
        timing = motor_timing(self._lag, self._plant, duration)
        step = _compile_step(self._vehicle, self._moving, bool(np.any(wind)))
        self.packed, self.rotors = step(self.packed, self.rotors, command, wind, timing)


@built(maxsize=64)
def _compile_step(vehicle: Vehicle, plant: Plant, windy: bool) -> Callable[..., Any]:
    return single(rotor_step(vehicle, plant, windy=windy))


def rotor_step(
    vehicle: Vehicle, plant: Plant = ROTORS, *, windy: bool = True, any_machine: bool = False, name: str = "rotor_step"
) -> ca.Function:
    """One step (state, rotors, command, wind, timing) → (state, rotors) of `vehicle` as a CasADi function.

    The rotor forces follow the command as an exact first-order lag with the time constant of the vehicle; for `timing`
    see `motor_timing`.

    Parameters
    ----------
    vehicle, plant
        As in `EquationsEngine`.
    windy : bool
        Whether there is wind; the input `wind` is ignored otherwise.
    any_machine : bool
        Whether `timing` ends with the numbers of the machine (see `machine_numbers`), in place of those of `vehicle`.
    name : str
        Name of the function.
    """
    n = len(vehicle.rotor_spins)
    packed, rotors, command = ca.SX.sym("s", SIZE), ca.SX.sym("r", n), ca.SX.sym("u", n)
    wind, timing = ca.SX.sym("w", 6), ca.SX.sym("h", timing_size(plant))
    own, motors = ca.SX.sym("machine", machine.SIZE * any_machine), ca.SX.sym("motors", (n + 1) * any_machine)
    flown: Any = machine.Machine(vehicle, *ca.vertsplit(own)) if any_machine else vehicle
    strength, sag = (motors[:n], motors[n]) if any_machine else (plant.strength, plant.sag)
    settled = settle_forces(command, vehicle.rotor_limits[1], strength, sag)
    outputs = step_state(packed, rotors, settled, wind if windy else None, timing, flown, plant)
    return ca.Function(name, [packed, rotors, command, wind, ca.vertcat(timing, own, motors)], outputs)


def step_state(
    packed: Numbers, rotors: Numbers, settled: Numbers, wind: Numbers, timing: Numbers, vehicle: Vehicle, plant: Plant
) -> list[Numbers]:
    """Return state and rotor forces after the step of `rotor_step`; without wind, `wind` is None.

    `settled` are the forces (n,), N, to which the rotors tend. The numbers of `vehicle` may be symbolic.
    """
    forces, after = follow(rotors, settled, timing)
    outside = wind
    if plant.in_air(vehicle) or not vehicle.free_joint:
        moved = runge_kutta_step(packed, forces, outside, timing[0], vehicle, plant)
    else:
        if wind is not None:
            at_pivot, on_bob = share_out(wind[3:], vehicle)
            outside = ca.vertcat(wind[:3] + at_pivot, on_bob)
        moved = cascade_step(packed, forces.mix(vehicle.mixing()), outside, timing[0], vehicle)
    return ca.cse([ca.densify(moved), ca.densify(after)])  # type: ignore[no-any-return]


def struck(vehicle: Vehicle) -> ca.Function:
    """Return the CasADi function (state (24,), impulses (6,) on vehicle and bob, N s) → state, e₃ up.

    Accelerations are affine in external forces, so an impulse makes velocities jump by their derivative times it.
    """
    packed, forces, impulses = ca.SX.sym("s", SIZE), ca.SX.sym("F", 6), ca.SX.sym("J", 6)
    state, still = State.symbolic(packed), Wrench(ca.SX(0), ca.SX.zeros(3))
    motion = disturbed_motion(state, still, vehicle, "up", Disturbance(forces[:3], forces[3:], vehicle.pivot_offset))
    jump = ca.mtimes(ca.jacobian(motion.packed(), forces), impulses)
    return ca.Function("strike", [packed, impulses], [ca.cse(ca.densify(packed + jump))])


def runge_kutta_step(
    packed: Numbers, forces: Ramp, outside: Numbers, h: Scalar, vehicle: Vehicle, plant: Plant = ROTORS
) -> Numbers:
    """Return the state (24, 1), e₃ up, after a classical Runge-Kutta step and projection onto the manifold, in CasADi.

    It is for whatever the cascade does not cover: a pivot beside the centre of mass or with friction, where rotation
    and rod depend on each other, a rod that spins, and air, whose forces depend on all velocities.

    Parameters
    ----------
    packed, outside, h
        As in `cascade_step`; `outside` acts on vehicle and rod, at their centres of mass.
    forces : Ramp of SX (n, 1)
        Rotor forces over the step, N.
    vehicle, plant
        As in `EquationsEngine`.
    """
    wind = ca.SX(6, 1) if outside is None else outside
    wrench = forces.mix(vehicle.mixing())

    def rates(s: Numbers, rotors: Any, acting: Numbers) -> Numbers:
        return rates_under(s, rotors, acting, wind, vehicle, plant)

    k_1 = rates(packed, forces.start, wrench.start)
    k_2 = rates(packed + h / 2 * k_1, forces.mean, wrench.mean)
    k_3 = rates(packed + h / 2 * k_2, forces.mean, wrench.mean)
    k_4 = rates(packed + h * k_3, forces.end, wrench.end)
    return project_symbolic(packed + h / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4))


def rates_under(
    packed: Numbers, rotors: Numbers, wrench: Numbers, wind: Numbers, vehicle: Vehicle, plant: Plant
) -> Numbers:
    """Return the rates (24, 1) of a state under rotor forces (n, 1) and `wind` (6, 1), N, in CasADi; e₃ up.

    `wrench` (4, 1) is what the forces amount to. See `runge_kutta_step`.
    """
    state, on_vehicle, moment = State.symbolic(packed), wind[:3], wrench[1:]
    if plant.in_air(vehicle):
        force, turning = air_wrench(state, rotors, vehicle, plant.effects(vehicle), plant.ground)
        on_vehicle, moment = on_vehicle + ca.mtimes(state.R, force), moment + turning
    torque = friction(state, vehicle) if vehicle.rubs else None
    spin = vehicle.rod_spin * vehicle.rod_spin_inertia if vehicle.rod_spin else None
    disturbance = Disturbance(on_vehicle, wind[3:], vehicle.pivot_offset, joint_torque=torque, spin=spin)
    return disturbed_motion(state, Wrench(wrench[0], moment), vehicle, "up", disturbance).packed()
