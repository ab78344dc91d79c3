"""The linear-quadratic problem of a Newton step: its backward recursion, and the step forward through the stages.

With deviations δ of the state, υ of the command and ε of a parameter that all stages share, each stage is

    δ⁺ = A δ + B υ + d,     cost ½ δᵀQδ + ½ υᵀRυ + (q + ε q_e)ᵀδ + rᵀυ + ½ c ε² + g ε,

and the cost to go is ½ δᵀPδ + (p + ε p_e)ᵀδ + ½ c ε² + g ε + v. A, B and Q are sparse, P and Q symmetric, R diagonal.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from flypend.compile.llvm.loops import Constants, Definition
from flypend.compile.llvm.stagewise import WIDTH, Stagewise, horizon


@dataclass(frozen=True)
class Layout:
    """How a problem with n coordinates and m commands lies in memory.

    Rows have n + m numbers and end with a multiple of `block`. A stage is the rows of F = [A B]; of its cost there are
    the rows [q r] and [q_e 0], R, c, g, and what of Q is not zero; of a cost to go the rows of P, p and p_e, and c, g,
    v. Where a row has more than n numbers that mean something, the rest is of no account. With a `block` of 1 only what
    is not zero of F is there, and the upper triangle of P, both column by column.
    """

    A: ca.Sparsity  # (n, n)
    B: ca.Sparsity  # (n, m)
    Q: ca.Sparsity  # (n, n)
    block: int = 1

    n = property(lambda self: int(self.A.size1()), doc="Number of coordinates of a state.")
    m = property(lambda self: int(self.B.size2()), doc="Length of a command.")
    of_slopes = property(lambda self: self.F.nnz() if self.block == 1 else self.n * self.width, doc="Length of F.")
    of_stage = property(
        lambda self: self._pad(2 * self.width + self.m + 2 + self.Q.nnz()), doc="Length of the cost of a stage."
    )
    _of_matrix = property(lambda self: self.n * (self.n + 1) // 2 if self.block == 1 else self.n * self.width)  # P
    of_shared = property(lambda self: self._of_matrix + 2 * self.width, doc="Place of c, g and v in a cost to go.")
    of_to_go = property(lambda self: self._pad(self.of_shared + 3), doc="Length of a cost to go.")
    of_gains = property(lambda self: self.m * (self.n + 2), doc="Length of the gains of a stage: rows of K, k and k_e.")

    @property
    def width(self) -> int:
        """Length of a row."""
        return self._pad(self.n + self.m)

    @property
    def F(self) -> ca.Sparsity:
        """Pattern of [A B]."""
        return ca.horzcat(ca.DM(self.A), ca.DM(self.B)).sparsity()

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
        n, w, first = self.n, self.width, self._of_matrix
        if self.block == 1:
            upper = ca.SX(ca.Sparsity.upper(n), memory[:first])
            P = upper + ca.triu(upper, False).T
        else:
            P = ca.reshape(memory[:first], w, n).T[:, :n]
        return P, memory[first : first + n], memory[first + w : first + w + n]

    def place_of_P(self, i: int, j: int) -> int:
        """Return the place in a cost to go of entry (i, j) of P, or of (j, i), which is the same."""
        low, high = min(i, j), max(i, j)
        return high * (high + 1) // 2 + low if self.block == 1 else low * self.width + high

    def _pad(self, length: int) -> int:
        return -(-length // self.block) * self.block

    def _row(self, values: ca.SX) -> ca.SX:
        """Return `values` (1, k) as a column of the length of a row."""
        return _to_length(ca.densify(values).T, self.width)


def _to_length(values: ca.SX, length: int) -> ca.SX:
    return ca.vertcat(ca.densify(values), ca.SX.zeros(length - values.numel()))


def backward(layout: Layout) -> Stagewise:
    """Compile (cost to go after, F, d, cost, damping) → cost to go before, and gains, as they lie in memory.

    Gains are the rows of K, then k and k_e, of the best command υ = K δ + k + k_e ε. `damping` (2,) is added to the
    diagonals of Q and R. With a block of 1 there is a problem per lane, else a single one.
    """
    n, m, block = layout.n, layout.m, layout.block
    lengths = [layout.of_to_go, layout.of_slopes, n, layout.of_stage, 2, layout.of_to_go, layout.of_gains]
    strides = [0 if length == 2 else length * (WIDTH if block == 1 else 1) for length in lengths]

    def inner() -> tuple[dict[str, Definition], Constants]:
        rows, columns = np.array(layout.F.row()), np.array(layout.F.get_col())
        parts = np.unique(np.stack([columns // block, rows]), axis=1)  # vectors that are not zero, column by column
        sparse = block == 1  # then only what is not zero is in memory
        numbers: Constants = {
            "BY_LANE": int(sparse), "n": n, "m": m, "PARTS": layout.width // block, "SHARED": layout.of_shared,
            "P_AT": np.array([[layout.place_of_P(i, j) for j in range(n)] for i in range(n)]),
            "F_COLUMN": np.array(layout.F.colind()), "F_ROW": rows,
            "F_AT": np.arange(len(rows)) if sparse else rows * layout.width + columns,
            "F_PART": np.searchsorted(parts[0], np.arange(layout.width // block + 1)), "F_PART_ROW": parts[1],
            "F_PART_AT": np.arange(len(rows)) if sparse else parts[1] * (layout.width // block) + parts[0],
            "Q_ENTRIES": layout.Q.nnz(), "Q_AT": np.array([
                -1 if sparse and i > j else layout.place_of_P(i, j) if sparse else i * layout.width + j
                for i, j in zip(*layout.Q.get_triplet(), strict=True)
            ]),
        }  # fmt: skip
        return {}, numbers

    return horizon("riccati", WIDTH, strides, True, inner, repr(layout))


def forward(layout: Layout) -> ca.Function:
    """Return (δ, ε, F, d, gains, cost to go after) → δ⁺, υ, and the largest of the costate P δ⁺ + p + p_e ε."""
    n, m = layout.n, layout.m
    delta, epsilon, d = ca.SX.sym("delta", n), ca.SX.sym("epsilon"), ca.SX.sym("d", n)
    memory, gains, V = (ca.SX.sym(*named) for named in (
        ("F", layout.of_slopes), ("gains", layout.of_gains), ("V", layout.of_to_go)
    ))  # fmt: skip
    F, (P, p, p_e), (K, k, k_e) = layout.slopes_in(memory), layout.to_go_in(V), unpack_gains(gains, n, m)
    upsilon = ca.mtimes(K, delta) + k + k_e * epsilon
    after = ca.mtimes(F[:, :n], delta) + ca.mtimes(F[:, n:], upsilon) + d
    costate = ca.mmax(ca.fabs(ca.mtimes(P, after) + p + p_e * epsilon))
    outputs = [ca.densify(after), ca.densify(upsilon), costate]
    return ca.Function("forward", [delta, epsilon, memory, d, gains, V], outputs)


def unpack_gains(gains: ca.SX, n: int, m: int) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Return K (m, n), k and k_e (m, 1) of packed `gains`, in CasADi."""
    return ca.reshape(gains[: n * m], n, m).T, gains[n * m : (n + 1) * m], gains[(n + 1) * m :]


def solve(S: ca.SX, right: ca.SX) -> ca.SX:
    """Return S⁻¹ `right` for a symmetric positive definite `S` (m, m), in CasADi."""
    return ca.ldl_solve(right, *ca.ldl(S))
