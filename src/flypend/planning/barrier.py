"""Inequalities and costs of a stage with a primal-dual barrier: as terms of a linear-quadratic problem, and as steps.

Each inequality g ≥ 0 has a slack s > 0 and a multiplier z > 0: g = s and s z = μ. Eliminating their steps leaves in
the Newton step the curvature Jᵀ(z/s)J and the gradient −Jᵀ(μ/s − (z/s)(g − s)), with J the derivative of g. Of the
curvature of g itself the part is kept that is convex whatever the state: that of distances and speeds.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca

from flypend.planning.coordinates import MOTION, POSITION, VELOCITY, retract
from flypend.planning.inequalities import SHARED, Structure, end_errors, inequalities, nearness, running_cost
from flypend.planning.riccati import packed_cost, packed_to_go
from flypend.planning.stage import Stage


class Barrier:
    """Programs of a `stage` with a `structure`; deviations δ of the state, υ of the command, ε of what is shared."""

    def __init__(self, stage: Stage, structure: Structure) -> None:
        n = stage.rotors
        self._stage, self._state, self._exact = stage, stage.before, structure.exact(n)
        self._moves = [ca.SX.sym("delta", MOTION + n), ca.SX.sym("upsilon", n), ca.SX.sym("epsilon")]
        delta, upsilon, epsilon = self._moves
        shared, numbers = ca.SX.sym("shared"), ca.SX.sym("numbers", structure.numbers)
        here, command, place = retract(stage.before, delta), stage.command + upsilon, ca.SX.sym("place", 3)
        self._g = inequalities(here, command, shared + epsilon, numbers, place, structure, stage.machine)
        self._J = [ca.jacobian(self._g, move) for move in self._moves]
        self._near = nearness(here, stage.before, numbers, structure, stage.machine)
        self._cost, self._end = running_cost(command, numbers), end_errors(here, numbers)
        self.inequalities, self.end_size = int(self._g.numel()), int(self._end.numel())
        self._slack, self._dual = ca.SX.sym("s", self.inequalities), ca.SX.sym("z", self.inequalities)
        self._mu, self._numbers = ca.SX.sym("mu"), numbers
        self._weight = numbers[-2] if structure.soft else 0
        self._point = [stage.before, stage.command, shared, numbers, stage.machine.numbers]
        self._place = [place] if structure.path else []

    def _function(self, name: str, inputs: list[Any], *outputs: Any) -> ca.Function:
        """Return a function of `inputs`, with all moves zero."""
        still = [ca.SX.zeros(move.shape) for move in self._moves]
        return ca.Function(name, inputs, ca.cse([ca.densify(v) for v in ca.substitute(outputs, self._moves, still)]))

    def values(self) -> ca.Function:
        """Return (*point, trial slack, μ, *place) → (merit, violation) of the stage, and slack.

        A point is (state, command, shared parameter, numbers, vehicle), and there is a place, where the pivot is to be,
        only with a path. The slack of an exact inequality is g, that of another the larger of g and the trial slack:
        what lies above g is the violation.
        """
        k, g = self._exact, self._g
        slack = ca.vertcat(g[:k], ca.fmax(g[k:], self._slack[k:]))
        merit = self._cost + self._weight * ca.sumsqr(self._near) / 2 - self._mu * ca.sum1(ca.log(slack))
        summary = ca.vertcat(merit, ca.sum1(slack[k:] - g[k:]) if k < g.numel() else 0)
        return self._function("values", [*self._point, self._slack, self._mu, *self._place], summary, slack)

    def terms(self, packed: Callable[..., Any] = packed_cost) -> ca.Function:
        """Return (*point, slack, dual, μ, *place) → cost of the linear-quadratic problem, `packed`."""
        s, z, (delta, upsilon, _) = self._slack, self._dual, self._moves
        push = self._mu / s - z / s * (self._g - s)
        J_x, J_u, J_e = self._J
        weight = ca.diag(z / s)
        N_x = ca.jacobian(self._near, delta)
        r = ca.gradient(self._cost, upsilon)
        R = ca.diag(ca.jacobian(r, upsilon) + ca.mtimes([J_u.T, weight, J_u]))
        cost = packed(
            self._curvature(),
            R,
            self._weight * ca.mtimes(N_x.T, self._near) - ca.mtimes(J_x.T, push),
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

    def _curvature(self) -> Any:
        """Return Q (16 + n, 16 + n), sparse."""
        J_x, N_x = self._J[0], ca.jacobian(self._near, self._moves[0])
        kept = ca.mtimes([J_x.T, ca.diag(self._dual / self._slack), J_x]) + self._bent()
        return self._weight * ca.mtimes(N_x.T, N_x) + kept

    def _bent(self) -> Any:
        """Return the curvature of −zᵀg in position and velocity."""
        delta = self._moves[0]
        H, _ = ca.hessian(-ca.dot(self._dual, self._g), delta)
        kept = ca.SX(*H.shape)
        for part in (POSITION, VELOCITY):
            kept[part, part] = H[part, part]
        return kept

    def steps(self) -> ca.Function:
        """Return (*point, slack, dual, μ, δ, υ, ε, *place) → steps of slack and dual, and shares that they take.

        The shares (2,) are the largest: max(−Δs/s) of inequalities that are not exact, and max(−Δz/z).
        """
        s, z, k = self._slack, self._dual, self._exact
        given = [ca.SX.sym(f"move_{i}", move.numel()) for i, move in enumerate(self._moves)]
        along = sum(ca.mtimes(J, move) for J, move in zip(self._J, given, strict=True))
        ds = along + self._g - s
        dz = self._mu / s - z - z / s * ds
        shares = ca.vertcat(_largest(-ds[k:] / s[k:]), _largest(-dz / z))
        return self._function("steps", [*self._point, s, z, self._mu, *given, *self._place], ds, dz, shares)

    def end(self, packed: Callable[..., Any] = packed_to_go) -> ca.Function:
        """Return (state, numbers, weight, offset) → end errors h, and ½ weight |h + offset|² to go, `packed`."""
        h, weight, offset = self._end, ca.SX.sym("weight"), ca.SX.sym("offset", self.end_size)
        J = ca.jacobian(h, self._moves[0])
        P, p = weight * ca.mtimes(J.T, J), weight * ca.mtimes(J.T, h + offset)
        cost = packed(P, p, ca.SX.zeros(p.numel()), 0, self._numbers[SHARED], 0)
        return self._function("end", [self._state, self._numbers, weight, offset], h, cost)


def _largest(values: Any) -> Any:
    largest = ca.SX(0)
    for i in range(values.numel()):
        largest = ca.fmax(largest, values[i])
    return largest
