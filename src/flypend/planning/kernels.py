"""The compiled programs of the solver, for machines with some number of rotors and some wishes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache, partial

from flypend.compile.llvm.stagewise import WIDTH, Stagewise, stagewise
from flypend.planning.barrier import Barrier
from flypend.planning.riccati import Shape, backward, forward
from flypend.planning.stage import Stage
from flypend.planning.wishes import Wishes


@dataclass(frozen=True)
class Kernels:
    """What the solver calls; the functions of the same name say what goes in and out.

    Parameters
    ----------
    shape : Shape
        Patterns of the derivatives.
    inequalities, exact, end_size : int
        Number of inequalities, of the exact ones among them, and of errors at the end.
    linearised, rollout, step : Stagewise
        See `plan.stage.Stage`.
    backward, forward : Stagewise
        See `plan.riccati`.
    values, terms, steps, end : Stagewise
        See `plan.barrier.Barrier`.
    """

    shape: Shape
    inequalities: int
    exact: int
    end_size: int
    linearised: Stagewise
    rollout: Stagewise
    step: Stagewise
    backward: Stagewise
    forward: Stagewise
    values: Stagewise
    terms: Stagewise
    steps: Stagewise
    end: Stagewise


@lru_cache(maxsize=32)
def kernels(rotors: int, wishes: Wishes, width: int = WIDTH) -> Kernels:
    """Return the compiled programs for machines with this many `rotors`, and `wishes`, on `width` lanes.

    They come from the cache if possible.
    """
    compiled = partial(stagewise, width=width)
    stage = Stage(rotors)
    barrier = Barrier(stage, wishes)
    linearised, A, B = stage.linearised()
    shape = Shape(A, B)
    return Kernels(
        shape=shape,
        inequalities=barrier.inequalities,
        exact=wishes.exact(rotors),
        end_size=barrier.end_size,
        linearised=compiled(linearised, shared=(3, 4)),
        rollout=compiled(stage.rollout(), shared=(5, 6, 7, 8, 9)),
        step=compiled(stage.step(), shared=(2, 3)),
        backward=compiled(backward(shape), shared=(5,), backward=True),
        forward=compiled(forward(shape), shared=(1,)),
        values=compiled(barrier.values(), shared=(2, 3, 4, 6)),
        terms=compiled(barrier.terms(), shared=(2, 3, 4, 7)),
        steps=compiled(barrier.steps(), shared=(2, 3, 4, 7, 10)),
        end=compiled(barrier.end(), shared=(1, 2)),
    )
