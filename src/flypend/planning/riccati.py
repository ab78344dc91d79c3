"""The linear-quadratic problem of a Newton step: its backward recursion, and the step forward through the stages.

With deviations δ of the state, υ of the command and ε of a parameter that all stages share, each stage is

    δ⁺ = A δ + B υ + d,     cost ½ δᵀQδ + ½ υᵀRυ + (q + ε q_e)ᵀδ + rᵀυ + ½ c ε² + g ε,

and the cost to go is ½ δᵀPδ + (p + ε p_e)ᵀδ + ½ c ε² + g ε + v. A and B are sparse, P and Q symmetric, R diagonal. A
cost to go is packed as the upper triangle of P, row by row, p, p_e, c, g, v; the cost of a stage as the upper triangle
of Q, column by column, R, q, q_e, r, c, g.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import reduce
from itertools import accumulate, pairwise
from operator import add
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
        """Length of the gains of a stage: rows of K, k and k_e."""
        return self.k * (self.n + 2)

    @property
    def filled(self) -> list[list[int]]:
        """The rows that are not zero of each column of [A B]."""
        pattern = ca.horzcat(ca.DM(self.A), ca.DM(self.B)).sparsity()
        return [pattern.row()[a:b] for a, b in pairwise(pattern.colind())]


def packed_to_go(P: Any, p: Any, p_e: Any, c: Any, g: Any, v: Any) -> Any:
    """Return a packed cost to go; see this module's head."""
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
    """Return the packed cost of a stage, from Q and the diagonal of R; see this module's head."""
    return ca.vertcat(*(Q[i, j] for j in range(Q.size1()) for i in range(j + 1)), R, q, q_e, r, c, g)


class ToGo(NamedTuple):
    """A cost to go: rows of P, rows p and p_e, and c, g, v."""

    P: Iterable[Any]
    p: Any
    p_e: Any
    c: Any
    g: Any
    v: Any


class Gains(NamedTuple):
    """The best command υ = K δ + k + k_e ε: rows of K, and the numbers k and k_e."""

    K: Sequence[Any]
    k: Sequence[Any]
    k_e: Sequence[Any]


class OfStage(NamedTuple):
    """A stage: rows of F = [A B], numbers d, and of its cost the rows of diag(Q, R), [q r], [q_e 0], and c, g."""

    F: Sequence[Any]
    d: Any
    H: Sequence[Any]
    h: Any
    h_e: Any
    c: Any
    g: Any


def before(
    after: ToGo, stage: OfStage, filled: Sequence[Sequence[int]], kept: Callable[[Iterable[Any]], Sequence[Any]] = list
) -> tuple[ToGo, Gains]:
    """Return the cost to go before a `stage` from that `after` it, and the gains.

    It is written for rows, which add up and take factors on their right, so that it can be compiled for many problems,
    with rows of CasADi symbols, and for one, with rows in registers. Rows of before's P are as long as those of F.

    Parameters
    ----------
    after, stage : ToGo, OfStage
        What is known.
    filled : sequence of sequences of int
        For each column of F, its rows that are not zero.
    kept : callable
        Computes rows, and returns them as such of which single numbers can be taken.
    """
    (_, p, p_e, c, g, v), (F, d, H, h, h_e, c_k, g_k), P = after, stage, list(after.P)
    n, m = len(P), len(H) - len(P)
    # What rounding leaves of a difference between P and its transpose would grow like an open loop: half of P is read.
    PF = kept(_sum(F[j] * P[min(i, j)][max(i, j)] for j in range(n)) for i in range(n))
    (p_d,) = kept([p + _sum(P[j] * d[j] for j in range(n))])
    x, e = kept(row + _sum(F[i] * part[i] for i in range(n)) for row, part in ((h, p_d), (h_e, p_e)))

    def quadratic(i: int) -> Any:
        return _sum([H[i], *(PF[j] * F[j][i] for j in filled[i])])

    Q_u = kept(quadratic(n + i) for i in range(m))
    parts = factors([[Q_u[i][n + j] for j in range(m)] for i in range(m)])
    k, k_e = ([-part for part in divided(*parts, [row[n + i] for i in range(m)])] for row in (x, e))
    K = kept(-row for row in divided(*parts, Q_u))
    along = [_sum(d[i] * part[i] for i in range(n)) for part in (p_e, p, p_d)]
    togo = ToGo(
        (_sum([quadratic(i), *(K[j] * Q_u[j][i] for j in range(m))]) for i in range(n)),
        _sum([x, *(Q_u[j] * k[j] for j in range(m))]),
        _sum([e, *(Q_u[j] * k_e[j] for j in range(m))]),
        c + c_k + _sum(k_e[j] * e[n + j] for j in range(m)),
        g + g_k + along[0] + _sum(k[j] * e[n + j] for j in range(m)),
        v + 0.5 * (along[1] + along[2] + _sum(k[j] * x[n + j] for j in range(m))),
    )
    return togo, Gains(K, k, k_e)


def _sum(terms: Iterable[Any]) -> Any:
    return reduce(add, terms)


def backward(shape: Shape) -> ca.Function:
    """Return (cost to go after, A, B, d, cost, damping) → cost to go before, and gains.

    Gains are the rows of K, then k and k_e; see `before`. `damping` (2,) is added to the diagonals of Q and R.
    """
    n, m = shape.n, shape.k
    V, cost, damping = ca.SX.sym("V", shape.to_go), ca.SX.sym("cost", shape.of_stage), ca.SX.sym("damping", 2)
    A, B, d = ca.SX.sym("A", shape.A), ca.SX.sym("B", shape.B), ca.SX.sym("d", n)
    P, p, p_e = _unpacked(V, n)
    Q, R, q, q_e, r, c, g = ca.vertsplit(cost, [0, *accumulate(shape.parts)])
    upper = ca.SX(ca.Sparsity.upper(n), Q)
    H = ca.diagcat(upper + ca.triu(upper, False).T + damping[0] * ca.SX.eye(n), ca.diag(R + damping[1]))
    stage = OfStage(
        ca.vertsplit(ca.horzcat(A, B)), d, ca.vertsplit(H), ca.horzcat(q.T, r.T), ca.horzcat(q_e.T, ca.SX(1, m)), c, g
    )
    found, gains = before(ToGo(ca.vertsplit(P), p.T, p_e.T, *ca.vertsplit(V[-3:])), stage, shape.filled)
    packed = packed_to_go(
        ca.vertcat(*found.P)[:, :n], found.p[:n].T, found.p_e[:n].T, found.c, found.g, found.v
    )  # fmt: skip
    inputs = [V, ca.vertcat(*A.nonzeros()), ca.vertcat(*B.nonzeros()), d, cost, damping]
    rows = ca.vertcat(*(row[:n].T for row in gains.K), *gains.k, *gains.k_e)
    return ca.Function("backward", inputs, [ca.densify(packed), ca.densify(rows)])


def forward(shape: Shape) -> ca.Function:
    """Return (δ, ε, A, B, d, gains, cost to go after) → δ⁺, υ, and the largest of the costate P δ⁺ + p + p_e ε."""
    V, A, B = ca.SX.sym("V", shape.to_go), ca.SX.sym("A", shape.A), ca.SX.sym("B", shape.B)
    given = [ca.vertcat(*A.nonzeros()), ca.vertcat(*B.nonzeros())]
    return ahead(shape, A, B, given, V, _unpacked(V, shape.n))


def ahead(shape: Shape, A: Any, B: Any, given: Sequence[Any], V: Any, to_go: tuple[Any, Any, Any]) -> ca.Function:
    """Return `forward` for A and B in the inputs `given`, and P, p and p_e `to_go` in the input V."""
    delta, epsilon, d = ca.SX.sym("delta", shape.n), ca.SX.sym("epsilon"), ca.SX.sym("d", shape.n)
    gains, (P, p, p_e) = ca.SX.sym("gains", shape.gains), to_go
    K, k, k_e = unpacked_gains(gains, shape.n, shape.k)
    upsilon = ca.mtimes(K, delta) + k + k_e * epsilon
    after = ca.mtimes(A, delta) + ca.mtimes(B, upsilon) + d
    costate = ca.fabs(ca.mtimes(P, after) + p + p_e * epsilon)
    inputs = [delta, epsilon, *given, d, gains, V]
    return ca.Function("forward", inputs, [ca.densify(after), ca.densify(upsilon), ca.mmax(costate)])


def unpacked_gains(gains: Any, n: int, m: int) -> tuple[Any, Any, Any]:
    """Return K (m, n), k and k_e (m, 1) of packed `gains`, in CasADi."""
    return ca.reshape(gains[: n * m], n, m).T, gains[n * m : (n + 1) * m], gains[(n + 1) * m :]


def solved(S: Any, right: Any) -> Any:
    """Return S⁻¹ `right` for a symmetric positive definite `S` (m, m), by its factors L D Lᵀ, in CasADi."""
    m = S.size1()
    return ca.vertcat(*divided(*factors([[S[i, j] for j in range(m)] for i in range(m)]), ca.vertsplit(right)))


def factors(S: Sequence[Sequence[Any]]) -> tuple[list[list[Any]], list[Any]]:
    """Return L below its diagonal of ones, row by row, and the diagonal of D in S = L D Lᵀ, symmetric and definite."""
    L: list[list[Any]] = [[] for _ in S]
    D: list[Any] = []
    for j, row in enumerate(S):
        D.append(row[j] - _sum(L[j][i] * L[j][i] * D[i] for i in range(j)) if j else row[j])
        for i in range(j + 1, len(S)):
            rest = S[i][j] - _sum(L[i][h] * L[j][h] * D[h] for h in range(j)) if j else S[i][j]
            L[i].append(rest / D[j])
    return L, D


def divided(L: Sequence[Sequence[Any]], D: Sequence[Any], right: Sequence[Any]) -> list[Any]:
    """Return (L D Lᵀ)⁻¹ times the rows or numbers `right`; L and D as in `factors`."""
    rows: list[Any] = []
    for i, row in enumerate(right):
        rows.append(row - _sum(rows[h] * L[i][h] for h in range(i)) if i else row)
    rows = [row * (1.0 / factor) for row, factor in zip(rows, D, strict=True)]
    for i in reversed(range(len(rows) - 1)):
        rows[i] = rows[i] - _sum(rows[h] * L[h][i] for h in range(i + 1, len(rows)))
    return rows
