"""What acts on MuJoCo's vehicle besides motors and gravity, and what its motors are commanded, before every step.

MuJoCo holds external forces during a step. They are those of the state half a step ahead, extrapolated with MuJoCo's
own accelerations, which makes them of second order.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from flypend.geometry import Numbers
from flypend.model import Vehicle
from flypend.model.air import air_wrench
from flypend.model.joint import friction
from flypend.plants.cascade import rotation_by
from flypend.plants.motors import settle_forces
from flypend.plants.mujoco import POSITIONS, VELOCITIES, filter_lag, rotation_of, state_of
from flypend.plants.plant import Plant

STEP_NUMBERS = 5


def step_numbers(vehicle: Vehicle, plant: Plant, h: float) -> Numbers:
    """Return the numbers (5,) of a step of `h` seconds for the functions below.

    h; the time constants of falling and rising forces, s; and the shares of a deviation that they leave after h/2.
    """
    falling = filter_lag(vehicle)
    lags = np.array([falling, plant.spin_up * falling])
    return np.array([h, *lags, *(np.exp(-h / (2 * lags)) if falling > 0 else (0.0, 0.0))])


def motors(vehicle: Vehicle, plant: Plant) -> ca.Function | None:
    """Return (commanded forces (n,), rotors (n,), `step_numbers`) → MuJoCo's controls (n,) and time constants (n,), s.

    None if the controls are the command, and the time constants those of the model.
    """
    n = len(vehicle.rotor_spins)
    command, rotors, numbers = ca.SX.sym("u", n), ca.SX.sym("r", n), ca.SX.sym("h", STEP_NUMBERS)
    target = settle_forces(command, vehicle.rotor_limits[1], plant.strength, plant.sag)
    if target is command and plant.spin_up == 1.0:
        return None
    return ca.Function(
        "motors", [command, rotors, numbers], [target, ca.if_else(rotors < target, numbers[2], numbers[1])]
    )


def surroundings(vehicle: Vehicle, plant: Plant) -> ca.Function | None:
    """Return (qpos, qvel, qacc, rotors, controls, wind, `step_numbers`) → outside forces, or None for wind alone.

    Outside forces are force (N) and torque (N m) on the vehicle (6,), and the force on the rod (3,), world frame, and
    the torque of the joint on the rod (3,), in the frame of the rod, N m.
    """
    if not (plant.in_air(vehicle) or vehicle.rubs):
        return None
    n = len(vehicle.rotor_spins)
    qpos, qvel, qacc = (ca.SX.sym(*pair) for pair in (("q", POSITIONS), ("v", VELOCITIES), ("a", VELOCITIES)))
    rotors, controls, wind = (ca.SX.sym(*pair) for pair in (("r", n), ("u", n), ("w", 6)))
    numbers = ca.SX.sym("h", STEP_NUMBERS)
    half, moved = numbers[0] / 2, numbers[0] / 2 * (qvel + numbers[0] / 4 * qacc)
    R, relative = (ca.mtimes(rotation_of(qpos[a : a + 4]), rotation_by(moved[b : b + 3])) for a, b in ((3, 3), (7, 6)))
    state = state_of(qpos[:3] + moved[:3], R, relative, qvel + half * qacc)
    forces = controls + ca.if_else(rotors < controls, numbers[4], numbers[3]) * (rotors - controls)
    force, moment, joint = ca.SX(3, 1), ca.SX(3, 1), ca.SX(3, 1)
    if plant.in_air(vehicle):
        force, moment = air_wrench(state, forces, vehicle, plant.effects(vehicle), plant.ground)
    if vehicle.rubs:
        joint = ca.mtimes(ca.mtimes(R, relative).T, friction(state, vehicle))
    on_vehicle = ca.vertcat(wind[:3] + ca.mtimes(R, force), ca.mtimes(R, moment))
    outside = [on_vehicle, wind[3:], ca.vertcat(joint[:2], 0)]  # its third component is zero but for roundoff
    inputs = [qpos, qvel, qacc, rotors, controls, wind, numbers]
    return ca.Function("surroundings", inputs, ca.cse([ca.densify(part) for part in outside]))
