"""What a kernel of the ideal plant integrates, as programs."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.program import Program


@dataclass(frozen=True)
class Problem:
    """What a kernel integrates, as programs of time t, state s and parameters p.

    Parameters
    ----------
    rates : Program
        (t, s, p) → rates of the state.
    project : Program
        s → s drawn back onto the manifold, and the drift (3,) before.
    observe : Program
        (t, s, p) → the values that `reductions` reduce at the sample times.
    reductions : tuple of str
        One kind per value: see `Reductions`.
    margin : Program, optional
        (t, s, p) → a number that stays positive where the law is defined.
    """

    rates: Program
    project: Program
    observe: Program
    reductions: tuple[str, ...]
    margin: Program | None = None

    @property
    def size(self) -> int:
        """Length of the state."""
        return self.rates.inputs[1]

    @property
    def parameters(self) -> int:
        """Number of parameters."""
        return self.rates.inputs[2]
