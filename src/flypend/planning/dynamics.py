"""A vehicle in its own units, coordinates of its states, and one stage of a plan: its step and derivatives.

The units are the rod length l, √(l/g) and the mass M + m. Rotor forces are in units of the hover force (M+m) g/n. So
l = g = M + m = 1, hover takes forces of 1, and one compiled solver serves all vehicles of n rotors.

Plans are changed and linearised by local coordinates δ ∈ R^(16+n) of states and rotor forces. About a state
(x, ẋ, R, ω, y, H) with H = y × ẏ, rotor forces r, and b an orthonormal basis of the plane normal to y, they mean

    x + δ_x,  ẋ + δ_ẋ,  R c(δ_θ),  ω + δ_ω,  c(v) y with v = b δ_y,  c(v) (H + b δ_H),  r + δ_r,

where c is the Cayley transform: c(v) turns by 2 atan(|v|/2) about v. It is rational, and so is its inverse, it agrees
with the exponential up to third order, and it stays on the manifold. Only antipodal rods and attitudes half a turn
apart are no neighbours. The basis jumps where y₃ changes sign, but it belongs to one state, and nothing depends on it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from flypend.errors import InputError
from flypend.geometry import cross, dot, scale, vee
from flypend.model import State, Vehicle
from flypend.model.state import SIZE
from flypend.planning.riccati import unpack_gains
from flypend.plants.cascade import cascade_step
from flypend.plants.lag import TIMING_SIZE, hold, step_timing

Array = NDArray[np.float64]

MOTION = 16  # coordinates of a state without its rotors
POSITION, VELOCITY, ATTITUDE, SPIN, ROD, SWING = (
    slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12), slice(12, 14), slice(14, 16)
)  # fmt: skip
LEAST_ROOM = 1e-9  # own units: less would be lost in the rounding of a command


@dataclass(frozen=True)
class Scaled:
    """Symbols of a vehicle with so many `rotors` in its own units, with the attributes that equations of motion read.

    The `numbers` (k, 1) are bob mass, inverse inertia and inertia (upper triangles), the rows of the mixing matrix for
    the moment, and constant forces from outside on vehicle and bob, in weights.
    """

    numbers: ca.SX
    rotors: int

    @classmethod
    def symbols(cls, rotors: int) -> Scaled:
        """Return the symbols of a vehicle with this many rotors."""
        return cls(ca.SX.sym("vehicle", size(rotors)), rotors)

    l = property(lambda self: 1.0, doc="Length of the rod.")
    g = property(lambda self: 1.0, doc="Gravitational acceleration.")
    m = property(lambda self: self.numbers[0], doc="Mass of the bob.")
    M = property(lambda self: 1 - self.numbers[0], doc="Mass that moves with the pivot.")
    I_inv = property(lambda self: _symmetric(self.numbers[1:7]), doc="Inverse of the inertia matrix.")
    I = property(lambda self: _symmetric(self.numbers[7:13]), doc="Inertia matrix, body frame.")

    @property
    def outside(self) -> ca.SX:
        """Forces from outside on vehicle and bob (6, 1)."""
        return self.numbers[-6:]

    @property
    def vehicle(self) -> Any:
        """The machine itself, as what equations take for a `Vehicle`."""
        return self

    def mixing(self) -> ca.SX:
        """Return the matrix (4, n) from rotor forces to thrust and moment in the body frame."""
        n = self.rotors
        return ca.vertcat(ca.DM.ones(1, n) / n, ca.reshape(self.numbers[13 : 13 + 3 * n], n, 3).T)


def size(rotors: int) -> int:
    """Return the number of numbers of a vehicle with this many rotors."""
    return 13 + 3 * rotors + 6


def _symmetric(upper: ca.SX) -> ca.SX:
    a, b, c, d, e, f = ca.vertsplit(upper)
    return ca.vertcat(ca.horzcat(a, b, c), ca.horzcat(b, d, e), ca.horzcat(c, e, f))


@dataclass(frozen=True)
class Units:
    """The units of a vehicle: `length` (m), `time` (s), `force` (N, of one rotor)."""

    length: float
    time: float
    force: float

    @classmethod
    def of(cls, vehicle: Vehicle) -> Units:
        """Return the units of `vehicle`. Raises InputError without gravity, which gives no unit of time."""
        if vehicle.gravity == 0:
            raise InputError("vehicle.gravity", "gravity > 0, without which no pose is inverted", "0 m/s²")
        return cls(vehicle.l, float(np.sqrt(vehicle.l / vehicle.g)), vehicle.weight / len(vehicle.rotor_spins))

    def timing(self, vehicle: Vehicle, h: float) -> Array:
        """Return `plants.lag.step_timing` (4,) of a step `h` of `vehicle`, all in its own units."""
        found: Array = step_timing(vehicle.rotor_lag / self.time, h)
        return found

    def numbers(self, vehicle: Vehicle) -> Array:
        """Return the numbers of `vehicle` in its own units, without forces from outside, for symbols of `Scaled`."""
        mass, upper = vehicle.M + vehicle.m, np.triu_indices(3)
        inertia = vehicle.I / (mass * self.length**2)
        moments = vehicle.mixing()[1:] * self.force / (mass * vehicle.g * self.length)
        return np.concatenate(
            [[vehicle.m / mass], np.linalg.inv(inertia)[upper], inertia[upper], moments.ravel(), np.zeros(6)]
        )

    @property
    def of_state(self) -> Array:
        """Units of the entries of a packed state (24,)."""
        return self._repeat((3, 3, 9, 3, 3, 3))

    def states(self, rotors: int) -> Array:
        """Return the units of the entries of a packed state followed by the forces of `rotors` rotors."""
        return np.append(self.of_state, np.full(rotors, self.force))

    def deviations(self, rotors: int) -> Array:
        """Return the units of the entries of a `feedback.deviation` (18 + n,) of a vehicle with so many `rotors`."""
        return np.append(self._repeat((3,) * 6), np.full(rotors, self.force))

    def _repeat(self, counts: tuple[int, ...]) -> Array:
        """Return the units of position, velocity, attitude, spin, rod and its rate, as often as `counts` say."""
        rate = 1 / self.time
        return np.repeat([self.length, self.length * rate, 1.0, rate, 1.0, rate], counts)


assert len(Units(1.0, 1.0, 1.0).of_state) == SIZE


def step_once(state: ca.SX, command: ca.SX, timing: ca.SX, machine: Scaled) -> ca.SX:
    """Return the state (24 + n, 1) after a step of `timing` (see `plants.lag.step_timing`) under `command` (n, 1)."""
    forces, rotors = hold(state[SIZE:], command, timing)
    moved = cascade_step(state[:SIZE], forces.mix(machine.mixing()), machine.outside, timing[0], machine.vehicle)
    return ca.vertcat(moved, rotors)


class Stage:
    """Symbols of a stage of a machine with `rotors` rotors, in its own units.

    `gap` are the coordinates of where the stage leads about the state `after`, at which the next stage begins.
    """

    def __init__(self, rotors: int) -> None:
        self.rotors = rotors
        self.coordinates = MOTION + rotors
        self.machine = Scaled.symbols(rotors)
        self.before, self.after = ca.SX.sym("before", SIZE + rotors), ca.SX.sym("after", SIZE + rotors)
        self.command, self.timing = ca.SX.sym("command", rotors), ca.SX.sym("timing", TIMING_SIZE)

    def gap_at(self, delta: ca.SX) -> ca.SX:
        """Return the gap (16 + n, 1) if the stage begins with coordinates `delta` about `before`."""
        led = step_once(retract(self.before, delta), self.command, self.timing, self.machine)
        return local(self.after, led)

    def step(self) -> ca.Function:
        """Return (before, command, timing, vehicle) → state after the stage."""
        led = step_once(self.before, self.command, self.timing, self.machine)
        return ca.Function("step", [self.before, self.command, self.timing, self.machine.numbers], [ca.cse(led)])

    def derivatives(self) -> tuple[ca.SX, ca.SX, ca.SX]:
        """Return gap, and its derivatives A and B with respect to coordinates of the state and the command, sparse."""
        delta = ca.SX.sym("delta", self.coordinates)
        gap = self.gap_at(delta)
        A, B = ca.jacobian(gap, delta), ca.jacobian(gap, self.command)
        at = ca.substitute([gap, A, B], [delta], [ca.SX.zeros(self.coordinates)])
        return ca.densify(at[0]), ca.sparsify(at[1]), ca.sparsify(at[2])

    def linearise(self, *outputs: ca.SX) -> ca.Function:
        """Return (before, after, command, timing, vehicle) → `outputs`, made of `derivatives`."""
        inputs = [self.before, self.after, self.command, self.timing, self.machine.numbers]
        return ca.Function("linearised", inputs, ca.cse([*outputs]))

    def rollout(self) -> ca.Function:
        """Return (nominal, command, gap, gains, state, length, ε, limits, timing, vehicle) → state after it, command.

        The new command is that of the `riccati` step, `length` of it, with feedback of the deviation of the state from
        the nominal one. It is kept within limits (3,): least, largest, and the largest share of the room between the
        old command and each of them that it takes; `LEAST_ROOM` always stays. What is left of the gap is
        1 − `length` of it.
        """
        n, state, length = self.coordinates, ca.SX.sym("state", SIZE + self.rotors), ca.SX.sym("length")
        gap, epsilon, limits = ca.SX.sym("gap", n), ca.SX.sym("epsilon"), ca.SX.sym("limits", 3)
        gains = ca.SX.sym("gains", self.rotors * (n + 2))
        K, k, k_e = unpack_gains(gains, n, self.rotors)
        wanted = self.command + length * (k + epsilon * k_e) + ca.mtimes(K, local(self.before, state))
        low, high = limits[0] + LEAST_ROOM, limits[1] - LEAST_ROOM
        least = ca.fmin(ca.fmax(self.command + limits[2] * (limits[0] - self.command), low), self.command)
        most = ca.fmax(ca.fmin(self.command + limits[2] * (limits[1] - self.command), high), self.command)
        command = ca.fmin(ca.fmax(wanted, least), most)
        led = retract(step_once(state, command, self.timing, self.machine), (length - 1) * gap)
        inputs = [self.before, self.command, gap, gains, state, length, epsilon, limits]
        inputs += [self.timing, self.machine.numbers]
        return ca.Function("rollout", inputs, ca.cse([ca.densify(led), ca.densify(command)]))


def retract(state: ca.SX, delta: ca.SX) -> ca.SX:
    """Return the state (24 + n, 1) with coordinates `delta` (16 + n, 1) about `state` (24 + n, 1), in CasADi."""
    s = State.symbolic(state[:SIZE])
    b = plane(s.y)
    turn = ca.mtimes(b, delta[ROD])
    y = turn_by(turn, s.y)
    H = turn_by(turn, cross(s.y, s.y_dot) + ca.mtimes(b, delta[SWING]))
    moved = State.symbolic(
        ca.vertcat(
            s.x + delta[POSITION],
            s.x_dot + delta[VELOCITY],
            ca.vec(ca.mtimes(s.R, cayley(delta[ATTITUDE])).T),
            s.omega + delta[SPIN],
            y,
            cross(H, y),
        )
    )
    return ca.vertcat(moved.packed(), state[SIZE:] + delta[MOTION:])


def local(state: ca.SX, other: ca.SX) -> ca.SX:
    """Return the coordinates (16 + n, 1) of the state `other` about `state`, both (24 + n, 1): `retract` inverted."""
    s, o = State.symbolic(state[:SIZE]), State.symbolic(other[:SIZE])
    b = plane(s.y)
    M = ca.mtimes(s.R.T, o.R)
    attitude = scale(4 / (1 + M[0, 0] + M[1, 1] + M[2, 2]), vee(M))
    turn = between(s.y, o.y)
    swing = turn_by(-turn, cross(o.y, o.y_dot)) - cross(s.y, s.y_dot)
    along = ca.mtimes(b.T, ca.horzcat(turn, swing))
    return ca.vertcat(
        o.x - s.x, o.x_dot - s.x_dot, attitude, o.omega - s.omega, along[:, 0], along[:, 1], other[SIZE:] - state[SIZE:]
    )


def between(a: ca.SX, b: ca.SX) -> ca.SX:
    """Return the vector v normal to the unit vectors `a` and `b` (3, 1) with c(v) a = b; infinite for antipodes."""
    return scale(2 / (1 + dot(a, b)), cross(a, b))


def turn_by(v: ca.SX, w: ca.SX) -> ca.SX:
    """Return c(v) w: `w` (3, 1) turned by 2 atan(|v|/2) about `v` (3, 1)."""
    across = cross(v, w)
    return w + scale(1 / (1 + dot(v, v) / 4), across + cross(v, across) / 2)


def cayley(v: ca.SX) -> ca.SX:
    """Return the rotation matrix c(v) (3, 3)."""
    return ca.horzcat(*(turn_by(v, ca.SX(column)) for column in ca.horzsplit(ca.DM.eye(3))))


def plane(y: ca.SX) -> ca.SX:
    """Return an orthonormal basis (3, 2) of the plane normal to the unit vector `y` (3, 1); right-handed with it.

    After Duff et al., Building an orthonormal basis, revisited (2017).
    """
    sign = ca.if_else(y[2] >= 0, 1, -1)
    a = -1 / (sign + y[2])
    across = y[0] * y[1] * a
    first = ca.vertcat(1 + sign * y[0] ** 2 * a, sign * across, -sign * y[0])
    return ca.horzcat(first, ca.vertcat(across, sign + y[1] ** 2 * a, -y[1]))
