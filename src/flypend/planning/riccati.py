"""The linear-quadratic problem of a Newton step: its backward recursion, and the step forward through the stages.

With deviations δ of the state, υ of the command and ε of a parameter that all stages share, each stage is

    δ⁺ = A δ + B υ + d,     cost ½ δᵀQδ + ½ υᵀRυ + (q + ε q_e)ᵀδ + rᵀυ + ½ c ε² + g ε,

and the cost to go is ½ δᵀPδ + (p + ε p_e)ᵀδ + ½ c ε² + g ε + v. A and B are sparse, P and Q symmetric, R diagonal. A
cost to go is packed as the upper triangle of P, row by row, p, p_e, c, g, v; the cost of a stage as the upper triangle
of Q, column by column, R, q, q_e, r, c, g.
"""

from __future__ import annotations

from itertools import accumulate
from typing import Any, NamedTuple

import casadi as ca


class Shape(NamedTuple):
    """Patterns of A (n, n) and B (n, k)."""

    A: ca.Sparsity
    B: ca.Sparsity

    @property
    def n(self) -> int:
        """Number of coordinates of a state."""
        return int(self.A.size1())

    @property
    def k(self) -> int:
        """Length of a command."""
        return int(self.B.size2())

    @property
    def to_go(self) -> int:
        """Length of a packed cost to go."""
        return self.n * (self.n + 1) // 2 + 2 * self.n + 3

    @property
    def of_stage(self) -> int:
        """Length of the packed cost of a stage."""
        return sum(self.parts)

    @property
    def parts(self) -> tuple[int, ...]:
        """Lengths of the parts of the cost of a stage."""
        return (self.n * (self.n + 1) // 2, self.k, self.n, self.n, self.k, 1, 1)

    @property
    def gains(self) -> int:
        """Length of the gains of a stage: columns of K, k and k_e."""
        return self.k * (self.n + 2)


def packed_to_go(P: Any, p: Any, p_e: Any, c: Any, g: Any, v: Any) -> Any:
    """Return a packed cost to go; see the head of this module."""
    return ca.vertcat(*(P[i, j] for i in range(P.size1()) for j in range(i, P.size1())), p, p_e, c, g, v)


def _unpacked(V: Any, n: int) -> tuple[Any, Any, Any]:
    """Return P, p and p_e of a packed cost to go."""
    P, place = ca.SX(n, n), 0
    for i in range(n):
        for j in range(i, n):
            P[i, j] = P[j, i] = V[place]
            place += 1
    return P, V[place : place + n], V[place + n : place + 2 * n]


def packed_cost(Q: Any, R: Any, q: Any, q_e: Any, r: Any, c: Any, g: Any) -> Any:
    """Return the packed cost of a stage, from the upper triangle of Q and the diagonal of R; see this module's head."""
    return ca.vertcat(Q, R, q, q_e, r, c, g)


def backward(shape: Shape) -> ca.Function:
    """Return (cost to go after, A, B, d, cost, damping) → cost to go before, and gains.

    The best command is υ = K δ + k + k_e ε; gains are K, k and k_e by columns. `damping` (2,) is added to the diagonals
    of Q and R.
    """
    n = shape.n
    V, cost, damping = ca.SX.sym("V", shape.to_go), ca.SX.sym("cost", shape.of_stage), ca.SX.sym("damping", 2)
    A, B, d = ca.SX.sym("A", shape.A), ca.SX.sym("B", shape.B), ca.SX.sym("d", n)
    P, p, p_e = _unpacked(V, n)
    c, g, v = ca.vertsplit(V[-3:])
    Q, R, q, q_e, r, c_k, g_k = ca.vertsplit(cost, [0, *accumulate(shape.parts)])
    upper = ca.SX(ca.Sparsity.upper(n), Q)
    Q = upper + ca.triu(upper, False).T + damping[0] * ca.SX.eye(n)

    p_d = p + ca.mtimes(P, d)
    Q_xx, Q_ux = Q + ca.mtimes(A.T, ca.mtimes(P, A)), ca.mtimes(B.T, ca.mtimes(P, A))
    Q_uu = ca.mtimes(B.T, ca.mtimes(P, B)) + ca.diag(R + damping[1])
    Q_x, Q_u = q + ca.mtimes(A.T, p_d), r + ca.mtimes(B.T, p_d)
    Q_xe, Q_ue = q_e + ca.mtimes(A.T, p_e), ca.mtimes(B.T, p_e)
    gains = -solved(Q_uu, ca.horzcat(ca.densify(Q_ux), Q_u, Q_ue))
    K, k, k_e = gains[:, :n], gains[:, n], gains[:, n + 1]
    before = packed_to_go(
        Q_xx + ca.mtimes(Q_ux.T, K),
        Q_x + ca.mtimes(Q_ux.T, k),
        Q_xe + ca.mtimes(Q_ux.T, k_e),
        c + c_k + ca.dot(Q_ue, k_e),
        g + g_k + ca.dot(p_e, d) + ca.dot(Q_ue, k),
        v + ca.dot(p + p_d, d) / 2 + ca.dot(Q_u, k) / 2,
    )
    inputs = [V, ca.vertcat(*A.nonzeros()), ca.vertcat(*B.nonzeros()), d, cost, damping]
    return ca.Function("backward", inputs, [ca.densify(before), ca.vec(gains)])


def forward(shape: Shape) -> ca.Function:
    """Return (δ, ε, A, B, d, gains, cost to go after) → δ⁺, υ, and the largest of the costate P δ⁺ + p + p_e ε."""
    n, m = shape.n, shape.k
    delta, epsilon, V = ca.SX.sym("delta", n), ca.SX.sym("epsilon"), ca.SX.sym("V", shape.to_go)
    A, B, d = ca.SX.sym("A", shape.A), ca.SX.sym("B", shape.B), ca.SX.sym("d", n)
    gains = ca.SX.sym("gains", m, n + 2)
    upsilon = ca.mtimes(gains[:, :n], delta) + gains[:, n] + gains[:, n + 1] * epsilon
    after = ca.mtimes(A, delta) + ca.mtimes(B, upsilon) + d
    P, p, p_e = _unpacked(V, n)
    costate = ca.fabs(ca.mtimes(P, after) + p + p_e * epsilon)
    inputs = [delta, epsilon, ca.vertcat(*A.nonzeros()), ca.vertcat(*B.nonzeros()), d, ca.vec(gains), V]
    return ca.Function("forward", inputs, [ca.densify(after), ca.densify(upsilon), ca.mmax(costate)])


def solved(S: Any, right: Any) -> Any:
    """Return S⁻¹ `right` for a symmetric positive definite `S` (m, m), by its factors L D Lᵀ, in CasADi."""
    m = S.size1()
    L = ca.SX.eye(m)
    D: list[Any] = []
    for j in range(m):
        D.append(S[j, j] - sum(L[j, i] ** 2 * D[i] for i in range(j)))
        for i in range(j + 1, m):
            L[i, j] = (S[i, j] - sum(L[i, h] * L[j, h] * D[h] for h in range(j))) / D[j]
    rows: list[Any] = []
    for i in range(m):
        rows.append(right[i, :] - sum(L[i, h] * rows[h] for h in range(i)))
    rows = [row / factor for row, factor in zip(rows, D, strict=True)]
    for i in reversed(range(m)):
        rows[i] = rows[i] - sum(L[h, i] * rows[h] for h in range(i + 1, m))
    return ca.vertcat(*rows)
