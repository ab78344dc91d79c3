"""The compiled programs of the solver, for machines with some number of rotors and some structure of inequalities."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from flypend.compile.llvm.stagewise import Stagewise, stagewise
from flypend.planning.barrier import Barrier
from flypend.planning.inequalities import Structure
from flypend.planning.riccati import Shape, backward, forward
from flypend.planning.stage import Stage


@dataclass(frozen=True)
class Kernels:
    """What the solver calls; the functions of the same name say what goes in and out.

    Parameters
    ----------
    shape : Shape
        Patterns of the derivatives.
    inequalities, exact, end_size : int
        Number of inequalities, of the exact ones among them, and of errors at the end.
    slopes : tuple of int
        Lengths of what `linearised` writes after the gap.
    of_stage, to_go, of_shared : int
        Lengths of the cost of a stage and of a cost to go, and the place of c, g and v in it.
    linearised, rollout : Stagewise
        See `stage.Stage`.
    backward, forward : Stagewise
        See `riccati`.
    values, terms, steps, end : Stagewise
        See `barrier.Barrier`.
    """

    shape: Shape
    inequalities: int
    exact: int
    end_size: int
    slopes: tuple[int, ...]
    of_stage: int
    to_go: int
    of_shared: int
    linearised: Stagewise
    rollout: Stagewise
    backward: Stagewise
    forward: Stagewise
    values: Stagewise
    terms: Stagewise
    steps: Stagewise
    end: Stagewise


@lru_cache(maxsize=32)
def kernels(rotors: int, structure: Structure) -> Kernels:
    """Return the compiled programs of as many problems as lanes, for machines with so many `rotors`, and `structure`.

    They come from the cache if possible.
    """
    stage = Stage(rotors)
    barrier = Barrier(stage, structure)
    linearised, A, B = stage.linearised()
    shape = Shape(A, B)
    return Kernels(
        shape=shape,
        inequalities=barrier.inequalities,
        exact=structure.exact(rotors),
        end_size=barrier.end_size,
        slopes=(A.nnz(), B.nnz()),
        of_stage=shape.of_stage,
        to_go=shape.to_go,
        of_shared=shape.to_go - 3,
        linearised=stagewise(linearised, shared=(3, 4)),
        rollout=stagewise(stage.rollout(), shared=(5, 6, 7, 8, 9)),
        backward=stagewise(backward(shape), shared=(5,), backward=True),
        forward=stagewise(forward(shape), shared=(1,)),
        values=stagewise(barrier.values(), shared=(2, 3, 4, 6)),
        terms=stagewise(barrier.terms(), shared=(2, 3, 4, 7)),
        steps=stagewise(barrier.steps(), shared=(2, 3, 4, 7, 10)),
        end=stagewise(barrier.end(), shared=(1, 2)),
    )
