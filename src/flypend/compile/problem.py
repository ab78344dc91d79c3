"""The problem that a kernel of the ideal plant integrates, as scalar programs."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.program import Program, drop_dead

# Operations with kinks or jumps.
PIECEWISE = frozenset(
    ("fabs", "sign", "fmin", "fmax", "floor", "ceil", "fmod", "select", "not", "and", "or", "lt", "le", "eq", "ne")
)

# Longest interval in which the rod moves along a cubic, s.
LONGEST = 2e-3


@dataclass(frozen=True)
class Touch:
    """What the rod can touch; see `flypend.flight.touch`.

    States are followed by forces: of the rotors in a sampled flight, the thrust in the ideal plant.

    Parameters
    ----------
    room : Program
        (state before, state after, seconds in between) → a lower bound of the distances in between.
    touching : Program
        (before, after, seconds) → (least distance, share of the interval until the rod touches, part); the share is > 1
        if it does not.
    """

    room: Program
    touching: Program


@dataclass(frozen=True)
class Judging:
    """What is reduced over a run: gauges that must end within bounds, and forces.

    Parameters
    ----------
    gauges : Program
        (t, s, ṡ) → k gauges, their first and second time derivatives, and the tolerances they are about, each (k,). A
        gauge is a squared distance, less a squared tolerance or not; the last one is the square of which the largest
        root is reported.
    bounds : tuple of float
        Largest value within tolerance of each gauge.
    forces : Program
        Output 1 of the rates, here called wrench → mean square and maximum of the forces (2,).
    """

    gauges: Program
    bounds: tuple[float, ...]
    forces: Program

    @property
    def values(self) -> Program:
        """(t, s, ṡ) → the gauges alone, which do not depend on ṡ."""
        return drop_dead(Program("values", self.gauges.inputs, self.gauges.operations, self.gauges.outputs[:1]))

    @property
    def smooth(self) -> bool:
        """Whether the gauges are without cases, so that between steps they follow from their derivatives."""
        return not PIECEWISE & self.gauges.counts().keys()

    @property
    def size(self) -> int:
        """Number of reductions.

        Time since which all gauges are within bounds, last time out of bounds of each, root of the largest value of the
        last gauge, and mean square over time and maximum of the forces.
        """
        return len(self.bounds) + 4


@dataclass(frozen=True)
class Problem:
    """An initial value problem as scalar programs of time t, state s and parameters p.

    Parameters
    ----------
    rates : Program
        (t, s, p) → state rates, and if runs are judged the wrench.
    project : Program
        s → s projected onto the manifold, and the drift (3,) before projection.
    judging : Judging, optional
        What is reduced over a run.
    margin : Program, optional
        (t, s, p) → a scalar that is positive where the law is defined.
    touch : Touch, optional
        What ends a flight as collided.
    """

    rates: Program
    project: Program
    judging: Judging | None = None
    margin: Program | None = None
    touch: Touch | None = None

    @property
    def size(self) -> int:
        """Length of the state."""
        return self.rates.inputs[1]

    @property
    def parameters(self) -> int:
        """Number of parameters."""
        return self.rates.inputs[2]
