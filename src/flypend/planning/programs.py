"""The compiled programs of the solver: of as many problems as lanes, or of one problem with its stages on the lanes.

The programs of one problem take many stages at a time where no stage takes from another, and in the recursion fill the
lanes with rows of matrices. With many problems a lane each is faster, as no lane is ever idle.
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
from flypend.compile.llvm.matrices import BLOCK, Entry, Kept, Lazy, Row, kept, put, recursion, row_of, write
from flypend.compile.llvm.stagewise import Stagewise, stagewise
from flypend.compile.llvm.vector import I64, Code, Value
from flypend.planning.dynamics import Stage
from flypend.planning.inequalities import Barrier, Structure
from flypend.planning.riccati import Layout, OfStage, ToGo, backward, before, forward


@dataclass(frozen=True)
class Programs:
    """What the solver calls; functions of the same names in the modules named here say what goes in and out."""

    layout: Layout
    inequalities: int  # their number,
    exact: int  # and that of the exact ones among them, which come first
    end_size: int  # number of errors at the end
    linearised: Stagewise  # of `dynamics.Stage`, as is `rollout`; of the derivatives it writes F
    rollout: Stagewise
    backward: Stagewise  # of `riccati`, as is `forward`
    forward: Stagewise
    values: Stagewise  # of `inequalities.Barrier`, as are the others
    terms: Stagewise
    steps: Stagewise
    end: Stagewise


@lru_cache(maxsize=64)
def programs(rotors: int, structure: Structure, *, lanes: bool) -> Programs:
    """Return the compiled programs for machines with this many `rotors`, and `structure`, from the cache if possible.

    They solve as many problems as `lanes`, or else a single one.
    """
    stage = Stage(rotors)
    barrier = Barrier(stage, structure)
    gap, A, B = stage.derivatives()
    curved = barrier.pattern
    pattern = curved + ca.Sparsity.diag(curved.size1())
    layout = Layout(A.sparsity(), B.sparsity(), pattern, 1 if lanes else BLOCK)
    each, in_turn = (stagewise, stagewise) if lanes else (abreast, partial(stagewise, width=1))
    return Programs(
        layout=layout,
        inequalities=barrier.inequalities,
        exact=structure.exact(rotors),
        end_size=barrier.end_size,
        linearised=each(stage.linearised(gap, layout.slopes(A, B)), shared=(3, 4)),
        values=each(barrier.values(), shared=(2, 3, 4, 6)),
        terms=each(barrier.terms(layout), shared=(2, 3, 4, 7)),
        steps=each(barrier.steps(), shared=(2, 3, 4, 7, 10)),
        backward=stagewise(backward(layout), shared=(4,), backward=True) if lanes else by_rows(layout),
        forward=in_turn(forward(layout), shared=(1,)),
        rollout=in_turn(stage.rollout(), shared=(5, 6, 7, 8, 9)),
        end=in_turn(barrier.end(layout), shared=(1, 2, 3, 4)),
    )


def by_rows(layout: Layout) -> Stagewise:
    """Return the program `riccati.backward` of one problem, with rows of matrices on the lanes."""
    n = layout.n
    lengths = [layout.of_to_go, layout.of_slopes, n, layout.of_stage, 2, layout.of_to_go, layout.of_gains]
    return recursion("backward", partial(_emit, layout), lengths, shared=(4,), backward=True)


def _emit(
    layout: Layout, code: Code, after: ir.Value, F: ir.Value, d: ir.Value, cost: ir.Value, damping: ir.Value,
    here: ir.Value, gains: ir.Value,
) -> None:  # fmt: skip
    """Emit `riccati.backward` on what lies in memory at a stage."""
    n, m, w = layout.n, layout.m, layout.width
    read, every, last = partial(Entry, code), [True] * (w // BLOCK), layout.of_shared

    def rows(memory: ir.Value, filled: Sequence[Sequence[bool]]) -> list[Row]:
        return [Kept(code, _at(code, memory, i * w), some) for i, some in enumerate(filled)]

    *P, p, p_e = rows(after, [every] * (n + 2))
    h, h_e = rows(cost, [every] * 2)
    known = ToGo(P, p, p_e, *(read(after, last + i) for i in range(3)))
    H = Lazy(n + m, partial(_hessian, layout, code, cost, damping))
    c, g = (read(cost, 2 * w + m + i) for i in range(2))
    stage = OfStage(rows(F, _filled(layout)), Lazy(n, partial(read, d)), H, h, h_e, c, g)
    found, steered = before(known, stage, layout.filled, kept)
    write(steered.K, [_at(code, gains, i * n) for i in range(m)], n)
    put([*steered.k, *steered.k_e], gains, n * m)
    write([*found.P, found.p, found.p_e], [_at(code, here, i * w) for i in range(n + 2)])
    put([found.c, found.g, found.v], here, last)


def _hessian(layout: Layout, code: Code, cost: ir.Value, damping: ir.Value, i: int) -> Any:
    """Return row `i` of diag(Q, R), damped."""
    n, m, w = layout.n, layout.m, layout.width
    places = [(n + j, n + j, j) for j in range(m)]
    places += [(row, j, m + 2 + at) for at, (row, j) in enumerate(zip(*layout.Q.get_triplet(), strict=True))]
    entries: dict[int, Value] = {i: Entry(code, damping, 0 if i < n else 1)}
    for _, j, at in (place for place in places if place[0] == i):
        value = Entry(code, cost, 2 * w + at)
        entries[j] = entries[j] + value if j in entries else value
    return row_of(code, entries, n + m)


def _filled(layout: Layout) -> list[list[bool]]:
    """Return which vectors of the rows of F are not zero."""
    F = np.array(ca.DM(layout.F, 1)) != 0
    whole = np.pad(F, ((0, 0), (0, layout.width - F.shape[1])))
    filled: list[list[bool]] = np.any(whole.reshape(len(F), -1, BLOCK), axis=2).tolist()
    return filled


def _at(code: Code, memory: ir.Value, first: int) -> ir.Value:
    return code.scalar_at(memory, ir.Constant(I64, first))
