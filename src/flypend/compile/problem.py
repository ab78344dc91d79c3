"""The problem that a kernel of the ideal plant integrates, as scalar programs."""

from __future__ import annotations

from dataclasses import dataclass

from flypend.compile.program import Program


@dataclass(frozen=True)
class Problem:
    """An initial value problem as scalar programs of time t, state s and parameters p.

    Parameters
    ----------
    rates : Program
        (t, s, p) → state rates.
    project : Program
        s → s projected onto the manifold, and the drift (3,) before projection.
    observe : Program
        (t, s, p) → the values to reduce over the sample times.
    reductions : tuple of str
        One kind of reduction per value; see `Reductions`.
    margin : Program, optional
        (t, s, p) → a scalar that is positive where the law is defined.
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
