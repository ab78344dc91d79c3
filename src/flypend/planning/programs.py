"""The compiled programs of the solver: of as many problems as lanes, or of one problem with its stages on the lanes.

The programs of one problem take many stages at a time where no stage takes from another, and in the recursion fill the
lanes with rows of matrices. With many problems a lane each is faster, as no lane is ever idle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache, partial

import casadi as ca

from flypend.compile.llvm.stagewise import WIDTH, Stagewise, stagewise
from flypend.planning.dynamics import Stage
from flypend.planning.inequalities import Barrier, Structure
from flypend.planning.riccati import Layout, backward, forward


@dataclass(frozen=True)
class Programs:
    """What the solver calls; functions of the same names in the modules named here say what goes in and out."""

    layout: Layout
    inequalities: int  # their number,
    exact: int  # and that of the exact ones among them, which come first
    end_size: int  # number of errors at the end
    summary: int  # length of what `values` tells of a stage
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
    layout = Layout(A.sparsity(), B.sparsity(), pattern, 1 if lanes else WIDTH)
    each, in_turn = (stagewise, stagewise) if lanes else (partial(stagewise, abreast=True), partial(stagewise, width=1))
    return Programs(
        layout=layout,
        inequalities=barrier.inequalities,
        exact=structure.exact(rotors),
        end_size=barrier.end_size,
        summary=3 + (structure.cost != ""),
        linearised=each(stage.linearised(gap, layout.slopes(A, B)), shared=(3, 4)),
        values=each(barrier.values(), shared=(2, 3, 4, 6)),
        terms=each(barrier.terms(layout), shared=(2, 3, 4, 7)),
        steps=each(barrier.steps(), shared=(2, 3, 4, 7, 10)),
        backward=backward(layout),
        forward=in_turn(forward(layout), shared=(1,)),
        rollout=in_turn(stage.rollout(), shared=(5, 6, 7, 8, 9)),
        end=in_turn(barrier.end(layout), shared=(1, 2, 3, 4)),
    )
