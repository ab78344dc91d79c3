"""A race of guesses: each is solved by itself, and after some iterations the worse ones are given up."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flypend.compile.llvm.stagewise import lanes
from flypend.planning.kernels import Kernels
from flypend.planning.method import Problem, Scratch
from flypend.planning.solver import Solver

# After so many iterations so many go on, those of least cost. One of 160 random starts costs 5 % more for it.
ROUNDS: Mapping[int, int] = MappingProxyType({6: 4})

Array = NDArray[np.float64]


class Race:
    """Solvers of one problem each, which are seen as the lanes of one; those given up are stuck, and cost infinity.

    Parameters
    ----------
    kernels : Kernels
        The programs of a single problem.
    problem, states, commands : Problem, (stages + 1, 24 + n, lanes), (stages, n, lanes)
        As in `Solver`.
    rounds : dict
        See `ROUNDS`.
    """

    def __init__(
        self, kernels: Kernels, problem: Problem, states: Array, commands: Array, rounds: Mapping[int, int] = ROUNDS
    ) -> None:
        scratch = Scratch(kernels, problem.stages, 1)
        self._solvers = [
            Solver(
                kernels,
                Problem(problem.stages, *(_lane(a, i) for a in problem.arrays)),
                _lane(states, i),
                _lane(commands, i),
                scratch=scratch,
            )
            for i in range(states.shape[-1])
        ]
        self._running = list(range(len(self._solvers)))
        self._iterations, self._rounds = 0, rounds

    def improve(self) -> None:
        """Do one iteration of each that is not given up."""
        for i in self._running:
            self._solvers[i].improve()
        self._iterations += 1
        if self._iterations in self._rounds:
            cost = np.nan_to_num(self.cost[self._running], nan=np.inf)
            best = np.argsort(cost, kind="stable")[: self._rounds[self._iterations]]
            self._running = sorted(self._running[i] for i in best)

    def insist(self, place: int, weight: float, on: Any) -> None:
        """See `Solver`."""
        for i in on:
            self._solvers[i].insist(place, weight, slice(None))

    def iterate(self, lane: int) -> tuple[Array, Array]:
        """See `Solver`."""
        return self._solvers[lane].iterate(0)

    def __getattr__(self, name: str) -> Array:
        """Return what is measured, (lanes,): cost, value, violation, gap, end, barrier."""
        measured = {i: getattr(self._solvers[i], name)[0] for i in self._running}
        return np.array([measured.get(i, np.inf) for i in range(len(self._solvers))])

    @property
    def stuck(self) -> NDArray[np.bool_]:
        """See `Solver`."""
        return np.array([i not in self._running or solver.stuck[0] for i, solver in enumerate(self._solvers)])


def work(rounds: Mapping[int, int], guesses: int, iterations: int) -> int:
    """Return how many iterations of single guesses so many `iterations` of a race are."""
    done = 0
    for i in range(iterations):
        guesses = rounds.get(i, guesses)
        done += guesses
    return done


def _lane(values: Array, i: int) -> Array:
    own = lanes(*values.shape[:-1], width=1)
    own[..., 0] = values[..., i]
    return own
