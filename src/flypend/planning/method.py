"""What the solver is given: a problem, the numbers of its method, and memory to work in."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from flypend.compile.llvm.stagewise import lanes as some_lanes
from flypend.model.state import SIZE
from flypend.planning.kernels import Kernels

Lanes = NDArray[np.float64]


@dataclass(frozen=True)
class Settings:
    """Numbers of the method, in the machine's own units, in which the cost is of order one.

    Parameters
    ----------
    barrier, least_barrier, cooling : float
        First and last μ, and its factor after a good step.
    damping, least_damping, most_damping : float
        First, least and largest damping of commands.
    state_damping : float
        Damping of states, as a share of that of commands.
    worse, better : float
        Factors of the damping after a step that failed, and after a long one.
    shrink : float
        Factor of the step length while the merit does not fall.
    attempts : int
        Most step lengths per iteration.
    room : float
        Largest share of the room to a limit that one step takes.
    turn : float
        Largest change of attitude or rod in one step, rad.
    spread : float
        Largest ratio between a multiplier and μ/s, either way.
    end_weight, most_end_weight, end_growth : float
        First and largest weight of the squared errors at the end, and its factor per iteration while they are too
        large at a barrier below `end_barrier`.
    end_barrier : float
        See `end_growth`.
    relief : float
        Barrier down to which a large e costs its logarithm, so that it does not outweigh the end.
    """

    barrier: float = 1e-3
    least_barrier: float = 1e-6
    cooling: float = 0.8
    damping: float = 3e-3
    least_damping: float = 1e-6
    most_damping: float = 1e6
    state_damping: float = 0.1
    worse: float = 8.0
    better: float = 1 / 3
    shrink: float = 0.4
    attempts: int = 8
    room: float = 0.9
    turn: float = 2.0
    spread: float = 100.0
    end_weight: float = 0.005
    most_end_weight: float = 50.0
    end_growth: float = 1.3
    end_barrier: float = 1e-4
    relief: float = 1e-4


@dataclass(frozen=True)
class Problem:
    """What is to be planned, one problem per lane, in each machine's own units.

    Parameters
    ----------
    stages : int
        Number of stages.
    timing : (4, lanes)
        Timing of a stage; see `plants.lag.step_timing`.
    vehicle : (k, lanes)
        Numbers of the machines; see `scaled.Units.numbers`.
    numbers : (j, lanes)
        Numbers of the inequalities; see `inequalities.Structure.numbers`.
    places : (stages + 1, 3, lanes), optional
        Where the pivot is to be, with the wish of a path; else the origin.
    """

    stages: int
    timing: Lanes
    vehicle: Lanes
    numbers: Lanes
    places: Lanes | None = None

    @property
    def arrays(self) -> tuple[Lanes, ...]:
        """What differs between lanes."""
        own = (self.timing, self.vehicle, self.numbers)
        return own if self.places is None else (*own, self.places)


class Scratch:
    """What an iteration of a solver writes before it reads it, for a number of `stages` on `width` lanes.

    Solvers that take turns share it: then it stays in the processor's cache.
    """

    def __init__(self, kernels: Kernels, stages: int, width: int) -> None:
        shape, k, of = kernels.shape, kernels.inequalities, partial(some_lanes, stages, width=width)
        self.slopes, self.d = tuple(of(length) for length in kernels.slopes), of(shape.n)
        self.cost, self.gains, self.summary = of(kernels.of_stage), of(shape.gains), of(2)
        self.to_go, self.end = (some_lanes(many, kernels.to_go, width=width) for many in (stages + 1, 1))
        self.delta, self.upsilon = some_lanes(stages + 1, shape.n, width=width), of(shape.k)
        self.costate, self.s_step, self.z_step, self.shares = of(1), of(k), of(k), of(2)
        self.new_states, self.new_commands = some_lanes(stages + 1, SIZE + shape.k, width=width), of(shape.k)
        self.trial, self.new_slack = of(k), of(k)
