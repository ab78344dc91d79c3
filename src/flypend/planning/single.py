"""The programs of one problem: what no stage takes from another many stages at a time, and the recursion by rows.

Rows have n + m numbers, for n coordinates and m commands, and end with a multiple of eight. A stage is n rows of
F = [A B]. Its cost is the rows [q r] and [q_e 0], R, c, g and what of Q is not zero; a cost to go is the rows of P, p
and p_e, and c, g, v. Where a row has more than n numbers that mean something, the rest is of no account.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any

import casadi as ca
import numpy as np
from llvmlite import ir

from flypend.compile.llvm.abreast import abreast
from flypend.compile.llvm.matrices import BLOCK, Entry, Kept, Lazy, Row, kept, padded, put, recursion, row_of, write
from flypend.compile.llvm.stagewise import stagewise
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.planning.barrier import Barrier
from flypend.planning.inequalities import Structure
from flypend.planning.kernels import Kernels
from flypend.planning.riccati import OfStage, Shape, ToGo, ahead, before
from flypend.planning.stage import Stage


@dataclass(frozen=True)
class Rows:
    """How a problem lies in memory.

    Parameters
    ----------
    shape : Shape
        Patterns of A and B.
    Q : Sparsity
        Pattern of Q.
    """

    shape: Shape
    Q: ca.Sparsity

    @property
    def width(self) -> int:
        """Length of a row in memory."""
        return padded(self.shape.n + self.shape.k)

    @property
    def of_stage(self) -> int:
        """Length of the cost of a stage."""
        return padded(2 * self.width + self.shape.k + 2 + self.Q.nnz())

    @property
    def to_go(self) -> int:
        """Length of a cost to go."""
        return padded(self.of_shared + 3)

    @property
    def of_shared(self) -> int:
        """Place of c, g and v in a cost to go."""
        return (self.shape.n + 2) * self.width

    def row(self, values: Any) -> Any:
        """Return `values` (1, k), in CasADi, as a column of the length of a row."""
        return ca.vertcat(ca.densify(values).T, ca.SX.zeros(self.width - values.numel()))

    def cost(self, Q: Any, R: Any, q: Any, q_e: Any, r: Any, c: Any, g: Any) -> Any:
        """Return the cost of a stage as it lies in memory."""
        parts = (self.row(ca.horzcat(q.T, r.T)), self.row(q_e.T), R, c, g, *ca.project(Q, self.Q).nonzeros())
        return _to_length(ca.vertcat(*parts), self.of_stage)

    def end(self, P: Any, p: Any, p_e: Any, c: Any, g: Any, v: Any) -> Any:
        """Return a cost to go as it lies in memory."""
        rows = [self.row(row) for row in (*ca.vertsplit(ca.densify(P)), p.T, p_e.T)]
        return _to_length(ca.vertcat(*rows, c, g, v), self.to_go)

    def stage(self, A: Any, B: Any) -> Any:
        """Return F as it lies in memory."""
        return ca.vertcat(*(self.row(row) for row in ca.vertsplit(ca.horzcat(A, B))))

    def forward(self) -> ca.Function:
        """Return `riccati.forward` on what lies in memory; F in place of A and B."""
        n, m, w = self.shape.n, self.shape.k, self.width
        F, V = ca.SX.sym("F", n * w), ca.SX.sym("V", self.to_go)
        rows, P = ca.reshape(F, w, n).T, ca.reshape(V[: n * w], w, n).T[:, :n]
        A, B = ca.project(rows[:, :n], self.shape.A), ca.project(rows[:, n : n + m], self.shape.B)
        p, p_e = (V[(n + i) * w : (n + i) * w + n] for i in range(2))
        return ahead(self.shape, A, B, [F], V, (P, p, p_e))

    def backward(self, code: Code, after: ir.Value, F: ir.Value, d: ir.Value, cost: ir.Value, damping: ir.Value,
                 here: ir.Value, gains: ir.Value) -> None:  # fmt: skip
        """Emit `riccati.backward` on what lies in memory at a stage."""
        n, m, w = self.shape.n, self.shape.k, self.width
        read, every, last = partial(Entry, code), [True] * (w // BLOCK), self.of_shared

        def rows(memory: ir.Value, filled: Sequence[Sequence[bool]]) -> list[Row]:
            return [Kept(code, _at(code, memory, i * w), some) for i, some in enumerate(filled)]

        *P, p, p_e = rows(after, [every] * (n + 2))
        h, h_e = rows(cost, [every] * 2)
        known = ToGo(P, p, p_e, *(read(after, last + i) for i in range(3)))
        H = Lazy(n + m, partial(self._hessian, code, cost, damping))
        c, g = (read(cost, 2 * w + m + i) for i in range(2))
        stage = OfStage(rows(F, self._filled), Lazy(n, partial(read, d)), H, h, h_e, c, g)
        found, steered = before(known, stage, self.shape.filled, kept)
        write(steered.K, [_at(code, gains, i * n) for i in range(m)], n)
        put([*steered.k, *steered.k_e], gains, n * m)
        write([*found.P, found.p, found.p_e], [_at(code, here, i * w) for i in range(n + 2)])
        put([found.c, found.g, found.v], here, last)

    def _hessian(self, code: Code, cost: ir.Value, damping: ir.Value, i: int) -> Any:
        """Return row `i` of diag(Q, R), damped."""
        n, m, w = self.shape.n, self.shape.k, self.width
        places = [(n + j, n + j, j) for j in range(m)]
        places += [(row, j, m + 2 + at) for at, (row, j) in enumerate(zip(*self.Q.get_triplet(), strict=True))]
        entries: dict[int, Value] = {i: Entry(code, damping, 0 if i < n else 1)}
        for _, j, at in (place for place in places if place[0] == i):
            value = Entry(code, cost, 2 * w + at)
            entries[j] = entries[j] + value if j in entries else value
        return row_of(code, entries, n + m)

    @property
    def _filled(self) -> list[list[bool]]:
        """Which vectors of the rows of F are not zero."""
        F = np.array(ca.horzcat(ca.DM(self.shape.A, 1), ca.DM(self.shape.B, 1))) != 0
        whole = np.pad(F, ((0, 0), (0, self.width - F.shape[1])))
        filled: list[list[bool]] = np.any(whole.reshape(len(F), -1, BLOCK), axis=2).tolist()
        return filled


def _to_length(values: Any, length: int) -> Any:
    return ca.vertcat(ca.densify(values), ca.SX.zeros(length - values.numel()))


def _at(code: Code, memory: ir.Value, first: int) -> ir.Value:
    return code.scalar_at(memory, ir.Constant(I64, first))


@lru_cache(maxsize=32)
def laid(rotors: int, structure: Structure) -> Rows:
    """Return how a problem with this many `rotors`, and `structure`, lies in memory."""
    _, A, B = Stage(rotors).derivatives()
    curved = Barrier(Stage(rotors), structure).pattern
    return Rows(Shape(A.sparsity(), B.sparsity()), curved + ca.Sparsity.diag(curved.size1()))


@lru_cache(maxsize=32)
def single(rotors: int, structure: Structure) -> Kernels:
    """Return the compiled programs of one problem for machines with this many `rotors`, and `structure`.

    They come from the cache if possible.
    """
    stage, rows = Stage(rotors), laid(rotors, structure)
    barrier, shape = Barrier(stage, structure), rows.shape
    gap, A, B = stage.derivatives()
    lengths = [rows.to_go, shape.n * rows.width, shape.n, rows.of_stage, 2, rows.to_go, shape.gains]
    one_by_one = partial(stagewise, width=1)
    return Kernels(
        shape=shape,
        inequalities=barrier.inequalities,
        exact=structure.exact(rotors),
        end_size=barrier.end_size,
        slopes=(shape.n * rows.width,),
        of_stage=rows.of_stage,
        to_go=rows.to_go,
        of_shared=rows.of_shared,
        linearised=abreast(stage.leading(gap, rows.stage(A, B)), shared=(3, 4)),
        values=abreast(barrier.values(), shared=(2, 3, 4, 6)),
        terms=abreast(barrier.terms(rows.cost), shared=(2, 3, 4, 7)),
        steps=abreast(barrier.steps(), shared=(2, 3, 4, 7, 10)),
        backward=recursion("backward", rows.backward, lengths, shared=(4,), backward=True),
        forward=one_by_one(rows.forward(), shared=(1,)),
        rollout=one_by_one(stage.rollout(), shared=(5, 6, 7, 8, 9)),
        end=one_by_one(barrier.end(rows.end), shared=(1, 2, 3, 4)),
    )
