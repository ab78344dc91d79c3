"""The linear-quadratic problem of a Newton step: its backward recursion, and the step forward through the stages.

With deviations δ of the state, υ of the command and ε of a parameter that all stages share, each stage is

    δ⁺ = A δ + B υ + d,     cost ½ δᵀQδ + ½ υᵀRυ + (q + ε q_e)ᵀδ + rᵀυ + ½ c ε² + g ε,

and the cost to go is ½ δᵀPδ + (p + ε p_e)ᵀδ + ½ c ε² + g ε + v. A, B and Q are sparse, P and Q symmetric, R diagonal.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import pairwise
from operator import add
from typing import Any, NamedTuple

import casadi as ca


@dataclass(frozen=True)
class Layout:
    """How a problem with n coordinates and m commands lies in memory.

    Rows have n + m numbers and end with a multiple of `block`. A stage is the rows of F = [A B]; of its cost there are
    the rows [q r] and [q_e 0], R, c, g, and what of Q is not zero; of a cost to go the rows of P, p and p_e, and c, g,
    v. Where a row has more than n numbers that mean something, the rest is of no account. With a `block` of 1 only what
    is not zero of F is there, and the upper triangle of P, both column by column.

    Parameters
    ----------
    A, B, Q : Sparsity
        Patterns (n, n), (n, m) and (n, n).
    block : int
        Numbers in a block.
    """

    A: ca.Sparsity
    B: ca.Sparsity
    Q: ca.Sparsity
    block: int = 1

    @property
    def n(self) -> int:
        """Number of coordinates of a state."""
        return int(self.A.size1())

    @property
    def m(self) -> int:
        """Length of a command."""
        return int(self.B.size2())

    @property
    def width(self) -> int:
        """Length of a row."""
        return self._padded(self.n + self.m)

    @property
    def of_slopes(self) -> int:
        """Length of F."""
        return int(self.F.nnz()) if self.block == 1 else self.n * self.width

    @property
    def of_stage(self) -> int:
        """Length of the cost of a stage."""
        return self._padded(2 * self.width + self.m + 2 + self.Q.nnz())

    @property
    def of_shared(self) -> int:
        """Place of c, g and v in a cost to go."""
        return self._of_P + 2 * self.width

    @property
    def of_to_go(self) -> int:
        """Length of a cost to go."""
        return self._padded(self.of_shared + 3)

    @property
    def of_gains(self) -> int:
        """Length of the gains of a stage: rows of K, k and k_e."""
        return self.m * (self.n + 2)

    @property
    def F(self) -> ca.Sparsity:
        """Pattern of [A B]."""
        return ca.horzcat(ca.DM(self.A), ca.DM(self.B)).sparsity()

    @property
    def filled(self) -> list[list[int]]:
        """The rows that are not zero of each column of F."""
        return [self.F.row()[a:b] for a, b in pairwise(self.F.colind())]

    def slopes(self, A: ca.SX, B: ca.SX) -> ca.SX:
        """Return [A B], of `A` (n, n) and `B` (n, m) in CasADi, as it lies in memory."""
        F = ca.horzcat(A, B)
        return ca.vertcat(*(ca.project(F, self.F).nonzeros() if self.block == 1 else map(self._row, ca.vertsplit(F))))

    def cost(self, Q: ca.SX, R: ca.SX, q: ca.SX, q_e: ca.SX, r: ca.SX, c: ca.SX, g: ca.SX) -> ca.SX:
        """Return the cost of a stage as it lies in memory; `R` (m, 1) is the diagonal, vectors are columns."""
        rows = self._row(ca.horzcat(q.T, r.T)), self._row(q_e.T)
        return _to_length(ca.vertcat(*rows, R, c, g, *ca.project(Q, self.Q).nonzeros()), self.of_stage)

    def to_go(self, P: ca.SX, p: ca.SX, p_e: ca.SX, c: ca.SX, g: ca.SX, v: ca.SX) -> ca.SX:
        """Return a cost to go as it lies in memory; `p` and `p_e` are columns (n, 1)."""
        P = ca.densify(P)
        rows = ca.triu(P).nonzeros() if self.block == 1 else map(self._row, ca.vertsplit(P))
        return _to_length(ca.vertcat(*rows, self._row(p.T), self._row(p_e.T), c, g, v), self.of_to_go)

    def slopes_in(self, memory: ca.SX) -> ca.SX:
        """Return F (n, n + m), sparse, of what lies in `memory`."""
        if self.block == 1:
            return ca.SX(self.F, memory)
        return ca.project(ca.reshape(memory, self.width, self.n).T[:, : self.n + self.m], self.F)

    def to_go_in(self, memory: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX]:
        """Return P (n, n), p and p_e (n, 1) of the cost to go that lies in `memory`."""
        n, w, first = self.n, self.width, self._of_P
        if self.block == 1:
            upper = ca.SX(ca.Sparsity.upper(n), memory[:first])
            P = upper + ca.triu(upper, False).T
        else:
            P = ca.reshape(memory[:first], w, n).T[:, :n]
        return P, memory[first : first + n], memory[first + w : first + w + n]

    @property
    def _of_P(self) -> int:
        return self.n * (self.n + 1) // 2 if self.block == 1 else self.n * self.width

    def _padded(self, length: int) -> int:
        return -(-length // self.block) * self.block

    def _row(self, values: ca.SX) -> ca.SX:
        """Return `values` (1, k) as a column of the length of a row."""
        return _to_length(ca.densify(values).T, self.width)


def _to_length(values: ca.SX, length: int) -> ca.SX:
    return ca.vertcat(ca.densify(values), ca.SX.zeros(length - values.numel()))


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


def backward(layout: Layout) -> ca.Function:
    """Return (cost to go after, F, d, cost, damping) → cost to go before, and gains, as they lie in memory.

    Gains are the rows of K, then k and k_e; see `before`. `damping` (2,) is added to the diagonals of Q and R.
    """
    n, m, w = layout.n, layout.m, layout.width
    V, memory, d = ca.SX.sym("V", layout.of_to_go), ca.SX.sym("F", layout.of_slopes), ca.SX.sym("d", n)
    cost, damping = ca.SX.sym("cost", layout.of_stage), ca.SX.sym("damping", 2)
    h, h_e, R, c, g, Q = ca.vertsplit(cost, [0, w, 2 * w, 2 * w + m, 2 * w + m + 1, 2 * w + m + 2, cost.numel()])
    H = ca.diagcat(ca.SX(layout.Q, Q[: layout.Q.nnz()]) + damping[0] * ca.SX.eye(n), ca.diag(R + damping[1]))
    stage = OfStage(ca.vertsplit(layout.slopes_in(memory)), d, ca.vertsplit(H), h[: n + m].T, h_e[: n + m].T, c, g)
    P, p, p_e = layout.to_go_in(V)
    shared = ca.vertsplit(V[layout.of_shared : layout.of_shared + 3])
    found, gains = before(ToGo(ca.vertsplit(P), p.T, p_e.T, *shared), stage, layout.filled)
    here = layout.to_go(
        ca.vertcat(*found.P)[:, :n], found.p[:n].T, found.p_e[:n].T, found.c, found.g, found.v
    )  # fmt: skip
    rows = ca.vertcat(*(row[:n].T for row in gains.K), *gains.k, *gains.k_e)
    return ca.Function("backward", [V, memory, d, cost, damping], [ca.densify(here), ca.densify(rows)])


def forward(layout: Layout) -> ca.Function:
    """Return (δ, ε, F, d, gains, cost to go after) → δ⁺, υ, and the largest of the costate P δ⁺ + p + p_e ε."""
    n, m = layout.n, layout.m
    delta, epsilon, d = ca.SX.sym("delta", n), ca.SX.sym("epsilon"), ca.SX.sym("d", n)
    memory, gains, V = (ca.SX.sym(*named) for named in (
        ("F", layout.of_slopes), ("gains", layout.of_gains), ("V", layout.of_to_go)
    ))  # fmt: skip
    F, (P, p, p_e), (K, k, k_e) = layout.slopes_in(memory), layout.to_go_in(V), unpacked_gains(gains, n, m)
    upsilon = ca.mtimes(K, delta) + k + k_e * epsilon
    after = ca.mtimes(F[:, :n], delta) + ca.mtimes(F[:, n:], upsilon) + d
    costate = ca.mmax(ca.fabs(ca.mtimes(P, after) + p + p_e * epsilon))
    outputs = [ca.densify(after), ca.densify(upsilon), costate]
    return ca.Function("forward", [delta, epsilon, memory, d, gains, V], outputs)


def unpacked_gains(gains: ca.SX, n: int, m: int) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Return K (m, n), k and k_e (m, 1) of packed `gains`, in CasADi."""
    return ca.reshape(gains[: n * m], n, m).T, gains[n * m : (n + 1) * m], gains[(n + 1) * m :]


def solved(S: ca.SX, right: ca.SX) -> ca.SX:
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
