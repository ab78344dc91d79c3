"""What ends a flight as collided, as scalar programs."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.program import Program

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
