"""The plant with symbols for what a log tells: one step of the motion and its readings, with their derivatives.

Errors of the estimate are local: (δx, δẋ, φ, δω, δy, δẏ) with R exp(φ̂) for the attitude, then those of the gusts, the
forces on vehicle and bob that the model lacks.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import accumulate, pairwise
from types import SimpleNamespace
from typing import Any

import casadi as ca
import numpy as np

from flypend.compile.numeric import as_numpy
from flypend.geometry import E3, Numbers, Vector, hat, vee
from flypend.model import State, Vehicle
from flypend.model.air import AIR, Air
from flypend.model.altered import Altered
from flypend.model.dynamics import swing_around
from flypend.model.state import SIZE
from flypend.plants.cascade import rotation_by
from flypend.plants.equations import rates_under, runge_kutta_step
from flypend.plants.lag import Ramp
from flypend.plants.measurement import displace
from flypend.plants.plant import Plant

ERROR, GUST = 18, 6  # numbers of a local error of the state, and of the gusts
LOCAL = ERROR + GUST
ZERO = ca.SX.zeros(LOCAL)
# What moves the machine, and what is read of it, in the order of the inputs `moving` and `reading`.
MOVING = {
    "rod_length": 1, "bob_mass": 1, "inertia": 3, "drag_ratio": 1, "pivot_offset": 3, "rotor_drag": 1, "inflow": 1,
    "wind": 2,
}  # fmt: skip
READING = {"latency": 1, "gyro_bias": 3, "force_bias": 3, "misalignment": 3}
ROTOR_AIR = ("rotor_drag", "inflow")  # of `MOVING`, the coefficients of `Air`
CHANNELS = {"position": 3, "attitude": 3, "gyro": 3, "force": 3, "rod": 3}


def sizes(table: dict[str, int]) -> int:
    """Return how many numbers a table of names and lengths has."""
    return sum(table.values())


def places(table: dict[str, int]) -> dict[str, slice]:
    """Return where each name of a table stands."""
    ends = [0, *accumulate(table.values())]
    return {name: slice(a, b) for name, (a, b) in zip(table, pairwise(ends), strict=True)}


def split(table: dict[str, int], values: Any) -> dict[str, Any]:
    """Return `values`, an array or an expression, by the names of `table`."""
    return {name: values[place] for name, place in places(table).items()}


def machine(vehicle: Vehicle, moving: Numbers) -> Any:
    """Return `vehicle` with the symbols `moving` in place of its numbers, without friction and spin of the rod.

    The rod keeps its shape, and so the share of its mass in the equivalent point bob; see `Vehicle`.
    """
    v = split(MOVING, moving)
    share = vehicle.m / vehicle.bob_mass
    principal = ca.diag(v["inertia"]) + ca.DM(vehicle.inertia - np.diag(np.diag(vehicle.inertia)))
    return Altered(
        vehicle, bob_mass=v["bob_mass"], M=vehicle.mass + (1 - share) * v["bob_mass"], m=share * v["bob_mass"],
        l=v["rod_length"] / share, I=principal, I_inv=ca.inv_minor(principal), pivot_offset=v["pivot_offset"],
        drag_ratio=v["drag_ratio"], wind=v["wind"], rubs=False, rod_spin=0.0,
        air=SimpleNamespace(**vars(vehicle.air or Air()) | {name: v[name] for name in ROTOR_AIR}, active=lambda: AIR),
    )  # fmt: skip


def moves(vehicle: Vehicle) -> Callable[..., Any]:
    """Return a correction, the step of the motion after it, and the derivatives of its local error's rate, on numbers.

    (state (24,), gusts (6,), correction (24,) of both, mean and change of the rotor forces (n,), duration, what is left
    of a gust, `moving`) → state (24,) and gusts (6,) after, and by errors, `moving` and mean forces (18 (24 + · + n),),
    a matrix by columns.
    """
    n, plant = len(vehicle.rotor_spins), Plant(air=AIR)
    before, gusts, mean, change = (ca.SX.sym(a, k) for a, k in (("s", SIZE), ("g", GUST), ("f", n), ("c", n)))
    h, decay, moving, error = ca.SX.sym("h"), ca.SX.sym("d"), ca.SX.sym("m", sizes(MOVING)), ca.SX.sym("e", LOCAL)
    correction, made = ca.SX.sym("k", LOCAL), machine(vehicle, moving)
    packed, felt = correct(before, correction[:ERROR]), gusts + correction[ERROR:]
    steady = felt + ca.vertcat(made.wind, ca.SX(4, 1))
    after = runge_kutta_step(packed, Ramp(mean, change), steady, h, made, plant)

    # Where an error goes in a short time h: to first order in h, by d/dh.
    start, origin = ca.SX.sym("p", SIZE), ca.SX.sym("o", SIZE)
    at = shift(start, error[:ERROR])
    later = at + h * rates_under(at, mean, ca.mtimes(made.mixing(), mean), steady + error[ERROR:], made, plant)
    by = ca.substitute(ca.jacobian(local_error(origin, later), ca.vertcat(error, moving, mean)), error, ZERO)
    columns = ca.vec(ca.densify(ca.substitute(by, origin, ca.substitute(later, error, ZERO))))
    rate = ca.substitute(ca.substitute(ca.jacobian(columns, h), h, 0), start, packed)
    outputs = ca.cse(list(map(ca.densify, (after, decay * felt, rate))))
    inputs = [before, gusts, correction, mean, change, h, decay, moving]
    return as_numpy(ca.Function("moves", inputs, outputs))


def reads(vehicle: Vehicle, marker: Vector) -> Callable[..., Any]:
    """Return what is read of a state with its derivatives, on numbers.

    (state (24,), gusts (6,), rotor forces (n,), age of the pose, s, `moving`, `reading`) → (readings (21,): position,
    attitude by rows, gyro, force, rod; and, of the 15 local numbers of `CHANNELS`, by errors, `moving`, forces and
    `reading` (15 (24 + · + n + ·),), a matrix by columns). `marker` is the tracked point from the pivot, body frame, m.
    """
    n = len(vehicle.rotor_spins)
    packed, gusts, forces, age = ca.SX.sym("s", SIZE), ca.SX.sym("g", GUST), ca.SX.sym("f", n), ca.SX.sym("a")
    moving, reading, error = ca.SX.sym("m", sizes(MOVING)), ca.SX.sym("r", sizes(READING)), ca.SX.sym("e", LOCAL)
    made, parts = machine(vehicle, moving), split(READING, reading)
    s = State.symbolic(shift(packed, error[:ERROR]))
    wind = gusts + error[ERROR:] + ca.vertcat(made.wind, ca.SX(4, 1))
    wrench = ca.mtimes(made.mixing(), forces)
    rates = State.symbolic(rates_under(s.packed(), forces, wrench, wind, made, Plant(air=AIR)))
    since = age + parts["latency"]
    R = s.R @ rotation_by(-since * s.omega)
    position = s.x - since * s.x_dot + since**2 / 2 * rates.x_dot + R @ ca.DM(marker)
    seen = R @ rotation_by(parts["misalignment"])
    felt = specific_force(s, rates, made) + parts["force_bias"]
    rod = s.y - since * s.y_dot + since**2 / 2 * rates.y_dot
    gyro = s.omega + parts["gyro_bias"]
    at = ca.SX.sym("at", 3, 3)
    local = ca.vertcat(position, vee(at.T @ seen), gyro, felt, rod)
    now = ca.substitute([ca.vertcat(position, ca.vec(seen.T), gyro, felt, rod), seen], [error], [ZERO])
    by = ca.jacobian(local, ca.vertcat(error, moving, forces, reading))
    columns = ca.vec(ca.densify(ca.substitute(ca.substitute(by, error, ZERO), ca.vec(at), ca.vec(now[1]))))
    inputs = [packed, gusts, forces, age, moving, reading]
    return as_numpy(ca.Function("reads", inputs, ca.cse(list(map(ca.densify, (now[0], columns))))))


def specific_force(state: State, rates: State, vehicle: Any) -> Any:
    """Return what an accelerometer at the centre of mass feels (3,), body frame, m/s², in CasADi; e₃ up.

    The centre of mass is at x − R o, with o the `pivot_offset`: Rᵀ (ẍ + g e₃) − ω̇ × o − ω × (ω × o).
    """
    swing = swing_around(vehicle.pivot_offset, state.omega, rates.omega)
    return ca.mtimes(state.R.T, rates.x_dot + vehicle.g * E3) - swing


def correct(packed: Numbers, error: Numbers) -> Numbers:
    """Return the packed state (24, 1) on the manifold that a local `error` (18, 1) makes of `packed`."""
    return displace(State.symbolic(packed), error).packed()


def shift(packed: Numbers, error: Numbers) -> Numbers:
    """Return the packed state (24, 1) that differs from `packed` by a local `error` (18, 1), to first order."""
    s = State.symbolic(packed)
    return State(
        x=s.x + error[0:3], x_dot=s.x_dot + error[3:6], R=s.R @ (ca.SX.eye(3) + hat(error[6:9])),
        omega=s.omega + error[9:12], y=s.y + error[12:15], y_dot=s.y_dot + error[15:18],
    ).packed()  # fmt: skip


def local_error(at: Numbers, packed: Numbers) -> Numbers:
    """Return the local error (18, 1) of `packed` from the packed state `at`, to first order."""
    a, s = State.symbolic(at), State.symbolic(packed)
    return ca.vertcat(
        s.x - a.x, s.x_dot - a.x_dot, vee(a.R.T @ s.R), s.omega - a.omega, s.y - a.y, s.y_dot - a.y_dot
    )  # fmt: skip
