"""Inequalities along the way, the cost of a stage and the errors at the end, in own units; and their barrier.

Each inequality g ≥ 0 has a slack s > 0 and a multiplier z > 0: g = s and s z = μ. Eliminating their steps leaves in
the Newton step the curvature Jᵀ(z/s)J and the gradient −Jᵀ(μ/s − (z/s)(g − s)), with J the derivative of g. Of the
curvature of g itself the part is kept that is convex whatever the state: that of distances and speeds.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate

import casadi as ca

from flypend.geometry import E3, cross, dot
from flypend.model import State, Vehicle, Wrench
from flypend.model.dynamics import bob_tension
from flypend.model.mount import least_margin, rod_in_body
from flypend.model.state import SIZE
from flypend.planning.dynamics import MOTION, POSITION, VELOCITY, Scaled, Stage, retract
from flypend.planning.riccati import Layout
from flypend.planning.window import NUMBERS, funnel_margins

# Tolerances at the end, in own units.
END = {"x": 0.01, "x_dot": 0.02, "tilt": 0.03, "omega": 0.06, "y": 0.015, "y_dot": 0.03, "rotors": 0.15}

# Places of the numbers that every plan has: weights of the shared parameter and of effort, rotor limits, and the
# tolerance of the spin about the thrust axis at the end.
SHARED, EFFORT, LOW, HIGH, YAW, BASE = 0, 1, 2, 3, 4, 5
# Numbers of constraints and costs of one's own: the target, m, units of length, time and force, and the root of the
# weight of a stage.
OWN, OF_FORCE = 7, 5
# Numbers of another end than hover upright: velocity, thrust axis, angular velocity, rod, its rate, and whether forces
# are those of hover.
OTHER_END = 16
WALLS = 7  # reach of the rod and corners of the box
DIFFERENCE = 1e-4
SOFT = 0.03  # rod lengths, or weights: what is by so much too near costs its full weight


@dataclass(frozen=True)
class Structure:
    """Which inequalities a plan obeys, beside the limits of the rotors and the ball |x|² ≤ e that its cost shrinks."""

    box: bool = False  # pivot and far end of the rod stay in a box
    speed: bool = False  # the speed of the pivot is limited
    lean: bool = False  # the lean of the rod is limited
    path: bool = False  # the ball is about a place that moves from stage to stage, not about the target
    gates: int = 0  # windows to fly through and waypoints to pass
    keep: str = ""  # a function of one's own, of `constraints.own_function`, as CasADi writes it
    cost: str = ""  # likewise: the half square of its values is a cost
    end: bool = False  # whether the end is another than hover upright
    mounted: Vehicle | None = None  # a vehicle whose mount limits the rod; None for a gimbal

    @cached_property
    def slices(self) -> dict[str, slice]:
        """Where the numbers of a plan are, by what they are for; only what it obeys has numbers.

        Those of "speed" and "lean" are the limit and the lowest y₃; those of "soft", which are the last, the weight of
        being too near and the margin of the mount.
        """
        lengths = {
            "base": BASE, "end": OTHER_END * self.end, "own": OWN * (self.keep + self.cost != ""),
            "box": WALLS * self.box, "speed": self.speed, "lean": self.lean, "gates": NUMBERS * self.gates,
            "soft": 2 * self.soft,
        }  # fmt: skip
        after = accumulate(lengths.values())
        return {name: slice(stop - n, stop) for (name, n), stop in zip(lengths.items(), after, strict=True) if n}

    @property
    def soft(self) -> bool:
        """Whether some are kept by a cost that grows: those about what the machine is not to touch."""
        return self.mounted is not None or self.gates > 0 or self.box


def inequalities(
    state: ca.SX, command: ca.SX, shared: ca.SX, numbers: ca.SX, middle: ca.SX, structure: Structure
) -> ca.SX:  # fmt: skip
    """Return g (k, 1), every entry of which is to be ≥ 0.

    A `state` (24 + n, 1) ends with rotor forces, and `command` (n, 1) are those commanded; `shared` is e, the squared
    radius of the ball about its `middle` (3, 1), and `numbers` are in `Structure.slices`.
    """
    s, slices = State.symbolic(state[:SIZE]), structure.slices
    off = s.x - middle if structure.path else s.x
    g = [command - numbers[LOW], numbers[HIGH] - command, shared - dot(off, off)]
    if structure.speed:
        fastest = numbers[slices["speed"]]
        g.append(fastest - dot(s.x_dot, s.x_dot) / fastest)
    if structure.lean:
        g.append(s.y[2] - numbers[slices["lean"]])
    if structure.keep:
        g.append(_own(state, numbers, structure, structure.keep))
    return ca.vertcat(*g)


def residuals(state: ca.SX, numbers: ca.SX, structure: Structure) -> ca.SX:
    """Return the values (k, 1) of the cost of one's own, none without one: half their squares are that of a stage."""
    if not structure.cost:
        return ca.SX(0, 1)
    return numbers[structure.slices["own"]][-1] * _own(state, numbers, structure, structure.cost)


def _own(state: ca.SX, numbers: ca.SX, structure: Structure, function: str) -> ca.SX:
    """Return the values (k, 1) of a `function` as CasADi writes it at a `state` in own units."""
    own = numbers[structure.slices["own"]]
    target, (length, time, force) = own[:3], ca.vertsplit(own[3:6])
    s = State.symbolic(state[:SIZE])
    packed = State(
        x=target + length * s.x, x_dot=length / time * s.x_dot, R=s.R, omega=s.omega / time, y=s.y, y_dot=s.y_dot / time
    ).packed()
    values: ca.SX = ca.Function.deserialize(function)(packed, force * state[SIZE:])
    return values


def nearness(state: ca.SX, about: ca.SX, numbers: ca.SX, structure: Structure, machine: Scaled) -> ca.SX:
    """Return by how much rod and machine are nearer than they should be to walls, mount and frames, (k, 1).

    It is in units of `SOFT`. The squares cost the last but one of `numbers`; the last is the margin that the mount is
    to keep, in rod lengths or weights.
    """
    gates = ca.vertsplit(numbers[structure.slices["gates"]], NUMBERS) if structure.gates else []
    near = [beyond(state, numbers, structure), *(-funnel_margins(state, about, gate) for gate in gates)]
    if structure.mounted is not None:
        near.append(numbers[-1] - _least_margin(state, about, structure.mounted, machine))
    return ca.fmax(0, ca.vertcat(ca.SX(0, 1), *near) / SOFT)


def beyond(state: ca.SX, numbers: ca.SX, structure: Structure) -> ca.SX:
    """Return how far pivot and far end of the rod are beyond each wall of the box, (k, 1), in rod lengths."""
    if not structure.box:
        return ca.SX(0, 1)
    reach, low, high = ca.vertsplit(numbers[structure.slices["box"]], [0, 1, 4, WALLS])
    x, y = state[POSITION], state[18:21]
    return ca.vertcat(*(ca.vertcat(low - point, point - high) for point in (x, x + reach * y)))


def _least_margin(state: ca.SX, about: ca.SX, mounted: Vehicle, machine: Scaled) -> ca.SX:
    """Return the least of `model.mount.margins`, in rod lengths or weights, linear in `state` about `about`.

    Its own derivatives do not exist everywhere, differences do.
    """
    here, there = (_rod_push(place, machine) for place in (state, about))

    def margin(held: ca.SX) -> ca.SX:
        return least_margin(held[:3], held[3] * mounted.l, mounted)[0] / mounted.l

    slopes = []
    for i in range(4):
        step = DIFFERENCE * ca.SX(ca.DM.eye(4)[:, i])
        slopes.append((margin(there + step) - margin(there - step)) / (2 * DIFFERENCE))
    return margin(there) + ca.dot(ca.vertcat(*slopes), here - there)


def _rod_push(state: ca.SX, machine: Scaled) -> ca.SX:
    """Return the rod in the body frame (3,) and its push on the vehicle, in weights.

    The push is that of the equivalent point bob: of a rod with inertia, in a cup that lifts it, less than its own.
    """
    s = State.symbolic(state[:SIZE])
    thrust = ca.mtimes(machine.mixing()[0, :], state[SIZE:])
    tension = bob_tension(s, Wrench(thrust, ca.SX(3, 1)), machine.vehicle)
    return ca.vertcat(rod_in_body(s, "up")[0], -tension)


def running_cost(command: ca.SX, numbers: ca.SX) -> ca.SX:
    """Return the cost of a stage: half the squared deviation of the commands from hover, weighted."""
    return numbers[EFFORT] * ca.sumsqr(command - 1) / 2


def end_errors(state: ca.SX, numbers: ca.SX, *, other: bool = False) -> ca.SX:
    """Return the errors of the last state about inverted hover, or an `other` end, in units of their tolerances."""
    s, up, still = State.symbolic(state[:SIZE]), ca.SX(ca.DM(E3)), ca.SX(3, 1)
    x_dot, z, omega, y, y_dot, hovers = still, up, still, up, still, 1
    if other:
        parts = numbers[BASE : BASE + OTHER_END]
        x_dot, z, omega, y, y_dot, hovers = (parts[i : i + 3] for i in range(0, OTHER_END, 3))
    return ca.vertcat(
        s.x / END["x"],
        (s.x_dot - x_dot) / END["x_dot"],
        _direction_error(s.z, z) / END["tilt"],
        (s.omega - omega) / ca.vertcat(END["omega"], END["omega"], numbers[YAW]),
        _direction_error(s.y, y) / END["y"],
        (s.y_dot - y_dot) / END["y_dot"],
        hovers * (state[SIZE:] - 1) / END["rotors"],
    )


def _direction_error(a: ca.SX, b: ca.SX) -> ca.SX:
    """Return the error of a unit vector `a` from `b`: the double tangent of half their angle (3, 1), and 1 − a·b.

    The tangent is kept finite for antipodes, where it vanishes and 1 − a·b is 2; near `b` that is of second order.
    About e₃ the third entry is always 0, and left out.
    """
    entries = ca.vertsplit(ca.vertcat(2 * cross(a, b) / (1.05 + dot(a, b)), 1 - dot(a, b)))
    return ca.vertcat(*(entry for entry in entries if not entry.is_zero()))


class Barrier:
    """Programs of a `stage` with a `structure`; deviations δ of the state, υ of the command, ε of what is shared.

    The first `exact` of the `inequalities` can always be kept: limits of the rotors, and the ball.
    """

    def __init__(self, stage: Stage, structure: Structure) -> None:
        n = stage.rotors
        self._stage, self._state, self.exact = stage, stage.before, 2 * n + 1
        self._moves = [ca.SX.sym("delta", MOTION + n), ca.SX.sym("upsilon", n), ca.SX.sym("epsilon")]
        delta, upsilon, epsilon = self._moves
        shared, numbers = ca.SX.sym("shared"), ca.SX.sym("numbers", [*structure.slices.values()][-1].stop)
        here, command, place = retract(stage.before, delta), stage.command + upsilon, ca.SX.sym("place", 3)
        self._g = inequalities(here, command, shared + epsilon, numbers, place, structure)
        self._J = [ca.jacobian(self._g, move) for move in self._moves]
        self._beyond = beyond(here, numbers, structure)
        self._near = nearness(here, stage.before, numbers, structure, stage.machine)
        self._cost, self._end = running_cost(command, numbers), end_errors(here, numbers, other=structure.end)
        self._own = residuals(here, numbers, structure)
        self.inequalities, self.end_size = int(self._g.numel()), int(self._end.numel())
        self._of_own = ca.Function.deserialize(structure.keep).numel_out() if structure.keep else 0
        self._slack, self._dual = ca.SX.sym("s", self.inequalities), ca.SX.sym("z", self.inequalities)
        self._mu, self._numbers = ca.SX.sym("mu"), numbers
        self._weight = numbers[-2] if structure.soft else 0
        self._point = [stage.before, stage.command, shared, numbers, stage.machine.numbers]
        self._place = [place] if structure.path else []

    def _function(self, name: str, inputs: list[ca.SX], *outputs: ca.SX) -> ca.Function:
        """Return a function of `inputs`, with all moves zero."""
        still = [ca.SX.zeros(move.shape) for move in self._moves]
        return ca.Function(name, inputs, ca.cse([ca.densify(v) for v in ca.substitute(outputs, self._moves, still)]))

    def values(self) -> ca.Function:
        """Return (*point, trial slack, μ, *place) → (merit, violation, lack) of the stage, and slack.

        A cost of one's own, which is part of the merit, stands behind them by itself. A point is (state, command,
        shared parameter, numbers, vehicle), and there is a place, where the pivot is to be, only with a path. The slack
        of an exact inequality is g, that of another the larger of g and the trial slack: what lies above g is the
        violation. What g itself lacks to 0, whatever its slack, is the lack.
        """
        k, g = self.exact, self._g
        slack = ca.vertcat(g[:k], ca.fmax(g[k:], self._slack[k:]))
        wished = ca.sumsqr(self._own) / 2
        merit = self._cost + wished + self._weight * ca.sumsqr(self._near) / 2 - self._mu * ca.sum1(ca.log(slack))
        violation, lack = ca.sum1(slack[k:] - g[k:]), ca.sum1(ca.fmax(0, ca.vertcat(-g[k:], self._beyond)))
        summary = ca.vertcat(merit, violation, lack, *([wished] if self._own.numel() else []))
        return self._function("values", [*self._point, self._slack, self._mu, *self._place], summary, slack)

    def terms(self, layout: Layout) -> ca.Function:
        """Return (*point, slack, dual, μ, *place) → cost of the linear-quadratic problem, as in its `layout`."""
        s, z, (delta, upsilon, _) = self._slack, self._dual, self._moves
        push = self._mu / s - z / s * (self._g - s)
        J_x, J_u, J_e = self._J
        weight = ca.diag(z / s)
        N_x, W_x = ca.jacobian(self._near, delta), ca.jacobian(self._own, delta)
        r = ca.gradient(self._cost, upsilon)
        R = ca.diag(ca.jacobian(r, upsilon) + ca.mtimes([J_u.T, weight, J_u]))
        cost = layout.cost(
            self._curvature(),
            R,
            self._weight * ca.mtimes(N_x.T, self._near) + ca.mtimes(W_x.T, self._own) - ca.mtimes(J_x.T, push),
            ca.mtimes([J_x.T, weight, J_e]),
            r - ca.mtimes(J_u.T, push),
            ca.mtimes([J_e.T, weight, J_e]),
            -ca.mtimes(J_e.T, push),
        )
        return self._function("terms", [*self._point, s, z, self._mu, *self._place], cost)

    @property
    def pattern(self) -> ca.Sparsity:
        """Pattern of Q."""
        return self._curvature().sparsity()

    def _curvature(self) -> ca.SX:
        """Return Q (16 + n, 16 + n), sparse."""
        J_x, N_x, W_x = self._J[0], *(ca.jacobian(each, self._moves[0]) for each in (self._near, self._own))
        kept = ca.mtimes([J_x.T, ca.diag(self._dual / self._slack), J_x]) + self._bent()
        return self._weight * ca.mtimes(N_x.T, N_x) + ca.mtimes(W_x.T, W_x) + kept

    def _bent(self) -> ca.SX:
        """Return the curvature of −zᵀg in position and velocity, but not of one's own g, which may have any sign."""
        delta, ours = self._moves[0], self.inequalities - self._of_own
        H, _ = ca.hessian(-ca.dot(self._dual[:ours], self._g[:ours]), delta)
        kept = ca.SX(*H.shape)
        for part in (POSITION, VELOCITY):
            kept[part, part] = H[part, part]
        return kept

    def steps(self) -> ca.Function:
        """Return (*point, slack, dual, μ, δ, υ, ε, *place) → steps of slack and dual, and shares that they take.

        The shares (2,) are the largest: max(−Δs/s) of inequalities that are not exact, and max(−Δz/z).
        """
        s, z, k = self._slack, self._dual, self.exact
        given = [ca.SX.sym(f"move_{i}", move.numel()) for i, move in enumerate(self._moves)]
        along = sum(ca.mtimes(J, move) for J, move in zip(self._J, given, strict=True))
        ds = along + self._g - s
        dz = self._mu / s - z - z / s * ds
        shares = ca.vertcat(ca.mmax(ca.vertcat(0, -ds[k:] / s[k:])), ca.mmax(ca.vertcat(0, -dz / z)))
        return self._function("steps", [*self._point, s, z, self._mu, *given, *self._place], ds, dz, shares)

    def end(self, layout: Layout) -> ca.Function:
        """Return (state, numbers, weight, offset) → end errors h, and ½ weight |h + offset|² to go."""
        h, weight, offset = self._end, ca.SX.sym("weight"), ca.SX.sym("offset", self.end_size)
        J = ca.jacobian(h, self._moves[0])
        P, p = weight * ca.mtimes(J.T, J), weight * ca.mtimes(J.T, h + offset)
        cost = layout.to_go(P, p, ca.SX.zeros(p.numel()), 0, self._numbers[SHARED], 0)
        return self._function("end", [self._state, self._numbers, weight, offset], h, cost)
