"""Embedded Runge-Kutta methods as tables, from SciPy, with what a step controller must know of each."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from flypend.errors import one_of

NAMES = ("dop853", "dp5")


@dataclass(frozen=True)
class Method:
    """An explicit embedded Runge-Kutta method with s stages.

    Parameters
    ----------
    name : str
        "dop853" or "dp5".
    A, B, C : (s, s), (s,), (s,)
        The Butcher tableau.
    errors : tuple of (s+1,)
        One error estimate, or two (of orders 5 and 3) that Hairer's formula for DOP853 joins; entry s weighs f at the
        end of the step.
    A_extra, C_extra : (e, s+1+e), (e,)
        Further stages for the dense output.
    dense : array
        For "dp5" the polynomial (s+1, 4) of the dense output, for "dop853" the rows (4, s+1+e) of its upper terms.
    """

    name: str
    A: Any
    B: Any
    C: Any
    errors: tuple[Any, ...]
    A_extra: Any
    C_extra: Any
    dense: Any

    @property
    def stages(self) -> int:
        """s, the number of evaluations of a step that is rejected."""
        return len(self.B)


@cache
def method(name: str) -> Method:
    """The method called `name`: "dop853" (Prince and Dormand's 8(5,3)) or "dp5" (Dormand and Prince's 5(4)).

    Raises InputError for another name.
    """
    from scipy.integrate import DOP853, RK45

    if one_of("method", name, NAMES) == "dp5":
        none = np.zeros((0, RK45.n_stages + 1))
        return Method("dp5", RK45.A, RK45.B, RK45.C, (RK45.E,), none, np.zeros(0), RK45.P)
    errors = (DOP853.E5, DOP853.E3)
    return Method("dop853", DOP853.A, DOP853.B, DOP853.C, errors, DOP853.A_EXTRA, DOP853.C_EXTRA, DOP853.D)
